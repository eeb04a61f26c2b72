//! Draws tonal art maps.
//!
//! As in Praun et al. 2001: tones from light to dark, in each the levels from coarse to fine, and in each level strokes
//! until its ink is reached. A stroke is drawn in its level and in all finer ones, in its tone and in all darker ones.
//! Here each tone is reached in [`STEPS`] steps, so that levels agree about the order of strokes within a tone too.

use super::placement::{Sheet, best};
use super::priorities::priorities;
use super::stroke::{Stroke, StrokeShape};
use super::{INK_TOLERANCE, Level, TonalArtMap};

/// What a map is made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// What strokes look like.
    pub shape: StrokeShape,
    /// Mean ink of each tone, light to dark, above 0 to [`DARKEST`].
    pub inks: Vec<f32>,
    /// Texels along a side of the finest level: a power of two, 32 to 2048.
    pub side: usize,
    /// Number of levels; each has half the side of the one before, 16 or more.
    pub levels: usize,
    /// Of so many random strokes the best is taken, 1 to 10 000.
    pub candidates: usize,
    /// Another number gives other strokes.
    pub seed: u64,
}

/// Mean ink of six tones that are evenly spaced between paper and full ink: i / 7.
pub const SIX_TONES: [f32; 6] = [1.0 / 7.0, 2.0 / 7.0, 3.0 / 7.0, 4.0 / 7.0, 5.0 / 7.0, 6.0 / 7.0];
/// No tone may be darker, in mean ink: the last bits of paper take very many strokes.
pub const DARKEST: f32 = 0.95;

impl Default for Recipe {
    fn default() -> Self {
        Self {
            shape: StrokeShape::default(),
            inks: SIX_TONES.to_vec(),
            side: 256,
            levels: 4,
            candidates: 400,
            seed: 1,
        }
    }
}

/// Why there is no map.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecipeError {
    /// A number is out of its range.
    #[error("`{name}` of a tonal art map is {value}: it must be between {least} and {most}")]
    Range {
        /// The field.
        name: &'static str,
        /// What it is.
        value: f32,
        /// The least that it may be.
        least: f32,
        /// The most that it may be.
        most: f32,
    },
    /// The resolutions are no halves of each other.
    #[error(
        "a tonal art map of {side} texels cannot have {levels} levels: the side must be a power of two from 32 to 2048, and \
         the coarsest level must have 16 texels or more; 256 and 4 are good"
    )]
    Levels {
        /// Of the finest level.
        side: usize,
        /// How many there should be.
        levels: usize,
    },
    /// The tones do not get darker.
    #[error(
        "the tones of a tonal art map have the inks {inks:?}: each must be greater than the one before, and there must be one"
    )]
    Order {
        /// As they were given.
        inks: Vec<f32>,
    },
    /// The strokes are too faint for the tone.
    #[error(
        "the strokes reach the ink {reached} of {wanted}: give them more `pressure` or less `grain`, or ask for lighter tones"
    )]
    TooFaint {
        /// Mean ink that was reached.
        reached: f32,
        /// Mean ink of the tone.
        wanted: f32,
    },
    /// The caller wanted no more.
    #[error("drawing the tonal art map was canceled")]
    Canceled,
}

/// Each tone is reached in so many steps.
pub const STEPS: usize = 4;
/// After so many strokes without any ink there will be no more.
const MAX_IDLE: usize = 100;

/// Strokes of a map with the place that they have in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedStroke {
    /// The stroke.
    pub stroke: Stroke,
    /// The coarsest level that has it.
    pub level: usize,
    /// The lightest tone that has it, from 0.
    pub tone: usize,
}

/// A map and its strokes, in the order in which they were drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnMap {
    /// The map.
    pub map: TonalArtMap,
    /// All strokes of its finest level.
    pub strokes: Vec<PlacedStroke>,
}

impl Recipe {
    /// Draws the map. The same recipe gives the same map. `progress` hears what share is done, 0 to 1, and says whether to
    /// go on.
    ///
    /// # Errors
    /// When the recipe asks for what cannot be drawn, or `progress` said no.
    pub fn draw(&self, progress: &(dyn Fn(f32) -> bool + Sync)) -> Result<DrawnMap, RecipeError> {
        self.check()?;
        let mut work = Work {
            recipe: self,
            sheets: (0..self.levels).map(|level| Sheet::new(&self.shape, self.side >> level)).collect(),
            strokes: Vec::new(),
            progress,
        };
        let mut tones = vec![Vec::new(); self.levels];
        let mut before = 0.0;
        for (tone, ink) in self.inks.iter().enumerate() {
            for step in 1..=STEPS {
                let target = before + (ink - before) * step as f32 / STEPS as f32;
                for level in (0..self.levels).rev() {
                    work.fill(level, tone, target, step == STEPS)?;
                }
            }
            before = *ink;
            for (tones, sheet) in tones.iter_mut().zip(&work.sheets) {
                tones.push(sheet.paper.iter().map(|paper| ((1.0 - paper) * 255.0).round() as u8).collect());
            }
        }
        let levels = work.sheets.iter().zip(tones).map(|(sheet, tones)| Level {
            side: sheet.side,
            tones,
            priorities: priorities(sheet.side, &sheet.touches),
        });
        let map = TonalArtMap { inks: self.inks.clone(), levels: levels.collect() };
        Ok(DrawnMap { map, strokes: work.strokes })
    }

