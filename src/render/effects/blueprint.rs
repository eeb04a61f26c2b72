//! Blueprints: the depth layers of a group, each with lines over a fill, composited in depth order (Nienhaus and Döllner 2004,
//! section 4).
//!
//! The paper blends the layers back to front; front to back, each beneath those before it, gives the same picture with two
//! layers in memory instead of all, and ends wherever layers do.

use encase::ShaderType;
use glam::Vec3;

use super::layered::{LayerRequest, Layered, LayeredGroup, LineRequest, Visit, min_pixels};
use super::section::GpuCap;
use crate::gpu::{ArrayBuffer, Gpu, Inputs, Recorder, Target, UniformBuffer, inputs};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::edge_styles::{EdgeStyles, EdgeStylesBuffer};
use crate::render::base::error::RenderError;
use crate::render::base::group::Group;
use crate::render::base::scene_view::SceneView;
use crate::render::passes::composition::Composition;
use crate::render::passes::count::{LayerCount, MAX_LAYERS};
use crate::render::passes::designated::{DepthMask, Uncover};
use crate::render::passes::place::{LayerShader, Pending, Place};
use crate::render::passes::traversal::GBufferPass;
use crate::style::{self, Edges, Style, Technique};

/// Objects whose style is equal, split into layers together.
#[derive(Debug, Clone, PartialEq)]
pub struct BlueprintGroup {
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
            by_layer: style.by_layer,
            fill: style.fill.to_linear(),
            opacity: style.fill_opacity,
            by_distance: style.by_distance,
            threshold: style.threshold,
        }
    }
}

impl BlueprintGroup {
    /// The group to which an object of this style belongs, in a scene with `count` object ids.
    pub fn group_of<'a>(all: &'a mut Vec<Self>, style: &Style, count: usize) -> &'a mut Group {
        let found = all.iter().position(|b| b.is_of(style));
        let index = found.unwrap_or(all.len());
        if found.is_none() {
            all.push(Self {
                group: Group::unculled(count),
                style: style.blueprint.clone(),
                edges: style.edges.clone(),
            });
        }
        &mut all[index].group
    }

    /// Whether an object of this style belongs to it.
    pub fn is_of(&self, style: &Style) -> bool {
        style.technique == Technique::Blueprint && self.style == style.blueprint && self.edges == style.edges
    }

    /// Most layers that are drawn.
    fn last(&self) -> u32 {
        self.style.to.min(MAX_LAYERS)
    }

    /// Most layers where nothing is to be uncovered.
    fn layers(&self) -> u32 {
        self.style.max_layers.min(self.last())
    }

    fn shows(&self, layer: u32) -> bool {
        layer + 1 >= self.style.from
    }
}

/// What of the drawing of a blueprint is on the device.
pub struct BlueprintBuffers {
    style: UniformBuffer<BlueprintUniform>,
    caps: ArrayBuffer,
}

impl BlueprintBuffers {
    /// Nothing written yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { style: UniformBuffer::new(gpu, "blueprint"), caps: ArrayBuffer::new(gpu, "caps") }
    }
}

/// What a blueprint is drawn with.
#[derive(Clone, Copy)]
pub struct BlueprintInputs<'a> {
    /// Its style.
    pub blueprint: &'a BlueprintGroup,
    /// The caps of a section by object id; empty when there are none.
    pub caps: &'a Vec<GpuCap>,
    /// Layers are drawn until enough of this is uncovered.
    pub mask: Option<&'a DepthMask>,
}

