//! Triangles in space on their way to a mesh: welding, creases, shading normals.

use std::collections::BTreeMap;

use glam::{DMat3, DVec2, DVec3, Vec3, dvec3};

use crate::glb::Mesh;
use crate::sets::{root, unite};

/// A surface, closed unless it is a leaf or a pane, as loose triangles, counter-clockwise from outside, in millimeters.
#[derive(Default, Clone)]
pub(crate) struct Solid {
    /// Corner positions.
    pub(crate) triangles: Vec<[DVec3; 3]>,
    /// Texture coordinates of the same corners, (0, 0) = upper left of the image, or none at all.
    pub(crate) uvs: Vec<[DVec2; 3]>,
}

/// A point of a textured surface and its texture coordinates.
pub(crate) type Corner = (DVec3, DVec2);

/// Which way a part's own `w` axis points in the model; its `v` axis stays in the plane of the drawing.
#[derive(Clone, Copy)]
pub(crate) enum Axis {
    /// Along the crankshaft; `v` up.
    X,
    /// Upwards.
    Y,
    /// Downwards.
    Down,
}

impl Axis {
    /// The rotation `model_from_part`.
    fn matrix(self) -> DMat3 {
        let (u, v, w) = match self {
            Self::X => (-DVec3::Z, DVec3::Y, DVec3::X),
            Self::Y => (DVec3::Z, DVec3::X, DVec3::Y),
            Self::Down => (DVec3::Z, -DVec3::X, -DVec3::Y),
        };
        DMat3::from_cols(u, v, w)
    }
}

impl Solid {
    /// Adds a triangle.
    pub(crate) fn triangle(&mut self, a: DVec3, b: DVec3, c: DVec3) {
        self.triangles.push([a, b, c]);
    }

    /// Adds a quadrilateral, cut along its shorter diagonal.
    pub(crate) fn quad(&mut self, a: DVec3, b: DVec3, c: DVec3, d: DVec3) {
        let corners = [a, b, c, d];
        self.triangles.extend(halves(corners).map(|half| half.map(|i| corners[i])));
    }

    /// Adds the band between two closed rings of equally many points; the second lies above the first when the rings
    /// run counter-clockwise from above.
    pub(crate) fn band(&mut self, low: &[DVec3], high: &[DVec3]) {
        let n = low.len();
        for i in 0..n {
            let j = (i + 1) % n;
            self.quad(low[i], low[j], high[j], high[i]);
        }
    }

    /// Adds the sheet between rows of equally many corners. A row that runs counter-clockwise from above lies below
    /// the next one, so that the sheet faces outwards and an image that follows it is not mirrored.
    pub(crate) fn sheet(&mut self, rows: &[Vec<Corner>]) {
        for pair in rows.windows(2) {
            for (low, high) in pair[0].windows(2).zip(pair[1].windows(2)) {
                let corners = [low[0], low[1], high[1], high[0]];
                for half in halves(corners.map(|corner| corner.0)) {
                    self.triangles.push(half.map(|i| corners[i].0));
                    self.uvs.push(half.map(|i| corners[i].1));
                }
            }
        }
    }

    /// The same surface, textured: `uv` gives the coordinates for a point and its triangle's unit normal.
    pub(crate) fn mapped(mut self, uv: impl Fn(DVec3, DVec3) -> DVec2) -> Self {
        let corners = self.triangles.iter().map(|&[a, b, c]| {
            let normal = (b - a).cross(c - a).normalize();
            [a, b, c].map(|p| uv(p, normal))
        });
        self.uvs = corners.collect();
        self
    }

    /// The same surface with each point where `to` puts it.
    pub(crate) fn bent(mut self, to: impl Fn(DVec3) -> DVec3) -> Self {
        for corner in self.triangles.iter_mut().flatten() {
            *corner = to(*corner);
        }
        self
    }

    /// The same surface with its `w` axis along `axis`.
    pub(crate) fn along(mut self, axis: Axis) -> Self {
        let matrix = axis.matrix();
        for corner in self.triangles.iter_mut().flatten() {
            *corner = matrix * *corner;
        }
        self
    }

    /// The same surface, moved.
    pub(crate) fn moved(mut self, x: f64, y: f64, z: f64) -> Self {
        for corner in self.triangles.iter_mut().flatten() {
            *corner += dvec3(x, y, z);
        }
        self
    }

