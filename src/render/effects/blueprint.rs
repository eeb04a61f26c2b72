//! Blueprints: the depth layers of a group, each with lines over a fill, composited in depth order (Nienhaus and Döllner 2004,
//! section 4).
//!
//! ```text
//!            ┌────────────────────────────────────────────────────────┐
//!            ▼                                                        │
//! draws ─► layer i ─► count ─► edge map ─► lines ─► beneath the layers before ─► picture of the group
//!                       └─► gate: too few pixels shut it, and nothing after that runs
//! ```
//!
//! The paper blends the layers back to front; front to back, each beneath those before it, gives the same picture with two
//! layers in memory instead of all, and ends wherever peeling does.

use std::sync::Arc;

use encase::ShaderType;
use glam::Vec3;

use crate::geometry::LineSegment;
use crate::gpu::recorder::{Draw, Input, Onto};
use crate::gpu::{ArrayBuffer, DepthRule, DynamicBuffer, Gate, Gpu, Program, Recorder, Target};
use crate::render::RenderError;
use crate::render::drawing::DrawingInputs;
use crate::render::effects::section::{CapUniform, caps};
use crate::render::frame_uniform::FrameUniform;
use crate::render::groups::Group;
use crate::render::passes::edge_map::{EdgeInputs, EdgeMapPass};
use crate::render::passes::edge_style::EdgeUniform;
use crate::render::passes::gbuffer::{DrawCall, DrawUniform, GBuffer, GBufferPass};
use crate::render::passes::line_distance::line_distance;
use crate::render::passes::lines::{Lines, Pen, lines};
use crate::render::passes::peel::{Layer, MOST_LAYERS, Peel, PeelCount, before_all};
use crate::render::passes::repeated::{none_seen, without_repeated};
use crate::render::segments::segments;
use crate::render::stage::{Output, Stage};
use crate::style::{self, Edges, Style};

/// Kinds of passes that a layer has beside the draws of its objects: room in the gate.
const PASSES: usize = 16;

/// Objects whose style is equal, peeled together.
#[derive(Debug, Clone, PartialEq)]
pub struct Blueprint {
    /// The objects.
    pub group: Group,
    style: style::Blueprint,
    edges: Edges,
}

/// Twin of `Blueprint` in `shaders/effects/blueprint.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct BlueprintUniform {
    near: Vec3,
    by_layer: f32,
    far: Vec3,
    by_distance: f32,
    fill: Vec3,
    opacity: f32,
}

impl From<&style::Blueprint> for BlueprintUniform {
    fn from(style: &style::Blueprint) -> Self {
        Self {
            near: style.near.to_linear(),
            by_layer: style.by_layer.clamp(0.0, 1.0),
            far: style.far.to_linear(),
            by_distance: style.by_distance.clamp(0.0, 1.0),
            fill: style.fill.to_linear(),
            opacity: style.opacity.clamp(0.0, 1.0),
        }
    }
}

impl Blueprint {
    /// The group to which an object of this style belongs, in a scene with `count` object ids.
    pub fn group_of<'a>(all: &'a mut Vec<Self>, style: &Style, count: usize) -> &'a mut Group {
        let found = all.iter().position(|b| b.style == style.blueprint && b.edges == style.edges);
        let index = found.unwrap_or(all.len());
        if found.is_none() {
            all.push(Self {
                group: Group::with_hidden(count),
                style: style.blueprint.clone(),
                edges: style.edges.clone(),
            });
        }
        &mut all[index].group
    }

    /// Most layers that are peeled: no more than are drawn.
    fn layers(&self) -> u32 {
        self.style.layers.min(self.style.to).min(MOST_LAYERS)
    }

    /// A layer of fewer pixels ends it: an empty one at the latest.
    fn least(&self, [width, height]: [u32; 2]) -> u32 {
        let share = f64::from(self.style.least.clamp(0.0, 100.0)) / 100.0;
        ((share * f64::from(width) * f64::from(height)).ceil() as u32).max(1)
    }

    fn shows(&self, layer: u32) -> bool {
        layer + 1 >= self.style.from
    }
}

/// A group, drawn.
#[derive(Debug, Clone)]
pub struct Peels {
    /// Linear colour times opacity, and opacity.
    pub color: Target,
    /// Geometry of the first layer that is drawn; `None` when none is.
    pub front: Option<Target>,
    /// The layers, where they are kept: as many as may be peeled, of which those after the last one are empty.
    pub layers: Vec<Layer>,
}

/// What a group's picture depends on.
#[derive(PartialEq)]
struct Inputs {
    shaders: u64,
    scene_revision: u64,
    surfaces: u64,
    blueprint: Blueprint,
    draws: Vec<DrawUniform>,
    calls: Vec<DrawCall>,
    uniform: FrameUniform,
    part: Option<[u32; 4]>,
    crease_angle: f32,
    caps: Vec<CapUniform>,
    keeps_layers: bool,
}