/// Places the layers of a blueprint, as far as the composition does not hide them; returns the geometry of the first one that
/// is drawn.
///
/// # Errors
/// [`RenderError`].
pub fn place_blueprint(
    rec: &mut Recorder<'_>,
    gbuffer_pass: &mut GBufferPass,
    layered: &mut Layered,
    key: &LayeredGroup,
    scene_view: &SceneView<'_>,
    composition: &Composition,
    inputs: BlueprintInputs<'_>,
    buffers: &mut BlueprintBuffers,
    place: &mut Place<'_>,
) -> Result<Option<Target>, RenderError> {
    let BlueprintInputs { blueprint, caps, mask } = inputs;
    let BlueprintGroup { group, style: params, .. } = blueprint;
    let has_caps = !caps.is_empty();
    if has_caps {
        buffers.caps.write(rec.gpu, caps);
    }
    buffers.style.write(rec.gpu, &BlueprintUniform::from(params));
    let is_captured = LAYERS.into_iter().any(|name| rec.captures(name));
    let line_styles = [&group.edge_styles];
    let request = request_of(blueprint, mask, rec.size(), is_captured, &line_styles);
    for name in LAYERS {
        rec.note(name, None);
    }
    let mut front = None;
    let outer = rec.scissor_rect.replace(group.scissor_rect(scene_view.scene, scene_view.view));
    let buffers = &*buffers;
    let drawn = layered.walk(rec, gbuffer_pass, scene_view, key, &request, |rec, mut visit: Visit<'_>| {
        let drawn = visit.drawn;
        let gbuffer = &drawn.layer.gbuffer;
        if is_captured {
            let buffers = [&gbuffer.geometry, &gbuffer.surface_id, &gbuffer.base_color, &gbuffer.depth];
            for (name, target) in LAYERS.into_iter().zip(buffers) {
                rec.note_another(name, target);
            }
        }
        if !blueprint.shows(drawn.number) {
            return Ok(());
        }
        front.get_or_insert_with(|| gbuffer.geometry.clone());
        let sprite = Sprite {
            composition,
            style: &buffers.style,
            has_threshold: params.threshold > 0.0,
            count: drawn.count,
            mask: mask.filter(|_| !params.beyond),
        };
        let (own, switches) = (sprite.inputs(), sprite.switches());
        let mut pending = Pending::default();
        let lines = LineRequest { repeated: params.repeated, ..LineRequest::default() };
        if group.have_lines()
            && let Some(edges) = visit.edges(rec, lines)?
            && let Some(lines) = visit.lines(&edges, 0)
        {
            let repeated = [("WITHOUT_REPEATED", edges.nearer.is_some()), ("AMONG_OTHERS", true)];
            let switches = [&repeated[..], &switches].concat();
            let inputs = own.clone().and(&inputs! { nearer_lines_tex: edges.nearer.as_ref() });
            let shader = LayerShader { file: "effects/blueprint.wgsl", inputs: &inputs, switches: &switches };
            place.lines(rec, &mut pending, &lines, shader)?;
        }
        if params.fill_opacity > 0.0 || has_caps {
            let edge_styles = visit.edge_styles(0).map(EdgeStylesBuffer::inputs).unwrap_or_default();
            let inputs = own.and(&edge_styles).and(&inputs! {
                surface_id_tex: &gbuffer.surface_id,
                caps: has_caps.then_some(&buffers.caps),
            });
            let switches = [&[("WITH_CAPS", has_caps)][..], &switches].concat();
            let shader = LayerShader { file: "effects/blueprint.wgsl", inputs: &inputs, switches: &switches };
            place.fill(rec, &mut pending, drawn.layer, shader)?;
        }
        place.end(rec, &pending)
    });
    rec.scissor_rect = outer;
    drawn?;
    Ok(front)
}

/// What a blueprint asks of its layers. `mask`: what is to be uncovered; `size`: of the picture, px; `is_captured`: whether somebody
/// looks at the layers themselves.
fn request_of<'a>(
    blueprint: &BlueprintGroup,
    mask: Option<&'a DepthMask>,
    size: [u32; 2],
    is_captured: bool,
    line_styles: &'a [&'a EdgeStyles],
) -> LayerRequest<'a> {
    let params = &blueprint.style;
    let any = |has: fn(&GpuEdgeStyle) -> bool| blueprint.group.edge_styles.styles().iter().any(has);
    LayerRequest {
        max_layers: if mask.is_some() { blueprint.last() } else { blueprint.layers() },
        min_pixels: min_pixels(params.min_coverage, size),
        uncover: mask.map(|mask| Uncover {
            mask,
            fraction: params.fraction,
            max_without: blueprint.layers(),
        }),
        by: None,
        with_color: is_captured || any(GpuEdgeStyle::reads_color),
        with_normals: is_captured || any(GpuEdgeStyle::reads_normals),
        with_depth: is_captured,
        line_styles,
        nearer: None,
    }
}

/// Names under which the layers of blueprints can be looked at, each several targets, the nearest first.
pub const LAYERS: [&str; 4] = ["layer geometry", "layer surface ids", "layer base color", "layer depth"];

/// What layers are drawn with and tested against.
#[derive(Clone, Copy)]
struct Sprite<'a> {
    composition: &'a Composition,
    style: &'a UniformBuffer<BlueprintUniform>,
    /// Whether ink below a threshold is left out.
    has_threshold: bool,
    count: &'a LayerCount,
    /// Nothing is drawn beyond it.
    mask: Option<&'a DepthMask>,
}

impl<'a> Sprite<'a> {
    /// What it is tested against, whether what lies beyond the depth mask is left out, and so on.
    fn switches(&self) -> Vec<(&'static str, bool)> {
        let own = [("WITHOUT_BEYOND", self.mask.is_some()), ("WITH_THRESHOLD", self.has_threshold)];
        [&own[..], &self.composition.switches()].concat()
    }

    /// What the shader of the effect reads of it.
    fn inputs(&self) -> Inputs<'a> {
        self.composition.tested().and(&inputs! {
            blueprint: self.style,
            layer_count: self.count.buffer(),
            mask: self.mask.map(|mask| &mask.count),
        })
    }
}
