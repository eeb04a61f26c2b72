//! One traversal of the scene (edge-enhancement paper, section 4.1.1): a G-buffer of the nearest surfaces or of what lies behind
//! a layer, or all fragments as lists.

use std::collections::HashMap;

use super::count::LayerCount;
use super::fragment_lists::FragmentLists;
use super::gbuffer::{BASE_COLOR, DEPTH, GBuffer, GEOMETRY, SORT_KEYS, SURFACE_ID};
use super::occlusion_culling::{Split, unoccluded};
use super::peel::Peel;
use crate::gpu::geometry::{Attributes, POSITIONS, SURFACES};
use crate::gpu::recorder::Onto;
use crate::gpu::{Gpu, MaterialBindings, Pipelines, Recorder, Target, drawn_as};
use crate::render::base::error::RenderError;
use crate::render::base::gpu_scene::GpuScene;
use crate::render::base::instances::{Batch, Detail, DrawCall, INSTANCES, Instance, InstanceBuffer, batches};

/// The pipelines of the pass, made when first needed.
pub struct GBufferPass {
    pipelines: HashMap<Variant, wgpu::RenderPipeline>,
    generation: u64,
    /// Layout of bind group 2: images.
    pub material_layout: wgpu::BindGroupLayout,
    /// Layout of bind group 3: the material of an instance.
    instance_layout: wgpu::BindGroupLayout,
    layer_layout: wgpu::BindGroupLayout,
    /// Where the fragments of one group after the other are collected.
    pub lists: FragmentLists,
}

/// What tells the pipelines apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Variant {
    detail: Detail,
    culled_face: Option<wgpu::Face>,
    /// Whether what lies behind a plane is left out.
    is_clipped: bool,
    /// Whether layers have a base color.
    with_color: bool,
    purpose: Purpose,
}

/// What objects are drawn for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Purpose {
    /// The nearest surfaces.
    Surfaces,
    /// The nearest of surfaces that are enlarged along their normals.
    Enlarged,
    /// What lies behind another layer.
    Layer,
    /// The base color of a layer that has been drawn.
    LayerColor,
    /// Where anything does.
    Counted,
    /// All fragments, as lists.
    Lists,
}

impl Purpose {
    fn file(self) -> &'static str {
        match self {
            Self::Surfaces | Self::Enlarged => "passes/gbuffer.wgsl",
            Self::Layer | Self::LayerColor | Self::Counted => "passes/peel.wgsl",
            Self::Lists => "passes/fragment_lists.wgsl",
        }
    }

    /// Of its vertex and its fragment shader.
    fn entry_points(self, detail: Detail) -> (String, String) {
        let detail = match detail {
            Detail::Lean => "lean",
            Detail::Smooth => "smooth",
            Detail::Colored => "colored",
            Detail::Full => "full",
        };
        let suffix = match self {
            Self::Surfaces | Self::Enlarged => "",
            Self::Layer => "_layer",
            Self::LayerColor => "_color",
            Self::Counted => "_counted",
            Self::Lists => "_list",
        };
        (format!("vs_{detail}"), format!("fs_{detail}{suffix}"))
    }

    fn outputs(self, with_color: bool) -> &'static [wgpu::TextureFormat] {
        match self {
            Self::Surfaces | Self::Enlarged => &[GEOMETRY, BASE_COLOR, SURFACE_ID],
            Self::Layer if with_color => &LAYER_WITH_COLOR,
            Self::Layer => &[GEOMETRY, SURFACE_ID, SORT_KEYS],
            Self::LayerColor => &[BASE_COLOR],
            Self::Counted => &[SURFACE_ID],
            Self::Lists => &[],
        }
    }
}

/// What a layer is drawn into at once, where a pass has room for so much.
const LAYER_WITH_COLOR: [wgpu::TextureFormat; 4] = [GEOMETRY, SURFACE_ID, SORT_KEYS, BASE_COLOR];

/// What is drawn of a scene.
#[derive(Clone, Copy)]
pub struct DrawList<'a> {
    /// The scene on the device.
    pub scene: &'a GpuScene,
    /// One for each object that is drawn.
    pub instances: &'a [Instance],
    /// The draw calls of those instances.
    pub calls: &'a [DrawCall],
    /// Whether what lies behind a plane is left out.
    pub is_clipped: bool,
}

/// A traversal of the scene.
struct Traversal<'a> {
    label: &'static str,
    purpose: Purpose,
    with_color: bool,
    color: &'a [&'a Target],
    depth: &'a Target,
    /// Bind group 1.
    group: Option<wgpu::BindGroup>,
}