/// What of the drawing of a group lives across frames.
pub struct Blueprints {
    draws: DynamicBuffer,
    edge_map_pass: EdgeMapPass,
    edge_styles: ArrayBuffer,
    greatest_radius: ArrayBuffer,
    style: ArrayBuffer,
    caps: ArrayBuffer,
    gate: Option<Gate>,
    count: PeelCount,
    stage: Stage<Inputs, Peels>,
}

impl Blueprints {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            draws: GBufferPass::draw_buffer(gpu),
            edge_map_pass: EdgeMapPass::new(gpu),
            edge_styles: ArrayBuffer::new(gpu, "edge styles of a blueprint"),
            greatest_radius: ArrayBuffer::new(gpu, "greatest radius"),
            style: ArrayBuffer::new(gpu, "blueprint"),
            caps: ArrayBuffer::new(gpu, "caps"),
            gate: None,
            count: PeelCount::new(gpu),
            stage: Stage::default(),
        }
    }

    /// How often a picture was drawn.
    pub fn runs(&self) -> u64 {
        self.stage.runs()
    }

    /// How far peeling came in the last picture.
    pub fn count(&self) -> &PeelCount {
        &self.count
    }

    /// The picture of a group, as far as opaque surfaces do not hide it.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &DrawingInputs<'_>,
        (uniform, surfaces): (&FrameUniform, &Output<GBuffer>),
        blueprint: &Blueprint,
    ) -> Result<Output<Peels>, RenderError> {
        let (draws, calls) = blueprint.group.draws(inputs.scene, inputs.view);
        let asked = Inputs {
            shaders: rec.pipelines.generation(),
            scene_revision: inputs.scene_revision,
            surfaces: surfaces.revision,
            blueprint: blueprint.clone(),
            draws,
            calls,
            uniform: uniform.without_background(),
            part: inputs.view.part,
            crease_angle: inputs.crease_angle,
            caps: caps(inputs.scene, inputs.view, inputs.objects.scale),
            keeps_layers: inputs.keeps_layers,
        };
        let Self { draws, edge_map_pass, edge_styles, greatest_radius, style, caps, gate, count, stage } = self;
        stage.run(asked, |asked| {
            edge_styles.write(rec.gpu, &blueprint.group.edge_styles);
            style.write(rec.gpu, &vec![BlueprintUniform::from(&blueprint.style)]);
            if !asked.caps.is_empty() {
                caps.write(rec.gpu, &asked.caps);
            }
            count.begin(rec.gpu, blueprint.least(rec.size()));
            let mut own = gate.take().unwrap_or_else(|| Gate::new(rec.gpu));
            own.clear(rec.gpu, asked.calls.len() + PASSES)?;
            let view = inputs.view.moved(glam::Vec2::ZERO);
            let segments = segments(inputs.scene, &blueprint.group, &view, inputs.crease_angle);
            let mut peeling = Peeling {
                inputs,
                asked,
                surfaces: &surfaces.value,
                segments: Arc::new(segments),
                gbuffer_pass,
                draws,
                edge_map_pass,
                edge_styles,
                greatest_radius,
                style,
                caps,
                count,
                front: None,
                kept: Vec::new(),
            };
            let color = rec.target("blueprint", wgpu::TextureFormat::Rgba16Float)?;
            rec.clear("blueprint", &color);
            let first = before_all(rec)?;
            rec.gate = Some(own);
            let peeled = peeling.peel(rec, first, &color);
            *gate = rec.gate.take();
            if let Some(gate) = gate {
                gate.open(rec.gpu);
            }
            let Peeling { front, kept: layers, .. } = peeling;
            peeled.map(|()| Peels { color, front, layers })
        })
    }
}

/// A group while it is peeled.
struct Peeling<'a> {
    inputs: &'a DrawingInputs<'a>,
    asked: &'a Inputs,
    surfaces: &'a GBuffer,
    segments: Arc<Vec<LineSegment>>,
    gbuffer_pass: &'a mut GBufferPass,
    draws: &'a mut DynamicBuffer,
    edge_map_pass: &'a mut EdgeMapPass,
    edge_styles: &'a ArrayBuffer,
    greatest_radius: &'a mut ArrayBuffer,
    style: &'a ArrayBuffer,
    caps: &'a ArrayBuffer,
    count: &'a PeelCount,
    front: Option<Target>,
    kept: Vec<Layer>,
}

