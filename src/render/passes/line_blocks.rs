//! Blocks of pixels, and in which of them lines run: what looks for lines looks here first.

use crate::gpu::{Program, RecordList, Recorder, Target, inputs};
use crate::render::base::error::RenderError;

/// Pixels per side of a block, as in `shaders/common/line_block.wgsl`.
pub const LINE_BLOCK: u32 = 4;
/// Blocks per side of a workgroup, as in `shaders/passes/{line_blocks,near_lines}.wgsl`.
const GROUP: u32 = 16;

const BLOCKS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// How many blocks there are in a picture, across and down.
pub(super) fn block_count(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(LINE_BLOCK))
}

/// How many workgroups work through these blocks, across and down.
pub(super) fn block_groups(size: [u32; 2]) -> [u32; 2] {
    block_count(size).map(|side| side.div_ceil(GROUP))
}

/// Finds the pixels of each block in which lines run; see `shaders/common/line_block.wgsl`. They are listed too, if there is a list.
///
/// # Errors
/// [`RenderError`].
pub fn line_blocks(
    rec: &mut Recorder<'_>,
    spines: &Target,
    list: Option<&RecordList>,
) -> Result<Target, RenderError> {
    let size = rec.size();
    let blocks = rec.target_of("blocks of lines", BLOCKS, block_count(size))?;
    let inputs = inputs! {
        spine_tex: spines,
        finding_tex: &blocks,
        keeping: list.map(RecordList::count),
        kept_pixels: list.map(RecordList::buffer),
    };
    let entry_point = if list.is_some() { "cs_list" } else { "cs_find" };
    let program = Program::new("passes/line_blocks.wgsl", entry_point);
    rec.compute("blocks of lines", &program, &inputs, block_groups(size))?;
    Ok(blocks)
}
