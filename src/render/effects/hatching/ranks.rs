//! In which order lines of hatching come as it gets darker, and where their strokes begin: as in
//! `shaders/effects/hatching/strokes.wgsl`.

/// So many lines that were born at a level beside each other differ.
const IDS: u32 = 8;
/// Ranks of 16, and beginnings in fifteenths of a stroke: a hexadecimal digit for each of [`IDS`]; lines of the next level have the
/// other words. Found by a search for the most even tone in patches of 8 × 8 spacings, at every density.
const RANKS: [u32; 2] = [0x4f6a_2d19, 0xb083_c5e7];
const OFFSETS: [u32; 2] = [0x5783_e40b, 0x2a96_35e8];

/// Which line it is: the same one while one comes closer.
pub(super) struct LineId {
    /// Among those that were born with it.
    pub(super) index: u32,
    /// At which it was born.
    pub(super) level: i32,
}

impl LineId {
    /// `number`: of the line among those of a level, that begin again after `period` (a power of two).
    pub(super) fn of(number: u32, period: u32, level: i32) -> Self {
        let bits = number % period;
        let born = (if bits == 0 { period } else { bits }).trailing_zeros();
        Self { index: (bits >> (born + 1)) % IDS, level: level - born as i32 }
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

/// In which order widths come: every second stroke of a line has another rank, so that a line is as dark as the others.
pub(super) fn rank_of_width(rank: u32, number: u32) -> u32 {
    (5 * (rank + 8 * (number & 1)) + 3) & 15
}
