//! How dark stripes have to be asked for so that they are as dark as they should be: measured on an even plane, with the same
//! arithmetic as `shaders/effects/hatching/stripes.wgsl`.

use glam::Vec2;
use rayon::prelude::*;

use super::strokes::GpuStroke;

/// Places in the octave between two densities, and in that between two lengths of strokes. What comes after the last is the first.
pub(super) const PLACES: usize = 16;
pub(super) const LENGTHS: usize = 10;
/// Shares of ink.
pub(super) const INKS: usize = 64;
/// Tones that are measured: more of lines that all get wider at once.
const TONES: [usize; 2] = [24, 64];
/// Points that are looked at for each tone: rows times places along them.
const ROWS: usize = PERIOD * 4;
/// After so many lines of the finer level, and half as many strokes, numbers begin again.
const PERIOD: usize = 32;
const ALONG: usize = 8;

/// For each of [`PLACES`], each of [`LENGTHS`] and each of [`INKS`] the tone to ask for, 0 to 1.
pub(super) fn calibration(stroke: &GpuStroke) -> Vec<f32> {
    let tables: Vec<Vec<f32>> =
        octaves(stroke).into_par_iter().map(|octave| tones_of(stroke, octave)).collect();
    let is_pointed = stroke.taper > 0.0;
    // Strokes without ends have no lengths.
    let times = if is_pointed { 1 } else { LENGTHS };
    tables.iter().flat_map(|table| std::iter::repeat_n(table, times)).flatten().copied().collect()
}

/// Where in both octaves points lie.
#[derive(Clone, Copy)]
struct Octave {
    /// Between two densities, 0 to 1.
    place: f32,
    /// Between two lengths.
    length: f32,
}

fn octaves(stroke: &GpuStroke) -> Vec<Octave> {
    let middle = |i: usize, of: usize| (i as f32 + 0.5) / of as f32;
    let lengths = if stroke.taper > 0.0 { LENGTHS } else { 1 };
    let at = |place| {
        (0..lengths).map(move |l| Octave { place: middle(place, PLACES), length: middle(l, lengths) })
    };
    (0..PLACES).flat_map(at).collect()
}

/// The greatest share of ink that is reached everywhere.
pub(super) fn greatest_ink(stroke: &GpuStroke) -> f32 {
    octaves(stroke).into_iter().map(|octave| mean_ink(stroke, 1.0, octave)).fold(1.0, f32::min)
}

fn tones_of(stroke: &GpuStroke, octave: Octave) -> Vec<f32> {
    let count = TONES[usize::from(stroke.taper <= 0.0)];
    let tone = |i: usize| i as f32 / (count - 1) as f32;
    let mut least = 0.0_f32;
    let measured: Vec<f32> = (0..count)
        .map(|i| {
            // More tone is never less ink.
            least = least.max(mean_ink(stroke, tone(i), octave));
            least
        })
        .collect();
    let inverted = |asked: f32| {
        let above = measured.partition_point(|ink| *ink < asked);
        if above == 0 {
            return 0.0;
        }
        let Some(high) = measured.get(above) else { return 1.0 };
        let low = measured[above - 1];
        tone(above - 1) + (asked - low) / (high - low).max(1e-6) * (tone(above) - tone(above - 1))
    };
    (0..INKS).map(|i| inverted(i as f32 / (INKS - 1) as f32)).collect()
}

/// Share of ink of an even plane, at a tone and a place in the octaves.
fn mean_ink(stroke: &GpuStroke, tone: f32, octave: Octave) -> f32 {
    let mut sum = 0.0;
    for row in 0..ROWS {
        for along in 0..ALONG {
            let jitter = |n: u32| unit(hash(row as u32 * 977 + n, along as u32));
            let y = PERIOD as f32 * (row as f32 + jitter(1)) / ROWS as f32;
            let x = 16.0 * (along as f32 + jitter(2)) / ALONG as f32;
            sum += ink(stroke, tone, octave, Vec2::new(x, y));
        }
    }
    sum / (ROWS * ALONG) as f32
}

