//! The surface techniques (blank, plain, unlit, Gooch), shaded from the G-buffer in one full-screen pass: the scene is
//! traversed once, where the edge-enhancement paper's pipeline traverses it twice.

use encase::ShaderType;
use glam::Vec3;

use crate::gpu::recorder::Input;
use crate::gpu::{Program, Recorder, Target};
use crate::render::RenderError;
use crate::render::passes::gbuffer::GBuffer;
use crate::style::{Style, Technique};

/// Twin of `SurfaceStyle` in `shaders/effects/surface.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct SurfaceUniform {
    cool: Vec3,
    alpha: f32,
    warm: Vec3,
    beta: f32,
    highlight: f32,
    shininess: f32,
    ambient: f32,
    technique: u32,
}

impl SurfaceUniform {
    /// Paper only.
    pub const BLANK: Self = Self {
        cool: Vec3::ZERO,
        alpha: 0.0,
        warm: Vec3::ZERO,
        beta: 0.0,
        highlight: 0.0,
        shininess: 1.0,
        ambient: 0.0,
        technique: BLANK,
    };
}

// As in `shaders/effects/surface.wgsl`.
const BLANK: u32 = 0;
const PLAIN: u32 = 1;
const UNLIT: u32 = 2;
const GOOCH: u32 = 3;

impl From<&Style> for SurfaceUniform {
    fn from(style: &Style) -> Self {
        let gooch = &style.gooch;
        Self {
            cool: gooch.cool.to_linear(),
            alpha: gooch.alpha.clamp(0.0, 1.0),
            warm: gooch.warm.to_linear(),
            beta: gooch.beta.clamp(0.0, 1.0),
            highlight: gooch.highlight.clamp(0.0, 1.0),
            shininess: gooch.shininess.clamp(1.0, 256.0),
            ambient: style.plain.ambient.clamp(0.0, 1.0),
            technique: match style.technique {
                Technique::Blank => BLANK,
                Technique::Plain => PLAIN,
                Technique::Unlit => UNLIT,
                Technique::Gooch => GOOCH,
            },
        }
    }
}

/// Linear colour times opacity, and opacity; `styles` are those of all visible objects. Shaded surfaces with their lines, nothing where there is no object.
///
/// # Errors
/// [`RenderError`].
pub fn surface(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    edge_map: Option<&Target>,
    styles: &[SurfaceUniform],
    surface_styles: &wgpu::Buffer,
    edge_styles: &wgpu::Buffer,
) -> Result<Target, RenderError> {
    let color = rec.target("color", wgpu::TextureFormat::Rgba16Float)?;
    rec.fullscreen(
        "surface",
        Program {
            file: "effects/surface.wgsl",
            entry_point: "fs_main",
            switches: vec![
                ("WITH_PLAIN", styles.iter().any(|s| s.technique == PLAIN)),
                ("WITH_GOOCH", styles.iter().any(|s| s.technique == GOOCH)),
                ("WITH_EDGES", edge_map.is_some()),
            ],
        },
        &[
            Input::Texture(&gbuffer.geometry),
            Input::Texture(&gbuffer.base_color),
            // Unread without edges: any texture of its kind.
            Input::Texture(edge_map.unwrap_or(&gbuffer.geometry)),
            Input::Storage(surface_styles),
            Input::Storage(edge_styles),
        ],
        &[&color],
        Some(&gbuffer.depth),
    )?;
    Ok(color)
}
