//! The curved surfaces that meshes stand for, and which silhouettes of triangles are lines of them.
//!
//! The silhouette of triangles goes to and fro around that of the surface that they stand for: beside it lie barbs and double
//! lines that nobody would draw. How that surface bends is found another way than by the renderer: with PN triangles (Vlachos et
//! al. 2001, "Curved PN Triangles"), whose silhouettes are those of a mesh that is finer by far.

use glam::{DVec2, DVec3, Vec3};
use hachure::geometry::line_score::TOLERANCE;
use hachure::geometry::normals::by_crease_angle;
use hachure::geometry::primitives::from_triangles;
use hachure::geometry::visible_edges::{EdgeSample, EdgeScene, LineRules, PlacedMesh, VisibleEdges};
use hachure::geometry::{Adjacency, EdgeClass, Mesh, Projector};
use hachure::scene::Scene;

/// Rows of small triangles in each triangle.
const ROWS: u32 = 4;
/// Degrees; what bends by more is an edge of the surface too.
const CREASE: f32 = 30.0;

/// The curved surfaces of the objects of a scene.
pub struct CurvedSurfaces {
    fine: EdgeScene,
    /// Corners of the triangles of the meshes themselves, in world space.
    triangles: Vec<[DVec3; 3]>,
}

impl CurvedSurfaces {
    /// Of the objects of a scene.
    pub fn new(scene: &Scene) -> Self {
        let meshes: Vec<Mesh> = scene.meshes.iter().map(|mesh| curved(mesh)).collect();
        let adjacencies: Vec<Adjacency> = meshes.iter().map(Adjacency::new).collect();
        let objects = || scene.nodes.iter().filter_map(|node| Some((node.mesh?, node.world_from_local)));
        let fine: Vec<PlacedMesh<'_>> = (0..)
            .zip(objects())
            .map(|(object, (mesh, world_from_local))| PlacedMesh {
                mesh: &meshes[mesh],
                adjacency: &adjacencies[mesh],
                world_from_local,
                object,
            })
            .collect();
        let triangles = objects().flat_map(|(mesh, world_from_local)| {
            let place = move |p: Vec3| world_from_local.transform_point3(p.as_dvec3());
            let mesh = &scene.meshes[mesh];
            mesh.triangles().iter().map(move |&t| mesh.corners(t).map(place))
        });
        Self { fine: EdgeScene::new(&fine), triangles: triangles.collect() }
    }

    /// The visible edges of the meshes without silhouettes that are none of the curved surface: before more of their own object,
    /// and with none of its silhouettes near them.
    pub fn lines_of(
        &self,
        edges: &VisibleEdges,
        projector: &Projector,
        rules: &LineRules<'_>,
    ) -> VisibleEdges {
        let side = projector.size[0] as usize;
        let outlines = [EdgeClass::Silhouette, EdgeClass::Border, EdgeClass::Object];
        let fine = self.fine.visible(projector, &LineRules { classes: &outlines, ..*rules });
        let mut near = vec![false; side * side];
        for sample in fine.samples.iter().flatten() {
            mark(&mut near, side, sample.position);
        }
        self.mark_background(&mut near, projector);
        let is_line = |sample: &EdgeSample| {
            let [x, y] = sample.position.as_i64vec2().to_array();
            let is_inside = (0..side as i64).contains(&x) && (0..side as i64).contains(&y);
            is_inside && near[y as usize * side + x as usize]
        };
        let mut lines = edges.clone();
        lines.samples[EdgeClass::Silhouette as usize].retain(is_line);
        lines
    }

    /// Marks the pixels near those in which there is nothing.
    fn mark_background(&self, near: &mut [bool], projector: &Projector) {
        let side = projector.size[0] as usize;
        let mut is_covered = vec![false; side * side];
        for corners in &self.triangles {
            let corners = corners.map(|p| projector.view_from_world.transform_point3(p));
            if corners.iter().any(|p| -p.z < projector.near) {
                continue;
            }
            cover(&mut is_covered, side, corners.map(|p| projector.pixel(p)));
        }
        let empty = (0..side * side).filter(|&at| !is_covered[at]);
        for at in empty {
            mark(near, side, DVec2::new((at % side) as f64 + 0.5, (at / side) as f64 + 0.5));
        }
    }
}

