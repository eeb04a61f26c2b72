//! The entrance: two leaning towers with the gate between them, masts and obelisks before them. In meters.

use glam::{DVec2, dvec3};

use crate::curve::turned_plain;
use crate::glb::Node;
use crate::solid::Solid;
use crate::temple::{Finish, Mason};
use crate::temple_masonry::{SUNK, Wall, crowned};

/// Towers, gate and masts.
pub(crate) fn pylon(mason: &mut Mason) -> Node {
    let tower = |x| crowned(x, [-SUNK, 13.4], [25.0, 30.0], 0.08, 1.3);
    let gate = Wall::along_x([-3.2, 3.2], [-1.5 * SUNK, 7.4], [26.4, 28.6]).door(0.0, 3.2, 5.2).solid();
    let crown = crowned([-3.19, 3.19], [7.3, 8.5], [26.41, 28.59], 0.0, 1.1);
    let mast = mason.mesh("mast", Finish::Cedar, turned_plain(&mast_profile(), 20));
    let mut parts = vec![
        mason.part("tower.1", Finish::Sandstone, tower([-15.6, -2.0])),
        mason.part("tower.2", Finish::Sandstone, tower([2.0, 15.6])),
        mason.part("gate", Finish::Pale, gate),
        mason.part("cornice", Finish::Pale, crown),
    ];
    parts.extend(
        [-11.2, -6.0, 6.0, 11.2]
            .into_iter()
            .enumerate()
            .map(|(i, x)| Mason::placed(Node::new(format!("mast.{}", i + 1), Some(mast)), x, 0.0, 30.6)),
    );
    Node::new("pylon", None).with(parts)
}

/// A pole on a stone foot's height of thicker wood.
fn mast_profile() -> Vec<DVec2> {
    [(0.0, -SUNK), (0.3, -SUNK), (0.3, 0.6), (0.2, 0.75), (0.11, 15.6), (0.05, 15.9), (0.0, 15.9)]
        .map(DVec2::from)
        .to_vec()
}

/// The obelisks before the pylon.
pub(crate) fn forecourt(mason: &mut Mason) -> Node {
    let foot =
        mason.mesh("pedestal", Finish::Sandstone, crowned([-1.0, 1.0], [-SUNK, 0.9], [-1.0, 1.0], 0.04, 0.3));
    let needle = mason.mesh("needle", Finish::RedGranite, needle());
    let obelisk = |(name, x): (&str, f64)| {
        let parts = vec![Node::new("pedestal", Some(foot)), Node::new("needle", Some(needle))];
        Mason::placed(Node::new(name, None).with(parts), x, 0.0, 33.6)
    };
    Node::new("forecourt", None).with([("obelisk.1", -4.4), ("obelisk.2", 4.4)].map(obelisk).to_vec())
}

/// The shaft of an obelisk with its pyramidion, on a pedestal 0.9 m high.
fn needle() -> Solid {
    let ring = |half: f64, y: f64| {
        [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)].map(|(x, z)| dvec3(x * half, y, z * half))
    };
    let (foot, shoulder, top) = (ring(0.66, 0.9 - SUNK), ring(0.44, 10.2), dvec3(0.0, 11.3, 0.0));
    let mut solid = Solid::default();
    solid.band(&foot, &shoulder);
    for i in 0..4 {
        solid.triangle(shoulder[i], shoulder[(i + 1) % 4], top);
    }
    let [a, b, c, d] = foot;
    solid.quad(d, c, b, a);
    solid
}
