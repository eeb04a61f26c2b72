//! The branches in the vase: bare stems below, leaves to either side above.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3, dvec2, dvec3};

use crate::curve::{through, wire};
use crate::glb::Node;
use crate::noise::Chance;
use crate::solid::{Corner, Solid};
use crate::still_life::{Finish, Studio};

/// A branch: the direction in which it leans (turns from +X to −Z), how far it reaches out, how high, its pairs of
/// leaves.
const BRANCHES: [(f64, f64, f64, usize); 6] = [
    (0.02, 116.0, 268.0, 2),
    (0.20, 74.0, 330.0, 2),
    (0.40, 112.0, 300.0, 2),
    (0.57, 104.0, 246.0, 2),
    (0.74, 84.0, 285.0, 2),
    (0.88, 112.0, 222.0, 2),
];
/// Rows of the mesh of a leaf, and columns on either side of its middle.
const ROWS: usize = 8;
const COLUMNS: i32 = 2;

/// The branches, as they stand in a vase at the origin.
pub(crate) fn node(studio: &mut Studio) -> Node {
    let mut chance = Chance::new(7);
    let mut children = Vec::new();
    let mut leaves = Vec::new();
    for (i, &(direction, reach, height, pairs)) in BRANCHES.iter().enumerate() {
        let out = DQuat::from_rotation_y(direction * TAU) * DVec3::X;
        let path = through(
            &[
                out * 9.0 + DVec3::Y * 14.0,
                out * 13.0 + DVec3::Y * 100.0,
                out * 16.5 + DVec3::Y * 162.0,
                out * (16.5 + reach * 0.38) + DVec3::Y * (162.0 + (height - 162.0) * 0.55),
                out * reach + DVec3::Y * height,
            ],
            8,
        );
        let solid = wire(&path, |t| 2.1 - 1.2 * t);
        children.push(studio.node(&format!("stem.{}", i + 1), Finish::Stem, solid));
        let tip = path.len() - 1;
        leaves.push((path[tip - 1], (path[tip] - path[tip - 1]).normalize(), 0.0, 1.0));
        for pair in 0..pairs {
            for side in [-1.0, 1.0] {
                // From the mouth of the vase to just below the tip, never two at one height.
                let along = (pair as f64 + 0.25 + side * 0.16) / pairs as f64;
                let at = (tip as f64 * (0.6 + 0.36 * along)).round() as usize;
                let forward = (path[at] - path[at - 1]).normalize();
                leaves.push((path[at], forward, side, 1.0 - 0.14 * along));
            }
        }
    }
    for (i, (at, forward, side, size)) in leaves.into_iter().enumerate() {
        let length = size * chance.between(76.0, 96.0);
        let (droop, fold) = (chance.between(0.5, 1.0), chance.between(0.13, 0.23));
        let turn = attitude(forward, side, &mut chance);
        let leaf = studio.node_creased(
            &format!("leaf.{:02}", i + 1),
            Finish::Leaf,
            blade(length, droop, fold),
            80.0,
        );
        children.push(leaf.at(at.x, at.y, at.z).turned(turn));
    }
    Node::new("plant", None).with(children)
}

/// How a leaf stands on its stem, which points `forward`: to the left (−1), to the right (1) or straight on (0).
fn attitude(forward: DVec3, side: f64, chance: &mut Chance) -> DQuat {
    let yaw = forward.x.atan2(forward.z) + side * chance.between(0.9, 1.3);
    let pitch = if side == 0.0 { forward.y.asin() * 0.8 } else { chance.between(0.45, 0.8) };
    let roll = chance.between(-0.25, 0.25) - side * 0.3;
    DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(-pitch) * DQuat::from_rotation_z(roll)
}

/// A leaf from the origin along +Z, its upper side up: `droop` radians are bent down between foot and tip, the halves
/// folded up by `fold` radians.
fn blade(length: f64, droop: f64, fold: f64) -> Solid {
    let step = length / ROWS as f64;
    let mut spine = DVec3::ZERO;
    let mut rows: Vec<Vec<Corner>> = Vec::new();
    for i in 0..=ROWS {
        let t = i as f64 / ROWS as f64;
        let bend = DQuat::from_rotation_x(droop * t * t);
        let corner = |k: i32| {
            let x = f64::from(k) / f64::from(COLUMNS) * 0.5;
            // The image is half as wide as high.
            let aside = dvec3(-x * 0.5 * length * fold.cos(), x.abs() * 0.5 * length * fold.sin(), 0.0);
            (spine + bend * aside, dvec2(0.5 + x, 1.0 - t))
        };
        rows.push((-COLUMNS..=COLUMNS).map(corner).collect());
        spine += DQuat::from_rotation_x(droop * (t + 0.5 / ROWS as f64).powi(2)) * DVec3::Z * step;
    }
    let mut out = Solid::default();
    out.sheet(&rows);
    out
}
