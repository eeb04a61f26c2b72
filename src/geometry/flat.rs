//! Whether a mesh is one flat face, and in which plane.

use glam::{DMat3, DMat4, DVec3, DVec4};

use super::Mesh;

/// How far the vertices of a flat mesh may lie off its plane, as a share of its diagonal.
const TOLERANCE: f64 = 1e-3;

/// A plane with a front: `normal` is a unit vector, and the front is the side to which it points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A point on it.
    pub point: DVec3,
    /// Unit vector towards its front.
    pub normal: DVec3,
}

/// Why a mesh lies in no plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NotFlat {
    /// It has no triangle with an area.
    #[error("its surface has no area")]
    NoArea,
    /// Some vertices lie off any plane.
    #[error("its surface is not flat")]
    Curved,
}

impl Plane {
    /// The plane of a mesh's triangles, local space. Its front is that of most of their area; where as much area shows
    /// to one side as to the other, that of the largest triangle.
    ///
    /// # Errors
    /// [`NotFlat`].
    pub fn of_mesh(mesh: &Mesh) -> Result<Self, NotFlat> {
        let bounds = mesh.bounds();
        let diagonal = bounds.diagonal();
        let mut sum = DVec3::ZERO;
        let mut largest = DVec3::ZERO;
        for &triangle in mesh.triangles() {
            let [a, b, c] = mesh.corners(triangle).map(|p| p.as_dvec3());
            let area = (b - a).cross(c - a);
            sum += area;
            if area.length_squared() > largest.length_squared() {
                largest = area;
            }
        }
        let min_area = 1e-12 * diagonal * diagonal;
        // NaN fails here too.
        if !(largest.length() > min_area && largest.is_finite()) {
            return Err(NotFlat::NoArea);
        }
        let normal = largest.normalize();
        let normal = if sum.dot(normal) < -min_area { -normal } else { normal };
        let mut used = mesh.indices.iter().filter_map(|&v| mesh.positions.get(v as usize));
        let point = used.next().map_or(bounds.center(), |p| p.as_dvec3());
        let is_flat = used.all(|p| normal.dot(p.as_dvec3() - point).abs() <= TOLERANCE * diagonal);
        if is_flat { Ok(Self { point, normal }) } else { Err(NotFlat::Curved) }
    }

    /// The same plane after an affine map; its front stays on the same side of it.
    ///
    /// # Errors
    /// [`NotFlat::NoArea`] when the map leaves nothing of it.
    pub fn transformed(&self, b_from_a: &DMat4) -> Result<Self, NotFlat> {
        let m = DMat3::from_mat4(*b_from_a);
        let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let normal = cofactors * self.normal * m.determinant().signum();
        let normal = normal.try_normalize().ok_or(NotFlat::NoArea)?;
        Ok(Self { point: b_from_a.transform_point3(self.point), normal })
    }

    /// Its distance function: the product with (point, 1) is how far before its front a point lies.
    pub fn equation(&self) -> DVec4 {
        self.normal.extend(-self.normal.dot(self.point))
    }

    /// The reflection at it.
    pub fn reflection(&self) -> DMat4 {
        let n = self.normal;
        let linear = DMat3::IDENTITY - 2.0 * DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        DMat4::from_mat3_translation(linear, 2.0 * n.dot(self.point) * n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives;
    use glam::Vec3;

    #[test]
    fn a_face_is_flat_and_a_cube_is_not() {
        let plane = Plane::of_mesh(&primitives::plane(2.0)).unwrap();
        assert!(plane.normal.abs().max_element() > 1.0 - 1e-9);
        assert_eq!(Plane::of_mesh(&primitives::cube(1.0)), Err(NotFlat::Curved));
        assert_eq!(Plane::of_mesh(&Mesh::default()), Err(NotFlat::NoArea));
        let line = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0],
            indices: vec![0, 1, 2],
            ..Mesh::default()
        };
        assert_eq!(Plane::of_mesh(&line), Err(NotFlat::NoArea));
    }

    #[test]
    fn its_front_stays_its_front_under_any_map_and_a_reflection_keeps_the_plane() {
        let plane = Plane { point: DVec3::new(1.0, 2.0, 3.0), normal: DVec3::new(0.6, 0.0, 0.8) };
        let before = plane.point + plane.normal;
        let maps = [
            DMat4::from_scale(DVec3::new(-1.0, 2.0, 3.0)),
            DMat4::from_rotation_x(1.0) * DMat4::from_scale(DVec3::new(1.0, 0.1, 4.0)),
        ];
        for map in maps {
            let moved = plane.transformed(&map).unwrap();
            assert!(moved.equation().dot(map.transform_point3(before).extend(1.0)) > 0.0);
            assert!(moved.equation().dot(map.transform_point3(plane.point).extend(1.0)).abs() < 1e-9);
        }
        assert_eq!(plane.transformed(&DMat4::from_scale(DVec3::ZERO)), Err(NotFlat::NoArea));
        let mirrored = plane.reflection().transform_point3(before);
        assert!((mirrored - (plane.point - plane.normal)).length() < 1e-12);
    }
}
