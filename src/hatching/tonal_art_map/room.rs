//! How much room there is for a stroke, seen from some distance.

use super::stroke::{Brush, Stroke, StrokeShape};

/// A tile at a coarse resolution, with strokes as wide as at the fine one.
pub(super) struct Room {
    brush: Brush,
    /// Sum of the ink of all strokes.
    density: Vec<f32>,
    sum: f32,
    /// How welcome a stroke is, 0 to 1: e⁻ⁿ, where n is the density, relative to its mean once that is large.
    room: Vec<f32>,
    /// By what the density was multiplied for that.
    scale: f32,
}

/// How much a stroke repels others.
const REPULSION: f32 = 2.0;
/// The scale is brought up to date when it is off by this factor.
const OUTDATED: f32 = 1.05;

impl Room {
    pub(super) fn new(shape: &StrokeShape, side: usize) -> Self {
        Self {
            brush: Brush::new(shape, side),
            density: vec![0.0; side * side],
            sum: 0.0,
            room: vec![1.0; side * side],
            scale: REPULSION,
        }
    }

    /// Mean room where a stroke would be, 0 to 1.
    pub(super) fn around(&self, stroke: &Stroke) -> f32 {
        let [room, ink] = self.brush.weighed(stroke, &self.room);
        room / ink.max(1e-6)
    }

    /// Takes a stroke's room away.
    pub(super) fn take(&mut self, stroke: &Stroke) {
        let Self { brush, density, sum, room, scale } = self;
        brush.visit(stroke, |texel, ink| {
            if let Some((density, room)) = density.get_mut(texel).zip(room.get_mut(texel)) {
                *density += ink;
                *sum += ink;
                *room = (-*scale * *density).exp();
            }
        });
        let wanted = REPULSION / (*sum / density.len() as f32).max(1.0);
        if *scale > wanted * OUTDATED {
            *scale = wanted;
            for (room, density) in room.iter_mut().zip(density) {
                *room = (-wanted * *density).exp();
            }
        }
    }
}
