//! The one declared list of parameters.
//!
//! An effect declares its parameters by pushing them to [`Params`]: key, label, unit, ranges, help and a slot that
//! borrows the field itself. Nothing else in the program knows a slider by name.

use std::fmt;
use std::ops::RangeInclusive;

use super::{Color, StyleError, Technique, nearest};

/// One parameter of one borrowed object.
pub struct Param<'a> {
    /// Dotted key, the same in files and on the command line: `edges.profile.threshold`.
    pub key: String,
    /// Short name for the panel.
    pub label: &'static str,
    /// Unit after a number: `°`, `px`; empty for none.
    pub unit: &'static str,
    /// One line of help.
    pub help: &'static str,
    /// The only technique that reads it; `None`: all do.
    pub technique: Option<Technique>,
    /// Where the value is.
    pub slot: Slot<'a>,
}

/// The borrowed value of a parameter.
pub enum Slot<'a> {
    /// A switch.
    Bool(&'a mut bool),
    /// A number.
    Number {
        /// The value.
        value: &'a mut f32,
        /// What a slider offers.
        soft: RangeInclusive<f32>,
        /// What is accepted at all.
        hard: RangeInclusive<f32>,
    },
    /// A colour.
    Color(&'a mut Color),
    /// One of a few names.
    Choice(&'a mut dyn Choice),
}

/// An enumeration whose variants have names.
pub trait Choice {
    /// All names.
    fn names(&self) -> &'static [&'static str];
    /// The name of the current variant.
    fn name(&self) -> &'static str;
    /// Takes the variant of that name; `false` if there is none.
    fn choose(&mut self, name: &str) -> bool;
}

impl<T> Choice for T
where
    T: strum::VariantNames + std::str::FromStr + Into<&'static str> + Copy,
{
    fn names(&self) -> &'static [&'static str] {
        T::VARIANTS
    }

    fn name(&self) -> &'static str {
        (*self).into()
    }

    fn choose(&mut self, name: &str) -> bool {
        name.parse().map(|value| *self = value).is_ok()
    }
}

/// A parameter's value by itself, as it stands in a file.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Of a switch.
    Bool(bool),
    /// Of a number.
    Number(f64),
    /// Of a colour or a choice.
    Text(String),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bool(b) => b.fmt(f),
            Self::Number(n) => n.fmt(f),
            Self::Text(t) => f.write_str(t),
        }
    }
}

impl Value {
    /// What a person wrote behind `=` on the command line.
    pub fn parse(text: &str) -> Self {
        match text {
            "true" | "on" => Self::Bool(true),
            "false" | "off" => Self::Bool(false),
            _ => text.parse().map_or_else(|_not_a_number| Self::Text(text.to_owned()), Self::Number),
        }
    }

    fn kind(&self) -> String {
        match self {
            Self::Bool(b) => format!("the switch `{b}`"),
            Self::Number(n) => format!("the number {n}"),
            Self::Text(t) => format!("the text `{t}`"),
        }
    }
}

