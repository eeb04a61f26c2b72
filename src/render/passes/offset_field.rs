//! The noise that says where lines and colors of a sketch go: see `shaders/passes/offset_field.wgsl`.
//!
//! ```text
//! edge map ─────────────────────────────► noise of each line, where it runs
//! geometry ─► blocks ─► nearest surface ─► noise of each surface, for blocks in it and around
//! ```

use encase::ShaderType;
use glam::{Mat4, UVec4, Vec2, Vec3};

use super::gbuffer::GBuffer;
use super::line_pixels::ListedLines;
use crate::gpu::{ArrayBuffer, Program, Recorder, Target, UniformBuffer, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::noise::{fine_waves, mixed_bits, waves};

/// Pixels per side of a block, as in `passes/offset_field.wgsl`.
pub const BLOCK: u32 = 4;
/// Most passes of one target, two halves each.
const PASSES_PER_TEXEL: u32 = 4;
/// Blocks per side of a workgroup.
const GROUP: u32 = 8;

const HALVES: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
const INDEX: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// Twin of `Field` in `shaders/passes/offset_field.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct FieldUniform {
    /// Length of a wave of lines, px.
    pub line_wave: f32,
    /// Length of a wave of colors, px.
    pub fill_wave: f32,
    /// Share of the finer wave, 0 to 1.
    pub detail: f32,
    /// What controls the noise, as in [`crate::style::sketch::Anchor`].
    pub control: u32,
    /// 1: with kinks.
    pub turbulent: u32,
    /// Number of the noise of colors.
    pub fill_seed: u32,
    /// How often lines are drawn, 1 to 8.
    pub passes: u32,
    /// Pixels per reference pixel.
    pub pixels_per_reference: f32,
    /// Numbers of their noise.
    pub seeds: [UVec4; 2],
    /// Periods of the tile of noise per px, for lines that noise of the picture moves.
    pub tile_scale: f32,
}

/// Twin of `FieldObject` in `shaders/passes/offset_field.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuFieldObject {
    /// View space to the object's axes about its middle, scene units.
    pub from_view: Mat4,
    /// Told apart by it, where objects are.
    pub seed: u32,
}

/// A place that has noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoisePlace {
    /// View space.
    pub at: Vec3,
    /// Width of a pixel there, scene units.
    pub pixel: f32,
    /// How much longer than on paper a line is there along itself, 1 to 4.
    pub foreshortening: f32,
}

impl FieldUniform {
    /// The noise of a pass of lines at a place on an object that no other one touches there, where nothing but the place controls it:
    /// twin of `noise_at`.
    pub fn line_noise(&self, object: &GpuFieldObject, place: &NoisePlace, pass: usize) -> Vec2 {
        let seed = self.seeds.iter().flat_map(|four| four.to_array()).nth(pass).unwrap_or_default();
        let (own, turbulent) = (mixed_bits(seed ^ object.seed), self.turbulent == 1);
        let at = object.from_view.transform_point3(place.at);
        let length = self.line_wave * place.pixel * place.foreshortening;
        waves(at, length, own, turbulent) + self.detail * fine_waves(at, 0.25 * length, own, turbulent)
    }
}

/// What noise is asked for with, on the device.
#[derive(Clone, Copy)]
pub struct FieldBuffers<'a> {
    /// Which noise.
    pub field: &'a UniformBuffer<FieldUniform>,
    /// [`GpuFieldObject`] by object id.
    pub objects: &'a ArrayBuffer,
}

/// The noise of lines: undefined where none run.
#[derive(Debug, Clone)]
pub struct LineField {
    /// Of the first four passes.
    pub first: Target,
    /// Of the others; `None`: there are none.
    pub more: Option<Target>,
}

impl LineField {
    /// The texture that holds the noise of a pass, and which of the four noises of a texel that is.
    pub fn of_pass(&self, pass: usize) -> (&Target, u32) {
        let per_texel = PASSES_PER_TEXEL as usize;
        let target = self.more.as_ref().filter(|_| pass >= per_texel).unwrap_or(&self.first);
        (target, (pass % per_texel) as u32)
    }
}

