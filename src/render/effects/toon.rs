//! Toon shading: what the surface pass needs for it, and the cartoon map (edge-enhancement paper, section 5, Fig. 9).
//!
//! The paper draws the scene in toon shades, keeps their colours as a texture and averages neighbours there. Here that
//! texture, the cartoon map, holds which band a pixel is of, not its colour: a mean of bands leaves the images on a
//! surface sharp, and one byte per pixel is cheap to read nine times.

use encase::ShaderType;
use glam::{Vec3, Vec4};

use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::RenderError;
use crate::render::passes::gbuffer::GBuffer;
use crate::render::style_images::StyleImages;
use crate::style::Toon;
use crate::style::toon::Border;

/// 1 + band, 512: highlight, 1024: rim; 0 where no object asks for it.
const BANDS: wgpu::TextureFormat = wgpu::TextureFormat::R16Uint;

/// Twin of `ToonStyle` in `shaders/effects/toon.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct ToonUniform {
    rim_color: Vec3,
    rim: f32,
    highlight: f32,
    highlight_from: f32,
    rim_to: f32,
    tint: f32,
    first_band: u32,
    bands: u32,
    start: f32,
    bands_per_unit: f32,
    border: u32,
}

// As in `shaders/effects/toon.wgsl`.
const NEAREST: u32 = 1;
const CARTOON_MAP: u32 = 2;
const ANALYTIC: u32 = 3;

/// Beyond any cosine.
const NOWHERE: f32 = 2.0;

impl ToonUniform {
    fn new(toon: &Toon, first_band: u32, bands: u32) -> Self {
        let start = toon.start.clamp(-1.0, 1.0);
        // A ramp that ends where it begins is one step there.
        let range = (toon.end.clamp(-1.0, 1.0) - start).max(1e-3);
        let angle = toon.highlight_size.clamp(1.0, 60.0).to_radians();
        Self {
            rim_color: toon.rim_color.to_linear(),
            rim: toon.rim.clamp(0.0, 1.0),
            highlight: toon.highlight.clamp(0.0, 1.0),
            highlight_from: if toon.highlight > 0.0 { angle.cos() } else { NOWHERE },
            rim_to: if toon.rim > 0.0 { toon.rim_width.clamp(0.0, 1.0) } else { -NOWHERE },
            tint: toon.tint.clamp(0.0, 1.0),
            first_band,
            bands,
            start,
            bands_per_unit: bands as f32 / range,
            border: match toon.border {
                Border::Nearest => NEAREST,
                Border::CartoonMap => CARTOON_MAP,
                Border::Analytic => ANALYTIC,
            },
        }
    }

    /// Whether the borders of its bands are smoothed by the cartoon map.
    pub fn has_cartoon_map(&self) -> bool {
        self.border == CARTOON_MAP
    }
}

/// How all visible toons are shaded; empty when no object is a toon.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Toons {
    /// By object id.
    pub styles: Vec<ToonUniform>,
    /// The bands of all ramps, one after the other: linear colours from shadow to light.
    pub bands: Vec<Vec4>,
    /// Few differ, however many objects there are.
    ramps: Vec<PlacedRamp>,
}

/// A ramp among [`Toons::bands`].
#[derive(Debug, Clone, PartialEq)]
struct PlacedRamp {
    /// The first toon that has it.
    toon: Toon,
    first_band: u32,
    bands: u32,
}

impl Toons {
    /// Makes one of `count` objects a toon.
    pub fn set(&mut self, object: usize, count: usize, toon: &Toon, images: &StyleImages) {
        let known = self.ramps.iter().find(|known| known.toon.has_ramp_of(toon));
        let [first_band, bands] = match known {
            Some(known) => [known.first_band, known.bands],
            None => self.place_ramp(toon, images),
        };
        self.styles.resize(count, ToonUniform::default());
        if let Some(style) = self.styles.get_mut(object) {
            *style = ToonUniform::new(toon, first_band, bands);
        }
    }

    fn place_ramp(&mut self, toon: &Toon, images: &StyleImages) -> [u32; 2] {
        let first_band = self.bands.len() as u32;
        match toon.ramp_image().and_then(|path| images.ramp(path)) {
            Some(image) => self.bands.extend(image.iter()),
            None => self.bands.extend(toon.colors().iter().map(|color| color.to_linear().extend(1.0))),
        }
        let bands = self.bands.len() as u32 - first_band;
        self.ramps.push(PlacedRamp { toon: toon.clone(), first_band, bands });
        [first_band, bands]
    }
}

/// The toons on the device.
#[derive(Clone, Copy)]
pub struct ToonBuffers<'a> {
    /// [`Toons::styles`].
    pub styles: &'a wgpu::Buffer,
    /// [`Toons::bands`].
    pub bands: &'a wgpu::Buffer,
}

/// Which features of the shader any object uses; `styles` are those of all visible objects, or none.
pub fn switches(styles: &[ToonUniform]) -> [(&'static str, bool); 4] {
    let any = |border| styles.iter().any(|s| s.border == border);
    [
        ("WITH_TOON", styles.iter().any(|s| s.border != 0)),
        ("WITH_NEAREST", any(NEAREST)),
        ("WITH_CARTOON_MAP", any(CARTOON_MAP)),
        ("WITH_ANALYTIC", any(ANALYTIC)),
    ]
}

/// The cartoon map: which band each pixel is of. Nothing where there is no object that asks for it.
///
/// # Errors
/// [`RenderError`].
pub fn cartoon_map(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    toon_styles: &wgpu::Buffer,
    shadow_mask: Option<&Target>,
) -> Result<Target, RenderError> {
    let map = rec.target("cartoon map", BANDS)?;
    rec.fullscreen(
        "cartoon map",
        Program {
            file: "effects/toon.wgsl",
            entry_point: "fs_cartoon_map",
            switches: vec![("WITH_SHADOWS", shadow_mask.is_some())],
        },
        &inputs! {
            geometry_tex: &gbuffer.geometry,
            shadow_mask_tex: shadow_mask,
            toon_styles: toon_styles,
        },
        &[&map],
        Some(&gbuffer.depth),
    )?;
    Ok(map)
}
