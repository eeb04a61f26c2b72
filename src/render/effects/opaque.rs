//! A group of one layer: of objects that hide what lies behind them only the nearest surface of each pixel is drawn. Its geometry,
//! the shadows on it, its edges and what of them is hidden.

use std::sync::Arc;

use glam::{UVec2, Vec2};

use super::hidden::{Hidden, HiddenLines};
use crate::geometry::EdgeClass;
use crate::geometry::line_segments::SegmentSet;
use crate::gpu::{ArrayBuffer, Gpu, RecordList, Recorder, Target};
use crate::render::base::edge_styles::{EdgeStyles, EdgeStylesBuffer};
use crate::render::base::error::RenderError;
use crate::render::base::feature_lines::feature_lines;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::group::Group;
use crate::render::base::instances::{DrawCall, Instance, InstanceBuffer};
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::base::stroke_style::StrokeStyle;
use crate::render::base::view::View;
use crate::render::effects::technique::Shaded;
use crate::render::passes::composition::ink;
use crate::render::passes::edge_map::{EdgeInputs, EdgeMap, edge_map};
use crate::render::passes::gbuffer::GBuffer;
use crate::render::passes::layers::Reported;
use crate::render::passes::line_classes::{Decisions, LineClasses};
use crate::render::passes::line_distance::{LineDistance, Widths, line_distance};
use crate::render::passes::line_pixels::LinePixels;
use crate::render::passes::lines::Lines;
use crate::render::passes::segments::Segments;
use crate::render::passes::shadows::{ShadowMap, ShadowMask};
use crate::render::passes::traversal::{DrawList, GBufferPass};

/// A group of one layer as a camera sees it.
#[derive(Clone, Copy)]
pub struct OpaqueInputs<'a> {
    /// The scene as the camera sees it.
    pub scene_view: SceneView<'a>,
    /// The objects.
    pub group: &'a Group,
    /// All that is in bind group 0.
    pub uniform: &'a FrameUniform,
    /// The maps of the lights that throw shadows, by channel.
    pub shadow_maps: &'a [ShadowMap],
}

/// The surfaces of a group of one layer.
pub struct OpaqueSurfaces {
    /// Per-pixel geometry.
    pub gbuffer: Output<GBuffer>,
    /// See [`ShadowMask`]; `None` when no light throws shadows.
    pub shadow_mask: Option<Output<Target>>,
}

/// What of a group of one layer lives across frames.
pub struct OpaqueLayer {
    instances: InstanceBuffer,
    placed_segments: Segments,
    line_pixels: LinePixels,
    line_classes: LineClasses,
    greatest_radius: ArrayBuffer,
    edge_styles: EdgeStylesBuffer,
    gbuffer: Stage<GeometryKey, GBuffer>,
    segments: Stage<SegmentsKey, Arc<SegmentSet>>,
    edge_map: Stage<EdgeKey, EdgeMap>,
    line_distance: Stage<u64, LineDistance>,
    ink: Stage<InkKey, Target>,
    shadow_mask: ShadowMask,
    /// `None` while no object has any.
    hidden: Option<HiddenLines>,
}

/// What the G-buffer depends on.
#[derive(PartialEq)]
struct GeometryKey {
    shaders: u64,
    scene_revision: u64,
    size: UVec2,
    /// `None` where nothing is drawn: that looks the same from everywhere.
    through: Option<View>,
    instances: Vec<Instance>,
    calls: Vec<DrawCall>,
}

/// What the lines that topology knows depend on.
#[derive(PartialEq)]
struct SegmentsKey {
    scene_revision: u64,
    view: View,
    styles: EdgeStyles,
    crease_angle: f32,
    strokes: Option<StrokeStyle>,
}

/// What the edge map depends on.
#[derive(PartialEq)]
struct EdgeKey {
    gbuffer: u64,
    shadows: Option<u64>,
    styles: EdgeStyles,
    depth_range: Vec2,
    light: Option<FrameUniform>,
    strokes: Option<StrokeStyle>,
}

/// What the ink depends on.
#[derive(PartialEq)]
struct InkKey {
    gbuffer: u64,
    edges: u64,
    line_distance: Option<u64>,
    edge_styles: EdgeStyles,
    uniform: FrameUniform,
}

