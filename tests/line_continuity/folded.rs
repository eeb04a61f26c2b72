//! A sheet with a narrow fold along its border: three lines side by side, a border, a ridge and a valley.

use std::sync::Arc;

use glam::{DMat4, DVec3, Vec3};
use hachure::geometry::primitives::from_triangles;
use hachure::scene::{Camera, Projection, Scene};

use crate::common::scene;

/// Half the length of the fold.
const HALF: f32 = 150.0;

/// A sheet in the plane z = 0 with a ridge so far from its border, and a valley as far from that.
pub(crate) fn folded_sheet(distance: f32) -> Arc<Scene> {
    let rows = [(0.0, 0.0), (distance, distance), (2.0 * distance, 0.0), (HALF, 0.0)];
    let positions = rows.iter().flat_map(|&(x, z)| [-HALF, HALF].map(|y| Vec3::new(x, y, z))).collect();
    let indices = (0..3).flat_map(|row| [0, 2, 3, 0, 3, 1].map(|corner| 2 * row + corner)).collect();
    scene(vec![("folded sheet", from_triangles(positions, indices), DMat4::IDENTITY, [0.7; 3])])
}

/// Looks at it from above, slightly turned; a unit is a pixel of a picture of this height.
pub(crate) fn from_above(height: u32) -> Camera {
    let focal_point = DVec3::new(f64::from(HALF) / 2.0, 0.0, 0.0);
    Camera {
        position: focal_point + 400.0 * DVec3::Z,
        focal_point,
        view_up: DVec3::new(0.12, 1.0, 0.0).normalize(),
        projection: Projection::Orthographic { view_height: f64::from(height) },
    }
}
