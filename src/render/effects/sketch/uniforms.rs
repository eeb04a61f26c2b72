//! What the shader of sketches reads, made from a style.

use encase::ShaderType;
use glam::{UVec4, Vec2, Vec3, Vec4};

use crate::render::base::noise::TILE_CELLS;
use crate::render::passes::moved_edges::MovementUniform;
use crate::render::passes::offset_field::FieldUniform;
use crate::style;
use crate::style::sketch::{MAX_OFFSET, MAX_PASSES, Noise};

/// Farthest that anything is fetched from, px.
const MAX_REACH: f32 = 128.0;

/// How far lines are smudged, reference pixels.
const SMUDGED: f32 = 20.0;

/// Twin of `Pass` in `shaders/effects/sketch.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub(super) struct PassUniform {
    matrix: Vec4,
    color: Vec3,
    has_color: u32,
    width: f32,
    opacity: f32,
}

/// Twin of `Sketch` in `shaders/effects/sketch.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub(super) struct SketchUniform {
    passes: [PassUniform; MAX_PASSES],
    fill_matrix: Vec4,
    pigment: Vec3,
    object_color: f32,
    smudge_color: Vec3,
    smudge: f32,
    turn: Vec2,
    stroke_width: f32,
    strokes: f32,
    opacity: f32,
    pressure: f32,
    grain: f32,
    soft: f32,
    grain_size: f32,
    roughness: f32,
    pixels_per_reference: f32,
    line_scale: f32,
    fill_scale: f32,
    count: u32,
    shows_fill: u32,
}

/// Twin of `SketchObject` in `shaders/effects/sketch.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub(super) struct SketchObject {
    /// The middle of the object, px.
    #[shader(align(16))]
    pub(super) middle: Vec2,
}

/// From noise to offsets in reference pixels, as a style asks for them.
fn offsets(sketch: &style::Sketch, matrix: style::Matrix) -> style::Matrix {
    matrix.scaled(sketch.wander.amount, MAX_OFFSET)
}

/// How far lines and colors are off at most, px: three times what they are off on average, in whole steps, so that a
/// little more or less does not change it.
pub(super) fn reaches(sketch: &style::Sketch, scale: f32) -> [f32; 2] {
    let passes = sketch.pass.iter().take(sketch.passes as usize);
    let rms = |matrix: style::Matrix| offsets(sketch, matrix).rms() * scale;
    let lines = passes.map(|pass| rms(pass.matrix)).fold(0.0, f32::max);
    let fill = if sketch.fill.show { rms(sketch.fill.matrix) } else { 0.0 };
    let rough = rough(sketch, scale);
    let whole = |far: f32| ((far / 2.0).ceil() * 2.0).clamp(4.0, MAX_REACH);
    [whole(3.0 * lines + rough), whole(3.0 * fill + rough)]
}

/// By how much grains are off at most, px.
fn rough(sketch: &style::Sketch, scale: f32) -> f32 {
    2.0 * sketch.grain.roughness * scale
}

/// How far lines are smudged, px; 0: they are not.
pub(super) fn smudged(sketch: &style::Sketch, scale: f32) -> f32 {
    if sketch.grain.smudge > 0.0 { SMUDGED * scale } else { 0.0 }
}

/// Factor of the widths of a pass.
pub(super) fn width(pass: &style::sketch::Pass) -> f32 {
    pass.relative_width
}

/// How a pass moves lines; `component`: which noise of a texel it has.
pub(super) fn movement(sketch: &style::Sketch, number: usize, scale: f32, component: u32) -> MovementUniform {
    let pass = &sketch.pass[number.min(MAX_PASSES - 1)];
    MovementUniform {
        matrix: rows(sketch, pass.matrix, scale),
        width: width(pass),
        margin: rough(sketch, scale),
        pressure: sketch.wander.pressure,
        component,
    }
}

/// From noise to offsets, px, by rows.
fn rows(sketch: &style::Sketch, matrix: style::Matrix, scale: f32) -> Vec4 {
    Vec4::from_array(offsets(sketch, matrix).numbers()) * scale
}

/// Periods of a tile of noise per px, for waves so long (reference pixels): noise of one cell is as long as a wave.
fn tile_scale(wave: f32, scale: f32) -> f32 {
    1.0 / (TILE_CELLS as f32 * wave * scale)
}

/// How far surfaces are enlarged, px.
pub(super) fn enlarged(sketch: &style::Sketch, scale: f32) -> f32 {
    sketch.wander.enlarge * scale
}

