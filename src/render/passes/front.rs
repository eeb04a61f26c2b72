//! What is in front of all, where it lies: opaque surfaces, sketches, and the first layers of blueprints. It is what a click means
//! and what an outline is drawn around.

use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;

/// Geometries (see `shaders/common/gbuffer.wgsl`) of which the nearest counts at each pixel.
#[derive(Debug, Clone)]
pub struct Front {
    /// Of opaque surfaces.
    pub surfaces: Target,
    /// Of other opaque ones, sketches, and of what may lie before all of them.
    pub layers: Vec<Target>,
}

impl Front {
    /// The nearest at each pixel.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn nearest(&self, rec: &mut Recorder<'_>) -> Result<Target, RenderError> {
        let mut nearest = self.surfaces.clone();
        for layer in &self.layers {
            let both = rec.target("front", nearest.format())?;
            let inputs = inputs! { geometry_tex: &nearest, other_tex: layer };
            rec.fullscreen("front", Program::new("passes/front.wgsl", "fs_main"), &inputs, &[&both], None)?;
            nearest = both;
        }
        Ok(nearest)
    }

    /// Each of them.
    pub fn all(&self) -> impl Iterator<Item = &Target> {
        std::iter::once(&self.surfaces).chain(&self.layers)
    }
}
