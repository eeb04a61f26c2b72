//! What the rays through the middles of all pixels meet.

use std::cell::RefCell;
use std::collections::BTreeMap;

use glam::{DMat4, DVec2, DVec3};
use hachure::geometry::{Bvh, Mesh};
use hachure::scene::{Camera, Projection};

use super::SIDE;

/// A surface that a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Along the view.
    pub depth: f64,
    pub triangle: usize,
}

/// What a ring is met by.
pub struct Cast {
    /// Per pixel, the nearest one first.
    pub hits: Vec<Vec<Hit>>,
    /// Per pixel, whether no silhouette is near, hidden ones included.
    pub is_steady: Vec<bool>,
}

impl Cast {
    pub fn new(mesh: &Mesh, place: &DMat4, camera: &Camera) -> Self {
        let corner = |v: u32| place.transform_point3(mesh.positions[v as usize].as_dvec3());
        let triangles: Vec<[DVec3; 3]> =
            mesh.indices.chunks_exact(3).map(|t| [corner(t[0]), corner(t[1]), corner(t[2])]).collect();
        let bvh = Bvh::new(&triangles);
        let hits: Vec<_> = (0..pixels()).map(|px| met(&bvh, ray(camera, px))).collect();
        let mut is_steady: Vec<bool> =
            (0..pixels()).map(|px| near(px).all(|q| hits[q].len() == hits[px].len())).collect();
        // Folds may be thinner than a pixel, so that no ray meets them, and yet have lines.
        for ends in silhouettes(&triangles, camera) {
            let [a, b] = ends.map(|end| project(camera, end));
            let steps = (2.0 * (b - a).length()).ceil().max(1.0);
            for step in 0..=steps as u32 {
                let px = a.lerp(b, f64::from(step) / steps).floor();
                if px.cmpge(DVec2::ZERO).all() && px.cmplt(DVec2::splat(f64::from(SIDE))).all() {
                    near(px.y as usize * SIDE as usize + px.x as usize).for_each(|px| is_steady[px] = false);
                }
            }
        }
        Self { hits, is_steady }
    }
}

/// The edges between triangles that face the eye and triangles that do not.
fn silhouettes(triangles: &[[DVec3; 3]], camera: &Camera) -> Vec<[DVec3; 2]> {
    let faces_eye = |[a, b, c]: &[DVec3; 3]| {
        let towards_eye = match camera.projection {
            Projection::Perspective { .. } => camera.position - *a,
            Projection::Orthographic { .. } => -camera.forward(),
        };
        (*b - *a).cross(*c - *a).dot(towards_eye) > 0.0
    };
    // Vertices that are one point are the same number exactly.
    let key = |p: DVec3| p.to_array().map(f64::to_bits);
    let mut first = BTreeMap::new();
    let mut found = Vec::new();
    for triangle in triangles {
        let [a, b, c] = *triangle;
        for ends in [[a, b], [b, c], [c, a]] {
            let mut keys = ends.map(key);
            keys.sort_unstable();
            match first.remove(&keys) {
                Some(other) if other != faces_eye(triangle) => found.push(ends),
                Some(_) => {}
                None => drop(first.insert(keys, faces_eye(triangle))),
            }
        }
    }
    assert!(first.is_empty(), "the mesh is closed");
    found
}

/// Where a point is in the picture, px.
fn project(camera: &Camera, point: DVec3) -> DVec2 {
    let from_eye = point - camera.position;
    let depth = match camera.projection {
        Projection::Perspective { .. } => from_eye.dot(camera.forward()) / camera.distance(),
        Projection::Orthographic { .. } => 1.0,
    };
    let beside = DVec2::new(from_eye.dot(camera.right()), -from_eye.dot(camera.up()));
    (beside / (depth * camera.view_height()) + 0.5) * f64::from(SIDE)
}

/// How many pixels there are.
pub fn pixels() -> usize {
    (SIDE * SIDE) as usize
}

/// All pixels at most so far away, px², this one included.
pub fn disk(px: usize, reach: i32, squared: i32) -> impl Iterator<Item = usize> {
    let side = SIDE as i32;
    let (x, y) = (px as i32 % side, px as i32 / side);
    (-reach..=reach).flat_map(move |dy| {
        (-reach..=reach).filter_map(move |dx| {
            let (x, y) = (x + dx, y + dy);
            let is_in = dx * dx + dy * dy <= squared && (0..side).contains(&x) && (0..side).contains(&y);
            is_in.then_some((y * side + x) as usize)
        })
    })
}

/// The pixels from which an edge is nearer than its lines are wide, and half a pixel more.
pub fn near(px: usize) -> impl Iterator<Item = usize> {
    disk(px, 2, 5)
}

/// Origin and direction, which is as long as the view is deep.
fn ray(camera: &Camera, px: usize) -> (DVec3, DVec3) {
    let half = camera.view_height() / 2.0;
    let side = f64::from(SIDE);
    let (x, y) = ((px % SIDE as usize) as f64 + 0.5, (px / SIDE as usize) as f64 + 0.5);
    let beside = camera.right() * (2.0 * x / side - 1.0) * half + camera.up() * (1.0 - 2.0 * y / side) * half;
    match camera.projection {
        Projection::Perspective { .. } => (camera.position, camera.forward() + beside / camera.distance()),
        Projection::Orthographic { .. } => (camera.position + beside, camera.forward()),
    }
}

fn met(bvh: &Bvh, (origin, direction): (DVec3, DVec3)) -> Vec<Hit> {
    let found = RefCell::new(Vec::new());
    bvh.any_hit(origin, direction, 0.0, f64::INFINITY, |hit| {
        found.borrow_mut().push(Hit { depth: hit.t, triangle: hit.triangle });
        true
    });
    let mut hits = found.into_inner();
    hits.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    // Two triangles that share an edge, on it.
    hits.dedup_by(|a, b| (a.depth - b.depth).abs() < 1e-9);
    hits
}
