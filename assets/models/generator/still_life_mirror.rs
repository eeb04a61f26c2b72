//! The standing mirror: a pane in a profiled frame that leans back on two feet and a strut.

use glam::{DQuat, DVec2, DVec3, dvec2, dvec3};

use crate::curve::{half_circle, profile, turned_plain};
use crate::glb::Node;
use crate::outline::{Outline, inset};
use crate::solid::Solid;
use crate::still_life::{Finish, SUNK, Studio};

/// Outer size of the frame.
const SIZE: DVec2 = dvec2(232.0, 292.0);
/// The pane's height in the frame.
const PANE: f64 = 6.0;
/// How far the mirror leans back, in radians.
const LEAN: f64 = 0.105;
/// The radius of its feet.
const FOOT: f64 = 8.0;

/// The mirror, standing at `at` and facing the direction that is `turned` from +Z to +X, in radians.
pub(crate) fn node(studio: &mut Studio, at: DVec3, turned: f64) -> Node {
    // Upright the frame's back is at z = 0 and its lower edge at y = 0.
    let outer = rectangle(SIZE);
    let lean = DQuat::from_rotation_x(-LEAN);
    let foot = dvec3(SIZE.x * 0.36, -1.0, 8.0);
    let rise = FOOT - SUNK - (lean * foot).y;
    let on_table = |z: f64| (-rise - SUNK + z * -LEAN.sin()) / LEAN.cos();
    let mut children = vec![
        studio.node("glass", Finish::Glass, pane(&inset(&outer, 20.0))),
        studio.node("frame", Finish::Gilt, frame(&outer)),
        studio.node("back", Finish::Bark, slab(&inset(&outer, 6.0), -1.5, 4.0)),
        studio.node("strut", Finish::Bark, strut(dvec2(200.0, -1.0), dvec2(on_table(-84.0), -84.0))),
    ];
    for (name, side) in [("foot.1", -1.0), ("foot.2", 1.0)] {
        let ball = studio.node(name, Finish::Gilt, turned_plain(&half_circle(FOOT, 12), 24));
        children.push(ball.at(side * foot.x, foot.y, foot.z));
    }
    let turn = DQuat::from_rotation_y(turned) * lean;
    Node::new("mirror", None).at(at.x, at.y + rise, at.z).turned(turn).with(children)
}

/// A rectangle that stands on the x axis.
fn rectangle(size: DVec2) -> Outline {
    let x = size.x * 0.5;
    vec![dvec2(-x, 0.0), dvec2(x, 0.0), dvec2(x, size.y), dvec2(-x, size.y)]
}

fn lifted(outline: &Outline, z: f64) -> Vec<DVec3> {
    outline.iter().map(|p| p.extend(z)).collect()
}

/// The pane: one quadrilateral, exactly plane.
fn pane(outline: &Outline) -> Solid {
    let mut out = Solid::default();
    if let [a, b, c, d] = lifted(outline, PANE)[..] {
        out.quad(a, b, c, d);
    }
    out
}

/// A molding, led around the outline with mitered corners: from its outer edge a round and a hollow, a step, a bead.
fn frame(outline: &Outline) -> Solid {
    let molding =
        profile(&[(0.0, 12.0), (1.2, 15.4), (4.4, 16.8), (8.0, 14.6), (11.6, 10.8), (17.0, 9.4)], 3);
    let bead = profile(&[(17.0, 11.2), (18.0, 13.0), (20.0, 13.6), (22.0, 12.8), (23.0, 10.8)], 2);
    let back = [dvec2(23.0, 0.0), dvec2(0.0, 0.0)];
    let section = molding.into_iter().chain(bead).chain(back);
    let rings: Vec<Vec<DVec3>> = section.map(|p| lifted(&inset(outline, p.x), p.y)).collect();
    let mut out = Solid::default();
    for (i, ring) in rings.iter().enumerate() {
        out.band(ring, &rings[(i + 1) % rings.len()]);
    }
    out
}

/// A board with the given outline, from one height to another.
fn slab(outline: &Outline, from: f64, to: f64) -> Solid {
    let mut out = Solid::default();
    if let ([a, b, c, d], [e, f, g, h]) = (&lifted(outline, from)[..], &lifted(outline, to)[..]) {
        out.band(&[*a, *b, *c, *d], &[*e, *f, *g, *h]);
        out.quad(*d, *c, *b, *a);
        out.quad(*e, *f, *g, *h);
    }
    out
}

/// The strut between two points (y, z).
fn strut(top: DVec2, foot: DVec2) -> Solid {
    let along = foot - top;
    let turn = DQuat::from_rotation_arc(DVec3::Y, dvec3(0.0, along.x, along.y).normalize());
    let outline = rectangle(dvec2(34.0, along.length()));
    slab(&outline, -2.5, 2.5).bent(|p| turn * p + dvec3(0.0, top.x, top.y))
}
