//! Threshold maps: the prioritized stroke textures of Freudenberg et al. 2002 ("Real-Time Halftoning: A Primitive For
//! Non-Photorealistic Shading"), rank-normalized, with one octave of sizes.
//!
//! A texel holds the tone at which ink appears there: there is ink where the tone is less. All values are equally
//! frequent, so that a tone of `t` has ink on `1 − t` of the tile.
//!
//! A tile repeats in both directions. On a surface it is laid out in sizes that are powers of two; for those between
//! there are [`STEPS`] *steps*, each with strokes as large as the others' on the screen. The last step is the first one
//! twice as small: there the next octave takes over, and nothing jumps.

use rayon::prelude::*;

use super::calibration;

/// Texels along a side of a tile.
pub const SIDE: usize = 512;
/// Steps of an octave.
pub const STEPS: usize = 8;
/// Layers of a map: one for each step and the first one of the next octave.
pub const LAYERS: usize = STEPS + 1;
/// Strokes, lines or dots beside each other along a side of a tile, at the first step.
pub const PERIODS: usize = 32;
/// Number of mip levels, down to one texel.
pub const LEVELS: usize = SIDE.ilog2() as usize + 1;

/// One mip level of one layer, row by row.
///
/// A texel holds the mean threshold in its area and their spread, twice the standard deviation, in 255ths.
pub type Level = Vec<[u8; 2]>;

/// A prioritized texture as the device needs it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ThresholdMap {
    /// [`LAYERS`] layers of [`LEVELS`] levels each.
    pub layers: Vec<Vec<Level>>,
    /// Thresholds for tones: see [`calibration`].
    pub calibration: Vec<f32>,
}

impl ThresholdMap {
    /// The map of a texture of which the thresholds at each of the [`STEPS`] are known, row by row in 256ths.
    pub fn new(steps: &[Vec<u8>]) -> Self {
        let layers = layers(steps);
        Self { calibration: calibration::measure(&layers), layers }
    }

    /// Reads images that `assets/textures` made: all steps below each other, and the calibration.
    ///
    /// # Errors
    /// When these are no such images.
    pub fn from_images(steps: &[u8], calibration: &[u8]) -> image::ImageResult<Self> {
        let steps = image::load_from_memory(steps)?.into_luma8().into_raw();
        let calibration = image::load_from_memory(calibration)?.into_luma16().into_raw();
        Ok(Self {
            layers: layers(&steps.chunks(SIDE * SIDE).map(<[u8]>::to_vec).collect::<Vec<_>>()),
            calibration: calibration.iter().map(|c| f32::from(*c) / 65535.0).collect(),
        })
    }
}

fn layers(steps: &[Vec<u8>]) -> Vec<Vec<Level>> {
    let mut layers: Vec<_> = steps.par_iter().map(|thresholds| levels(thresholds)).collect();
    let next: Vec<_> = layers.first().map(|first| next_octave(first)).unwrap_or_default();
    layers.push(next);
    layers
}

/// Thresholds in 256ths from priorities, of which only the order matters: ink comes earlier where they are greater.
/// Afterwards all thresholds are equally frequent; equal priorities are told apart by their place.
pub fn ranked(values: &[f32]) -> Vec<u8> {
    let mut order: Vec<u64> = values
        .iter()
        .enumerate()
        .map(|(i, v)| {
            // Orders as the numbers do, negative ones too.
            let bits = v.to_bits();
            let key = if bits >> 31 == 0 { bits | 1 << 31 } else { !bits };
            u64::from(key) << 32 | i as u64
        })
        .collect();
    order.sort_unstable();
    let mut ranked = vec![0; values.len()];
    for (rank, key) in order.iter().enumerate() {
        if let Some(slot) = ranked.get_mut(*key as u32 as usize) {
            *slot = (rank * 256 / values.len()) as u8;
        }
    }
    ranked
}

/// Mean and variance of thresholds in the area of a texel.
#[derive(Debug, Clone, Copy)]
struct Moments {
    mean: f32,
    variance: f32,
}

/// All mip levels of a square of thresholds in 256ths.
fn levels(thresholds: &[u8]) -> Vec<Level> {
    let mut side = SIDE;
    let at = |x: usize, y: usize| {
        let byte = thresholds.get((y % SIDE) * SIDE + x % SIDE).copied().unwrap_or_default();
        (f32::from(byte) + 0.5) / 256.0
    };
    let mut texels: Vec<Moments> = (0..SIDE * SIDE)
        .map(|i| {
            // Inside a texel thresholds change evenly: a range of r has a variance of r²/12.
            let (x, y) = (i % SIDE, i / SIDE);
            let dx = 0.5 * (at(x + 1, y) - at(x + SIDE - 1, y));
            let dy = 0.5 * (at(x, y + 1) - at(x, y + SIDE - 1));
            Moments { mean: at(x, y), variance: (dx * dx + dy * dy) / 12.0 }
        })
        .collect();
    let mut levels = vec![packed(&texels)];
    while side > 1 {
        let half = side / 2;
        texels = (0..half * half)
            .map(|i| {
                let (x, y) = (i % half * 2, i / half * 2);
                let four = [y * side + x, y * side + x + 1, (y + 1) * side + x, (y + 1) * side + x + 1]
                    .map(|j| texels[j]);
                let mean = four.iter().map(|t| t.mean).sum::<f32>() * 0.25;
                // The law of total variance.
                let variance =
                    four.iter().map(|t| t.variance + (t.mean - mean) * (t.mean - mean)).sum::<f32>() * 0.25;
                Moments { mean, variance }
            })
            .collect();
        side = half;
        levels.push(packed(&texels));
    }
    levels
}

fn packed(texels: &[Moments]) -> Level {
    let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
    texels.iter().map(|t| [byte(t.mean), byte(2.0 * t.variance.max(0.0).sqrt())]).collect()
}

/// The first layer of the next octave: the first one of this, half as large and twice as often.
fn next_octave(first: &[Level]) -> Vec<Level> {
    let halved = first.iter().skip(1).enumerate().map(|(level, texels)| {
        let side = SIDE >> level;
        let half = side / 2;
        (0..side * side).map(|i| texels[(i / side % half) * half + i % side % half]).collect()
    });
    halved.chain(first.last().cloned()).collect()
}
