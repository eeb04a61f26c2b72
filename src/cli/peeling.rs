//! What is said of the blueprints of a picture: how far they were peeled, and what of the designated objects that uncovered.

use serde_json::{Value, json};

use crate::render::passes::peel::Peeled;

/// Exactly how far each blueprint was peeled.
pub(super) fn as_json(peeled: &[Peeled]) -> Value {
    peeled.iter().map(blueprint).collect()
}

fn blueprint(peeled: &Peeled) -> Value {
    let drawn = peeled.layers as usize;
    let of_layers = |counts: &[u32]| counts.iter().take(drawn).copied().collect::<Vec<_>>();
    let mut found = json!({
        "layers": drawn,
        "pixels": of_layers(&peeled.pixels),
        "ended_by": peeled.ended().to_string(),
    });
    if peeled.masked > 0 {
        found["mask"] = json!({
            "pixels": peeled.masked,
            "uncovered": peeled.uncovered(),
            "uncovered_by_layer": of_layers(&peeled.passed),
            "behind_opaque": peeled.hidden,
            "asked": f64::from(peeled.fraction),
            "reached": peeled.share_uncovered(),
        });
    }
    found
}

/// What could not be uncovered.
pub(super) fn warnings(peeled: &[Peeled]) -> impl Iterator<Item = String> + '_ {
    peeled.iter().filter_map(Peeled::shortfall).map(|shortfall| format!("blueprint: {shortfall}"))
}
