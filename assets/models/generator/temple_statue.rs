//! A seated king with striped head cloth and false beard, hands on his knees, on a throne with a back pillar. In meters;
//! he looks towards +Z, his plinth stands at `y = 0`.

use crate::glb::Node;
use crate::loft::{Loft, Way, pair};
use crate::solid::Solid;
use crate::temple::{Finish, Mason};
use crate::temple_masonry::{SUNK, block};

/// Height of the plinth under his feet.
const PLINTH: f64 = 0.35;
/// Edges of the figure that turn by more stay hard, in degrees.
const CREASE: f64 = 50.0;

/// What stands upright: trunk, head, limbs.
const UPRIGHT: Loft = Loft { way: Way::Up, power: 2.5, sides: 16, pieces: 2 };
/// A limb that lies.
const LYING: Loft = Loft { way: Way::Forward, power: 2.6, sides: 16, pieces: 2 };
/// Cloth with firm edges.
const CLOTH: Loft = Loft { way: Way::Up, power: 12.0, sides: 8, pieces: 1 };

/// The meshes of a statue, which all statues share.
pub(crate) struct Statue {
    parts: [(&'static str, usize); 3],
}

impl Statue {
    /// Carves the king, his regalia and his throne.
    pub(crate) fn new(mason: &mut Mason) -> Self {
        let mut part = |name, finish, solid: Solid| {
            (name, mason.creased(name, finish, solid.moved(0.0, PLINTH, 0.0), CREASE))
        };
        Self {
            parts: [
                part("king", Finish::Granite, united([trunk(), head(), arms(), legs()])),
                part("regalia", Finish::DarkGranite, united([head_cloth(), beard(), kilt()])),
                part("throne", Finish::Granite, throne()),
            ],
        }
    }

    /// A statue.
    pub(crate) fn node(&self, name: &str) -> Node {
        let parts = self.parts.iter().map(|&(name, mesh)| Node::new(name, Some(mesh))).collect();
        Node::new(name, None).with(parts)
    }
}

/// The bodies as one.
fn united<const N: usize>(bodies: [Solid; N]) -> Solid {
    let triangles = bodies.into_iter().flat_map(|body| body.triangles).collect();
    Solid { triangles, ..Solid::default() }
}

/// Hips, waist, chest, shoulders and neck.
fn trunk() -> Solid {
    Loft { sides: 20, ..UPRIGHT }.through(&[
        ([0.0, 1.3, -0.5], [0.48, 0.35]),
        ([0.0, 1.7, -0.51], [0.45, 0.33]),
        ([0.0, 2.0, -0.53], [0.38, 0.28]),
        ([0.0, 2.4, -0.52], [0.48, 0.33]),
        ([0.0, 2.66, -0.53], [0.6, 0.31]),
        ([0.0, 2.8, -0.53], [0.42, 0.24]),
        ([0.0, 2.88, -0.5], [0.2, 0.19]),
        ([0.0, 3.15, -0.45], [0.17, 0.18]),
    ])
}

/// Face, nose, lips, eyes and ears.
fn head() -> Solid {
    let ball = |[x, y, z]: [f64; 3], [a, b, c]: [f64; 3]| {
        let ring = |height: f64, size: f64| ([x, y + b * height, z], [a * size, c * size]);
        Loft { power: 2.0, sides: 8, pieces: 1, ..UPRIGHT }.through(&[
            ring(-1.0, 0.15),
            ring(-0.75, 0.66),
            ring(0.0, 1.0),
            ring(0.75, 0.66),
            ring(1.0, 0.15),
        ])
    };
    let skull = Loft { power: 2.3, ..UPRIGHT }.through(&[
        ([0.0, 2.96, -0.25], [0.09, 0.09]),
        ([0.0, 3.02, -0.28], [0.18, 0.19]),
        ([0.0, 3.16, -0.34], [0.26, 0.29]),
        ([0.0, 3.38, -0.37], [0.29, 0.33]),
        ([0.0, 3.62, -0.4], [0.27, 0.31]),
    ]);
    let nose = Loft { power: 2.0, sides: 12, pieces: 1, ..UPRIGHT }.through(&[
        ([0.0, 3.23, -0.04], [0.035, 0.03]),
        ([0.0, 3.26, -0.03], [0.055, 0.05]),
        ([0.0, 3.32, -0.04], [0.035, 0.045]),
        ([0.0, 3.44, -0.07], [0.025, 0.04]),
    ]);
    let features = pair(&united([
        ball([0.125, 3.38, -0.075], [0.075, 0.032, 0.035]),
        ball([0.3, 3.34, -0.3], [0.045, 0.11, 0.08]),
    ]));
    united([skull, nose, features, ball([0.0, 3.145, -0.065], [0.095, 0.03, 0.035])])
}

/// Upper arms along the body, lower arms on the thighs, hands flat towards the knees.
fn arms() -> Solid {
    let upper = UPRIGHT.through(&[
        ([0.68, 1.7, -0.5], [0.11, 0.13]),
        ([0.69, 1.84, -0.5], [0.14, 0.16]),
        ([0.69, 2.56, -0.53], [0.175, 0.195]),
        ([0.63, 2.76, -0.53], [0.15, 0.165]),
        ([0.55, 2.84, -0.53], [0.06, 0.07]),
    ]);
    let lower = LYING.through(&[
        ([0.68, 1.84, -0.62], [0.1, 0.1]),
        ([0.67, 1.84, -0.5], [0.135, 0.14]),
        ([0.52, 1.79, 0.0], [0.12, 0.115]),
        ([0.38, 1.74, 0.32], [0.085, 0.075]),
        ([0.33, 1.71, 0.52], [0.125, 0.06]),
        ([0.29, 1.67, 0.86], [0.105, 0.03]),
    ]);
    pair(&united([upper, lower]))
}

/// Thighs, shins and feet.
fn legs() -> Solid {
    let thigh = LYING.through(&[
        ([0.29, 1.4, -0.5], [0.26, 0.27]),
        ([0.28, 1.41, 0.5], [0.225, 0.24]),
        ([0.27, 1.41, 0.74], [0.19, 0.21]),
        ([0.27, 1.4, 0.84], [0.11, 0.13]),
        ([0.27, 1.39, 0.86], [0.03, 0.04]),
    ]);
    let shin = UPRIGHT.through(&[
        ([0.27, 0.15, 0.6], [0.115, 0.135]),
        ([0.28, 0.85, 0.57], [0.185, 0.21]),
        ([0.27, 1.4, 0.62], [0.215, 0.205]),
    ]);
    let foot = Loft { power: 3.2, sides: 12, ..LYING }.through(&[
        ([0.27, 0.12, 0.46], [0.11, 0.13]),
        ([0.28, 0.13, 0.8], [0.13, 0.15]),
        ([0.29, 0.07, 1.1], [0.16, 0.09]),
        ([0.3, 0.04, 1.26], [0.13, 0.06]),
    ]);
    pair(&united([thigh, shin, foot]))
}

/// The pleated kilt over lap and thighs.
fn kilt() -> Solid {
    Loft { way: Way::Forward, power: 5.0, sides: 20, ..CLOTH }.through(&[
        ([0.0, 1.42, -0.78], [0.54, 0.28]),
        ([0.0, 1.41, -0.2], [0.59, 0.29]),
        ([0.0, 1.4, 0.56], [0.53, 0.285]),
    ])
}

/// Brow band, cap, wings behind the ears, lappets on the chest, the cobra above the brow.
fn head_cloth() -> Solid {
    let cap = Loft { power: 2.3, ..UPRIGHT }.through(&[
        ([0.0, 3.47, -0.4], [0.325, 0.375]),
        ([0.0, 3.64, -0.41], [0.325, 0.37]),
        ([0.0, 3.8, -0.43], [0.25, 0.3]),
        ([0.0, 3.88, -0.45], [0.1, 0.13]),
    ]);
    let band = Loft { power: 2.3, pieces: 1, ..UPRIGHT }
        .through(&[([0.0, 3.46, -0.4], [0.335, 0.385]), ([0.0, 3.53, -0.4], [0.335, 0.385])]);
    let wings = CLOTH.through(&[
        ([0.0, 2.76, -0.56], [0.58, 0.14]),
        ([0.0, 2.92, -0.54], [0.585, 0.16]),
        ([0.0, 3.2, -0.52], [0.52, 0.165]),
        ([0.0, 3.5, -0.5], [0.4, 0.16]),
        ([0.0, 3.68, -0.48], [0.29, 0.15]),
    ]);
    let lappet = CLOTH.through(&[
        ([0.26, 2.36, -0.235], [0.1, 0.07]),
        ([0.3, 2.64, -0.23], [0.125, 0.07]),
        ([0.34, 2.84, -0.29], [0.14, 0.08]),
        ([0.38, 3.06, -0.42], [0.14, 0.08]),
    ]);
    let cobra = Loft { power: 2.0, sides: 12, pieces: 1, ..UPRIGHT }.through(&[
        ([0.0, 3.48, -0.03], [0.03, 0.03]),
        ([0.0, 3.6, 0.0], [0.06, 0.03]),
        ([0.0, 3.7, -0.01], [0.045, 0.035]),
        ([0.0, 3.76, 0.01], [0.02, 0.025]),
    ]);
    united([cap, band, wings, pair(&lappet), cobra])
}

/// The false beard.
fn beard() -> Solid {
    Loft { power: 2.0, pieces: 1, ..UPRIGHT }.through(&[
        ([0.0, 2.56, -0.12], [0.095, 0.06]),
        ([0.0, 2.62, -0.115], [0.1, 0.07]),
        ([0.0, 3.03, -0.12], [0.065, 0.06]),
    ])
}

/// Plinth, seat, low back and pillar.
fn throne() -> Solid {
    united([
        block([-0.85, 0.85], [-PLINTH - SUNK, SUNK], [-1.25, 1.5]),
        block([-0.66, 0.66], [0.0, 1.2], [-1.15, 0.44]),
        block([-0.64, 0.64], [1.18, 1.68], [-1.13, -0.84]),
        block([-0.3, 0.3], [1.5, 3.45], [-1.11, -0.6]),
    ])
}
