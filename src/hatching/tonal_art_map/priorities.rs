//! All tones in one image: each texel says from which tone on it is inked, and how much.
//!
//! As the stroke textures of Webb et al. 2002 ("Fine Tone Control in Hardware Hatching"), with the ink of texels beside
//! the threshold, so that rims of strokes stay soft. The ink of a tile is exactly the tone's (see [`priorities`]).

use super::Priority;
use super::placement::Touch;

impl Priority {
    /// Ink of the texel when the tile's mean ink is `ink`; both 0 to 1. Twin of the shader's.
    pub fn ink_at(self, ink: f32) -> f32 {
        if self.threshold < NEVER && f32::from(self.threshold) < 255.0 * ink {
            f32::from(self.ink) / 255.0
        } else {
            0.0
        }
    }
}

/// The threshold of texels that are not inked in the darkest tone either.
pub const NEVER: u8 = 255;

/// The priorities of a tile from what its strokes did; `darkest`: its mean ink after them.
///
/// Each texel gets the single step that is nearest to what its strokes did (least squares over all tones). Then thresholds
/// are set so that the texels below one have as much ink as it says: the mean ink of a tile is its tone, within a 255th.
pub(super) fn priorities(side: usize, touches: &[Touch], darkest: f32) -> Vec<Priority> {
    let mut order: Vec<usize> = (0..touches.len()).collect();
    let texel = |i: usize| touches.get(i).map_or(u32::MAX, |touch| touch.texel);
    order.sort_by_key(|i| texel(*i));
    let mut steps: Vec<(usize, Step)> = Vec::with_capacity(side * side);
    for of_texel in order.chunk_by(|a, b| texel(*a) == texel(*b)) {
        let touches: Vec<Touch> = of_texel.iter().filter_map(|i| touches.get(*i)).copied().collect();
        let Some(first) = touches.first() else { continue };
        steps.push((first.texel as usize, nearest_step(&touches, darkest)));
    }
    steps.sort_by(|(a, first), (b, second)| first.amount.total_cmp(&second.amount).then(a.cmp(b)));
    let mut priorities = vec![Priority { threshold: NEVER, ink: 0 }; side * side];
    let mut sum = 0.0f64;
    for (texel, step) in steps {
        let mean = sum / (side * side) as f64;
        sum += f64::from(step.ink);
        if let Some(priority) = priorities.get_mut(texel) {
            *priority = Priority {
                threshold: (mean * 255.0).round().min(f64::from(NEVER - 1)) as u8,
                ink: (step.ink * 255.0).round() as u8,
            };
        }
    }
    spread(side, &mut priorities);
    priorities
}

struct Step {
    amount: f32,
    ink: f32,
}

/// The step that is nearest to a texel's own, over amounts up to the darkest.
fn nearest_step(touches: &[Touch], darkest: f32) -> Step {
    let mut area = 0.0;
    let mut end = darkest;
    let mut best = Step { amount: darkest, ink: 0.0 };
    let mut most = 0.0;
    for touch in touches.iter().rev() {
        area += touch.ink * (end - touch.amount).max(0.0);
        end = end.min(touch.amount);
        let width = darkest - end;
        let ink = if width > 1e-4 { area / width } else { touch.ink };
        // What is left of the squared error gets smaller by this.
        let explained = ink * area;
        if explained >= most {
            most = explained;
            best = Step { amount: touch.amount, ink };
        }
    }
    best
}

/// Gives texels without ink the thresholds of their neighbours: between texels a threshold then stays that of its stroke,
/// and the stroke ends where its ink does.
fn spread(side: usize, priorities: &mut [Priority]) {
    let before = priorities.to_vec();
    let at = |x: usize, y: usize| before.get(y % side * side + x % side).copied().unwrap_or_default();
    for (i, priority) in priorities.iter_mut().enumerate().filter(|(_, priority)| priority.ink == 0) {
        let (x, y) = (i % side + side, i / side + side);
        let around = (0..9).map(|n| at(x + n % 3 - 1, y + n / 3 - 1)).filter(|near| near.ink > 0);
        if let Some(strongest) = around.max_by_key(|near| near.ink) {
            priority.threshold = strongest.threshold;
        }
    }
}
