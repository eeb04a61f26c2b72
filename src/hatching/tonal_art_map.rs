//! Tonal art maps: stroke textures over tones and resolutions (Praun et al. 2001, "Real-Time Hatching").
//!
//! A map is a square tile that repeats in both directions, in several resolutions (*levels*), each in several *tones*.
//! Strokes run along +x. They nest: the strokes of a tone are in all darker ones, the strokes of a level are in all
//! finer ones. They are as many texels wide in each level, so a coarser level has fewer of them for the same ink.

pub mod cached;
pub mod composition;
pub mod files;
pub mod generator;
mod placement;
pub mod priorities;
pub mod sets;
pub mod stroke;
pub mod stroke_image;
mod vacancy;

/// Stroke textures over tones and levels.
#[derive(Debug, Clone, PartialEq)]
pub struct TonalArtMap {
    /// Mean ink of each tone, light to dark, 0 to 1; each level keeps to it within [`INK_TOLERANCE`].
    pub inks: Vec<f32>,
    /// The resolutions, finest first; each has half the side of the one before.
    pub levels: Vec<Level>,
}

/// One resolution of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Texels along a side of the tile.
    pub side: usize,
    /// Ink of the texels of each tone, row by row: 0 is paper, 255 full ink.
    pub tones: Vec<Vec<u8>>,
    /// All tones in one image.
    pub priorities: Vec<Priority>,
}

/// How one texel is inked when the tone darkens, in two steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Priority {
    /// Mean ink of the tile above which each step is taken, in 255ths; 255: never. The first one is not greater.
    pub thresholds: [u8; 2],
    /// Ink of the texel after each step, in 255ths. The first one is not greater.
    pub inks: [u8; 2],
}

/// The mean ink of a tone is off by no more than this.
pub const INK_TOLERANCE: f32 = 0.01;

impl TonalArtMap {
    /// Ink of a tone at a place of the tile, 0 to 1, between texels; `place` in tiles. Twin of the shader's.
    pub fn ink(&self, level: usize, tone: usize, place: [f32; 2]) -> f32 {
        let Some(level) = self.levels.get(level) else { return 0.0 };
        let Some(tone) = level.tones.get(tone) else { return 0.0 };
        level.between(place, |i| tone.get(i).map_or(0.0, |ink| f32::from(*ink) / 255.0))
    }

    /// The same of a tile with the mean ink `ink`, from its priorities.
    pub fn ink_of_priorities(&self, level: usize, ink: f32, place: [f32; 2]) -> f32 {
        let Some(level) = self.levels.get(level) else { return 0.0 };
        level.between(place, |i| level.priorities.get(i).map_or(0.0, |priority| priority.ink_at(ink)))
    }
}

impl Level {
    /// A value between texels, bilinear.
    fn between(&self, [u, v]: [f32; 2], at: impl Fn(usize) -> f32) -> f32 {
        let side = self.side.max(1);
        let split = |c: f32| {
            let c = c * side as f32 - 0.5;
            let first = (c.floor() as i64).rem_euclid(side as i64) as usize;
            (first, (first + 1) % side, c - c.floor())
        };
        let ((left, right, x), (above, below, y)) = (split(u), split(v));
        let row = |row: usize| {
            let (a, b) = (at(row * side + left), at(row * side + right));
            a + (b - a) * x
        };
        let (first, second) = (row(above), row(below));
        first + (second - first) * y
    }
}
