//! Rings of which each goes through others.

use std::f64::consts::TAU;

use glam::{DMat4, DVec3};
use hachure::geometry::{Mesh, primitives};

/// A ring, and where copies of it lie.
#[derive(Debug, Clone)]
pub struct Links {
    pub mesh: Mesh,
    pub places: Vec<DMat4>,
}

/// Around the Z axis, of radius 1; as thin as its tube's radius says.
fn ring(tube: f32) -> Mesh {
    let mut mesh = primitives::torus(1.0, tube, 40, 20);
    for p in mesh.positions.iter_mut().chain(&mut mesh.normals) {
        (p.y, p.z) = (-p.z, p.y);
    }
    mesh
}

/// Two rings, each through the middle of the other.
pub fn pair() -> Links {
    let across = DMat4::from_translation(DVec3::X) * DMat4::from_rotation_x(TAU / 4.0);
    Links { mesh: ring(0.24), places: vec![DMat4::IDENTITY, across] }
}

/// A closed chain of `count` links, turned against each other so that it closes whatever their number is.
pub fn chain(count: usize) -> Links {
    // Between the middles of two links; more than 1 leaves room for the next but one.
    const STEP: f64 = 1.3;
    let radius = STEP / (2.0 * (TAU / 2.0 / count as f64).sin());
    // Half a turn brings a ring onto itself.
    let turn = TAU / 2.0 * (count as f64 / 2.0).round() / count as f64;
    let place = |i: usize| {
        DMat4::from_rotation_y(TAU * i as f64 / count as f64)
            * DMat4::from_translation(DVec3::Z * radius)
            * DMat4::from_rotation_x(turn * i as f64)
    };
    Links { mesh: ring(0.17), places: (0..count).map(place).collect() }
}

/// Rings each of which goes through all others: circles of Villarceau on one torus.
pub fn knot(count: usize) -> Links {
    const OFF: f64 = 0.55;
    let place = |i: usize| {
        DMat4::from_rotation_z(TAU * i as f64 / count as f64)
            * DMat4::from_translation(DVec3::X * OFF)
            * DMat4::from_rotation_x(OFF.asin())
    };
    Links { mesh: ring(0.13), places: (0..count).map(place).collect() }
}
