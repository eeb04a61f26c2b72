//! Images painted by functions of place, and their PNGs.

use glam::{DVec2, DVec3, dvec2, dvec3};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ImageEncoder, PixelWithColorType, Rgb, RgbImage};

use crate::glb::Image;

/// The size of an image and of the surface that it covers.
#[derive(Clone, Copy)]
pub(crate) struct Canvas {
    /// Texels across and down.
    pub(crate) texels: [u32; 2],
    /// Width and height of the surface, in millimeters.
    pub(crate) size: DVec2,
}

impl Canvas {
    /// The middle of a texel, in millimeters from the lower left.
    pub(crate) fn place(&self, column: u32, row: u32) -> DVec2 {
        let [width, height] = self.texels.map(f64::from);
        let part = dvec2((f64::from(column) + 0.5) / width, 1.0 - (f64::from(row) + 0.5) / height);
        part * self.size
    }

    /// The width and height of a texel in millimeters.
    pub(crate) fn texel(&self) -> DVec2 {
        self.size / dvec2(f64::from(self.texels[0]), f64::from(self.texels[1]))
    }

    /// An image whose colors are given per place; see [`Canvas::place`].
    pub(crate) fn paint(&self, color: impl Fn(DVec2) -> Rgb<u8>) -> RgbImage {
        RgbImage::from_fn(self.texels[0], self.texels[1], |x, y| color(self.place(x, y)))
    }

    /// The tangent-space normal map of a relief, given its height in millimeters per place.
    pub(crate) fn relief(&self, height: impl Fn(DVec2) -> f64) -> RgbImage {
        let step = self.texel();
        self.paint(|p| {
            let slope = |d: DVec2| (height(p + d) - height(p - d)) / (2.0 * d.length());
            let normal = dvec3(-slope(dvec2(step.x, 0.0)), -slope(dvec2(0.0, step.y)), 1.0).normalize();
            Rgb((normal * 127.5 + DVec3::splat(127.5)).round().to_array().map(|v| v as u8))
        })
    }
}

/// A color as written in paint programs: `0xRRGGBB`, sRGB.
pub(crate) fn paint(srgb: u32) -> DVec3 {
    let [_, r, g, b] = srgb.to_be_bytes();
    dvec3(r.into(), g.into(), b.into())
}

/// The color nearest to one between those that [`paint`] gives.
pub(crate) fn rgb(color: DVec3) -> Rgb<u8> {
    Rgb(color.round().to_array().map(|v| v as u8))
}

/// 0 below `from`, 1 above `to`, smooth between.
pub(crate) fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// An image ready for the file, which repeats beyond its borders.
pub(crate) fn tile(name: &'static str, picture: &RgbImage) -> Image {
    Image { tiles: true, ..encoded(name, picture) }
}

/// An image ready for the file.
pub(crate) fn encoded<P: PixelWithColorType<Subpixel = u8>>(
    name: &'static str,
    picture: &image::ImageBuffer<P, Vec<u8>>,
) -> Image {
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(picture, picture.width(), picture.height(), P::COLOR_TYPE)
        .expect("memory takes any image");
    Image { name, png, tiles: false }
}
