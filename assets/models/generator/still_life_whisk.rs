//! The whisk: a turned handle and four nested loops of wire.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec2, DVec3, dvec3};

use crate::curve::{profile, through, turned_plain, wire};
use crate::glb::Node;
use crate::solid::Solid;
use crate::still_life::{Finish, SUNK, Studio};

/// Loops, and the radius of their wire.
const LOOPS: usize = 4;
const WIRE: f64 = 1.0;
/// Half of the outermost loop: along the axis from the handle's end, away from the axis.
const LOOP: [(f64, f64); 7] =
    [(104.0, 5.2), (118.0, 5.4), (142.0, 12.0), (176.0, 23.0), (212.0, 29.0), (242.0, 21.0), (256.0, 7.0)];
/// The thickest places of the handle and of the balloon: along the axis, away from it.
const RESTS: [(f64, f64); 2] = [(14.0, 10.5), (212.0, 29.0 + WIRE)];

/// The whisk, lying: its handle ends above `at`, from where it points `towards`.
pub(crate) fn node(studio: &mut Studio, at: DVec3, towards: DVec3) -> Node {
    let mut children = vec![
        studio.node("handle", Finish::Lacquer, handle()),
        studio.node("ferrule", Finish::Steel, ferrule()),
    ];
    for i in 0..LOOPS {
        let solid = wire(&path(i), |_| WIRE);
        children.push(studio.node(&format!("wire.{}", i + 1), Finish::Steel, solid));
    }
    // The body lies on the line that touches its two thickest places from below.
    let [near, far] = RESTS;
    let rise = ((far.1 - near.1) / (far.0 - near.0)).asin();
    let height = near.1 * rise.cos() - near.0 * rise.sin() - SUNK;
    let yaw = DQuat::from_rotation_arc(DVec3::X, towards.normalize());
    let turn = yaw * DQuat::from_rotation_z(rise);
    Node::new("whisk", None).at(at.x, at.y + height, at.z).turned(turn).with(children)
}

/// A profile of radii and places along the axis, turned about X.
fn turned_about_x(points: &[DVec2]) -> Solid {
    turned_plain(points, 32).bent(|p| dvec3(p.y, -p.x, p.z))
}

fn handle() -> Solid {
    turned_about_x(&profile(
        &[
            (0.0, 0.0),
            (5.5, 1.2),
            (9.4, 6.0),
            (10.5, 14.0),
            (9.2, 26.0),
            (7.6, 42.0),
            (8.6, 64.0),
            (9.6, 80.0),
            (8.2, 93.0),
            (7.2, 98.0),
            (0.0, 98.5),
        ],
        4,
    ))
}

fn ferrule() -> Solid {
    let mut points = vec![(0.0, 94.0)];
    points.extend([(8.4, 94.0), (8.8, 95.0), (8.8, 108.0), (8.2, 109.6), (7.2, 110.2), (0.0, 110.2)]);
    turned_about_x(&points.into_iter().map(DVec2::from).collect::<Vec<_>>())
}

/// The way of a loop's wire; the first loop stands upright, each next one ends further in.
fn path(i: usize) -> Vec<DVec3> {
    let turn = DQuat::from_rotation_x(FRAC_PI_2 + PI * i as f64 / LOOPS as f64);
    let depth = 2.3 * WIRE * i as f64;
    let side = |&(x, r): &(f64, f64), sign: f64| {
        let share = (x - 104.0) / (256.0 - 104.0);
        dvec3(x - depth * share, 0.0, r * sign)
    };
    let there = LOOP.iter().map(|p| side(p, 1.0));
    let tip = dvec3(258.5 - depth, 0.0, 0.0);
    let back = LOOP.iter().rev().map(|p| side(p, -1.0));
    let points: Vec<DVec3> = there.chain([tip]).chain(back).map(|p| turn * p).collect();
    through(&points, 4)
}
