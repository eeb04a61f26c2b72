//! Shadow maps: what is nearest to a light, in each direction from it (Williams 1978, "Casting Curved Shadows on
//! Curved Surfaces").

use std::collections::HashMap;

use encase::ShaderType;
use glam::{Mat4, Vec4};

use crate::gpu::geometry::{Attributes, POSITIONS};
use crate::gpu::material::MaterialUniform;
use crate::gpu::{DynamicBuffer, Gpu, Pipelines, Recorder, Target};
use crate::render::base::error::RenderError;
use crate::render::base::gpu_scene::{GpuScene, Origin};
use crate::render::base::light_view::LightView;

/// Reversed: 1 nearest to the light, 0 where it meets nothing.
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// One draw; twin of `ShadowDraw` in `shaders/passes/shadow_map.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct ShadowDraw {
    /// Local to the light's clip space.
    pub clip_from_local: Mat4,
    /// What it is made of, for its holes.
    pub material: MaterialUniform,
    /// What lies behind the section plane is left out: local space, its product with (point, 1) is the distance before it.
    pub section: Vec4,
}

/// One draw call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadowCall {
    /// Index of its uniform.
    pub draw: u32,
    /// Number of the light's picture in which it is seen.
    pub view: usize,
    /// The buffers that hold it.
    pub origin: Origin,
    /// Range of the index buffer.
    pub first_index: u32,
    /// Number of indices.
    pub index_count: u32,
    /// First vertex of the mesh.
    pub base_vertex: i32,
    /// Bind group of the material.
    pub material_group: usize,
    /// Whether light falls through holes.
    pub has_holes: bool,
    /// Whether the section plane cuts it open.
    pub is_clipped: bool,
    /// The side of its triangles that is left out.
    pub culled_face: Option<wgpu::Face>,
}

/// Everything that the map of one light depends on.
#[derive(Debug, Clone, PartialEq)]
pub struct ShadowScene {
    /// The pictures that the light sees.
    pub views: Vec<LightView>,
    /// What is in them.
    pub draws: Vec<ShadowDraw>,
    /// How it is drawn.
    pub calls: Vec<ShadowCall>,
    /// Width and height of the map, texels.
    pub side: u32,
}

/// What tells the pipelines apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Variant {
    has_holes: bool,
    is_clipped: bool,
    culled_face: Option<wgpu::Face>,
}

impl From<&ShadowCall> for Variant {
    fn from(call: &ShadowCall) -> Self {
        let ShadowCall { has_holes, is_clipped, culled_face, .. } = *call;
        Self { has_holes, is_clipped, culled_face }
    }
}

/// The pipelines of the pass, made when first needed, and room for the draws of one map.
pub struct ShadowMapPass {
    pipelines: HashMap<Variant, wgpu::RenderPipeline>,
    generation: u64,
    draw_layout: wgpu::BindGroupLayout,
    draws: DynamicBuffer,
}

impl ShadowMapPass {
    /// Compiles nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        let draw_layout = DynamicBuffer::layout::<ShadowDraw>(gpu, "shadow draw");
        Self {
            pipelines: HashMap::new(),
            generation: 0,
            draw_layout,
            draws: DynamicBuffer::new::<ShadowDraw>(gpu, "shadow draws"),
        }
    }

    fn prepare(
        &mut self,
        gpu: &Gpu,
        pipelines: &mut Pipelines,
        material_layout: &wgpu::BindGroupLayout,
        key: Variant,
    ) -> Result<(), RenderError> {
        if self.generation != pipelines.generation() {
            self.pipelines.clear();
            self.generation = pipelines.generation();
        }
        if !self.pipelines.contains_key(&key) {
            let module = pipelines.module(gpu, "passes/shadow_map.wgsl")?;
            let layouts =
                [Some(pipelines.frame_layout()), None, Some(material_layout), Some(&self.draw_layout)];
            self.pipelines.insert(key, build(gpu, &module, &layouts, key));
        }
        Ok(())
    }

    /// Draws the map of one light in one depth-only pass.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        scene: &GpuScene,
        material_layout: &wgpu::BindGroupLayout,
        seen: &ShadowScene,
    ) -> Result<Target, RenderError> {
        let map = rec.target_of("shadow map", DEPTH, [seen.side, seen.side])?;
        let gpu = rec.gpu;
        for call in &seen.calls {
            self.prepare(gpu, rec.pipelines, material_layout, call.into())?;
        }
        self.draws.write(gpu, &seen.draws)?;
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow draws"),
            layout: &self.draw_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: self.draws.binding::<ShadowDraw>() }],
        });
        let depth = wgpu::RenderPassDepthStencilAttachment {
            view: map.view(),
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        };
        let mut pass = rec.pass("shadow map", &[], Some(depth));
        let (mut bound, mut material, mut view, mut origin) = (None, None, None, None);
        for call in &seen.calls {
            if origin != Some(call.origin) {
                let geometry = scene.geometry(call.origin);
                geometry.bind(&mut pass, 0, &[Some(&geometry.positions), geometry.attributes.as_ref()]);
                origin = Some(call.origin);
            }
            let key = Variant::from(call);
            if bound != Some(key) {
                let Some(pipeline) = self.pipelines.get(&key) else { continue };
                pass.set_pipeline(pipeline);
                bound = Some(key);
            }
            if view != Some(call.view) {
                let Some(seen) = seen.views.get(call.view) else { continue };
                let [[x, y], [w, h]] = seen.tile.map(|at| at.map(|texels| texels as f32));
                pass.set_viewport(x, y, w, h, 0.0, 1.0);
                view = Some(call.view);
            }
            if material != Some(call.material_group) {
                pass.set_bind_group(2, scene.materials.group(call.material_group), &[]);
                material = Some(call.material_group);
            }
            let indices = call.first_index..call.first_index + call.index_count;
            pass.set_bind_group(3, &group, &[self.draws.offset(call.draw)]);
            pass.draw_indexed(indices, call.base_vertex, 0..1);
        }
        drop(pass);
        Ok(map)
    }
}

fn build(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    Variant { has_holes, is_clipped, culled_face }: Variant,
) -> wgpu::RenderPipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("shadow map"),
        bind_group_layouts: layouts,
        immediate_size: 0,
    });
    let buffers = [Some(POSITIONS), Some(Attributes::LAYOUT)];
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("shadow map"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(match (has_holes, is_clipped) {
                (true, _) => "vs_holes",
                (false, true) => "vs_clipped",
                (false, false) => "vs_main",
            }),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: if has_holes { &buffers } else { &buffers[..1] },
        },
        primitive: wgpu::PrimitiveState { cull_mode: culled_face, ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: (has_holes || is_clipped).then(|| wgpu::FragmentState {
            module,
            entry_point: Some(if has_holes { "fs_holes" } else { "fs_clipped" }),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}
