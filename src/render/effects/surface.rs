//! The surface techniques (blank, plain, unlit, Gooch, toon, halftone), shaded from the G-buffer in one full-screen pass:
//! the scene is traversed once, where the edge-enhancement paper's pipeline traverses it twice.

use encase::ShaderType;
use glam::{DMat4, Vec3};

use super::gooch::GoochUniform;
use super::halftone::{self, HalftoneInputs};
use super::section::section;
use super::toon::{self, ToonBuffers, Toons};
use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::RenderError;
use crate::render::passes::gbuffer::GBuffer;
use crate::style::{Style, Technique};

/// Twin of `SurfaceStyle` in `shaders/effects/surface.wgsl`; by default paper only.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct SurfaceUniform {
    gooch: GoochUniform,
    highlight: Vec3,
    ambient: f32,
    technique: u32,
}

// As in `shaders/effects/surface.wgsl`.
const BLANK: u32 = 0;
const PLAIN: u32 = 1;
const UNLIT: u32 = 2;
const GOOCH: u32 = 3;
const TOON: u32 = 4;
const HALFTONE: u32 = 5;
const DESIGNATED: u32 = 6;

impl SurfaceUniform {
    /// Of an object that lies at `world_from_local`.
    pub fn new(style: &Style, world_from_local: &DMat4) -> Self {
        Self {
            gooch: match style.technique {
                Technique::Gooch => GoochUniform::new(&style.gooch, world_from_local),
                _ => GoochUniform::default(),
            },
            highlight: style.blueprint.highlight.to_linear(),
            ambient: style.plain.ambient.clamp(0.0, 1.0),
            technique: match style.technique {
                Technique::Blank => BLANK,
                // Only what is designated is a surface.
                Technique::Blueprint => DESIGNATED,
                Technique::Plain => PLAIN,
                Technique::Unlit => UNLIT,
                Technique::Gooch => GOOCH,
                Technique::Toon => TOON,
                Technique::Halftone => HALFTONE,
            },
        }
    }
}

/// How all visible objects are shaded, and where the device has it.
#[derive(Clone, Copy)]
pub struct Shading<'a> {
    /// By object id.
    pub surfaces: &'a [SurfaceUniform],
    /// `surfaces` on the device.
    pub surface_styles: &'a wgpu::Buffer,
    /// Those that are toons.
    pub toons: &'a Toons,
    /// `toons` on the device.
    pub toon_buffers: ToonBuffers<'a>,
    /// See `shaders/common/light.wgsl`; `None` when no light throws shadows.
    pub shadow_mask: Option<&'a Target>,
    /// See [`toon::cartoon_map`]; `None` when no object asks for it.
    pub cartoon_map: Option<&'a Target>,
    /// What halftones need.
    pub halftones: HalftoneInputs<'a>,
    /// The caps of a section by object id; `None` when there are none.
    pub caps: Option<&'a wgpu::Buffer>,
    /// Whether materials blend: then colours are as opaque as they are.
    pub blends: bool,
}

/// Linear colour times opacity, and opacity. Nothing where there is no object.
///
/// # Errors
/// [`RenderError`].
pub fn surface(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    shading: &Shading<'_>,
) -> Result<Target, RenderError> {
    let color = rec.target("color", wgpu::TextureFormat::Rgba16Float)?;
    let uses = |technique| shading.surfaces.iter().any(|s| s.technique == technique);
    let mut switches = vec![
        ("WITH_SHADOWS", shading.shadow_mask.is_some()),
        ("WITH_OPACITY", shading.blends),
        ("WITH_PLAIN", uses(PLAIN)),
        ("WITH_GOOCH", uses(GOOCH)),
        ("WITH_METAL", shading.surfaces.iter().any(|s| s.gooch.has_metal())),
    ];
    switches.extend(toon::switches(&shading.toons.styles));
    switches.extend(halftone::switches(shading.halftones.styles));
    rec.fullscreen(
        "surface",
        Program { file: "effects/surface.wgsl", entry_point: "fs_main", switches },
        &inputs! {
            geometry_tex: &gbuffer.geometry,
            region_tex: &gbuffer.region,
            base_color_tex: &gbuffer.base_color,
            shadow_mask_tex: shading.shadow_mask,
            surface_styles: shading.surface_styles,
            toon_styles: shading.toon_buffers.styles,
            toon_bands: shading.toon_buffers.bands,
            cartoon_map_tex: shading.cartoon_map,
            halftone_styles: shading.halftones.style_buffer,
            thresholds: shading.halftones.maps.thresholds(),
            threshold_sampler: shading.halftones.maps.sampler(),
            calibration: shading.halftones.maps.calibration(),
            coordinates_tex: shading.halftones.coordinates,
        },
        &[&color],
        Some(&gbuffer.depth),
    )?;
    if let Some(caps) = shading.caps {
        section(rec, gbuffer, caps, &color)?;
    }
    Ok(color)
}
