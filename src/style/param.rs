//! The one declared list of parameters.
//!
//! An effect declares its parameters by pushing them to [`Params`]: key, label, unit, ranges, help and a slot that
//! borrows the field itself. Nothing else in the program knows a slider by name.
//!
//! A parameter may *inherit*: until it has a value of its own, the value of another parameter holds. A value of its
//! own stays its own where it happens to equal the other's, in memory as in files; only `inherit` gives it back.

use std::path::{Path, PathBuf};

use super::{Color, Curve, StyleError, nearest, widened};

pub use super::declare::Params;
pub use super::slot::{Choice, Slot, StyleField};
pub use super::value::Value;

/// One parameter of one borrowed object.
pub struct Param<'a> {
    /// Dotted key, the same in files and on the command line: `edges.profile.width`.
    pub key: String,
    /// Short name for the panel.
    pub label: &'static str,
    /// Unit after a number: `°`, `px`; empty for none.
    pub unit: &'static str,
    /// One line of help.
    pub help: &'static str,
    /// When it matters: all must hold.
    pub conditions: Vec<Condition>,
    /// Where it matters.
    pub scope: Scope,
    /// Whether its section is folded in the panel at first.
    pub detail: bool,
    /// Whether it is the switch of its whole section.
    pub head: bool,
    /// That it and the next one are the ends of one range: what the panel calls it.
    pub span: Option<&'static str>,
    /// The key that it has in files of earlier versions, where that was another one.
    pub former: Option<String>,
    /// A value of a choice as files of earlier versions have it, and what it is called now.
    pub former_value: Option<(&'static str, &'static str)>,
    /// Where the value is.
    pub slot: Slot<'a>,
}

/// Of what a parameter changes the look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scope {
    /// Of any object.
    #[default]
    Objects,
    /// Of the whole drawing: nothing comes of it in the style of a single object.
    Drawing,
    /// Of mirrors.
    Mirrors,
    /// Of drawings with designated objects.
    Masks,
}

/// That a choice, a switch or a whole number has one of some values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Condition {
    /// Key of the parameter.
    pub key: &'static str,
    /// The values of which it must have one, as they are written.
    pub values: Vec<&'static str>,
}

impl Param<'_> {
    /// The value that holds, its own or an inherited one.
    pub fn value(&self) -> Value {
        match &self.slot {
            Slot::Bool(b) => Value::Bool(b.get()),
            Slot::Number { value, .. } => Value::Number(widened(value.get())),
            Slot::Integer { value, .. } => Value::Number(f64::from(**value)),
            Slot::Color(c) => Value::Text(c.get().to_string()),
            Slot::File(path) => {
                Value::Text(path.as_ref().map_or_else(String::new, |p| p.to_string_lossy().into_owned()))
            }
            Slot::Matrix { value, .. } => Value::Matrix(**value),
            Slot::Curve(curve) => Value::Curve(curve.points().to_vec()),
            Slot::Choice(c) => Value::Text(c.name().to_owned()),
        }
    }

    /// The value as it stands in a file: its own one, or that it inherits.
    pub fn own(&self) -> Value {
        if self.slot.is_inherited() { Value::Inherit } else { self.value() }
    }

    /// What it takes, in words: `a number from 0 to 1`.
    pub fn domain(&self) -> String {
        let mut domain = match &self.slot {
            Slot::Bool(_) => "true or false".to_owned(),
            Slot::Number { hard, .. } => format!("a number from {} to {}", hard.start(), hard.end()),
            Slot::Integer { range, .. } => {
                format!("a whole number from {} to {}", range.start(), range.end())
            }
            Slot::Color(_) => "a color as #rrggbb".to_owned(),
            Slot::File(_) => "the path of a PNG or JPEG image, or an empty text".to_owned(),
            Slot::Matrix { most, .. } => format!(
                "a matrix of numbers from {} to {most}, [[a, b], [c, d]] in a file and a,b,c,d behind --set",
                -most
            ),
            Slot::Curve(_) => format!(
                "a curve of {} to {} points from x = 0 to x = 1, y from 0 to 1, [[x, y], …] in a file and x,y,… behind \
                 --set",
                Curve::MIN_POINTS,
                Curve::MAX_POINTS
            ),
            Slot::Choice(c) => format!("one of {}", c.names().join(", ")),
        };
        if self.slot.inherits().is_some() {
            domain.push_str(&format!(", or {}", Value::Inherit));
        }
        domain
    }

    /// Sets the value, or gives it back to what it inherits from.
    ///
    /// # Errors
    /// [`StyleError::WrongType`], [`StyleError::OutOfRange`] or [`StyleError::Curve`]; the value is then unchanged.
    pub fn set(&mut self, new: &Value) -> Result<(), StyleError> {
        let done = match (&mut self.slot, new) {
            (slot, Value::Inherit) => slot.inherit(),
            (Slot::Bool(b), Value::Bool(new)) => {
                b.set(*new);
                true
            }
            (Slot::Number { value, hard, .. }, Value::Number(new)) => {
                let narrow = *new as f32;
                if !hard.contains(&narrow) {
                    return Err(out_of_range(&self.key, *new, [*hard.start(), *hard.end()]));
                }
                value.set(narrow);
                true
            }
            (Slot::Integer { value, range }, Value::Number(new)) if new.fract() == 0.0 => {
                let [min, max] = [*range.start(), *range.end()];
                if !(f64::from(min)..=f64::from(max)).contains(new) {
                    return Err(out_of_range(&self.key, *new, [min as f32, max as f32]));
                }
                **value = *new as u32;
                true
            }
            (Slot::Color(c), Value::Text(new)) => new.parse::<Color>().map(|new| c.set(new)).is_ok(),
            (Slot::File(path), Value::Text(new)) => {
                **path = (!new.is_empty()).then(|| PathBuf::from(new));
                true
            }
            (Slot::Matrix { value, most }, Value::Matrix(new)) => {
                if let Some(wrong) = new.numbers().into_iter().find(|n| !(-*most..=*most).contains(n)) {
                    return Err(out_of_range(&self.key, widened(wrong), [-*most, *most]));
                }
                **value = *new;
                true
            }
            (Slot::Curve(curve), Value::Curve(_) | Value::Matrix(_)) => {
                **curve = Curve::of_points(&new.points())
                    .map_err(|source| StyleError::Curve { key: self.key.clone(), source })?;
                true
            }
            (Slot::Choice(c), Value::Text(new)) => c.choose(new),
            // What stands without quotes on the command line is read as a switch.
            (Slot::Choice(c), Value::Bool(false)) => c.choose("off"),
            _ => false,
        };
        if done {
            Ok(())
        } else {
            Err(StyleError::WrongType { key: self.key.clone(), expected: self.domain(), found: new.kind() })
        }
    }
}

