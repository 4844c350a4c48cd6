// npm i && npm start: balls bounce between walls and platforms; the button saves the recording so far.
import Phaser from 'phaser';
import { playButton } from './page/page.mjs';
import { recordPhaser } from './record-phaser.mjs';

const balls = 200;

class Bouncing extends Phaser.Scene {
  create() {
    const ball = this.make.graphics({ x: 0, y: 0 }, false).fillStyle(0x5f78e8).fillCircle(6, 6, 6);
    ball.generateTexture('ball', 12, 12);
    const moving = this.physics.add.group({ collideWorldBounds: true, bounceX: 1, bounceY: 0.9 });
    for (let k = 0; k < balls; k++) {
      moving.create(20 + ((k * 37) % 600), 20 + ((k * 23) % 300), 'ball').setVelocity(((k * 31) % 200) - 100, 0);
    }
    const platforms = Array.from({ length: 6 }, (_, k) =>
      this.add.rectangle(70 + 100 * k, 180 + 35 * (k % 3), 70, 10, 0x73767e),
    );
    const still = this.physics.add.staticGroup(platforms);
    this.physics.add.collider(moving, moving);
    this.physics.add.collider(moving, still);

    const recorded = recordPhaser(this);
    document.getElementById('save').addEventListener('click', () => recorded.download());
    globalThis.recorded = recorded;
  }
}

const game = new Phaser.Game({
  type: Phaser.CANVAS,
  parent: 'game',
  scale: { mode: Phaser.Scale.FIT, autoCenter: Phaser.Scale.CENTER_BOTH, width: 640, height: 400 },
  transparent: true,
  banner: false,
  audio: { noAudio: true },
  // Within a page, it leaves the focus, the wheel and a finger that scrolls to the page.
  autoFocus: false,
  input: { mouse: { preventDefaultWheel: false }, touch: { capture: false } },
  physics: { default: 'arcade', arcade: { gravity: { x: 0, y: 200 } } },
  scene: Bouncing,
});

// From the first frame on.
game.events.once(Phaser.Core.Events.POST_RENDER, () =>
  playButton(document.getElementById('play'), (playing) => {
    if (playing) game.loop.wake();
    else game.loop.sleep();
  }),
);
