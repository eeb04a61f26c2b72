//! The hypostyle hall: a high nave between lower aisles, lit by the grilles of its clerestory. In meters.

use glam::dvec2;

use crate::glb::Node;
use crate::solid::Solid;
use crate::temple::{Finish, Mason};
use crate::temple_columns::{Capital, Order};
use crate::temple_masonry::{SUNK, Wall, block, crowned, sunk, sweep, wall_section};

/// The columns' lines across the hall.
const BAYS: [f64; 4] = [1.9, -1.1, -4.1, -7.1];
/// The hall's inner length.
const INSIDE: [f64; 2] = [-9.0, 4.4];
/// The nave's columns, from the temple's axis.
const NAVE: f64 = 4.8;
/// Those that carry the clerestory.
const AISLE: f64 = 7.4;
/// Those along the walls.
const OUTER: f64 = 10.0;

/// Walls, columns, architraves, clerestory and roofs.
pub(crate) fn hall(mason: &mut Mason) -> Node {
    let mut parts = walls(mason);
    parts.extend(columns(mason));
    parts.extend(beams(mason));
    parts.extend(clerestory(mason));
    let (roof, length) = ([6.77, 7.3], sunk(INSIDE, 2.0));
    let nave = crowned([-7.9, 7.9], [9.38, 10.3], [-10.0, 5.4], 0.0, 0.85);
    parts.extend([
        mason.part("roof.1", Finish::Roof, block([-12.0 - SUNK, -7.53], roof, length)),
        mason.part("roof.2", Finish::Roof, block([7.53, 12.0 + SUNK], roof, length)),
        mason.part("roof.3", Finish::Roof, nave),
    ]);
    Node::new("hall", None).with(parts)
}

/// A door frame with its cornice around a doorway in a wall across the temple.
pub(crate) fn portal(mason: &mut Mason, name: &str, half: f64, door: [f64; 2], z: [f64; 2]) -> Node {
    let [width, top] = door;
    let lintel = top + half - width / 2.0;
    let frame = Wall::along_x([-half, half], [-SUNK / 2.0, lintel], z).door(0.0, width, top);
    let within = [0.01 - half, half - 0.01];
    let crown = crowned(within, [lintel - 0.1, lintel + 0.7], [z[0] + 0.01, z[1] - 0.01], 0.0, 0.7);
    Node::new(name, None).with(vec![
        mason.part("frame", Finish::Pale, frame.solid()),
        mason.part("cornice", Finish::Pale, crown),
    ])
}

/// The outer walls and the two walls across.
fn walls(mason: &mut Mason) -> Vec<Node> {
    let across =
        |z, door: [f64; 2]| Wall::along_x([-13.4, 13.4], [-SUNK, 7.8], z).door(0.0, door[0], door[1]).solid();
    let crown =
        |[from, to]: [f64; 2]| crowned([-13.39, 13.39], [7.7, 8.6], [from + 0.01, to - 0.01], 0.0, 0.8);
    let side = |x: f64, from: f64, to: f64| {
        sweep(&wall_section(1.0, [-1.5 * SUNK, 7.65], 0.3, 0.7), &[dvec2(x, from), dvec2(x, to)])
    };
    let (front, rear) = ([4.4, 5.6], [-10.2, -9.0]);
    vec![
        mason.part("wall.1", Finish::Sandstone, side(-12.0, -9.5, 4.9)),
        mason.part("wall.2", Finish::Sandstone, side(12.0, 4.9, -9.5)),
        mason.part("wall.3", Finish::Sandstone, across(front, [2.8, 5.6])),
        mason.part("wall.4", Finish::Sandstone, across(rear, [2.4, 4.1])),
        mason.part("cornice.1", Finish::Pale, crown(front)),
        mason.part("cornice.2", Finish::Pale, crown(rear)),
        portal(mason, "portal", 2.0, [2.6, 5.5], [4.2, 5.8]),
    ]
}

/// Tall open papyri in the nave, buds in the aisles.
fn columns(mason: &mut Mason) -> Vec<Node> {
    let row = |x: f64| BAYS.map(|z| [x, z]);
    let mut columns =
        Order::new(mason, Capital::Open, 8.6, 0.76).columns(1, &[-NAVE, NAVE].map(row).concat());
    let aisles = [-OUTER, -AISLE, AISLE, OUTER].map(row).concat();
    columns.extend(Order::new(mason, Capital::Bud, 6.0, 0.58).columns(columns.len() + 1, &aisles));
    columns
}

/// The architraves, one upon each row of columns.
fn beams(mason: &mut Mason) -> Vec<Node> {
    let aisle = sunk(INSIDE, 1.0);
    let nave = [-9.4 - SUNK, 4.6 + SUNK];
    let rows = [
        (-OUTER, 0.42, 6.0, aisle),
        (-AISLE, 0.45, 6.0, aisle),
        (-NAVE, 0.6, 8.59, nave),
        (NAVE, 0.6, 8.59, nave),
        (AISLE, 0.45, 6.0, aisle),
        (OUTER, 0.42, 6.0, aisle),
    ];
    let beam = |(i, (x, half, y, z)): (usize, (f64, f64, f64, [f64; 2]))| {
        let solid = block([x - half, x + half], [y - SUNK, y + 0.8], z);
        mason.part(&format!("architrave.{}", i + 1), Finish::Sandstone, solid)
    };
    rows.into_iter().enumerate().map(beam).collect()
}

/// The walls that lift the nave's roof above those of the aisles, with a stone grille between each two columns.
fn clerestory(mason: &mut Mason) -> Vec<Node> {
    let grilles = |x| {
        let mut wall = Wall::along_z([-9.4 - SUNK, 4.6 + SUNK], [6.78, 9.4], x);
        for bay in BAYS.windows(2) {
            let middle = (bay[0] + bay[1]) / 2.0;
            for i in 0..6 {
                wall = wall.window(middle + 0.28 * (f64::from(i) - 2.5), 0.16, [7.75, 9.05]);
            }
        }
        wall.solid()
    };
    let end = |z| block([-7.6, 7.6], [8.4, 9.41], z);
    let mut wall = |i: usize, solid: Solid| mason.part(&format!("clerestory.{i}"), Finish::Sandstone, solid);
    vec![
        wall(1, grilles([-7.55, -7.05])),
        wall(2, grilles([7.05, 7.55])),
        wall(3, end([4.6, 5.1])),
        wall(4, end([-9.9, -9.4])),
    ]
}
