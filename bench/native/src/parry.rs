// parry: its tree, either rebuilt in each frame or refitted, by one thread or by all.
use bench_native::{play, Frames};

fn boxes_of(frames: &Frames, frame: &[f32]) -> Vec<Aabb> {
    frame.chunks_exact(2 * frames.dimensions).map(box_of).collect()
}

fn main() {
    match std::env::args().nth(2).as_deref() {
        Some("rebuild") => play(|frames| {
            let (dimensions, count) = (frames.dimensions, frames.count);
            let mut workspace = BvhWorkspace::default();
            move |frame: &[f32], pairs: &mut Vec<(u32, u32)>| {
                let leaves = (0..count).map(|id| (id, box_of(&frame[2 * dimensions * id..2 * dimensions * (id + 1)])));
                let tree = Bvh::from_iter(BvhBuildStrategy::Binned, leaves);
                tree.traverse_bvtt_single_tree::<false>(&mut workspace, &mut |a, b| pairs.push((a, b)));
            }
        }),
        Some("refit") => play(|frames| {
            let mut tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes_of(frames, frames.frame(0)));
            let mut workspace = BvhWorkspace::default();
            let dimensions = frames.dimensions;
            move |frame: &[f32], pairs: &mut Vec<(u32, u32)>| {
                for (id, numbers) in frame.chunks_exact(2 * dimensions).enumerate() {
                    tree.insert_or_update_partially(box_of(numbers), id as u32, 0.0);
                }
                tree.refit(&mut workspace);
                tree.optimize_incremental(&mut workspace);
                tree.traverse_bvtt_single_tree::<false>(&mut workspace, &mut |a, b| pairs.push((a, b)));
            }
        }),
        Some("parallel") => play(|frames| {
            let mut tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes_of(frames, frames.frame(0)));
            let mut workspace = BvhWorkspace::default();
            let mut statuses = Vec::new();
            let mut updates = Vec::new();
            let dimensions = frames.dimensions;
            move |frame: &[f32], pairs: &mut Vec<(u32, u32)>| {
                updates.clear();
                let boxes = frame.chunks_exact(2 * dimensions).enumerate();
                updates.extend(boxes.map(|(id, numbers)| (box_of(numbers), id as u32, 0.0)));
                tree.insert_or_update_batch_partially_parallel(&updates, &mut statuses);
                tree.refit_parallel(&mut workspace);
                tree.optimize_incremental(&mut workspace);
                *pairs = tree.traverse_bvtt_single_tree_parallel::<false>();
            }
        }),
        other => panic!("expected rebuild, refit or parallel, not {other:?}"),
    }
}
