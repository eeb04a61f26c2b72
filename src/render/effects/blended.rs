//! Materials that blend, in the surface techniques: their parts are cut into depth layers, and each is shaded and drawn with
//! its lines beneath those before it, so that the order of objects does not matter.
//!
//! ```text
//! draws ─► layers ─► shaded as surfaces are, by their opacity ─► beneath the layers before ─► picture of all
//!                └─► edge map of each ─► lines ─────────────────────────┘
//! ```
//!
//! What is opaque hides what lies behind it, its lines too, which are wider than it: see `effects/blended.wgsl`.

use crate::document::LayersBy;
use crate::gpu::bindings::NOTHING;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{DepthRule, Gpu, Inputs, Program, Recorder, Target, inputs};
use crate::render::RenderError;
use crate::render::drawing::DrawingInputs;
use crate::render::effects::surface::{Shading, surface};
use crate::render::effects::toon::cartoon_map;
use crate::render::groups::Group;
use crate::render::layers::{LayerInputs, LayerLines, LayerLinesInputs, Layers, Reported};
use crate::render::passes::gbuffer::{GBuffer, GBufferPass};
use crate::render::passes::instances::{DrawCall, Instance, Instances};
use crate::render::passes::lines::{Lines, Pen, lines};
use crate::render::passes::peel::Layer;
use crate::render::passes::segments::Segments;
use crate::render::segments::segments;
use crate::render::shadows::ShadowMask;

/// Most layers that are composited: beneath so many nothing can be told apart.
const MOST_LAYERS: u32 = 16;

/// The opaque lines at each pixel: see `cover_tex` in `effects/blended.wgsl`.
const COVER: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// What the picture depends on beyond what that of the surfaces does.
#[derive(Debug, Clone, PartialEq)]
pub struct Blend {
    scene_revision: u64,
    group: Group,
    draws: Vec<Instance>,
    calls: Vec<DrawCall>,
    crease_angle: f32,
    layers_by: LayersBy,
}

impl Blend {
    /// What blends; `None` if nothing does.
    pub fn new(inputs: &DrawingInputs<'_>) -> Option<Self> {
        let group = &inputs.objects.blended;
        if group.visible().is_empty() {
            return None;
        }
        let (draws, calls) = group.draws(inputs.scene, inputs.view);
        Some(Self {
            scene_revision: inputs.scene_revision,
            group: group.clone(),
            draws,
            calls,
            crease_angle: inputs.crease_angle,
            layers_by: inputs.layers_by,
        })
    }
}

/// What is opaque.
#[derive(Clone, Copy)]
pub struct Opaque<'a> {
    /// Its surfaces.
    pub gbuffer: &'a GBuffer,
    /// Its lines, where it has any.
    pub lines: Option<&'a Lines<'a>>,
}

/// What blends, drawn.
#[derive(Debug, Clone)]
pub struct Panes {
    /// Linear colour times opacity, and opacity.
    pub color: Target,
    /// Geometry of the nearest layer.
    pub front: Option<Target>,
}

/// What of the drawing of what blends lives across frames.
pub struct Blended {
    layers: Layers,
    lines: LayerLines,
    segments: Segments,
    draws: Instances,
}

