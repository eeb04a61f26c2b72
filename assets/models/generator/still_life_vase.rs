//! The vase: a turned body with a lip, hollow, with a band of petals and beads in relief.

use glam::{DVec2, dvec2};

use crate::curve::{profile, turned};
use crate::glb::{Image, Node};
use crate::picture::{Canvas, paint, rgb, smoothstep, tile};
use crate::still_life::{Finish, Studio};

/// Height of the vase.
const HEIGHT: f64 = 165.0;
/// Petals around it.
const PETALS: usize = 12;
/// What the image covers: one petal, as wide as at the belly, from the foot to the lip.
const CANVAS: Canvas = Canvas { texels: [192, 1024], size: dvec2(27.0, HEIGHT) };
/// The lower and the upper border of the band.
const BAND: [f64; 2] = [44.0, 98.0];

/// The vase.
pub(crate) fn node(studio: &mut Studio) -> Node {
    let outside = profile(
        &[
            (33.0, 0.0),
            (34.5, 3.0),
            (34.0, 8.0),
            (37.0, 20.0),
            (46.5, 44.0),
            (51.5, 68.0),
            (48.5, 94.0),
            (36.0, 118.0),
            (26.5, 138.0),
            (27.0, 152.0),
            (34.0, 162.5),
            (36.0, 164.8),
        ],
        4,
    );
    let inside = profile(
        &[
            (35.2, 165.0),
            (33.5, 163.8),
            (31.0, 161.0),
            (24.2, 150.0),
            (23.6, 138.0),
            (33.0, 117.0),
            (44.5, 94.0),
            (47.0, 68.0),
            (42.0, 44.0),
            (30.0, 16.0),
            (18.0, 9.0),
            (0.0, 8.0),
        ],
        3,
    );
    let mut body = vec![dvec2(0.0, 0.0), dvec2(18.0, 0.0)];
    body.extend(outside.iter().copied());
    let last_outside = body.len();
    body.extend(inside.iter().copied());
    // Inside and underneath is plain glaze: there the image goes on beyond its borders.
    let v = |i: usize| match i {
        i if i < 2 => 1.0 + 0.02 * (2 - i) as f64,
        i if i < last_outside => 1.0 - body[i].y / HEIGHT,
        i => -0.06 * (i + 1 - last_outside) as f64 / (body.len() - last_outside) as f64,
    };
    let solid = turned(&body, 72, PETALS as f64, v);
    studio.node("vase", Finish::Vase, solid)
}

/// The colors: pale glaze, a blue band, petals left pale.
pub(crate) fn color() -> Image {
    let (glaze, blue, line) = (paint(0xec_e6d6), paint(0x5b_7f92), paint(0x3b_5a70));
    let picture = CANVAS.paint(|p| {
        let edge = |height: f64| smoothstep(-0.15, 0.15, p.y - height);
        let mut color = glaze.lerp(blue, edge(BAND[0]) - edge(BAND[1]));
        color = color.lerp(glaze, smoothstep(-0.12, 0.12, raised(p)));
        // Rings of the brush at the foot and under the lip.
        for height in [14.0, 150.0] {
            color = color.lerp(line, smoothstep(1.3, 1.0, (p.y - height).abs()));
        }
        rgb(color)
    });
    tile("glaze", &picture)
}

/// The normal map.
pub(crate) fn relief() -> Image {
    tile("ornament", &CANVAS.relief(height))
}

/// The height of the relief in millimeters.
fn height(p: DVec2) -> f64 {
    let pillow = smoothstep(-0.2, 2.6, raised(p));
    let groove = smoothstep(0.9, 0.3, (petal(p) - 2.6).abs()) * smoothstep(0.0, 2.0, petal(p));
    1.5 * pillow - 0.5 * groove
}

/// How deep a place lies inside of what is raised; negative beside it.
fn raised(p: DVec2) -> f64 {
    let ring = |height: f64| 1.3 - (p.y - height).abs();
    petal(p).max(bud(p)).max(beads(p)).max(ring(BAND[0] + 8.5)).max(ring(BAND[1] - 8.5))
}

/// A place in the tile, seen from the middle of the petal's foot.
fn in_tile(p: DVec2) -> DVec2 {
    dvec2(p.x.rem_euclid(CANVAS.size.x) - CANVAS.size.x * 0.5, p.y - BAND[0] - 11.5)
}

/// The petal: where two circles overlap.
fn petal(p: DVec2) -> f64 {
    let q = in_tile(p);
    pointed(dvec2(q.x.abs(), q.y - 15.5), 9.2, 15.5)
}

/// The bud between two petals.
fn bud(p: DVec2) -> f64 {
    let q = in_tile(p);
    let x = CANVAS.size.x * 0.5 - q.x.abs();
    pointed(dvec2(x, q.y - 21.5), 3.6, 9.5)
}

/// How deep a point with x ≥ 0 lies in the pointed oval with these half extents.
fn pointed(p: DVec2, half_width: f64, half_height: f64) -> f64 {
    let radius = (half_height * half_height + half_width * half_width) / (2.0 * half_width);
    radius - p.distance(dvec2(half_width - radius, 0.0))
}

/// Two rows of beads at the band's borders, four to a petal.
fn beads(p: DVec2) -> f64 {
    let pitch = CANVAS.size.x / 4.0;
    let x = p.x.rem_euclid(pitch) - pitch * 0.5;
    let bead = |height: f64| 2.4 - dvec2(x, p.y - height).length();
    bead(BAND[0] + 3.6).max(bead(BAND[1] - 3.6))
}
