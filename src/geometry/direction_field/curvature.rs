//! The principal direction of the larger curvature at each vertex of a cut mesh.
//!
//! Source: Rusinkiewicz, Estimating Curvatures and Their Derivatives on Triangle Meshes, 3DPVT 2004, with tensors that
//! are added in space instead of from plane to plane.

use glam::{Mat3, Vec3};
use rayon::prelude::*;

use super::cut::{CutMesh, Faces};

/// Shading normals that differ more than the angle with this cosine from the triangles' are not believed.
const LEAST_COSINE: f32 = 0.7;

/// What is known of the curvature at a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Curvature {
    /// Unit vector in the tangent plane in the direction of the largest absolute curvature; zero if it is not known.
    pub(crate) direction: Vec3,
    /// 0 where the surface is flat or bends the same in all directions, up to 1 where the direction is certain.
    pub(crate) confidence: f32,
}

/// Of every vertex. Shading normals are used where the mesh has them.
pub(crate) fn curvatures(faces: &Faces<'_>, cut: &CutMesh) -> Vec<Curvature> {
    let normals = smooth_normals(faces, cut);
    let tensors: Vec<Mat3> = (0..cut.triangles.len())
        .into_par_iter()
        .with_min_len(2048)
        .map(|face| {
            let triangle = cut.triangles[face].map(|v| v as usize);
            let tensor = face_tensor(
                faces.normals[face],
                triangle.map(|v| cut.positions[v]),
                triangle.map(|v| normals[v]),
            );
            let area = faces.areas[face];
            if area > 0.0 && tensor.is_finite() { tensor * (area / 3.0) } else { Mat3::ZERO }
        })
        .collect();
    let mut sums = vec![Mat3::ZERO; cut.len()];
    for (triangle, tensor) in cut.triangles.iter().zip(&tensors) {
        for &v in triangle {
            sums[v as usize] += *tensor;
        }
    }
    sums.par_iter()
        .with_min_len(2048)
        .enumerate()
        .map(|(v, sum)| principal(*sum, cut.areas[v], cut.normals[v]))
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
        if mean.dot(normal) > LEAST_COSINE { mean } else { normal }
    };
    sums.into_iter().zip(&cut.normals).map(believed).collect()
}

/// The curvature tensor in space that explains best, in the sense of least squares, how the normals of the corners
/// differ along the edges of a triangle.
fn face_tensor(normal: Vec3, corners: [Vec3; 3], normals: [Vec3; 3]) -> Mat3 {
    let edges = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
    let longest =
        edges.iter().fold(Vec3::ZERO, |l, e| if e.length_squared() > l.length_squared() { *e } else { l });
    let size = longest.length();
    let tangent = longest / size;
    let bitangent = normal.cross(tangent);
    // Rows (u, v, 0) and (0, u, v) of the unknowns (E, F, G), with edges of about unit length.
    let mut matrix = Mat3::ZERO;
    let mut right = Vec3::ZERO;
    for k in 0..3 {
        let change = normals[(k + 1) % 3] - normals[k];
        let (u, v) = (edges[k].dot(tangent) / size, edges[k].dot(bitangent) / size);
        let (du, dv) = (change.dot(tangent), change.dot(bitangent));
        matrix += Mat3::from_cols(
            Vec3::new(u * u, u * v, 0.0),
            Vec3::new(u * v, u * u + v * v, u * v),
            Vec3::new(0.0, u * v, v * v),
        );
        right += Vec3::new(u * du, u * dv + v * du, v * dv);
    }
    let [e, f, g] = (matrix.inverse() * right / size).to_array();
    let outer = |a: Vec3, b: Vec3| Mat3::from_cols(a * b.x, a * b.y, a * b.z);
    let mixed = outer(tangent, bitangent);
    outer(tangent, tangent) * e + (mixed + mixed.transpose()) * f + outer(bitangent, bitangent) * g
}

/// The eigenvector of the larger absolute eigenvalue in the tangent plane.
fn principal(sum: Mat3, area: f32, normal: Vec3) -> Curvature {
    let (x, y) = normal.any_orthonormal_pair();
    let tensor = sum * (1.0 / area.max(f32::MIN_POSITIVE));
    let (xx, xy, yy) = (x.dot(tensor * x), x.dot(tensor * y), y.dot(tensor * y));
    let (mean, half_difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let spread = half_difference.hypot(xy);
    let (k1, k2) = (mean + spread, mean - spread);
    if !(spread > 0.0 && spread.is_finite() && mean.is_finite()) {
        return Curvature { direction: Vec3::ZERO, confidence: 0.0 };
    }
    let angle = 0.5 * xy.atan2(half_difference);
    let (sin, cos) = angle.sin_cos();
    let direction = if k1.abs() >= k2.abs() { x * cos + y * sin } else { y * cos - x * sin };
    let largest = k1.abs().max(k2.abs());
    let confidence = (k1.abs() - k2.abs()).abs() / (k1.abs() + k2.abs() + 0.5) * (0.5 * largest).min(1.0);
    Curvature { direction, confidence }
}