impl Blended {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            layers: Layers::new(gpu),
            lines: LayerLines::new(gpu),
            segments: Segments::new(gpu),
            draws: Instances::new(gpu),
        }
    }

    /// What has been reported about its pictures. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        self.layers.take_reports()
    }

    /// The picture of what blends. `shading`: that of the surfaces; of what is found per pixel, each layer gets its own.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &DrawingInputs<'_>,
        blend: &Blend,
        opaque: Opaque<'_>,
        (shading, shadow_mask): (&Shading<'_>, &mut ShadowMask),
    ) -> Result<Panes, RenderError> {
        let Blend { group, draws, calls, .. } = blend;
        let Self { layers, lines: layer_lines, segments: placed, draws: draw_buffer } = self;
        layer_lines.begin(rec.gpu, &group.edge_styles);
        let view = inputs.view.moved(glam::Vec2::ZERO);
        placed.write(rec, &segments(inputs.scene, group, &view, inputs.crease_angle), true)?;
        let cover = match opaque.lines {
            Some(opaque_lines) => Some(cover(rec, opaque_lines)?),
            None => None,
        };
        let with_coordinates: Vec<_> = calls
            .iter()
            .filter(|call| {
                let draw = draws.get(call.draw as usize);
                draw.is_some_and(|draw| inputs.objects.halftones.need_coordinates(draw.object))
            })
            .copied()
            .collect();
        if !with_coordinates.is_empty() {
            draw_buffer.write(rec.gpu, draws, &[])?;
        }
        // Layers are drawn by the same pass.
        let mut coordinates_pass = std::mem::take(&mut gbuffer_pass.coordinates);
        let color = rec.target("blended", wgpu::TextureFormat::Rgba16Float)?;
        rec.clear("blended", &[&color]);
        let (mut seen, mut front) = (None, None);
        let cut = LayerInputs {
            scene: inputs.scene,
            draws,
            calls,
            is_cut: inputs.view.has_cuts(),
            most: MOST_LAYERS,
            least: 1,
            mask: None,
            fraction: 1.0,
            by: inputs.layers_by,
            with_color: true,
            with_normals: true,
            with_depth: true,
            whole: MOST_LAYERS,
        };
        let drawn = layers.each(rec, gbuffer_pass, &cut, |rec, _, layer, _| {
            front.get_or_insert_with(|| layer.gbuffer.geometry.clone());
            let mask = shadow_mask.of_layer(rec, &layer.gbuffer, inputs)?;
            let bands = if inputs.objects.have_cartoon_map() {
                let styles = shading.toon_buffers.styles;
                Some(cartoon_map(rec, &layer.gbuffer, styles, mask.as_ref())?)
            } else {
                None
            };
            let coordinates = if with_coordinates.is_empty() {
                None
            } else {
                Some(coordinates_pass.run(
                    rec,
                    inputs.scene,
                    &layer.gbuffer,
                    draw_buffer,
                    &with_coordinates,
                )?)
            };
            let mut own =
                Shading { shadow_mask: mask.as_ref(), cartoon_map: bands.as_ref(), blends: true, ..*shading };
            own.halftones.coordinates = coordinates.as_ref();
            let shaded = surface(rec, &layer.gbuffer, &own)?;
            let pane = Pane { opaque: opaque.gbuffer, cover: cover.as_ref(), shaded: &shaded };
            if group.have_lines() {
                let edges = LayerLinesInputs {
                    styles: &group.edge_styles,
                    is_whole: false,
                    segments: placed,
                    has_holes: group.has_holes,
                    is_cut: inputs.view.cut.is_some(),
                    before: None,
                    repeated: false,
                };
                let found = layer_lines.edges(rec, &edges, layer, &mut seen)?;
                let pen = Pen {
                    file: "effects/blended.wgsl",
                    entry_point: "fs_lines",
                    inputs: &pane.inputs().and(&inputs! { seen_tex: found.nearer.as_ref() }),
                    switches: &[("AMONG_OTHERS", true), pane.with_cover()],
                    onto: Onto::Beneath,
                };
                lines(rec, &found.lines(layer, layer_lines, edges.styles), &pen, &color)?;
            }
            lay_beneath(rec, layer, pane, &color)
        });
        gbuffer_pass.coordinates = coordinates_pass;
        drawn?;
        Ok(Panes { color, front })
    }
}

/// A layer, and what it is tested against.
#[derive(Clone, Copy)]
struct Pane<'a> {
    opaque: &'a GBuffer,
    cover: Option<&'a Target>,
    shaded: &'a Target,
}

impl<'a> Pane<'a> {
    fn with_cover(&self) -> (&'static str, bool) {
        ("WITH_COVER", self.cover.is_some())
    }

    /// What the shader of the effect reads of it.
    fn inputs(&self) -> Inputs<'a> {
        inputs! { surface_tex: &self.opaque.geometry, cover_tex: self.cover, shaded_tex: self.shaded }
    }
}

/// Where the lines of what is opaque hide what lies behind them.
fn cover(rec: &mut Recorder<'_>, opaque: &Lines<'_>) -> Result<Target, RenderError> {
    let cover = rec.target("cover", COVER)?;
    let pen = Pen {
        file: "effects/blended.wgsl",
        entry_point: "fs_cover",
        inputs: &NOTHING,
        switches: &[],
        onto: Onto::Nothing,
    };
    lines(rec, opaque, &pen, &cover)?;
    Ok(cover)
}

/// Draws the shaded surfaces of a layer beneath what is there.
fn lay_beneath(
    rec: &mut Recorder<'_>,
    layer: &Layer,
    pane: Pane<'_>,
    color: &Target,
) -> Result<(), RenderError> {
    let inputs = pane.inputs().and(&inputs! { geometry_tex: &layer.gbuffer.geometry });
    rec.draw(Draw {
        label: "blended",
        program: Program {
            file: "effects/blended.wgsl",
            entry_point: "fs_surface",
            switches: vec![pane.with_cover()],
        },
        inputs: &inputs,
        outputs: &[color],
        onto: Onto::Beneath,
        depth: Some((&layer.gbuffer.depth, DepthRule::Covered)),
    })?;
    Ok(())
}
