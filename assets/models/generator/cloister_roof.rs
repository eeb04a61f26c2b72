//! The lean-to roofs over the walks, which slope towards the court, with ridges of round tiles. In metres.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, dvec2};

use crate::cloister::{BAY, Builder, Finish, OUTER};
use crate::cloister_masonry::{cover, frame, points, united};
use crate::glb::Node;
use crate::solid::Solid;

/// Where the roof starts, from the court's middle, and how high.
const LOW: [f64; 2] = [9.48, 4.97];
/// Where it ends in the outer walls.
const HIGH: f64 = OUTER + 0.1;
/// Metres of height per metre.
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
