//! Blueprints: the depth layers of a group, each with lines over a fill, composited in depth order (Nienhaus and Döllner 2004,
//! section 4).
//!
//! ```text
//! draws ─► layers ─► edge map of each ─► lines ─► beneath the layers before ─► picture of the group
//! ```
//!
//! The paper blends the layers back to front; front to back, each beneath those before it, gives the same picture with two
//! layers in memory instead of all, and ends wherever peeling does.

use encase::ShaderType;
use glam::Vec3;

use crate::document;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{ArrayBuffer, DepthRule, Gpu, Inputs, Program, Recorder, Target, UniformBuffer, inputs};
use crate::render::RenderError;
use crate::render::drawing::{Begun, DrawingInputs};
use crate::render::effects::section::{CapUniform, caps};
use crate::render::frame_uniform::FrameUniform;
use crate::render::groups::Group;
use crate::render::layers::{LayerInputs, LayerLines, LayerLinesInputs, Layers, LayersBy, Reported};
use crate::render::passes::depth_mask::DepthMask;
use crate::render::passes::edge_style::EdgeUniform;
use crate::render::passes::gbuffer::{GBuffer, GBufferPass};
use crate::render::passes::instances::{DrawCall, Instance};
use crate::render::passes::lines::{Pen, lines};
use crate::render::passes::peel::{Layer, MOST_LAYERS, PeelCount, Peeled};
use crate::render::passes::segments::Segments;
use crate::render::segments::segments;
use crate::render::stage::{Output, Stage};
use crate::style::{self, Edges, Style, Technique};

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
    far: Vec3,
    by_layer: f32,
    fill: Vec3,
    opacity: f32,
    by_distance: f32,
    threshold: f32,
}

impl From<&style::Blueprint> for BlueprintUniform {
    fn from(style: &style::Blueprint) -> Self {
        Self {
            far: style.far.to_linear(),
            by_layer: style.by_layer.clamp(0.0, 1.0),
            fill: style.fill.to_linear(),
            opacity: style.opacity.clamp(0.0, 1.0),
            by_distance: style.by_distance.clamp(0.0, 1.0),
            threshold: style.threshold.clamp(0.0, 1.0),
        }
    }
}

impl Blueprint {
    /// The group to which an object of this style belongs, in a scene with `count` object ids.
    pub fn group_of<'a>(all: &'a mut Vec<Self>, style: &Style, count: usize) -> &'a mut Group {
        let found = all.iter().position(|b| b.is_of(style));
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

    /// Whether an object of this style belongs to it.
    fn is_of(&self, style: &Style) -> bool {
        style.technique == Technique::Blueprint && self.style == style.blueprint && self.edges == style.edges
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
struct Key {
    shaders: u64,
    scene_revision: u64,
    surfaces: u64,
    mask: Option<u64>,
    blueprint: Blueprint,
    draws: Vec<Instance>,
    calls: Vec<DrawCall>,
    uniform: FrameUniform,
    part: Option<[u32; 4]>,
    crease_angle: f32,
    caps: Vec<CapUniform>,
    keeps_layers: bool,
    layers_by: document::LayersBy,
}

/// What of the drawing of a group lives across frames.
pub struct Blueprints {
    layers: Layers,
    lines: LayerLines,
    segments: Segments,
    style: UniformBuffer<BlueprintUniform>,
    caps: ArrayBuffer,
    stage: Stage<Key, Peels>,
}

impl Blueprints {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            layers: Layers::new(gpu),
            lines: LayerLines::new(gpu),
            segments: Segments::new(gpu),
            style: UniformBuffer::new(gpu, "blueprint"),
            caps: ArrayBuffer::new(gpu, "caps"),
            stage: Stage::default(),
        }
    }

    /// How often a picture was drawn.
    pub fn runs(&self) -> u64 {
        self.stage.runs()
    }

    /// What has been reported about its pictures; it draws an incomplete one again. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        let reported = self.layers.take_reports();
        if reported == Reported::Incomplete {
            self.stage.clear();
        }
        reported
    }

    /// Whether objects of this style were drawn last.
    pub fn is_of(&self, style: &Style) -> bool {
        self.stage.inputs().is_some_and(|last| last.blueprint.is_of(style))
    }

    /// How far the last picture came whose report has arrived.
    pub fn last(&self) -> Option<&(Peeled, LayersBy)> {
        self.layers.last()
    }

    /// How far peeling came in the last picture.
    pub fn count(&self) -> &PeelCount {
        self.layers.count()
    }

    /// The picture of a group, as far as opaque surfaces do not hide it, peeled until `mask` is uncovered.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &DrawingInputs<'_>,
        (begun, mask): (&Begun, Option<&Output<DepthMask>>),
        blueprint: &Blueprint,
    ) -> Result<Output<Peels>, RenderError> {
        let Begun { uniform, gbuffer: surfaces, .. } = begun;
        let (draws, calls) = blueprint.group.draws(inputs.scene, inputs.view);
        let asked = Key {
            shaders: rec.pipelines.generation(),
            scene_revision: inputs.scene_revision,
            surfaces: surfaces.revision,
            mask: mask.map(|mask| mask.revision),
            blueprint: blueprint.clone(),
            draws,
            calls,
            uniform: uniform.without_background(),
            part: inputs.view.part,
            crease_angle: inputs.crease_angle,
            caps: caps(inputs.scene, inputs.view, inputs.objects.scale),
            keeps_layers: inputs.keeps_layers,
            layers_by: inputs.layers_by,
        };
        let Self { layers, lines: layer_lines, segments: placed, style, caps, stage } = self;
        stage.run(asked, |asked| {
            let Blueprint { group, style: params, .. } = blueprint;
            style.write(rec.gpu, &BlueprintUniform::from(params));
            let has_caps = !asked.caps.is_empty();
            if has_caps {
                caps.write(rec.gpu, &asked.caps);
            }
            layer_lines.begin(rec.gpu, &group.edge_styles);
            let view = inputs.view.moved(glam::Vec2::ZERO);
            placed.write(rec, &segments(inputs.scene, group, &view, inputs.crease_angle), true)?;
            let edges = LayerLinesInputs {
                styles: &group.edge_styles,
                is_whole: false,
                segments: placed,
                has_holes: group.has_holes,
                is_cut: inputs.view.cut.is_some(),
                before: None,
                repeated: params.repeated,
            };
            let color = rec.target("blueprint", wgpu::TextureFormat::Rgba16Float)?;
            rec.clear("blueprint", &[&color]);
            let (mut seen, mut front, mut kept) = (None, None, Vec::new());
            let cut = LayerInputs {
                scene: inputs.scene,
                draws: &asked.draws,
                calls: &asked.calls,
                is_cut: inputs.view.has_cuts(),
                most: blueprint.layers(),
                least: blueprint.least(rec.size()),
                mask: mask.map(|mask| &mask.value),
                fraction: params.fraction,
                by: inputs.layers_by,
                with_color: asked.keeps_layers || group.edge_styles.iter().any(EdgeUniform::reads_color),
                with_normals: asked.keeps_layers || group.edge_styles.iter().any(EdgeUniform::reads_normals),
                with_depth: asked.keeps_layers,
                // The first one that is drawn is what a click means.
                whole: if asked.keeps_layers || group.edge_styles.iter().any(EdgeUniform::compares_geometry) {
                    MOST_LAYERS
                } else {
                    params.from
                },
            };
            let outer = rec.part.replace(group.part(inputs.scene, inputs.view));
            let drawn = layers.each(rec, gbuffer_pass, &cut, |rec, number, layer, count| {
                if asked.keeps_layers {
                    kept.push(layer.clone());
                }
                if !blueprint.shows(number) {
                    return Ok(());
                }
                front.get_or_insert_with(|| layer.gbuffer.geometry.clone());
                let sprite = Sprite {
                    surfaces: &surfaces.value,
                    has_surfaces: !inputs.objects.surfaces.is_empty(),
                    style: style.buffer(),
                    has_threshold: params.threshold > 0.0,
                    count,
                    mask: mask.map(|mask| &mask.value).filter(|_| !params.beyond),
                };
                if group.have_lines() {
                    let found = layer_lines.edges(rec, &edges, layer, &mut seen)?;
                    let pen = Pen {
                        file: "effects/blueprint.wgsl",
                        entry_point: "fs_lines",
                        inputs: &sprite.inputs().and(&inputs! { seen_tex: found.nearer.as_ref() }),
                        switches: &[
                            &[("WITHOUT_REPEATED", found.nearer.is_some()), ("AMONG_OTHERS", true)][..],
                            &sprite.switches(),
                        ]
                        .concat(),
                        onto: Onto::Beneath,
                    };
                    lines(rec, &found.lines(layer, layer_lines, edges.styles), &pen, &color)?;
                }
                if params.opacity > 0.0 || has_caps {
                    let caps = has_caps.then_some(caps.buffer());
                    fill(rec, layer, layer_lines.edge_styles(), sprite, caps, &color)?;
                }
                Ok(())
            });
            rec.part = outer;
            drawn?;
            Ok(Peels { color, front, layers: kept })
        })
    }
}

