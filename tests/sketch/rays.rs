//! What rays through the middles of all pixels meet first.

use glam::DVec3;
use hachure::export::session::Opened;
use hachure::geometry::Bvh;
use hachure::scene::{NodeId, Projection};
use rayon::prelude::*;

/// Depths along the view of what some nodes have at each pixel; infinite: nothing.
pub fn cast(opened: &Opened, side: u32, nodes: &[NodeId]) -> Vec<f64> {
    let camera = opened.document.camera.unwrap();
    let triangles: Vec<[DVec3; 3]> = nodes
        .iter()
        .flat_map(|node| {
            let node = &opened.scene.nodes[*node];
            let mesh = &opened.scene.meshes[node.mesh.unwrap()];
            let corner =
                |v: u32| node.world_from_local.transform_point3(mesh.positions[v as usize].as_dvec3());
            mesh.indices
                .chunks_exact(3)
                .map(|t| [corner(t[0]), corner(t[1]), corner(t[2])])
                .collect::<Vec<_>>()
        })
        .collect();
    let bvh = Bvh::new(&triangles);
    let half = camera.view_height() / 2.0;
    let (forward, right, up, distance) = (camera.forward(), camera.right(), camera.up(), camera.distance());
    let ray = |px: u32| {
        let middle = |c: u32| 2.0 * (f64::from(c) + 0.5) / f64::from(side) - 1.0;
        let beside = right * middle(px % side) * half - up * middle(px / side) * half;
        match camera.projection {
            Projection::Perspective { .. } => (camera.position, forward + beside / distance),
            Projection::Orthographic { .. } => (camera.position + beside, forward),
        }
    };
    let depth = |px: u32| {
        let (origin, direction) = ray(px);
        bvh.closest_hit(origin, direction, 0.0, f64::INFINITY, |_| false).map_or(f64::INFINITY, |hit| hit.t)
    };
    (0..side * side).into_par_iter().map(depth).collect()
}

/// Of each pixel, what `pick` leaves of all values at most so far away in x and y.
pub fn around(values: &[f64], side: u32, reach: usize, pick: fn(f64, f64) -> f64) -> Vec<f64> {
    let side = side as usize;
    let along = |values: &[f64], step: usize, at: &dyn Fn(usize) -> usize| -> Vec<f64> {
        (0..values.len())
            .map(|px| {
                let own = at(px);
                let (first, last) = (own.min(reach), (side - 1 - own).min(reach));
                (px - first * step..=px + last * step).step_by(step).map(|q| values[q]).reduce(pick).unwrap()
            })
            .collect()
    };
    let rows = along(values, 1, &|px| px % side);
    along(&rows, side, &|px| px / side)
}

/// By how much more than a depth another one is, in pixels' widths, as the renderer counts.
pub fn step_px(opened: &Opened, side: u32, near: f64, far: f64) -> f64 {
    let camera = opened.document.camera.unwrap();
    let height = camera.view_height();
    match camera.projection {
        _ if near == f64::INFINITY => f64::NEG_INFINITY,
        _ if far == f64::INFINITY => f64::INFINITY,
        Projection::Perspective { .. } => (far / near - 1.0) * f64::from(side) * camera.distance() / height,
        Projection::Orthographic { .. } => (far - near) * f64::from(side) / height,
    }
}
