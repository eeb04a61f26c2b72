//! How dark stripes have to be asked for so that they are as dark as they should be: reckoned for an even plane, with the same
//! arithmetic as `shaders/effects/hatching/strokes.wgsl`.

use std::array;

use rayon::prelude::*;

use super::ranks::{LineId, rank_of_width};
use super::smoothstep::smoothstep;
use super::strokes::GpuStroke;

/// Places in the octave between two densities, and in that between two lengths of strokes. What comes after the last is the first.
pub(super) const PLACES: usize = 32;
pub(super) const LENGTHS: usize = 10;
/// Shares of ink.
pub(super) const INKS: usize = 64;
/// Tones that are reckoned: more of lines that go on and on, which cost little.
const TONES: [usize; 2] = [40, 128];
/// Lines of the finer level and strokes of each that are reckoned: after that they are much the same.
const PERIOD: usize = 32;
const STROKES: usize = 8;
/// With the first line of the next period.
const LINES: usize = PERIOD + 1;
/// Places along each stroke that are reckoned.
const ALONG: usize = 2;

/// What strokes of one kind need to be as dark as asked.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Calibration {
    /// For each of [`PLACES`], each of [`LENGTHS`] and each of [`INKS`] the tone to ask for, 0 to 1.
    pub(super) tones: Vec<f32>,
    /// The greatest share of ink that is reached everywhere.
    pub(super) greatest: f32,
}

impl Calibration {
    pub(super) fn of(stroke: &GpuStroke) -> Self {
        // Strokes without ends have no lengths.
        let lengths = if stroke.taper > 0.0 { LENGTHS } else { 1 };
        let strokes: Vec<Vec<Lines>> =
            (0..lengths).into_par_iter().map(|i| places(stroke, middle(i, lengths), ALONG)).collect();
        let inks: Vec<Vec<f32>> = (0..PLACES * lengths)
            .into_par_iter()
            .map(|i| inks_of(stroke, middle(i / lengths, PLACES), &strokes[i % lengths]))
            .collect();
        let times = LENGTHS / lengths;
        let by_length = inks.iter().flat_map(|inks| std::iter::repeat_n(inverse(inks), times));
        let greatest = inks.iter().filter_map(|inks| inks.last()).fold(1.0, |least, ink| ink.min(least));
        Self { tones: by_length.flatten().collect(), greatest }
    }
}

fn middle(i: usize, of: usize) -> f32 {
    (i as f32 + 0.5) / of as f32
}

/// Shares of ink by tone, evenly from 0 to 1.
fn inks_of(stroke: &GpuStroke, place: f32, strokes: &[Lines]) -> Vec<f32> {
    let count = TONES[usize::from(stroke.taper <= 0.0)];
    let mut least = 0.0_f32;
    (0..count)
        .map(|i| {
            // More tone is never less ink.
            least = least.max(mean_ink(stroke, i as f32 / (count - 1) as f32, place, strokes));
            least
        })
        .collect()
}

/// Tones by share of ink.
fn inverse(inks: &[f32]) -> Vec<f32> {
    let tone = |i: usize| i as f32 / (inks.len() - 1) as f32;
    let inverted = |asked: f32| {
        let above = inks.partition_point(|ink| *ink < asked);
        if above == 0 {
            return 0.0;
        }
        let Some(high) = inks.get(above) else { return 1.0 };
        let low = inks[above - 1];
        tone(above - 1) + (asked - low) / (high - low).max(1e-6) * (tone(above) - tone(above - 1))
    };
    (0..INKS).map(|i| inverted(i as f32 / (INKS - 1) as f32)).collect()
}

/// What all lines of a period are like at a place along them, whatever the tone.
struct Lines {
    own: Strokes,
    /// The strokes whose ends pass those.
    passing: Option<Strokes>,
}

/// One stroke of each line of a period at a place along them.
struct Strokes {
    /// The tone from which on a line is drawn, if it is not inserted and no end is near.
    onsets: [f32; LINES],
    /// 0 where a stroke ends.
    tapered: [f32; LINES],
    /// How far its end widens where it is dark, 0 to 1.
    closes: [f32; LINES],
    /// Share of its width anywhere.
    varied: [f32; LINES],
}

impl Strokes {
    fn of(stroke: &GpuStroke, pieces: &[Piece; LINES]) -> Self {
        Self {
            onsets: pieces.map(|p| stroke.tone_by_count * stroke.randomness * p.chance),
            tapered: pieces.map(|p| p.tapered),
            closes: pieces.map(|p| p.closes),
            varied: pieces.map(|p| 1.0 - stroke.variation * p.variation),
        }
    }

    /// `late`: how much later the line comes; `apart`: to the next line, px.
    fn mark(&self, stroke: &GpuStroke, row: usize, tone: f32, late: f32, apart: f32) -> Mark {
        let onset = self.onsets[row] + late;
        let closed = smoothstep(ENDS_CLOSE, ENDS_CLOSED, (tone - onset) / (1.0 - onset).max(1e-3));
        let open = 1.0 - self.tapered[row];
        let tapered = 1.0 - open * (1.0 - closed * self.closes[row]);
        let threshold = onset + stroke.tone_by_count * (1.0 - tapered) * stroke.pointedness;
        let width = width(stroke, tone - threshold, 1.0 - threshold, tapered * self.varied[row], apart);
        Mark { width, aside: PASSING * stroke.spacing * open * (1.0 - closed) }
    }
}

