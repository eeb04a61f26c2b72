//! A group cut into depth layers, one behind the other, and the lines of each (blueprints paper, sections 3 and 4.1).
//!
//! ```text
//!            ┌──────────────────────────────────────────────┐
//!            ▼                                              │
//! draws ─► layer i ─► count ─► what the caller makes of it ─┘
//!                       └─► gate: too few pixels shut it, and nothing after that runs
//! ```

use crate::geometry::LineSegment;
use crate::gpu::{ArrayBuffer, DynamicBuffer, Gate, Gpu, Recorder, Target};
use crate::render::RenderError;
use crate::render::gpu_scene::GpuScene;
use crate::render::passes::edge_map::{EdgeInputs, EdgeMap, EdgeMapPass};
use crate::render::passes::edge_style::EdgeUniform;
use crate::render::passes::gbuffer::{DrawCall, DrawUniform, GBufferPass};
use crate::render::passes::line_distance::{Reach, line_distance};
use crate::render::passes::lines::Lines;
use crate::render::passes::peel::{Layer, MOST_LAYERS, Peel, PeelCount, before_all};
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
}

/// What of the layers of a group lives across frames.
pub struct Layers {
    draws: DynamicBuffer,
    gate: Option<Gate>,
    count: PeelCount,
}

impl Layers {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { draws: GBufferPass::draw_buffer(gpu), gate: None, count: PeelCount::new(gpu) }
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
        self.count.begin(rec.gpu, inputs.least.max(1));
        let mut gate = self.gate.take().unwrap_or_else(|| Gate::new(rec.gpu));
        gate.clear(rec.gpu, inputs.calls.len() + PASSES)?;
        let first = before_all(rec)?;
        rec.gate = Some(gate);
        let peeled = self.peel(rec, gbuffer_pass, inputs, first, draw);
        self.gate = rec.gate.take();
        if let Some(gate) = &self.gate {
            gate.open(rec.gpu);
        }
        peeled
    }

    fn peel(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &LayerInputs<'_>,
        [mut last_depth, mut last_order]: [Target; 2],
        mut draw: impl FnMut(&mut Recorder<'_>, u32, &Layer, &PeelCount) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let LayerInputs { scene, draws, calls, is_cut, .. } = *inputs;
        for number in 0..inputs.most.min(MOST_LAYERS) {
            let order = rec.target("order", last_order.format())?;
            let peel = Peel { last_depth: &last_depth, last_order: &last_order, order: &order };
            let gbuffer =
                gbuffer_pass.run(rec, scene, &mut self.draws, (draws, calls), is_cut, Some(&peel))?;
            let layer = Layer { gbuffer, order };
            self.count.count(rec, &layer)?;
            draw(rec, number, &layer, &self.count)?;
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
    /// Whether what lies behind a mirror's plane is left out.
    pub is_cut: bool,
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