impl OpaqueLayer {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            instances: InstanceBuffer::new(gpu),
            placed_segments: Segments::new(gpu),
            line_pixels: LinePixels::new(gpu),
            line_classes: LineClasses::new(gpu),
            greatest_radius: ArrayBuffer::new(gpu, "greatest radius"),
            edge_styles: EdgeStylesBuffer::new(gpu),
            gbuffer: Stage::default(),
            segments: Stage::default(),
            edge_map: Stage::default(),
            line_distance: Stage::default(),
            ink: Stage::default(),
            shadow_mask: ShadowMask::new(gpu),
            hidden: None,
        }
    }

    /// Edge styles on the device.
    pub fn edge_styles(&self) -> &EdgeStylesBuffer {
        &self.edge_styles
    }

    /// Finds shadows, on other layers too.
    pub fn shadow_mask(&mut self) -> &mut ShadowMask {
        &mut self.shadow_mask
    }

    /// How often each stage has run, by name.
    pub fn runs(&self) -> [(&'static str, u64); 5] {
        [
            ("g-buffer", self.gbuffer.runs()),
            ("edge map", self.edge_map.runs()),
            ("line distance", self.line_distance.runs()),
            ("shadow", self.shadow_mask.runs()),
            ("hidden lines", self.hidden.as_ref().map_or(0, HiddenLines::runs)),
        ]
    }

    /// What has been reported about the layers of hidden lines. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        self.hidden.as_mut().map_or(Reported::Complete, HiddenLines::take_reports)
    }

    /// Draws the surfaces and the shadows on them.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn surfaces(
        &mut self,
        rec: &mut Recorder<'_>,
        pass: &mut GBufferPass,
        inputs: &OpaqueInputs<'_>,
    ) -> Result<OpaqueSurfaces, RenderError> {
        let OpaqueInputs { scene_view, group, shadow_maps, .. } = *inputs;
        let SceneView { scene, view, .. } = scene_view;
        self.edge_styles.write(rec.gpu, &group.edge_styles);
        let (instances, calls) = group.instances(scene, view);
        let key = GeometryKey {
            shaders: rec.pipelines.generation(),
            scene_revision: scene_view.scene_revision,
            size: view.size,
            through: (!calls.is_empty()).then_some(*view),
            instances,
            calls,
        };
        let gbuffer = self.gbuffer.run(key, |GeometryKey { instances, calls, .. }| {
            let draw_list = DrawList { scene, instances, calls, is_clipped: view.is_clipped() };
            pass.run(rec, &draw_list, &mut self.instances, None)
        })?;
        let shadow_mask = self.shadow_mask.run(rec, &gbuffer, &scene_view, shadow_maps)?;
        Ok(OpaqueSurfaces { gbuffer, shadow_mask })
    }

    /// The surfaces as shading asks for them; `uniform`: without the paper; `spines`: see [`Shaded`].
    pub fn shaded<'a>(
        &'a self,
        surfaces: &'a OpaqueSurfaces,
        scene_view: SceneView<'a>,
        uniform: &'a FrameUniform,
        spines: Option<(&'a Target, u64)>,
    ) -> Shaded<'a> {
        let drawn = self.gbuffer.inputs();
        Shaded {
            gbuffer: &surfaces.gbuffer.value,
            revision: Some(surfaces.gbuffer.revision),
            shadow_mask: surfaces.shadow_mask.as_ref().map(|mask| (&mask.value, mask.revision)),
            spines,
            scene_view,
            uniform,
            instance_buffer: &self.instances,
            instances: drawn.map_or(&[], |key| &key.instances),
            calls: drawn.map_or(&[], |key| &key.calls),
        }
    }

    /// The edges of the surfaces.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn edges(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &OpaqueInputs<'_>,
        surfaces: &OpaqueSurfaces,
    ) -> Result<Output<EdgeMap>, RenderError> {
        let OpaqueInputs { scene_view, group, uniform, .. } = *inputs;
        let styles = group.edge_styles.for_finding();
        // Only widths that follow the light depend on more than the geometry.
        let light = styles.styles().iter().any(|s| s.by_light > 0.0).then(|| uniform.without_background());
        // Which edges are lines does not change from sample to sample.
        let view = scene_view.view.moved(Vec2::ZERO);
        let key = SegmentsKey {
            scene_revision: scene_view.scene_revision,
            view,
            styles: styles.clone(),
            crease_angle: scene_view.crease_angle,
            strokes: group.strokes,
        };
        let segments = self.segments.run(key, |_| {
            // The device draws surfaces while lines are looked for.
            rec.flush();
            Ok::<_, RenderError>(Arc::new(feature_lines(
                scene_view.scene,
                group,
                &view,
                scene_view.crease_angle,
            )))
        })?;
        let has_borders = styles.styles().iter().any(|s| s.draws(EdgeClass::Shadow));
        let shadow_mask = surfaces.shadow_mask.as_ref().filter(|_| has_borders);
        let key = EdgeKey {
            gbuffer: surfaces.gbuffer.revision,
            shadows: shadow_mask.map(|mask| mask.revision),
            styles,
            depth_range: uniform.depth_range(),
            light,
            strokes: group.strokes,
        };
        self.edge_map.run(key, |EdgeKey { styles, .. }| {
            self.placed_segments.write(rec, &segments.value, false)?;
            let edges = edge_map(
                rec,
                &EdgeInputs {
                    gbuffer: &surfaces.gbuffer.value,
                    styles: styles.styles(),
                    edge_styles: &self.edge_styles,
                    nearer: None,
                    marked: None,
                    segments: &self.placed_segments,
                    has_holes: group.has_holes,
                    is_clipped: view.clip_plane.is_some(),
                    before: None,
                    shadow_mask: shadow_mask.map(|mask| &mask.value),
                },
            )?;
            let decisions = Decisions::of(styles.styles(), group.strokes.is_some());
            let gbuffer = &surfaces.gbuffer.value;
            let Self { line_classes, line_pixels, edge_styles, .. } = self;
            line_pixels.forget();
            line_classes.settle(rec, &edges, gbuffer, edge_styles, decisions, line_pixels)?;
            Ok(edges)
        })
    }

    /// The pixels of the lines of the last edges, of which these are the spines.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn line_pixels(
        &mut self,
        rec: &mut Recorder<'_>,
        spines: &Target,
    ) -> Result<&RecordList, RenderError> {
        Ok(self.line_pixels.list(rec, spines)?.list)
    }

    /// Lets go of the edges.
    pub fn forget_edges(&mut self) {
        self.edge_map.clear();
    }

    /// Which lines reach each pixel; `None`: none of exact mode does.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn line_distance(
        &mut self,
        rec: &mut Recorder<'_>,
        group: &Group,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Option<Output<LineDistance>>, RenderError> {
        let spines = edges.and_then(|edges| Some((edges.revision, edges.value.spines.as_ref()?)));
        let Some((revision, spines)) = spines else {
            self.line_distance.clear();
            return Ok(None);
        };
        let (radius, widths) = (&mut self.greatest_radius, Widths::of(group.edge_styles.styles()));
        let blocks = self.line_pixels.blocks();
        self.line_distance.run(revision, |_| line_distance(rec, spines, blocks, widths, radius)).map(Some)
    }

    /// The lines of the surfaces.
    pub fn lines<'a>(
        &'a self,
        group: &'a Group,
        surfaces: &'a OpaqueSurfaces,
        edges: &'a EdgeMap,
        line_distance: Option<&'a LineDistance>,
    ) -> Lines<'a> {
        Lines {
            gbuffer: &surfaces.gbuffer.value,
            edge_map: edges,
            line_distance,
            styles: group.edge_styles.styles(),
            edge_styles: &self.edge_styles,
        }
    }

    /// The ink of the lines, placed by depth; `None`: there are no lines.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn ink(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &OpaqueInputs<'_>,
        surfaces: &OpaqueSurfaces,
        edges: Option<&Output<EdgeMap>>,
        line_distance: Option<&Output<LineDistance>>,
    ) -> Result<Option<Output<Target>>, RenderError> {
        let OpaqueInputs { group, uniform, .. } = *inputs;
        let Some(edges) = edges.filter(|_| !group.is_empty()) else {
            self.ink.clear();
            return Ok(None);
        };
        let key = InkKey {
            gbuffer: surfaces.gbuffer.revision,
            edges: edges.revision,
            line_distance: line_distance.map(|line_distance| line_distance.revision),
            edge_styles: group.edge_styles.clone(),
            uniform: uniform.without_background(),
        };
        let drawn = Lines {
            gbuffer: &surfaces.gbuffer.value,
            edge_map: &edges.value,
            line_distance: line_distance.map(|line_distance| &line_distance.value),
            styles: group.edge_styles.styles(),
            edge_styles: &self.edge_styles,
        };
        self.ink.run(key, |_| ink(rec, &drawn)).map(Some)
    }

    /// Lets go of the ink.
    pub fn forget_ink(&mut self) {
        self.ink.clear();
    }

    /// The hidden lines of the surfaces: linear color times opacity, and opacity; `None`: they have none.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn hidden_lines(
        &mut self,
        rec: &mut Recorder<'_>,
        pass: &mut GBufferPass,
        inputs: &OpaqueInputs<'_>,
        asked: &Hidden,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Option<Output<Target>>, RenderError> {
        if asked.is_empty() {
            self.hidden = None;
            return Ok(None);
        }
        let hidden = self.hidden.get_or_insert_with(|| HiddenLines::new(rec.gpu));
        hidden.run(rec, pass, &inputs.scene_view, inputs.uniform, inputs.group, asked, edges).map(Some)
    }

    /// Lets go of what only a picture needs.
    pub fn forget_picture(&mut self) {
        self.line_distance.clear();
        self.ink.clear();
        self.hidden = None;
    }
}
