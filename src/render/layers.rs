//! A group cut into depth layers, one behind the other, and the lines of each (blueprints paper, sections 3 and 4.1).
//!
//! ```text
//!            ┌──────────────────────────────────────────────┐
//!            ▼                                              │
//! draws ─► layer i ─► count ─► what the caller makes of it ─┘
//!                       └─► gate: too few pixels shut it, or enough of the depth mask, and nothing after that runs
//! ```

use crate::geometry::LineSegment;
use crate::gpu::{ArrayBuffer, DynamicBuffer, Gate, Gpu, Recorder, Reports, Target};
use crate::render::RenderError;
use crate::render::gpu_scene::GpuScene;
use crate::render::passes::depth_mask::DepthMask;
use crate::render::passes::edge_map::{EdgeInputs, EdgeMap, EdgeMapPass};
use crate::render::passes::edge_style::EdgeUniform;
use crate::render::passes::gbuffer::{DrawCall, DrawUniform, GBufferPass};
use crate::render::passes::line_distance::{Reach, line_distance};
use crate::render::passes::lines::Lines;
use crate::render::passes::peel::{Layer, MOST_LAYERS, Peel, PeelCount, Peeled, before_all};
use crate::render::passes::repeated::{none_seen, without_repeated};

/// Kinds of passes that a layer has beside the draws of its objects: room in the gate.
const PASSES: usize = 24;

/// What is cut into layers, and how far.
#[derive(Clone, Copy)]
pub struct LayerInputs<'a> {
    /// The scene on the device.
    pub scene: &'a GpuScene,
    /// The uniforms of all draws.
    pub draws: &'a [DrawUniform],
    /// The draws.
    pub calls: &'a [DrawCall],
    /// Whether what lies behind a plane is left out.
    pub is_cut: bool,
    /// Most layers, up to [`MOST_LAYERS`].
    pub most: u32,
    /// It ends before a layer of fewer pixels, at the latest before an empty one.
    pub least: u32,
    /// The designated objects: it ends with the layer that leaves `fraction` (0 to 1) of them uncovered.
    pub mask: Option<&'a DepthMask>,
    /// See `mask`.
    pub fraction: f32,
}

/// More layers are recorded than the last report names, as there may be more by now.
const MORE_LAYERS: u32 = 1;

/// What is known of pictures that were drawn, from reports that come back some time after them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reported {
    /// All of them are complete.
    Complete,
    /// Not yet all about the last one.
    Waiting,
    /// One was incomplete, as there was not room enough. Whoever wants it asks for it again: there is now.
    Incomplete,
}

/// What the processor has to know of a frame to understand its report.
#[derive(Debug, Clone, Copy)]
struct Recorded {
    /// So many layers were recorded, of so many that were asked for.
    layers: u32,
    most: u32,
}

/// What of the layers of a group lives across frames.
pub struct Layers {
    draws: DynamicBuffer,
    gate: Option<Gate>,
    count: PeelCount,
    reports: Reports<Recorded>,
    /// The latest report.
    last: Option<Peeled>,
    /// How many layers there were then: how many to record is guessed from it; `None`: all.
    guess: Option<u32>,
}

impl Layers {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            draws: GBufferPass::draw_buffer(gpu),
            gate: None,
            count: PeelCount::new(gpu),
            reports: Reports::default(),
            last: None,
            guess: None,
        }
    }

    /// What has been reported since the last call. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        let mut reported = Reported::Complete;
        if let Some((recorded, bytes)) = self.reports.take() {
            let peeled = Peeled::from_bytes(&bytes);
            let is_complete = peeled.has_ended == 1 || recorded.layers >= recorded.most;
            self.guess = is_complete.then_some(peeled.layers + 1);
            if !is_complete {
                reported = Reported::Incomplete;
            }
            self.last = Some(peeled);
        }
        if reported == Reported::Complete && self.reports.is_waiting() { Reported::Waiting } else { reported }
    }

    /// How far the last picture came whose report has arrived.
    pub fn last(&self) -> Option<&Peeled> {
        self.last.as_ref()
    }

    /// How far the last ones came.
    pub fn count(&self) -> &PeelCount {
        &self.count
    }

    /// Hands each layer to `draw`, the nearest first, with its number from 0 on and their count so far. What it
    /// records is left out by the device once layers have ended.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn each(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &LayerInputs<'_>,
        draw: impl FnMut(&mut Recorder<'_>, u32, &Layer, &PeelCount) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        self.count.begin(rec.gpu, inputs.least.max(1), inputs.fraction);
        let mut gate = self.gate.take().unwrap_or_else(|| Gate::new(rec.gpu));
        gate.clear(rec.gpu, inputs.calls.len() + PASSES)?;
        let first = before_all(rec)?;
        rec.gate = Some(gate);
        let peeled = self.peel(rec, gbuffer_pass, inputs, first, draw);
        self.gate = rec.gate.take();
        let most = inputs.most.min(MOST_LAYERS);
        self.reports.send(rec, self.count.buffer(), Recorded { layers: self.recorded(most), most });
        if let Some(gate) = &self.gate {
            gate.open(rec.gpu);
        }
        peeled
    }

    /// How many of so many layers are recorded. The guess decides nothing: when it is wrong, the report says so.
    fn recorded(&self, most: u32) -> u32 {
        self.guess.map_or(most, |guess| (guess + MORE_LAYERS).min(most))
    }

    fn peel(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &LayerInputs<'_>,
        [mut last_depth, mut last_order]: [Target; 2],
        mut draw: impl FnMut(&mut Recorder<'_>, u32, &Layer, &PeelCount) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let LayerInputs { scene, draws, calls, is_cut, mask, .. } = *inputs;
        for number in 0..self.recorded(inputs.most.min(MOST_LAYERS)) {
            let order = rec.target("order", last_order.format())?;
            let peel = Peel { last_depth: &last_depth, last_order: &last_order, order: &order };
            let gbuffer =
                gbuffer_pass.run(rec, scene, &mut self.draws, (draws, calls), is_cut, Some(&peel))?;
            let layer = Layer { gbuffer, order };
            self.count.count(rec, &layer, mask)?;
            draw(rec, number, &layer, &self.count)?;
            if let Some(mask) = mask {
                self.count.end_where_uncovered(rec, &layer, mask)?;
            }
            (last_depth, last_order) = (layer.gbuffer.depth, layer.order);
        }
        Ok(())
    }
}

