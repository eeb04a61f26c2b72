//! Parts that touch: the outline of one runs along the rim of the other.

use std::sync::Arc;

use glam::{DMat4, DVec3, Vec3};
use hachure::geometry::Mesh;
use hachure::geometry::primitives::from_triangles;
use hachure::scene::Scene;

use crate::common::scene;

/// A closed cylinder about Z.
fn cylinder(radius: f32, length: f32, sides: u32) -> Mesh {
    let rim = |z: f32| {
        (0..sides).map(move |i| {
            let (sin, cos) = (i as f32 / sides as f32 * std::f32::consts::TAU).sin_cos();
            Vec3::new(radius * cos, radius * sin, z)
        })
    };
    let positions = rim(0.5 * length).chain(rim(-0.5 * length)).collect();
    let caps = (1..sides - 1).flat_map(|i| [0, i, i + 1, sides, sides + i + 1, sides + i]);
    let walls = (0..sides).flat_map(|i| {
        let j = (i + 1) % sides;
        [i, sides + i, sides + j, i, sides + j, j]
    });
    from_triangles(positions, caps.chain(walls).collect())
}

/// A flange on a hub that is a hair narrower, with another number of sides.
pub(crate) fn flange_on_hub() -> Arc<Scene> {
    let along = |z: f64| DMat4::from_translation(DVec3::Z * z);
    scene(vec![
        ("hub", cylinder(1.0, 0.6, 72), along(-0.3), [0.7; 3]),
        ("flange", cylinder(1.004, 0.3, 64), along(0.15), [0.7; 3]),
    ])
}
