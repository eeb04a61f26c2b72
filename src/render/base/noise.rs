//! Gradient noise (Perlin, "An Image Synthesizer", 1985): the twin of `shaders/common/noise.wgsl`, and tiles of it that repeat.

use glam::{IVec3, Vec2, Vec3};
use rayon::prelude::*;

// As in `shaders/common/noise.wgsl`.
const NOISE_SCALE: f32 = 5.08;
const MEAN_ABSOLUTE: f32 = 0.804;
const DEVIATION_ABSOLUTE: f32 = 0.595;

/// A number of which every bit depends on every bit of another one.
pub fn mixed_bits(mut h: u32) -> u32 {
    h ^= h >> 16;
    h = h.wrapping_mul(0x7feb_352d);
    h ^= h >> 15;
    h = h.wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}

fn corner_hash(p: IVec3, seed: u32) -> u32 {
    let [x, y, z] = p.to_array().map(|n| n as u32);
    mixed_bits(mixed_bits(mixed_bits(x ^ seed).wrapping_add(y)).wrapping_add(z))
}

/// Two independent noises at a place, each of mean 0 and mean square 1. `corner`: where a corner of the lattice takes its
/// gradients from, itself unless the noise is to repeat.
fn noise(p: Vec3, seed: u32, corner: impl Fn(IVec3) -> IVec3) -> Vec2 {
    let cell = p.floor();
    let f = p - cell;
    let w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let mut sum = Vec2::ZERO;
    for i in 0..8_i32 {
        let offset = IVec3::new(i & 1, (i >> 1) & 1, i >> 2);
        let h = corner_hash(corner(cell.as_ivec3() + offset), seed);
        let gradient = |first: u32| {
            Vec3::from_array([0, 5, 10].map(|shift| ((h >> (first + shift)) & 31) as f32 / 15.5 - 1.0))
        };
        let offset = offset.as_vec3();
        let weights = Vec3::ONE - offset + w * (2.0 * offset - Vec3::ONE);
        let away = f - offset;
        sum += weights.element_product() * Vec2::new(gradient(0).dot(away), gradient(15).dot(away));
    }
    sum * NOISE_SCALE
}

/// Two independent noises at a place; they repeat nowhere.
pub fn noise3x2(p: Vec3, seed: u32) -> Vec2 {
    noise(p, seed, |corner| corner)
}

/// The same with kinks where `turbulent`: absolute values, again of mean 0 and mean square 1.
fn shaped(n: Vec2, turbulent: bool) -> Vec2 {
    if turbulent { (n.abs() - MEAN_ABSOLUTE) / DEVIATION_ABSOLUTE } else { n }
}

/// Where the lattice of an octave lies, in cells: at corners of it noise is 0, which are not to meet in the middle of every object.
fn lattice_shift(seed: u32) -> Vec3 {
    let h = mixed_bits(seed);
    Vec3::from_array([0, 10, 20].map(|shift| ((h >> shift) & 1023) as f32)) / 1024.0
}

/// Logarithm to base 2 of how much larger each octave is than the one before: a factor of 8. Waves are replaced all the time as the
/// camera comes nearer, and change the less the longer each of them stays.
const OCTAVE: f32 = 3.0;

/// Octaves of [`waves`]: how many, how fast they come and go, how much larger ones count for, how much larger than asked for they are
/// in the middle (a logarithm to base 2), and what tells their seed apart.
struct Octaves {
    count: i32,
    period: f32,
    tilt: f32,
    larger: f32,
    seed: u32,
}

fn sum_of(octaves: &Octaves, at: Vec3, wave: f32, seed: u32, turbulent: bool) -> Vec2 {
    let s = (wave.max(1e-30).log2() + octaves.larger) / OCTAVE;
    let least = (at.abs().max_element().max(1e-30).log2() - 20.0) / OCTAVE;
    let first = (s - 0.5 * octaves.count as f32).ceil();
    let (mut sum, mut power) = (Vec2::ZERO, 0.0);
    for i in 0..octaves.count {
        let k = first + i as f32;
        let x = k - s;
        let weight = (octaves.period * x).cos() * (octaves.tilt * x).exp2();
        let level = k.max(least);
        let seed = seed.wrapping_add((k as i32).wrapping_mul(17) as u32).wrapping_add(octaves.seed);
        let place = at * (-OCTAVE * level).exp2() + lattice_shift(seed);
        sum += weight * shaped(noise3x2(place, seed), turbulent);
        power += weight * weight;
    }
    sum / power.max(1e-12).sqrt()
}

/// Waves that are `wave` long wherever it is measured, from octaves a factor of 8 apart. `at` and `wave`: in one unit.
pub fn waves(at: Vec3, wave: f32, seed: u32, turbulent: bool) -> Vec2 {
    let octaves = Octaves { count: 4, period: std::f32::consts::FRAC_PI_4, tilt: 0.3, larger: 0.5, seed: 0 };
    sum_of(&octaves, at, wave, seed, turbulent)
}

