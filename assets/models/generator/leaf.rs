//! The image of a leaf: its shape in the alpha, its veins in the color.

use glam::{DVec2, dvec2};
use image::{Rgba, RgbaImage};

use crate::glb::Image;
use crate::picture::{Canvas, encoded, paint, rgb, smoothstep};

/// What the image covers: a leaf twice as long as wide, its stalk at the middle of the lower border, its tip above.
const CANVAS: Canvas = Canvas { texels: [256, 512], size: dvec2(0.5, 1.0) };
/// The length of the stalk.
const STALK: f64 = 0.13;
/// Side veins per unit of length.
const VEINS: f64 = 9.0;

/// The image, for a sheet that is cut out at half its alpha.
pub(crate) fn image() -> Image {
    let picture = RgbaImage::from_fn(CANVAS.texels[0], CANVAS.texels[1], |x, y| {
        let p = CANVAS.place(x, y) - dvec2(CANVAS.size.x * 0.5, 0.0);
        // A slope of eight texels lets a filter find the outline between them.
        let alpha = (0.5 + inside(p) / (8.0 * CANVAS.texel().x)).clamp(0.0, 1.0);
        let [r, g, b] = color(p).0;
        Rgba([r, g, b, (alpha * 255.0).round() as u8])
    });
    encoded("leaf", &picture)
}

/// Roughly the distance to the outline, positive inside.
fn inside(p: DVec2) -> f64 {
    half_width(p.y) - p.x.abs()
}

/// Half the leaf's width at a height: a stalk, a round base, a drawn-out tip.
fn half_width(y: f64) -> f64 {
    let stalk = if y < STALK + 0.05 { 0.011 } else { -1.0 };
    let t = (y - STALK) / (0.985 - STALK);
    if !(0.0..=1.0).contains(&t) {
        return if t < 0.0 { stalk } else { 0.985 - y };
    }
    stalk.max(0.236 * (std::f64::consts::PI * t.powf(0.72)).sin().max(0.0).powf(0.85))
}

/// The color: two halves in unlike light, a dark rim, pale veins.
fn color(p: DVec2) -> image::Rgb<u8> {
    let (deep, fresh, pale) = (paint(0x3f_6b45), paint(0x6f_9a58), paint(0xc3_d39a));
    let across = (p.x.abs() / half_width(p.y).max(0.02)).min(1.0);
    let half = if p.x < 0.0 { 0.3 } else { 0.0 };
    let blade = deep.lerp(fresh, 0.35 + half + 0.25 * (p.y - 0.5) - 0.3 * smoothstep(0.7, 1.0, across));
    let middle = smoothstep(0.012, 0.006, p.x.abs() + 0.004 * p.y);
    // A side vein leaves the middle upwards and bends towards the tip.
    let along = (p.y - 0.62 * p.x.abs() - 1.1 * p.x * p.x) * VEINS;
    let off = (along - along.round()).abs() / VEINS;
    let side = smoothstep(0.0075, 0.003, off + 0.004 * across) * smoothstep(1.0, 0.8, across);
    rgb(blade.lerp(pale, middle.max(0.75 * side)))
}
