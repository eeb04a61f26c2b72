//! Images as halftone textures.

use super::threshold_map::{SIDE, STEPS, ThresholdMap, ranked};
use crate::scene::Texture;

impl ThresholdMap {
    /// The map of an image, fitted into a square tile: ink comes first where it is dark. During an octave its strokes
    /// make way for those of the image half as large.
    pub fn of_image(image: &Texture) -> Self {
        let coarse = darkness(image);
        let at = |x: usize, y: usize| coarse.get(y % SIDE * SIDE + x % SIDE).copied().unwrap_or_default();
        let steps: Vec<_> = (0..STEPS)
            .map(|step| {
                let step = 2.0 * step as f32 / STEPS as f32;
                let (later, earlier) = ((step - 1.0).max(0.0), (1.0 - step).max(0.0));
                let priorities: Vec<f32> = (0..SIDE * SIDE)
                    .map(|i| {
                        let (x, y) = (i % SIDE, i / SIDE);
                        let fine = 0.5 * (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y + 1));
                        (at(x, y) - later).max(fine - earlier)
                    })
                    .collect();
                ranked(&priorities)
            })
            .collect();
        Self::new(&steps)
    }
}

/// So much of the surroundings' darkness is added, that even areas are inked from their rims inwards. Less than one step
/// of an image's own values.
const SURROUNDINGS: f32 = 0.003;
/// What is left is inked in no order.
const NOISE: f32 = 1e-5;

/// Darkness of the texels of a tile, about 0 to 1; hardly any two are equal.
fn darkness(image: &Texture) -> Vec<f32> {
    let columns = image.width.clamp(1, SIDE as u32) as usize;
    let rows = image.height.clamp(1, SIDE as u32) as usize;
    let own: Vec<f32> = image
        .averaged([SIDE as u32; 2])
        .iter()
        .map(|c| 1.0 - (c.w * c.truncate().dot(glam::vec3(0.2126, 0.7152, 0.0722)) + 1.0 - c.w))
        .collect();
    let mut tile: Vec<f32> =
        (0..SIDE * SIDE).map(|i| between(&own, [columns, rows], i % SIDE, i / SIDE)).collect();
    let mut surroundings = vec![0.0; SIDE * SIDE];
    let (mut smaller, mut side) = (tile.clone(), SIDE);
    while side > 8 {
        let half = side / 2;
        smaller = (0..half * half)
            .map(|i| {
                let first = i / half * 2 * side + i % half * 2;
                [0, 1, side, side + 1].iter().filter_map(|d| smaller.get(first + d)).sum::<f32>() * 0.25
            })
            .collect();
        side = half;
        for (i, sum) in surroundings.iter_mut().enumerate() {
            *sum += between(&smaller, [side, side], i % SIDE, i / SIDE) / 6.0;
        }
    }
    for (i, (texel, around)) in tile.iter_mut().zip(&surroundings).enumerate() {
        let noise = (i as u32).wrapping_mul(0x9e37_79b9).rotate_left(15).wrapping_mul(0x85eb_ca6b) >> 8;
        *texel += SURROUNDINGS * around + NOISE * noise as f32 / (1 << 24) as f32;
    }
    tile
}

/// A texel of the tile from an image of another size that repeats, between its texels.
fn between(texels: &[f32], [columns, rows]: [usize; 2], x: usize, y: usize) -> f32 {
    let split = |c: usize, count: usize| {
        let place = (c as f32 + 0.5) * count as f32 / SIDE as f32 - 0.5;
        let first = (place.floor() as i64).rem_euclid(count as i64) as usize;
        (first, (first + 1) % count, place - place.floor())
    };
    let ((left, right, u), (upper, lower, v)) = (split(x, columns), split(y, rows));
    let at = |column: usize, row: usize| texels.get(row * columns + column).copied().unwrap_or_default();
    let above = at(left, upper) + (at(right, upper) - at(left, upper)) * u;
    let below = at(left, lower) + (at(right, lower) - at(left, lower)) * u;
    above + (below - above) * v
}
