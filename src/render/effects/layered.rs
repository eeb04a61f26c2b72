//! A group that is split into depth layers, each with lines of its own: the walk that glass, blueprints, hidden lines and looks
//! at one layer have in common. They differ in what they ask of the layers, and in what they make of each.

use glam::Vec2;

use crate::document::LayersBy;
use crate::gpu::{Gpu, Recorder, Target};
use crate::render::base::edge_styles::{EdgeStyles, EdgeStylesBuffer};
use crate::render::base::error::RenderError;
use crate::render::base::feature_lines::plain_feature_lines;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::group::Group;
use crate::render::base::instances::{DrawCall, Instance};
use crate::render::base::scene_view::SceneView;
use crate::render::passes::count::LayerCount;
use crate::render::passes::designated::Uncover;
use crate::render::passes::layer_report::LayerReport;
use crate::render::passes::layers::{
    DrawnLayer, LayerEdges, LayerInputs, LayerLines, LayerLinesInputs, LayerMethod, Layers, Reported,
};
use crate::render::passes::lines::Lines;
use crate::render::passes::segments::Segments;
use crate::render::passes::traversal::{DrawList, GBufferPass};

/// A group as a camera sees it: what any picture of its layers depends on, by value.
#[derive(Clone, PartialEq)]
pub struct LayeredGroup {
    shaders: u64,
    scene_revision: u64,
    /// The objects.
    pub group: Group,
    /// The instances that are drawn of them.
    pub instances: Vec<Instance>,
    /// The draw calls of these instances.
    pub calls: Vec<DrawCall>,
    /// Bind group 0, without the paper.
    pub uniform: FrameUniform,
    scissor_rect: Option<[u32; 4]>,
    crease_angle: f32,
    layers_by: LayersBy,
}

impl LayeredGroup {
    /// A group as `scene_view` shows it; `uniform`: bind group 0.
    pub fn new(rec: &Recorder<'_>, scene_view: &SceneView<'_>, uniform: &FrameUniform, group: Group) -> Self {
        let (instances, calls) = group.instances(scene_view.scene, scene_view.view);
        Self {
            shaders: rec.pipelines.generation(),
            scene_revision: scene_view.scene_revision,
            group,
            instances,
            calls,
            uniform: uniform.without_background(),
            scissor_rect: scene_view.view.scissor_rect,
            crease_angle: scene_view.crease_angle,
            layers_by: scene_view.layers_by,
        }
    }
}

/// What is asked of the layers of a group; see [`LayerInputs`].
#[derive(Clone, Copy)]
pub struct LayerRequest<'a> {
    /// Most layers.
    pub max_layers: u32,
    /// It ends before a layer of fewer pixels.
    pub min_pixels: u32,
    /// What is to be uncovered.
    pub uncover: Option<Uncover<'a>>,
    /// How layers are to be made; `None`: as the document says.
    pub by: Option<LayersBy>,
    /// Whether their base colors are asked for.
    pub with_color: bool,
    /// Whether their shading normals are.
    pub with_normals: bool,
    /// Whether their depths are.
    pub with_depth: bool,
    /// How lines look; objects may differ from layer to layer, so there are as many as are told apart.
    pub line_styles: &'a [&'a EdgeStyles],
    /// Lines before the first layer, which are not repeated.
    pub nearer: Option<&'a Target>,
}

/// What is asked of the lines of one layer; see [`LayerLinesInputs`].
#[derive(Clone, Copy, Default)]
pub struct LineRequest<'a> {
    /// Index of [`LayerRequest::line_styles`].
    pub style: usize,
    /// Surface ids of the last layer and of that before it, if what goes on there has no outline.
    pub before: Option<[&'a Target; 2]>,
    /// Whether a line is drawn again where a nearer layer has one.
    pub repeated: bool,
}

/// One layer while it is being drawn.
pub struct Visit<'w> {
    /// The layer.
    pub drawn: DrawnLayer<'w>,
    lines: &'w mut [LayerLines],
    line_styles: &'w [&'w EdgeStyles],
    segments: &'w Segments,
    has_holes: bool,
    is_clipped: bool,
    nearer: &'w mut Option<Target>,
}

