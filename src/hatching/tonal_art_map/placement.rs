//! Where strokes go: of many random ones the one that lies where most is vacant.

use rayon::prelude::*;

use super::stroke::{Brush, Stroke, StrokeShape, random};
use super::vacancy::VacancyMap;

/// What a stroke did to a texel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    pub(super) texel: u32,
    /// Mean ink of the tile after this stroke, 0 to 1.
    pub(super) amount: f32,
    /// Ink of the texel after this stroke, 0 to 1.
    pub(super) ink: f32,
}

/// One level that is being drawn.
pub(super) struct Sheet {
    pub(super) side: usize,
    brush: Brush,
    /// What is left of the paper at each texel, 0 to 1.
    pub(super) paper: Vec<f32>,
    /// The same strokes in the same width at half the side, a quarter and so on: there they take up the space around them
    /// (the image pyramid of Praun et al. 2001).
    vacancies: Vec<VacancyMap>,
    /// All texels of all strokes, in their order.
    pub(super) touches: Vec<Touch>,
    inked: f64,
}

/// Pyramids of levels end here, in texels along a side.
const SMALLEST: usize = 8;
/// Weight of each resolution, relative to the next finer one: more than 1, for a tone has to be even over some strokes.
const FARTHER: f32 = 1.6;
/// Strokes that are tried in one go.
const BATCH: usize = 128;

impl Sheet {
    pub(super) fn new(shape: &StrokeShape, side: usize) -> Self {
        let halves = std::iter::successors(Some(side / 2), |side| Some(side / 2));
        Self {
            side,
            brush: Brush::new(shape, side),
            paper: vec![1.0; side * side],
            vacancies: halves
                .take_while(|side| *side >= SMALLEST)
                .map(|side| VacancyMap::new(shape, side))
                .collect(),
            touches: Vec::new(),
            inked: 0.0,
        }
    }

    /// Mean ink of the tile, 0 to 1.
    pub(super) fn ink(&self) -> f32 {
        (self.inked / (self.side * self.side) as f64) as f32
    }

    /// By how much the mean ink would grow.
    pub(super) fn gain(&self, stroke: &Stroke) -> f32 {
        let [gain, _] = self.brush.weighed(stroke, &self.paper);
        gain / (self.side * self.side) as f32
    }

    /// Draws a stroke.
    pub(super) fn draw(&mut self, stroke: &Stroke) {
        let (mut inked, first) = (0.0, self.touches.len());
        self.brush.visit(stroke, |texel, ink| {
            let Some(paper) = self.paper.get_mut(texel) else { return };
            inked += f64::from(*paper * ink);
            *paper *= 1.0 - ink;
            self.touches.push(Touch { texel: texel as u32, amount: 0.0, ink: 1.0 - *paper });
        });
        self.inked += inked;
        let amount = self.ink();
        for touch in self.touches.iter_mut().skip(first) {
            touch.amount = amount;
        }
        for vacancy in &mut self.vacancies {
            vacancy.occupy(stroke);
        }
    }
}

/// The best of `count` random strokes for all of some levels; `number`: of the stroke, so that each draws other lots.
pub(super) fn best(sheets: &[Sheet], shape: &StrokeShape, seed: u64, number: u64, count: usize) -> Stroke {
    let lot = |i: usize| shape.stroke(random(seed, number << 24 | i as u64));
    let best_of = |batch: usize| {
        let mut best = Try { goodness: -1.0, number: batch * BATCH };
        for number in batch * BATCH..((batch + 1) * BATCH).min(count) {
            if let Some(goodness) = goodness(sheets, &lot(number), best.goodness) {
                best = Try { goodness, number };
            }
        }
        best
    };
    let best = (0..count.div_ceil(BATCH)).into_par_iter().map(best_of).reduce_with(Try::better);
    lot(best.map_or(0, |best| best.number))
}

/// What share of a stroke would be on paper, and how vacant its place is at coarser resolutions; nothing if that is no
/// more than `least`.
fn goodness(sheets: &[Sheet], stroke: &Stroke, least: f32) -> Option<f32> {
    // None adds more than its weight, and coarse ones cost little: most strokes are out of the question early.
    let weights = |sheet: &Sheet| (0..=sheet.vacancies.len() as i32).map(|i| FARTHER.powi(i)).sum::<f32>();
    let mut open: f32 = sheets.iter().map(weights).sum();
    let mut sum = 0.0;
    for sheet in sheets.iter().rev() {
        for (i, vacancy) in sheet.vacancies.iter().enumerate().rev() {
            let weight = FARTHER.powi(i as i32 + 1);
            sum += weight * vacancy.around(stroke);
            open -= weight;
            if sum + open <= least {
                return None;
            }
        }
        let [gain, ink] = sheet.brush.weighed(stroke, &sheet.paper);
        sum += gain / ink.max(1e-6);
        open -= 1.0;
    }
    Some(sum).filter(|sum| *sum > least)
}

/// A stroke that was tried.
struct Try {
    goodness: f32,
    number: usize,
}

impl Try {
    /// The better one; of equals the earlier one, however they were shared out.
    fn better(self, other: Self) -> Self {
        let order = self.goodness.total_cmp(&other.goodness).then(other.number.cmp(&self.number));
        if order.is_lt() { other } else { self }
    }
}
