// The button that records frames, and saves them as a trace.
import { find } from '../../shared/elements.ts';
import { formatCount } from '../../shared/format.ts';
import { save } from '../files.ts';
import type { Picture, Requests } from '../worker/messages.ts';

type Bytes = ReturnType<Requests['recording']>;

interface Doing {
  begin(): Promise<void>;
  /** Ends it. */
  bytes(): Promise<Bytes>;
  /** What is shown now, for the name of the file. */
  name(): string;
  failed(error: unknown): void;
}

export function createRecorder(doing: Doing) {
  const button = find('record');
  const text = find('recording');
  /** The name of what is being recorded. */
  let recording: string | undefined;

  const turn = (name: string | undefined) => {
    recording = name;
    button.textContent = name === undefined ? 'Record' : 'Stop and save';
  };

  /** Ends a recording and saves it, if there is one; `why` it ended, unless it was asked to. */
  async function end(why = '', bytes = doing.bytes): Promise<void> {
    if (recording === undefined) return;
    const name = recording;
    turn(undefined);
    try {
      save(await bytes(), `${name}.trace`);
      text.textContent = `${why}Saved. Next: npx broadphase tune on that file.`;
    } catch (error) {
      text.textContent = `${why}The recording is lost.`;
      doing.failed(error);
    }
  }

  async function begin(): Promise<void> {
    turn(doing.name());
    try {
      await doing.begin();
    } catch (error) {
      turn(undefined);
      doing.failed(error);
    }
  }

  button.addEventListener('click', () => void (recording === undefined ? begin() : end()));
  return {
    end,
    /** Tells how much has been recorded. */
    show(recorded: Picture['recorded']): void {
      if (recording === undefined || !recorded) return;
      const { frames, bytes, full } = recorded;
      text.textContent = `${formatCount(frames)} frames, ${(bytes / 1e6).toFixed(1)} MB${full ? ': full' : ''}`;
    },
  };
}
