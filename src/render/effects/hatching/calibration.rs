//! How dark stripes have to be asked for so that they are as dark as they should be: measured on an even plane, with the same
//! arithmetic as `shaders/effects/hatching/stripes.wgsl`.

use rayon::prelude::*;

use super::strokes::StrokeUniform;

/// Places in the octave between two densities.
pub(super) const PLACES: usize = 10;
/// Shares of ink.
pub(super) const INKS: usize = 64;
/// Tones that are measured.
const TONES: usize = 48;
/// Points that are looked at for each tone: rows times places along them.
const ROWS: usize = 16 * 16;
const ALONG: usize = 8;

/// For each of [`PLACES`] and each of [`INKS`] the tone to ask for, 0 to 1.
pub(super) fn calibration(stroke: &StrokeUniform) -> Vec<f32> {
    (0..PLACES).into_par_iter().flat_map_iter(|place| tones_of(stroke, place)).collect()
}

/// The greatest share of ink that is reached everywhere.
pub(super) fn greatest_ink(stroke: &StrokeUniform) -> f32 {
    (0..PLACES).map(|place| mean_ink(stroke, 1.0, middle(place))).fold(1.0, f32::min)
}

fn middle(place: usize) -> f32 {
    (place as f32 + 0.5) / PLACES as f32
}

fn tones_of(stroke: &StrokeUniform, place: usize) -> Vec<f32> {
    let tone = |i: usize| i as f32 / (TONES - 1) as f32;
    let mut least = 0.0_f32;
    let measured: Vec<f32> = (0..TONES)
        .map(|i| {
            // More tone is never less ink.
            least = least.max(mean_ink(stroke, tone(i), middle(place)));
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

/// Share of ink of an even plane, at a tone and a place in the octave.
fn mean_ink(stroke: &StrokeUniform, tone: f32, place: f32) -> f32 {
    let mut sum = 0.0;
    for row in 0..ROWS {
        for along in 0..ALONG {
            let jitter = |n: u32| unit(hash(row as u32 * 977 + n, along as u32));
            let y = 16.0 * (row as f32 + jitter(1)) / ROWS as f32;
            let at = Along { place: 16.0 * (along as f32 + jitter(2)) / ALONG as f32, octave: jitter(3) };
            sum += ink(stroke, tone, place, y, at);
        }
    }
    sum / (ROWS * ALONG) as f32
}

/// Where a point lies along a stroke.
struct Along {
    /// In strokes.
    place: f32,
    /// In the octave of their lengths, 0 to 1.
    octave: f32,
}

/// Ink of one family at a point of a plane: `y` in rows of the finer level.
fn ink(stroke: &StrokeUniform, tone: f32, place: f32, y: f32, along: Along) -> f32 {
    let spacing = stroke.spacing * place.exp2();
    let row = y.round();
    let even = (row as i32) & 1 == 0;
    let away = (y - row) * spacing * 0.5;
    let code = (row as i32 & 15) as u32;
    let code = if code == 0 { 16 } else { code };
    let born = code.trailing_zeros();
    let id = hash(code >> born, 1_u32.wrapping_sub(born));
    let (mut tap, mut chance, mut variation) = (1.0_f32, unit(id), 0.0);
    if stroke.taper > 0.0 {
        let length = stroke.length * along.octave.exp2();
        let u = along.place + unit(mixed(id));
        let number = (u.floor() as i32 & 15) as u32;
        let share = u - u.floor();
        let end = share.min(1.0 - share) * length - stroke.gap;
        let middle = if along.octave > 0.35 {
            (share - 0.5).abs() * length - stroke.gap * smoothstep(0.35, 1.0, along.octave)
        } else {
            1e9
        };
        tap = (end.min(middle) / stroke.taper).clamp(0.0, 1.0);
        let half = u32::from(share > 0.5);
        let [whole, halves] = [number, 2 * number + half + 100].map(|n| unit(hash(id, n)));
        chance = whole + (halves - whole) * 0.35 * smoothstep(0.3, 1.0, along.octave);
        variation = unit(hash(hash(id, number), 23)) - 0.5;
    }
    let late = if even { 0.0 } else { (1.0 - place) * stroke.inserted };
    let threshold = stroke.spread * (stroke.chance * chance + (1.0 - tap) * stroke.pointed) + late;
    let beyond = ((tone - threshold) / (1.0 - threshold).max(1e-3)).clamp(0.0, 1.0);
    let share = stroke.thin + (stroke.thick - stroke.thin) * beyond;
    let pressed = tap.sqrt() * (1.0 - stroke.variation * variation) * smoothstep(0.0, SOFT, tone - threshold);
    let width = stroke.spacing * share * pressed;
    // No hair lines: a stroke ends, it does not fade.
    let width = if width < LEAST_WIDTH { 0.0 } else { width };
    (width.max(2.0 * LEAST_WIDTH) * 0.5 - away.abs() + 0.5).clamp(0.0, 1.0)
        * (width / (2.0 * LEAST_WIDTH)).min(1.0)
}

// As in `shaders/effects/hatching/stripes.wgsl`.
const SOFT: f32 = 0.04;
const LEAST_WIDTH: f32 = 0.35;

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
    use crate::style::Hatching;

    #[test]
    fn asked_tones_are_drawn() {
        let stroke = StrokeUniform::new(&Hatching::default().stroke, 1.0);
        let table = calibration(&stroke);
        let greatest = greatest_ink(&stroke);
        assert!(greatest > 0.5, "{greatest}");
        for (place, tones) in table.chunks(INKS).enumerate() {
            assert!(tones.is_sorted(), "place {place}");
            for (i, tone) in tones.iter().enumerate() {
                let asked = i as f32 / (INKS - 1) as f32;
                if asked < greatest {
                    let drawn = mean_ink(&stroke, *tone, middle(place));
                    assert!((drawn - asked).abs() < 0.02, "place {place}: {drawn} for {asked}");
                }
            }
        }
    }
}
