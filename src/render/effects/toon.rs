//! Toon shading: what the surface pass needs for it, and the cartoon map (edge-enhancement paper, section 5, Fig. 9).
//!
//! The paper draws the scene in toon shades, keeps their colors as a texture and averages neighbors there. Here that
//! texture, the cartoon map, holds which band a pixel is of, not its color: a mean of bands leaves the images on a
//! surface sharp, and one byte per pixel is cheap to read nine times.

use encase::ShaderType;
use glam::{Vec3, Vec4};

use super::technique::{Shaded, Styled, SurfaceTechnique};
use crate::gpu::{ArrayBuffer, Gpu, Inputs, Program, RecordTexture, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::stage::Stage;
use crate::render::base::style_images::StyleImages;
use crate::render::passes::gbuffer::GBuffer;
use crate::scene::Texture;
use crate::style::toon::{MAX_RAMP, Smoothing};
use crate::style::{Technique, Toon};

/// 1 + band, 512: highlight, 1024: rim; 0 where no object asks for it.
const BANDS: wgpu::TextureFormat = wgpu::TextureFormat::R16Uint;

/// Twin of `ToonStyle` in `shaders/effects/toon.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuToonStyle {
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
    smoothing: u32,
}

// As in `shaders/effects/toon.wgsl`.
const NEAREST: u32 = 1;
const CARTOON_MAP: u32 = 2;
const ANALYTIC: u32 = 3;

/// Beyond any cosine.
const NOWHERE: f32 = 2.0;

impl GpuToonStyle {
    fn new(toon: &Toon, first_band: u32, bands: u32) -> Self {
        let start = toon.start;
        // A ramp that ends where it begins is one step there.
        let range = (toon.end - start).max(1e-3);
        let angle = toon.highlight_size.to_radians();
        Self {
            rim_color: toon.rim_color.to_linear(),
            rim: toon.rim,
            highlight: toon.highlight,
            highlight_from: if toon.highlight > 0.0 { angle.cos() } else { NOWHERE },
            rim_to: if toon.rim > 0.0 { toon.rim_width } else { -NOWHERE },
            tint: toon.object_color,
            first_band,
            bands,
            start,
            bands_per_unit: bands as f32 / range,
            smoothing: match toon.smoothing {
                Smoothing::Nearest => NEAREST,
                Smoothing::CartoonMap => CARTOON_MAP,
                Smoothing::Analytic => ANALYTIC,
            },
        }
    }

    /// Whether the borders of its bands are smoothed by the cartoon map.
    pub fn has_cartoon_map(&self) -> bool {
        self.smoothing == CARTOON_MAP
    }
}

/// How all visible toons are shaded; empty when no object is a toon.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Toons {
    /// By object id.
    pub styles: Vec<GpuToonStyle>,
    /// The bands of all ramps, one after the other: linear colors from shadow to light.
    pub bands: Vec<Vec4>,
    /// Few differ, however many objects there are.
    ramps: Vec<PlacedRamp>,
}

/// An image as a ramp: linear colors along its longer side, from the left or the top, each the mean across the other side; at
/// most [`MAX_RAMP`].
struct RampColors(Vec<Vec4>);

fn ramp(image: &Texture) -> RampColors {
    let size = if image.width >= image.height { [MAX_RAMP, 1] } else { [1, MAX_RAMP] };
    RampColors(image.averaged(size))
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
    fn set(&mut self, object: usize, count: usize, toon: &Toon, images: &StyleImages) {
        let known = self.ramps.iter().find(|known| known.toon.has_ramp_of(toon));
        let [first_band, bands] = match known {
            Some(known) => [known.first_band, known.bands],
            None => self.place_ramp(toon, images),
        };
        self.styles.resize(count, GpuToonStyle::default());
        if let Some(style) = self.styles.get_mut(object) {
            *style = GpuToonStyle::new(toon, first_band, bands);
        }
    }

    fn place_ramp(&mut self, toon: &Toon, images: &StyleImages) -> [u32; 2] {
        let first_band = self.bands.len() as u32;
        match toon.ramp_image().and_then(|path| images.made(path, ramp)) {
            Some(ramp) => self.bands.extend(&ramp.0),
            None => self.bands.extend(toon.colors().iter().map(|color| color.to_linear().extend(1.0))),
        }
        let bands = self.bands.len() as u32 - first_band;
        self.ramps.push(PlacedRamp { toon: toon.clone(), first_band, bands });
        [first_band, bands]
    }
}