impl GBufferPass {
    /// Compiles nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            pipelines: HashMap::new(),
            generation: 0,
            material_layout: MaterialBindings::layout(gpu),
            instance_layout: InstanceBuffer::material_layout(gpu),
            layer_layout: Peel::layout(gpu),
            lists: FragmentLists::new(gpu),
        }
    }

    fn prepare(&mut self, gpu: &Gpu, pipelines: &mut Pipelines, key: Variant) -> Result<(), RenderError> {
        if self.generation != pipelines.generation() {
            self.pipelines.clear();
            self.generation = pipelines.generation();
        }
        if self.pipelines.contains_key(&key) {
            return Ok(());
        }
        let module = pipelines.module(gpu, key.purpose.file())?;
        let own = match key.purpose {
            Purpose::Surfaces | Purpose::Enlarged => None,
            Purpose::Layer | Purpose::LayerColor | Purpose::Counted => Some(&self.layer_layout),
            Purpose::Lists => Some(self.lists.layout()),
        };
        let frame = pipelines.frame_layout();
        let layouts = [Some(frame), own, Some(&self.material_layout), Some(&self.instance_layout)];
        let bound = if key.detail == Detail::Full { &layouts[..] } else { &layouts[..2] };
        self.pipelines.insert(key, build(gpu, &module, bound, key));
        Ok(())
    }

    /// Draws a list of a scene, whose instances go to `instance_buffer`; of a layer only what lies behind the last one.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        draw_list: &DrawList<'_>,
        instance_buffer: &mut InstanceBuffer,
        peel: Option<&Peel<'_>>,
    ) -> Result<GBuffer, RenderError> {
        let gbuffer = GBuffer::new(rec)?;
        let GBuffer { geometry, base_color, surface_id, depth } = &gbuffer;
        let (label, purpose, with_color, color) = match peel {
            // Nobody looks at colors and surface ids where nothing is.
            None if draw_list.calls.is_empty() => ("g-buffer", Purpose::Surfaces, true, vec![geometry]),
            None => ("g-buffer", Purpose::Surfaces, true, vec![geometry, base_color, surface_id]),
            Some(Peel { sort_keys: None, .. }) => ("peel", Purpose::Counted, false, vec![surface_id]),
            Some(Peel { sort_keys: Some(sort_keys), with_color, .. }) => {
                let mut color = vec![geometry, surface_id, *sort_keys];
                let with_color = *with_color && rec.gpu.has_room_for(&LAYER_WITH_COLOR);
                color.extend(with_color.then_some(base_color));
                ("peel", Purpose::Layer, with_color, color)
            }
        };
        let group = peel.map(|peel| Peel::group_of(rec.gpu, &self.layer_layout, peel.last));
        let traversal = Traversal { label, purpose, with_color, color: &color, depth, group };
        self.traverse(rec, draw_list, instance_buffer, traversal)?;
        if let Some(Peel { sort_keys: Some(own), with_color: true, .. }) = peel
            && !with_color
        {
            let group = Some(Peel::group_of(rec.gpu, &self.layer_layout, own));
            // Fragments are told by their sort keys.
            let depth = &rec.target("depth", DEPTH)?;
            let (label, purpose, color) = ("peel colors", Purpose::LayerColor, &[base_color][..]);
            let traversal = Traversal { label, purpose, with_color: true, color, depth, group };
            self.traverse(rec, draw_list, instance_buffer, traversal)?;
        }
        Ok(gbuffer)
    }

    /// Draws the nearest surfaces of a list enlarged along their normals (sketchy drawings paper, section 4.2), each by
    /// as much as its instance says.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run_enlarged(
        &mut self,
        rec: &mut Recorder<'_>,
        draw_list: &DrawList<'_>,
        instance_buffer: &mut InstanceBuffer,
    ) -> Result<GBuffer, RenderError> {
        let gbuffer = GBuffer::new(rec)?;
        let GBuffer { geometry, base_color, surface_id, depth } = &gbuffer;
        let color = &[geometry, base_color, surface_id];
        let (label, purpose) = ("enlarged", Purpose::Enlarged);
        let traversal = Traversal { label, purpose, with_color: true, color, depth, group: None };
        self.traverse(rec, draw_list, instance_buffer, traversal)?;
        Ok(gbuffer)
    }

    /// Collects all fragments of a list in [`Self::lists`].
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn collect(
        &mut self,
        rec: &mut Recorder<'_>,
        draw_list: &DrawList<'_>,
        instance_buffer: &mut InstanceBuffer,
        with_color: bool,
        count: &LayerCount,
    ) -> Result<(), RenderError> {
        let group = Some(self.lists.group(rec.gpu, count));
        // A pass has to have an output.
        let depth = &rec.target("depth", DEPTH)?;
        let (label, purpose) = ("fragment lists", Purpose::Lists);
        let traversal = Traversal { label, purpose, with_color, color: &[], depth, group };
        self.traverse(rec, draw_list, instance_buffer, traversal)
    }

    fn traverse(
        &mut self,
        rec: &mut Recorder<'_>,
        draw_list: &DrawList<'_>,
        instance_buffer: &mut InstanceBuffer,
        traversal: Traversal<'_>,
    ) -> Result<(), RenderError> {
        let Traversal { label, purpose, with_color, color, depth, group: own } = traversal;
        let DrawList { scene, instances, calls, is_clipped } = *draw_list;
        let gpu = rec.gpu;
        let variant = |call: &DrawCall| {
            let DrawCall { detail, culled_face, .. } = *call;
            Variant { detail, culled_face, is_clipped, with_color, purpose }
        };
        for call in calls {
            self.prepare(gpu, rec.pipelines, variant(call))?;
        }
        instance_buffer.write(gpu, instances, calls)?;
        let split = match purpose {
            Purpose::Surfaces => Split::new(rec, calls),
            _ => Split::none(calls),
        };
        let shared = Shared {
            scene,
            own: own.as_ref(),
            instance_buffer,
            materials: &instance_buffer.material_group(gpu, &self.instance_layout),
            variant: &variant,
        };
        let drawn = batches(rec, &split.occluders);
        let cleared = rec.attachments(Onto::Clear, color);
        let pass = rec.pass(label, &cleared, Some(depth_attachment(depth, wgpu::LoadOp::Clear(0.0))));
        self.draw(pass, &drawn, &shared);
        if split.rest.is_empty() {
            return Ok(());
        }
        let drawn = unoccluded(rec, &split.rest, depth)?;
        let loaded = rec.attachments(Onto::Load, color);
        let pass = rec.pass(label, &loaded, Some(depth_attachment(depth, wgpu::LoadOp::Load)));
        self.draw(pass, &drawn, &shared);
        Ok(())
    }

    fn draw(&self, mut pass: wgpu::RenderPass<'_>, batches: &[Batch], shared: &Shared<'_>) {
        let Shared { scene, own, instance_buffer, materials, variant } = *shared;
        if let Some(own) = own {
            pass.set_bind_group(1, own, &[]);
        }
        let (mut bound, mut images, mut origin) = (None, None, None);
        for batch in batches {
            let call = &batch.call;
            if origin != Some(call.origin) {
                let geometry = scene.geometry(call.origin);
                let buffers =
                    [Some(&geometry.positions), Some(&geometry.surfaces), geometry.attributes.as_ref()];
                geometry.bind(&mut pass, 1, &buffers);
                origin = Some(call.origin);
            }
            let key = variant(call);
            if bound != Some(key) {
                let Some(pipeline) = self.pipelines.get(&key) else { continue };
                pass.set_pipeline(pipeline);
                bound = Some(key);
            }
            if call.detail == Detail::Full {
                if images != Some(call.material_group) {
                    pass.set_bind_group(2, scene.materials.group(call.material_group), &[]);
                    images = Some(call.material_group);
                }
                pass.set_bind_group(3, materials, &[instance_buffer.material_of(call)]);
            }
            instance_buffer.draw(&mut pass, batch);
        }
    }
}

