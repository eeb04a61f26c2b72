//! Strokes that are left out away from edges, as the device reads it.

use encase::ShaderType;

use super::strokes::within;
use crate::style::indication::{DetailBy, Indication};

/// Twin of `Indication` in `shaders/effects/hatching/indication.wgsl`. Lengths in px.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct IndicationUniform {
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
const MOST_REACH: f32 = 512.0;

impl IndicationUniform {
    /// Of a style; `scale`: pixels per reference pixel.
    pub(super) fn new(indication: &Indication, scale: f32) -> Self {
        let (patches, silhouettes) = (&indication.patches, &indication.silhouettes);
        Self {
            amount: within(indication.amount, 0.0, 1.0),
            by_fields: u32::from(indication.by == DetailBy::Fields),
            distance: within(indication.distance, 1.0, 300.0) * scale,
            falloff: within(indication.falloff, 0.1, 4.0),
            attraction: within(indication.attraction, 0.0, 8.0),
            patch_share: within(patches.share, 0.0, 2.0),
            patch_offset: within(patches.offset, 0.1, 4.0),
            patch_slope: within(patches.slope, 0.0, 50.0),
            patch_power: within(patches.power, 0.0, 4.0),
            silhouette_share: within(silhouettes.share, 0.0, 2.0),
            radius: within(silhouettes.radius, 1.0, 200.0) * scale,
            step: within(silhouettes.step, 0.1, 100.0) * scale,
            alpha: within(silhouettes.alpha, 0.0, 10.0),
            beta: within(silhouettes.beta, 0.1, 4.0),
            lambda: within(silhouettes.lambda, 0.0, 10.0),
            silhouette_offset: within(silhouettes.offset, 0.1, 4.0),
            silhouette_slope: within(silhouettes.slope, 0.0, 50.0),
            silhouette_power: within(silhouettes.power, 0.0, 4.0),
        }
    }

    /// How far from lines strokes become fewer, px; 0: lines do not matter.
    pub(super) fn reach(&self) -> f32 {
        let is_by_lines = self.amount > 0.0 && self.by_fields == 0;
        if is_by_lines { (8.0 * self.distance).min(MOST_REACH) } else { 0.0 }
    }
}
