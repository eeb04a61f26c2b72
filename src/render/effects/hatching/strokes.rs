//! What strokes are like, as the device reads it.

use encase::ShaderType;

use crate::style::hatching::Stroke;

/// Twin of `Stroke` in `shaders/effects/hatching/stripes.wgsl`: lengths in px, widths as shares of the spacing.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuStroke {
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

impl GpuStroke {
    /// Of a style; `scale`: pixels per reference pixel.
    pub(super) fn new(stroke: &Stroke, scale: f32) -> Self {
        let thin = stroke.min_width;
        Self {
            // Closer than two pixels there are no lines.
            spacing: (stroke.spacing * scale).max(2.0),
            thin,
            thick: stroke.max_width.max(thin),
            length: stroke.length * scale,
            taper: stroke.taper * scale,
            gap: stroke.gap * scale,
            spread: stroke.tone_by_count,
            chance: stroke.randomness,
            pointed: stroke.pointedness,
            inserted: stroke.late_insertion,
            variation: stroke.variation,
            table: 0,
        }
    }
}
