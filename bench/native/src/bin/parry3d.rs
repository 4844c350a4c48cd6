use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};

fn box_of(numbers: &[f32]) -> Aabb {
    Aabb::new(Vector::new(numbers[0], numbers[1], numbers[2]), Vector::new(numbers[3], numbers[4], numbers[5]))
}

include!("../parry.rs");