/// What the noise of lines is that of.
#[derive(Clone, Copy)]
pub enum NoiseSource<'a> {
    /// Of their own place in space, on these surfaces.
    Lines(&'a GBuffer),
    /// Of the enlarged surfaces that their pixels show.
    Enlarged(&'a GBuffer),
    /// Of their place in the picture: a tile of noise.
    Tile(&'a wgpu::TextureView),
}

/// Finds the noise of lines, for so many passes.
///
/// # Errors
/// [`RenderError`].
pub fn line_field(
    rec: &mut Recorder<'_>,
    buffers: FieldBuffers<'_>,
    lines: ListedLines<'_>,
    source: NoiseSource<'_>,
    passes: u32,
) -> Result<LineField, RenderError> {
    let first = rec.target("noise of lines", HALVES)?;
    let more = if passes > PASSES_PER_TEXEL { Some(rec.target("noise of lines", HALVES)?) } else { None };
    let (entry_point, geometry, tiles) = match source {
        NoiseSource::Lines(gbuffer) => ("cs_lines", Some(&gbuffer.geometry), None),
        NoiseSource::Enlarged(gbuffer) => ("cs_enlarged", Some(&gbuffer.geometry), None),
        NoiseSource::Tile(tile) => ("cs_screen", None, Some(tile)),
    };
    let inputs = inputs! {
        field: buffers.field,
        field_objects: buffers.objects,
        geometry_tex: geometry,
        edge_map_tex: lines.edges,
        spine_tex: lines.spines,
        tiles: tiles,
        list: lines.pixels.count(),
        listed_pixels: lines.pixels.buffer(),
        line_field_tex: &first,
        more_line_field_tex: more.as_ref(),
    };
    let program = Program::new("passes/offset_field.wgsl", entry_point);
    rec.compute("noise of lines", &program, &inputs, lines.pixels.count())?;
    Ok(LineField { first, more })
}

/// Finds for each block the nearest surface, as far as it is within `distance` (px).
///
/// # Errors
/// [`RenderError`].
pub fn nearest_surfaces(
    rec: &mut Recorder<'_>,
    geometry: &Target,
    distance: f32,
) -> Result<Target, RenderError> {
    let blocks = rec.size().map(|side| side.div_ceil(BLOCK));
    let groups = blocks.map(|side| side.div_ceil(GROUP));
    let program = |entry_point, switches| Program { file: "passes/offset_field.wgsl", entry_point, switches };
    let mut near = rec.target_of("nearest surfaces", INDEX, blocks)?;
    let inputs = inputs! { geometry_tex: geometry, found_tex: &near };
    rec.compute("nearest surfaces", &program("cs_blocks", vec![]), &inputs, groups)?;
    let mut step = ((distance / BLOCK as f32).ceil() as u32).clamp(1, 32).next_power_of_two();
    while step > 0 {
        let next = rec.target_of("nearest surfaces", INDEX, blocks)?;
        let inputs = inputs! { near_tex: &near, found_tex: &next };
        let names = ["STEP_32", "STEP_16", "STEP_8", "STEP_4", "STEP_2", "STEP_1"];
        let switches = names.into_iter().zip([32, 16, 8, 4, 2, 1].map(|size| step == size)).collect();
        rec.compute("nearest surfaces", &program("cs_flood", switches), &inputs, groups)?;
        near = next;
        step /= 2;
    }
    Ok(near)
}

/// Finds the noise of the surfaces that are nearest to blocks.
///
/// # Errors
/// [`RenderError`].
pub fn fill_field(
    rec: &mut Recorder<'_>,
    buffers: FieldBuffers<'_>,
    geometry: &Target,
    nearest: &Target,
) -> Result<Target, RenderError> {
    let blocks = nearest.size();
    let fill = rec.target_of("noise of surfaces", HALVES, blocks)?;
    let inputs = inputs! {
        field: buffers.field,
        field_objects: buffers.objects,
        geometry_tex: geometry,
        near_tex: nearest,
        fill_field_tex: &fill,
    };
    let program = Program::new("passes/offset_field.wgsl", "cs_fill");
    rec.compute("noise of surfaces", &program, &inputs, blocks.map(|side| side.div_ceil(GROUP)))?;
    Ok(fill)
}