impl Peeling<'_> {
    fn peel(
        &mut self,
        rec: &mut Recorder<'_>,
        [mut last_depth, mut last_order]: [Target; 2],
        color: &Target,
    ) -> Result<(), RenderError> {
        let blueprint = &self.asked.blueprint;
        let mut seen = None;
        for number in 0..blueprint.layers() {
            let order = rec.target("order", last_order.format())?;
            let peel = Peel { last_depth: &last_depth, last_order: &last_order, order: &order };
            let drawn = (self.asked.draws.as_slice(), self.asked.calls.as_slice());
            let is_cut = self.inputs.view.has_cuts();
            let gbuffer =
                self.gbuffer_pass.run(rec, self.inputs.scene, self.draws, drawn, is_cut, Some(&peel))?;
            let layer = Layer { gbuffer, order };
            self.count.count(rec, &layer)?;
            if blueprint.shows(number) {
                self.front.get_or_insert_with(|| layer.gbuffer.geometry.clone());
                if blueprint.group.have_lines() {
                    self.lines(rec, &layer, &mut seen, color)?;
                }
                self.fill(rec, &layer, color)?;
            }
            if self.asked.keeps_layers {
                self.kept.push(layer.clone());
            }
            (last_depth, last_order) = (layer.gbuffer.depth, layer.order);
        }
        Ok(())
    }

    /// Draws the lines of a layer beneath what is there. `seen`: those of the layers before.
    fn lines(
        &mut self,
        rec: &mut Recorder<'_>,
        layer: &Layer,
        seen: &mut Option<Target>,
        color: &Target,
    ) -> Result<(), RenderError> {
        let Blueprint { group, style, .. } = &self.asked.blueprint;
        let styles: &[EdgeUniform] = &group.edge_styles;
        let mut edge_map = self.edge_map_pass.run(
            rec,
            &EdgeInputs {
                gbuffer: &layer.gbuffer,
                styles,
                edge_styles: self.edge_styles.buffer(),
                segments: &self.segments,
                has_holes: group.has_holes,
                is_cut: self.inputs.view.cut.is_some(),
                is_layer: true,
                shadow_mask: None,
            },
        )?;
        let mut seen_before = None;
        if !style.repeated {
            let before = match seen.take() {
                Some(seen) => seen,
                None => none_seen(rec)?,
            };
            let (now, own) = without_repeated(rec, &edge_map, &before)?;
            (*seen, edge_map, seen_before) = (Some(now), own, Some(before));
        }
        let reach = match &edge_map.spines {
            Some(spines) => Some(line_distance(rec, spines, styles, self.greatest_radius)?),
            None => None,
        };
        let drawn = Lines {
            gbuffer: &layer.gbuffer,
            edge_map: &edge_map,
            reach: reach.as_ref(),
            styles,
            edge_styles: self.edge_styles.buffer(),
        };
        let pen = Pen {
            file: "effects/blueprint.wgsl",
            entry_point: "fs_lines",
            inputs: &self.sprite(seen_before.as_ref().unwrap_or(&layer.order)),
            switches: &[("WITHOUT_REPEATED", seen_before.is_some()), ("AMONG_OTHERS", true)],
            onto: Onto::Beneath,
        };
        lines(rec, &drawn, &pen, color)
    }

    /// What the shader of the effect reads from binding 6 on.
    fn sprite<'b>(&'b self, seen: &'b Target) -> [Input<'b>; 4] {
        [
            Input::Texture(&self.surfaces.geometry),
            Input::Storage(self.style.buffer()),
            Input::Storage(self.count.buffer()),
            Input::Texture(seen),
        ]
    }

    /// Draws the surfaces of a layer beneath what is there, caps with the pen of its lines.
    fn fill(&self, rec: &mut Recorder<'_>, layer: &Layer, color: &Target) -> Result<(), RenderError> {
        let has_caps = !self.asked.caps.is_empty();
        if self.asked.blueprint.style.opacity <= 0.0 && !has_caps {
            return Ok(());
        }
        // Of the lines' bindings only the first is read: any texture of their kind.
        let mut inputs = vec![
            Input::Texture(&layer.gbuffer.geometry),
            Input::Texture(&layer.order),
            Input::Texture(&layer.gbuffer.base_color),
            Input::Texture(&layer.order),
            Input::Texture(&layer.order),
            Input::Storage(self.edge_styles.buffer()),
        ];
        inputs.extend(self.sprite(&layer.order));
        inputs.extend([Input::Texture(&layer.gbuffer.region), Input::Storage(self.caps.buffer())]);
        rec.draw(Draw {
            label: "fill",
            program: Program {
                file: "effects/blueprint.wgsl",
                entry_point: "fs_fill",
                switches: vec![("WITH_CAPS", has_caps)],
            },
            inputs: &inputs,
            outputs: &[color],
            onto: Onto::Beneath,
            depth: Some((&layer.gbuffer.depth, DepthRule::Covered)),
            lines: None,
        })?;
        Ok(())
    }
}
