//! Simple shapes for tests, examples and benchmarks, centered on the origin, with material 0.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::{Mesh, Submesh};

/// A mesh of these positions and triangles, in one submesh with material 0.
pub fn from_triangles(positions: Vec<Vec3>, indices: Vec<u32>) -> Mesh {
    let submeshes = vec![Submesh { first_index: 0, index_count: indices.len() as u32, material: 0 }];
    Mesh { positions, indices, submeshes, ..Mesh::default() }
}

/// A flat-shaded cube with edges of length `size`: 8 shared corners, 12 triangles, no normals.
pub fn cube(size: f32) -> Mesh {
    let h = size * 0.5;
    let corner = |i: u32| {
        let at = |bit: u32| if i >> bit & 1 == 0 { -h } else { h };
        Vec3::new(at(0), at(1), at(2))
    };
    let quads: [[u32; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let indices = quads.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]).collect();
    from_triangles((0..8).map(corner).collect(), indices)
}

/// A cube as [`cube`], with 24 corners: each side has its own four, with normals and with texture coordinates from
/// (0,0) to (1,1).
pub fn cube_split(size: f32) -> Mesh {
    let shared = cube(size);
    let mut mesh = from_triangles(Vec::new(), Vec::new());
    for quad in shared.indices.chunks_exact(6) {
        let base = mesh.positions.len() as u32;
        let corners = [quad[0], quad[1], quad[2], quad[5]].map(|v| shared.positions[v as usize]);
        let normal = super::normals::face_normal([corners[0], corners[1], corners[2]]);
        mesh.positions.extend(corners);
        mesh.normals.extend([normal; 4]);
        mesh.uvs.extend([Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 0.0)]);
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|k| base + k));
    }
    mesh.submeshes[0].index_count = mesh.indices.len() as u32;
    mesh
}

/// A smooth sphere with its poles on ±Y: `rings` bands from pole to pole (at least 2) of `segments` quads (at least
/// 3), triangles at the poles. Texture coordinates run once around and from pole to pole; their seam is split.
pub fn sphere(radius: f32, rings: u32, segments: u32) -> Mesh {
    let (rings, segments) = (rings.max(2), segments.max(3));
    let mut mesh = grid(segments, rings, |u, v| {
        let (sin_polar, cos_polar) = (v * PI).sin_cos();
        let (sin, cos) = (u * TAU).sin_cos();
        // The poles and the seam are exact, so that they weld.
        let sin_polar = if v == 0.0 || v == 1.0 { 0.0 } else { sin_polar };
        let (sin, cos) = if u == 1.0 { (0.0, 1.0) } else { (sin, cos) };
        let normal = Vec3::new(cos * sin_polar, cos_polar, -sin * sin_polar);
        (normal * radius, normal)
    });
    // At the poles one half of each quad has no area.
    let triangles = mesh.triangles();
    let (first_ring, last_ring) = (2 * segments as usize, triangles.len() - 2 * segments as usize);
    mesh.indices = triangles
        .iter()
        .enumerate()
        .filter(|&(t, _)| match t % 2 {
            0 => t < last_ring,
            _ => t >= first_ring,
        })
        .flat_map(|(_, triangle)| *triangle)
        .collect();
    mesh.submeshes[0].index_count = mesh.indices.len() as u32;
    mesh.without_unused_vertices()
}

/// A smooth torus around the Y axis: `major` is the radius of the circle that the tube follows, `minor` that of the
/// tube; `segments` around the axis and `sides` around the tube, at least 3 each. Texture seams are split.
pub fn torus(major: f32, minor: f32, segments: u32, sides: u32) -> Mesh {
    grid(segments.max(3), sides.max(3), |u, v| {
        let (u, v) = (u % 1.0, v % 1.0);
        let (sin, cos) = (u * TAU).sin_cos();
        let (sin_tube, cos_tube) = (-v * TAU).sin_cos();
        let normal = Vec3::new(cos * cos_tube, sin_tube, -sin * cos_tube);
        let center = Vec3::new(cos, 0.0, -sin) * major;
        (center + normal * minor, normal)
    })
}

/// A square in the XY plane that faces +Z, with sides of length `size`: two triangles, no normals, texture coordinates
/// from (0,0) at the upper left (−X, +Y) to (1,1).
pub fn plane(size: f32) -> Mesh {
    let h = size * 0.5;
    let corner = |u: f32, v: f32| Vec3::new((2.0 * u - 1.0) * h, (1.0 - 2.0 * v) * h, 0.0);
    let uvs = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)];
    let mut mesh = from_triangles(uvs.iter().map(|&(u, v)| corner(u, v)).collect(), vec![0, 1, 2, 0, 2, 3]);
    mesh.uvs = uvs.iter().map(|&(u, v)| Vec2::new(u, v)).collect();
    mesh
}

/// A grid of `columns` × `rows` quads over (u, v) in 0..1 mapped by `point` to (position, unit normal); row by row,
/// each quad as (upper left, lower left, lower right), (upper left, lower right, upper right), with v pointing down.
fn grid(columns: u32, rows: u32, point: impl Fn(f32, f32) -> (Vec3, Vec3)) -> Mesh {
    let mut mesh = from_triangles(Vec::new(), Vec::new());
    for row in 0..=rows {
        for column in 0..=columns {
            let uv = Vec2::new(column as f32 / columns as f32, row as f32 / rows as f32);
            let (position, normal) = point(uv.x, uv.y);
            mesh.positions.push(position);
            mesh.normals.push(normal);
            mesh.uvs.push(uv);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let upper = row * (columns + 1) + column;
            let lower = upper + columns + 1;
            mesh.indices.extend([upper, lower, lower + 1, upper, lower + 1, upper + 1]);
        }
    }
    mesh.submeshes[0].index_count = mesh.indices.len() as u32;
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Adjacency, clean};

    #[test]
    fn shapes_are_clean_closed_and_face_outwards() {
        for (name, mesh) in [
            ("cube", cube(2.0)),
            ("split cube", cube_split(2.0)),
            ("sphere", sphere(1.0, 8, 12)),
            ("coarse sphere", sphere(1.0, 2, 3)),
            ("torus", torus(2.0, 0.5, 12, 8)),
        ] {
            let (after, report) = clean(mesh.clone());
            assert!(report.is_clean(), "{name}: {report:?}");
            assert!(after == mesh, "{name}");
            let adjacency = Adjacency::new(&mesh);
            assert!(adjacency.is_closed(), "{name} is not closed");
            assert_eq!(adjacency.flipped_count, 0, "{name}");
            let volume: f32 = mesh
                .triangles()
                .iter()
                .map(|&t| {
                    let [a, b, c] = mesh.corners(t);
                    a.dot(b.cross(c)) / 6.0
                })
                .sum();
            assert!(volume > 0.0, "{name} is inside out");
            for (t, normal) in mesh.triangles().iter().zip(crate::geometry::normals::face_normals(&mesh)) {
                for &v in t {
                    let smooth = mesh.normals.get(v as usize).copied().unwrap_or(normal);
                    assert!(smooth.dot(normal) > 0.2, "{name}");
                }
            }
        }
    }

    #[test]
    fn the_plane_faces_the_viewer() {
        let mesh = plane(2.0);
        assert!(clean(mesh.clone()).1.is_clean());
        assert_eq!(Adjacency::new(&mesh).border_count, 4);
        assert_eq!(crate::geometry::normals::face_normals(&mesh), [Vec3::Z; 2]);
    }
}