impl Visit<'_> {
    /// The edges of the layer.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn edges(
        &mut self,
        rec: &mut Recorder<'_>,
        request: LineRequest<'_>,
    ) -> Result<Option<LayerEdges>, RenderError> {
        let Some((lines, styles)) =
            self.lines.get_mut(request.style).zip(self.line_styles.get(request.style))
        else {
            return Ok(None);
        };
        let inputs = LayerLinesInputs {
            styles: styles.styles(),
            segments: self.segments,
            has_holes: self.has_holes,
            is_clipped: self.is_clipped,
            before: request.before,
            repeated: request.repeated,
        };
        lines.edges(rec, &inputs, self.drawn.layer, self.nearer).map(Some)
    }

    /// What draws them.
    pub fn lines<'a>(&'a self, edges: &'a LayerEdges, style: usize) -> Option<Lines<'a>> {
        let (lines, styles) = self.lines.get(style).zip(self.line_styles.get(style))?;
        Some(edges.lines(self.drawn.layer, lines, styles.styles()))
    }

    /// Edge styles on the device.
    pub fn edge_styles(&self, style: usize) -> Option<&EdgeStylesBuffer> {
        self.lines.get(style).map(LayerLines::edge_styles)
    }
}

/// What of the layers of a group lives across frames.
pub struct Layered {
    layers: Layers,
    lines: Vec<LayerLines>,
    segments: Segments,
}

impl Layered {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { layers: Layers::new(gpu), lines: Vec::new(), segments: Segments::new(gpu) }
    }

    /// What has been reported about its layers. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        self.layers.take_reports()
    }

    /// How far the last layers came of which that is known, and how they were made.
    pub fn last(&self) -> Option<&(LayerReport, LayerMethod)> {
        self.layers.last()
    }

    /// How far the last layers came, on the device.
    pub fn count(&self) -> &LayerCount {
        self.layers.count()
    }

    /// Splits a group into layers, and hands each to `draw`, the nearest first.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn walk(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        scene_view: &SceneView<'_>,
        layered: &LayeredGroup,
        request: &LayerRequest<'_>,
        mut draw: impl FnMut(&mut Recorder<'_>, Visit<'_>) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let Self { layers, lines, segments } = self;
        let LayeredGroup { group, instances, calls, .. } = layered;
        lines.resize_with(request.line_styles.len(), || LayerLines::new(rec.gpu));
        for (lines, styles) in lines.iter_mut().zip(request.line_styles) {
            lines.begin(rec.gpu, styles);
        }
        // Which edges are lines does not change from sample to sample.
        let view = scene_view.view.moved(Vec2::ZERO);
        segments.write(
            rec,
            &plain_feature_lines(scene_view.scene, group, &view, scene_view.crease_angle),
            true,
        )?;
        let mut nearer_lines = request.nearer.cloned();
        let inputs = LayerInputs {
            draw_list: DrawList {
                scene: scene_view.scene,
                instances,
                calls,
                is_clipped: scene_view.view.is_clipped(),
            },
            max_layers: request.max_layers,
            min_pixels: request.min_pixels,
            uncover: request.uncover,
            by: request.by.unwrap_or(scene_view.layers_by),
            with_color: request.with_color,
            with_normals: request.with_normals,
            with_depth: request.with_depth,
        };
        layers.each(rec, gbuffer_pass, &inputs, |rec, drawn| {
            let visit = Visit {
                drawn: *drawn,
                lines: &mut *lines,
                line_styles: request.line_styles,
                segments,
                has_holes: group.has_holes,
                is_clipped: scene_view.view.clip_plane.is_some(),
                nearer: &mut nearer_lines,
            };
            draw(rec, visit)
        })
    }
}

/// So many pixels are this share of a picture, percent: a layer of fewer ends layers, an empty one at the latest.
pub fn min_pixels(percent: f32, [width, height]: [u32; 2]) -> u32 {
    let share = f64::from(percent) / 100.0;
    ((share * f64::from(width) * f64::from(height)).ceil() as u32).max(1)
}
