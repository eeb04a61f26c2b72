//! The edge map: ink per pixel, and whose it is (edge-enhancement paper, section 4.1.2).

use encase::ShaderType;
use glam::Vec3;

use super::gbuffer::GBuffer;
use crate::gpu::recorder::Input;
use crate::gpu::{Program, Recorder, Target};
use crate::render::RenderError;
use crate::style::{DepthOperator, Edges};

/// Twin of `EdgeStyle` in `shaders/common/edge_style.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct EdgeUniform {
    profile_color: Vec3,
    profile_strength: f32,
    inner_color: Vec3,
    inner_strength: f32,
    gain_z: f32,
    gain_c1: f32,
    gain_n: f32,
    profile_threshold: f32,
    inner_threshold: f32,
    use_c1: u32,
}

impl From<&Edges> for EdgeUniform {
    fn from(edges: &Edges) -> Self {
        let (profile, inner) = (&edges.profile, &edges.inner);
        let gain = |show: bool, gain: f32| if show { gain.clamp(0.0, 1000.0) } else { 0.0 };
        Self {
            profile_color: profile.color.to_linear(),
            profile_strength: profile.strength.clamp(0.0, 1.0),
            inner_color: inner.color.to_linear(),
            inner_strength: inner.strength.clamp(0.0, 1.0),
            gain_z: gain(profile.show, profile.gain),
            gain_c1: gain(profile.show, profile.more.gain_c1),
            gain_n: gain(inner.show, inner.gain),
            profile_threshold: profile.threshold.clamp(0.0, 0.99),
            inner_threshold: inner.threshold.clamp(0.0, 0.99),
            use_c1: u32::from(edges.operator == DepthOperator::C1),
        }
    }
}

impl EdgeUniform {
    /// No lines at all.
    pub const NONE: Self = Self {
        profile_color: Vec3::ZERO,
        profile_strength: 0.0,
        inner_color: Vec3::ZERO,
        inner_strength: 0.0,
        gain_z: 0.0,
        gain_c1: 0.0,
        gain_n: 0.0,
        profile_threshold: 0.0,
        inner_threshold: 0.0,
        use_c1: 0,
    };

    /// Whether any line can come of it.
    pub fn draws_anything(&self) -> bool {
        let profile = if self.use_c1 == 1 { self.gain_c1 } else { self.gain_z };
        profile * self.profile_strength > 0.0 || self.gain_n * self.inner_strength > 0.0
    }
}

/// Makes the edge map: per pixel inner and profile ink (2 × 16-bit unorm) and the object whose style draws it.
///
/// # Errors
/// [`RenderError`].
pub fn edge_map(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    styles: &[EdgeUniform],
    edge_styles: &wgpu::Buffer,
) -> Result<Target, RenderError> {
    let with_c1 = styles.iter().any(|s| s.use_c1 == 1);
    run(
        rec,
        gbuffer,
        edge_styles,
        "edge map",
        "fs_main",
        with_c1,
        Some(&gbuffer.depth),
        wgpu::TextureFormat::Rg32Uint,
    )
}

/// The operators' own values per pixel: `I_N`, `I_Z`, C1 (no edge: 1, 1, 0).
///
/// # Errors
/// [`RenderError`].
pub fn operators(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    edge_styles: &wgpu::Buffer,
) -> Result<Target, RenderError> {
    run(rec, gbuffer, edge_styles, "operators", "fs_operators", true, None, wgpu::TextureFormat::Rgba32Float)
}

fn run(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    edge_styles: &wgpu::Buffer,
    label: &'static str,
    entry_point: &'static str,
    with_c1: bool,
    covered: Option<&Target>,
    format: wgpu::TextureFormat,
) -> Result<Target, RenderError> {
    let out = rec.target(label, format)?;
    let inputs = [Input::Texture(&gbuffer.geometry), Input::Storage(edge_styles)];
    let program = Program { file: "passes/edge_map.wgsl", entry_point, switches: vec![("WITH_C1", with_c1)] };
    rec.fullscreen(label, program, &inputs, &[&out], covered)?;
    Ok(out)
}
