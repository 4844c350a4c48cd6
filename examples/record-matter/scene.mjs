// Circles and boxes of many sizes fall into a box, past some pegs.
import Matter from 'matter-js';

const { Bodies, Composite, Engine } = Matter;

export function createScene(count = 300) {
  const engine = Engine.create();
  const still = { isStatic: true };
  const walls = [
    Bodies.rectangle(400, 610, 820, 20, still),
    Bodies.rectangle(-10, 300, 20, 620, still),
    Bodies.rectangle(810, 300, 20, 620, still),
  ];
  const pegs = Array.from({ length: 24 }, (_, k) =>
    Bodies.circle(60 + (k % 8) * 97, 320 + 60 * Math.floor(k / 8), 8, still),
  );
  const falling = Array.from({ length: count }, (_, k) => {
    const [x, y, size] = [30 + ((k * 37) % 740), -((k * 53) % 900), 8 + (k % 7) * 2];
    return k % 2 ? Bodies.circle(x, y, size / 2) : Bodies.rectangle(x, y, size, size);
  });
  Composite.add(engine.world, [...walls, ...pegs, ...falling]);
  return engine;
}
