//! What is said of the blueprints of a picture: how far they were peeled, and what of the designated objects that uncovered.

use serde_json::{Value, json};

use crate::document::LayersBy;
use crate::render;
use crate::render::Peeled;

/// Exactly how far each blueprint was peeled, and how its layers were made.
pub(super) fn as_json(peeled: &[(Peeled, render::LayersBy)]) -> Value {
    peeled.iter().map(blueprint).collect()
}

fn blueprint((peeled, by): &(Peeled, render::LayersBy)) -> Value {
    let drawn = peeled.layers as usize;
    let of_layers = |counts: &[u32]| counts.iter().take(drawn).copied().collect::<Vec<_>>();
    let mut found = json!({
        "layers": drawn,
        "layers_by": by.to_string(),
        "pixels": of_layers(&peeled.pixels),
        "ended_by": peeled.ended.to_string(),
    });
    if peeled.masked > 0 {
        found["mask"] = json!({
            "pixels": peeled.masked,
            "uncovered": peeled.uncovered(),
            "uncovered_by_layer": of_layers(&peeled.passed),
            "behind_opaque": peeled.hidden,
            // Through text, so that 0.9 is printed as 0.9.
            "asked": peeled.fraction.to_string().parse::<f64>().unwrap_or_default(),
            "reached": peeled.share_uncovered(),
        });
    }
    found
}

/// What could not be uncovered, and whether layers could not be made as was asked for.
pub(super) fn warnings(
    peeled: &[(Peeled, render::LayersBy)],
    asked: LayersBy,
) -> impl Iterator<Item = String> + '_ {
    let shortfalls = peeled.iter().flat_map(move |(peeled, by)| {
        let by = by.shortfall().filter(|_| asked == LayersBy::Lists);
        peeled.shortfall().into_iter().chain(by)
    });
    shortfalls.map(|shortfall| format!("blueprint: {shortfall}"))
}
