//! Surfaces with real borders, in a space about 1 wide.

use std::f32::consts::{PI, TAU};

use glam::{Mat3, Vec3};

use super::repatch::Random;
use crate::geometry::{Mesh, primitives};

/// A grid of quads over (u, v) in 0..1, with vertices of its own for each.
pub(super) fn grid(columns: u32, rows: u32, point: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let mut positions = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            positions.push(point(column as f32 / columns as f32, row as f32 / rows as f32));
        }
    }
    let mut indices = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let a = row * (columns + 1) + column;
            let b = a + columns + 1;
            indices.extend([a, a + 1, b + 1, a, b + 1, b]);
        }
    }
    primitives::from_triangles(positions, indices)
}

/// One mesh of several.
pub(super) fn together(meshes: impl IntoIterator<Item = Mesh>) -> Mesh {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for mesh in meshes {
        let base = positions.len() as u32;
        positions.extend(mesh.positions);
        indices.extend(mesh.indices.iter().map(|i| base + i));
    }
    primitives::from_triangles(positions, indices)
}

pub(super) fn turned_over(mut mesh: Mesh) -> Mesh {
    mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|t| t.swap(1, 2));
    mesh
}

pub(super) fn sheet(n: u32, at: Vec3, size: f32) -> Mesh {
    grid(n, n, |u, v| at + Vec3::new(u, v, 0.0) * size)
}

/// A tube along z, from one angle to another.
pub(super) fn tube(radius: f32, segments: u32, from: f32, to: f32) -> Mesh {
    grid(segments, 3, |u, v| {
        let (sin, cos) = if u == 1.0 && to == TAU { (0.0, 1.0) } else { (from + u * (to - from)).sin_cos() };
        Vec3::new(radius * cos, radius * sin, v)
    })
}

pub(super) fn moebius() -> Mesh {
    grid(60, 2, |u, v| {
        // The end is the start, turned over.
        let (u, v) = if u == 1.0 { (0.0, 1.0 - v) } else { (u, v) };
        let (angle, w) = (u * TAU, 0.3 * (v - 0.5));
        let r = 0.5 + w * (angle / 2.0).cos();
        Vec3::new(r * angle.cos(), r * angle.sin(), w * (angle / 2.0).sin())
    })
}

/// Small sheets at random places in random directions.
pub(super) fn leaf_cards(count: usize) -> Mesh {
    let mut random = Random(5);
    together((0..count).map(|_| {
        let (at, x, y) = (random.in_ball() * 0.5, random.in_ball(), random.in_ball());
        let x = x.normalize_or(Vec3::X) * 0.03;
        let y = x.cross(y).normalize_or(Vec3::Y) * 0.02;
        grid(1, 1, |u, v| at + x * u + y * v)
    }))
}

/// Sheets over each other with these distances, every other one turned over if `opposite`.
pub(super) fn stack(count: usize, gap: f32, subdivisions: [u32; 2], opposite: bool) -> Mesh {
    together((0..count).map(|k| {
        let page = sheet(subdivisions[k % 2], Vec3::Z * gap * k as f32, 0.7);
        if opposite && k % 2 == 1 { turned_over(page) } else { page }
    }))
}

pub(super) fn double_tube(gap: f32) -> Mesh {
    together([tube(0.3, 24, 0.0, TAU), turned_over(tube(0.3 - gap, 24, 0.0, TAU))])
}

/// Two bulging sheets whose borders are apart.
pub(super) fn pillow(gap: f32) -> Mesh {
    let bulge = |u: f32, v: f32| 0.1 * (u * PI).sin() * (v * PI).sin();
    let half =
        |sign: f32| grid(8, 8, move |u, v| Vec3::new(0.7 * u, 0.7 * v, sign * (bulge(u, v) + 0.5 * gap)));
    together([half(1.0), turned_over(half(-1.0))])
}

/// Square tiles with joints between them.
pub(super) fn tiles(count: u32, gap: f32, subdivisions: u32) -> Mesh {
    let pitch = 0.7 / count as f32;
    together((0..count * count).map(|k| {
        let at = Vec3::new((k % count) as f32, (k / count) as f32, 0.0) * pitch;
        sheet(subdivisions, at, pitch - gap)
    }))
}

