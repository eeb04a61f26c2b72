//! `hachure styles`: presets and the reference of all parameters.

mod markdown;

use std::collections::BTreeMap;

use serde_json::json;

use super::args::StylesArgs;
use super::{CliError, print_json, print_line, print_text};
use crate::document::{Lighting, SectionSettings, ViewSettings};
use crate::style::preset::Preset;
use crate::style::{Param, Slot, Style, Value, preset, widened};

pub(super) fn run(args: &StylesArgs) -> Result<(), CliError> {
    let presets = preset::all();
    let mut style = Style::default();
    let mut view = ViewSettings::default();
    let mut lighting = Lighting::default();
    let paper = style.paper.color;
    let mut section = SectionSettings::default();
    let mut params = style.params();
    params.extend(view.params(paper));
    params.extend(lighting.params());
    params.extend(section.params());
    if args.markdown {
        return print_text(&markdown::page(&presets, &params));
    }
    if args.json {
        return print_json(&json!({
            "presets": presets.iter().map(|p| json!({
                "id": p.id,
                "name": p.name,
                "technique": <&str>::from(p.style.technique),
                "description": p.description,
            })).collect::<Vec<_>>(),
            "parameters": params.iter().map(parameter_json).collect::<Vec<_>>(),
        }));
    }
    print_line("Presets")?;
    let width = presets.iter().map(|p| p.id.len()).max().unwrap_or_default();
    for Preset { id, name, description, style, .. } in &presets {
        let technique: &str = style.technique.into();
        print_line(&format!("  {id:<width$} {technique:<9} {name}: {description}"))?;
    }
    print_line("\nParameters (for --set KEY=VALUE and style files)")?;
    let width = params.iter().map(|p| p.key.len()).max().unwrap_or_default();
    for param in &params {
        print_line(&format!("  {:<width$} {}, {}", param.key, default_of(param), param.domain()))?;
        print_line(&format!("  {:<width$} {}{}", "", param.help, conditions_of(param)))?;
    }
    Ok(())
}

/// `2.5 px`, or `as edges.profile.width`.
fn default_of(param: &Param<'_>) -> String {
    match (param.own(), param.slot.inherits()) {
        (Value::Inherit, Some(other)) => format!("as {other}"),
        (Value::Text(text), _) if text.is_empty() => "none".to_owned(),
        (own, _) => format!("{own} {}", param.unit).trim_end().to_owned(),
    }
}

/// ` (edges.mode=exact)`, or nothing.
fn conditions_of(param: &Param<'_>) -> String {
    if param.conditions.is_empty() {
        return String::new();
    }
    let conditions: Vec<_> =
        param.conditions.iter().map(|c| format!("{}={}", c.key, c.values.join("|"))).collect();
    format!(" ({})", conditions.join(", "))
}

fn parameter_json(param: &Param<'_>) -> serde_json::Value {
    let (range, choices) = match &param.slot {
        Slot::Number { soft, hard, .. } => {
            let ends = |r: &std::ops::RangeInclusive<f32>| json!([*r.start(), *r.end()]);
            (json!({ "soft": ends(soft), "hard": ends(hard) }), json!(null))
        }
        Slot::Integer { range, .. } => {
            let ends = [range.start(), range.end()];
            (json!({ "soft": ends, "hard": ends }), json!(null))
        }
        Slot::Choice(choice) => (json!(null), json!(choice.names())),
        Slot::Matrix { most, .. } => (json!({ "hard": [-most, *most] }), json!(null)),
        Slot::Curve(_) => (json!({ "hard": [0.0, 1.0] }), json!(null)),
        Slot::Bool(_) | Slot::Color(_) | Slot::File(_) => (json!(null), json!(null)),
    };
    json!({
        "key": param.key,
        "label": param.label,
        "unit": param.unit,
        "when": param.conditions.iter().map(|c| (c.key, &c.values)).collect::<BTreeMap<_, _>>(),
        "inherits": param.slot.inherits(),
        "default": match param.own() {
            Value::Bool(b) => json!(b),
            Value::Number(n) if matches!(param.slot, Slot::Integer { .. }) => json!(n as u32),
            Value::Number(n) => json!(n),
            Value::Matrix(m) => json!(m.0.map(|row| row.map(widened))),
            Value::Curve(points) => json!(points.iter().map(|p| [p.x, p.y].map(widened)).collect::<Vec<_>>()),
            own @ (Value::Text(_) | Value::Inherit) => json!(own.to_string()),
        },
        "range": range,
        "choices": choices,
        "help": param.help,
    })
}
