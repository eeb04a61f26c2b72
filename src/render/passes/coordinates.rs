//! Coordinates on surfaces, for styles whose pattern lies there: a second, cheap traversal of only the objects that ask
//! for it, over the G-buffer's own depth.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::gbuffer::{DEPTH, GBuffer};
use crate::gpu::geometry::{Attributes, POSITIONS};
use crate::gpu::recorder::Onto;
use crate::gpu::{Gpu, Recorder, Target};
use crate::render::base::error::RenderError;
use crate::render::base::gpu_scene::GpuScene;
use crate::render::base::instances::{DrawCall, INSTANCES, InstanceBuffer, batches};

/// What both shaders of this pass write.
const COORDINATES: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// What is drawn of surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinates {
    /// Texture coordinates and their change from pixel to pixel: see `shaders/passes/coordinates.wgsl`.
    Texture,
    /// Triangles, and places in local space: see `shaders/passes/triangle_map.wgsl`.
    Triangles,
}

impl Coordinates {
    /// Whether a device can draw them.
    pub fn are_supported(self, gpu: &Gpu) -> bool {
        self == Self::Texture || gpu.device.features().contains(wgpu::Features::PRIMITIVE_INDEX)
    }

    fn label(self) -> &'static str {
        match self {
            Self::Texture => "coordinates",
            Self::Triangles => "triangles",
        }
    }

    fn file(self) -> &'static str {
        match self {
            Self::Texture => "passes/coordinates.wgsl",
            Self::Triangles => "passes/triangle_map.wgsl",
        }
    }
}

/// The pipelines of the pass by the side of triangles that is left out, made when first needed.
pub struct CoordinatesPass {
    what: Coordinates,
    pipelines: HashMap<Option<wgpu::Face>, wgpu::RenderPipeline>,
    generation: u64,
}

impl CoordinatesPass {
    /// Compiles nothing yet.
    pub fn new(what: Coordinates) -> Self {
        Self { what, pipelines: HashMap::new(), generation: 0 }
    }

    /// Draws parts of the scene of which a G-buffer was made from the same instances; 0 elsewhere, or what is drawn of others
    /// where it goes `beside` that. For texture coordinates their meshes must have some.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        scene: &GpuScene,
        gbuffer: &GBuffer,
        instance_buffer: &InstanceBuffer,
        calls: &[DrawCall],
        beside: Option<&Target>,
    ) -> Result<Target, RenderError> {
        let what = self.what;
        let (target, onto) = match beside {
            Some(target) => (target.clone(), Onto::Load),
            None => (rec.target(what.label(), COORDINATES)?, Onto::Clear),
        };
        if self.generation != rec.pipelines.generation() {
            self.pipelines.clear();
            self.generation = rec.pipelines.generation();
        }
        for call in calls {
            if let Entry::Vacant(place) = self.pipelines.entry(call.culled_face) {
                let module = rec.pipelines.module(rec.gpu, what.file())?;
                place.insert(build(rec.gpu, &module, rec.pipelines.frame_layout(), call.culled_face, what));
            }
        }
        let batches = batches(rec, calls);
        let color = rec.attachments(onto, &[&target]);
        let depth = wgpu::RenderPassDepthStencilAttachment {
            view: gbuffer.depth.view(),
            depth_ops: None,
            stencil_ops: None,
        };
        let mut pass = rec.pass(what.label(), &color, Some(depth));
        let mut origin = None;
        for batch in &batches {
            let call = &batch.call;
            let geometry = scene.geometry(call.origin);
            let attributes = geometry.attributes.as_ref().filter(|_| what == Coordinates::Texture);
            if attributes.is_none() && what == Coordinates::Texture {
                continue;
            }
            if origin != Some(call.origin) {
                geometry.bind(&mut pass, 1, &[Some(&geometry.positions), attributes]);
                origin = Some(call.origin);
            }
            let Some(pipeline) = self.pipelines.get(&call.culled_face) else { continue };
            pass.set_pipeline(pipeline);
            instance_buffer.draw(&mut pass, batch);
        }
        drop(pass);
        Ok(target)
    }
}

fn build(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    frame_layout: &wgpu::BindGroupLayout,
    culled_face: Option<wgpu::Face>,
    what: Coordinates,
) -> wgpu::RenderPipeline {
    let label = Some(what.label());
    let buffers = [Some(INSTANCES), Some(POSITIONS), Some(Attributes::LAYOUT)];
    let count = if what == Coordinates::Texture { 3 } else { 2 };
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(frame_layout)],
        immediate_size: 0,
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vs_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &buffers[..count],
        },
        primitive: wgpu::PrimitiveState { cull_mode: culled_face, ..Default::default() },
        // What the G-buffer shows lies exactly there; holes by alpha too are none of it.
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(false),
            depth_compare: Some(wgpu::CompareFunction::Equal),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fs_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(COORDINATES.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