/// What layers are drawn with and tested against.
#[derive(Clone, Copy)]
struct Sprite<'a> {
    surfaces: &'a GBuffer,
    /// Whether there is anything in it.
    has_surfaces: bool,
    style: &'a wgpu::Buffer,
    /// Whether ink below a threshold is left out.
    has_threshold: bool,
    count: &'a PeelCount,
    /// Nothing is drawn beyond it.
    mask: Option<&'a DepthMask>,
}

impl<'a> Sprite<'a> {
    /// Whether it is tested against anything, whether what lies beyond the depth mask is left out, and so on.
    fn switches(&self) -> [(&'static str, bool); 3] {
        [
            ("WITH_SURFACES", self.has_surfaces),
            ("WITHOUT_BEYOND", self.mask.is_some()),
            ("WITH_THRESHOLD", self.has_threshold),
        ]
    }

    /// What the shader of the effect reads of it.
    fn inputs(&self) -> Inputs<'a> {
        inputs! {
            surface_tex: &self.surfaces.geometry,
            blueprint: self.style,
            peeled: self.count.buffer(),
            mask: self.mask.map(|mask| &mask.count),
        }
    }
}

/// Draws the surfaces of a layer beneath what is there, `caps` (those by object id) with the pen of its lines.
fn fill(
    rec: &mut Recorder<'_>,
    layer: &Layer,
    edge_styles: &wgpu::Buffer,
    sprite: Sprite<'_>,
    caps: Option<&wgpu::Buffer>,
    color: &Target,
) -> Result<(), RenderError> {
    let inputs = sprite.inputs().and(&inputs! {
        geometry_tex: &layer.gbuffer.geometry,
        region_tex: &layer.gbuffer.region,
        edge_styles: edge_styles,
        caps: caps,
    });
    rec.draw(Draw {
        label: "fill",
        program: Program {
            file: "effects/blueprint.wgsl",
            entry_point: "fs_fill",
            switches: [&[("WITH_CAPS", caps.is_some())][..], &sprite.switches()].concat(),
        },
        inputs: &inputs,
        outputs: &[color],
        onto: Onto::Beneath,
        depth: Some((&layer.gbuffer.depth, DepthRule::Covered)),
    })?;
    Ok(())
}
