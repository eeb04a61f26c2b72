//! The scene drawn once, from one camera; and what its mirrors show, each by a drawing of its own.

pub mod objects;
mod reflections;
mod stages;

use std::sync::Arc;

use glam::Vec2;

use self::objects::Objects;
use self::reflections::Reflection;
use self::stages::{ColorKey, EdgeKey, GeometryKey, InkKey, SegmentsKey};
use crate::geometry::{EdgeClass, LineSegment};
use crate::gpu::{ArrayBuffer, Gpu, Recorder, Target, UniformBuffer};
use crate::render::base::edge_style::EdgeUniform;
use crate::render::base::error::RenderError;
use crate::render::base::feature_lines::feature_lines;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::instances::Instances;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::effects::blended::BlendedShading;
use crate::render::effects::hidden::HiddenLines;
use crate::render::effects::mirror::mirror;
use crate::render::effects::section::caps;
use crate::render::effects::surface::{Look, Shading};
use crate::render::effects::technique::Shaded;
use crate::render::effects::techniques::SharedTechniques;
use crate::render::effects::translucent::{TranslucentGroups, TranslucentInputs, TranslucentState};
use crate::render::passes::composition::{Composition, ink};
use crate::render::passes::depth_mask::DepthMaskPass;
use crate::render::passes::designated::DepthMask;
use crate::render::passes::edge_map::{EdgeInputs, EdgeMap, edge_map};
use crate::render::passes::front::Front;
use crate::render::passes::gbuffer::GBuffer;
use crate::render::passes::layers::{LayersBy, Reported};
use crate::render::passes::line_distance::{Reach, line_distance};
use crate::render::passes::lines::{Lines, Pen, lines};
use crate::render::passes::overlay::overlay;
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
    segments: Stage<SegmentsKey, Arc<Vec<LineSegment>>>,
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

    /// Shades the surfaces, and composes them with their lines, mirrors and what is seen through.
    fn compose(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Drawn, RenderError> {
        let DrawingInputs { seen, objects, .. } = *inputs;
        let look = Look::new(&objects.styles, &seen, caps(seen.scene, seen.view, objects.scale));
        let reflected = self.reflect(rec, shared, inputs)?;
        let hidden = self.draw_hidden(rec, shared, inputs, surfaces, edges)?;
        let reach = self.find_reach(rec, inputs, edges)?;
        let gbuffer = &surfaces.gbuffer;
        let geometry = Output { value: gbuffer.value.geometry.clone(), revision: gbuffer.revision };
        let mut composition = Composition::of_surfaces(geometry, !objects.surfaces.is_empty());
        let edge_styles = &objects.surfaces.edge_styles;
        self.shading.upload(&mut shared.techniques, rec.gpu, &look)?;
        if objects.blended.is_empty() && objects.blueprints.is_empty() {
            self.blueprinted += self.translucent.take().map_or(0, |state| state.blueprint_runs());
            self.ink.clear();
            self.depth_mask.forget();
        } else {
            composition.place_ink(self.draw_ink(rec, inputs, surfaces, edges, reach.as_ref())?);
            self.place_translucent(rec, shared, inputs, surfaces, &look, &mut composition)?;
        }
        let key = ColorKey {
            gbuffer: gbuffer.revision,
            shadows: surfaces.shadow_mask.as_ref().map(|mask| mask.revision),
            edges: edges.map(|edges| edges.revision),
            reach: reach.as_ref().map(|reach| reach.revision),
            look,
            edge_styles: edge_styles.clone(),
            uniform: surfaces.uniform.without_background(),
            reflected: reflected.iter().map(|r| (r.color.revision, r.uniform)).collect(),
            paper_in_mirrors: (!reflected.is_empty()).then_some(seen.background),
            hidden: hidden.as_ref().map(|hidden| hidden.revision),
            translucent: composition.translucent_revisions(),
        };
        let color = self.color.run(key, |key| {
            if let Some(only) = composition.only_translucent() {
                return Ok(only.clone());
            }
            let geometry = self.gbuffer.inputs();
            let layer = Shaded {
                gbuffer: &gbuffer.value,
                revision: Some(gbuffer.revision),
                shadow_mask: surfaces.shadow_mask.as_ref().map(|mask| (&mask.value, mask.revision)),
                seen,
                uniform: &key.uniform,
                instances: &self.draws,
                draws: geometry.map_or(&[], |key| &key.draws),
                calls: geometry.map_or(&[], |key| &key.calls),
            };
            let color = self.shading.shade(rec, &mut shared.techniques, &key.look, &layer, false)?;
            for seen in &reflected {
                let Some(reflection) = self.reflections.get_mut(seen.index) else { continue };
                reflection.uniform.write(rec.gpu, &vec![seen.uniform]);
                let uniform = reflection.uniform.buffer();
                mirror(rec, &gbuffer.value, &seen.color.value, uniform, &color)?;
            }
            if let Some(hidden) = &hidden {
                overlay(rec, &hidden.value, &color)?;
            }
            if let Some(edges) = edges {
                let drawn = Lines {
                    gbuffer: &gbuffer.value,
                    edge_map: &edges.value,
                    reach: reach.as_ref().map(|reach| &reach.value),
                    styles: edge_styles,
                    edge_styles: self.edge_styles.buffer(),
                };
                lines(rec, &drawn, &Pen::PLAIN, &color)?;
            }
            composition.lay_translucent(rec, &color)?;
            Ok::<_, RenderError>(color)
        })?;
        let mut revisions = vec![gbuffer.revision];
        revisions.extend(composition.translucent_revisions());
        Ok(Drawn { color, front: (composition.front(), revisions) })
    }

    fn draw_hidden(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Option<Output<Target>>, RenderError> {
        let Objects { surfaces: group, hidden: asked, .. } = inputs.objects;
        if asked.is_empty() {
            self.hidden = None;
            return Ok(None);
        }
        let hidden = self.hidden.get_or_insert_with(|| HiddenLines::new(rec.gpu));
        let asked = (group, asked);
        hidden.run(rec, &mut shared.gbuffer, &inputs.seen, &surfaces.uniform, asked, edges).map(Some)
    }

    fn find_reach(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &DrawingInputs<'_>,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Option<Output<Reach>>, RenderError> {
        let spines = edges.and_then(|edges| Some((edges.revision, edges.value.spines.as_ref()?)));
        let Some((revision, spines)) = spines else {
            self.reach.clear();
            return Ok(None);
        };
        let styles = &inputs.objects.surfaces.edge_styles;
        self.reach.run(revision, |_| line_distance(rec, spines, styles, &mut self.greatest_radius)).map(Some)
    }

    fn draw_ink(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
        edges: Option<&Output<EdgeMap>>,
        reach: Option<&Output<Reach>>,
    ) -> Result<Option<Output<Target>>, RenderError> {
        let styles = &inputs.objects.surfaces.edge_styles;
        let Some(edges) = edges.filter(|_| !inputs.objects.surfaces.is_empty()) else {
            self.ink.clear();
            return Ok(None);
        };
        let key = InkKey {
            gbuffer: surfaces.gbuffer.revision,
            edges: edges.revision,
            reach: reach.map(|reach| reach.revision),
            edge_styles: styles.clone(),
            uniform: surfaces.uniform.without_background(),
        };
        let drawn = Lines {
            gbuffer: &surfaces.gbuffer.value,
            edge_map: &edges.value,
            reach: reach.map(|reach| &reach.value),
            styles,
            edge_styles: self.edge_styles.buffer(),
        };
        self.ink.run(key, |_| ink(rec, &drawn)).map(Some)
    }

    fn place_translucent(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
        look: &Look,
        composition: &mut Composition,
    ) -> Result<(), RenderError> {
        let DrawingInputs { seen, objects, shadow_maps, .. } = *inputs;
        let mask = self.draw_mask(rec, shared, inputs, surfaces)?;
        let no_caps = Vec::new();
        let caps = if objects.blueprints.is_empty() { &no_caps } else { look.caps() };
        let shading = BlendedShading {
            look,
            shading: &mut self.shading,
            shared: &mut shared.techniques,
            shadow_mask: &mut self.shadow_mask,
            shadow_maps,
        };
        let inputs = TranslucentInputs {
            seen,
            uniform: &surfaces.uniform,
            caps,
            mask: mask.as_ref(),
            shading,
            shadow_revisions: shadow_maps.iter().map(ShadowMap::revision).collect(),
        };
        let groups = TranslucentGroups { blended: &objects.blended, blueprints: &objects.blueprints };
        let state = self.translucent.get_or_insert_with(|| TranslucentState::new(rec.gpu));
        state.place(rec, &mut shared.gbuffer, groups, inputs, composition)
    }

    /// The depth mask; `None` where nobody asks for one.
    fn draw_mask(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
    ) -> Result<Option<Output<DepthMask>>, RenderError> {
        let objects = inputs.objects;
        let mask = if objects.blueprints.is_empty() || objects.masks.is_empty() {
            self.depth_mask.forget();
            None
        } else {
            let opaque = (&objects.surfaces, &surfaces.gbuffer);
            Some(self.depth_mask.run(rec, &mut shared.gbuffer, &inputs.seen, &objects.masks, opaque)?)
        };
        rec.note("depth mask", mask.as_ref().map(|mask| &mask.value.depth));
        Ok(mask)
    }
}
