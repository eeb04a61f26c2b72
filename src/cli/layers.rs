//! What is said of the blueprints of a picture: how many layers they have, and what of the designated objects that uncovered.

use serde_json::{Value, json};

use crate::document::LayersBy;
use crate::render::{LayerMethod, LayerReport};

/// The layers of each blueprint: how many, what ended them and how they were made.
pub(super) fn as_json(reports: &[(LayerReport, LayerMethod)]) -> Value {
    reports.iter().map(blueprint).collect()
}

fn blueprint((report, by): &(LayerReport, LayerMethod)) -> Value {
    let drawn = report.layers as usize;
    let of_layers = |counts: &[u32]| counts.iter().take(drawn).copied().collect::<Vec<_>>();
    let mut found = json!({
        "layers": drawn,
        "layers_by": by.to_string(),
        "pixels": of_layers(&report.pixels),
        "ended_by": report.ended.to_string(),
    });
    if report.masked > 0 {
        found["mask"] = json!({
            "pixels": report.masked,
            "uncovered": report.uncovered(),
            "uncovered_by_layer": of_layers(&report.passed),
            "behind_opaque": report.hidden,
            // Through text, so that 0.9 is printed as 0.9.
            "asked": report.fraction.to_string().parse::<f64>().unwrap_or_default(),
            "reached": report.share_uncovered(),
        });
    }
    found
}

/// What could not be uncovered, and whether layers could not be made as was asked for.
pub(super) fn warnings(
    reports: &[(LayerReport, LayerMethod)],
    asked: LayersBy,
) -> impl Iterator<Item = String> + '_ {
    let shortfalls = reports.iter().flat_map(move |(report, by)| {
        let by = by.shortfall().filter(|_| asked == LayersBy::Lists);
        report.shortfall().into_iter().chain(by)
    });
    shortfalls.map(|shortfall| format!("blueprint: {shortfall}"))
}
