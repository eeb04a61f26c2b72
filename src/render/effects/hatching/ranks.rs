//! When a line of hatching comes among those near it, and where its strokes begin: as in `shaders/effects/hatching/stripes.wgsl`.

/// So many lines that were born at a level beside each other differ.
pub(super) const BROOD: u32 = 8;
/// Ranks among 16 and beginnings in fifteenths of a stroke, a hexadecimal digit for each line of a brood; those of the next level
/// have the other words.
const RANKS: [u32; 2] = [0x6c0b_71da, 0x8d46_2b97];
const OFFSETS: [u32; 2] = [0x7e32_c894, 0xb5d3_c8e2];

/// A line among those that were born with it.
pub(super) struct Brood {
    pub(super) index: u32,
    pub(super) level: i32,
}

impl Brood {
    /// `number`: of the line among those of a level, that begin again after `period` (a power of two).
    pub(super) fn of(number: u32, period: u32, level: i32) -> Self {
        let bits = number % period;
        let born = (if bits == 0 { period } else { bits }).trailing_zeros();
        Self { index: (bits >> (born + 1)) % BROOD, level: level - born as i32 }
    }

    fn digit(&self, words: [u32; 2]) -> u32 {
        words[self.level.rem_euclid(2) as usize] >> (4 * self.index) & 15
    }

    pub(super) fn rank(&self) -> u32 {
        self.digit(RANKS)
    }

    /// In strokes; `level`: of lengths.
    pub(super) fn offset(&self, level: u32) -> f32 {
        // Twice as much where there are twice as many, so that what is an end stays one.
        ((self.digit(OFFSETS) << (level % 4)) % 15) as f32 / 15.0
    }
}

/// Strokes of a line take turns: every second one comes later.
pub(super) fn rank_of_stroke(rank: u32, number: u32) -> u32 {
    (rank + 8 * (number & 1)) & 15
}
