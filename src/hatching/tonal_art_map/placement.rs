//! Where strokes go: of many random ones the one that inks the most paper.

use rayon::prelude::*;

use super::stroke::{Brush, Stroke, StrokeShape, random};

/// A tile that strokes are drawn on, at one resolution.
struct Canvas {
    brush: Brush,
    /// What is left of the paper, 0 to 1.
    paper: Vec<f32>,
}

impl Canvas {
    fn new(shape: &StrokeShape, side: usize) -> Self {
        Self { brush: Brush::new(shape, side), paper: vec![1.0; side * side] }
    }

    /// How much paper a stroke would ink and how much ink it has, in texels.
    fn gain(&self, stroke: &Stroke) -> [f32; 2] {
        let mut sums = [0.0; 2];
        self.brush.visit(stroke, |texel, ink| {
            sums[0] += ink * self.paper.get(texel).copied().unwrap_or_default();
            sums[1] += ink;
        });
        sums
    }
}

/// What of a texel a stroke left as paper.
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
    /// First the level itself; then the same strokes in the same width at half the side each: there strokes fill up the
    /// space around them, so that new ones go where there is most room (the image pyramid of Praun et al. 2001).
    pyramid: Vec<Canvas>,
    /// All texels of all strokes, in their order.
    pub(super) touches: Vec<Touch>,
    inked: f64,
}

/// Pyramids of levels end here, in texels along a side.
const SMALLEST: usize = 16;
/// Strokes that are tried in one go.
const BATCH: usize = 64;

impl Sheet {
    pub(super) fn new(shape: &StrokeShape, side: usize) -> Self {
        let sides = std::iter::successors(Some(side), |side| Some(side / 2).filter(|half| *half >= SMALLEST));
        Self {
            side,
            pyramid: sides.map(|side| Canvas::new(shape, side)).collect(),
            touches: Vec::new(),
            inked: 0.0,
        }
    }

    /// Mean ink of the tile, 0 to 1.
    pub(super) fn ink(&self) -> f32 {
        (self.inked / (self.side * self.side) as f64) as f32
    }

    /// What is left of the paper at each texel, 0 to 1.
    pub(super) fn paper(&self) -> &[f32] {
        self.pyramid.first().map(|canvas| canvas.paper.as_slice()).unwrap_or_default()
    }

    /// By how much the mean ink would grow.
    pub(super) fn gain(&self, stroke: &Stroke) -> f32 {
        let gain = self.pyramid.first().map_or(0.0, |canvas| canvas.gain(stroke)[0]);
        gain / (self.side * self.side) as f32
    }

    /// Share of a stroke that would be on paper, mean of all resolutions.
    fn goodness(&self, stroke: &Stroke) -> f32 {
        self.pyramid
            .iter()
            .map(|canvas| {
                let [gain, ink] = canvas.gain(stroke);
                gain / ink.max(1e-6)
            })
            .sum()
    }

    /// The best of `count` random strokes; `number`: of the stroke, so that each draws other lots.
    pub(super) fn best(&self, shape: &StrokeShape, seed: u64, number: u64, count: usize) -> Stroke {
        let batches = count.max(1).div_ceil(BATCH);
        let best_of = |batch: usize| {
            (batch * BATCH..((batch + 1) * BATCH).min(count.max(1)))
                .map(|i| {
                    let stroke = shape.stroke(random(seed, number << 24 | i as u64));
                    Try { goodness: self.goodness(&stroke), number: i, stroke }
                })
                .reduce(Try::better)
        };
        let best = (0..batches).into_par_iter().filter_map(best_of).reduce_with(Try::better);
        best.map_or_else(|| shape.stroke(random(seed, number << 24)), |best| best.stroke)
    }

    /// Draws a stroke.
    pub(super) fn draw(&mut self, stroke: &Stroke) {
        let (mut inked, first) = (0.0, self.touches.len());
        for (i, canvas) in self.pyramid.iter_mut().enumerate() {
            let Canvas { brush, paper } = canvas;
            brush.visit(stroke, |texel, ink| {
                let Some(paper) = paper.get_mut(texel) else { return };
                if i == 0 {
                    inked += f64::from(*paper * ink);
                    let ink = 1.0 - *paper * (1.0 - ink);
                    self.touches.push(Touch { texel: texel as u32, amount: 0.0, ink });
                }
                *paper *= 1.0 - ink;
            });
        }
        self.inked += inked;
        let amount = self.ink();
        for touch in self.touches.iter_mut().skip(first) {
            touch.amount = amount;
        }
    }
}

/// A stroke that was tried.
struct Try {
    goodness: f32,
    number: usize,
    stroke: Stroke,
}

impl Try {
    /// The better one; of equals the earlier one, however they were shared out.
    fn better(self, other: Self) -> Self {
        let order = self.goodness.total_cmp(&other.goodness).then(other.number.cmp(&self.number));
        if order.is_lt() { other } else { self }
    }
}
