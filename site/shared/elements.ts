// Elements of every page with a moving picture.
const playIcon = 'M4 2.2v11.6a.6.6 0 0 0 .9.5l9-5.8a.6.6 0 0 0 0-1l-9-5.8a.6.6 0 0 0-.9.5z';
const pauseIcon = 'M3.5 2h3v12h-3zM9.5 2h3v12h-3z';

/** The element with this id, which must exist. */
export const find = <T extends Element = HTMLElement>(id: string) => document.getElementById(id) as unknown as T;

/** Makes the play button say what it does next: play or pause. */
export function showPlaying(playing: boolean): void {
  find('play-icon').setAttribute('d', playing ? pauseIcon : playIcon);
  find('play-label').textContent = playing ? 'Pause' : 'Play';
}
