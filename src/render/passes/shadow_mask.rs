//! The shadow mask: how much of each light that throws shadows reaches each pixel.

use encase::ShaderType;
use glam::{DMat4, Mat4, Vec2};

use super::gbuffer::GBuffer;
use crate::gpu::{ArrayBuffer, Gpu, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::light_view::LightView;
use crate::render::base::lights::MAX_SHADOWS;

/// A light per channel, 1: all of it reaches the pixel.
const MASK: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// One picture that a light sees; twin of `LightView` in `shaders/passes/shadow_mask.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct GpuLightView {
    light_from_view: Mat4,
    scale: Vec2,
    origin: Vec2,
    tile_min: Vec2,
    tile_max: Vec2,
    range: Vec2,
    texel: f32,
    is_central: u32,
}

/// Which pictures are of one light; twin of `ShadowLight` in `shaders/passes/shadow_mask.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuShadowLight {
    #[shader(align(16))]
    first: u32,
    count: u32,
    spread: f32,
}

impl GpuLightView {
    fn new(view: &LightView, view_from_world: &DMat4) -> Self {
        let (scale, origin) = view.texels();
        let [min, size] = view.tile.map(|[x, y]| Vec2::new(x as f32, y as f32));
        Self {
            light_from_view: (view.light_from_world * view_from_world.inverse()).as_mat4(),
            scale: scale.as_vec2(),
            origin: origin.as_vec2(),
            tile_min: min,
            tile_max: min + size - 1.0,
            range: Vec2::from_array(view.range.map(|d| d as f32)),
            texel: scale.abs().recip().max_element() as f32,
            is_central: u32::from(view.is_central),
        }
    }
}

/// Room for what the pass tells the device.
pub struct ShadowPass {
    lights: ArrayBuffer,
    views: ArrayBuffer,
}

impl ShadowPass {
    /// Nothing told yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { lights: ArrayBuffer::new(gpu, "shadow lights"), views: ArrayBuffer::new(gpu, "light views") }
    }

    /// Finds the shadows on everything visible. `maps`: for each light its pictures and the map that holds them;
    /// `spread`: tangent of the lights' radius.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer: &GBuffer,
        view_from_world: &DMat4,
        maps: &[(&[LightView], &Target)],
        spread: f32,
    ) -> Result<Option<Target>, RenderError> {
        if maps.is_empty() {
            return Ok(None);
        }
        let mut views: Vec<GpuLightView> = Vec::new();
        let mut lights = Vec::new();
        for (seen, _) in maps {
            lights.push(GpuShadowLight { first: views.len() as u32, count: seen.len() as u32, spread });
            views.extend(seen.iter().map(|v| GpuLightView::new(v, view_from_world)));
        }
        self.lights.write(rec.gpu, &lights);
        self.views.write(rec.gpu, &views);
        let mask = rec.target("shadow mask", MASK)?;
        let any_central = views.iter().any(|v| v.is_central == 1);
        let map = |i: usize| maps.get(i).map(|(_, map)| *map);
        rec.fullscreen(
            "shadow",
            Program {
                file: "passes/shadow_mask.wgsl",
                entry_point: "fs_main",
                switches: vec![
                    ("WITH_SECOND", maps.len() > 1),
                    ("WITH_THIRD", maps.len() > 2),
                    ("WITH_FOURTH", maps.len() > 3),
                    ("WITH_CENTRAL", any_central),
                    ("WITH_SOFT", spread > 0.0),
                ],
            },
            &inputs! {
                geometry_tex: &gbuffer.geometry,
                shadow_lights: &self.lights,
                light_views: &self.views,
                map_0: map(0),
                map_1: map(1),
                map_2: map(2),
                map_3: map(MAX_SHADOWS - 1),
            },
            &[&mask],
            Some(&gbuffer.depth),
        )?;
        Ok(Some(mask))
    }
}
