// broccoli: its tree is rebuilt in each frame, as its documentation advises, and reports all pairs. In 2D only.
use bench_native::play;
use broccoli::{bbox, rect, Tree};

fn main() {
    play(|frames| {
        let count = frames.count;
        let mut boxes = Vec::with_capacity(count);
        move |frame: &[f32], pairs: &mut Vec<(u32, u32)>| {
            boxes.clear();
            boxes.extend((0..count).map(|id| {
                let k = 4 * id;
                bbox(rect(frame[k], frame[k + 2], frame[k + 1], frame[k + 3]), id as u32)
            }));
            Tree::new(&mut boxes).find_colliding_pairs(|a, b| {
                pairs.push((*a.unpack_inner(), *b.unpack_inner()));
            });
        }
    });
}
