//! A parameter's value by itself, as it stands in a file.

use std::fmt;

use super::{Matrix, Point};

/// The word that gives a parameter back to what it inherits from.
const INHERIT: &str = "inherit";

/// A parameter's value by itself, as it stands in a file or behind `--set KEY=`.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Of a switch.
    Bool(bool),
    /// Of a number.
    Number(f64),
    /// Of a matrix, or of a curve of two points, which looks the same.
    Matrix(Matrix),
    /// Of a curve: its points as they stand there, whether they make up one or not.
    Curve(Vec<Point>),
    /// Of a color or a choice.
    Text(String),
    /// No value of its own, written `inherit`: the value of the parameter that it inherits from.
    Inherit,
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bool(b) => b.fmt(f),
            Self::Number(n) => n.fmt(f),
            Self::Matrix(m) => m.fmt(f),
            Self::Curve(points) => {
                for (i, Point { x, y }) in points.iter().enumerate() {
                    write!(f, "{}{x},{y}", if i == 0 { "" } else { "," })?;
                }
                Ok(())
            }
            Self::Text(t) => f.write_str(t),
            Self::Inherit => f.write_str(INHERIT),
        }
    }
}

impl From<&str> for Value {
    /// A text in a file.
    fn from(text: &str) -> Self {
        if text == INHERIT { Self::Inherit } else { Self::Text(text.to_owned()) }
    }
}

impl Value {
    /// What a person wrote behind `=` on the command line.
    pub fn parse(text: &str) -> Self {
        match text {
            "true" | "on" => Self::Bool(true),
            "false" | "off" => Self::Bool(false),
            _ => match (text.parse(), text.parse()) {
                (Ok(number), _) => Self::Number(number),
                (_, Ok(matrix)) => Self::Matrix(matrix),
                _ => points_of(text).map_or_else(|| Self::from(text), Self::Curve),
            },
        }
    }

    /// The points of a curve; none of what is neither a curve nor looks like one.
    pub(super) fn points(&self) -> Vec<Point> {
        match self {
            Self::Matrix(rows) => rows.0.map(Point::from).to_vec(),
            Self::Curve(points) => points.clone(),
            Self::Bool(_) | Self::Number(_) | Self::Text(_) | Self::Inherit => Vec::new(),
        }
    }

    /// What it is, in words.
    pub(super) fn kind(&self) -> String {
        match self {
            Self::Bool(b) => format!("the switch `{b}`"),
            Self::Number(n) => format!("the number {n}"),
            Self::Matrix(m) => format!("the matrix {m}"),
            Self::Curve(points) => match points.len() {
                1 => "1 point".to_owned(),
                count => format!("{count} points"),
            },
            Self::Text(t) => format!("the text `{t}`"),
            Self::Inherit => format!("`{INHERIT}`, for it inherits from nothing"),
        }
    }
}

/// The number as it is written in decimals, so that 0.1 stays 0.1 and does not become 0.10000000149.
pub(crate) fn widened(number: f32) -> f64 {
    number.to_string().parse().unwrap_or(0.0)
}

/// Points as `x,y,x,y,…`; `None` if that is something else.
fn points_of(text: &str) -> Option<Vec<Point>> {
    let numbers: Result<Vec<f32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
    let numbers = numbers.ok()?;
    let (points, rest) = numbers.as_chunks();
    rest.is_empty().then(|| points.iter().copied().map(Point::from).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let matrix = Value::Matrix(Matrix([[1.0, 0.5], [-0.5, 0.1]]));
        let curve = Value::Curve([[0.0, 0.1], [0.4, 0.2], [1.0, 0.75]].map(Point::from).to_vec());
        let text = Value::Text("c1".to_owned());
        for value in [Value::Bool(true), Value::Number(0.1), matrix, curve, text, Value::Inherit] {
            assert_eq!(Value::parse(&value.to_string()), value);
        }
        assert_eq!(Value::parse("off"), Value::Bool(false));
        assert_eq!(Value::parse(" 0, 0,0.5 ,1,1, 1").to_string(), "0,0,0.5,1,1,1");
        for text in ["0,0,1", "0,0,0.5,x,1,1", "0,0;1,1", "[[0,0],[0.5,0],[1,1]]", "0,0,0.5,0,1,1,"] {
            assert_eq!(Value::parse(text), Value::Text(text.to_owned()));
        }
    }
}
