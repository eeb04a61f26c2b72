//! Glyphs as tables of a `.hachure` file.

use glam::DVec3;
use serde::Deserialize;
use toml::{Table, Value};

use super::{Anchor, Glyph, Shape};
use crate::style::{StyleError, diff_to_toml, nearest, set_from_toml};

/// A table that is no glyph. It is kept, so that saving loses nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Unreadable {
    /// As TOML.
    text: String,
    /// What is wrong with it.
    pub reason: String,
}

const KINDS: [&str; 4] = ["box", "arrow", "path", "label"];

/// What is no parameter.
#[derive(Deserialize)]
struct Form {
    kind: String,
    name: Option<String>,
    node: Option<String>,
    point: Option<DVec3>,
    points: Option<Vec<DVec3>>,
    text: Option<String>,
}

/// The glyphs that a document lists, and what of the list cannot be read.
pub(in crate::document) fn from_tables(tables: Vec<Table>) -> (Vec<Glyph>, Vec<Unreadable>) {
    let (mut glyphs, mut unreadable) = (Vec::new(), Vec::new());
    for table in tables {
        match from_table(table.clone()) {
            Ok(glyph) => glyphs.push(glyph),
            Err(reason) => unreadable.push(Unreadable { text: table.to_string(), reason }),
        }
    }
    (glyphs, unreadable)
}

fn from_table(mut table: Table) -> Result<Glyph, String> {
    let own: Table = ["kind", "name", "node", "point", "points", "text"]
        .into_iter()
        .filter_map(|key| Some((key.to_owned(), table.remove(key)?)))
        .collect();
    let form: Form = own.try_into().map_err(|e: toml::de::Error| e.message().to_owned())?;
    let points = form.points.iter().flatten().chain(&form.point);
    if let Some(number) = points.clone().position(|p| !p.is_finite()) {
        return Err(format!("its point {} has a coordinate that is no number", number + 1));
    }
    let missing = |key: &str| format!("a glyph of kind `{}` needs `{key}`", form.kind);
    let shape = match form.kind.as_str() {
        "box" => Shape::around(form.node.ok_or_else(|| missing("node"))?),
        "arrow" | "path" => Shape::path(form.points.ok_or_else(|| missing("points"))?),
        "label" => {
            let anchor = match (form.point, form.node) {
                (Some(point), _) => Anchor::Point(point),
                (None, Some(node)) => Anchor::Node(node),
                (None, None) => return Err(missing("point` or `node")),
            };
            Shape::label(form.text.ok_or_else(|| missing("text"))?, anchor)
        }
        other => {
            let meant = nearest(other, KINDS).map_or(String::new(), |n| format!("; did you mean `{n}`?"));
            return Err(format!("`{other}` is no kind of glyph; there are {}{meant}", KINDS.join(", ")));
        }
    };
    let mut glyph = Glyph::new(form.name.unwrap_or(form.kind), shape);
    let section = Table::from_iter([("glyph".to_owned(), Value::Table(table))]);
    set_from_toml(&mut glyph.params(), &section.to_string(), "").map(drop).map_err(|e| match e {
        StyleError::InFile { source, .. } => source.to_string(),
        other => other.to_string(),
    })?;
    Ok(glyph)
}

/// The tables of glyphs: only what differs from the usual look is written.
pub(in crate::document) fn to_tables(glyphs: &[Glyph], unreadable: &[Unreadable]) -> Vec<Table> {
    let tables = glyphs.iter().map(to_table);
    tables.chain(unreadable.iter().map(|u| u.text.parse().unwrap_or_default())).collect()
}

fn to_table(glyph: &Glyph) -> Table {
    let numbers = |p: &DVec3| Value::Array(p.to_array().map(Value::Float).to_vec());
    let mut table = Table::new();
    table.insert("kind".to_owned(), glyph.shape.kind().into());
    table.insert("name".to_owned(), glyph.name.clone().into());
    match &glyph.shape {
        Shape::Box(shape) => {
            table.insert("node".to_owned(), shape.node.clone().into());
        }
        Shape::Path(shape) => {
            table.insert("points".to_owned(), shape.points.iter().map(numbers).collect::<Vec<_>>().into());
        }
        Shape::Label(shape) => {
            table.insert("text".to_owned(), shape.text.clone().into());
            match &shape.anchor {
                Anchor::Point(point) => table.insert("point".to_owned(), numbers(point)),
                Anchor::Node(node) => table.insert("node".to_owned(), node.clone().into()),
            };
        }
    }
    let mut usual = Glyph::new(String::new(), glyph.shape.usual());
    let differing = diff_to_toml(&mut glyph.clone().params(), &mut usual.params());
    table.extend(differing.get("glyph").and_then(Value::as_table).cloned().unwrap_or_default());
    table
}