/// Marks the pixels whose centers are within the tolerance of that of the pixel of a position.
fn mark(near: &mut [bool], side: usize, position: DVec2) {
    let reach = TOLERANCE.floor() as i64;
    let [x, y] = position.floor().as_i64vec2().to_array();
    let within = |c: i64| (c - reach).max(0)..(c + reach + 1).min(side as i64);
    for y in within(y) {
        for x in within(x) {
            near[y as usize * side + x as usize] = true;
        }
    }
}

/// Marks the pixels whose centers lie in a triangle.
fn cover(is_covered: &mut [bool], side: usize, [a, b, c]: [DVec2; 3]) {
    let (low, high) = (a.min(b).min(c).floor(), a.max(b).max(c).ceil());
    let within =
        |low: f64, high: f64| low.clamp(0.0, side as f64) as usize..high.clamp(0.0, side as f64) as usize;
    for y in within(low.y, high.y) {
        for x in within(low.x, high.x) {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(p - from));
            if sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0) {
                is_covered[y * side + x] = true;
            }
        }
    }
}

/// The PN triangles of a mesh, as small triangles.
fn curved(mesh: &Mesh) -> Mesh {
    let smooth = if mesh.normals.is_empty() { by_crease_angle(mesh.clone(), CREASE) } else { mesh.clone() };
    let mut positions = Vec::new();
    let mut indices = Vec::new();
    for &corners in smooth.triangles() {
        let patch = Patch::new(smooth.corners(corners), corners.map(|v| smooth.normals[v as usize]));
        let first = positions.len() as u32;
        // Row by row towards the first corner, each shorter by one.
        let number = |row: u32, place: u32| first + row * (2 * ROWS + 3 - row) / 2 + place;
        for row in 0..=ROWS {
            for place in 0..=ROWS - row {
                let v = place as f32 / ROWS as f32;
                let w = row as f32 / ROWS as f32;
                positions.push(patch.at(Vec3::new(1.0 - v - w, v, w)));
                if row + place < ROWS {
                    indices.extend([number(row, place), number(row, place + 1), number(row + 1, place)]);
                }
                if row + place + 1 < ROWS {
                    let [right, above] = [number(row, place + 1), number(row + 1, place)];
                    indices.extend([right, number(row + 1, place + 1), above]);
                }
            }
        }
    }
    from_triangles(positions, indices)
}

/// A cubic Bézier triangle over a triangle with normals.
struct Patch {
    corners: [Vec3; 3],
    /// Of each side, from each corner on, the control point next to its first end and that next to its last one.
    sides: [[Vec3; 2]; 3],
    middle: Vec3,
}

impl Patch {
    fn new(corners: [Vec3; 3], normals: [Vec3; 3]) -> Self {
        let beside = |from: usize, to: usize| {
            let (p, n) = (corners[from], normals[from]);
            (2.0 * p + corners[to] - n * (corners[to] - p).dot(n)) / 3.0
        };
        let sides = [0, 1, 2].map(|i| [beside(i, (i + 1) % 3), beside((i + 1) % 3, i)]);
        let mean = sides.iter().flatten().sum::<Vec3>() / 6.0;
        Self { corners, sides, middle: mean + (mean - corners.iter().sum::<Vec3>() / 3.0) / 2.0 }
    }

    /// At these weights of its corners.
    fn at(&self, weights: Vec3) -> Vec3 {
        let w = weights.to_array();
        let mut point = 6.0 * w[0] * w[1] * w[2] * self.middle;
        for i in 0..3 {
            let (own, next) = (w[i], w[(i + 1) % 3]);
            point += own * own * own * self.corners[i];
            point += 3.0 * own * next * (own * self.sides[i][0] + next * self.sides[i][1]);
        }
        point
    }
}
