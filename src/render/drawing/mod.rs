//! The scene drawn once, from one camera; and what its mirrors show, each by a drawing of its own.

mod compose;
pub mod objects;
mod reflections;
mod stages;

use self::objects::Objects;
use self::reflections::Reflection;
use self::stages::{ColorKey, TogetherKey};
use crate::gpu::{Gpu, Recorder, Target, UniformBuffer};
use crate::render::base::edge_styles::EdgeStylesBuffer;
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::effects::opaque::{OpaqueInputs, OpaqueLayer, OpaqueSurfaces};
use crate::render::effects::sketch::{SharedSketches, SketchState};
use crate::render::effects::surface::Shading;
use crate::render::effects::techniques::SharedTechniques;
use crate::render::effects::translucent::TranslucentState;
use crate::render::passes::depth_mask::DepthMaskPass;
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::front::Front;
use crate::render::passes::layer_report::LayerReport;
use crate::render::passes::layers::{LayerMethod, Reported};
use crate::render::passes::shadows::ShadowMap;
use crate::render::passes::traversal::GBufferPass;
use crate::style::Style;

/// What is to be drawn, and from where.
#[derive(Clone, Copy)]
pub struct DrawingInputs<'a> {
    /// The scene as the camera sees it.
    pub scene_view: SceneView<'a>,
    /// Styles and roles, resolved.
    pub objects: &'a Objects,
    /// The maps of the lights that throw shadows, by channel; they are for all cameras.
    pub shadow_maps: &'a [ShadowMap],
    /// How many mirrors in a row are followed from here.
    pub reflections: u32,
}

/// The opaque surfaces of a drawing that lie in their place.
pub struct DrawnSurfaces {
    /// All that is in bind group 0.
    pub uniform: FrameUniform,
    /// The surfaces.
    pub surfaces: OpaqueSurfaces,
}

/// A drawing, drawn.
pub struct Drawn {
    /// Linear color times opacity, and opacity.
    pub color: Output<Target>,
    /// What is in front, and what changes when it does.
    pub front: (Front, Vec<u64>),
}

/// What all drawings have in common across frames.
pub struct Shared {
    /// Pipelines of the geometry.
    pub gbuffer: GBufferPass,
    techniques: SharedTechniques,
    sketches: SharedSketches,
}

impl Shared {
    /// Compiles and uploads nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gbuffer: GBufferPass::new(gpu),
            techniques: SharedTechniques::new(gpu),
            sketches: SharedSketches::new(gpu),
        }
    }
}

/// What of a drawing lives across frames.
pub struct Drawing {
    uniform: UniformBuffer<FrameUniform>,
    frame_group: wgpu::BindGroup,
    surfaces: OpaqueLayer,
    sketches: Vec<SketchState>,
    shading: Shading,
    color: Stage<ColorKey, Target>,
    together: Stage<TogetherKey, Target>,
    depth_mask: DepthMaskPass,
    /// `None` while nothing is seen through.
    translucent: Option<TranslucentState>,
    reflections: Vec<Reflection>,
    /// How often layers of blueprints were drawn that are gone.
    blueprinted: u64,
    /// How often a reflection was drawn.
    reflected: u64,
}