    /// Welds the triangles into a mesh in meters. Edges that turn by more than `crease` degrees stay hard.
    pub(crate) fn into_mesh(self, name: &str, material: usize, crease: f64) -> Mesh {
        let (points, faces, uvs) = self.welded();
        let normals: Vec<DVec3> = faces
            .iter()
            .map(|f| {
                let [a, b, c] = f.map(|i| points[i].as_dvec3());
                (b - a).cross(c - a)
            })
            .collect();
        let fans = smooth_fans(&faces, &normals, crease.to_radians().cos());
        let mut mesh = Mesh {
            name: name.to_owned(),
            positions: Vec::new(),
            normals: Vec::new(),
            uvs: Vec::new(),
            indices: Vec::new(),
            material,
        };
        // Large faces weigh most, so that planes beside a rounded rim stay flat in shading. A seam of the texture
        // parts vertices, not the normal.
        let mut sums: BTreeMap<usize, DVec3> = BTreeMap::new();
        let mut vertices: BTreeMap<(usize, [u32; 2]), usize> = BTreeMap::new();
        for (corner, &fan) in fans.iter().enumerate() {
            let (face, k) = (corner / 3, corner % 3);
            let [p, q, r] = [0, 1, 2].map(|d| points[faces[face][(k + d) % 3]].as_dvec3());
            let angle = (q - p).angle_between(r - p);
            *sums.entry(fan).or_default() += normals[face] * angle;
            let uv = uvs.get(face).map(|uvs| uvs[k].as_vec2());
            let next = vertices.len();
            let vertex =
                *vertices.entry((fan, uv.unwrap_or_default().to_array().map(f32::to_bits))).or_insert(next);
            if vertex == next {
                mesh.positions.push(p.as_vec3().to_array());
                mesh.uvs.extend(uv.map(|uv| uv.to_array()));
            }
            mesh.indices.push(vertex as u32);
        }
        mesh.normals = vec![[0.0; 3]; vertices.len()];
        for (&(fan, _), &vertex) in &vertices {
            mesh.normals[vertex] = sums[&fan].normalize().as_vec3().to_array();
        }
        mesh
    }

    /// Points in meters, triangles between them and those triangles' texture coordinates, if there are any; triangles
    /// that vanish in the weld are left out.
    fn welded(&self) -> (Vec<Vec3>, Vec<[usize; 3]>, Vec<[DVec2; 3]>) {
        let mut index_of: BTreeMap<[i64; 3], usize> = BTreeMap::new();
        let mut points = Vec::new();
        let mut faces = Vec::new();
        let mut uvs = Vec::new();
        for (t, triangle) in self.triangles.iter().enumerate() {
            let face = triangle.map(|p| {
                // A hundred-thousandth of a millimeter.
                let key = (p * 1e5).round().to_array().map(|v| v as i64);
                *index_of.entry(key).or_insert_with(|| {
                    points.push((p * 1e-3).as_vec3());
                    points.len() - 1
                })
            });
            if face[0] != face[1] && face[1] != face[2] && face[2] != face[0] {
                faces.push(face);
                uvs.extend(self.uvs.get(t));
            }
        }
        (points, faces, uvs)
    }
}

/// The triangles of a quadrilateral that is cut along its shorter diagonal.
fn halves([a, b, c, d]: [DVec3; 4]) -> [[usize; 3]; 2] {
    if a.distance_squared(c) <= b.distance_squared(d) * 1.000_001 {
        [[0, 1, 2], [0, 2, 3]]
    } else {
        [[0, 1, 3], [1, 2, 3]]
    }
}

/// For each corner of each face the smallest corner number that it reaches around its point without crossing a crease.
fn smooth_fans(faces: &[[usize; 3]], normals: &[DVec3], cosine: f64) -> Vec<usize> {
    let mut fan: Vec<usize> = (0..faces.len() * 3).collect();
    let mut beside: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (f, face) in faces.iter().enumerate() {
        for k in 0..3 {
            beside.insert((face[k], face[(k + 1) % 3]), f * 3 + k);
        }
    }
    for (&(a, b), &here) in &beside {
        let Some(&there) = beside.get(&(b, a)) else {
            continue;
        };
        let (n, m) = (normals[here / 3], normals[there / 3]);
        if n.dot(m) < cosine * n.length() * m.length() {
            continue;
        }
        unite(&mut fan, here, next_in(there));
        unite(&mut fan, next_in(here), there);
    }
    (0..fan.len()).map(|i| root(&fan, i)).collect()
}

/// The corner after this one in its triangle.
fn next_in(corner: usize) -> usize {
    corner / 3 * 3 + (corner % 3 + 1) % 3
}
