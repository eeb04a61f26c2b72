//! Angles between triangles as they are placed: placements that are no similarity change them.

use std::f32::consts::PI;

use glam::{DMat3, DMat4};

use crate::geometry::Mesh;
use crate::geometry::feature_edges::Traits;

/// How much the axes of a placement may differ in length or from right angles and still count as a similarity.
const SIMILAR: f64 = 1e-5;

/// The angles of one object.
pub(super) struct Angles<'a> {
    mesh: &'a Mesh,
    /// What bends the angles; `None`: they are as they were made.
    placement: Option<DMat3>,
    /// Upper bound of the ratio of the placement's greatest to its least scale.
    condition_number: f64,
}

impl<'a> Angles<'a> {
    pub(super) fn new(mesh: &'a Mesh, view_from_local: &DMat4) -> Self {
        let linear = DMat3::from_mat4(*view_from_local);
        let products = linear.transpose() * linear;
        let scale = (products.x_axis.x + products.y_axis.y + products.z_axis.z) / 3.0;
        let off = products - DMat3::from_diagonal(glam::DVec3::splat(scale));
        let is_similarity = off.to_cols_array().into_iter().all(|x| x.abs() <= SIMILAR * scale);
        let norm = |m: DMat3| m.to_cols_array().into_iter().map(|x| x * x).sum::<f64>().sqrt();
        Self {
            mesh,
            placement: (!is_similarity).then_some(linear),
            condition_number: if is_similarity { 1.0 } else { norm(linear) * norm(linear.inverse()) },
        }
    }

    /// The least angle in local space that can appear as this one (radians).
    pub(super) fn min_local(&self, angle: f32) -> f32 {
        if self.placement.is_none() || angle > PI {
            return angle;
        }
        // A linear map changes the tangents of half-angles by its condition number at most.
        let local = 2.0 * ((0.5 * f64::from(angle)).tan() / self.condition_number).atan();
        if local.is_finite() { 0.999 * local as f32 } else { 0.0 }
    }

    /// The angle between two triangles; `dihedral` is the one in local space.
    pub(super) fn of(&self, faces: [u32; 2], dihedral: f32, traits: Traits) -> f32 {
        let Some(placement) = self.placement else { return dihedral };
        let triangles = faces.map(|face| self.mesh.triangles().get(face as usize));
        let [Some(&one), Some(&two)] = triangles else { return dihedral };
        let angle = |linear: DMat3| {
            let [n, m] = [one, two].map(|triangle| {
                let [a, b, c] = self.mesh.corners(triangle).map(|p| p.as_dvec3());
                (linear * (b - a)).cross(linear * (c - a)).normalize_or_zero()
            });
            let m = if traits.any(Traits::FLIPPED) { -m } else { m };
            n.cross(m).length().atan2(n.dot(m)) as f32
        };
        // What the edge counts for may be another angle than the one of its triangles: then as many times that of these.
        let own = angle(DMat3::IDENTITY);
        let times = if own > 0.0 { dihedral.abs() / own } else { 1.0 };
        // Convex stays convex, mirrored or not.
        (times * angle(placement)).min(PI).copysign(dihedral)
    }
}
