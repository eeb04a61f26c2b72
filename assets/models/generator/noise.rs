//! Chance that is the same on every run: numbers in a row, and smooth noise over a torus.

use glam::{DVec2, IVec2, dvec2};

use crate::picture::smoothstep;

/// A row of numbers.
pub(crate) struct Chance(u64);

impl Chance {
    /// The row that belongs to `seed`.
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number between `low` and `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        // The step of splitmix64.
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        low + (high - low) * unit(self.0)
    }
}

/// Smooth noise from −1 to 1 that repeats every `period` cells; `p` counts cells.
pub(crate) fn noise(seed: u64, period: IVec2, p: DVec2) -> f64 {
    let cell = p.floor();
    let weight = (p - cell).to_array().map(|t| smoothstep(0.0, 1.0, t));
    let corner = |dx: i32, dy: i32| {
        let at = (cell.as_ivec2() + IVec2::new(dx, dy)).rem_euclid(period);
        2.0 * unit(seed << 48 ^ (at.x as u64) << 24 ^ at.y as u64) - 1.0
    };
    let row = |dy: i32| corner(0, dy) + (corner(1, dy) - corner(0, dy)) * weight[0];
    row(0) + (row(1) - row(0)) * weight[1]
}

/// Noise on an image of the given size whose cells are as large as stated; whole cells fill the image.
pub(crate) fn tiled(seed: u64, size: DVec2, cell: DVec2, p: DVec2) -> f64 {
    let period = (size / cell).round().max(dvec2(1.0, 1.0));
    noise(seed, period.as_ivec2(), p / size * period)
}

/// A number from 0 to 1 for a key: the finish of splitmix64.
fn unit(key: u64) -> f64 {
    let mut z = key.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