/// Toon shading on the device.
pub struct ToonShading {
    styles: ArrayBuffer,
    bands: RecordTexture,
    cartoon_map: Stage<MapKey, Target>,
    /// That of the layer that is shaded; `None` when no object asks for it.
    map: Option<Target>,
}

/// What the cartoon map of a layer depends on.
#[derive(Clone, PartialEq)]
struct MapKey {
    gbuffer: u64,
    shadows: Option<u64>,
    toons: Toons,
    uniform: FrameUniform,
}

impl SurfaceTechnique for ToonShading {
    const TECHNIQUE: Technique = Technique::Toon;

    type Styles = Toons;
    type Shared = ();

    fn shared(_gpu: &Gpu) {}

    fn new(gpu: &Gpu) -> Self {
        Self {
            styles: ArrayBuffer::new(gpu, "toon styles"),
            bands: RecordTexture::new(gpu, "toon bands"),
            cartoon_map: Stage::default(),
            map: None,
        }
    }

    fn add(styles: &mut Toons, object: &Styled<'_>) {
        if object.style.technique == Technique::Toon {
            styles.set(object.id, object.count, &object.style.toon, object.images);
        }
    }

    fn switches(toons: &Toons) -> Vec<(&'static str, bool)> {
        let any = |smoothing| toons.styles.iter().any(|s| s.smoothing == smoothing);
        vec![
            ("WITH_TOON", toons.styles.iter().any(|s| s.smoothing != 0)),
            ("WITH_NEAREST", any(NEAREST)),
            ("WITH_CARTOON_MAP", any(CARTOON_MAP)),
            ("WITH_ANALYTIC", any(ANALYTIC)),
        ]
    }

    fn upload(&mut self, (): &mut (), gpu: &Gpu, toons: &Toons) -> Result<(), RenderError> {
        if !toons.styles.is_empty() {
            self.styles.write(gpu, &toons.styles);
            self.bands.write(gpu, &toons.bands)?;
        }
        Ok(())
    }

    fn begin(
        &mut self,
        rec: &mut Recorder<'_>,
        (): &mut (),
        toons: &Toons,
        layer: &Shaded<'_>,
    ) -> Result<(), RenderError> {
        let is_asked_for = toons.styles.iter().any(GpuToonStyle::has_cartoon_map);
        let styles = &self.styles;
        let mut draw = || cartoon_map(rec, layer.gbuffer, styles, layer.shadow_mask.map(|(mask, _)| mask));
        self.map = match layer.revision {
            Some(gbuffer) if is_asked_for => {
                let shadows = layer.shadow_mask.map(|(_, revision)| revision);
                let key = MapKey { gbuffer, shadows, toons: toons.clone(), uniform: *layer.uniform };
                Some(self.cartoon_map.run(key, |_| draw())?.value)
            }
            None if is_asked_for => Some(draw()?),
            _ => None,
        };
        if layer.revision.is_some() {
            rec.note("cartoon map", self.map.as_ref());
        }
        Ok(())
    }

    fn bind<'a>(&'a self, (): &'a (), inputs: &mut Inputs<'a>) {
        inputs.set("toon_styles", &self.styles);
        inputs.set("toon_bands", self.bands.target());
        inputs.set("cartoon_map_tex", self.map.as_ref());
    }

    fn runs(&self) -> Option<(&'static str, u64)> {
        Some(("cartoon map", self.cartoon_map.runs()))
    }
}

/// The cartoon map: which band each pixel is of. Nothing where there is no object that asks for it.
///
/// # Errors
/// [`RenderError`].
fn cartoon_map(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    toon_styles: &ArrayBuffer,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_runs_along_the_longer_side_and_is_averaged_across() {
        let rgba: Vec<u8> = [0_u8, 255, 0, 255, 255, 255].iter().flat_map(|v| [*v, *v, *v, 255]).collect();
        let image = |width, height| Texture { name: String::new(), width, height, rgba: rgba.clone().into() };
        let ramp = |width, height| ramp(&image(width, height)).0.iter().map(|c| c.x).collect::<Vec<_>>();
        assert_eq!(ramp(6, 1), [0.0, 1.0, 0.0, 1.0, 1.0, 1.0]);
        assert_eq!(ramp(3, 2), [0.5, 1.0, 0.5]);
        assert_eq!(ramp(2, 3), [0.5, 0.5, 1.0]);
    }
}
