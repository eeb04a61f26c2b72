//! Which lines nearer layers have (blueprints paper, section 4.1, Fig. 5): those at the same place can be left out.

use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;

/// What the distance transform reads of lines, see `spine_of` in `shaders/common/edge_map.wgsl`.
pub(super) const SPINES: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// The lines of layers; see `shaders/common/repeated.wgsl`.
#[derive(Debug, Clone)]
pub struct NearerLines {
    /// Of all nearer ones.
    pub before: Target,
    /// Of this one too, once its edge map has been made.
    pub now: Target,
}

impl NearerLines {
    /// For the layer behind those whose lines `before` holds; `None`: there are none.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn behind(rec: &mut Recorder<'_>, before: Option<Target>) -> Result<Self, RenderError> {
        let before = match before {
            Some(before) => before,
            None => none(rec)?,
        };
        let now = rec.target("nearer lines", SPINES)?;
        rec.copy(&before, &now);
        Ok(Self { before, now })
    }
}

fn none(rec: &mut Recorder<'_>) -> Result<Target, RenderError> {
    let lines = rec.target("nearer lines", SPINES)?;
    rec.clear("no nearer lines", &[&lines]);
    Ok(lines)
}

/// Adds the ink of the papers' operators, where an edge map has no `spines`, to the nearer lines.
///
/// # Errors
/// [`RenderError`].
pub(super) fn add_ink(
    rec: &mut Recorder<'_>,
    edges: &Target,
    spines: &Target,
    lines: &Target,
) -> Result<(), RenderError> {
    rec.draw(Draw {
        label: "ink of nearer lines",
        program: Program::new("passes/repeated.wgsl", "fs_ink"),
        inputs: &inputs! { edge_map_tex: edges, spine_tex: spines },
        outputs: &[lines],
        onto: Onto::Load,
        depth: None,
    })?;
    Ok(())
}