/// So many places along each stroke. `octave`: place in that of lengths.
fn places(stroke: &GpuStroke, octave: f32, along: usize) -> Vec<Lines> {
    let lines = |i: usize| {
        // Another share of each stroke, so that all of them are seen evenly.
        let (number, share) = (i % STROKES, i / STROKES);
        let shift = (number as u32).reverse_bits() >> (32 - STROKES.trailing_zeros());
        let x = number as f32 + (share as f32 + middle(shift as usize, STROKES)) / along as f32;
        let pieces: [Pieces; LINES] = array::from_fn(|row| pieces_at(stroke, octave, row as u32, x));
        Lines {
            own: Strokes::of(stroke, &pieces.map(|p| p.own)),
            passing: (stroke.gap < 0.0).then(|| Strokes::of(stroke, &pieces.map(|p| p.passing))),
        }
    };
    let count = if stroke.taper > 0.0 { STROKES * along } else { 1 };
    (0..count).map(lines).collect()
}

/// A stroke of a line at a place.
#[derive(Clone, Copy)]
struct Piece {
    /// 0 where it ends.
    tapered: f32,
    closes: f32,
    chance: f32,
    variation: f32,
}

/// The stroke of a line at a place, and the one whose end passes it, which has no width where none does.
#[derive(Clone, Copy)]
struct Pieces {
    own: Piece,
    passing: Piece,
}

/// `x`: along the line, in strokes.
fn pieces_at(stroke: &GpuStroke, octave: f32, row: u32, x: f32) -> Pieces {
    let id = LineId::of(row, PERIOD as u32, 1);
    let rank = id.rank();
    let seed = hash(id.index, id.level as u32);
    let chance = |jitter: f32| (rank as f32 + jitter) / 16.0;
    if stroke.taper <= 0.0 {
        let own = Piece { tapered: 1.0, closes: 1.0, chance: chance(unit(seed)), variation: 0.0 };
        return Pieces { own, passing: Piece { tapered: 0.0, closes: 0.0, ..own } };
    }
    let length = stroke.length * octave.exp2();
    let apart = smoothstep(0.35, 1.0, octave);
    let mix = |from: f32, to: f32| from + (to - from) * apart;
    let u = x + id.offset(0);
    let own = (u.floor() as i32).rem_euclid(16) as u32;
    let share = u - u.floor();
    let second = u32::from(share > 0.5);
    let end = share.min(1.0 - share) * length;
    let middle = (share - 0.5).abs() * length;
    let taper = |left: f32| ((left - stroke.gap) / stroke.taper).clamp(0.0, 1.0);
    let piece = |number: u32, half: u32, tapered: f32, closes: f32| {
        let numbers = [number, (2 * number + half) % 16];
        let [whole, halves] = numbers.map(|n| (unit(seed) + STROKE_JITTER * n as f32).fract());
        let [rank, half_rank] = numbers.map(|n| rank_of_width(rank, n) as f32);
        let variation = mix(rank + whole, half_rank + halves) / 16.0 - 0.5;
        Piece { tapered, closes, chance: chance(mix(whole, halves)), variation }
    };
    let in_middle = middle < end;
    let (nearer, share, other) =
        if in_middle { (middle, apart, own) } else { (end, 1.0, (own + 15 + 2 * second) % 16) };
    let beyond = taper(-nearer) * share;
    let closes = smoothstep(0.0, (-stroke.gap / stroke.taper).clamp(1e-3, 1.0), beyond);
    Pieces {
        own: piece(own, second, taper(end).min(mix(1.0, taper(middle))), 1.0),
        passing: piece(other, 1 - second, beyond, closes),
    }
}

/// Share of ink of an even plane, at a tone and a place in the octave of densities. Without branches, so that several lines are
/// reckoned at once.
fn mean_ink(stroke: &GpuStroke, tone: f32, place: f32, strokes: &[Lines]) -> f32 {
    let rank = |row: usize| LineId::of(row as u32, PERIOD as u32, 1).rank();
    let late: [f32; LINES] = array::from_fn(|row| lateness(stroke, place, rank(row)));
    let spacing = 0.5 * stroke.spacing * place.exp2();
    let apart = late.map(|late| spacing * (2.0 - smoothstep(0.0, INSERTED, tone - late)));
    let mut inks = [0.0; LINES - 1];
    for Lines { own, passing } in strokes {
        let late = |row: usize| if row % 2 == 1 { late[row] } else { 0.0 };
        let mark = |strokes: &Strokes, row: usize| strokes.mark(stroke, row, tone, late(row), apart[row]);
        let widths: [f32; LINES] = match passing {
            None => array::from_fn(|row| mark(own, row).width),
            Some(passing) => array::from_fn(|row| mark(own, row).width_with(mark(passing, row))),
        };
        for (ink, (one, other)) in inks.iter_mut().zip(widths.iter().zip(&widths[1..])) {
            *ink += ink_between(*one, *other, spacing);
        }
    }
    inks.iter().sum::<f32>() / (spacing * (inks.len() * strokes.len()) as f32)
}

