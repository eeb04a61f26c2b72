//! The rooms behind the hall, a stair to the storey above them, and the chamber that is hidden there. In meters.

use glam::{DVec2, dvec2};

use crate::glb::Node;
use crate::outline::Outline;
use crate::plate::Plate;
use crate::solid::{Axis, Solid};
use crate::temple::{Finish, Mason};
use crate::temple_columns::{Capital, Order};
use crate::temple_masonry::{SUNK, Wall, block, crowned, slab, sunk, sweep, wall_section};

/// The rooms' length between the hall's rear wall and the temple's.
const INSIDE: [f64; 2] = [-28.5, -10.2];
/// The height of the rooms.
const CEILING: f64 = 4.0;
/// The floor of the storey above.
const UPPER: f64 = 4.4;
/// The height of the upper storey's walls.
const TOP: f64 = 7.0;
/// The stair's inner side.
const STAIR_X: f64 = -10.5;
/// Where the stair starts and ends.
const STAIR: [f64; 2] = [-15.3, -20.06];
/// Its treads; one more step leads onto the floor above.
const TREADS: usize = 17;

/// Rooms, stair, altars, the storey above and the roofs.
pub(crate) fn chambers(mason: &mut Mason) -> Node {
    let (left, right) = (-12.0, 12.0);
    let around = [dvec2(right, -9.7), dvec2(right, -28.5), dvec2(left, -28.5), dvec2(left, -9.7)];
    let enclosure = sweep(&wall_section(1.0, [-1.5 * SUNK, 7.9], 0.3, 0.7), &around);
    let mut parts = vec![mason.part("enclosure", Finish::Sandstone, enclosure)];
    parts.extend(rooms(mason));
    let table = crowned([-0.6, 0.6], [-SUNK, 0.95], [-18.35, -17.15], 0.04, 0.25);
    let altar = crowned([-0.75, 0.75], [-SUNK, 1.2], [-26.4, -24.4], 0.05, 0.3);
    parts.extend([
        mason.part("offering_table", Finish::Alabaster, table),
        mason.part("altar", Finish::Alabaster, altar),
        mason.part("stair", Finish::Pale, stair()),
    ]);
    let places = [[-2.8, -12.2], [2.8, -12.2], [-2.3, -16.4], [2.3, -16.4], [-2.3, -19.1], [2.3, -19.1]];
    parts.extend(Order::new(mason, Capital::Bud, CEILING + SUNK, 0.4).columns(1, &places));
    parts.extend(upper_storey(mason));
    Node::new("chambers", None).with(parts)
}

/// The walls between the rooms.
fn rooms(mason: &mut Mason) -> Vec<Node> {
    let across = |z| Wall::along_x([-12.0 - SUNK, 12.0 + SUNK], [-SUNK, CEILING + SUNK], z);
    // A little lower at both ends than the walls across, in which it stands.
    let along = |z, x| Wall::along_z(z, [-SUNK / 2.0, CEILING + SUNK / 2.0], x);
    let ante = [-14.2 - SUNK, INSIDE[1] + SUNK];
    let offering = [-20.5 - SUNK, -15.0 + SUNK];
    let rear = [INSIDE[0] - SUNK, -21.3 + SUNK];
    let walls = [
        across([-15.0, -14.2]).door(-9.2, 1.0, 2.4).door(0.0, 1.8, 3.0).door(9.2, 1.0, 2.4),
        across([-21.3, -20.5])
            .door(-9.7, 1.0, 2.4)
            .door(-5.4, 1.0, 2.4)
            .door(0.0, 1.6, 3.0)
            .door(5.4, 1.0, 2.4)
            .door(9.7, 1.0, 2.4),
        along(ante, [-6.7, -6.0]).door(-12.2, 1.2, 2.6),
        along(ante, [6.0, 6.7]).door(-12.2, 1.2, 2.6),
        along(offering, [-4.7, -4.0]).door(-17.75, 1.2, 2.6),
        along(offering, [4.0, 4.7]).door(-17.75, 1.2, 2.6),
        along(rear, [-3.4, -2.6]),
        along(rear, [2.6, 3.4]),
        along(rear, [-8.0, -7.4]),
        along(rear, [7.4, 8.0]),
    ];
    let wall =
        |(i, wall): (usize, Wall)| mason.part(&format!("wall.{:02}", i + 1), Finish::Sandstone, wall.solid());
    walls.into_iter().enumerate().map(wall).collect()
}

