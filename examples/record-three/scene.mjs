// Asteroids that turn and drift, in a group that turns as a whole. Now and then one disappears.
import { BoxGeometry, Group, IcosahedronGeometry, Mesh, MeshBasicMaterial, Scene } from 'three';

export function createScene(count = 300) {
  const scene = new Scene();
  const belt = new Group();
  scene.add(belt);
  const geometries = [new BoxGeometry(1, 1, 1), new IcosahedronGeometry(0.7), new BoxGeometry(3, 0.4, 0.4)];
  const material = new MeshBasicMaterial();
  const rocks = Array.from({ length: count }, (_, k) => {
    const rock = new Mesh(geometries[k % 3], material);
    const angle = k * 2.4;
    rock.position.set((8 + (k % 9)) * Math.cos(angle), ((k * 5) % 7) - 3, (8 + (k % 9)) * Math.sin(angle));
    rock.scale.setScalar(0.5 + (k % 5) / 4);
    belt.add(rock);
    return rock;
  });
  return {
    scene,
    belt,
    step(frame) {
      belt.rotation.y += 0.005;
      rocks.forEach((rock, k) => {
        rock.rotation.x += 0.01 + k / 30_000;
        rock.position.y += Math.sin(frame / 20 + k) / 100;
      });
      if (frame % 20 === 19) belt.remove(rocks[frame % count]);
    },
  };
}
