//! Colors as people write them.

use std::fmt;
use std::str::FromStr;
use std::sync::LazyLock;

use glam::{Vec3, Vec4};

/// An opaque sRGB color, 8 bits per channel, written `#rrggbb`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Color(pub [u8; 3]);

impl Color {
    /// `#000000`
    pub const BLACK: Self = Self([0; 3]);
    /// `#ffffff`
    pub const WHITE: Self = Self([255; 3]);

    /// Between this color (share 0) and another one (share 1), in even steps as displayed.
    #[must_use]
    pub fn mixed(self, other: Self, share: f32) -> Self {
        let mix = |(a, b): (u8, u8)| {
            (f32::from(a) + (f32::from(b) - f32::from(a)) * share.clamp(0.0, 1.0)).round() as u8
        };
        let ([r, g, b], [r2, g2, b2]) = (self.0, other.0);
        Self([(r, r2), (g, g2), (b, b2)].map(mix))
    }

    /// Linear RGB, 0 to 1 (IEC 61966-2-1).
    pub fn to_linear(self) -> Vec3 {
        Vec3::from_array(self.0.map(linear_from_srgb))
    }
}

/// One channel as light, 0 to 1 (IEC 61966-2-1).
pub fn linear_from_srgb(byte: u8) -> f32 {
    // Thousands of objects with a dozen colors each are converted for every frame.
    static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
        std::array::from_fn(|byte| {
            let c = byte as f32 / 255.0;
            if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        })
    });
    LINEAR[usize::from(byte)]
}

/// The nearest byte for a channel's light; what is beyond 0 to 1 becomes its end.
pub fn srgb_from_linear(linear: f32) -> u8 {
    let c = linear.clamp(0.0, 1.0);
    let c = if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    (c * 255.0).round() as u8
}

/// The nearest bytes for a linear color and its opacity, which has no curve.
pub fn rgba_from_linear(color: Vec4) -> [u8; 4] {
    let [r, g, b] = color.truncate().to_array().map(srgb_from_linear);
    [r, g, b, (color.w.clamp(0.0, 1.0) * 255.0).round() as u8]
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

impl FromStr for Color {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let wrong = || format!("`{s}` is no color; write it as #rrggbb");
        let digits = s.strip_prefix('#').ok_or_else(wrong)?;
        if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(wrong());
        }
        let value = u32::from_str_radix(digits, 16).map_err(|_not_hex| wrong())?;
        match digits.len() {
            6 => Ok(Self([(value >> 16) as u8, (value >> 8) as u8, value as u8])),
            3 => Ok(Self([8, 4, 0].map(|shift| ((value >> shift & 15) * 17) as u8))),
            _ => Err(wrong()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_become_light_and_bytes_again() {
        assert!((0..=255).all(|byte| srgb_from_linear(linear_from_srgb(byte)) == byte));
        assert_eq!([-1.0, 2.0, f32::NAN].map(srgb_from_linear), [0, 255, 0]);
    }

    #[test]
    fn colors_are_read_and_written() {
        assert_eq!("#0a80ff".parse(), Ok(Color([10, 128, 255])));
        assert_eq!("#f80".parse(), Ok(Color([255, 136, 0])));
        assert_eq!(Color([10, 128, 255]).to_string(), "#0a80ff");
        for wrong in ["", "red", "#12345", "#xyzxyz", "#+12345"] {
            assert!(wrong.parse::<Color>().is_err(), "{wrong}");
        }
    }
}
