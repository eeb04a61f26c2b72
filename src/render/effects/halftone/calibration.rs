//! Which threshold leaves how much ink.
//!
//! In each layer of a map thresholds are equally frequent, but not between two layers, and not in the area of a pixel
//! that is larger than the strokes. So it is measured: for each of [`PLACES`] in the octave, [`SIZES`] of a pixel and
//! [`TONES`] a map keeps the threshold with which the mean ink of a tile is what the tone asks for.

use rayon::prelude::*;

use super::threshold_map::{LEVELS, Level, STEPS};

/// Places in the octave, evenly from 0 to 1.
pub const PLACES: usize = 4 * STEPS + 1;
/// Sizes of a pixel, evenly from 2⁻² to 2⁶ texels in powers of two.
pub const SIZES: usize = 33;
/// Tones, evenly from 0 to 1.
pub const TONES: usize = 33;

/// The size of a pixel of that number, as a power of two of texels.
fn size(number: usize) -> f32 {
    0.25 * number as f32 - 2.0
}

/// The thresholds of all places, in each of all sizes, in each of all tones.
pub fn measure(layers: &[Vec<Level>]) -> Vec<f32> {
    (0..PLACES * SIZES)
        .into_par_iter()
        .flat_map_iter(|i| measure_tones(layers, i / SIZES, size(i % SIZES)))
        .collect()
}

/// Share of ink in a pixel of which the thresholds have this mean and spread (see [`Level`]), for a threshold; `size`
/// of the pixel in texels of the finest level. Twin of `ink_share` in `shaders/effects/halftone.wgsl`.
pub fn ink(mean: f32, spread: f32, size: f32, threshold: f32) -> f32 {
    // An even spread over a width w has the deviation w / √12. An enlarged texel changes only a little within a pixel.
    let width = (3.0f32.sqrt() * spread * size.min(1.0)).min(2.0 * mean.min(1.0 - mean));
    ((mean - threshold) / width.max(MIN_WIDTH) + 0.5).clamp(0.0, 1.0)
}

/// Thresholds closer than this are one.
const MIN_WIDTH: f32 = 1e-4;

/// Mean and spread at a place of a tile, as the device reads them: between texels and between mip levels.
pub fn sample(layer: &[Level], [u, v]: [f32; 2], level: f32) -> [f32; 2] {
    let level = level.clamp(0.0, (LEVELS - 1) as f32);
    let coarser = layer.get(level as usize + 1).map_or([0.0; 2], |texels| bilinear(texels, u, v));
    let finer = layer.get(level as usize).map_or([0.0; 2], |texels| bilinear(texels, u, v));
    [0, 1].map(|i| finer[i] + (coarser[i] - finer[i]) * level.fract())
}

fn bilinear(texels: &Level, u: f32, v: f32) -> [f32; 2] {
    let side = texels.len().isqrt();
    let split = |c: f32| {
        let texel = c * side as f32 - 0.5;
        let first = (texel.floor() as i64).rem_euclid(side.max(1) as i64) as usize;
        (first, (first + 1) % side.max(1), texel - texel.floor())
    };
    let ((left, right, x), (upper, lower, y)) = (split(u), split(v));
    let at =
        |column: usize, row: usize| texels.get(row * side + column).map_or([0.0; 2], |t| t.map(f32::from));
    let corners = [at(left, upper), at(right, upper), at(left, lower), at(right, lower)];
    [0, 1].map(|i| {
        let [a, b, c, d] = corners.map(|corner| corner[i] / 255.0);
        let (above, below) = (a + (b - a) * x, c + (d - c) * x);
        above + (below - above) * y
    })
}

/// So many places of a tile are measured.
const MEASURED: usize = 4096;
/// So many thresholds are tried.
const TRIED: usize = 128;

/// Thresholds for all tones at a place in the octave, for pixels of 2^`size` texels.
fn measure_tones(layers: &[Vec<Level>], place: usize, size: f32) -> [f32; TONES] {
    let (step, share) =
        (place * STEPS / (PLACES - 1), (place * STEPS % (PLACES - 1)) as f32 / (PLACES - 1) as f32);
    let tried: [f32; TRIED + 1] = std::array::from_fn(|i| i as f32 / TRIED as f32);
    let mut inks = [0.0f32; TRIED + 1];
    for n in 0..MEASURED {
        // The R2 sequence fills the tile evenly.
        let at = [0.754_877_7, 0.569_840_3].map(|step: f64| (step * n as f64).fract() as f32);
        let [here, there] =
            [step, step + 1].map(|step| layers.get(step).map_or([0.0; 2], |layer| sample(layer, at, size)));
        let [mean, spread] =
            if share == 0.0 { here } else { [0, 1].map(|i| here[i] + (there[i] - here[i]) * share) };
        for (sum, threshold) in inks.iter_mut().zip(&tried) {
            *sum += ink(mean, spread, size.exp2(), *threshold) / MEASURED as f32;
        }
    }
    // The ink falls from 1 at the threshold 0 to nothing at 1.
    std::array::from_fn(|tone| {
        let request = 1.0 - tone as f32 / (TONES - 1) as f32;
        let after = inks.iter().position(|ink| *ink < request).unwrap_or(TRIED).clamp(1, TRIED);
        let (before, after_ink) = (inks[after - 1], inks[after]);
        let fall = (before - after_ink).max(1e-6);
        ((after - 1) as f32 + ((before - request) / fall).clamp(0.0, 1.0)) / TRIED as f32
    })
}
