//! Leaves out lines that a nearer layer has at the same place (blueprints paper, section 4.1, Fig. 5).

use super::edge_map::{EdgeMap, SPINES};
use crate::gpu::recorder::{Draw, Input, Onto};
use crate::gpu::{DepthRule, Program, Recorder, Target};
use crate::render::RenderError;

/// No line seen yet.
///
/// # Errors
/// [`RenderError`].
pub fn none_seen(rec: &mut Recorder<'_>) -> Result<Target, RenderError> {
    let seen = rec.target("seen lines", SPINES)?;
    rec.clear("no line seen", &seen);
    Ok(seen)
}

/// The lines of an edge map.
///
/// # Errors
/// [`RenderError`].
pub fn seen_lines(rec: &mut Recorder<'_>, edge_map: &EdgeMap) -> Result<Target, RenderError> {
    match &edge_map.spines {
        Some(spines) if !edge_map.has_paper => Ok(spines.clone()),
        _ => {
            let none = none_seen(rec)?;
            Ok(without_repeated(rec, edge_map, &none)?.0)
        }
    }
}

/// What the lines of a layer leave: those of all layers so far, and its edge map without those in `seen`. The papers'
/// operators have no spines: whoever draws their ink looks at `seen` itself.
///
/// # Errors
/// [`RenderError`].
pub fn without_repeated(
    rec: &mut Recorder<'_>,
    edge_map: &EdgeMap,
    seen: &Target,
) -> Result<(Target, EdgeMap), RenderError> {
    let program = |entry_point| Program {
        file: "passes/repeated.wgsl",
        entry_point,
        switches: vec![("WITH_PAPER", edge_map.has_paper), ("WITH_EXACT", edge_map.spines.is_some())],
    };
    let inputs = [
        Input::Texture(&edge_map.edges),
        // Without spines any texture of their kind.
        Input::Texture(edge_map.spines.as_ref().unwrap_or(seen)),
        Input::Texture(seen),
    ];
    let (now_seen, own) = (rec.target("seen lines", SPINES)?, rec.target("own spines", SPINES)?);
    let marks = rec.target("lines of layer", wgpu::TextureFormat::Depth32Float)?;
    rec.copy(seen, &now_seen);
    rec.draw(Draw {
        label: "seen lines",
        program: program("fs_seen"),
        inputs: &inputs,
        outputs: &[&now_seen],
        onto: Onto::Old,
        depth: Some((&marks, DepthRule::Mark)),
    })?;
    rec.draw(Draw {
        label: "repeated lines",
        program: program("fs_own"),
        inputs: &inputs,
        outputs: &[&own],
        onto: Onto::Nothing,
        depth: Some((&marks, DepthRule::Marked)),
    })?;
    let spines = edge_map.spines.is_some().then_some(own);
    Ok((now_seen, EdgeMap { spines, ..edge_map.clone() }))
}
