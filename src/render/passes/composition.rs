//! The composition of a drawing: what is where so far, by which it is decided what hides what. Each way of placing tests its own
//! pixels against it: `passes/lines.rs`, `passes/place.rs`, `effects/sketch/placing.rs`.
//!
//! ```text
//! nearest:  surfaces with their lines ─► geometry (object, depth, plane), ink (color, depth of its edge)
//!           sketches: moved, each by its depth ─► the same
//! beneath:  what is seen through      ─► tested against both, each layer by its own depth, among all groups
//! front:    the nearest of all        ─► what a click means and what an outline is drawn around
//! ```

use super::front::Front;
use super::lines::{LineShader, Lines, lines};
use super::overlay::overlay;
use crate::gpu::inputs::NOTHING;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{Inputs, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::stage::Output;

/// Ink of lines and its depth; see `shaders/common/placed.wgsl`.
pub const PLACED: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// What has been placed so far.
pub struct Composition {
    /// Geometry of the opaque surface that is drawn at each pixel; see `shaders/common/gbuffer.wgsl`.
    pub surfaces: Output<Target>,
    /// The same without sketches; if nothing else is opaque, of the first of them, where its surfaces lie.
    in_place: Output<Target>,
    /// The same of each other sketch, where its surfaces lie.
    sketches: Vec<Output<Target>>,
    /// Whether there is any.
    pub has_surfaces: bool,
    /// Their ink, which reaches beyond them; `None` where nobody asks for it, or nothing has lines.
    pub ink: Option<Output<Target>>,
    /// Pictures of what is seen through, and the geometry of the nearest layer of each.
    translucent: Vec<Output<Translucent>>,
}

/// What is seen through, drawn.
#[derive(Debug, Clone)]
pub struct Translucent {
    /// Linear color times opacity, and opacity.
    pub color: Target,
    /// Geometry of the nearest layer that is drawn, of each group; empty when none is.
    pub fronts: Vec<Target>,
}

impl Composition {
    /// Begins with what is opaque.
    pub fn of_surfaces(surfaces: Output<Target>, has_surfaces: bool) -> Self {
        let in_place = surfaces.clone();
        Self { surfaces, in_place, sketches: Vec::new(), has_surfaces, ink: None, translucent: Vec::new() }
    }

    /// Places the ink of what is opaque.
    pub fn place_ink(&mut self, ink: Option<Output<Target>>) {
        self.ink = ink;
    }

    /// Places groups that are seen through: those of one picture are in order among themselves, and overlap no others.
    pub fn place_translucent(&mut self, picture: Output<Translucent>) {
        self.translucent.push(picture);
    }

    /// Changes when what is opaque does, or its ink.
    pub fn revisions(&self) -> [Option<u64>; 2] {
        [Some(self.surfaces.revision), self.ink.as_ref().map(|ink| ink.revision)]
    }

    /// Changes when what is seen through does.
    pub fn translucent_revisions(&self) -> Vec<u64> {
        self.translucent.iter().map(|picture| picture.revision).collect()
    }

    /// Whether nothing is left to be laid over the color of what is opaque.
    pub fn is_laid(&self) -> bool {
        self.ink.is_none() && self.translucent.is_empty()
    }

    /// The picture of what is seen through, if it is all there is.
    pub fn only_translucent(&self) -> Option<&Target> {
        match self.translucent.as_slice() {
            [only] if !self.has_surfaces => Some(&only.value.color),
            _ => None,
        }
    }

    /// Takes over what is opaque with a sketch among it, whose `own` geometry this is; `surfaces`: `None` if nothing is placed after
    /// it.
    pub fn place_sketch(
        &mut self,
        own: Output<Target>,
        surfaces: Option<Output<Target>>,
        ink: Option<Output<Target>>,
    ) {
        if self.has_surfaces {
            self.sketches.push(own);
        } else {
            self.in_place = own;
        }
        if let Some(surfaces) = surfaces {
            self.surfaces = surfaces;
        }
        self.has_surfaces = true;
        self.ink = ink;
    }

    /// Lays the ink of what is opaque over its color.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn lay_ink(&self, rec: &mut Recorder<'_>, color: &Target) -> Result<(), RenderError> {
        let Some(ink) = &self.ink else { return Ok(()) };
        rec.draw(Draw {
            label: "ink",
            program: Program::new("passes/overlay.wgsl", "fs_ink"),
            inputs: &inputs! { ink_tex: &ink.value },
            outputs: &[color],
            onto: Onto::Over,
            depth: None,
        })?;
        Ok(())
    }

    /// Lays what is seen through over what is opaque.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn lay_translucent(&self, rec: &mut Recorder<'_>, color: &Target) -> Result<(), RenderError> {
        self.translucent.iter().try_for_each(|picture| overlay(rec, &picture.value.color, color))
    }

    /// What is in front, where it lies: a click on color that a sketch puts beside its surface means what lies there. And what
    /// changes when it does.
    pub fn front(&self) -> (Front, Vec<u64>) {
        let sketches = self.sketches.iter().map(|sketch| sketch.value.clone());
        let translucent = self.translucent.iter().flat_map(|picture| picture.value.fronts.clone());
        let surfaces = self.in_place.value.clone();
        let opaque = [&self.in_place].into_iter().chain(&self.sketches).map(|drawn| drawn.revision);
        let revisions = opaque.chain(self.translucent_revisions()).collect();
        (Front { surfaces, layers: sketches.chain(translucent).collect() }, revisions)
    }

    /// What the shaders of what is seen through test it against: `shaders/common/composition.wgsl`.
    pub fn tested(&self) -> Inputs<'_> {
        inputs! { surface_tex: &self.surfaces.value, opaque_ink_tex: self.ink.as_ref().map(|ink| &ink.value) }
    }

    /// The switches of that.
    pub fn switches(&self) -> [(&'static str, bool); 2] {
        [("WITH_SURFACES", self.has_surfaces), ("WITH_OPAQUE_INK", self.ink.is_some())]
    }
}

/// The ink of lines, each pixel with the depth of the edge that it is of.
///
/// # Errors
/// [`RenderError`].
pub fn ink(rec: &mut Recorder<'_>, opaque: &Lines<'_>) -> Result<Target, RenderError> {
    let ink = rec.target("ink", PLACED)?;
    let shader = LineShader {
        file: "passes/lines.wgsl",
        entry_point: "fs_placed",
        inputs: &NOTHING,
        switches: &[("ON_SURFACES", true)],
        onto: Onto::Clear,
    };
    lines(rec, opaque, &shader, &ink)?;
    Ok(ink)
}
