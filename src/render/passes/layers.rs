//! A group split into depth layers, one behind the other, and the lines of each (blueprints paper, sections 3 and 4.1).
//!
//! ```text
//! draws ─► fragment lists, where the device can
//!            │┌──────────────────────────────────────────────┐
//!            ▼▼                                              │
//! (draws ─►) layer i ─► count ─► what the caller makes of it ─┘
//!                       └─► predicate: too few pixels disable it, or enough of the depth mask, and nothing after that runs
//! ```
//!
//! How many layers are recorded, and how many fragments there is memory for, is guessed from reports about earlier pictures;
//! a wrong guess is reported too, and the picture drawn again.

mod budget;

pub use self::budget::{LayerMethod, Reason, Reported};

use self::budget::{Budget, Recorded};
use crate::document::LayersBy;
use crate::gpu::{ArrayBuffer, Gpu, Predicate, Recorder, Reports, Target};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::edge_styles::{EdgeStyles, EdgeStylesBuffer};
use crate::render::base::error::RenderError;
use crate::render::base::instances::{DrawCall, InstanceBuffer};
use crate::render::passes::count::{Layer, LayerCount, MAX_LAYERS, report_from_bytes};
use crate::render::passes::designated::Uncover;
use crate::render::passes::edge_map::{EdgeInputs, EdgeMap, edge_map};
use crate::render::passes::fragment_lists::LayerOutputs;
use crate::render::passes::layer_report::LayerReport;
use crate::render::passes::line_distance::{LineDistance, Widths, line_distance};
use crate::render::passes::lines::Lines;
use crate::render::passes::peel::{Peel, before_all};
use crate::render::passes::repeated::NearerLines;
use crate::render::passes::segments::Segments;
use crate::render::passes::traversal::{DrawList, GBufferPass};

/// Kinds of passes that a layer has beside the draw calls of its objects: entries of the predicate.
const PASSES: usize = 32;

/// What is split into layers, and how far.
#[derive(Clone, Copy)]
pub struct LayerInputs<'a> {
    /// What is drawn.
    pub draw_list: DrawList<'a>,
    /// Most layers, up to [`MAX_LAYERS`].
    pub max_layers: u32,
    /// It ends before a layer of fewer pixels, at the latest before an empty one.
    pub min_pixels: u32,
    /// What it is to uncover, before it has come to `max_layers`.
    pub uncover: Option<Uncover<'a>>,
    /// How layers are to be made.
    pub by: LayersBy,
    /// Whether their base color is asked for.
    pub with_color: bool,
    /// Whether their shading normals are; otherwise they are those of the faces.
    pub with_normals: bool,
    /// Whether their depth is; see [`crate::render::passes::gbuffer::GBuffer::depth`].
    pub with_depth: bool,
}

/// A layer that has been extracted.
#[derive(Clone, Copy)]
pub struct DrawnLayer<'a> {
    /// Its number, from 0 on.
    pub number: u32,
    /// What is in its pixels.
    pub layer: &'a Layer,
    /// How far layers have come, this one included.
    pub count: &'a LayerCount,
    /// What was drawn.
    pub instance_buffer: &'a InstanceBuffer,
}

/// What of the layers of a group lives across frames.
pub struct Layers {
    instances: InstanceBuffer,
    predicate: Option<Predicate>,
    count: LayerCount,
    reports: Reports<Recorded>,
    /// The latest report, and how those layers were made.
    last: Option<(LayerReport, LayerMethod)>,
    budget: Budget,
}

