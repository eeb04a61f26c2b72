//! Units of length.

/// A unit that coordinates may be in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Its name.
    pub name: &'static str,
    /// What stands behind a number.
    pub symbol: &'static str,
    /// How long it is.
    pub metres: f64,
}

/// Those that a person can choose.
pub const UNITS: [Unit; 6] = [
    Unit { name: "Millimetre", symbol: "mm", metres: 0.001 },
    Unit { name: "Centimetre", symbol: "cm", metres: 0.01 },
    Unit { name: "Metre", symbol: "m", metres: 1.0 },
    Unit { name: "Kilometre", symbol: "km", metres: 1000.0 },
    Unit { name: "Inch", symbol: "in", metres: 0.0254 },
    Unit { name: "Foot", symbol: "ft", metres: 0.3048 },
];

impl Unit {
    /// The unit of so many metres, if it has a name.
    pub fn of(metres: f64) -> Option<Self> {
        UNITS.into_iter().find(|unit| (unit.metres - metres).abs() < 1e-9 * metres)
    }
}

impl std::str::FromStr for Unit {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        UNITS.into_iter().find(|unit| unit.symbol == s).ok_or_else(|| {
            format!("`{s}` is no unit; use one of {}", UNITS.map(|unit| unit.symbol).join(", "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_known_by_length_and_symbol() {
        assert_eq!(Unit::of(0.0254).map(|unit| unit.symbol), Some("in"));
        assert_eq!(Unit::of(0.5), None);
        assert_eq!("km".parse::<Unit>().map(|unit| unit.metres), Ok(1000.0));
        assert!("parsec".parse::<Unit>().unwrap_err().contains("mm, cm, m, km, in, ft"));
    }
}
