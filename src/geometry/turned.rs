//! Turned and extruded forms: the axis that a surface lies around, where it has one.
//!
//! A turned form glides in itself when it turns about its axis: the velocity of each point lies across the normal there. Of all
//! motions the one that comes nearest to that is found by least squares (Pottmann and Wallner 2001, "Computational Line
//! Geometry"). A form that is extruded along an axis has all normals across it.

use glam::{DMat3, DVec3};

use super::{Mesh, Surfaces};

/// What a surface lies around.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FormAxis {
    /// Unit length, local space; 0 where there is none.
    pub direction: DVec3,
    /// How surely the surface is a form around it, 0 to 1.
    pub strength: f64,
}

/// Least share of the area's normals that must lie across their mean, so that a surface is rounded and not flat: from none to all.
const ROUNDED: [f64; 2] = [0.01, 0.03];
/// Share of the second least of what normals have along an axis and across it: from extruded to not.
const EXTRUDED: [f64; 2] = [0.03, 0.12];
/// Mean square of the sine by which normals miss the axis: from turned to not.
const TURNED: [f64; 2] = [0.03, 0.08];

/// The axis of each surface of a mesh.
pub fn form_axes(mesh: &Mesh, surfaces: &Surfaces) -> Vec<FormAxis> {
    let mut triangles: Vec<Vec<Facet>> = (0..surfaces.count).map(|_| Vec::new()).collect();
    for (triangle, &surface) in mesh.triangles().iter().zip(&surfaces.of_triangle) {
        let [a, b, c] = mesh.corners(*triangle).map(|p| p.as_dvec3());
        let normal = (b - a).cross(c - a);
        let area = normal.length();
        if area > 0.0
            && let Some(of_surface) = triangles.get_mut(surface as usize)
        {
            of_surface.push(Facet { middle: (a + b + c) / 3.0, normal: normal / area, area });
        }
    }
    triangles.iter_mut().map(|facets| axis_of(facets)).collect()
}

struct Facet {
    middle: DVec3,
    normal: DVec3,
    area: f64,
}

fn axis_of(facets: &mut [Facet]) -> FormAxis {
    let area: f64 = facets.iter().map(|f| f.area).sum();
    let center = facets.iter().map(|f| f.middle * f.area).sum::<DVec3>() / area;
    let size = (facets.iter().map(|f| f.middle.distance_squared(center) * f.area).sum::<f64>() / area).sqrt();
    if size <= 0.0 || !size.is_finite() {
        return FormAxis::default();
    }
    let mut by_normals = DMat3::ZERO;
    let mut by_moments = DMat3::ZERO;
    let mut mixed = DMat3::ZERO;
    for facet in &mut *facets {
        (facet.middle, facet.area) = ((facet.middle - center) / size, facet.area / area);
        let (normal, moment) = (facet.normal, facet.middle.cross(facet.normal));
        by_normals += outer(normal, normal) * facet.area;
        by_moments += outer(moment, moment) * facet.area;
        mixed += outer(normal, moment) * facet.area;
    }
    let (spread, directions) = eigen(by_normals);
    let is_rounded = step(ROUNDED, spread[1]);
    if is_rounded == 0.0 {
        return FormAxis::default();
    }
    let extruded = FormAxis {
        direction: directions.x_axis,
        strength: is_rounded * (1.0 - step(EXTRUDED, spread[0] / spread[1])),
    };
    // A velocity that is added to that of turning makes the axis pass elsewhere.
    let shift = -((by_normals + DMat3::IDENTITY * 1e-6).inverse() * mixed);
    // What any axis fits, such as a ball, is turned about the second one.
    let misses =
        by_moments + mixed.transpose() * shift + (DMat3::IDENTITY - outer(DVec3::Y, DVec3::Y)) * 1e-4;
    let axis = eigen(misses).1.x_axis;
    let through = axis.cross(shift * axis);
    let (mut missed, mut all) = (0.0, 0.0);
    for Facet { middle, normal, area } in facets {
        let away = (*middle - through).reject_from_normalized(axis);
        missed += *area * axis.cross(*normal).dot(away).powi(2);
        all += *area * axis.cross(*normal).length_squared() * away.length_squared();
    }
    let turned = FormAxis {
        direction: axis,
        strength: is_rounded * (1.0 - step(TURNED, missed / all.max(f64::MIN_POSITIVE))),
    };
    if turned.strength > extruded.strength { turned } else { extruded }
}

