use parry2d::bounding_volume::Aabb;
use parry2d::math::Vector;
use parry2d::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};

fn box_of(numbers: &[f32]) -> Aabb {
    Aabb::new(Vector::new(numbers[0], numbers[1]), Vector::new(numbers[2], numbers[3]))
}

include!("../parry.rs");
