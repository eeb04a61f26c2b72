//! Bodies through rounded sections, as a sculptor cuts them: limbs, trunks, cloth.

use std::f64::consts::TAU;

use glam::{DVec3, dvec3};

use crate::curve::through;
use crate::solid::Solid;

/// Which way the sections follow each other.
#[derive(Clone, Copy)]
pub(crate) enum Way {
    /// Along +Y.
    Up,
    /// Along +Z.
    Forward,
}

/// A section: its middle, its half size along X and along Z (`Up`) or Y (`Forward`).
pub(crate) type Section = ([f64; 3], [f64; 2]);

/// How a body is cut.
#[derive(Clone, Copy)]
pub(crate) struct Loft {
    /// Where it goes.
    pub(crate) way: Way,
    /// The sections are superellipses: 2 = an ellipse, more = nearer to a rectangle.
    pub(crate) power: f64,
    /// Points around a section, a multiple of four.
    pub(crate) sides: usize,
    /// Pieces from one section to the next: 1 = straight, more = a smooth curve through the sections.
    pub(crate) pieces: usize,
}

impl Loft {
    /// The closed body through the sections.
    pub(crate) fn through(self, sections: &[Section]) -> Solid {
        let strands: Vec<Vec<DVec3>> = (0..self.sides)
            .map(|i| {
                let corners: Vec<DVec3> = sections.iter().map(|section| self.corner(section, i)).collect();
                through(&corners, self.pieces)
            })
            .collect();
        let ring = |row: usize| strands.iter().map(|strand| strand[row]).collect::<Vec<_>>();
        let rows = strands[0].len();
        let mut solid = Solid::default();
        for row in 1..rows {
            solid.band(&ring(row - 1), &ring(row));
        }
        let mut low = ring(0);
        low.reverse();
        close(&mut solid, &low);
        close(&mut solid, &ring(rows - 1));
        solid
    }

    /// A section's corner, counter-clockwise as seen from where the body goes.
    fn corner(self, &(middle, half): &Section, i: usize) -> DVec3 {
        let (sin, cos) = (TAU * i as f64 / self.sides as f64).sin_cos();
        // What should be zero, is.
        let bend = |v: f64| if v.abs() < 1e-9 { 0.0 } else { v.signum() * v.abs().powf(2.0 / self.power) };
        let (u, v) = (half[0] * bend(cos), half[1] * bend(sin));
        DVec3::from(middle)
            + match self.way {
                Way::Up => dvec3(u, 0.0, -v),
                Way::Forward => dvec3(u, v, 0.0),
            }
    }
}

/// Fills a flat ring from its middle.
fn close(solid: &mut Solid, ring: &[DVec3]) {
    let middle = ring.iter().sum::<DVec3>() / ring.len() as f64;
    for (i, &a) in ring.iter().enumerate() {
        solid.triangle(a, ring[(i + 1) % ring.len()], middle);
    }
}

/// The body and its mirror image at the left.
pub(crate) fn pair(right: &Solid) -> Solid {
    let mut both = right.clone();
    let left = right.triangles.iter().map(|&[a, b, c]| [a, c, b].map(|p| dvec3(-p.x, p.y, p.z)));
    both.triangles.extend(left);
    both
}
