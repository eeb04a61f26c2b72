//! Columns: a round base, a shaft like a papyrus stem, an open or a closed capital, an abacus. In meters.

use glam::{DVec2, dvec2};

use crate::curve::{profile, turned_plain};
use crate::glb::Node;
use crate::temple::{Finish, Mason};
use crate::temple_masonry::{SUNK, block};

/// Sides of a shaft: enough that none of its edges is sharp enough to be drawn.
const SEGMENTS: usize = 26;

/// What the capital shows.
#[derive(Clone, Copy)]
pub(crate) enum Capital {
    /// The open umbel of a papyrus.
    Open,
    /// A closed bud.
    Bud,
}

/// Columns of one kind, which share their meshes.
pub(crate) struct Order {
    parts: [(&'static str, usize); 4],
}

impl Order {
    /// Columns of a height from the floor to the top of the abacus; `radius` is the shaft's largest.
    pub(crate) fn new(mason: &mut Mason, capital: Capital, height: f64, radius: f64) -> Self {
        let base = 0.45 * radius;
        let abacus = height - 0.75 * radius;
        let spring = abacus - 2.3 * radius;
        let half = match capital {
            Capital::Open => 0.8 * radius,
            Capital::Bud => 0.78 * radius,
        };
        let mut round = |name, finish, profile: &[DVec2]| {
            (name, mason.mesh(name, finish, turned_plain(profile, SEGMENTS)))
        };
        Self {
            parts: [
                round("base", Finish::Sandstone, &base_profile(radius, base)),
                round("shaft", Finish::Pale, &shaft_profile(radius, base - SUNK, spring)),
                round("capital", Finish::Painted, &capital_profile(capital, radius, spring - SUNK, abacus)),
                (
                    "abacus",
                    mason.mesh(
                        "abacus",
                        Finish::Sandstone,
                        block([-half, half], [abacus - SUNK, height], [-half, half]),
                    ),
                ),
            ],
        }
    }

    /// A column.
    pub(crate) fn column(&self, number: usize, x: f64, z: f64) -> Node {
        let parts = self.parts.iter().map(|&(name, mesh)| Node::new(name, Some(mesh))).collect();
        Mason::placed(Node::new(format!("column.{number:02}"), None).with(parts), x, 0.0, z)
    }

    /// Columns at places of x and z, numbered from `first`.
    pub(crate) fn columns(&self, first: usize, places: &[[f64; 2]]) -> Vec<Node> {
        places.iter().enumerate().map(|(i, &[x, z])| self.column(first + i, x, z)).collect()
    }
}

/// A disc with a beveled rim.
fn base_profile(radius: f64, top: f64) -> Vec<DVec2> {
    let (wide, bevel) = (1.28 * radius, 0.12 * radius);
    vec![
        dvec2(0.0, -SUNK),
        dvec2(wide, -SUNK),
        dvec2(wide, top - bevel),
        dvec2(wide - bevel, top),
        dvec2(0.0, top),
    ]
}

/// Drawn in at the foot like a stem that rises from its leaves, then tapering.
fn shaft_profile(radius: f64, low: f64, high: f64) -> Vec<DVec2> {
    let at = |r: f64, along: f64| (r * radius, low + along * (high - low));
    let mut out = vec![dvec2(0.0, low)];
    out.extend(profile(&[at(0.86, 0.0), at(0.97, 0.06), at(1.0, 0.14)], 2));
    out.extend([at(0.86, 1.0), at(0.0, 1.0)].map(DVec2::from));
    out
}

/// A band around the neck, then the umbel or the bud.
fn capital_profile(capital: Capital, radius: f64, low: f64, high: f64) -> Vec<DVec2> {
    let at = |(r, along): (f64, f64)| (r * radius, low + along * (high - low));
    let mut out = vec![dvec2(0.0, low)];
    let band = [(0.95, 0.0), (0.95, 0.11), (0.87, 0.11)].map(at);
    out.extend(band.map(DVec2::from));
    let bell: &[(f64, f64)] = match capital {
        Capital::Open => &[(0.88, 0.13), (0.93, 0.4), (1.1, 0.66), (1.42, 0.87), (1.62, 0.95)],
        Capital::Bud => &[(0.94, 0.14), (1.2, 0.24), (1.22, 0.38), (1.06, 0.68), (0.88, 0.96)],
    };
    let bell: Vec<_> = bell.iter().copied().map(at).collect();
    out.extend(profile(&bell, 3));
    let rim: &[(f64, f64)] = match capital {
        Capital::Open => &[(1.62, 0.985), (1.5, 1.0)],
        Capital::Bud => &[(0.86, 1.0)],
    };
    out.extend(rim.iter().map(|&point| DVec2::from(at(point))));
    out.push(dvec2(0.0, high));
    out
}
