//! Marks of ink: how long they are, how far apart, how wide.

use crate::frame::Frame;

/// From so much on a pixel belongs to a mark.
const INKED: f64 = 0.3;
/// Marks shorter than this are crumbs, px.
const SHORT: f64 = 6.0;
/// Greatest change of depth between neighbors of one surface, as a share of the depth, and least cosine between their normals.
const SAME_DEPTH: f32 = 0.01;
const SAME_NORMAL: f32 = 0.9;

/// Ink in marks that are all of it, short, and short with nothing that cuts them off.
pub(crate) struct Marks {
    all: f64,
    short: f64,
    free: f64,
}

impl Marks {
    pub(crate) fn of(frame: &Frame) -> Self {
        let side = frame.side;
        let mut is_seen: Vec<bool> = frame.inks.iter().map(|ink| *ink < INKED).collect();
        let mut marks = Self { all: 0.0, short: 0.0, free: 0.0 };
        for start in 0..is_seen.len() {
            if is_seen[start] {
                continue;
            }
            is_seen[start] = true;
            let mut mark = vec![start];
            let mut next = 0;
            while let Some(&px) = mark.get(next) {
                next += 1;
                for neighbor in around(px, side) {
                    if !std::mem::replace(&mut is_seen[neighbor], true) {
                        mark.push(neighbor);
                    }
                }
            }
            let ink: f64 = mark.iter().map(|px| frame.inks[*px]).sum();
            let range = |coordinate: fn(usize, usize) -> usize| {
                let all = mark.iter().map(|px| coordinate(*px, side));
                (all.clone().max().unwrap() - all.min().unwrap() + 1) as f64
            };
            let length = range(|px, side| px % side).hypot(range(|px, side| px / side));
            marks.all += ink;
            if length < SHORT {
                marks.short += ink;
                let is_cut =
                    mark.iter().any(|px| around(*px, side).any(|other| has_border(frame, *px, other)));
                marks.free += if is_cut { 0.0 } else { ink };
            }
        }
        marks
    }

    /// Share of the ink in short marks.
    pub(crate) fn crumbs(&self) -> f64 {
        self.short / self.all
    }

    /// The same without those that touch the border of a surface.
    pub(crate) fn free_crumbs(&self) -> f64 {
        self.free / self.all
    }
}

fn around(px: usize, side: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (px % side, px / side);
    let near = move |c: usize| c.saturating_sub(1)..(c + 2).min(side);
    near(y).flat_map(move |y| near(x).map(move |x| y * side + x))
}

fn has_border(frame: &Frame, a: usize, b: usize) -> bool {
    let [a, b] = [a, b].map(|px| &frame.surfels[px]);
    a.object != b.object
        || (a.depth / b.depth - 1.0).abs() > SAME_DEPTH
        || a.face_normal.dot(b.face_normal) < SAME_NORMAL
}

/// Mean spacing and width of strokes, px.
pub(crate) struct Evenness {
    pub(crate) spacing: f64,
    pub(crate) width: f64,
}

impl Evenness {
    /// By Crofton's formula the length of the borders of strokes is π/4 of how often rows and columns of pixels cross them, where
    /// they run anyhow.
    pub(crate) fn of(frame: &Frame) -> Self {
        let side = frame.side;
        let last = side - 1;
        let inside = (0..side * side).filter(|px| {
            let (x, y) = (px % side, px / side);
            let neighbors = [*px, px + 1, px + side];
            x < last && y < last && neighbors.iter().all(|px| frame.surfels[*px].object != 0)
        });
        let (mut area, mut crossed, mut covered) = (0.0, 0.0, 0.0);
        for px in inside {
            let ink = |px: usize| frame.inks[px];
            area += 1.0;
            crossed += (ink(px + 1) - ink(px)).abs() + (ink(px + side) - ink(px)).abs();
            covered += ink(px);
        }
        let spacing = 2.0 * area / (std::f64::consts::FRAC_PI_4 * crossed);
        Self { spacing, width: covered / area * spacing }
    }
}

pub(crate) fn mean(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().sum::<f64>() / values.count() as f64
}

/// Coefficient of variation.
pub(crate) fn variation(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count() as f64;
    let mean = mean(values.clone());
    (values.map(|v| (v - mean) * (v - mean)).sum::<f64>() / count).sqrt() / mean
}
