//! What strokes are like, as the device reads it.

use encase::ShaderType;

use crate::style::hatching::Stroke;

/// Twin of `Stroke` in `shaders/effects/hatching/strokes.wgsl`: lengths in px, widths as shares of the spacing.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuStroke {
    pub(super) spacing: f32,
    pub(super) min_width: f32,
    pub(super) max_width: f32,
    pub(super) length: f32,
    pub(super) taper: f32,
    pub(super) gap: f32,
    pub(super) tone_by_count: f32,
    pub(super) randomness: f32,
    pub(super) pointedness: f32,
    pub(super) late_insertion: f32,
    pub(super) variation: f32,
    pub(super) table: u32,
}

impl GpuStroke {
    /// Of a style; `scale`: pixels per reference pixel.
    pub(super) fn new(stroke: &Stroke, scale: f32) -> Self {
        let min_width = stroke.min_width;
        Self {
            // Closer than two pixels there are no lines.
            spacing: (stroke.spacing * scale).max(2.0),
            min_width,
            max_width: stroke.max_width.max(min_width),
            length: stroke.length * scale,
            taper: stroke.taper * scale,
            // Strokes without ends have none that pass each other.
            gap: if stroke.taper > 0.0 { stroke.gap * scale } else { 0.0 },
            tone_by_count: stroke.tone_by_count,
            randomness: stroke.randomness,
            pointedness: stroke.pointedness,
            late_insertion: stroke.late_insertion,
            variation: stroke.variation,
            table: 0,
        }
    }
}