impl Drawing {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let uniform = UniformBuffer::new(gpu, "frame");
        let nearest = gpu
            .device
            .create_sampler(&wgpu::SamplerDescriptor { label: Some("nearest"), ..Default::default() });
        let frame_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: frame_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.buffer().as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&nearest) },
            ],
        });
        Self {
            uniform,
            frame_group,
            surfaces: OpaqueLayer::new(gpu),
            sketches: Vec::new(),
            shading: Shading::new(gpu),
            color: Stage::default(),
            together: Stage::default(),
            depth_mask: DepthMaskPass::new(gpu),
            translucent: None,
            reflections: Vec::new(),
            blueprinted: 0,
            reflected: 0,
        }
    }

    /// Bind group 0 of its passes.
    pub fn frame_group(&self) -> &wgpu::BindGroup {
        &self.frame_group
    }

    /// Edge styles on the device.
    pub fn edge_styles(&self) -> &EdgeStylesBuffer {
        self.surfaces.edge_styles()
    }

    /// How often each stage has run, by name.
    pub fn runs(&self) -> Vec<(&'static str, u64)> {
        let blueprints = self.translucent.as_ref().map_or(0, TranslucentState::blueprint_runs);
        let mut runs = self.surfaces.runs().to_vec();
        runs.extend([
            ("surface", self.color.runs()),
            ("blueprint", self.blueprinted + blueprints),
            ("mirror", self.reflected),
        ]);
        runs.extend(self.shading.runs());
        for (name, count) in self.sketches.iter().flat_map(SketchState::runs) {
            match runs.iter_mut().find(|(known, _)| *known == name) {
                Some((_, sum)) => *sum += count,
                None => runs.push((name, count)),
            }
        }
        runs
    }

    /// In how many bands of rows the groups that overlap were drawn; 0: none do.
    pub fn bands(&self) -> usize {
        self.translucent.as_ref().map_or(0, TranslucentState::bands)
    }

    /// What has been reported about the layers of its pictures and of what mirrors show; it draws incomplete ones again.
    /// Never waits.
    pub fn take_reports(&mut self) -> Reported {
        let reflected = self.reflections.iter_mut().map(|r| r.drawing.take_reports());
        let opaque =
            self.sketches.iter_mut().map(SketchState::take_reports).chain([self.surfaces.take_reports()]);
        let translucent = self.translucent.iter_mut().map(TranslucentState::take_reports);
        translucent.chain(opaque).chain(reflected).max().unwrap_or(Reported::Complete)
    }

    /// How far the layers of each blueprint came. Waits for the device.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn layer_reports(&self, gpu: &Gpu) -> Result<Vec<LayerReport>, RenderError> {
        self.translucent.as_ref().map_or(Ok(Vec::new()), |state| state.layer_reports(gpu))
    }

    /// How far the layers of each blueprint came in the last picture whose report has arrived; in the order of
    /// [`Objects::blueprints`].
    pub fn last_layer_reports(&self) -> Vec<Option<(LayerReport, LayerMethod)>> {
        self.translucent.as_ref().map_or(Vec::new(), TranslucentState::last_layer_reports)
    }

    /// The same of the blueprint that objects of this style are in.
    pub fn last_layer_report_of(&self, style: &Style) -> Option<&(LayerReport, LayerMethod)> {
        self.translucent.as_ref()?.last_layer_report_of(style)
    }

    /// All of a drawing: surfaces, edges, what is seen in mirrors and through others, placed into one composition.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn draw(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
    ) -> Result<Drawn, RenderError> {
        let drawn = self.draw_surfaces(rec, shared, inputs)?;
        let edges = match inputs.objects.surfaces.have_lines() {
            true => Some(self.find_edges(rec, inputs, &drawn)?),
            false => {
                self.surfaces.forget_edges();
                None
            }
        };
        rec.note("edge map", edges.as_ref().map(|edges| &edges.value.edges));
        self.compose(rec, shared, inputs, &drawn, edges.as_ref())
    }

    /// Draws the opaque surfaces and the shadows on them; all later passes see through this camera.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn draw_surfaces(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
    ) -> Result<DrawnSurfaces, RenderError> {
        let DrawingInputs { scene_view, objects, .. } = *inputs;
        let SceneView { scene, view, .. } = scene_view;
        let depth_range = view.fitted_depth_range(objects.enhanced_boxes(scene));
        let uniform =
            FrameUniform::new(view, scene_view.sample, depth_range, scene_view.lights, scene_view.background);
        self.uniform.write(rec.gpu, &uniform);
        self.bind_camera(rec, &scene_view);
        let surfaces = self.surfaces.surfaces(rec, &mut shared.gbuffer, &surfaces_of(inputs, &uniform))?;
        let gbuffer = &surfaces.gbuffer.value;
        for (name, target) in [
            ("geometry", &gbuffer.geometry),
            ("surface ids", &gbuffer.surface_id),
            ("base color", &gbuffer.base_color),
            ("depth", &gbuffer.depth),
        ] {
            rec.note(name, Some(target));
        }
        rec.note("shadow mask", surfaces.shadow_mask.as_ref().map(|mask| &mask.value));
        Ok(DrawnSurfaces { uniform, surfaces })
    }

    fn bind_camera(&self, rec: &mut Recorder<'_>, scene_view: &SceneView<'_>) {
        rec.frame = self.frame_group.clone();
        rec.scissor_rect = scene_view.view.scissor_rect;
    }

    /// The edges of surfaces.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn find_edges(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &DrawingInputs<'_>,
        drawn: &DrawnSurfaces,
    ) -> Result<Output<EdgeMap>, RenderError> {
        self.surfaces.edges(rec, &surfaces_of(inputs, &drawn.uniform), &drawn.surfaces)
    }

    /// Lets go of what only a picture needs.
    pub fn forget_picture(&mut self) {
        self.surfaces.forget_picture();
        self.sketches.clear();
        self.color.clear();
        self.together.clear();
        self.depth_mask.forget();
        self.blueprinted += self.translucent.as_ref().map_or(0, TranslucentState::blueprint_runs);
        self.translucent = None;
        self.reflections.clear();
    }
}

/// The opaque surfaces that lie in their place, as a camera sees them.
fn surfaces_of<'a>(inputs: &DrawingInputs<'a>, uniform: &'a FrameUniform) -> OpaqueInputs<'a> {
    let DrawingInputs { scene_view, objects, shadow_maps, .. } = *inputs;
    OpaqueInputs { scene_view, group: &objects.surfaces, uniform, shadow_maps }
}