    fn check(&self) -> Result<(), RecipeError> {
        let shape = &self.shape;
        let ranges = [
            ("length", shape.length, 0.0, 1.0),
            ("length_spread", shape.length_spread, 0.0, 1.0),
            ("width", shape.width, 0.25, 32.0),
            ("width_spread", shape.width_spread, 0.0, 1.0),
            ("taper", shape.taper[0], 0.0, 1.0),
            ("taper", shape.taper[1], 0.0, 1.0),
            ("waviness", shape.waviness, 0.0, 0.25),
            ("angle_spread", shape.angle_spread, 0.0, 0.5),
            ("pressure", shape.pressure, 0.05, 1.0),
            ("grain", shape.grain, 0.0, 0.9),
            ("candidates", self.candidates as f32, 1.0, 10_000.0),
        ];
        let inks = self.inks.iter().map(|ink| ("inks", *ink, 0.001, DARKEST));
        for (name, value, least, most) in ranges.into_iter().chain(inks) {
            // NaN is in no range.
            if !(least..=most).contains(&value) {
                return Err(RecipeError::Range { name, value, least, most });
            }
        }
        if self.inks.is_empty() || self.inks.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(RecipeError::Order { inks: self.inks.clone() });
        }
        let is_side = self.side.is_power_of_two() && (32..=2048).contains(&self.side);
        if !is_side || self.levels == 0 || self.levels > 8 || self.side >> (self.levels - 1) < 16 {
            return Err(RecipeError::Levels { side: self.side, levels: self.levels });
        }
        Ok(())
    }
}

struct Work<'a> {
    recipe: &'a Recipe,
    /// Finest first.
    sheets: Vec<Sheet>,
    strokes: Vec<PlacedStroke>,
    progress: &'a (dyn Fn(f32) -> bool + Sync),
}

impl Work<'_> {
    /// Draws strokes in a level and all finer ones until it has the ink; only `exactly` if the last one may be cut short.
    fn fill(&mut self, level: usize, tone: usize, target: f32, exactly: bool) -> Result<(), RecipeError> {
        let Recipe { shape, seed, candidates, .. } = self.recipe;
        let mut idle = 0;
        while let Some(sheet) = self.sheets.get(level).filter(|sheet| sheet.ink() < target) {
            if !(self.progress)(self.share_done()) {
                return Err(RecipeError::Canceled);
            }
            let rest = target - sheet.ink();
            let mut stroke =
                best(&self.sheets[..=level], shape, *seed, self.strokes.len() as u64, *candidates);
            let gain = sheet.gain(&stroke);
            idle = if gain > 0.0 { 0 } else { idle + 1 };
            if idle > MAX_IDLE {
                return Err(RecipeError::TooFaint { reached: sheet.ink(), wanted: target });
            }
            // A stub shows: better a little too much or too little ink.
            let error = rest.min(gain - rest);
            if gain > rest && exactly && error > 0.6 * INK_TOLERANCE {
                stroke = shortened(sheet, &stroke, rest);
            } else if gain > 2.0 * rest {
                break;
            }
            for sheet in self.sheets.iter_mut().take(level + 1) {
                sheet.draw(&stroke);
            }
            self.strokes.push(PlacedStroke { stroke, level, tone });
        }
        Ok(())
    }

    /// Share of all strokes that are drawn, about.
    fn share_done(&self) -> f32 {
        // Strokes that lie anywhere leave e⁻ⁿ of the paper.
        let strokes = |ink: f32| -(1.0 - ink.min(DARKEST)).ln();
        let all = self.recipe.inks.last().map_or(1.0, |ink| strokes(*ink));
        let [done, of] = self.sheets.iter().fold([0.0, 0.0], |[done, of], sheet| {
            let side = sheet.side as f32;
            [done + side * strokes(sheet.ink()), of + side * all]
        });
        (done / of).clamp(0.0, 1.0)
    }
}

/// A stroke that adds about `gain` to the mean ink: the beginning of another one, or a thinner one.
fn shortened(sheet: &Sheet, stroke: &Stroke, gain: f32) -> Stroke {
    let with_share = |share: f32| Stroke {
        length: stroke.length * share,
        width: if stroke.length > 0.0 { stroke.width } else { stroke.width * share },
        swing: stroke.swing.map(|swing| swing * share),
        ..*stroke
    };
    let [mut least, mut most] = [0.1, 1.0];
    for _ in 0..8 {
        let middle = 0.5 * (least + most);
        if sheet.gain(&with_share(middle)) > gain { most = middle } else { least = middle }
    }
    with_share(least)
}

#[cfg(test)]
#[path = "generator_tests.rs"]
mod tests;