/// A solid flight of steps along the left outer wall.
fn stair() -> Solid {
    let tread = (STAIR[0] - STAIR[1]) / TREADS as f64;
    let rise = UPPER / (TREADS + 1) as f64;
    let mut outline: Outline = vec![dvec2(-STAIR[0], -SUNK), dvec2(-STAIR[1], -SUNK)];
    for i in (0..TREADS).rev() {
        let (from, y) = (-STAIR[0] + tread * i as f64, rise * (i + 1) as f64);
        outline.extend([dvec2(from + tread, y), dvec2(from, y)]);
    }
    let rim = vec![(0.0, -12.0 - SUNK), (0.0, STAIR_X)];
    Plate { outline, rim, ..Plate::default() }.solid().along(Axis::X)
}

/// The floor above the rooms, open over the stair, two walls upon it, and the roofs.
fn upper_storey(mason: &mut Mason) -> Vec<Node> {
    let (wide, [rear, front]) = (12.0 + 2.0 * SUNK, sunk(INSIDE, 2.0));
    let (well, side) = (STAIR[1] + SUNK, STAIR_X - SUNK);
    let floor = [
        [rear, -wide],
        [well, -wide],
        [well, side],
        [-17.0, side],
        [-17.0, -wide],
        [front, -wide],
        [front, wide],
        [rear, wide],
    ];
    let floor: Outline = floor.into_iter().map(DVec2::from).collect();
    let wall = |x| Wall::along_z(sunk(INSIDE, 1.0), [UPPER - SUNK, TOP], x);
    let roof = [TOP - SUNK, TOP + 0.38];
    vec![
        mason.part("roof.lower", Finish::Roof, slab(floor, [CEILING, UPPER])),
        mason.part("wall.upper.1", Finish::Sandstone, wall([-4.7, -4.0]).door(-12.6, 0.9, 6.3).solid()),
        mason.part("wall.upper.2", Finish::Sandstone, wall([4.0, 4.7]).solid()),
        mason.part("roof.upper.1", Finish::Roof, block([-wide, -4.35], roof, [rear, front])),
        mason.part("roof.upper.2", Finish::Roof, block([4.35, wide], roof, [rear, front])),
        mason.part(
            "roof.upper.3",
            Finish::Roof,
            block([-4.35 - SUNK, 4.35 + SUNK], [TOP - 2.0 * SUNK, TOP + 0.46], sunk(INSIDE, 3.0)),
        ),
    ]
}

/// The chamber above the sanctuary; one crawls into it from the gap around it.
pub(crate) fn hidden_chamber(mason: &mut Mason) -> Node {
    let walls = [4.58, 6.62];
    let (wide, z) = ([-3.2, 3.2], [-28.0, -21.7]);
    let length = [-27.4 - SUNK, -22.3 + SUNK];
    let inner = [4.585, 6.615];
    let chest = crowned([-0.65, 0.65], [4.58, 5.45], [-26.1, -23.6], 0.0, 0.2);
    let lid = Plate {
        outline: [[-26.0, -0.55], [-23.7, -0.55], [-23.7, 0.55], [-26.0, 0.55]].map(DVec2::from).to_vec(),
        rim: vec![(0.0, 5.43), (0.0, 5.53), (0.22, 5.68)],
        ..Plate::default()
    };
    let sarcophagus = vec![
        mason.part("chest", Finish::Granite, chest),
        mason.part("lid", Finish::Granite, lid.solid().along(Axis::Y)),
    ];
    Node::new("hidden_chamber", None).with(vec![
        mason.part("floor", Finish::Pale, block(wide, [UPPER - SUNK, 4.6], z)),
        mason.part("wall.1", Finish::Pale, block([-3.1, 3.1], walls, [-22.3, -21.8])),
        mason.part("wall.2", Finish::Pale, block([-3.1, 3.1], walls, [-27.9, -27.4])),
        mason.part(
            "wall.3",
            Finish::Pale,
            Wall::along_z(length, inner, [-3.08, -2.6]).door(-26.6, 0.8, 5.5).solid(),
        ),
        mason.part("wall.4", Finish::Pale, Wall::along_z(length, inner, [2.6, 3.08]).solid()),
        mason.part("roof", Finish::Roof, block(wide, [6.6, 6.9], z)),
        Node::new("sarcophagus", None).with(sarcophagus),
    ])
}
