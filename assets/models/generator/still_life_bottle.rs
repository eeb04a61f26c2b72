//! The bottle of ink with its cork and its label.

use glam::{DVec2, dvec2, dvec3};

use crate::curve::{profile, turned_plain};
use crate::glb::{Image, Node};
use crate::lettering::{Ink, Nib};
use crate::picture::{Canvas, encoded, paint, rgb};
use crate::solid::{Corner, Solid};
use crate::still_life::{Finish, Studio};

/// The radius of the bottle's body.
const RADIUS: f64 = 37.0;
/// The lower and the upper edge of the label.
const LABEL: [f64; 2] = [30.0, 108.0];
/// The direction to the middle of the label, from +Z to +X, in radians.
const FACING: f64 = 0.4;
/// How much of the body's circumference the label covers, in radians.
const COVERED: f64 = 3.3;
/// What the image of the label covers.
const CANVAS: Canvas = Canvas { texels: [1024, 640], size: dvec2(RADIUS * COVERED, LABEL[1] - LABEL[0]) };

/// The bottle.
pub(crate) fn node(studio: &mut Studio) -> Node {
    let mut body = vec![dvec2(0.0, 0.0), dvec2(20.0, 0.0), dvec2(33.0, 0.0)];
    let corner = [(33.0, 0.0), (35.8, 1.2), (RADIUS, 4.0), (RADIUS, 30.0)];
    body.extend(profile(&corner, 3).into_iter().skip(1));
    body.extend([70.0, 112.0, 124.0].map(|y| dvec2(RADIUS, y)));
    let shoulder =
        [(RADIUS, 124.0), (34.4, 139.0), (24.0, 153.0), (15.6, 168.0), (13.4, 184.0), (13.2, 206.0)];
    body.extend(profile(&shoulder, 5).into_iter().skip(1));
    let lip = [
        (15.4, 206.6),
        (16.6, 208.6),
        (16.6, 214.0),
        (15.2, 216.4),
        (11.6, 216.8),
        (10.2, 215.6),
        (10.0, 196.0),
    ];
    body.extend(lip.map(DVec2::from));
    body.push(dvec2(0.0, 196.0));
    let cork =
        [(0.0, 198.0), (9.6, 198.0), (10.3, 214.0), (11.0, 226.0), (10.4, 227.6), (9.0, 228.2), (0.0, 228.2)];
    Node::new("bottle", None).with(vec![
        studio.node("body", Finish::Bottle, turned_plain(&body, 64)),
        studio.node("label", Finish::Label, label()),
        studio.node("cork", Finish::Cork, turned_plain(&cork.map(DVec2::from), 32)),
    ])
}

/// The paper around the body: a sheet that clears the facets of the glass.
fn label() -> Solid {
    let pieces = 40;
    let row = |y: f64, v: f64| -> Vec<Corner> {
        let corner = |i: i32| {
            let part = f64::from(i) / f64::from(pieces);
            let angle = FACING + COVERED * (part - 0.5);
            let radius = RADIUS + 0.35;
            (dvec3(radius * angle.sin(), y, radius * angle.cos()), dvec2(part, v))
        };
        (0..=pieces).map(corner).collect()
    };
    let mut out = Solid::default();
    out.sheet(&[row(LABEL[0], 1.0), row(LABEL[1], 0.0)]);
    out
}

/// The printed label.
pub(crate) fn label_image() -> Image {
    let middle = CANVAS.size * 0.5;
    let (mut black, mut red) = (Ink::on(CANVAS), Ink::on(CANVAS));
    let broad = Nib { widths: [2.7, 1.0], angle: 0.5 };
    black.write("HACHURE", middle + dvec2(0.0, 2.5), 13.0, 2.6, broad);
    red.write("DRAWING INK", middle + dvec2(0.0, -13.0), 5.4, 1.4, Nib::round(0.95));
    black.write("FOR LINES OF ANY WIDTH", middle + dvec2(0.0, -22.5), 3.2, 0.9, Nib::round(0.55));
    black.write("NO. 7", middle + dvec2(-21.0, 21.0), 4.6, 1.1, Nib::round(0.75));
    black.write("50 CL", middle + dvec2(21.0, 21.0), 4.6, 1.1, Nib::round(0.75));
    hatched_ball(&mut black, middle + dvec2(0.0, 21.5), 8.0);
    for (margin, width) in [(3.0, 1.1), (5.2, 0.45)] {
        let (low, high) = (DVec2::splat(margin), CANVAS.size - DVec2::splat(margin));
        let corners = [low, dvec2(high.x, low.y), high, dvec2(low.x, high.y), low];
        red.line(&corners, Nib::round(width));
    }
    let (paper, ink, rubric) = (paint(0xf1_e8d2), paint(0x2b_2a33), paint(0xa8_4336));
    let picture = image::RgbImage::from_fn(CANVAS.texels[0], CANVAS.texels[1], |x, y| {
        rgb(paper.lerp(rubric, red.at(x, y)).lerp(ink, black.at(x, y)))
    });
    encoded("label", &picture)
}

/// The emblem: a ball that is nothing but hachures, denser and longer where it is dark.
fn hatched_ball(ink: &mut Ink, center: DVec2, radius: f64) {
    let rim: Vec<DVec2> = (0..=48)
        .map(|i| center + radius * DVec2::from_angle(std::f64::consts::TAU * f64::from(i) / 48.0))
        .collect();
    ink.line(&rim, Nib::round(0.6));
    for i in 1..14 {
        let offset = radius * (f64::from(i) / 7.0 - 1.0);
        let half = (radius * radius - offset * offset).sqrt();
        let light = -0.35 * half + 0.55 * offset;
        let turn = DVec2::from_angle(-0.7);
        let at = |along: f64| center + turn.rotate(dvec2(along, offset));
        if light < half {
            ink.line(&[at(light.max(-half)), at(half)], Nib::round(0.5));
        }
    }
}
