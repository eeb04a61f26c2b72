//! Parameters as TOML: only what differs from the defaults is written, every mistake is told with its line.
//!
//! A parameter that inherits, as by default, is left out; one that would have a value of its own by default is
//! written as `"inherit"`.

use toml::de::{DeArray, DeTable, DeValue};
use toml::{Spanned, Table};

use super::param::{self, Param, Renamed, Slot};
use super::{Matrix, Point, StyleError, Value, widened};

/// The parameters of `params` that differ from `defaults`, as nested tables.
pub fn diff_to_toml(params: &mut [Param<'_>], defaults: &mut [Param<'_>]) -> Table {
    let mut root = Table::new();
    for (param, default) in params.iter().zip(defaults.iter()) {
        let value = param.own();
        if value == default.own() {
            continue;
        }
        let mut table = &mut root;
        let mut names = param.key.split('.').peekable();
        while let Some(name) = names.next() {
            if names.peek().is_none() {
                table.insert(
                    name.to_owned(),
                    match &value {
                        Value::Bool(b) => (*b).into(),
                        Value::Number(n) if matches!(param.slot, Slot::Integer { .. }) => (*n as i64).into(),
                        Value::Number(n) => (*n).into(),
                        Value::Matrix(m) => rows_of(m.0),
                        Value::Curve(points) => rows_of(points.iter().map(|p| [p.x, p.y])),
                        Value::Text(_) | Value::Inherit => value.to_string().into(),
                    },
                );
                break;
            }
            let entry = table.entry(name).or_insert_with(|| toml::Value::Table(Table::new()));
            let toml::Value::Table(inner) = entry else {
                break;
            };
            table = inner;
        }
    }
    root
}

