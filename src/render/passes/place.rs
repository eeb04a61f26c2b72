//! Where the layers of a group go: beneath the nearer ones of the same group, or, where other groups overlap it, to the lists
//! in which the layers of all are put in order.

use super::composition::PLACED;
use super::count::Layer;
use super::layer_lists::LayerLists;
use super::lines::{LineShader, Lines, lines};
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{DepthRule, Inputs, Program, Recorder, Target};
use crate::render::base::error::RenderError;

/// Where layers go.
pub enum Place<'a> {
    /// Beneath what a picture of the group holds already.
    Beneath(&'a Target),
    /// To lists.
    Listed(&'a mut LayerLists),
}

/// A shader that draws layers: it has the entry points `fs_lines` and `fs_fill`, which give a color (linear, times its opacity),
/// and `fs_lines_placed` and `fs_fill_placed`, which give it with a depth (see `shaders/common/placed.wgsl`).
#[derive(Clone, Copy)]
pub struct LayerShader<'a> {
    /// File below `shaders/`.
    pub file: &'static str,
    /// What it reads beyond the layer.
    pub inputs: &'a Inputs<'a>,
    /// Its switches.
    pub switches: &'a [(&'static str, bool)],
}

/// What was drawn of a layer for the lists.
#[derive(Default)]
pub struct Pending {
    ink: Option<Target>,
    fill: Option<Target>,
}

impl Place<'_> {
    /// Places the lines of a layer; before its fill, which they lie over.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn lines(
        &self,
        rec: &mut Recorder<'_>,
        pending: &mut Pending,
        drawn: &Lines<'_>,
        shader: LayerShader<'_>,
    ) -> Result<(), RenderError> {
        let LayerShader { file, inputs, switches } = shader;
        match self {
            Self::Beneath(color) => {
                let shader =
                    LineShader { file, entry_point: "fs_lines", inputs, switches, onto: Onto::Under };
                lines(rec, drawn, &shader, color)
            }
            Self::Listed(_) => {
                let ink = rec.target("ink of layer", PLACED)?;
                let shader =
                    LineShader { file, entry_point: "fs_lines_placed", inputs, switches, onto: Onto::Clear };
                lines(rec, drawn, &shader, &ink)?;
                pending.ink = Some(ink);
                Ok(())
            }
        }
    }

    /// Places the surfaces of a layer.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn fill(
        &self,
        rec: &mut Recorder<'_>,
        pending: &mut Pending,
        layer: &Layer,
        shader: LayerShader<'_>,
    ) -> Result<(), RenderError> {
        let LayerShader { file, inputs, switches } = shader;
        let mut inputs = inputs.clone();
        inputs.set("geometry_tex", &layer.gbuffer.geometry);
        let (entry_point, target, onto) = match self {
            Self::Beneath(color) => ("fs_fill", (*color).clone(), Onto::Under),
            Self::Listed(_) => ("fs_fill_placed", rec.target("fill of layer", PLACED)?, Onto::Clear),
        };
        rec.draw(Draw {
            label: "fill",
            program: Program { file, entry_point, switches: switches.to_vec() },
            inputs: &inputs,
            outputs: &[&target],
            onto,
            depth: Some((&layer.gbuffer.depth, DepthRule::Covered)),
        })?;
        pending.fill = Some(target);
        Ok(())
    }

    /// Ends a layer.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn end(&mut self, rec: &mut Recorder<'_>, pending: &Pending) -> Result<(), RenderError> {
        match self {
            Self::Beneath(_) => Ok(()),
            Self::Listed(lists) => lists.append(rec, pending.ink.as_ref(), pending.fill.as_ref()),
        }
    }
}
