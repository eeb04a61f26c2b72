//! Strokes that are left out away from edges, as the device reads it.

use encase::ShaderType;

use crate::style::indication::{DetailBy, Indication};

/// Twin of `Indication` in `shaders/effects/hatching/style.wgsl`. Lengths in px.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuIndication {
    #[shader(align(16))]
    pub(super) amount: f32,
    by_fields: u32,
    distance: f32,
    falloff: f32,
    attraction: f32,
    patch_share: f32,
    patch_offset: f32,
    patch_slope: f32,
    patch_power: f32,
    silhouette_share: f32,
    radius: f32,
    step: f32,
    alpha: f32,
    beta: f32,
    lambda: f32,
    silhouette_offset: f32,
    silhouette_slope: f32,
    silhouette_power: f32,
}

/// Farthest that edges are looked for, px.
const MAX_REACH: f32 = 512.0;

impl GpuIndication {
    /// Of a style; `scale`: pixels per reference pixel.
    pub(super) fn new(indication: &Indication, scale: f32) -> Self {
        let (patches, silhouettes) = (&indication.patches, &indication.silhouettes);
        Self {
            amount: indication.amount,
            by_fields: u32::from(indication.by == DetailBy::Fields),
            distance: indication.distance * scale,
            falloff: indication.falloff,
            attraction: indication.attraction,
            patch_share: patches.share,
            patch_offset: patches.offset,
            patch_slope: patches.slope,
            patch_power: patches.power,
            silhouette_share: silhouettes.weight.share,
            radius: silhouettes.radius * scale,
            step: silhouettes.step * scale,
            alpha: silhouettes.alpha,
            beta: silhouettes.beta,
            lambda: silhouettes.lambda,
            silhouette_offset: silhouettes.weight.offset,
            silhouette_slope: silhouettes.weight.slope,
            silhouette_power: silhouettes.weight.power,
        }
    }

    /// How far from lines strokes become fewer, px; 0: lines do not matter.
    pub(super) fn reach(&self) -> f32 {
        let is_by_lines = self.amount > 0.0 && self.by_fields == 0;
        if is_by_lines { (8.0 * self.distance).min(MAX_REACH) } else { 0.0 }
    }
}
