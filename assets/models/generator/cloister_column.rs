//! Twin columns under one abacus: a plinth, the two rolls of an Attic base, a swelling shaft, a basket capital that
//! turns from round to square. In meters.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, dvec3};

use crate::cloister::{ARCADE, Builder, Finish, IMPOST, PARAPET};
use crate::cloister_masonry::{plan, points, united, upright};
use crate::curve::turned_plain;
use crate::glb::Node;
use crate::solid::Solid;
use crate::temple_masonry::{SUNK, block};

/// Sides of a column: enough that none of its edges is sharp enough to be drawn.
const SEGMENTS: usize = 18;
/// The same of a capital, with corners for the square.
const CORNERED: usize = 16;
/// How far each of the two stands from their middle.
const APART: f64 = 0.175;
/// The shaft's largest radius.
const RADIUS: f64 = 0.105;
/// Where the shaft starts.
const FOOT: f64 = PARAPET + 0.2;
/// Where the capital starts.
const NECK: f64 = IMPOST - 0.56;
/// Where the abacus starts.
const ABACUS: f64 = IMPOST - 0.22;

/// The meshes of a pair of columns, which all pairs share.
pub(crate) struct Pair {
    parts: [(&'static str, usize); 3],
    abacus: usize,
}

impl Pair {
    /// Cuts the stones.
    pub(crate) fn new(builder: &mut Builder) -> Self {
        let abacus = upright(
            &plan([-0.29, 0.29], [ARCADE - 0.38, ARCADE + 0.38]),
            &[
                (0.1, ABACUS - SUNK),
                (0.1, ABACUS + 0.03),
                (0.07, ABACUS + 0.08),
                (0.03, ABACUS + 0.11),
                (0.0, ABACUS + 0.12),
                (0.0, IMPOST),
            ],
        );
        Self {
            parts: [
                ("base", builder.mesh("base", Finish::Stone, base())),
                ("shaft", builder.mesh("shaft", Finish::Marble, shaft())),
                ("capital", builder.creased("capital", Finish::Stone, capital(), 40.0)),
            ],
            abacus: builder.mesh("abacus", Finish::Stone, abacus),
        }
    }

    /// One of the two.
    pub(crate) fn column(&self, name: impl Into<String>, x: f64, z: f64) -> Node {
        let parts = self.parts.map(|(name, mesh)| Node::new(name, Some(mesh))).to_vec();
        Builder::placed(Node::new(name, None).with(parts), x, 0.0, z)
    }

    /// A pair across the arcade.
    pub(crate) fn pair(&self, number: usize, x: f64) -> Node {
        let parts = vec![
            self.column("column.1", 0.0, ARCADE - APART),
            self.column("column.2", 0.0, ARCADE + APART),
            Node::new("abacus", Some(self.abacus)),
        ];
        Builder::placed(Node::new(format!("columns.{number}"), None).with(parts), x, 0.0, 0.0)
    }
}

/// A roll: its profile about the height of its middle, bulging to `radius`.
fn roll(radius: f64, middle: f64, half: f64) -> Vec<(f64, f64)> {
    const PIECES: usize = 3;
    let at = |i: usize| {
        let (sin, cos) = (PI * i as f64 / PIECES as f64).sin_cos();
        (radius - half + half * sin, middle - half * cos)
    };
    (0..=PIECES).map(at).collect()
}

/// Plinth, lower roll, hollow, upper roll.
fn base() -> Solid {
    let plinth = PARAPET + 0.06;
    let mut turned = vec![(0.0, plinth - SUNK), (0.13, plinth - SUNK)];
    turned.extend(roll(0.165, plinth + 0.035, 0.035));
    turned.extend([(0.123, plinth + 0.078), (0.116, plinth + 0.095)]);
    turned.extend(roll(0.136, plinth + 0.124, 0.022));
    turned.push((0.0, plinth + 0.146));
    let half = 0.168;
    united([
        block([-half, half], [PARAPET - SUNK, plinth], [-half, half]),
        turned_plain(&points(&turned), SEGMENTS),
    ])
}

/// The shaft with its slight swelling and the ring below the capital.
fn shaft() -> Solid {
    let at = |r: f64, along: f64| (r * RADIUS, FOOT + along * (NECK - FOOT));
    let low = FOOT - SUNK;
    let mut turned = vec![(0.0, low), (RADIUS, low)];
    turned.extend([at(1.0, 0.35), at(0.95, 0.7), at(0.86, 1.0)]);
    turned.extend(roll(1.06 * RADIUS, NECK + 0.02, 0.018));
    turned.push((0.0, NECK + 0.038));
    turned_plain(&points(&turned), SEGMENTS)
}

/// Round below, square above.
fn capital() -> Solid {
    // Half width, the superellipse's power (2 = round), height.
    let sections = [
        (0.090, 2.0, 0.0),
        (0.091, 2.0, 0.07),
        (0.099, 2.2, 0.14),
        (0.116, 2.7, 0.21),
        (0.142, 3.6, 0.27),
        (0.164, 5.0, 0.305),
        (0.166, 6.0, 0.34),
    ];
    let ring = |&(half, power, height): &(f64, f64, f64)| -> Vec<DVec3> {
        (0..CORNERED)
            .map(|i| {
                let (sin, cos) = (TAU * i as f64 / CORNERED as f64).sin_cos();
                let reach = (cos.abs().powf(power) + sin.abs().powf(power)).powf(-1.0 / power);
                dvec3(half * reach * cos, NECK + 0.025 + height, -half * reach * sin)
            })
            .collect()
    };
    let rings: Vec<_> = sections.iter().map(ring).collect();
    let mut solid = Solid::default();
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    let (low, high) = (&rings[0], &rings[rings.len() - 1]);
    let middle = |ring: &[DVec3]| dvec3(0.0, ring[0].y, 0.0);
    for i in 0..CORNERED {
        let j = (i + 1) % CORNERED;
        solid.triangle(low[j], low[i], middle(low));
        solid.triangle(high[i], high[j], middle(high));
    }
    solid
}
