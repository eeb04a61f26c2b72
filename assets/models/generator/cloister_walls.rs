//! The outer walls of the walks with their doors and windows, and what strengthens them outside. In meters, as parts of
//! the south walk, which lies towards +Z.

use crate::cloister::{BAY, Builder, DEEP, FLOOR, Finish, IMPOST, OUTER, WALK, bays, bounds};
use crate::cloister_masonry::{
    Opening, angle, frame, pierced, pilaster, plan, points, surround, united, upright,
};
use crate::glb::Node;
use crate::outline::Outline;
use crate::plate::Plate;
use crate::solid::{Axis, Solid};
use crate::temple_masonry::{SUNK, block};

/// The walls' outer side.
const FACE: f64 = OUTER + 0.9;
/// The walls' upper side.
const TOP: f64 = 6.88;
/// The middle of the vault at a walk's end.
const END: f64 = (OUTER + WALK) / 2.0;
/// The gate in the middle of a side.
const GATE: Opening = Opening { middle: 0.0, half: 0.85, foot: -DEEP, spring: 2.2 };

/// What the outer walls share.
pub(crate) struct Walls {
    outside: usize,
    beside: usize,
    gate: [usize; 2],
    step: usize,
    frame: usize,
    buttress: usize,
}

/// Where a wall has windows: in every bay beside the gate, and at the ends of the other walks.
fn windows() -> [f64; 8] {
    let [a, b, c, _, e, f, g] = bays();
    [-END, a, b, c, e, f, g, END]
}

/// Where it has buttresses: outside of the vaults' arches.
fn buttresses() -> [f64; 8] {
    let [a, b, c, d, e, f] = bounds();
    let last = 3.5 * BAY + 0.3;
    [-last, a, b, c, d, e, f, last]
}

/// A window; its frame is a little narrower than its opening in the wall.
fn window(middle: f64) -> Opening {
    Opening { middle, half: 0.45, foot: 1.88, spring: 3.1 }
}

impl Walls {
    /// Cuts the stones.
    pub(crate) fn new(builder: &mut Builder) -> Self {
        let wall = |doors: &[Opening], windows: &[Opening]| {
            let end = OUTER - 0.06;
            pierced([-end, end], [-DEEP, TOP], [OUTER, FACE], doors, windows)
        };
        let windows: Vec<Opening> = windows().into_iter().map(window).collect();
        let doors = [-END, END].map(|middle| Opening { middle, ..GATE });
        let jambs = surround(GATE.grown(-0.08), -0.5 * DEEP, 0.3, [OUTER - 0.07, FACE + 0.08]);
        let step = block([-1.4, 1.4], [-0.6 * DEEP, 0.06], [FACE - 0.3, FACE + 0.55]);
        let around = united([
            surround(window(0.0).grown(-0.07), window(0.0).foot - SUNK, 0.17, [OUTER - 0.05, FACE + 0.05]),
            block([-0.64, 0.64], [1.76, 1.94], [OUTER - 0.1, FACE + 0.11]),
        ]);
        Self {
            outside: builder.mesh("wall", Finish::Stone, wall(&[GATE], &windows)),
            beside: builder.mesh("wall", Finish::Stone, wall(&doors, &[])),
            gate: [builder.mesh("jambs", Finish::Pale, jambs), builder.mesh("leaf", Finish::Wood, leaf())],
            step: builder.mesh("step", Finish::Paving, step),
            frame: builder.mesh("window", Finish::Pale, around),
            buttress: builder.mesh("buttress", Finish::Stone, buttress()),
        }
    }

    /// A door at a place along the wall.
    fn door(&self, name: &str, x: f64) -> Node {
        let [jambs, leaf] = self.gate;
        let parts = vec![Node::new("jambs", Some(jambs)), Node::new("leaf", Some(leaf))];
        Builder::placed(Node::new(name, None).with(parts), x, 0.0, 0.0)
    }

