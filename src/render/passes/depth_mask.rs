//! The depth mask: a depth texture of the designated objects alone, and what peeling must know of it (blueprints paper,
//! section 4.3, Fig. 6).
//!
//! ```text
//! designated objects ─► depth mask ─► Q, farthest depth
//! ```

use encase::ShaderType;

use super::gbuffer::{GBuffer, GBufferPass};
use super::instances::{DrawCall, Instance, Instances};
use crate::gpu::{Gpu, Program, Recorder, Target, inputs};
use crate::render::RenderError;
use crate::render::drawing::DrawingInputs;
use crate::render::frame_uniform::View;
use crate::render::stage::{Output, Stage};

/// Pixels per side of a workgroup, as in `passes/depth_mask.wgsl`.
const GROUP: u32 = 16;

/// What is counted of a depth mask. Twin of `Masked` in `shaders/common/depth_mask.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct Masked {
    /// Its pixels, the paper's Q; 0: nothing designated is in the picture.
    pub pixels: u32,
    /// Those of them that opaque surfaces hide, which no peeling uncovers.
    pub hidden: u32,
    /// Its greatest linear depth, as a number in the same order.
    pub farthest: u32,
}

/// The depth texture of the designated objects, hidden by nothing but themselves.
#[derive(Debug, Clone)]
pub struct DepthMask {
    /// Reversed depth; 0 where there is none of them.
    pub depth: Target,
    /// [`Masked`] on the device.
    pub count: wgpu::Buffer,
}

/// What of the depth mask lives across frames.
pub struct DepthMaskPass {
    draws: Instances,
    count: wgpu::Buffer,
    stage: Stage<(u64, u64, View, Vec<Instance>, Vec<DrawCall>, u64), DepthMask>,
}

impl DepthMaskPass {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        Self {
            draws: Instances::new(gpu),
            count: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("depth mask"),
                size: Masked::min_size().get(),
                usage,
                mapped_at_creation: false,
            }),
            stage: Stage::default(),
        }
    }

    /// The mask of what is designated beside `surfaces`, which it is among; `None` where nobody asks for one.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &DrawingInputs<'_>,
        surfaces: &Output<GBuffer>,
    ) -> Result<Option<Output<DepthMask>>, RenderError> {
        let DrawingInputs { scene, objects, view, .. } = *inputs;
        if objects.blueprints.is_empty() || objects.masks.visible().is_empty() {
            self.stage.clear();
            return Ok(None);
        }
        let (draws, calls) = objects.masks.draws(scene, view);
        let shaders = rec.pipelines.generation();
        let asked = (shaders, inputs.scene_revision, *view, draws, calls, surfaces.revision);
        let Self { draws: buffer, count, stage } = self;
        let mask = stage.run(asked, |(_, _, view, draws, calls, _)| {
            // Where nothing else is opaque, they have been drawn.
            let designated = if objects.masks.visible() == objects.surfaces.visible() {
                surfaces.value.clone()
            } else {
                gbuffer_pass.run(rec, scene, buffer, (draws, calls), view.has_cuts(), None)?
            };
            rec.encoder.clear_buffer(count, 0, None);
            let [width, height] = rec.size();
            rec.compute(
                "depth mask",
                Program::new("passes/depth_mask.wgsl", "cs_main"),
                &inputs! {
                    geometry_tex: &designated.geometry,
                    surface_tex: &surfaces.value.geometry,
                    mask: &*count,
                },
                [width.div_ceil(GROUP), height.div_ceil(GROUP)],
            )?;
            Ok::<_, RenderError>(DepthMask { depth: designated.depth, count: count.clone() })
        })?;
        Ok(Some(mask))
    }
}