/// What the draws of a traversal share.
struct Shared<'a> {
    scene: &'a GpuScene,
    /// Bind group 1.
    own: Option<&'a wgpu::BindGroup>,
    instance_buffer: &'a InstanceBuffer,
    materials: &'a wgpu::BindGroup,
    variant: &'a dyn Fn(&DrawCall) -> Variant,
}

fn depth_attachment(depth: &Target, load: wgpu::LoadOp<f32>) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view: depth.view(),
        depth_ops: Some(wgpu::Operations { load, store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}

fn build(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    variant: Variant,
) -> wgpu::RenderPipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("g-buffer"),
        bind_group_layouts: layouts,
        immediate_size: 0,
    });
    let buffers = [Some(INSTANCES), Some(POSITIONS), Some(SURFACES), Some(Attributes::LAYOUT)];
    let (vertex, fragment) = variant.purpose.entry_points(variant.detail);
    let outputs = variant.purpose.outputs(variant.with_color).iter();
    let targets: Vec<_> = outputs.map(|&format| Some(drawn_as(format).into())).collect();
    let mut constants = vec![("WITH_CLIP_PLANE", variant.is_clipped)];
    match variant.purpose {
        Purpose::Surfaces => {}
        Purpose::Enlarged => constants.push(("ENLARGED", true)),
        _ => constants.push(("WITH_COLOR", variant.with_color)),
    }
    let constants: Vec<_> = constants.into_iter().map(|(name, on)| (name, f64::from(u8::from(on)))).collect();
    let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    // Lists take all fragments, and those of a layer are known.
    let has_depth = !matches!(variant.purpose, Purpose::Lists | Purpose::LayerColor);
    let depth_compare =
        if has_depth { wgpu::CompareFunction::Greater } else { wgpu::CompareFunction::Always };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("g-buffer"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(&vertex),
            compilation_options: options.clone(),
            buffers: if variant.detail == Detail::Lean { &buffers[..3] } else { &buffers },
        },
        // Unless a mesh is known to be solid, both sides are drawn: flipped or mixed winding is common in files.
        primitive: wgpu::PrimitiveState { cull_mode: variant.culled_face, ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(has_depth),
            depth_compare: Some(depth_compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(&fragment),
            compilation_options: options,
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
