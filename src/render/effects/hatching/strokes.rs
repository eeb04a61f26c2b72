//! What strokes are like, as the device reads it.

use encase::ShaderType;

use super::smoothstep::smoothstep;
use crate::style::hatching::Stroke;

/// Twin of `Stroke` in `shaders/effects/hatching/style.wgsl`: lengths in px, widths as shares of the spacing.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuStroke {
    #[shader(align(16))]
    pub(super) spacing: f32,
    pub(super) min_width: f32,
    pub(super) max_width: f32,
    pub(super) end_width: f32,
    pub(super) length: f32,
    pub(super) taper: f32,
    pub(super) gap: f32,
    pub(super) tone_by_count: f32,
    pub(super) randomness: f32,
    pub(super) pointedness: f32,
    pub(super) late_insertion: f32,
    pub(super) insertion_spread: f32,
    pub(super) variation: f32,
    pub(super) crispness: f32,
    pub(super) table: u32,
}

/// Crisp strokes would beat with the pixels if they lay close: spacings from which on they begin to be crisp, and are, px.
const CLOSE: f32 = 2.0;
const WIDE_APART: f32 = 4.8;
/// How narrow soft strokes are where they end, and crisp ones, px.
const SOFT_END: f32 = 0.45;
const CRISP_END: f32 = 0.82;

impl GpuStroke {
    /// Of a style; `scale`: pixels per reference pixel. `is_single`: a picture of one sample shows strokes as a print does, ink or
    /// paper, hardly a gray, and none that would be narrower than a pixel: there are fewer instead. Where samples are averaged, and
    /// while something moves, their rims are soft, or they would flicker.
    pub(super) fn new(stroke: &Stroke, scale: f32, is_single: bool) -> Self {
        // Closer than two pixels there are no lines.
        let spacing = (stroke.spacing * scale).max(2.0);
        let crispness = if is_single { smoothstep(CLOSE, WIDE_APART, spacing) } else { 0.0 };
        let end_width = SOFT_END + (CRISP_END - SOFT_END) * crispness;
        let min_width = stroke.min_width.max(crispness * CRISP_END / spacing);
        Self {
            spacing,
            min_width,
            end_width,
            max_width: stroke.max_width.max(min_width),
            length: stroke.length * scale,
            taper: stroke.taper * scale,
            // Strokes without ends have none that pass each other.
            gap: if stroke.taper > 0.0 { stroke.gap * scale } else { 0.0 },
            tone_by_count: stroke.tone_by_count,
            randomness: stroke.randomness,
            pointedness: stroke.pointedness,
            late_insertion: stroke.late_insertion,
            insertion_spread: stroke.insertion_spread,
            variation: stroke.variation,
            crispness,
            table: 0,
        }
    }
}
