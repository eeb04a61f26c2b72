//! All tones in one image: each texel says from which tones on it is inked, and how much.
//!
//! As the stroke textures of Webb et al. 2002 ("Fine Tone Control in Hardware Hatching"), with ink beside the thresholds,
//! so that rims of strokes stay soft, and with two steps, for most texels are met by several strokes.

use super::Priority;
use super::placement::Touch;

impl Priority {
    /// Ink of the texel when the tile's mean ink is `ink`; both 0 to 1. Twin of the shader's.
    pub fn ink_at(self, ink: f32) -> f32 {
        let steps = self.thresholds.into_iter().zip(self.inks);
        let mut taken =
            steps.filter(|(threshold, _)| *threshold < NEVER && f32::from(*threshold) < 255.0 * ink);
        taken.next_back().map_or(0.0, |(_, ink)| f32::from(ink) / 255.0)
    }
}

/// The threshold of a step that is not taken in the darkest tone either.
pub const NEVER: u8 = 255;

/// A step of a texel: its ink from a mean ink of the tile on.
#[derive(Debug, Clone, Copy, Default)]
struct Step {
    amount: f32,
    ink: f32,
}

/// One of the two steps of a texel, by how much its ink grows.
struct Rise {
    texel: usize,
    number: usize,
    amount: f32,
    by: f32,
}

/// The priorities of a tile from what its strokes did.
///
/// Each texel gets the two steps that are nearest to what its strokes did (least squares over all tones). The last one leads
/// to all its ink, so that the darkest tone is exact. Then thresholds
/// are set so that all steps below one have as much ink as it says: the mean ink of a tile is its tone, within a 255th.
pub(super) fn priorities(side: usize, touches: &[Touch]) -> Vec<Priority> {
    let mut ordered = touches.to_vec();
    ordered.sort_by_key(|touch| touch.texel);
    let mut priorities = vec![Priority { thresholds: [NEVER; 2], inks: [0; 2] }; side * side];
    let mut rises = Vec::with_capacity(2 * side * side);
    for touches in ordered.chunk_by(|a, b| a.texel == b.texel) {
        let texel = touches.first().map_or(0, |touch| touch.texel as usize);
        let mut before = 0.0;
        for (number, step) in nearest_steps(touches).into_iter().enumerate() {
            rises.push(Rise { texel, number, amount: step.amount, by: step.ink - before });
            before = step.ink;
        }
    }
    rises.sort_by(|a, b| a.amount.total_cmp(&b.amount).then((a.texel, a.number).cmp(&(b.texel, b.number))));
    let mut sum = 0.0f64;
    let mut inks = vec![0.0f32; side * side];
    for rise in rises.iter().filter(|rise| rise.by > 0.0) {
        let threshold = (sum / (side * side) as f64 * 255.0).round().min(f64::from(NEVER - 1)) as u8;
        sum += f64::from(rise.by);
        if let Some((priority, ink)) = priorities.get_mut(rise.texel).zip(inks.get_mut(rise.texel)) {
            *ink += rise.by;
            let taken = (*ink * 255.0).round() as u8;
            for number in rise.number..2 {
                priority.thresholds[number] = threshold;
                priority.inks[number] = taken;
            }
        }
    }
    for priority in priorities.iter_mut().filter(|priority| priority.inks[0] == 0) {
        // One step is two at once.
        *priority = Priority { thresholds: [priority.thresholds[1]; 2], inks: [priority.inks[1]; 2] };
    }
    spread(side, &mut priorities);
    priorities
}

/// The two steps that are nearest to a texel's own, over all amounts, of those that lead to all its ink: so that the darkest
/// tone is reached.
fn nearest_steps(touches: &[Touch]) -> [Step; 2] {
    let amount = |i: usize| touches.get(i).map_or(1.0, |touch| touch.amount);
    let all = touches.last().map_or(0.0, |touch| touch.ink);
    // Ink of all touches up to one, over the amounts; differences of it let any interval be asked for.
    let mut areas = vec![0.0f32];
    for (i, touch) in touches.iter().enumerate() {
        let before = areas.last().copied().unwrap_or_default();
        areas.push(before + touch.ink * (amount(i + 1) - amount(i)));
    }
    let area =
        |from: usize, to: usize| areas.get(from).zip(areas.get(to)).map_or(0.0, |(from, to)| to - from);
    // By how much an ink all over an interval of amounts lessens the squared error.
    let gain =
        |ink: f32, [from, to]: [usize; 2]| ink * (2.0 * area(from, to) - ink * (amount(to) - amount(from)));
    let count = touches.len();
    let mut best = [Step { amount: 1.0, ink: 0.0 }; 2];
    let mut most = -1.0;
    for first in 0..count {
        for second in first..count {
            let width = amount(second) - amount(first);
            let ink = if width > 1e-5 { area(first, second) / width } else { 0.0 };
            let gain = gain(ink, [first, second]) + gain(all, [second, count]);
            if gain > most {
                most = gain;
                best = [Step { amount: amount(first), ink }, Step { amount: amount(second), ink: all }];
            }
        }
    }
    best
}

/// Gives texels without ink the thresholds of their neighbors: between texels a threshold then stays that of its stroke,
/// and the stroke ends where its ink does.
fn spread(side: usize, priorities: &mut [Priority]) {
    let before = priorities.to_vec();
    let at = |x: usize, y: usize| before.get(y % side * side + x % side).copied().unwrap_or_default();
    for (i, priority) in priorities.iter_mut().enumerate().filter(|(_, priority)| priority.inks == [0; 2]) {
        let (x, y) = (i % side + side, i / side + side);
        let around = (0..9).map(|n| at(x + n % 3 - 1, y + n / 3 - 1)).filter(|near| near.inks[1] > 0);
        if let Some(strongest) = around.max_by_key(|near| near.inks) {
            priority.thresholds = strongest.thresholds;
        }
    }
}
