//! The reference of presets and parameters as a page: `docs/parameters.md`.

use crate::style::Param;
use crate::style::param::Condition;
use crate::style::preset::Preset;

/// What stands above everything.
const HEAD: &str = "# Presets and parameters

Printed by `hachure styles --markdown`; `make docs` writes it to this file. What is written here by hand is lost.

Keys are those of `--set KEY=VALUE`, of style files and of documents ([documents](documents.md)). Lengths in px are of a picture
1080 pixels high. *Panel* is what the window calls a parameter. Where a section or a row says \"when\", the parameter has no
effect otherwise. `inherit` gives a parameter back to the one that it follows.
";

/// The whole page.
pub(super) fn page(presets: &[Preset], params: &[Param<'_>]) -> String {
    let mut page = HEAD.to_owned();
    page += "\n## Presets\n\n| `--style` | panel | technique | |\n| --- | --- | --- | --- |\n";
    for preset in presets {
        let technique: &str = preset.style.technique.into();
        let Preset { id, name, description, .. } = preset;
        page += &format!("| `{id}` | {name} | `{technique}` | {} |\n", cell(description));
    }
    for (name, rows) in sections(params) {
        let common = common_conditions(&rows);
        let level = "#".repeat(2 + name.matches('.').count());
        page += &format!("\n{level} {}\n\n", if name.is_empty() { "Of every style" } else { name });
        if !common.is_empty() {
            page += &format!("When {}.\n\n", in_words(&common));
        }
        page += "| key | panel | default | takes | |\n| --- | --- | --- | --- | --- |\n";
        for param in rows {
            page += &row(param, &common);
        }
    }
    page
}

/// The parameters under what their keys have before the last dot, in the order in which these come first.
fn sections<'p, 'v>(params: &'p [Param<'v>]) -> Vec<(&'p str, Vec<&'p Param<'v>>)> {
    let mut sections: Vec<(&str, Vec<&Param<'_>>)> = Vec::new();
    for param in params {
        let name = param.key.rsplit_once('.').map_or("", |(section, _)| section);
        match sections.iter_mut().find(|(known, _)| *known == name) {
            Some((_, rows)) => rows.push(param),
            None => sections.push((name, vec![param])),
        }
    }
    sections
}

/// The conditions that all of some parameters have.
fn common_conditions(rows: &[&Param<'_>]) -> Vec<Condition> {
    let mut common = rows.first().map_or_else(Vec::new, |first| first.conditions.clone());
    common.retain(|condition| rows.iter().all(|row| row.conditions.contains(condition)));
    common
}

fn row(param: &Param<'_>, common: &[Condition]) -> String {
    let own: Vec<_> = param.conditions.iter().filter(|c| !common.contains(c)).cloned().collect();
    let when = if own.is_empty() { String::new() } else { format!(" When {}.", in_words(&own)) };
    let [label, default, domain, help] =
        [param.label, &super::default_of(param), &param.domain(), param.help].map(cell);
    format!("| `{}` | {label} | {default} | {domain} | {help}{when} |\n", param.key)
}

/// `` `edges.mode` is `exact` and `edges.hidden.mode` is `faint` or `own` ``
fn in_words(conditions: &[Condition]) -> String {
    let one = |c: &Condition| format!("`{}` is `{}`", c.key, c.values.join("` or `"));
    conditions.iter().map(one).collect::<Vec<_>>().join(" and ")
}

/// A text that ends no cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
