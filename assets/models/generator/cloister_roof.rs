//! The lean-to roofs over the walks, which slope towards the court, with ridges of round tiles. In meters.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec3, dvec2, dvec3};

use crate::cloister::{BAY, Builder, Finish, OUTER};
use crate::cloister_masonry::{cover, frame, points, united};
use crate::glb::Node;
use crate::solid::Solid;

/// Where the roof starts, from the court's middle, and how high.
const LOW: [f64; 2] = [9.48, 4.97];
/// Where it ends in the outer walls.
const HIGH: f64 = OUTER + 0.1;
/// Meters of height per meter.
const SLOPE: f64 = 0.33;
/// The roof's thickness at the eaves.
const THICK: f64 = 0.12;
/// Tiles per bay.
const PER_BAY: usize = 4;

/// The roof's upper side.
fn height(out: f64) -> f64 {
    LOW[1] + THICK + SLOPE * (out - LOW[0])
}

/// The roof over all four walks, and the ridges of tiles on each.
pub(crate) fn roofs(builder: &mut Builder) -> Vec<Node> {
    let [near, low] = LOW;
    let section =
        points(&[(near, low), (HIGH, height(HIGH) - 0.26), (HIGH, height(HIGH)), (near, height(near))]);
    let mut parts = vec![builder.part("roof", Finish::Tiles, frame(&section))];
    let tiles = builder.mesh("tiles", Finish::Tiles, tiles());
    parts.extend((0..4).map(|i| {
        let turn = DQuat::from_rotation_y(f64::from(i) * FRAC_PI_2);
        Node::new(format!("tiles.{}", i + 1), Some(tiles)).turned(turn)
    }));
    let valley = builder.mesh("valley", Finish::Tiles, valley());
    parts.extend((0..4).map(|i| {
        let turn = DQuat::from_rotation_y(f64::from(i) * FRAC_PI_2);
        Node::new(format!("valley.{}", i + 1), Some(valley)).turned(turn)
    }));
    parts
}

/// The ridges of one side; those beyond the court start where the next side's roof rises through this one.
fn tiles() -> Solid {
    let n = (OUTER / BAY * PER_BAY as f64) as usize;
    let ridge = |i: usize| {
        let x = (i as f64 + 0.5 - n as f64) * BAY / PER_BAY as f64;
        let [from, to] = [(LOW[0] - 0.04).max(x.abs() - 0.35), HIGH - 0.02];
        cover(x, dvec2(from, height(from)), dvec2(to, height(to)), 0.15, [0.1, 0.22])
    };
    united((0..2 * n).map(ridge))
}

/// The broad tiles in the valley between two sides, which hide where their ridges end.
fn valley() -> Solid {
    const WIDE: f64 = 0.3;
    // Higher than the ridges.
    let (over, under) = (0.1, -0.05);
    let ring = |out: f64| {
        let place = |x: f64, z: f64, over: f64| dvec3(out + x, height(out + x.max(z)) + over, out + z);
        let row = |over| [place(WIDE, 0.0, over), place(0.0, 0.0, over), place(0.0, WIDE, over)];
        (row(under), row(over))
    };
    let mut solid = Solid::default();
    let (near, far) = (ring(LOW[0] - 0.05), ring(OUTER + 0.02));
    let around = |([a, b, c], [d, e, f]): ([DVec3; 3], [DVec3; 3])| [a, b, c, f, e, d];
    solid.band(&around(far), &around(near));
    for (low, high) in [near, ([far.0[2], far.0[1], far.0[0]], [far.1[2], far.1[1], far.1[0]])] {
        solid.quad(low[0], low[1], high[1], high[0]);
        solid.quad(low[1], low[2], high[2], high[1]);
    }
    solid
}