/// 0 before the first of these, 1 beyond the second, smooth between them.
fn step([from, to]: [f64; 2], x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// Eigenvalues, the least one first, and eigenvectors of a symmetric matrix, by Jacobi's rotations.
fn eigen(symmetric: DMat3) -> (DVec3, DMat3) {
    let mut matrix = symmetric;
    let mut vectors = DMat3::IDENTITY;
    for round in 0..18 {
        let (p, q) = [(0, 1), (0, 2), (1, 2)][round % 3];
        let off = matrix.col(q)[p];
        if off != 0.0 {
            let angle = 0.5 * (2.0 * off).atan2(matrix.col(q)[q] - matrix.col(p)[p]);
            let (sin, cos) = angle.sin_cos();
            let mut rotation = DMat3::IDENTITY;
            (rotation.col_mut(p)[p], rotation.col_mut(q)[q]) = (cos, cos);
            (rotation.col_mut(p)[q], rotation.col_mut(q)[p]) = (-sin, sin);
            matrix = rotation.transpose() * matrix * rotation;
            vectors *= rotation;
        }
    }
    let values = [0, 1, 2].map(|i| matrix.col(i)[i]);
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| f64::total_cmp(&values[*a], &values[*b]));
    let [a, b, c] = order;
    (
        DVec3::new(values[a], values[b], values[c]),
        DMat3::from_cols(vectors.col(a), vectors.col(b), vectors.col(c)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Adjacency, primitives};
    use glam::DQuat;

    /// The form of a mesh of one surface that has been turned and moved, and where its second axis is then.
    fn form_of(mut mesh: Mesh) -> (FormAxis, DVec3) {
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.7, -0.3);
        for p in &mut mesh.positions {
            *p = (turn * p.as_dvec3() + DVec3::new(5.0, -2.0, 8.0)).as_vec3();
        }
        let surfaces = Adjacency::new(&mesh).surfaces(0.6);
        (form_axes(&mesh, &surfaces)[0], turn * DVec3::Y)
    }

    fn only(mesh: &mut Mesh, keeps: impl Fn([glam::Vec3; 3]) -> bool) {
        let kept: Vec<u32> =
            mesh.triangles().iter().filter(|t| keeps(mesh.corners(**t))).flatten().copied().collect();
        mesh.indices = kept;
    }

    #[test]
    fn a_part_of_a_turned_form_knows_its_axis() {
        // An egg, of which no two axes are equal but for the turning, and a quarter of it.
        for is_quarter in [false, true] {
            let mut mesh = primitives::sphere(1.0, 24, 32);
            mesh.positions.iter_mut().for_each(|p| p.y *= 2.0);
            if is_quarter {
                only(&mut mesh, |corners| corners.iter().all(|p| p.x > -0.01 && p.z > -0.01));
            }
            let (form, axis) = form_of(mesh);
            assert!(form.strength > 0.99 && form.direction.dot(axis).abs() > 0.999, "{form:?} {axis}");
        }
    }

    #[test]
    fn an_extruded_form_knows_its_axis_and_others_have_none() {
        // An ellipse, extruded.
        let mut mesh = primitives::sphere(1.0, 24, 32);
        mesh.positions.iter_mut().for_each(|p| {
            *p = glam::vec3(p.x, p.y.signum() * 2.0, p.z * 0.4);
        });
        only(&mut mesh, |corners| corners.iter().any(|p| p.y > 0.0) && corners.iter().any(|p| p.y < 0.0));
        let (form, axis) = form_of(mesh);
        assert!(form.strength > 0.99 && form.direction.dot(axis).abs() > 0.999, "{form:?} {axis}");

        let (flat, _) = form_of(primitives::plane(1.0));
        assert_eq!(flat, FormAxis::default());
        let mut potato = primitives::sphere(1.0, 24, 32);
        potato.positions.iter_mut().for_each(|p| *p *= glam::vec3(1.0, 1.8, 0.5));
        assert_eq!(form_of(potato).0.strength, 0.0);
    }
}
