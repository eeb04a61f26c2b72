//! A parameter's value by itself, as it stands in a file.

use std::fmt;

use super::Matrix;

/// The word that gives a parameter back to what it inherits from.
const INHERIT: &str = "inherit";

/// A parameter's value by itself, as it stands in a file or behind `--set KEY=`.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Of a switch.
    Bool(bool),
    /// Of a number.
    Number(f64),
    /// Of a matrix.
    Matrix(Matrix),
    /// Of a colour or a choice.
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
                _ => Self::from(text),
            },
        }
    }

    /// What it is, in words.
    pub(super) fn kind(&self) -> String {
        match self {
            Self::Bool(b) => format!("the switch `{b}`"),
            Self::Number(n) => format!("the number {n}"),
            Self::Matrix(m) => format!("the matrix {m}"),
            Self::Text(t) => format!("the text `{t}`"),
            Self::Inherit => format!("`{INHERIT}`, for it inherits from nothing"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let matrix = Value::Matrix(Matrix([[1.0, 0.5], [-0.5, 0.1]]));
        for value in
            [Value::Bool(true), Value::Number(0.1), matrix, Value::Text("c1".to_owned()), Value::Inherit]
        {
            assert_eq!(Value::parse(&value.to_string()), value);
        }
        assert_eq!(Value::parse("off"), Value::Bool(false));
    }
}
