// npm i && npm start: 20,000 bullets against 200 ships. broadphase finds the overlaps; Phaser draws, and reads the
// pointer and the keys. Runs on Phaser 3 and 4.
import Phaser from 'phaser';
import { Bullets } from './bullets.mjs';
import { playButton, stopwatch } from './page/page.mjs';

const ships = 200;
const bullets = 20_000;
/** The world has the proportions of the window, and always this area, in pixels. */
const area = 1920 * 1200;
/** Pixels per frame, by the arrow keys. */
const shieldSpeed = 9;
const hues = 8;

const stage = document.getElementById('stage');
stage.tabIndex = 0; // so that it gets the keys
const aspect = stage.clientWidth / stage.clientHeight;
const game = new Bullets(ships, bullets, Math.sqrt(area * aspect), Math.sqrt(area / aspect));
const colours = Array.from(
  { length: hues },
  (_, k) => Phaser.Display.Color.HSVToRGB(0.52 + (0.46 * k) / hues, 0.62, 0.95).color,
);
const search = stopwatch();
let playing = false;
let plain = false;

class Hell extends Phaser.Scene {
  create() {
    this.disc('bullet', 6, 1);
    this.disc('ship', 128, 0.55);
    const blitter = this.add.blitter(0, 0, 'bullet'); // the lightest sprites Phaser has
    this.bobs = Array.from({ length: bullets }, () => blitter.create(0, 0));
    this.ships = Array.from({ length: ships }, (_, id) =>
      this.add
        .image(0, 0, 'ship')
        .setTint(id === 0 ? 0xffb000 : colours[id % hues])
        .setScale(game.radius[id] / 64),
    );
    this.keys = this.input.keyboard.createCursorKeys();
    const follow = ({ worldX, worldY }) => this.moveShield(worldX, worldY);
    this.input.on('pointermove', follow);
    this.input.on('pointerdown', follow);
    this.draw();
  }

  /** A white disc as a texture, with a rim. */
  disc(name, size, inside) {
    const r = size / 2;
    const drawing = this.make.graphics({}, false).fillStyle(0xffffff, inside).fillCircle(r, r, r);
    drawing.lineStyle(size / 20, 0xffffff, 1).strokeCircle(r, r, r * 0.95);
    drawing.generateTexture(name, size, size);
  }

  moveShield(x, y) {
    game.x[0] = Math.min(game.width, Math.max(0, x));
    game.y[0] = Math.min(game.height, Math.max(0, y));
  }

  update(_time, delta) {
    if (!playing) return;
    const frames = Math.min(2, (delta * 60) / 1000);
    const { left, right, up, down } = this.keys;
    const way = frames * shieldSpeed;
    this.moveShield(
      game.x[0] + way * (Number(right.isDown) - Number(left.isDown)),
      game.y[0] + way * (Number(down.isDown) - Number(up.isDown)),
    );
    game.move(frames);
    find();
    game.collide();
    this.draw();
  }

  draw() {
    for (let k = 0; k < bullets; k++) {
      const bob = this.bobs[k];
      bob.x = game.x[ships + k] - 3;
      bob.y = game.y[ships + k] - 3;
      bob.tint = colours[game.owner[ships + k] % hues];
    }
    for (let id = 0; id < ships; id++) {
      this.ships[id].setPosition(game.x[id], game.y[id]).setAlpha(0.45 + 0.55 * game.glow[id]);
    }
  }
}

const find = () => search.time(() => (plain ? game.findByPlainLoops() : game.find()));

const phaser = new Phaser.Game({
  parent: stage,
  width: game.width,
  height: game.height,
  transparent: true,
  banner: false,
  audio: { noAudio: true },
  // Within a page, it leaves the focus, the wheel and a finger that scrolls to the page.
  autoFocus: false,
  input: { mouse: { preventDefaultWheel: false }, touch: { capture: false } },
  scale: { mode: Phaser.Scale.FIT, autoCenter: Phaser.Scale.CENTER_BOTH },
  scene: Hell,
});

const numbers = document.getElementById('numbers');
const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });
function report() {
  const pairs = game.pairs.length / 2;
  numbers.innerHTML = `<b>${search.mean().toFixed(2)} ms</b> to find <b>${whole.format(pairs)}</b> pairs among ${whole.format(game.count)} · ${whole.format(phaser.loop.actualFps)} frames a second · you caught ${whole.format(game.caught)}`;
}
setInterval(() => playing && report(), 250);

// From the first frame on. While it pauses, Phaser draws nothing either.
phaser.events.once(Phaser.Core.Events.POST_RENDER, () =>
  playButton(document.getElementById('play'), (now) => {
    playing = now;
    if (playing) phaser.loop.wake();
    else phaser.loop.sleep();
  }),
);
document.getElementById('plain').addEventListener('change', ({ target }) => {
  plain = target.checked;
  search.mean();
  find();
  report();
});
find();
report();
globalThis.game = game; // for the test
