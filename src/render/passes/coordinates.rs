//! Coordinates on surfaces, for styles whose pattern lies there: a second, cheap traversal of only the objects that ask
//! for it, over the G-buffer's own depth.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::gbuffer::{DEPTH, DrawCall, GBuffer, draw_group};
use crate::gpu::geometry::Attributes;
use crate::gpu::recorder::color_attachment;
use crate::gpu::{DynamicBuffer, Gpu, Recorder, Target};
use crate::render::RenderError;
use crate::render::gpu_scene::GpuScene;

/// Texture coordinates and their change from pixel to pixel: see `shaders/passes/coordinates.wgsl`.
const COORDINATES: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// The pipelines of the pass by the side of triangles that is left out, made when first needed.
#[derive(Default)]
pub struct CoordinatesPass {
    pipelines: HashMap<Option<wgpu::Face>, wgpu::RenderPipeline>,
    generation: u64,
}

impl CoordinatesPass {
    /// Draws parts of the scene of which a G-buffer was made from the same `draws`; 0 elsewhere. Their meshes must have
    /// texture coordinates.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        scene: &GpuScene,
        gbuffer: &GBuffer,
        (draw_layout, draws): (&wgpu::BindGroupLayout, &DynamicBuffer),
        calls: &[DrawCall],
    ) -> Result<Target, RenderError> {
        let target = rec.target("coordinates", COORDINATES)?;
        if self.generation != rec.pipelines.generation() {
            self.pipelines.clear();
            self.generation = rec.pipelines.generation();
        }
        for call in calls {
            if let Entry::Vacant(place) = self.pipelines.entry(call.hidden_side) {
                let module = rec.pipelines.module(rec.gpu, "passes/coordinates.wgsl")?;
                let layouts = [Some(rec.pipelines.frame_layout()), None, None, Some(draw_layout)];
                place.insert(build(rec.gpu, &module, &layouts, call.hidden_side));
            }
        }
        let group = draw_group(rec.gpu, draw_layout, draws);
        let color = [Some(color_attachment(&target, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)))];
        let depth = wgpu::RenderPassDepthStencilAttachment {
            view: gbuffer.depth.view(),
            depth_ops: None,
            stencil_ops: None,
        };
        let mut pass = rec.pass("coordinates", &color, Some(depth));
        let mut origin = None;
        for call in calls {
            let geometry = scene.geometry(call.origin);
            if geometry.attributes.is_none() {
                continue;
            }
            if origin != Some(call.origin) {
                geometry.bind(&mut pass, &[Some(&geometry.positions), geometry.attributes.as_ref()]);
                origin = Some(call.origin);
            }
            let Some(pipeline) = self.pipelines.get(&call.hidden_side) else { continue };
            pass.set_pipeline(pipeline);
            pass.set_bind_group(3, &group, &[draws.offset(call.draw)]);
            let indices = call.first_index..call.first_index + call.index_count;
            pass.draw_indexed(indices, call.base_vertex, 0..1);
        }
        drop(pass);
        Ok(target)
    }
}

fn build(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    hidden_side: Option<wgpu::Face>,
) -> wgpu::RenderPipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("coordinates"),
        bind_group_layouts: layouts,
        immediate_size: 0,
    });
    let position = wgpu::VertexBufferLayout {
        array_stride: 12,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3],
    };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("coordinates"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vs_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(position), Some(Attributes::LAYOUT)],
        },
        primitive: wgpu::PrimitiveState { cull_mode: hidden_side, ..Default::default() },
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