/// The same with two octaves only: for details.
pub fn fine_waves(at: Vec3, wave: f32, seed: u32, turbulent: bool) -> Vec2 {
    let octaves =
        Octaves { count: 2, period: std::f32::consts::FRAC_PI_2, tilt: 0.0, larger: 0.0, seed: 8191 };
    sum_of(&octaves, at, wave, seed, turbulent)
}

/// Texels per side of a tile.
pub const SIDE: usize = 512;

/// Cells of the largest octave of [`turbulence_tile`] per side.
pub const TILE_CELLS: u32 = 4;

/// Noise on a tile that repeats, `cells` per side and direction.
fn on_tile(at: Vec2, cells: [i32; 2], seed: u32) -> f32 {
    let [columns, rows] = cells;
    let p = at * Vec2::new(columns as f32, rows as f32);
    let repeated = |c: IVec3| IVec3::new(c.x.rem_euclid(columns), c.y.rem_euclid(rows), c.z);
    // Between two planes of the lattice, where noise is nowhere always 0.
    noise(p.extend(0.5), seed, repeated).x
}

/// All texels of a tile, row by row; `texel` is given places from 0 to 1.
fn tile<T: Send>(texel: impl Fn(Vec2) -> T + Sync) -> Vec<T> {
    let place = |i: usize| (Vec2::new((i % SIDE) as f32, (i / SIDE) as f32) + 0.5) / SIDE as f32;
    (0..SIDE * SIDE).into_par_iter().map(|i| texel(place(i))).collect()
}

/// A tile of (turbulence(s, t), turbulence(1 − s, 1 − t)) (sketchy drawings paper, section 3.2): sums of octaves, each twice as
/// fine and half as strong as the one before, of mean 0 and mean square 1.
pub fn turbulence_tile(octaves: u32, seed: u32, turbulent: bool) -> Vec<[f32; 2]> {
    let octaves = octaves.clamp(1, 8);
    let mut values: Vec<f32> = tile(|at| {
        let octave = |i: u32| {
            let n = on_tile(at, [(TILE_CELLS << i) as i32; 2], seed.wrapping_add(i));
            shaped(Vec2::new(n, 0.0), turbulent).x * 0.5_f32.powi(i as i32)
        };
        (0..octaves).map(octave).sum()
    });
    let count = values.len() as f64;
    let mean = values.iter().map(|v| f64::from(*v)).sum::<f64>() / count;
    let square = values.iter().map(|v| (f64::from(*v) - mean).powi(2)).sum::<f64>() / count;
    let scale = square.max(1e-12).sqrt().recip();
    for value in &mut values {
        *value = ((f64::from(*value) - mean) * scale) as f32;
    }
    values.iter().zip(values.iter().rev()).map(|(a, b)| [*a, *b]).collect()
}

/// Each value by its rank among all, 0 to 255: every level has the same share.
pub fn ranked(values: &[f32]) -> Vec<u8> {
    let mut order: Vec<u32> = (0..values.len() as u32).collect();
    order.par_sort_unstable_by(|a, b| values[*a as usize].total_cmp(&values[*b as usize]).then(a.cmp(b)));
    let mut ranks = vec![0; values.len()];
    for (rank, index) in order.into_iter().enumerate() {
        ranks[index as usize] = (rank * 256 / values.len()) as u8;
    }
    ranks
}

/// Cells per side of the tooth of [`paper_tile`], and of its strokes in both directions, and of its slow waves.
pub const TOOTH_CELLS: i32 = 128;
/// See [`TOOTH_CELLS`].
pub const STROKE_CELLS: i32 = 64;
/// See [`TOOTH_CELLS`].
pub const SLOW_CELLS: i32 = 4;

