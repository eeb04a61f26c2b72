//! Where the value of a parameter is kept: a field that is borrowed, with a value of its own or an inherited one.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use super::{Color, Curve, Matrix};

/// The borrowed value of a parameter.
pub enum Slot<'a> {
    /// A switch.
    Bool(StyleField<'a, bool>),
    /// A number.
    Number {
        /// The value.
        value: StyleField<'a, f32>,
        /// What a slider offers.
        soft: RangeInclusive<f32>,
        /// What is accepted at all.
        hard: RangeInclusive<f32>,
    },
    /// A whole number.
    Integer {
        /// The value.
        value: &'a mut u32,
        /// What a slider offers, and what is accepted at all.
        range: RangeInclusive<u32>,
    },
    /// A color.
    Color(StyleField<'a, Color>),
    /// An image file, or none.
    File(&'a mut Option<PathBuf>),
    /// A 2×2 matrix.
    Matrix {
        /// The value.
        value: &'a mut Matrix,
        /// What each number may be at most, and with the other sign at least; sliders offer a quarter of it.
        most: f32,
    },
    /// A curve.
    Curve(&'a mut Curve),
    /// One of a few names.
    Choice(&'a mut dyn Choice),
}

impl Slot<'_> {
    /// The parameter whose value it takes while it has none of its own.
    pub fn inherits(&self) -> Option<&str> {
        match self {
            Self::Bool(place) => place.source(),
            Self::Number { value, .. } => value.source(),
            Self::Color(place) => place.source(),
            Self::Integer { .. } | Self::File(_) | Self::Matrix { .. } | Self::Curve(_) | Self::Choice(_) => {
                None
            }
        }
    }

    /// Whether the value is not its own at present.
    pub fn is_inherited(&self) -> bool {
        match self {
            Self::Bool(place) => place.is_inherited(),
            Self::Number { value, .. } => value.is_inherited(),
            Self::Color(place) => place.is_inherited(),
            Self::Integer { .. } | Self::File(_) | Self::Matrix { .. } | Self::Curve(_) | Self::Choice(_) => {
                false
            }
        }
    }

    /// Moves a number into the range that is accepted; what is no number becomes the least, in a matrix 0.
    pub(super) fn clamp(&mut self) {
        let within = |n: f32, range: &RangeInclusive<f32>| {
            if n.is_nan() { *range.start() } else { n.clamp(*range.start(), *range.end()) }
        };
        match self {
            Self::Number { value, hard, .. } => value.map(|n| within(n, hard)),
            Self::Integer { value, range } => **value = (**value).clamp(*range.start(), *range.end()),
            Self::Matrix { value, most } => **value = value.scaled(1.0, *most),
            Self::Bool(_) | Self::Color(_) | Self::File(_) | Self::Curve(_) | Self::Choice(_) => {}
        }
    }

    /// Drops the value of its own; `false` if it inherits from nothing.
    pub(super) fn inherit(&mut self) -> bool {
        match self {
            Self::Bool(place) => place.inherit(),
            Self::Number { value, .. } => value.inherit(),
            Self::Color(place) => place.inherit(),
            Self::Integer { .. } | Self::File(_) | Self::Matrix { .. } | Self::Curve(_) | Self::Choice(_) => {
                false
            }
        }
    }
}

/// A field of a style.
pub enum StyleField<'a, T> {
    /// It always has a value.
    Own(&'a mut T),
    /// It takes the value of another parameter until it has one of its own.
    Inheriting {
        /// The field.
        own: &'a mut Option<T>,
        /// What the other parameter has now.
        inherited: T,
        /// Key of the other parameter.
        from: String,
    },
}

impl<'a, T> From<&'a mut T> for StyleField<'a, T> {
    fn from(value: &'a mut T) -> Self {
        Self::Own(value)
    }
}

impl<T: Copy> StyleField<'_, T> {
    /// The value that holds.
    pub fn get(&self) -> T {
        match self {
            Self::Own(value) => **value,
            Self::Inheriting { own, inherited, .. } => own.unwrap_or(*inherited),
        }
    }

    /// Gives it a value of its own.
    pub fn set(&mut self, new: T) {
        match self {
            Self::Own(value) => **value = new,
            Self::Inheriting { own, .. } => **own = Some(new),
        }
    }

    /// Changes the value of its own, if it has one.
    fn map(&mut self, change: impl FnOnce(T) -> T) {
        match self {
            Self::Own(value) => **value = change(**value),
            Self::Inheriting { own, .. } => **own = own.map(change),
        }
    }

    fn source(&self) -> Option<&str> {
        match self {
            Self::Own(_) => None,
            Self::Inheriting { from, .. } => Some(from),
        }
    }

    fn is_inherited(&self) -> bool {
        matches!(self, Self::Inheriting { own: None, .. })
    }

    fn inherit(&mut self) -> bool {
        match self {
            Self::Own(_) => false,
            Self::Inheriting { own, .. } => {
                **own = None;
                true
            }
        }
    }
}

/// Declares an enumeration whose variants have names in snake case: a [`Choice`].
macro_rules! choice {
    ($($item:tt)*) => {
        #[derive(
            Debug,
            Clone,
            Copy,
            PartialEq,
            Eq,
            Hash,
            Default,
            strum::EnumIter,
            strum::EnumString,
            strum::IntoStaticStr,
            strum::VariantNames,
        )]
        #[strum(serialize_all = "snake_case")]
        $($item)*
    };
}
pub(crate) use choice;

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