/// What finding noise depends on; `scale`: pixels per reference pixel.
pub fn field(sketch: &style::Sketch, scale: f32) -> FieldUniform {
    let wander = &sketch.wander;
    let seed = |purpose: u32, own: u32| {
        wander.seed.wrapping_mul(0x9e37_79b1)
            ^ own.wrapping_mul(0x85eb_ca6b)
            ^ purpose.wrapping_mul(0xc2b2_ae35)
    };
    let seeds: [u32; MAX_PASSES] = std::array::from_fn(|i| seed(1, sketch.pass[i].seed));
    let [a, b, c, d, e, f, g, h] = seeds;
    FieldUniform {
        line_wave: wander.wave * wander.wave_scale * scale,
        fill_wave: sketch.fill.wave * wander.wave_scale * scale,
        detail: wander.detail,
        control: wander.anchor as u32,
        turbulent: u32::from(wander.noise == Noise::Turbulence),
        fill_seed: seed(2, 0),
        passes: sketch.passes,
        pixels_per_reference: scale,
        seeds: [UVec4::new(a, b, c, d), UVec4::new(e, f, g, h)],
        tile_scale: tile_scale(wander.wave, scale),
    }
}

impl SketchUniform {
    /// Of a style; `scale`: pixels per reference pixel.
    pub(super) fn new(sketch: &style::Sketch, scale: f32) -> Self {
        let style::Sketch { wander, passes, fill, grain, .. } = sketch;
        let pass = |pass: &style::sketch::Pass| PassUniform {
            matrix: rows(sketch, pass.matrix, scale),
            color: pass.color.unwrap_or_default().to_linear(),
            has_color: u32::from(pass.color.is_some()),
            width: width(pass),
            opacity: pass.opacity,
        };
        let ink = sketch.pass[0].color.unwrap_or(fill.color);
        Self {
            passes: std::array::from_fn(|number| pass(&sketch.pass[number])),
            fill_matrix: rows(sketch, fill.matrix, scale),
            pigment: fill.color.to_linear(),
            object_color: fill.object_color,
            smudge_color: ink.to_linear(),
            smudge: grain.smudge,
            turn: Vec2::from_angle(fill.angle.to_radians()),
            stroke_width: fill.stroke_width * scale,
            strokes: fill.strokes,
            opacity: fill.opacity,
            pressure: wander.pressure,
            grain: grain.amount,
            soft: grain.soft,
            grain_size: grain.size * scale,
            roughness: grain.roughness * scale,
            pixels_per_reference: scale,
            line_scale: tile_scale(wander.wave, scale),
            fill_scale: tile_scale(fill.wave, scale),
            count: *passes,
            shows_fill: u32::from(fill.show),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::{Matrix, Style};

    fn sketch(matrix: Matrix, amount: f32) -> style::Sketch {
        let mut sketch = style::Sketch::default();
        (sketch.pass[0].matrix, sketch.fill.matrix) = (matrix, Matrix::ZERO);
        sketch.wander.amount = amount;
        sketch
    }

    #[test]
    fn what_is_no_number_or_too_great_is_held_back() {
        for wrong in [f32::NAN, f32::INFINITY, -1e30] {
            let mut style = Style::default();
            let sketch = &mut style.sketch;
            (sketch.pass[0].matrix, sketch.wander.amount) = (Matrix([[wrong; 2]; 2]), wrong);
            sketch.wander.wave = wrong;
            sketch.grain.size = wrong;
            sketch.fill.wave = wrong;
            let sketch = style.clamped().sketch;
            let uniform = SketchUniform::new(&sketch, 1.0);
            let [lines, fill] = reaches(&sketch, 1.0);
            assert!(uniform.passes[0].matrix.abs().max_element() <= MAX_OFFSET, "{wrong}");
            assert!(uniform.line_scale > 0.0 && uniform.line_scale.is_finite(), "{wrong}");
            assert!((4.0..=MAX_REACH).contains(&lines) && (4.0..=MAX_REACH).contains(&fill), "{wrong}");
            assert!(field(&sketch, 1.0).line_wave >= 8.0);
        }
    }

    #[test]
    fn lines_are_looked_for_as_far_as_offsets_go() {
        let [small, large] = [1.0, 2.0].map(|amount| sketch(Matrix([[3.0, 0.0], [0.0, 3.0]]), amount));
        assert_eq!((reaches(&small, 1.0), reaches(&large, 1.0)), ([10.0, 4.0], [18.0, 4.0]));
        assert_eq!(reaches(&small, 2.0), reaches(&large, 1.0));
        assert_eq!(SketchUniform::new(&small, 2.0).passes[0].matrix, Vec4::new(6.0, 0.0, 0.0, 6.0));
    }
}
