//! Threshold maps: the prioritised stroke textures of Freudenberg et al. 2002 ("Real-Time Halftoning: A Primitive For
//! Non-Photorealistic Shading"), rank-normalised, with one octave of sizes.
//!
//! A texel holds the tone at which ink appears there: there is ink where the tone is less. All values are equally
//! frequent, so that a tone of `t` has ink on `1 − t` of the tile.
//!
//! A tile repeats in both directions. On a surface it is laid out in sizes that are powers of two; for those between
//! there are [`STEPS`] *steps*, each with strokes as large as the others' on the screen. The last step is the first one
//! twice as small: there the next octave takes over, and nothing jumps.

use rayon::prelude::*;

/// Texels along a side of a tile.
pub const SIDE: usize = 512;
/// Steps of an octave.
pub const STEPS: usize = 8;
/// Layers of a map: one for each step and the first one of the next octave.
pub const LAYERS: usize = STEPS + 1;
/// Strokes, lines or dots beside each other along a side of a tile, at the first step.
pub const PERIODS: usize = 32;
/// Places in the octave, evenly from 0 to 1, for which there is a calibration; four for each step.
pub const PLACES: usize = 4 * STEPS + 1;
/// Tones, evenly from 0 to 1, for which there is a calibration.
pub const TONES: usize = 33;
/// Number of mip levels, down to one texel.
pub const LEVELS: usize = SIDE.ilog2() as usize + 1;

/// One mip level of one layer, row by row.
///
/// A texel holds the mean threshold in its area and their spread, twice the standard deviation, in 255ths.
pub type Level = Vec<[u8; 2]>;

/// A prioritised texture as the device needs it.
#[derive(Debug, Clone, PartialEq)]
pub struct ThresholdMap {
    /// [`LAYERS`] layers of [`LEVELS`] levels each.
    pub layers: Vec<Vec<Level>>,
    /// Between two steps their thresholds are mixed, and mixtures are not equally frequent: for each of [`PLACES`] places
    /// in the octave and each of [`TONES`] tones the threshold that leaves so much paper.
    pub calibration: Vec<f32>,
}

impl ThresholdMap {
    /// The map of a texture. `priority(step)` gives its texels at a place 0 ≤ `step` < 1 in the octave, row by row;
    /// where it is greater, ink comes earlier. Only their order matters.
    pub fn new(priority: impl Fn(f32) -> Vec<f32> + Sync) -> Self {
        let mut layers: Vec<_> = (0..STEPS)
            .into_par_iter()
            .map(|step| levels(&ranks(&priority(step as f32 / STEPS as f32))))
            .collect();
        let next: Vec<_> = layers.first().map(|first| next_octave(first)).unwrap_or_default();
        layers.push(next);
        let finest: Vec<_> = layers.iter().filter_map(|layer| layer.first()).collect();
        let calibration = (0..PLACES).into_par_iter().flat_map_iter(|place| calibrate(&finest, place)).collect();
        Self { layers, calibration }
    }
}

/// Replaces values by their rank, 0 to 1: afterwards all are equally frequent. Equal ones are told apart by their place.
pub fn ranks(values: &[f32]) -> Vec<f32> {
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
    let mut ranks = vec![0.0; values.len()];
    for (rank, key) in order.iter().enumerate() {
        if let Some(slot) = ranks.get_mut(*key as u32 as usize) {
            *slot = (rank as f32 + 0.5) / values.len() as f32;
        }
    }
    ranks
}

/// Mean and variance of thresholds in the area of a texel.
#[derive(Debug, Clone, Copy)]
struct Moments {
    mean: f32,
    variance: f32,
}

/// All mip levels of a square of thresholds.
fn levels(thresholds: &[f32]) -> Vec<Level> {
    let mut side = SIDE;
    let at = |x: usize, y: usize| thresholds[(y % SIDE) * SIDE + x % SIDE];
    let mut texels: Vec<Moments> = (0..SIDE * SIDE)
        .map(|i| {
            // Inside a texel thresholds change evenly: a range of r has a variance of r²/12.
            let (x, y) = (i % SIDE, i / SIDE);
            let dx = 0.5 * (at(x + 1, y) - at(x + SIDE - 1, y));
            let dy = 0.5 * (at(x, y + 1) - at(x, y + SIDE - 1));
            Moments { mean: thresholds[i], variance: (dx * dx + dy * dy) / 12.0 }
        })
        .collect();
    let mut levels = vec![packed(&texels)];
    while side > 1 {
        let half = side / 2;
        texels = (0..half * half)
            .map(|i| {
                let (x, y) = (i % half * 2, i / half * 2);
                let four =
                    [y * side + x, y * side + x + 1, (y + 1) * side + x, (y + 1) * side + x + 1].map(|j| texels[j]);
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

/// Thresholds for all tones at a place in the octave.
fn calibrate(steps: &[&Level], place: usize) -> Vec<f32> {
    let (step, share) = (place / 4, place % 4);
    let tones = (0..TONES).map(|tone| tone as f32 / (TONES - 1) as f32);
    let (Some(here), Some(there)) = (steps.get(step), steps.get(step + 1)) else { return tones.collect() };
    if share == 0 {
        return tones.collect();
    }
    // Bytes mixed by quarters are whole numbers.
    let mut counts = vec![0u32; 255 * 4 + 1];
    for (a, b) in here.iter().zip(there.iter()) {
        let mixed = usize::from(a[0]) * (4 - share) + usize::from(b[0]) * share;
        if let Some(count) = counts.get_mut(mixed) {
            *count += 1;
        }
    }
    let (mut bin, mut below) = (0, 0.0);
    let threshold = |tone: f32| {
        let wanted = tone * here.len() as f32;
        while let Some(count) = counts.get(bin).filter(|count| below + **count as f32 <= wanted) {
            below += *count as f32;
            bin += 1;
        }
        let inside = counts.get(bin).map_or(0.0, |count| (wanted - below) / *count as f32);
        ((bin as f32 + inside) / counts.len() as f32).min(1.0)
    };
    tones.map(threshold).collect()
}
