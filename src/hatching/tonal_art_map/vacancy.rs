//! How vacant a tile of strokes is, seen from some distance: where it has little ink, the next stroke is welcome.

use super::stroke::{Brush, Stroke, StrokeShape};

/// A tile at a coarse resolution, with strokes as wide as at the fine one.
pub(super) struct VacancyMap {
    brush: Brush,
    /// Sum of the ink of all strokes.
    density: Vec<f32>,
    sum: f32,
    /// How vacant each texel is, 0 to 1: e⁻ⁿ, where n is the density, relative to its mean once that is large.
    vacancy: Vec<f32>,
    /// By what the density was multiplied for that.
    scale: f32,
}

/// How much a stroke repels others.
const REPULSION: f32 = 2.0;
/// The scale is brought up to date when it is off by this factor.
const OUTDATED: f32 = 1.05;

impl VacancyMap {
    pub(super) fn new(shape: &StrokeShape, side: usize) -> Self {
        Self {
            brush: Brush::new(shape, side),
            density: vec![0.0; side * side],
            sum: 0.0,
            vacancy: vec![1.0; side * side],
            scale: REPULSION,
        }
    }

    /// Mean vacancy where a stroke would be, 0 to 1.
    pub(super) fn around(&self, stroke: &Stroke) -> f32 {
        let [vacancy, ink] = self.brush.weighed(stroke, &self.vacancy);
        vacancy / ink.max(1e-6)
    }

    /// Adds the ink of a stroke: its place is less vacant from now on.
    pub(super) fn occupy(&mut self, stroke: &Stroke) {
        let Self { brush, density, sum, vacancy, scale } = self;
        brush.visit(stroke, |texel, ink| {
            if let Some((density, vacancy)) = density.get_mut(texel).zip(vacancy.get_mut(texel)) {
                *density += ink;
                *sum += ink;
                *vacancy = (-*scale * *density).exp();
            }
        });
        let wanted = REPULSION / (*sum / density.len() as f32).max(1.0);
        if *scale > wanted * OUTDATED {
            *scale = wanted;
            for (vacancy, density) in vacancy.iter_mut().zip(density) {
                *vacancy = (-wanted * *density).exp();
            }
        }
    }
}
