//! Placing a sketch: color and ink of each pixel from beside itself, by the depth of where they come from.

use super::group::SketchGroup;
use super::ink::MovedLines;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{DepthRule, Inputs, Program, Recorder, STENCIL, Target, UniformBuffer, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::stage::Output;
use crate::render::effects::opaque::{OpaqueLayer, OpaqueSurfaces};
use crate::render::passes::composition::{Composition, PLACED};
use crate::render::passes::edge_map::EdgeMap;
use crate::style::sketch::{SketchDepth, Tone};

/// What has been placed: all that is opaque so far.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    /// `None` where nothing is placed among it any more: large textures take their time.
    pub(super) geometry: Option<Target>,
    pub(super) color: Target,
    pub(super) ink: Option<Target>,
}

/// What is fetched from, drawn.
pub(super) struct Fetched<'a> {
    pub(super) surfaces: &'a OpaqueSurfaces,
    pub(super) color: Output<Target>,
    pub(super) edges: Option<Output<EdgeMap>>,
    pub(super) near_lines: Option<Output<Target>>,
    pub(super) hidden: Option<Output<Target>>,
    /// By pass; empty: there are no exact lines.
    pub(super) moved: Vec<MovedLines>,
    pub(super) fill_field: Output<Target>,
}

/// A sketch while it is being placed.
pub(super) struct Placing<'a> {
    pub(super) sketch: &'a SketchGroup,
    pub(super) layer: &'a OpaqueLayer,
    pub(super) fetched: &'a Fetched<'a>,
    pub(super) composition: &'a Composition,
    pub(super) before: &'a Target,
    /// Of the sketch itself.
    pub(super) own: Inputs<'a>,
    /// Numbers of its passes.
    pub(super) numbers: Vec<&'a UniformBuffer<u32>>,
}

