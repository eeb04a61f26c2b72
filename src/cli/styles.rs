//! `hachure styles`: presets and the reference of all parameters.

use serde_json::json;

use super::args::StylesArgs;
use super::{CliError, print_json, print_line};
use crate::document::View;
use crate::style::{Param, Slot, Style, Value, preset};

pub(super) fn run(args: &StylesArgs) -> Result<(), CliError> {
    let presets = preset::all();
    let mut style = Style::default();
    let mut view = View::default();
    let mut params = style.params();
    params.extend(view.params());
    if args.json {
        return print_json(&json!({
            "presets": presets.iter().map(|p| json!({
                "name": p.name,
                "technique": <&str>::from(p.style.technique),
                "description": p.description,
            })).collect::<Vec<_>>(),
            "parameters": params.iter().map(parameter_json).collect::<Vec<_>>(),
        }));
    }
    print_line("Presets")?;
    for preset in &presets {
        let technique: &str = preset.style.technique.into();
        print_line(&format!("  {:<10} {technique:<8} {}", preset.name, preset.description))?;
    }
    print_line("\nParameters (for --set KEY=VALUE and style files)")?;
    for param in &params {
        let unit = param.unit;
        print_line(&format!("  {:<26} {}{unit}, {}", param.key, param.value(), param.domain()))?;
        print_line(&format!("  {:<26} {}", "", param.help))?;
    }
    Ok(())
}

fn parameter_json(param: &Param<'_>) -> serde_json::Value {
    let (range, choices) = match &param.slot {
        Slot::Number { soft, hard, .. } => {
            let ends = |r: &std::ops::RangeInclusive<f32>| json!([*r.start(), *r.end()]);
            (json!({ "soft": ends(soft), "hard": ends(hard) }), json!(null))
        }
        Slot::Choice(choice) => (json!(null), json!(choice.names())),
        Slot::Bool(_) | Slot::Color(_) => (json!(null), json!(null)),
    };
    json!({
        "key": param.key,
        "label": param.label,
        "unit": param.unit,
        "technique": param.technique.map(<&str>::from),
        "default": match param.value() {
            Value::Bool(b) => json!(b),
            Value::Number(n) => json!(n),
            Value::Text(t) => json!(t),
        },
        "range": range,
        "choices": choices,
        "help": param.help,
    })
}
