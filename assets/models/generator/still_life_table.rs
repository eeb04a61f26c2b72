//! The table: four planks with rounded edges on two battens.

use std::f64::consts::FRAC_PI_8;

use glam::{DVec3, dvec2};

use crate::glb::Node;
use crate::outline::Outline;
use crate::plate::Plate;
use crate::solid::{Axis, Solid};
use crate::still_life::{Finish, SUNK, Studio};
use crate::wood;

/// Length and width of a plank, and its thickness.
const PLANK: [f64; 3] = [610.0, 97.0, 20.0];
/// Between two planks.
const GAP: f64 = 1.4;
/// The radius of the planks' edges.
const ROUND: f64 = 2.4;
/// Planks.
const COUNT: usize = 4;
/// Where each plank was cut: an offset in the image of the wood, in parts of it.
const CUTS: [[f64; 2]; COUNT] = [[0.0, 0.42], [0.37, 0.18], [0.7, 0.91], [0.12, 0.66]];

/// The table.
pub(crate) fn node(studio: &mut Studio) -> Node {
    let [_, width, thickness] = PLANK;
    let mut children = Vec::new();
    for (i, cut) in CUTS.into_iter().enumerate() {
        let solid = sawn(board(PLANK[0], width, thickness), [0, 2], cut);
        let z = (width + GAP) * (i as f64 - (COUNT - 1) as f64 / 2.0);
        let finish = if i % 2 == 0 { Finish::Wood } else { Finish::DarkWood };
        let plank = studio.node(&format!("plank.{}", i + 1), finish, solid);
        children.push(plank.at(0.0, -thickness * 0.5, z));
    }
    let across = (width + GAP) * COUNT as f64 - 60.0;
    for (i, x) in [-210.0, 210.0].into_iter().enumerate() {
        let solid = sawn(board(46.0, across, 16.0), [2, 0], [0.2, 0.5]);
        let batten = studio.node(&format!("batten.{}", i + 1), Finish::DarkWood, solid);
        children.push(batten.at(x, -thickness - 8.0 + SUNK, 0.0));
    }
    Node::new("table", None).with(children)
}

/// A board about the origin, lying flat: its extents along x, z and y.
fn board(x: f64, z: f64, y: f64) -> Solid {
    // The axis along Y turns the outline's x to z and its y to x.
    let (u, v, half) = (z * 0.5, x * 0.5, y * 0.5);
    let outline: Outline = vec![dvec2(-u, -v), dvec2(u, -v), dvec2(u, v), dvec2(-u, v)];
    let quarter = |i: u32| {
        let angle = FRAC_PI_8 * f64::from(i);
        (ROUND * (1.0 - angle.cos()), ROUND * (1.0 - angle.sin()))
    };
    let upper = (0..=4).map(|i| (quarter(i).0, half - quarter(i).1));
    let lower = (0..=4).rev().map(|i| (quarter(i).0, quarter(i).1 - half));
    Plate { outline, rim: lower.chain(upper).collect(), ..Plate::default() }.solid().along(Axis::Y)
}

/// Lays the image of the wood over a board, folded down at its edges; `axes` run along and across the grain.
fn sawn(board: Solid, axes: [usize; 2], cut: [f64; 2]) -> Solid {
    let mut half = DVec3::ZERO;
    for p in board.triangles.iter().flatten() {
        half = half.max(p.abs());
    }
    board.mapped(|p, normal| {
        let folded = |axis: usize| {
            let aside = normal[axis].abs() > 0.71;
            if aside { p[axis].signum() * (half[axis] + half.y - p.y) } else { p[axis] }
        };
        let size = wood::CANVAS.size;
        dvec2(cut[0] + folded(axes[0]) / size.x, cut[1] + folded(axes[1]) / size.y)
    })
}
