//! The depth mask: a depth texture of the designated objects alone, and what layers must know of it (blueprints paper,
//! section 4.3, Fig. 6).
//!
//! ```text
//! designated objects ─► depth mask ─► Q, farthest depth
//! ```

use encase::ShaderType as _;

use super::designated::{DepthMask, Masked};
use super::gbuffer::GBuffer;
use super::traversal::{DrawList, GBufferPass};
use crate::gpu::{Gpu, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::group::Group;
use crate::render::base::instances::{DrawCall, Instance, InstanceBuffer};
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::base::view::View;

/// Pixels per side of a workgroup, as in `passes/depth_mask.wgsl`.
const GROUP: u32 = 16;

/// What of the depth mask lives across frames.
pub struct DepthMaskPass {
    instances: InstanceBuffer,
    count: wgpu::Buffer,
    stage: Stage<Key, DepthMask>,
}

/// What the depth mask depends on.
#[derive(PartialEq)]
struct Key {
    shaders: u64,
    scene_revision: u64,
    view: View,
    instances: Vec<Instance>,
    calls: Vec<DrawCall>,
    surfaces: u64,
}

impl DepthMaskPass {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        Self {
            instances: InstanceBuffer::new(gpu),
            count: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("depth mask"),
                size: Masked::min_size().get(),
                usage,
                mapped_at_creation: false,
            }),
            stage: Stage::default(),
        }
    }

    /// Lets go of the last one.
    pub fn forget(&mut self) {
        self.stage.clear();
    }

    /// The mask of what is `designated`, with the G-buffer of just that where it has been drawn; `surfaces`: geometry of all
    /// that is opaque, it included.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        scene_view: &SceneView<'_>,
        designated: &Group,
        drawn: Option<&GBuffer>,
        surfaces: &Output<Target>,
    ) -> Result<Output<DepthMask>, RenderError> {
        let SceneView { scene, view, .. } = *scene_view;
        let (instances, calls) = designated.instances(scene, view);
        let key = Key {
            shaders: rec.pipelines.generation(),
            scene_revision: scene_view.scene_revision,
            view: *view,
            instances,
            calls,
            surfaces: surfaces.revision,
        };
        let Self { instances: buffer, count, stage } = self;
        stage.run(key, |Key { view, instances, calls, .. }| {
            let designated = match drawn {
                Some(drawn) => drawn.clone(),
                None => {
                    let draw_list = DrawList { scene, instances, calls, is_clipped: view.is_clipped() };
                    gbuffer_pass.run(rec, &draw_list, buffer, None)?
                }
            };
            rec.encoder.clear_buffer(count, 0, None);
            let [width, height] = rec.size();
            rec.compute(
                "depth mask",
                &Program::new("passes/depth_mask.wgsl", "cs_main"),
                &inputs! {
                    geometry_tex: &designated.geometry,
                    surface_tex: &surfaces.value,
                    mask: &*count,
                },
                [width.div_ceil(GROUP), height.div_ceil(GROUP)],
            )?;
            Ok::<_, RenderError>(DepthMask { depth: designated.depth, count: count.clone() })
        })
    }
}
