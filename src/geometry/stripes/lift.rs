//! From the phases at the corners of a triangle to phases that are linear inside of it.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_3};

use glam::Vec3;

use super::levels::{BASE_LEVEL, DENSITIES, FAMILIES, LEVELS, Phases};
use crate::geometry::direction_field::cut::transport;

/// A corner of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Where it is, in units of the mesh.
    pub position: Vec3,
    /// Direction of the strokes of family 0, unit length.
    pub direction: Vec3,
    /// Unit normal of the surface there.
    pub normal: Vec3,
    /// The phases.
    pub phases: Phases,
}

/// A triangle's phases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrianglePhases {
    /// 1 where the direction of a corner agrees with that of the first corner, −1 where it is its opposite.
    pub signs: [f32; 3],
    /// For each family, level and corner the phase in cycles. Values inside the triangle are to be interpolated between
    /// them; lines are where they are whole. All levels are right up to a whole number.
    pub phases: [[[f32; 3]; LEVELS]; FAMILIES],
}

/// Vector in the tangent plane along which the phase of a family grows, as long as its lines are dense (`DENSITIES`):
/// `90 + 60 family` degrees from the direction.
pub fn gradient(direction: Vec3, normal: Vec3, family: usize) -> Vec3 {
    let (sin, cos) = (FRAC_PI_2 + FRAC_PI_3 * family as f32).sin_cos();
    (direction * cos + normal.cross(direction) * sin) * DENSITIES[family]
}

/// 1 if two directions are turned against each other by less than 90° when the surface is rolled from the plane of one
/// to that of the other, else −1.
pub fn sign_between(first: &Corner, second: &Corner) -> f32 {
    sign(first.direction, first.normal, second.direction, second.normal)
}

pub(super) fn sign(from: Vec3, from_normal: Vec3, to: Vec3, to_normal: Vec3) -> f32 {
    if transport(from, from_normal, to_normal).dot(to) < 0.0 { -1.0 } else { 1.0 }
}

/// The phases of a triangle. `cycles_per_unit` is that of the [`super::StripeField`].
///
/// Each corner but the first gets the phase nearest to what the gradient between it and the first corner foretells; a
/// corner whose direction is the opposite of the first one's counts backwards. Triangles may hold many cycles. Where
/// lines end or part, the side opposite to the first corner does not agree with its neighbor: that is so in one triangle
/// per end.
pub fn lift(corners: &[Corner; 3], cycles_per_unit: f32) -> TrianglePhases {
    let signs = [1.0, sign_between(&corners[0], &corners[1]), sign_between(&corners[0], &corners[2])];
    let mut phases = [[[0.0; 3]; LEVELS]; FAMILIES];
    for (family, of_family) in phases.iter_mut().enumerate() {
        let gradients = corners.map(|c| gradient(c.direction, c.normal, family));
        // Cycles from the first corner to each, at the base level.
        let cycles: [f32; 3] = std::array::from_fn(|j| {
            let mean = 0.5 * (gradients[0] + gradients[j] * signs[j]);
            cycles_per_unit * mean.dot(corners[j].position - corners[0].position)
        });
        for (level, lifted) in of_family.iter_mut().enumerate() {
            let scale = (level as f32 - BASE_LEVEL as f32).exp2();
            let phase = |j: usize| f32::from(corners[j].phases[family][level]) / 65536.0;
            for j in 0..3 {
                let foretold = phase(0) + cycles[j] * scale;
                lifted[j] = if j == 0 { phase(0) } else { foretold + wrap(signs[j] * phase(j) - foretold) };
            }
        }
    }
    TrianglePhases { signs, phases }
}

/// What is left of a number of cycles without whole ones, −½ to ½.
pub fn wrap(cycles: f32) -> f32 {
    cycles - cycles.round()
}