/// Sets what the TOML text `text` says and returns the keys of earlier versions among it. The keys `name` and `description` are
/// left to the caller.
///
/// # Errors
/// The first mistake, with `place` (a file name) and line. Parameters before it have been set.
pub fn set_from_toml(params: &mut [Param<'_>], text: &str, place: &str) -> Result<Vec<Renamed>, StyleError> {
    let line_of = |offset: usize| 1 + text.bytes().take(offset).filter(|b| *b == b'\n').count();
    let in_file = |offset: usize, source| StyleError::InFile {
        path: place.to_owned(),
        line: line_of(offset),
        source: Box::new(source),
    };
    let table = DeTable::parse(text).map_err(|e| {
        in_file(e.span().map_or(0, |s| s.start), StyleError::Syntax { message: e.message().to_owned() })
    })?;
    let mut values = Vec::new();
    collect(table.get_ref(), "", &mut values);
    let mut renamed = Vec::new();
    for (key, offset, value) in values {
        if key == "name" || key == "description" {
            continue;
        }
        let value = value.map_err(|e| asked_of(params, e));
        renamed.extend(
            value.and_then(|value| param::set(params, &key, &value)).map_err(|e| in_file(offset, e))?,
        );
    }
    Ok(renamed)
}

/// With what the parameter takes in place of what any takes.
fn asked_of(params: &[Param<'_>], error: StyleError) -> StyleError {
    match error {
        StyleError::WrongType { key, expected, found } => {
            let param = params.iter().find(|p| p.key == key);
            StyleError::WrongType { expected: param.map_or(expected, Param::domain), key, found }
        }
        other => other,
    }
}

/// `[[a, b], [c, d]]`
fn rows_of(rows: impl IntoIterator<Item = [f32; 2]>) -> toml::Value {
    let number = |n: f32| toml::Value::Float(widened(n));
    toml::Value::Array(rows.into_iter().map(|row| toml::Value::Array(row.map(number).to_vec())).collect())
}

/// A matrix that stands as `[[a, b], [c, d]]`, or a curve that stands as `[[x, y], …]`.
fn rows(rows: &DeArray<'_>) -> Option<Value> {
    let rows: Vec<[f32; 2]> = rows.iter().map(row).collect::<Option<_>>()?;
    match rows.as_slice() {
        [] => None,
        [first, second] => Some(Value::Matrix(Matrix([*first, *second]))),
        points => Some(Value::Curve(points.iter().copied().map(Point::from).collect())),
    }
}

/// `[a, b]`
fn row(row: &Spanned<DeValue<'_>>) -> Option<[f32; 2]> {
    let DeValue::Array(row) = row.get_ref() else { return None };
    let mut numbers = row.iter().map(|number| match number.get_ref() {
        DeValue::Integer(i) => i64::from_str_radix(i.as_str(), i.radix()).ok().map(|i| i as f32),
        DeValue::Float(f) => f.as_str().parse().ok(),
        _ => None,
    });
    match (numbers.next(), numbers.next(), numbers.next()) {
        (Some(Some(a)), Some(Some(b)), None) => Some([a, b]),
        _ => None,
    }
}

type Found = (String, usize, Result<Value, StyleError>);

fn collect(table: &DeTable<'_>, prefix: &str, out: &mut Vec<Found>) {
    for (name, value) in table {
        let key = format!("{prefix}{}", name.get_ref());
        match value.get_ref() {
            DeValue::Table(inner) => collect(inner, &format!("{key}."), out),
            _ => out.push((key.clone(), name.span().start, scalar(&key, value))),
        }
    }
}

fn scalar(key: &str, value: &Spanned<DeValue<'_>>) -> Result<Value, StyleError> {
    let wrong = |found: &str| StyleError::WrongType {
        key: key.to_owned(),
        expected: "a switch, a number, a text, a matrix as [[a, b], [c, d]] or a curve as [[x, y], …]"
            .to_owned(),
        found: found.to_owned(),
    };
    match value.get_ref() {
        DeValue::Boolean(b) => Ok(Value::Bool(*b)),
        DeValue::Integer(i) => i64::from_str_radix(i.as_str(), i.radix())
            .map(|i| Value::Number(i as f64))
            .map_err(|_too_large| wrong("an integer that is too large")),
        DeValue::Float(f) => {
            f.as_str().parse().map(Value::Number).map_err(|_malformed| wrong("a malformed number"))
        }
        DeValue::String(s) => Ok(Value::from(s.as_ref())),
        DeValue::Array(array) => rows(array).ok_or_else(|| wrong("this array")),
        _ => Err(wrong("something else")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Style;
    use super::*;

    fn error(text: &str) -> String {
        set_from_toml(&mut Style::default().params(), text, "my.toml").unwrap_err().to_string()
    }

    #[test]
    fn mistakes_are_told_with_place_line_and_remedy() {
        assert_eq!(
            error("technique = \"gooch\"\n[gooch]\nalhpa = 0.3\n"),
            "my.toml, line 3: unknown parameter `gooch.alhpa`; did you mean `gooch.alpha`?"
        );
        assert_eq!(
            error("[gooch]\nalpha = 3\n"),
            "my.toml, line 2: `gooch.alpha` = 3 is out of range: 0 to 1"
        );
        assert_eq!(
            error("[gooch]\nalpha = \"much\"\n"),
            "my.toml, line 2: `gooch.alpha` takes a number from 0 to 1, not the text `much`"
        );
        assert!(error("technique = \"oil\"").contains("one of blank, plain, unlit, gooch"));
        assert!(error("x = [").starts_with("my.toml, line 1: "));
        assert!(error("[gooch]\nalpha = nan").contains("out of range"));
        assert_eq!(
            error("[toon]\nbands = [2]\n"),
            "my.toml, line 2: `toon.bands` takes a whole number from 2 to 8, not this array"
        );
        assert!(
            error("toon = [1, 2]").starts_with("my.toml, line 1: `toon` takes a switch, a number, a text")
        );
        assert!(error(&"nonsense\n".repeat(100_000)).starts_with("my.toml, line 1: "));
    }

    #[test]
    fn matrices_stand_as_two_rows() {
        let text = "[sketch.pass1]\nmatrix = [[1.0, 0.2], [-0.2, 1.0]]\n";
        let mut style = Style::default();
        set_from_toml(&mut style.params(), text, "my.toml").unwrap();
        assert_eq!(style.sketch.pass[0].matrix, Matrix([[1.0, 0.2], [-0.2, 1.0]]));
        let written = diff_to_toml(&mut style.params(), &mut Style::default().params());
        assert_eq!(written, text.parse().unwrap());
        let mut again = Style::default();
        set_from_toml(&mut again.params(), &written.to_string(), "my.toml").unwrap();
        assert_eq!(again, style);
        // Whole numbers will do, on lines of their own too.
        let whole = "[sketch]\npass1.matrix = [\n  [1, 0x2], # of the first noise and the second\n  [+3, 4_0e-1],\n]\n";
        set_from_toml(&mut style.params(), whole, "my.toml").unwrap();
        assert_eq!(style.sketch.pass[0].matrix, Matrix([[1.0, 2.0], [3.0, 4.0]]));
    }

    #[test]
    fn what_is_no_matrix_is_told_with_line_and_remedy() {
        let row =
            |value: &str| error(&format!("[sketch]\nenabled = true\n[sketch.pass1]\nmatrix = {value}\n"));
        let takes = "my.toml, line 4: `sketch.pass1.matrix` takes a matrix of numbers from -32 to 32, \
                     [[a, b], [c, d]] in a file and a,b,c,d behind --set, not ";
        for array in [
            "[1, 2, 3, 4]",
            "[]",
            "[[]]",
            "[[1, 2], [3]]",
            "[[1, 2], [3, 4], 5]",
            "[[1, 2, 3], [4]]",
            "[[1, \"2\"], [3, 4]]",
            "[[1, 2], [3, [4]]]",
            "[[1, 2], [3, 99999999999999999999]]",
            "[1, [2, 3]]",
        ] {
            assert_eq!(row(array), format!("{takes}this array"), "{array}");
        }
        assert_eq!(row("[[1, 2]]"), format!("{takes}1 point"));
        assert_eq!(row("[[1, 2], [3, 4], [5, 6]]"), format!("{takes}3 points"));
        assert_eq!(row("\"1,2,3,4\""), format!("{takes}the text `1,2,3,4`"));
        assert_eq!(row("1.5"), format!("{takes}the number 1.5"));
        assert_eq!(row("true"), format!("{takes}the switch `true`"));
        assert!(row("\"inherit\"").ends_with("not `inherit`, for it inherits from nothing"));
        assert!(row("{ a = 1 }").contains("unknown parameter `sketch.pass1.matrix.a`"));
        let range = "my.toml, line 4: `sketch.pass1.matrix` = ";
        for (value, number) in
            [("nan", "NaN"), ("-inf", "-inf"), ("1e9", "1000000000"), ("-32.1", "-32.1"), ("33", "33")]
        {
            let message = row(&format!("[[0, 0], [{value}, 0]]"));
            assert_eq!(message, format!("{range}{number} is out of range: -32 to 32"));
        }
        assert!(row("[[1, 2], [3, 4]").starts_with("my.toml, line "));
    }
}
