//! Pictures as numbers.

use glam::{DVec4, dvec4};
use image::RgbaImage;

use super::SIDE;
use super::common::to_linear;

fn curve(c: f64) -> f64 {
    let c = c.clamp(0.0, 1.0);
    255.0 * if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

/// A color as pictures hold it, in 255ths that are not rounded: straight opacity, sRGB.
pub fn encoded(c: DVec4) -> DVec4 {
    let a = c.w.max(1e-6);
    dvec4(curve(c.x / a), curve(c.y / a), curve(c.z / a), 255.0 * c.w)
}

/// The same, but colors stay multiplied by their opacity.
pub fn encoded_share(c: DVec4) -> DVec4 {
    dvec4(curve(c.x), curve(c.y), curve(c.z), 255.0 * c.w)
}

/// What is seen of `behind` beneath a color.
pub fn over(front: DVec4, behind: DVec4) -> DVec4 {
    front + behind * (1.0 - front.w)
}

/// A picture drawn on nothing.
pub struct Picture {
    /// Premultiplied linear light.
    pub colors: Vec<DVec4>,
}

impl From<RgbaImage> for Picture {
    fn from(image: RgbaImage) -> Self {
        Self { colors: image.pixels().map(|p| to_linear(*p)).collect() }
    }
}

/// A picture of such colors on gray paper, to look at.
pub fn shown(colors: impl Iterator<Item = DVec4>) -> RgbaImage {
    let paper = dvec4(0.6, 0.6, 0.6, 1.0);
    let bytes = colors.flat_map(|c| encoded(over(c, paper)).to_array().map(|c| c.round() as u8)).collect();
    RgbaImage::from_raw(SIDE, SIDE, bytes).unwrap_or_default()
}