/// A floor and a wall that ends above it.
pub(super) fn corner_clearance(gap: f32) -> Mesh {
    let wall = grid(7, 3, |u, v| Vec3::new(0.7 * u, 0.0, gap + 0.5 * v));
    together([sheet(5, Vec3::ZERO, 0.7), wall])
}

pub(super) fn half_shells(gap: f32) -> Mesh {
    let shell = |sign: f32| {
        grid(24, 6, move |u, v| {
            let (sin, cos) = if u == 1.0 { (0.0, 1.0) } else { (u * TAU).sin_cos() };
            let (up, out) = (v * 0.45 * PI).sin_cos();
            Vec3::new(0.4 * out * cos, 0.4 * out * sin, sign * (0.4 * up + 0.5 * gap))
        })
    };
    together([shell(1.0), turned_over(shell(-1.0))])
}

/// A plate with a slot from its middle to its border, `start` wide within and `end` at the border.
pub(super) fn slit_plate(start: f32, end: f32) -> Mesh {
    let half = |sign: f32| {
        grid(6, 4, move |u, v| {
            let x = 0.7 * u;
            let open = (x - 0.35).max(0.0) / 0.35;
            let width = if x < 0.349 { 0.0 } else { start + (end - start) * open };
            Vec3::new(x, sign * (0.5 * width + 0.35 * v), 0.0)
        })
    };
    together([turned_over(half(-1.0)), half(1.0)])
}

/// A plate with a closed rectangular slot.
pub(super) fn slotted_plate(gap: f32) -> Mesh {
    let (x, y) = ([0.0, 0.2, 0.5, 0.7], [0.0, 0.35 - 0.5 * gap, 0.35 + 0.5 * gap, 0.7]);
    let quads = (0..9).filter(|&k| k != 4);
    together(quads.map(|k| {
        let (i, j) = (k % 3, k / 3);
        let pick = |list: [f32; 4], k: usize, t: f32| if t == 0.0 { list[k] } else { list[k + 1] };
        grid(1, 1, |u, v| Vec3::new(pick(x, i, u), pick(y, j, v), 0.0))
    }))
}

/// A long strip, or a leaf that is pointed at both ends.
pub(super) fn strip(width: f32, is_leaf: bool) -> Mesh {
    let mesh = grid(16, 1, |u, v| {
        let width = if is_leaf { width * 4.0 * u * (1.0 - u) } else { width };
        Vec3::new(u, width * (v - 0.5) + 0.1 * (u * 3.0).sin(), 0.0)
    });
    crate::geometry::clean(mesh).0
}

/// Triangles at random places.
pub(super) fn loose_triangles(count: usize, size: f32) -> Mesh {
    let mut random = Random(9);
    let positions = (0..count)
        .flat_map(|_| {
            let at = random.in_ball();
            [at, at + random.in_ball() * size, at + random.in_ball() * size]
        })
        .collect();
    primitives::from_triangles(positions, (0..3 * count as u32).collect())
}

/// Needles that all run along z within a thin bundle.
pub(super) fn bundle(count: usize) -> Mesh {
    let mut random = Random(3);
    let positions = (0..count)
        .flat_map(|_| {
            let at = random.in_ball() * 2e-4;
            [at, at + Vec3::Z + random.in_ball() * 1e-4, at + random.in_ball() * 1e-4]
        })
        .collect();
    primitives::from_triangles(positions, (0..3 * count as u32).collect())
}

/// The mesh with a vertex of its own at every corner, each moved by at most `jitter`.
pub(super) fn soup(mesh: &Mesh, jitter: f32) -> Mesh {
    let mut random = Random(7);
    let corner = |&v: &u32| mesh.positions[v as usize] + random.in_ball() * jitter;
    let positions: Vec<Vec3> = mesh.indices.iter().map(corner).collect();
    let indices = (0..positions.len() as u32).collect();
    primitives::from_triangles(positions, indices)
}

/// The mesh turned, scaled and moved.
pub(super) fn placed(mesh: &Mesh, scale: f32, offset: Vec3) -> Mesh {
    let turn = Mat3::from_rotation_x(0.7) * Mat3::from_rotation_y(0.4);
    let mut mesh = mesh.clone();
    for p in &mut mesh.positions {
        *p = turn * *p * scale + offset;
    }
    for n in &mut mesh.normals {
        *n = turn * *n;
    }
    mesh
}