/// Ink of one family at a point of a plane: x in strokes, y in rows of the finer level.
fn ink(stroke: &GpuStroke, tone: f32, Octave { place, length: octave }: Octave, at: Vec2) -> f32 {
    let Vec2 { x, y } = at;
    let spacing = stroke.spacing * place.exp2();
    let row = y.round();
    let even = (row as i32) & 1 == 0;
    let away = (y - row) * spacing * 0.5;
    let period = PERIOD as u32;
    let bits = row as u32 % period;
    let code = if bits == 0 { period } else { bits.min(period - bits) };
    let born = code.trailing_zeros();
    let id = hash(code >> born, 1_u32.wrapping_sub(born));
    let (mut tapered, mut chance, mut variation) = (1.0_f32, unit(id), 0.0);
    if stroke.taper > 0.0 {
        let length = stroke.length * octave.exp2();
        let u = x + unit(mixed(id));
        let number = (u.floor() as i32 & 15) as u32;
        let share = u - u.floor();
        let end = share.min(1.0 - share) * length - stroke.gap;
        let apart = smoothstep(0.35, 1.0, octave);
        let middle = (share - 0.5).abs() * length - stroke.gap;
        let [end, middle] = [end, middle].map(|left| (left / stroke.taper).clamp(0.0, 1.0));
        tapered = end.min(1.0 + (middle - 1.0) * apart);
        let half = u32::from(share > 0.5);
        let [whole, halves] = [number, (2 * number + half) & 15].map(|n| hash(id, n));
        let mix = |from: f32, to: f32| from + (to - from) * apart;
        chance = mix(unit(whole), unit(halves));
        variation = mix(unit(mixed(whole)), unit(mixed(halves))) - 0.5;
    }
    let late = if even { 0.0 } else { (1.0 - place) * stroke.late_insertion };
    let threshold =
        stroke.tone_by_count * (stroke.randomness * chance + (1.0 - tapered) * stroke.pointedness) + late;
    let beyond = ((tone - threshold) / (1.0 - threshold).max(1e-3)).clamp(0.0, 1.0);
    let share = stroke.min_width + (stroke.max_width - stroke.min_width) * beyond;
    let pressed =
        tapered.sqrt() * (1.0 - stroke.variation * variation) * smoothstep(0.0, SOFT, tone - threshold);
    let width = stroke.spacing * share * pressed;
    // No hair lines: a stroke ends, it does not fade.
    let width = if width < MIN_WIDTH { 0.0 } else { width };
    // Nor hair lines of paper.
    let next = 0.5 * spacing;
    let width = width + smoothstep(next - 2.0 * MIN_WIDTH, next, width);
    (width.max(2.0 * MIN_WIDTH) * 0.5 - away.abs() + 0.5).clamp(0.0, 1.0)
        * (width / (2.0 * MIN_WIDTH)).min(1.0)
}

// As in `shaders/effects/hatching/stripes.wgsl`.
const SOFT: f32 = 0.04;
const MIN_WIDTH: f32 = 0.35;

fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn mixed(v: u32) -> u32 {
    let state = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

fn hash(a: u32, b: u32) -> u32 {
    mixed(a.wrapping_add(mixed(b)))
}

fn unit(hash: u32) -> f32 {
    (hash >> 8) as f32 / 16_777_216.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::{Hatching, Technique, preset};

    /// The tone to ask for, as `tone_for` in the shader finds it.
    fn tone_for(table: &[f32], octave: Octave, ink: f32) -> f32 {
        let row = octave.place * PLACES as f32 - 0.5 + PLACES as f32;
        let column = octave.length * LENGTHS as f32 - 0.5 + LENGTHS as f32;
        let at = ink * (INKS - 1) as f32;
        let first = (at as usize).min(INKS - 2);
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let entry = |r: usize, c: usize| {
            let k = (r % PLACES * LENGTHS + c % LENGTHS) * INKS + first;
            mix(table[k], table[k + 1], at - first as f32)
        };
        let (r, c) = (row as usize, column as usize);
        let by_row = |c| mix(entry(r, c), entry(r + 1, c), row.fract());
        mix(by_row(c), by_row(c + 1), column.fract())
    }

    #[test]
    fn asked_tones_are_drawn_between_the_measured_ones_too() {
        let presets = preset::all().into_iter().filter(|p| p.style.technique == Technique::Hatching);
        let all =
            presets.map(|p| (p.name, p.style.hatching)).chain([("default".into(), Hatching::default())]);
        for (name, hatching) in all {
            let stroke = GpuStroke::new(&hatching.stroke, 1.0);
            let (table, greatest) = (calibration(&stroke), greatest_ink(&stroke));
            assert!(greatest > 0.3, "{name}: {greatest}");
            let mut worst = 0.0_f32;
            for i in 0..60 {
                let at = |k: f32| (i as f32 * k).fract();
                let octave = Octave { place: at(0.618), length: at(0.755) };
                let asked = greatest * at(0.57);
                let drawn = mean_ink(&stroke, tone_for(&table, octave, asked), octave);
                worst = worst.max((drawn - asked).abs());
            }
            assert!(worst < 0.03, "{name}: {worst}");
        }
    }
}
