//! What strokes are like, as the device reads it.

use encase::ShaderType;

use crate::style::hatching::Stroke;

/// Twin of `Stroke` in `shaders/effects/hatching/stripes.wgsl`: lengths in px, widths as shares of the spacing.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct StrokeUniform {
    pub(super) spacing: f32,
    pub(super) thin: f32,
    pub(super) thick: f32,
    pub(super) length: f32,
    pub(super) taper: f32,
    pub(super) gap: f32,
    pub(super) spread: f32,
    pub(super) chance: f32,
    pub(super) pointed: f32,
    pub(super) inserted: f32,
    pub(super) variation: f32,
    pub(super) table: u32,
}

pub(super) fn within(value: f32, least: f32, most: f32) -> f32 {
    if value.is_nan() { least } else { value.clamp(least, most) }
}

impl StrokeUniform {
    /// Of a style; `scale`: pixels per reference pixel.
    pub(super) fn new(stroke: &Stroke, scale: f32) -> Self {
        let thin = within(stroke.thin, 0.02, 1.2);
        Self {
            // Closer than two pixels there are no lines.
            spacing: (within(stroke.spacing, 2.0, 60.0) * scale).max(2.0),
            thin,
            thick: within(stroke.thick, 0.02, 1.2).max(thin),
            length: within(stroke.length, 5.0, 1000.0) * scale,
            taper: within(stroke.taper, 0.0, 100.0) * scale,
            gap: within(stroke.gap, 0.0, 20.0) * scale,
            spread: within(stroke.spread, 0.0, 1.0),
            chance: within(stroke.chance, 0.0, 1.0),
            pointed: within(stroke.pointed, 0.0, 2.0),
            inserted: within(stroke.inserted, 0.0, 1.0),
            variation: within(stroke.variation, 0.0, 1.0),
            table: 0,
        }
    }
}
