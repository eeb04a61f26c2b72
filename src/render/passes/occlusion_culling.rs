//! Occlusion culling: what lies behind large objects is not drawn, if its box tells.
//!
//! ```text
//! occluders drawn ─► farthest depth of each block of pixels ─► boxes of the rest against it ─► the rest drawn, unless hidden
//! ```
//!
//! Which objects are drawn first follows from the view alone, and nothing that is seen is left out: a picture does not depend on
//! those before.

use std::borrow::Cow;

use crate::gpu::{ArrayBuffer, Predicate, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::instances::{Batch, DrawCall, batches};
use crate::render::base::view::Extent;

/// Fewer draw calls are drawn faster than sifted.
const LEAST_CALLS: usize = 128;
/// Share of all triangles that occluders have.
const OCCLUDERS: f64 = 0.15;
/// Pixels per side of a block; twin of `BLOCK` in `shaders/passes/occlusion_culling.wgsl`.
const BLOCK: u32 = 8;
/// Blocks per side of a workgroup.
const GROUP: u32 = 8;
/// Draws in a row of workgroups; twin of `COLUMNS` there.
const COLUMNS: u32 = 1024;

/// Bits of floats.
const FARTHEST: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// Draw calls in two parts, each in their order.
pub struct Split<'a> {
    /// Those that hide most for their number of triangles.
    pub occluders: Cow<'a, [DrawCall]>,
    /// All others.
    pub rest: Vec<DrawCall>,
}

impl<'a> Split<'a> {
    /// Splits these calls; without a rest where culling does not pay or the device cannot do it.
    pub fn new(rec: &Recorder<'_>, calls: &'a [DrawCall]) -> Self {
        let can_cull = rec.gpu.device.features().contains(wgpu::Features::INDIRECT_FIRST_INSTANCE);
        // What may be left out already is not tested again.
        if calls.len() < LEAST_CALLS || !can_cull || rec.predicate.is_some() {
            return Self::none(calls);
        }
        Self::by_extent(calls)
    }

    /// Without a rest.
    pub fn none(calls: &'a [DrawCall]) -> Self {
        Self { occluders: calls.into(), rest: Vec::new() }
    }

    fn by_extent(calls: &'a [DrawCall]) -> Self {
        let hidden_per_index = |call: &DrawCall| {
            call.extent.map_or(f32::INFINITY, |extent| extent.area() / call.index_count.max(1) as f32)
        };
        let mut best: Vec<usize> = (0..calls.len()).collect();
        best.sort_by(|&a, &b| hidden_per_index(&calls[b]).total_cmp(&hidden_per_index(&calls[a])));
        let all: u64 = calls.iter().map(|call| u64::from(call.index_count)).sum();
        let mut is_occluder = vec![false; calls.len()];
        let mut drawn = 0;
        for &index in &best {
            // Of those that may cover anything there is nothing to test.
            let is_anywhere = calls[index].extent.is_none();
            drawn += u64::from(calls[index].index_count);
            is_occluder[index] = is_anywhere || drawn as f64 <= OCCLUDERS * all as f64;
        }
        let part = |wanted: bool| -> Vec<DrawCall> {
            let own = calls.iter().zip(&is_occluder).filter(move |(_, is)| **is == wanted);
            own.map(|(call, _)| *call).collect()
        };
        Self { occluders: part(true).into(), rest: part(false) }
    }
}

/// Batches of these calls, of which the device leaves out those that lie behind what has been drawn, by its depth.
///
/// # Errors
/// [`RenderError`].
pub fn unoccluded(
    rec: &mut Recorder<'_>,
    calls: &[DrawCall],
    depth: &Target,
) -> Result<Vec<Batch>, RenderError> {
    let mut predicate = Predicate::new(rec.gpu);
    predicate.reset(rec.gpu, calls.len())?;
    rec.predicate = Some(predicate);
    let batches = batches(rec, calls);
    let Some(predicate) = rec.predicate.take() else { return Ok(batches) };
    predicate.enable(rec.gpu);
    let mut extents = ArrayBuffer::new(rec.gpu, "extents");
    extents.write(rec.gpu, &calls.iter().filter_map(|call| call.extent).collect::<Vec<Extent>>());
    let blocks = rec.size().map(|side| side.div_ceil(BLOCK));
    let farthest = rec.target_of("farthest depths", FARTHEST, blocks)?;
    let program = |entry_point| Program::new("passes/occlusion_culling.wgsl", entry_point);
    let inputs = inputs! { depth_tex: depth, finding_tex: &farthest };
    rec.compute(
        "farthest depths",
        &program("cs_farthest"),
        &inputs,
        blocks.map(|side| side.div_ceil(GROUP)),
    )?;
    let inputs = inputs! { farthest_tex: &farthest, extents: &extents, draws: predicate.buffer() };
    let count = calls.len() as u32;
    let groups = [count.min(COLUMNS), count.div_ceil(COLUMNS)];
    rec.compute("occlusion culling", &program("cs_cull"), &inputs, groups)?;
    Ok(batches)
}

#[cfg(test)]
mod tests {
    use glam::UVec4;

    use super::*;
    use crate::render::base::gpu_scene::Origin;
    use crate::render::base::instances::Detail;

    fn call(instance: u32, side: u32, triangles: u32) -> DrawCall {
        DrawCall {
            instance,
            origin: Origin::Model,
            first_index: 0,
            index_count: 3 * triangles,
            surfaces: 1,
            base_vertex: 0,
            material_group: 0,
            detail: Detail::Lean,
            culled_face: None,
            extent: (side > 0).then(|| Extent { rect: UVec4::new(0, 0, side, side), nearest: 0.5 }),
        }
    }

    #[test]
    fn large_objects_of_few_triangles_and_those_that_may_be_anywhere_are_occluders() {
        let calls =
            [call(0, 10, 500), call(1, 300, 12), call(2, 20, 300), call(3, 0, 400), call(4, 200, 100)];
        let Split { occluders, rest } = Split::by_extent(&calls);
        let instances = |calls: &[DrawCall]| calls.iter().map(|call| call.instance).collect::<Vec<_>>();
        // 196 triangles are 15 %, and the one that may be anywhere has more.
        assert_eq!(instances(&occluders), [3]);
        assert_eq!(instances(&rest), [0, 1, 2, 4]);
        let others = [&calls[..3], &calls[4..]].concat();
        let Split { occluders, rest } = Split::by_extent(&others);
        assert_eq!(instances(&occluders), [1, 4]);
        assert_eq!(instances(&rest), [0, 2]);
    }
}
