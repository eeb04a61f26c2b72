//! The court: paved paths that cross at the well, lawns in kerbs, cypresses; and the ground that all stands on. In
//! meters.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec2};

use crate::cloister::{Builder, DEEP, FLOOR, Finish, OUTER};
use crate::cloister_masonry::{frame, points};
use crate::curve::{profile, turned_plain};
use crate::glb::Node;
use crate::outline::{Outline, arc, inset};
use crate::plate::{Hole, Plate};
use crate::solid::Axis;
use crate::temple_masonry::{SUNK, block};

/// Half the width of the paths.
const PATH: f64 = 1.15;
/// The pavement around the well.
const ROUND: f64 = 3.6;
/// The lawns' outer side.
const EDGE: f64 = 8.4;
/// The kerbs' width.
const KERB: f64 = 0.16;

/// Everything level, and what grows on it.
pub(crate) fn grounds(builder: &mut Builder) -> Vec<Node> {
    let ground = block([-17.4, 17.4], [-0.5, -0.06], [-25.0, 17.4]);
    let floor = points(&[
        (9.56, -1.1 * DEEP),
        (OUTER + 0.3, -1.1 * DEEP),
        (OUTER + 0.3, FLOOR),
        (9.54, FLOOR),
        (9.52, FLOOR - 0.02),
        (9.52, FLOOR - 0.06),
        (9.56, FLOOR - 0.08),
    ]);
    let roots = vec![
        builder.part("ground", Finish::Earth, ground),
        builder.part("floor", Finish::Paving, frame(&floor)),
    ];
    let mut parts =
        vec![builder.part("pavement", Finish::Paving, block([-9.7, 9.7], [-0.45, 0.0], [-9.7, 9.7]))];
    let lawn = lawn();
    let kerb = Plate {
        outline: lawn.clone(),
        rim: vec![(0.0, -DEEP), (0.0, 0.1), (0.03, 0.13)],
        holes: vec![Hole { outline: inset(&lawn, KERB), chamfer: 0.0 }],
        ..Plate::default()
    };
    let grass = Plate {
        outline: inset(&lawn, KERB - SUNK),
        rim: vec![(0.0, -DEEP / 2.0), (0.0, 0.08)],
        ..Plate::default()
    };
    let kerb = builder.mesh("kerb", Finish::Pale, kerb.solid().along(Axis::Y));
    let grass = builder.mesh("grass", Finish::Lawn, grass.solid().along(Axis::Y));
    let trunk = builder.mesh(
        "trunk",
        Finish::Wood,
        turned_plain(&points(&[(0.0, -0.1), (0.1, -0.1), (0.07, 0.6), (0.0, 0.6)]), 16),
    );
    let crown = builder.mesh("crown", Finish::Cypress, turned_plain(&crown(), 24));
    for i in 0..4 {
        let cypress = Node::new("cypress", None)
            .with(vec![Node::new("trunk", Some(trunk)), Node::new("crown", Some(crown))]);
        let garden = vec![
            Node::new("kerb", Some(kerb)),
            Node::new("grass", Some(grass)),
            Builder::placed(cypress, 6.6, 0.0, 6.6),
        ];
        let turn = DQuat::from_rotation_y(f64::from(i) * FRAC_PI_2);
        parts.push(Node::new(format!("garden.{}", i + 1), None).with(garden).turned(turn));
    }
    roots.into_iter().chain([Node::new("court", None).with(parts)]).collect()
}

/// A lawn's outline by z and x: a square that makes room for the well.
fn lawn() -> Outline {
    let end = (PATH / ROUND).asin();
    let mut outline = arc(DVec2::ZERO, ROUND, FRAC_PI_2 - end, end, 14);
    outline.extend(points(&[(EDGE, PATH), (EDGE, EDGE), (PATH, EDGE)]));
    outline
}

/// A slender cypress.
fn crown() -> Vec<DVec2> {
    let mut out = points(&[(0.0, 0.36)]);
    out.extend(profile(
        &[(0.17, 0.34), (0.34, 0.5), (0.43, 0.95), (0.41, 1.8), (0.29, 2.9), (0.14, 3.75), (0.03, 4.2)],
        2,
    ));
    out.extend(points(&[(0.0, 4.24)]));
    out
}