/// Where ink goes.
#[derive(Clone, Copy)]
enum InkTarget<'a> {
    /// Over color.
    Color(&'a Target),
    /// Into a picture of its own.
    Ink(&'a Target),
}

impl Placing<'_> {
    /// Places color, then ink: over the color if it `lays_ink`.
    pub(super) fn place(&self, rec: &mut Recorder<'_>, lays_ink: bool) -> Result<Placed, RenderError> {
        let Self { composition, before, .. } = *self;
        let format = composition.surfaces.value.format();
        let geometry = if lays_ink { None } else { Some(rec.target("geometry with sketch", format)?) };
        let color = rec.target("color with sketch", before.format())?;
        self.place_color(rec, geometry.as_ref(), &color)?;
        let ink = if self.fetched.edges.is_none() && composition.ink.is_none() {
            None
        } else if lays_ink {
            for number in 0..self.numbers.len() {
                self.draw_ink(rec, number, None, None, InkTarget::Color(&color))?;
            }
            None
        } else {
            let mut before = composition.ink.as_ref().map(|ink| ink.value.clone());
            for number in 0..self.numbers.len() {
                let ink = rec.target("ink with sketch", PLACED)?;
                self.draw_ink(rec, number, geometry.as_ref(), before.as_ref(), InkTarget::Ink(&ink))?;
                before = Some(ink);
            }
            before
        };
        Ok(Placed { geometry, color, ink })
    }

    /// What color and ink read.
    fn inputs(&self) -> Inputs<'_> {
        let Self { fetched, composition, .. } = self;
        self.own.clone().and(&composition.tested()).and(&inputs! {
            geometry_tex: &fetched.surfaces.gbuffer.value.geometry,
            fill_field_tex: &fetched.fill_field.value,
        })
    }

    fn switches(&self) -> Vec<(&'static str, bool)> {
        let Self { sketch, fetched, composition, .. } = self;
        let style = &sketch.style;
        let mut switches = vec![
            ("ON_SCREEN", sketch.is_on_screen()),
            ("ENLARGED", sketch.is_enlarged()),
            ("WITH_NEARER", style.wander.depth == SketchDepth::Nearer),
            ("WITH_GRAIN", style.grain.amount > 0.0),
            ("WITH_ROUGHNESS", style.grain.roughness > 0.0),
            ("WITH_STROKES", style.fill.strokes > 0.0),
            ("WITH_PRESSURE", style.wander.pressure > 0.0),
            ("WITH_DARKNESS", style.fill.tone == Tone::Darkness),
            ("WITH_SMUDGE", fetched.near_lines.is_some()),
            ("WITH_OPACITY", sketch.blends),
            ("WITH_HIDDEN", fetched.hidden.is_some()),
        ];
        switches.extend(composition.switches());
        switches
    }

    fn place_color(
        &self,
        rec: &mut Recorder<'_>,
        geometry: Option<&Target>,
        color: &Target,
    ) -> Result<(), RenderError> {
        let Self { fetched, composition, before, .. } = self;
        let inputs = self.inputs().and(&inputs! {
            shaded_tex: &fetched.color.value,
            surface_id_tex: &fetched.surfaces.gbuffer.value.surface_id,
            hidden_tex: fetched.hidden.as_ref().map(|hidden| &hidden.value),
            near_line_tex: fetched.near_lines.as_ref().map(|near| &near.value),
            before_tex: *before,
        });
        let onto = if composition.has_surfaces {
            if let Some(geometry) = geometry {
                rec.copy(&composition.surfaces.value, geometry);
            }
            rec.copy(before, color);
            Onto::Load
        } else {
            Onto::Clear
        };
        let filled = rec.target("covered by color", STENCIL)?;
        rec.draw(Draw {
            label: "sketched color",
            program: Program {
                file: "effects/sketch.wgsl",
                entry_point: "fs_fill",
                switches: self.switches(),
            },
            inputs: &inputs,
            outputs: &[color].into_iter().chain(geometry).collect::<Vec<_>>(),
            onto,
            depth: Some((&filled, DepthRule::Where("fs_filled"))),
        })?;
        Ok(())
    }

    /// Draws the ink of a pass, with that `before` it.
    fn draw_ink(
        &self,
        rec: &mut Recorder<'_>,
        number: usize,
        geometry: Option<&Target>,
        before: Option<&Target>,
        onto: InkTarget<'_>,
    ) -> Result<(), RenderError> {
        let Self { sketch, layer, fetched, .. } = self;
        let moved = fetched.moved.get(number);
        let edges = moved.map(|moved| moved.edges.edge_map());
        let edges = edges.as_ref().or(fetched.edges.as_ref().map(|edges| &edges.value));
        let mut inputs = self.inputs();
        let mut switches = self.switches();
        if let Some(edges) = edges {
            let line_distance = moved.map(|moved| &moved.line_distance.value);
            let lines = layer.lines(&sketch.group, fetched.surfaces, edges, line_distance);
            inputs.extend(&lines.inputs());
            switches.extend(lines.switches());
        } else {
            // What is new hides ink that is there.
            switches.extend([("WITH_OPERATORS", false), ("WITH_EXACT", false)]);
        }
        inputs.extend(&inputs! {
            pass_number: self.numbers[number],
            operator_map_tex: fetched.edges.as_ref().map(|edges| &edges.value.edges),
            source_tex: moved.map(|moved| &moved.edges.sources),
            filled_tex: geometry,
            opaque_ink_tex: before,
        });
        switches.retain(|(name, _)| *name != "WITH_OPAQUE_INK");
        switches.extend([
            ("MOVED", true),
            ("WITH_OPAQUE_INK", before.is_some()),
            ("BEFORE_IS_OTHER", number == 0),
        ]);
        let (output, entry_point, onto) = match onto {
            InkTarget::Color(color) => (color, "fs_lay_ink", Onto::Over),
            InkTarget::Ink(ink) => (ink, "fs_ink", Onto::Clear),
        };
        let inked = rec.target("covered by ink", STENCIL)?;
        rec.draw(Draw {
            label: "sketched ink",
            program: Program { file: "effects/sketch.wgsl", entry_point, switches },
            inputs: &inputs,
            outputs: &[output],
            onto,
            depth: Some((&inked, DepthRule::Where("fs_inked"))),
        })?;
        Ok(())
    }
}
