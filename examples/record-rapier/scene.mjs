// Cubes, balls, capsules and cylinders fall onto a floor and past a turning bar.
import * as RAPIER from '@dimforge/rapier3d-compat';

export async function createScene(count = 300) {
  await RAPIER.init();
  const world = new RAPIER.World({ x: 0, y: -9.81, z: 0 });
  world.createCollider(RAPIER.ColliderDesc.cuboid(20, 0.5, 20).setTranslation(0, -0.5, 0));
  const bar = world.createRigidBody(RAPIER.RigidBodyDesc.kinematicVelocityBased().setTranslation(0, 2, 0));
  bar.setAngvel({ x: 0, y: 2, z: 0 });
  world.createCollider(RAPIER.ColliderDesc.cuboid(8, 0.3, 0.3), bar);
  const shapes = [
    () => RAPIER.ColliderDesc.cuboid(0.4, 0.2, 0.3),
    () => RAPIER.ColliderDesc.ball(0.3),
    () => RAPIER.ColliderDesc.capsule(0.3, 0.2),
    () => RAPIER.ColliderDesc.cylinder(0.2, 0.4),
    () => RAPIER.ColliderDesc.convexHull(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)),
  ];
  for (let k = 0; k < count; k++) {
    const place = RAPIER.RigidBodyDesc.dynamic()
      .setTranslation(((k * 7) % 19) - 9, 4 + Math.floor(k / 40), ((k * 11) % 17) - 8)
      .setRotation({ x: Math.sin(k) / 2, y: 0, z: 0, w: Math.sqrt(1 - Math.sin(k) ** 2 / 4) });
    world.createCollider(shapes[k % shapes.length](), world.createRigidBody(place));
  }
  return world;
}
