//! The scene drawn once, from one camera; and what its mirrors show, each by a drawing of its own.

mod compose;
pub mod objects;
mod reflections;
mod stages;

use std::sync::Arc;

use glam::Vec2;

use self::objects::Objects;
use self::reflections::Reflection;
use self::stages::{ColorKey, EdgeKey, GeometryKey, InkKey, SegmentsKey};
use crate::geometry::EdgeClass;
use crate::geometry::line_segments::Strokes;
use crate::gpu::{ArrayBuffer, Gpu, Recorder, Target, UniformBuffer};
use crate::render::base::edge_style::EdgeUniform;
use crate::render::base::error::RenderError;
use crate::render::base::feature_lines::feature_lines;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::instances::Instances;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::effects::hidden::HiddenLines;
use crate::render::effects::surface::Shading;
use crate::render::effects::techniques::SharedTechniques;
use crate::render::effects::translucent::TranslucentState;
use crate::render::passes::depth_mask::DepthMaskPass;
use crate::render::passes::edge_map::{EdgeInputs, EdgeMap, edge_map};
use crate::render::passes::front::Front;
use crate::render::passes::gbuffer::GBuffer;
use crate::render::passes::layers::{LayersBy, Reported};
use crate::render::passes::line_distance::Reach;
use crate::render::passes::peeled::Peeled;
use crate::render::passes::segments::Segments;
use crate::render::passes::shadows::{ShadowMap, ShadowMask};
use crate::render::passes::traversal::GBufferPass;
use crate::style::Style;

/// What is to be drawn, and from where.
#[derive(Clone, Copy)]
pub struct DrawingInputs<'a> {
    /// The scene as the camera sees it.
    pub seen: SceneView<'a>,
    /// Styles and roles, resolved.
    pub objects: &'a Objects,
    /// The maps of the lights that throw shadows, by channel; they are for all cameras.
    pub shadow_maps: &'a [ShadowMap],
    /// How many mirrors in a row are followed from here.
    pub reflections: u32,
}

/// The opaque surfaces of a drawing: a group of one layer.
pub struct Surfaces {
    /// All that is in bind group 0.
    pub uniform: FrameUniform,
    /// Linear depth range of the enhanced objects.
    pub depth_range: Vec2,
    /// Per-pixel geometry.
    pub gbuffer: Output<GBuffer>,
    /// See [`ShadowMask`]; `None` when no light throws shadows.
    pub shadow_mask: Option<Output<Target>>,
}

/// A drawing, drawn.
pub struct Drawn {
    /// Linear colour times opacity, and opacity.
    pub color: Output<Target>,
    /// What is in front, and what changes when it does.
    pub front: (Front, Vec<u64>),
}

/// What all drawings have in common across frames.
pub struct Shared {
    /// Pipelines of the geometry.
    pub gbuffer: GBufferPass,
    techniques: SharedTechniques,
}

impl Shared {
    /// Compiles and uploads nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { gbuffer: GBufferPass::new(gpu), techniques: SharedTechniques::new(gpu) }
    }
}

