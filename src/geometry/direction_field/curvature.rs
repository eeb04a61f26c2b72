//! The principal direction of the larger curvature in each triangle of a cut mesh.
//!
//! Source: Rusinkiewicz, Estimating Curvatures and Their Derivatives on Triangle Meshes, 3DPVT 2004.

use glam::{DMat3, DVec3, Vec3};
use rayon::prelude::*;

use super::cut::{CutMesh, Faces};

/// Shading normals that differ more than the angle with this cosine from the triangles' are not believed.
const MIN_COSINE: f32 = 0.7;

/// What is known of the curvature in a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Curvature {
    /// Unit vector in its plane in the direction of the largest absolute curvature; zero if it is not known.
    pub(crate) direction: Vec3,
    /// 0 where the surface is flat or bends the same in all directions, up to 1 where the direction is certain.
    pub(crate) confidence: f32,
    /// How much it bends along that direction and across it, in radians per unit length, at least 0.
    pub(crate) bends: [f32; 2],
}

/// Of every triangle. Shading normals are used where the mesh has them.
///
/// Each triangle has a say of its own, instead of tensors that are added up at the vertices: a narrow fillet bends more
/// than the cylinder beside it, but has less area.
pub(crate) fn curvatures(faces: &Faces<'_>, cut: &CutMesh) -> Vec<Curvature> {
    let normals = smooth_normals(faces, cut);
    (0..cut.triangles.len())
        .into_par_iter()
        .with_min_len(2048)
        .map(|face| {
            let triangle = cut.triangles[face].map(|v| v as usize);
            let corners = triangle.map(|v| cut.positions[v]);
            principal(faces.normals[face], corners, triangle.map(|v| normals[v]))
        })
        .collect()
}

/// The mean of the shading normals at each vertex, or the normal of the triangles where there is none to believe.
fn smooth_normals(faces: &Faces<'_>, cut: &CutMesh) -> Vec<Vec3> {
    let shading = &faces.mesh.normals;
    if shading.len() != faces.mesh.positions.len() {
        return cut.normals.clone();
    }
    let mut sums = vec![Vec3::ZERO; cut.len()];
    for (face, triangle) in faces.mesh.triangles().iter().enumerate() {
        let corners = faces.corners(face);
        for k in 0..3 {
            let angle = (corners[(k + 1) % 3] - corners[k]).angle_between(corners[(k + 2) % 3] - corners[k]);
            let weighted = shading[triangle[k] as usize] * angle;
            if weighted.is_finite() {
                sums[cut.triangles[face][k] as usize] += weighted;
            }
        }
    }
    let believed = |(sum, &normal): (Vec3, &Vec3)| {
        let mean = sum.normalize_or(normal);
        if mean.dot(normal) > MIN_COSINE { mean } else { normal }
    };
    sums.into_iter().zip(&cut.normals).map(believed).collect()
}

/// The principal direction of the tensor that explains best, in the sense of least squares, how the normals of the
/// corners of a triangle differ along its edges.
fn principal(normal: Vec3, corners: [Vec3; 3], normals: [Vec3; 3]) -> Curvature {
    let edges = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
    let longest =
        edges.iter().fold(Vec3::ZERO, |l, e| if e.length_squared() > l.length_squared() { *e } else { l });
    let size = longest.length();
    let x = longest / size;
    let y = normal.cross(x);
    // Rows (u, v, 0) and (0, u, v) of the unknowns (xx, xy, yy), with edges of about unit length. Slivers need double
    // precision.
    let mut matrix = DMat3::ZERO;
    let mut right = DVec3::ZERO;
    for k in 0..3 {
        let change = (normals[(k + 1) % 3] - normals[k]).as_dvec3();
        let edge = edges[k] / size;
        let (u, v) = (f64::from(edge.dot(x)), f64::from(edge.dot(y)));
        let (du, dv) = (change.dot(x.as_dvec3()), change.dot(y.as_dvec3()));
        matrix += DMat3::from_cols(
            DVec3::new(u * u, u * v, 0.0),
            DVec3::new(u * v, u * u + v * v, u * v),
            DVec3::new(0.0, u * v, v * v),
        );
        right += DVec3::new(u * du, u * dv + v * du, v * dv);
    }
    let [xx, xy, yy] = (matrix.inverse() * right).as_vec3().to_array().map(|k| k / size);
    let (mean, half_difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let spread = half_difference.hypot(xy);
    let (k1, k2) = ((mean + spread).abs(), (mean - spread).abs());
    if !(spread > 0.0 && spread.is_finite() && mean.is_finite()) {
        return Curvature { direction: Vec3::ZERO, confidence: 0.0, bends: [0.0; 2] };
    }
    let (sin, cos) = (0.5 * xy.atan2(half_difference)).sin_cos();
    let direction = if k1 >= k2 { x * cos + y * sin } else { y * cos - x * sin };
    let confidence = (k1 - k2).abs() / (k1 + k2 + 0.5) * (0.5 * k1.max(k2)).min(1.0);
    Curvature { direction, confidence, bends: [k1.max(k2), k1.min(k2)] }
}