/// What a stroke of a line leaves at a place, px.
#[derive(Clone, Copy)]
struct Mark {
    width: f32,
    /// From the middle of the line.
    aside: f32,
}

impl Mark {
    /// Width of both where the stroke passes another.
    fn width_with(self, other: Self) -> f32 {
        let apart = self.aside + other.aside;
        let overlap = 0.5 * (self.width + other.width) - apart;
        self.width + other.width - overlap.min(self.width).min(other.width).max(0.0)
    }
}

/// Width of a line, px; `beyond`: by how much the tone is above the line's threshold, and `most`: by how much it can be; `apart`: to
/// the next line, px.
fn width(stroke: &GpuStroke, beyond: f32, most: f32, pressed: f32, apart: f32) -> f32 {
    let share = (beyond / most.max(1e-3)).clamp(0.0, 1.0);
    let share = stroke.min_width + (stroke.max_width - stroke.min_width) * share;
    let width = stroke.spacing * share * pressed * smoothstep(0.0, SOFT, beyond);
    // No hair lines: a stroke ends, it does not fade.
    let width = if width < stroke.end_width { 0.0 } else { width };
    // Nor hair lines of paper.
    width + smoothstep(apart - FULL_WIDTH, apart, width)
}

fn lateness(stroke: &GpuStroke, octave: f32, rank: u32) -> f32 {
    let rest = (1.0 - octave).powf((stroke.insertion_spread * (rank as f32 / 7.5 - 1.0)).exp2());
    rest.powi(8) + (rest - rest.powi(8)) * stroke.late_insertion
}

/// Ink from the middle of one line to that of another, px; what both cover counts once.
fn ink_between(one: f32, other: f32, apart: f32) -> f32 {
    // Without a line there is no strength.
    let half = |width: f32| if width > 0.0 { 0.5 * width.max(FULL_WIDTH) } else { -2.0 * apart };
    let strength = |width: f32| (width / (FULL_WIDTH)).min(1.0);
    let border = (0.5 * (half(one) + apart - half(other))).clamp(0.0, apart);
    strength(one) * covered(half(one), border) + strength(other) * covered(half(other), apart - border)
}

/// From the middle of a line to a distance from it (px): how much of that it covers, with an edge of one pixel.
fn covered(half: f32, distance: f32) -> f32 {
    let inner = half - 0.5;
    let beyond = (distance - inner).clamp(0.0, 1.0);
    distance.min(inner) + beyond - 0.5 * beyond * beyond
}

// As in `shaders/effects/hatching/strokes.wgsl`.
const SOFT: f32 = 0.04;
// A stroke that is narrower is drawn so wide, px, and paler.
const FULL_WIDTH: f32 = 0.7;
const PASSING: f32 = 0.25;
const STROKE_JITTER: f32 = 7.0 / 16.0;
const INSERTED: f32 = 0.2;
// The share of its greatest width from which on a stroke's ends close, and that at which it has none.
const ENDS_CLOSE: f32 = 0.3;
const ENDS_CLOSED: f32 = 0.8;

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

    /// The tone to ask for, as `tone_for` in the shader finds it; `octaves`: places in those of densities and of lengths.
    fn tone_for(table: &[f32], octaves: [f32; 2], ink: f32) -> f32 {
        let row = octaves[0] * PLACES as f32 - 0.5 + PLACES as f32;
        let column = octaves[1] * LENGTHS as f32 - 0.5 + LENGTHS as f32;
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
    fn asked_tones_are_drawn_between_the_reckoned_ones_too() {
        let presets = preset::all().into_iter().filter(|p| p.style.technique == Technique::Hatching);
        let all =
            presets.map(|p| (p.name, p.style.hatching)).chain([("default".into(), Hatching::default())]);
        for ((name, hatching), is_single) in
            all.flat_map(|preset| [false, true].map(|is_single| (preset.clone(), is_single)))
        {
            let stroke = GpuStroke::new(&hatching.stroke, 1.0, is_single);
            let Calibration { tones: table, greatest } = Calibration::of(&stroke);
            assert!(greatest > 0.3, "{name}: {greatest}");
            let mut worst = 0.0_f32;
            for i in 0..240 {
                let at = |k: f32| (i as f32 * k).fract();
                let [place, length] = [0.618, 0.755].map(at);
                let asked = greatest * at(0.57);
                let tone = tone_for(&table, [place, length], asked);
                let drawn = mean_ink(&stroke, tone, place, &places(&stroke, length, 40));
                worst = worst.max((drawn - asked).abs());
            }
            assert!(worst < 0.02, "{name}: {worst}");
        }
    }
}
