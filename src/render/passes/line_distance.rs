//! Which line each pixel belongs to: an exact distance transform whose cost does not depend on the lines' width.

use super::line_blocks::{block_count, block_groups, line_blocks};
use crate::gpu::{ArrayBuffer, Program, Recorder, Target, inputs};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::error::RenderError;

const INDEX: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
/// Columns or rows per workgroup, as in `passes/line_distance.wgsl`.
const GROUP: u32 = 64;

/// Lines with a greater radius than this (px) reach farther than to the next pixel, or to that behind it.
const NARROW: f32 = 0.95;
const NARROW_BY_TWO: f32 = 1.95;

/// How the lines that reach a pixel are found.
#[derive(Debug, Clone)]
pub enum LineDistance {
    /// All lines are thin: by looking at the spines in the neighboring pixels.
    Narrow {
        /// Where lines run.
        spines: Target,
        /// Not 0 for blocks of pixels that any of them can reach, see `passes/near_lines.wgsl`.
        near: Target,
        /// Whether they reach two pixels far.
        by_two: bool,
    },
    /// Per pixel the pixel of the edge map that holds its line, plus 1 (column in the lower 16 bits, row in the upper
    /// ones); 0: none.
    Wide {
        /// The line that reaches farthest beyond the pixel.
        farthest: Target,
        /// The nearest spine; `None` where all lines are about equally wide, so that it is the same.
        nearest: Option<Target>,
    },
}

/// Finds the nearest spine of each pixel, as far as any is within `distance` (px); `radius` is a buffer for the greatest radius.
/// The result is as [`LineDistance::Wide`] describes.
///
/// # Errors
/// [`RenderError`].
pub fn nearest_lines(
    rec: &mut Recorder<'_>,
    spines: &Target,
    distance: f32,
    radius: &mut ArrayBuffer,
) -> Result<Target, RenderError> {
    radius.write(rec.gpu, &vec![distance]);
    transform(rec, spines, radius, true)
}

/// Finds the lines that reach each pixel from where spines run; `blocks` are those of [`line_blocks`], if they are known, `radius` is
/// a buffer for the greatest radius.
///
/// # Errors
/// [`RenderError`].
pub fn line_distance(
    rec: &mut Recorder<'_>,
    spines: &Target,
    blocks: Option<&Target>,
    widths: Widths,
    radius: &mut ArrayBuffer,
) -> Result<LineDistance, RenderError> {
    let by_two = widths.greatest_radius > NARROW;
    if !by_two || (widths.greatest_radius <= NARROW_BY_TWO && widths.are_moved && !widths.differ) {
        let size = rec.size();
        let near = rec.target_of("near lines", INDEX, block_count(size))?;
        let blocks = blocks.map_or_else(|| line_blocks(rec, spines, None), |blocks| Ok(blocks.clone()))?;
        let program = Program {
            file: "passes/near_lines.wgsl",
            entry_point: "cs_main",
            switches: vec![("NARROW_BY_TWO", by_two)],
        };
        let inputs = inputs! { block_tex: &blocks, near_tex: &near };
        rec.compute("near lines", &program, &inputs, block_groups(size))?;
        return Ok(LineDistance::Narrow { spines: spines.clone(), near, by_two });
    }
    radius.write(rec.gpu, &vec![widths.greatest_radius]);
    let farthest = transform(rec, spines, radius, false)?;
    let nearest = if widths.differ { Some(transform(rec, spines, radius, true)?) } else { None };
    Ok(LineDistance::Wide { farthest, nearest })
}

/// How wide lines are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Widths {
    /// Greatest distance from its spine at which a line has ink, px.
    pub greatest_radius: f32,
    /// Whether two differ so much that the thin one can be seen inside the wide one.
    pub differ: bool,
    /// Whether lines have been moved, so that none of them hides another that is nearer.
    pub are_moved: bool,
}

impl Widths {
    /// Those of the lines of these styles.
    pub fn of(styles: &[GpuEdgeStyle]) -> Self {
        let widths = styles.iter().flat_map(|style| {
            let thinnest = if style.varies() { 0.1 } else { 1.0 };
            style.drawn().flat_map(move |(_, line)| [line.width, line.width * thinnest])
        });
        let (least, most) =
            widths.fold((f32::INFINITY, 0.0_f32), |(least, most), width| (least.min(width), most.max(width)));
        Self {
            greatest_radius: styles.iter().map(GpuEdgeStyle::greatest_radius).fold(0.0, f32::max),
            differ: most - least > 2.0,
            are_moved: false,
        }
    }
}

fn transform(
    rec: &mut Recorder<'_>,
    spines: &Target,
    radius: &ArrayBuffer,
    nearest: bool,
) -> Result<Target, RenderError> {
    let columns = rec.target("line of column", INDEX)?;
    let found = rec.target("line of pixel", INDEX)?;
    let stack = rec.target("envelopes", INDEX)?;
    let [width, height] = rec.size();
    let inputs = inputs! {
        spine_tex: spines,
        greatest_radius: radius,
        column_tex: &columns,
        found_tex: &found,
        stack_tex: &stack,
    };
    let program = |entry_point| Program {
        file: "passes/line_distance.wgsl",
        entry_point,
        switches: vec![("NEAREST", nearest)],
    };
    rec.compute("line columns", &program("cs_columns"), &inputs, [width.div_ceil(GROUP), 1])?;
    rec.compute("line rows", &program("cs_rows"), &inputs, [height.div_ceil(GROUP), 1])?;
    Ok(found)
}