/// A tile of paper: its tooth, gaps between the strokes of a hand along x, and two slow noises; the first two by rank, the others
/// about 128 with a deviation of 51.
pub fn paper_tile() -> Vec<[u8; 4]> {
    let tooth: Vec<f32> = tile(|at| {
        let octave = |cells: i32, seed| on_tile(at, [cells; 2], seed);
        let coarse = (f64::from(TOOTH_CELLS) / 2.2) as i32;
        let fine = (f64::from(TOOTH_CELLS) / 0.55) as i32;
        0.5 * octave(coarse, 1) + octave(TOOTH_CELLS, 2) + 0.6 * octave(fine, 3)
    });
    let strokes: Vec<f32> = tile(|at| {
        // Sixteen times as long as wide, with finer ones among them; see `stroke_share` in `shaders/effects/sketch.wgsl`.
        on_tile(at, [STROKE_CELLS; 2], 4)
            + 0.5 * on_tile(at, [STROKE_CELLS * 16 / 9, STROKE_CELLS * 20 / 9], 5)
    });
    let slow = |seed| -> Vec<u8> { tile(|at| (128.0 + 51.0 * on_tile(at, [SLOW_CELLS; 2], seed)) as u8) };
    let (tooth, strokes, across, along) = (ranked(&tooth), ranked(&strokes), slow(6), slow(7));
    (0..SIDE * SIDE).map(|i| [tooth[i], strokes[i], across[i], along[i]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> impl Iterator<Item = Vec3> {
        let part = |n: u32| f64::from(mixed_bits(n)) / f64::from(u32::MAX) * 1000.0 - 500.0;
        (0..60_000).map(move |i| glam::DVec3::new(part(3 * i), part(3 * i + 1), part(3 * i + 2)).as_vec3())
    }

    /// Mean, mean square and mean product of both values.
    fn moments(value: impl Fn(Vec3) -> Vec2) -> [f64; 3] {
        let values: Vec<Vec2> = places().map(value).collect();
        let mean = |part: fn(&Vec2) -> f32| {
            values.iter().map(|v| f64::from(part(v))).sum::<f64>() / values.len() as f64
        };
        [mean(|v| 0.5 * (v.x + v.y)), mean(|v| 0.5 * v.length_squared()), mean(|v| v.x * v.y)]
    }

    #[test]
    fn noise_has_mean_0_and_mean_square_1_with_and_without_kinks_at_every_distance() {
        for turbulent in [false, true] {
            for wave in [1.0, 3.0, 11.0, 40.0] {
                let all: [(&str, [f64; 3]); 3] = [
                    ("one", moments(|p| shaped(noise3x2(p / wave, 7), turbulent))),
                    ("waves", moments(|p| waves(p, wave, 7, turbulent))),
                    ("fine", moments(|p| fine_waves(p, wave, 7, turbulent))),
                ];
                for (name, [mean, square, product]) in all {
                    assert!(mean.abs() < 0.04, "{name} {wave}: mean {mean}");
                    assert!((square - 1.0).abs() < 0.06, "{name} {wave}: mean square {square}");
                    assert!(product.abs() < 0.06, "{name} {wave}: product {product}");
                }
            }
        }
    }

    #[test]
    fn small_objects_wander_as_far_as_large_ones() {
        // About the middle of an object that is small beside its waves.
        let square = |made: fn(Vec3, f32, u32, bool) -> Vec2, at: Vec3| {
            let all =
                (0..20_000).map(|seed| f64::from(made(at, 64.0, mixed_bits(seed), false).length_squared()));
            all.sum::<f64>() / 40_000.0
        };
        for at in [Vec3::ZERO, Vec3::splat(0.3), Vec3::new(64.0, 0.0, -16.0)] {
            for made in [waves, fine_waves] {
                let square = square(made, at);
                assert!((square - 1.0).abs() < 0.06, "{at}: mean square {square}");
            }
        }
    }

    #[test]
    fn octaves_come_and_go_unseen() {
        // Where the logarithm of the wave is whole, one octave is replaced by another.
        for base in
            [0.015625_f32, 0.125, 1.0, 8.0, 64.0].iter().flat_map(|wave| [*wave, wave / 2.0_f32.sqrt()])
        {
            for p in places().take(50) {
                for made in [waves, fine_waves] {
                    let [before, after] = [0.99999, 1.00001].map(|share| made(p, base * share, 3, false));
                    assert!((before - after).length() < 2e-3, "{base} {p}: {before} {after}");
                }
            }
        }
    }

    #[test]
    fn tiles_repeat_and_have_every_tone() {
        let tile = turbulence_tile(4, 1, true);
        let mean: f64 = tile.iter().map(|v| f64::from(v[0])).sum::<f64>() / tile.len() as f64;
        let square: f64 = tile.iter().map(|v| f64::from(v[0]).powi(2)).sum::<f64>() / tile.len() as f64;
        assert!(mean.abs() < 1e-3 && (square - 1.0).abs() < 1e-3, "{mean} {square}");
        assert_eq!(tile[0][0], tile[SIDE * SIDE - 1][1]);
        // Across the seam it goes on as smoothly as anywhere.
        let step = |a: usize, b: usize| (tile[a][0] - tile[b][0]).abs();
        let inside = (1..SIDE).map(|x| step(x, x - 1)).fold(0.0, f32::max);
        assert!(step(0, SIDE - 1) <= inside, "{} {inside}", step(0, SIDE - 1));
        let paper = paper_tile();
        for channel in 0..2 {
            let mut levels = [0_usize; 256];
            for texel in &paper {
                levels[usize::from(texel[channel])] += 1;
            }
            assert!(levels.iter().all(|n| *n == SIDE * SIDE / 256));
        }
    }
}