fn out_of_range(key: &str, found: f64, [min, max]: [f32; 2]) -> StyleError {
    StyleError::OutOfRange { key: key.to_owned(), found, min, max }
}

/// Replaces the path of every image of a list.
pub fn map_paths(params: &mut [Param<'_>], map: impl Fn(&Path) -> PathBuf) {
    for param in params {
        if let Slot::File(Some(path)) = &mut param.slot {
            *path = map(path);
        }
    }
}

/// A key of earlier versions, or with a value `key=value`, and what it is called now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Renamed {
    /// As it was given.
    pub former: String,
    /// As it is now.
    pub now: String,
}

impl std::fmt::Display for Renamed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "`{}` is now called `{}`; the old name was read as the new one", self.former, self.now)
    }
}

/// Sets one parameter of a list by its key, or by that of an earlier version, and says so then; also where the value is that of an
/// earlier version. What inherits from it follows in the next list that is made.
///
/// # Errors
/// [`StyleError::UnknownKey`], or what [`Param::set`] says.
pub fn set(params: &mut [Param<'_>], key: &str, value: &Value) -> Result<Option<Renamed>, StyleError> {
    let place = params
        .iter()
        .position(|p| p.key == key)
        .or_else(|| params.iter().position(|p| p.former.as_deref() == Some(key)));
    let Some(param) = place.and_then(|place| params.get_mut(place)) else {
        return Err(StyleError::UnknownKey {
            key: key.to_owned(),
            nearest: nearest(key, params.iter().map(|p| p.key.as_str())),
        });
    };
    let renamed = match (param.former_value, value) {
        (Some((former, now)), Value::Text(given)) if given == former => {
            param.set(&Value::from(now))?;
            return Ok(Some(Renamed {
                former: format!("{key}={former}"),
                now: format!("{}={now}", param.key),
            }));
        }
        _ => (param.key != key).then(|| Renamed { former: key.to_owned(), now: param.key.clone() }),
    };
    param.set(value).map(|()| renamed)
}

/// Leaves only the parameters that matter with the choices as they are.
pub fn retain_relevant(params: &mut Vec<Param<'_>>) {
    let is_asked = |p: &&Param<'_>| matches!(p.slot, Slot::Choice(_) | Slot::Bool(_) | Slot::Integer { .. });
    let values: Vec<(String, String)> =
        params.iter().filter(is_asked).map(|p| (p.key.clone(), p.value().to_string())).collect();
    let holds =
        |c: &Condition| values.iter().any(|(key, value)| key == c.key && c.values.contains(&value.as_str()));
    params.retain(|p| p.conditions.iter().all(holds));
}