    /// A wall towards the outside.
    pub(crate) fn outside(&self) -> Node {
        let mut parts = vec![
            Node::new("wall", Some(self.outside)),
            self.door("gate", 0.0),
            Node::new("step", Some(self.step)),
        ];
        for (i, x) in windows().into_iter().enumerate() {
            let frame = Node::new(format!("window.{}", i + 1), Some(self.frame));
            parts.push(Builder::placed(frame, x, 0.0, 0.0));
        }
        for (i, x) in buttresses().into_iter().enumerate() {
            let buttress = Node::new(format!("buttress.{}", i + 1), Some(self.buttress));
            parts.push(Builder::placed(buttress, x, 0.0, 0.0));
        }
        Node::new("enclosure", None).with(parts)
    }

    /// The wall towards the church.
    pub(crate) fn beside_church(&self) -> Node {
        Node::new("enclosure", None).with(vec![
            Node::new("wall", Some(self.beside)),
            self.door("door.1", -END),
            self.door("door.2", END),
        ])
    }
}

/// A door of boards, closed.
fn leaf() -> Solid {
    let middle = OUTER + 0.42;
    let shape: Outline = Opening { foot: -0.4 * DEEP, ..GATE }.grown(SUNK).outline();
    let panel = |z: f64, half: f64| Plate {
        outline: shape.clone(),
        rim: vec![(0.0, z - half), (0.0, z + half)],
        ..Plate::default()
    };
    let band = |y: f64| block([-0.8, 0.8], [y - 0.05, y + 0.05], [middle - 0.08, middle + 0.08]);
    let seam = |x: f64| {
        block([x - 0.02, x + 0.02], [FLOOR + 0.02, 2.95 - x.abs() * 0.5], [middle - 0.065, middle + 0.065])
    };
    united(
        [panel(middle, 0.05).solid(), band(0.6), band(1.4), band(2.15)]
            .into_iter()
            .chain([-0.42, 0.0, 0.42].map(seam)),
    )
}

/// A buttress outside, which steps back under sloping stones.
fn buttress() -> Solid {
    let outline = points(&[
        (-FACE - 0.6, -0.8 * DEEP),
        (-FACE + 0.2, -0.8 * DEEP),
        (-FACE + 0.2, 6.15),
        (-FACE - 0.32, 5.3),
        (-FACE - 0.32, 3.4),
        (-FACE - 0.6, 2.95),
    ]);
    Plate { outline, rim: vec![(0.0, -0.3), (0.0, 0.3)], ..Plate::default() }.solid().along(Axis::X)
}

/// The buttress at a corner of the walks, and the pilaster in the corner inside, which carries the vault.
pub(crate) fn corner(builder: &mut Builder) -> Vec<(&'static str, usize)> {
    // The walls end behind it, far enough from its edges.
    let core = [OUTER - 0.1, FACE - 0.3];
    let stone = united([
        upright(
            &angle(OUTER - 0.45, FACE - 0.35, FACE + 0.3),
            &[(0.0, -0.9 * DEEP), (0.0, TOP - 0.5 * SUNK)],
        ),
        block(core, [-0.85 * DEEP, TOP - SUNK], core),
    ]);
    let inner = [OUTER - 0.17, OUTER + 0.1];
    let support = upright(&plan(inner, inner), &pilaster(FLOOR, IMPOST));
    vec![
        ("buttress", builder.mesh("corner buttress", Finish::Stone, stone)),
        ("pilaster", builder.mesh("corner pilaster", Finish::Stone, support)),
    ]
}

/// The coping on the outer walls.
pub(crate) fn coping(builder: &mut Builder) -> Node {
    let section = points(&[
        (OUTER - 0.12, TOP - 2.0 * SUNK),
        (FACE + 0.34, TOP - 2.0 * SUNK),
        (FACE + 0.4, TOP + 0.04),
        (FACE + 0.4, TOP + 0.12),
        (OUTER + 0.5, TOP + 0.32),
        (OUTER - 0.16, TOP + 0.14),
        (OUTER - 0.16, TOP + 0.04),
    ]);
    builder.part("coping", Finish::Pale, frame(&section))
}