impl Param<'_> {
    /// The value as it stands in a file.
    pub fn value(&self) -> Value {
        match &self.slot {
            Slot::Bool(b) => Value::Bool(**b),
            // Through text, so that 0.1 is written as 0.1 and not as 0.10000000149.
            Slot::Number { value, .. } => Value::Number(value.to_string().parse().unwrap_or(0.0)),
            Slot::Color(c) => Value::Text(c.to_string()),
            Slot::Choice(c) => Value::Text(c.name().to_owned()),
        }
    }

    /// What it takes, in words: `a number from 0 to 1`.
    pub fn domain(&self) -> String {
        match &self.slot {
            Slot::Bool(_) => "true or false".to_owned(),
            Slot::Number { hard, .. } => format!("a number from {} to {}", hard.start(), hard.end()),
            Slot::Color(_) => "a colour as #rrggbb".to_owned(),
            Slot::Choice(c) => format!("one of {}", c.names().join(", ")),
        }
    }

    /// Sets the value.
    ///
    /// # Errors
    /// [`StyleError::WrongType`] or [`StyleError::OutOfRange`]; the value is then unchanged.
    pub fn set(&mut self, new: &Value) -> Result<(), StyleError> {
        let done = match (&mut self.slot, new) {
            (Slot::Bool(b), Value::Bool(new)) => {
                **b = *new;
                true
            }
            (Slot::Number { value, hard, .. }, Value::Number(new)) => {
                let narrow = *new as f32;
                if !hard.contains(&narrow) {
                    return Err(StyleError::OutOfRange {
                        key: self.key.clone(),
                        found: *new,
                        min: *hard.start(),
                        max: *hard.end(),
                    });
                }
                **value = narrow;
                true
            }
            (Slot::Color(c), Value::Text(new)) => new.parse().map(|new| **c = new).is_ok(),
            (Slot::Choice(c), Value::Text(new)) => c.choose(new),
            _ => false,
        };
        if done {
            Ok(())
        } else {
            Err(StyleError::WrongType { key: self.key.clone(), expected: self.domain(), found: new.kind() })
        }
    }
}

/// Sets one parameter of a list by its key.
///
/// # Errors
/// [`StyleError::UnknownKey`], or what [`Param::set`] says.
pub fn set(params: &mut [Param<'_>], key: &str, value: &Value) -> Result<(), StyleError> {
    if let Some(param) = params.iter_mut().find(|p| p.key == key) {
        return param.set(value);
    }
    Err(StyleError::UnknownKey {
        key: key.to_owned(),
        nearest: nearest(key, params.iter().map(|p| p.key.as_str())),
    })
}

/// The list while it is being declared.
#[derive(Default)]
pub struct Params<'a> {
    list: Vec<Param<'a>>,
    prefix: String,
    technique: Option<Technique>,
}

impl<'a> Params<'a> {
    /// Declares the parameters of one effect or group: their keys begin with `name.`.
    pub fn section(&mut self, name: &str, technique: Option<Technique>, declare: impl FnOnce(&mut Self)) {
        let outer = self.prefix.len();
        let outer_technique = self.technique;
        self.prefix.push_str(name);
        self.prefix.push('.');
        self.technique = technique.or(outer_technique);
        declare(self);
        self.prefix.truncate(outer);
        self.technique = outer_technique;
    }

    fn push(
        &mut self,
        key: &str,
        label: &'static str,
        unit: &'static str,
        help: &'static str,
        slot: Slot<'a>,
    ) {
        self.list.push(Param {
            key: format!("{}{key}", self.prefix),
            label,
            unit,
            help,
            technique: self.technique,
            slot,
        });
    }

    /// A switch.
    pub fn switch(&mut self, key: &str, label: &'static str, help: &'static str, value: &'a mut bool) {
        self.push(key, label, "", help, Slot::Bool(value));
    }

    /// A number with the range of its slider (`soft`) and the range that is accepted (`hard`).
    pub fn number(
        &mut self,
        key: &str,
        label: &'static str,
        unit: &'static str,
        soft: RangeInclusive<f32>,
        hard: RangeInclusive<f32>,
        help: &'static str,
        value: &'a mut f32,
    ) {
        self.push(key, label, unit, help, Slot::Number { value, soft, hard });
    }

    /// A colour.
    pub fn color(&mut self, key: &str, label: &'static str, help: &'static str, value: &'a mut Color) {
        self.push(key, label, "", help, Slot::Color(value));
    }

    /// One of the variants of an enumeration.
    pub fn choice(&mut self, key: &str, label: &'static str, help: &'static str, value: &'a mut dyn Choice) {
        self.push(key, label, "", help, Slot::Choice(value));
    }

    /// The finished list.
    pub fn finish(self) -> Vec<Param<'a>> {
        self.list
    }
}
