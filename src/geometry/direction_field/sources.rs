//! Directions that do not come from the form: of texture coordinates, and of a fixed axis.

use glam::{Vec2, Vec3};

use super::cut::{CutMesh, Faces};

/// Calls `add` for each triangle with its unit direction in which the first (`axis` = 0) or second (1) texture coordinate
/// grows, and with its area; not for triangles whose texture has no area or is not finite.
pub(crate) fn along_texture(faces: &Faces<'_>, axis: usize, mut add: impl FnMut(usize, Vec3, f32)) {
    let uvs = &faces.mesh.uvs;
    if uvs.len() != faces.mesh.positions.len() {
        return;
    }
    for (face, triangle) in faces.mesh.triangles().iter().enumerate() {
        let [a, b, c] = triangle.map(|v| uvs[v as usize]);
        let corners = faces.corners(face);
        if let Some(direction) = growth(corners, [b - a, c - a], axis) {
            add(face, direction, faces.areas[face]);
        }
    }
}

/// The unit direction in which one texture coordinate grows while the other stays.
fn growth([p, q, r]: [Vec3; 3], [ab, ac]: [Vec2; 2], axis: usize) -> Option<Vec3> {
    let determinant = ab.perp_dot(ac);
    let size = ab.length() * ac.length();
    if !(determinant.abs() > 1e-6 * size && size.is_finite()) {
        return None;
    }
    let (e1, e2) = (q - p, r - p);
    let along = if axis == 0 { e1 * ac.y - e2 * ab.y } else { e2 * ab.x - e1 * ac.x };
    (along / determinant).try_normalize()
}

/// The projection of an axis on the tangent plane of each vertex; the closer it is to the normal, the shorter.
pub(crate) fn along_axis(cut: &CutMesh, axis: Vec3) -> impl Iterator<Item = Vec3> {
    let axis = axis.normalize_or(Vec3::Y);
    cut.normals.iter().map(move |&n| axis - n * axis.dot(n))
}
