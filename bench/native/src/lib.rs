// What every program in Rust shares: it reads the frames of a scene from a file, plays as many as a line of its input asks
// for, and answers with a line for each: milliseconds, pairs, and fingerprints of the pairs and of the boxes, made as
// harness/fingerprint.mjs makes them.
use std::io::{BufRead, Write};
use std::time::Instant;

pub struct Frames {
    pub dimensions: usize,
    pub count: usize,
    numbers: Vec<f32>,
}

impl Frames {
    pub fn frame(&self, k: usize) -> &[f32] {
        let stride = 2 * self.dimensions * self.count;
        &self.numbers[k * stride..(k + 1) * stride]
    }
}

fn read(path: &str) -> Frames {
    let bytes = std::fs::read(path).expect("the file of frames");
    let number = |k: usize| u32::from_le_bytes(bytes[4 * k..4 * k + 4].try_into().unwrap());
    Frames {
        dimensions: number(0) as usize,
        count: number(1) as usize,
        numbers: (2..bytes.len() / 4).map(|k| f32::from_bits(number(k))).collect(),
    }
}

/// `make` gets the first frame, and gives what takes in a frame and puts the pairs it finds into a list.
pub fn play<F: FnMut(&[f32], &mut Vec<(u32, u32)>)>(make: impl FnOnce(&Frames) -> F) {
    let frames = read(&std::env::args().nth(1).expect("a file of frames"));
    let mut update = make(&frames);
    let mut pairs = Vec::new();
    let mut next = 0;
    println!("ready");
    for line in std::io::stdin().lock().lines() {
        let wanted: usize = line.unwrap().trim().parse().expect("a number of frames");
        let mut out = std::io::stdout().lock();
        for _ in 0..wanted {
            let boxes = frames.frame(next);
            next += 1;
            let start = Instant::now();
            pairs.clear();
            update(boxes, &mut pairs);
            let ms = start.elapsed().as_secs_f64() * 1000.0;
            writeln!(out, "{ms} {} {} {}", pairs.len(), of_pairs(&pairs), of_boxes(boxes)).unwrap();
        }
        writeln!(out, ".").unwrap();
        out.flush().unwrap();
    }
}

fn mix(value: u32) -> u32 {
    let mut hash = value;
    hash = (hash ^ (hash >> 16)).wrapping_mul(0x7feb352d);
    hash = (hash ^ (hash >> 15)).wrapping_mul(0x846ca68b);
    hash ^ (hash >> 16)
}

fn of_pairs(pairs: &[(u32, u32)]) -> String {
    let (mut first, mut second) = (0u32, 0u32);
    for &(a, b) in pairs {
        let (low, high) = (a.min(b), a.max(b));
        first = first.wrapping_add(mix(low.wrapping_mul(0x9e3779b1) ^ mix(high)));
        second = second.wrapping_add(mix(high.wrapping_mul(0x85ebca77) ^ mix(low.wrapping_add(0x5bd1e995))));
    }
    format!("{first:x} {second:x}")
}

fn of_boxes(boxes: &[f32]) -> String {
    let mut hash = boxes.len() as u32;
    for (k, number) in boxes.iter().enumerate() {
        hash = (hash ^ number.to_bits()).wrapping_mul(0x01000193).wrapping_add(k as u32);
    }
    format!("{hash:x}")
}