/// What of a drawing lives across frames.
pub struct Drawing {
    uniform: UniformBuffer<FrameUniform>,
    frame_group: wgpu::BindGroup,
    draws: Instances,
    placed_segments: Segments,
    greatest_radius: ArrayBuffer,
    edge_styles: ArrayBuffer,
    gbuffer: Stage<GeometryKey, GBuffer>,
    segments: Stage<SegmentsKey, Arc<Strokes>>,
    edge_map: Stage<EdgeKey, EdgeMap>,
    reach: Stage<u64, Reach>,
    ink: Stage<InkKey, Target>,
    shadow_mask: ShadowMask,
    shading: Shading,
    color: Stage<ColorKey, Target>,
    depth_mask: DepthMaskPass,
    /// `None` while nothing is seen through.
    translucent: Option<TranslucentState>,
    /// `None` while no object has any.
    hidden: Option<HiddenLines>,
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
            draws: Instances::new(gpu),
            placed_segments: Segments::new(gpu),
            greatest_radius: ArrayBuffer::new(gpu, "greatest radius"),
            edge_styles: ArrayBuffer::new(gpu, "edge styles"),
            gbuffer: Stage::default(),
            segments: Stage::default(),
            edge_map: Stage::default(),
            reach: Stage::default(),
            ink: Stage::default(),
            shadow_mask: ShadowMask::new(gpu),
            shading: Shading::new(gpu),
            color: Stage::default(),
            depth_mask: DepthMaskPass::new(gpu),
            translucent: None,
            hidden: None,
            reflections: Vec::new(),
            blueprinted: 0,
            reflected: 0,
        }
    }

    /// Bind group 0 of its passes.
    pub fn frame_group(&self) -> &wgpu::BindGroup {
        &self.frame_group
    }

    /// Edge styles by object id on the device.
    pub fn edge_styles(&self) -> &wgpu::Buffer {
        self.edge_styles.buffer()
    }

    /// How often each stage has run, by name.
    pub fn runs(&self) -> Vec<(&'static str, u64)> {
        let blueprints = self.translucent.as_ref().map_or(0, TranslucentState::blueprint_runs);
        let mut runs = vec![
            ("g-buffer", self.gbuffer.runs()),
            ("edge map", self.edge_map.runs()),
            ("line distance", self.reach.runs()),
            ("shadow", self.shadow_mask.runs()),
            ("surface", self.color.runs()),
            ("hidden lines", self.hidden.as_ref().map_or(0, HiddenLines::runs)),
            ("blueprint", self.blueprinted + blueprints),
            ("mirror", self.reflected),
        ];
        runs.extend(self.shading.runs());
        runs
    }

    /// What has been reported about the layers of its pictures and of what mirrors show; it draws incomplete ones again.
    /// Never waits.
    pub fn take_reports(&mut self) -> Reported {
        let reflected = self.reflections.iter_mut().map(|r| r.drawing.take_reports());
        let hidden = self.hidden.iter_mut().map(HiddenLines::take_reports);
        let translucent = self.translucent.iter_mut().map(TranslucentState::take_reports);
        translucent.chain(hidden).chain(reflected).max().unwrap_or(Reported::Complete)
    }

    /// How far peeling came in each blueprint. Waits for the device.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn peeled(&self, gpu: &Gpu) -> Result<Vec<Peeled>, RenderError> {
        self.translucent.as_ref().map_or(Ok(Vec::new()), |state| state.peeled(gpu))
    }

    /// How far the layers of each blueprint came in the last picture whose report has arrived; in the order of
    /// [`Objects::blueprints`].
    pub fn last_peeled(&self) -> Vec<Option<(Peeled, LayersBy)>> {
        self.translucent.as_ref().map_or(Vec::new(), TranslucentState::last_peeled)
    }

    /// The same of the blueprint that objects of this style are in.
    pub fn last_peeled_of(&self, style: &Style) -> Option<&(Peeled, LayersBy)> {
        self.translucent.as_ref()?.last_peeled_of(style)
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
        let surfaces = self.draw_surfaces(rec, shared, inputs)?;
        let edges = match inputs.objects.surfaces.have_lines() {
            true => Some(self.find_edges(rec, inputs, &surfaces)?),
            false => {
                self.edge_map.clear();
                None
            }
        };
        rec.note("edge map", edges.as_ref().map(|edges| &edges.value.edges));
        self.compose(rec, shared, inputs, &surfaces, edges.as_ref())
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
    ) -> Result<Surfaces, RenderError> {
        let DrawingInputs { seen, objects, shadow_maps, .. } = *inputs;
        let SceneView { scene, view, .. } = seen;
        let depth_range = view.fitted_depth_range(objects.enhanced_boxes(scene));
        let uniform = FrameUniform::new(view, seen.sample, depth_range, seen.lights, seen.background);
        self.uniform.write(rec.gpu, &uniform);
        self.look_through(rec, &seen);
        self.edge_styles.write(rec.gpu, &objects.surfaces.edge_styles);
        let (draws, calls) = objects.surfaces.draws(scene, view);
        let key = GeometryKey::new(rec, &seen, draws, calls);
        let gbuffer = self.gbuffer.run(key, |GeometryKey { draws, calls, .. }| {
            shared.gbuffer.run(rec, scene, &mut self.draws, (draws, calls), view.has_cuts(), None)
        })?;
        let shadow_mask = self.shadow_mask.run(rec, &gbuffer, &seen, shadow_maps)?;
        let GBuffer { geometry, region, base_color, depth } = &gbuffer.value;
        for (name, target) in
            [("geometry", geometry), ("regions", region), ("base color", base_color), ("depth", depth)]
        {
            rec.note(name, Some(target));
        }
        rec.note("shadow mask", shadow_mask.as_ref().map(|mask| &mask.value));
        Ok(Surfaces { uniform, depth_range, gbuffer, shadow_mask })
    }

    fn look_through(&self, rec: &mut Recorder<'_>, seen: &SceneView<'_>) {
        rec.frame = self.frame_group.clone();
        rec.part = seen.view.part;
    }

    /// The edges of surfaces.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn find_edges(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
    ) -> Result<Output<EdgeMap>, RenderError> {
        let DrawingInputs { seen, objects, .. } = *inputs;
        let group = &objects.surfaces;
        let styles: Vec<_> = group.edge_styles.iter().map(EdgeUniform::for_finding).collect();
        // Only widths that follow the light depend on more than the geometry.
        let light = styles.iter().any(|s| s.by_light > 0.0).then(|| surfaces.uniform.without_background());
        // Which edges are lines does not change from sample to sample.
        let view = seen.view.moved(Vec2::ZERO);
        let key = SegmentsKey {
            scene_revision: seen.scene_revision,
            view,
            styles: styles.clone(),
            crease_angle: seen.crease_angle,
            strokes: group.strokes,
        };
        let segments = self.segments.run(key, |_| {
            Ok::<_, RenderError>(Arc::new(feature_lines(seen.scene, group, &view, seen.crease_angle)))
        })?;
        let has_borders = styles.iter().any(|s| s.draws(EdgeClass::Shadow));
        let shadow_mask = surfaces.shadow_mask.as_ref().filter(|_| has_borders);
        let key = EdgeKey {
            gbuffer: surfaces.gbuffer.revision,
            shadows: shadow_mask.map(|mask| mask.revision),
            styles,
            depth_range: surfaces.depth_range,
            light,
            strokes: group.strokes,
        };
        self.edge_map.run(key, |EdgeKey { styles, .. }| {
            self.placed_segments.write(rec, &segments.value, false)?;
            edge_map(
                rec,
                &EdgeInputs {
                    gbuffer: &surfaces.gbuffer.value,
                    styles,
                    edge_styles: self.edge_styles.buffer(),
                    is_whole: true,
                    seen: None,
                    marked: None,
                    segments: &self.placed_segments,
                    has_holes: group.has_holes,
                    is_cut: view.cut.is_some(),
                    before: None,
                    shadow_mask: shadow_mask.map(|mask| &mask.value),
                },
            )
        })
    }

    /// Lets go of what only a picture needs.
    pub fn forget_picture(&mut self) {
        self.reach.clear();
        self.ink.clear();
        self.color.clear();
        self.depth_mask.forget();
        self.blueprinted += self.translucent.as_ref().map_or(0, TranslucentState::blueprint_runs);
        self.translucent = None;
        self.hidden = None;
        self.reflections.clear();
    }
}
