//! Units of length.

/// A unit that coordinates may be in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Its name.
    pub name: &'static str,
    /// What stands behind a number.
    pub symbol: &'static str,
    /// How long it is.
    pub meters: f64,
}

/// Those that a person can choose.
pub const UNITS: [Unit; 6] = [
    Unit { name: "Millimeter", symbol: "mm", meters: 0.001 },
    Unit { name: "Centimeter", symbol: "cm", meters: 0.01 },
    Unit { name: "Meter", symbol: "m", meters: 1.0 },
    Unit { name: "Kilometer", symbol: "km", meters: 1000.0 },
    Unit { name: "Inch", symbol: "in", meters: 0.0254 },
    Unit { name: "Foot", symbol: "ft", meters: 0.3048 },
];

impl Unit {
    /// The unit of so many meters, if it has a name.
    pub fn of(meters: f64) -> Option<Self> {
        UNITS.into_iter().find(|unit| (unit.meters - meters).abs() < 1e-9 * meters)
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
        assert_eq!("km".parse::<Unit>().map(|unit| unit.meters), Ok(1000.0));
        assert!("parsec".parse::<Unit>().unwrap_err().contains("mm, cm, m, km, in, ft"));
    }
}
