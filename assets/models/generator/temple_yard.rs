//! The inner yard: open to the sky, with a colonnade on three sides. In meters.

use glam::{DVec2, dvec2};

use crate::glb::Node;
use crate::temple::{Finish, Mason};
use crate::temple_columns::{Capital, Order};
use crate::temple_masonry::{SUNK, block, eaves_section, sweep, wall_section};

/// The line of the columns, from the temple's axis.
const ROW: f64 = 8.8;
/// The line of those along the pylon.
const FRONT: f64 = 23.2;
/// Height of the columns.
const COLUMN: f64 = 5.0;

/// Half the width of an architrave.
const BEAM: f64 = 0.43;
/// Its upper side.
const LEDGE: f64 = COLUMN + 0.66;

/// Walls, columns, architraves and roofs.
pub(crate) fn yard(mason: &mut Mason) -> Node {
    let wall = |path: [DVec2; 2]| sweep(&wall_section(1.0, [-1.5 * SUNK, 6.9], 0.3, 0.7), &path);
    let beam = |x: f64| block([x - BEAM, x + BEAM], [COLUMN - SUNK, LEDGE], [5.3, FRONT + BEAM]);
    // Between the other two, a little smaller.
    let across = block(
        [BEAM - ROW - SUNK, ROW - BEAM + SUNK],
        [COLUMN - SUNK / 2.0, LEDGE - SUNK / 2.0],
        [FRONT - BEAM + 0.01, FRONT + BEAM - 0.01],
    );
    // From the walls and the gate to a little beyond the architraves.
    let (flank, gate) = (12.0 + SUNK, FRONT + 12.0 + SUNK - ROW);
    let eaves = eaves_section(flank - ROW + BEAM + 0.07, [LEDGE - SUNK, 6.2]);
    let around = [dvec2(flank, 5.28), dvec2(flank, gate), dvec2(-flank, gate), dvec2(-flank, 5.28)];
    let mut part = |name, finish, solid| mason.part(name, finish, solid);
    let mut parts = vec![
        part("wall.1", Finish::Sandstone, wall([dvec2(-12.0, 5.1), dvec2(-12.0, 27.2)])),
        part("wall.2", Finish::Sandstone, wall([dvec2(12.0, 27.2), dvec2(12.0, 5.1)])),
        part("architrave.1", Finish::Sandstone, beam(-ROW)),
        part("architrave.2", Finish::Sandstone, beam(ROW)),
        part("architrave.3", Finish::Sandstone, across),
        part("roof", Finish::Roof, sweep(&eaves, &around)),
    ];
    let sides = [-ROW, ROW].map(|x| [9.4, 12.85, 16.3, 19.75, FRONT].map(|z| [x, z])).concat();
    let front = [-5.9, -2.9, 2.9, 5.9].map(|x| [x, FRONT]);
    let order = Order::new(mason, Capital::Open, COLUMN, 0.54);
    parts.extend(order.columns(1, &[sides, front.to_vec()].concat()));
    Node::new("yard", None).with(parts)
}
