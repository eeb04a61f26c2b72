//! Sawn wood: growth rings that a saw has cut along the trunk, a knot, fibres. Repeats in both directions.

use glam::{DVec2, dvec2};

use crate::glb::Image;
use crate::noise::tiled;
use crate::picture::{Canvas, paint, rgb, smoothstep, tile};

/// What the image covers; the grain runs along x.
pub(crate) const CANVAS: Canvas = Canvas { texels: [1024, 512], size: dvec2(640.0, 320.0) };
/// Rings that the image crosses from bottom to top.
const RINGS: f64 = 32.0;
/// Where the knot is.
const KNOT: DVec2 = dvec2(452.0, 118.0);
/// Shades of the base color; few, as if painted.
const SHADES: f64 = 24.0;

/// The colors.
pub(crate) fn color() -> Image {
    let (light, dark) = (paint(0xdd_b98a), paint(0x96_6238));
    let picture = CANVAS.paint(|p| {
        let large = tiled(5, CANVAS.size, dvec2(200.0, 30.0), p);
        let tone = 0.1 + 0.75 * late_wood(p) + 0.1 * fibre(p) + 0.1 * large + 0.35 * knot(p, 0.7);
        let shade = (tone.clamp(0.0, 1.0) * SHADES).round() / SHADES;
        rgb(light.lerp(dark, shade))
    });
    tile("wood", &picture)
}

/// The normal map: hard late wood stands out, as on a brushed board.
pub(crate) fn relief() -> Image {
    tile("wood grain", &CANVAS.relief(|p| 0.26 * late_wood(p) + 0.06 * fibre(p)))
}

/// How dark the ring is at a place: grows slowly through the year and ends at once, 0 to 1.
fn late_wood(p: DVec2) -> f64 {
    let size = CANVAS.size;
    let trunk = 2.9 * tiled(1, size, dvec2(213.0, 64.0), p) + 0.5 * tiled(2, size, dvec2(80.0, 20.0), p);
    let ring = (p.y / size.y * RINGS + trunk + 3.0 * knot(p, 1.6)).rem_euclid(1.0);
    ring.powi(3) * (1.0 - smoothstep(0.88, 1.0, ring))
}

/// Streaks along the grain, −1 to 1.
fn fibre(p: DVec2) -> f64 {
    tiled(3, CANVAS.size, dvec2(40.0, 2.0), p)
}

/// 1 in the middle of the knot, falling off over about `reach` of its size.
fn knot(p: DVec2, reach: f64) -> f64 {
    let d = (p - KNOT) / (dvec2(17.0, 7.5) * reach);
    (-d.length_squared()).exp()
}
