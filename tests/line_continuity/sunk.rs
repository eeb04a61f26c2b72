//! Sheets that end just behind the wall that they stand on: the wall hides where they end.

use std::sync::Arc;

use glam::{DMat4, Vec3};
use hachure::geometry::primitives::from_triangles;
use hachure::scene::Scene;

use crate::common::scene;

/// A square frame of thin walls on a larger square at z = 0, all of it one mesh; it ends so far behind the square.
pub(crate) fn frame_on_wall(depth: f32) -> Arc<Scene> {
    let square = |side: f32, z: f32| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| Vec3::new(0.5 * side * x, 0.5 * side * y, z))
    };
    let positions = [square(4.0, 0.0), square(1.0, -depth), square(1.0, 0.4)].concat();
    let sides = (0..4).flat_map(|i| {
        let [a, b, c, d] = [4 + i, 4 + (i + 1) % 4, 8 + (i + 1) % 4, 8 + i];
        [a, b, c, a, c, d]
    });
    let mesh = from_triangles(positions, [0, 1, 2, 0, 2, 3].into_iter().chain(sides).collect());
    scene(vec![("frame on wall", mesh, DMat4::IDENTITY, [0.7; 3])])
}