impl Layers {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            instances: InstanceBuffer::new(gpu),
            predicate: None,
            count: LayerCount::new(gpu),
            reports: Reports::default(),
            last: None,
            budget: Budget::default(),
        }
    }

    /// What has been reported since the last call. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        let Some((recorded, bytes)) = self.reports.take() else {
            return if self.reports.is_waiting() { Reported::Waiting } else { Reported::Complete };
        };
        let report = report_from_bytes(&bytes);
        let is_complete = self.budget.learn(&recorded, &report);
        self.last = Some((report, recorded.by()));
        match is_complete {
            false => Reported::Incomplete,
            true if self.reports.is_waiting() => Reported::Waiting,
            true => Reported::Complete,
        }
    }

    /// How far the last picture came whose report has arrived, and how its layers were made.
    pub fn last(&self) -> Option<&(LayerReport, LayerMethod)> {
        self.last.as_ref()
    }

    /// How far the last ones came.
    pub fn count(&self) -> &LayerCount {
        &self.count
    }

    /// Hands each layer to `draw`, the nearest first. What it records is left out by the device once layers have ended.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn each(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &LayerInputs<'_>,
        draw: impl FnMut(&mut Recorder<'_>, &DrawnLayer<'_>) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let plain: Vec<DrawCall>;
        let mut inputs = *inputs;
        if !inputs.with_color && !inputs.with_normals {
            plain = inputs.draw_list.calls.iter().map(DrawCall::without_attributes).collect();
            inputs.draw_list.calls = &plain;
        }
        self.count.begin(rec.gpu, inputs.min_pixels.max(1), inputs.uncover);
        let mut recorded =
            self.budget.plan(rec.gpu, rec.size(), inputs.max_layers.min(MAX_LAYERS), inputs.by);
        let mut predicate = self.predicate.take().unwrap_or_else(|| Predicate::new(rec.gpu));
        // Objects may be drawn once more, for their coordinates.
        predicate.reset(rec.gpu, 2 * inputs.draw_list.calls.len() + PASSES)?;
        rec.predicate = Some(predicate);
        let drawn = self.draw_each(rec, gbuffer_pass, &inputs, &mut recorded, draw);
        self.predicate = rec.predicate.take();
        self.reports.send(rec, self.count.buffer(), recorded);
        if let Some(predicate) = &self.predicate {
            predicate.enable(rec.gpu);
        }
        drawn
    }

    fn draw_each(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &LayerInputs<'_>,
        recorded: &mut Recorded,
        mut draw: impl FnMut(&mut Recorder<'_>, &DrawnLayer<'_>) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let LayerInputs { draw_list, with_color, .. } = inputs;
        let with_color = *with_color;
        let mask = inputs.uncover.map(|uncover| uncover.mask);
        if let Ok(budget) = &mut recorded.fragments {
            *budget = gbuffer_pass.lists.begin(rec, *budget)?;
            gbuffer_pass.collect(rec, draw_list, &mut self.instances, with_color, &self.count)?;
        }
        let mut lists = match recorded.by() {
            LayerMethod::Lists => Some(gbuffer_pass.lists.extract(rec, recorded.layers)?),
            LayerMethod::Peeling(_) => None,
        };
        let with_depth = inputs.with_depth || mask.is_some();
        let mut last = None;
        for number in 0..recorded.layers {
            let layer = match &mut lists {
                Some(lists) => {
                    let with_normals = inputs.with_normals;
                    lists.next(rec, LayerOutputs { with_color, with_normals, with_depth })?
                }
                None => {
                    let before = match last.take() {
                        Some(last) => last,
                        None => before_all(rec)?,
                    };
                    last = match recorded.only_counts(number) {
                        true => None,
                        false => Some(rec.target("sort keys", before.format())?),
                    };
                    let peel = Peel { last: &before, sort_keys: last.as_ref(), with_color };
                    let gbuffer = gbuffer_pass.run(rec, draw_list, &mut self.instances, Some(&peel))?;
                    Layer { gbuffer, marked: None }
                }
            };
            self.count.count(rec, &layer, mask)?;
            if recorded.only_counts(number) {
                break;
            }
            let Self { count, instances: instance_buffer, .. } = &*self;
            draw(rec, &DrawnLayer { number, layer: &layer, count, instance_buffer })?;
            if let Some(mask) = mask {
                self.count.end_where_uncovered(rec, &layer, mask)?;
            }
        }
        Ok(())
    }
}

/// What of the lines of layers lives across frames.
pub struct LayerLines {
    edge_styles: EdgeStylesBuffer,
    greatest_radius: ArrayBuffer,
}

/// What the lines of the layers of one group depend on.
#[derive(Clone, Copy)]
pub struct LayerLinesInputs<'a> {
    /// The edge styles of its objects.
    pub styles: &'a [GpuEdgeStyle],
    /// What topology knows, hidden edges included.
    pub segments: &'a Segments,
    /// Whether any material of an object with lines has holes.
    pub has_holes: bool,
    /// Whether what lies behind a mirror's plane is left out.
    pub is_clipped: bool,
    /// See [`EdgeInputs::before`].
    pub before: Option<[&'a Target; 2]>,
    /// Whether a line is drawn again where a nearer layer has one at the same place (Fig. 5).
    pub repeated: bool,
}

/// The edges of one layer.
pub struct LayerEdges {
    /// The edge map, without repeated ones if they are left out.
    pub edge_map: EdgeMap,
    /// How far its lines reach; `None` without exact ones.
    pub line_distance: Option<LineDistance>,
    /// Where nearer layers have lines; `None` if repeated ones are drawn.
    pub nearer: Option<Target>,
}

impl LayerEdges {
    /// What draws them on `layer`.
    pub fn lines<'a>(
        &'a self,
        layer: &'a Layer,
        lines: &'a LayerLines,
        styles: &'a [GpuEdgeStyle],
    ) -> Lines<'a> {
        Lines {
            gbuffer: &layer.gbuffer,
            edge_map: &self.edge_map,
            line_distance: self.line_distance.as_ref(),
            styles,
            edge_styles: &lines.edge_styles,
        }
    }
}

impl LayerLines {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            edge_styles: EdgeStylesBuffer::new(gpu),
            greatest_radius: ArrayBuffer::new(gpu, "greatest radius"),
        }
    }

    /// Uploads the styles for what is recorded next.
    pub fn begin(&mut self, gpu: &Gpu, styles: &EdgeStyles) {
        self.edge_styles.write(gpu, styles);
    }

    /// Edge styles on the device.
    pub fn edge_styles(&self) -> &EdgeStylesBuffer {
        &self.edge_styles
    }

    /// The edges of the next layer. `nearer`: where the layers before it have lines, to which those of this layer are added.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn edges(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &LayerLinesInputs<'_>,
        layer: &Layer,
        nearer: &mut Option<Target>,
    ) -> Result<LayerEdges, RenderError> {
        let own = match inputs.repeated {
            true => None,
            false => Some(NearerLines::behind(rec, nearer.take())?),
        };
        let edge_map = edge_map(
            rec,
            &EdgeInputs {
                gbuffer: &layer.gbuffer,
                styles: inputs.styles,
                edge_styles: &self.edge_styles,
                segments: inputs.segments,
                has_holes: inputs.has_holes,
                is_clipped: inputs.is_clipped,
                before: inputs.before,
                shadow_mask: None,
                nearer: own.as_ref(),
                marked: layer.marked,
            },
        )?;
        let (before, now) = own.map(|NearerLines { before, now }| (before, now)).unzip();
        *nearer = now;
        let line_distance = match &edge_map.spines {
            Some(spines) => {
                Some(line_distance(rec, spines, None, Widths::of(inputs.styles), &mut self.greatest_radius)?)
            }
            None => None,
        };
        Ok(LayerEdges { edge_map, line_distance, nearer: before })
    }
}