/// What of the lines of layers lives across frames.
pub struct LayerLines {
    edge_map_pass: EdgeMapPass,
    edge_styles: ArrayBuffer,
    greatest_radius: ArrayBuffer,
}

/// What the lines of the layers of one group depend on.
#[derive(Clone, Copy)]
pub struct LayerLinesInputs<'a> {
    /// Edge styles by object id.
    pub styles: &'a [EdgeUniform],
    /// What topology knows, hidden edges included.
    pub segments: &'a [LineSegment],
    /// Whether any material of an object with lines has holes.
    pub has_holes: bool,
    /// Whether what lies behind a plane is left out.
    pub is_cut: bool,
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
    pub reach: Option<Reach>,
    /// Where nearer layers have lines; `None` if repeated ones are drawn.
    pub nearer: Option<Target>,
}

impl LayerEdges {
    /// What draws them on `layer`.
    pub fn lines<'a>(
        &'a self,
        layer: &'a Layer,
        lines: &'a LayerLines,
        styles: &'a [EdgeUniform],
    ) -> Lines<'a> {
        Lines {
            gbuffer: &layer.gbuffer,
            edge_map: &self.edge_map,
            reach: self.reach.as_ref(),
            styles,
            edge_styles: lines.edge_styles.buffer(),
        }
    }
}

impl LayerLines {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            edge_map_pass: EdgeMapPass::new(gpu),
            edge_styles: ArrayBuffer::new(gpu, "edge styles of layers"),
            greatest_radius: ArrayBuffer::new(gpu, "greatest radius"),
        }
    }

    /// Uploads the styles for what is recorded next.
    pub fn begin(&mut self, gpu: &Gpu, styles: &Vec<EdgeUniform>) {
        self.edge_styles.write(gpu, styles);
    }

    /// Edge styles by object id on the device.
    pub fn edge_styles(&self) -> &wgpu::Buffer {
        self.edge_styles.buffer()
    }

    /// The edges of the next layer; `seen`: those of the layers before, of which it becomes one.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn edges(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &LayerLinesInputs<'_>,
        layer: &Layer,
        seen: &mut Option<Target>,
    ) -> Result<LayerEdges, RenderError> {
        let mut edge_map = self.edge_map_pass.run(
            rec,
            &EdgeInputs {
                gbuffer: &layer.gbuffer,
                styles: inputs.styles,
                edge_styles: self.edge_styles.buffer(),
                segments: inputs.segments,
                has_holes: inputs.has_holes,
                is_cut: inputs.is_cut,
                is_layer: true,
                before: inputs.before,
                shadow_mask: None,
            },
        )?;
        let mut nearer = None;
        if !inputs.repeated {
            let before = match seen.take() {
                Some(seen) => seen,
                None => none_seen(rec)?,
            };
            let (now, own) = without_repeated(rec, &edge_map, &before)?;
            (*seen, edge_map, nearer) = (Some(now), own, Some(before));
        }
        let reach = match &edge_map.spines {
            Some(spines) => Some(line_distance(rec, spines, inputs.styles, &mut self.greatest_radius)?),
            None => None,
        };
        Ok(LayerEdges { edge_map, reach, nearer })
    }
}
