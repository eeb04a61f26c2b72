use glam::{Vec2, Vec3};

use super::*;
use crate::geometry::normals::face_normals;
use crate::geometry::{EdgeKind, Rig, Submesh, primitives};

mod gaps;
#[path = "../../../tests/common/repatch.rs"]
mod repatch;
mod shapes;

use repatch::{Common, Repatch};

fn mended(mesh: &Mesh) -> Option<(Mesh, Mended)> {
    mend(mesh, &Adjacency::new(mesh), SeamTolerance::Automatic)
}

fn area(mesh: &Mesh) -> f64 {
    let area = |t: &[u32; 3]| {
        let [a, b, c] = mesh.corners(*t);
        f64::from((b - a).cross(c - a).length()) * 0.5
    };
    mesh.triangles().iter().map(area).sum()
}

/// A cylinder whose upper end is slanted, with caps that are fans around their middles.
fn cut_cylinder() -> Mesh {
    const SIDES: u32 = 40;
    let rim = |upper: bool| {
        (0..SIDES).map(move |k| {
            let (sin, cos) = (k as f32 / SIDES as f32 * std::f32::consts::TAU).sin_cos();
            Vec3::new(0.4 * cos, 0.4 * sin, if upper { 1.0 + 0.2 * cos } else { 0.0 })
        })
    };
    let mut positions: Vec<Vec3> = rim(false).chain(rim(true)).collect();
    positions.extend([Vec3::ZERO, Vec3::Z]);
    let indices = (0..SIDES).flat_map(|k| {
        let [a, b] = [k, (k + 1) % SIDES];
        let [c, d] = [a + SIDES, b + SIDES];
        [a, b, d, a, d, c, 2 * SIDES, b, a, 2 * SIDES + 1, c, d]
    });
    primitives::from_triangles(positions, indices.collect())
}

fn solids() -> Vec<(&'static str, Mesh)> {
    vec![
        ("cube", primitives::cube(1.0)),
        ("sphere", primitives::sphere(1.0, 12, 24)),
        ("torus", primitives::torus(1.0, 0.3, 32, 16)),
        ("cylinder", cut_cylinder()),
    ]
}

/// One side of an arc that two strips have in common: cut at these shares of it, and as wide as `width`, inwards if
/// negative. The far border is lifted.
fn strip_along_arc(shares: &[f32], width: f32, lift: f32) -> Mesh {
    let last = shares.len() as u32 - 1;
    let strip = shapes::grid(last, 1, |u, v| {
        let share = shares[(u * last as f32).round() as usize];
        let (sin, cos) = (0.24 * share).sin_cos();
        Vec3::new(cos, sin, 0.0) * (1.0 + v * width) + Vec3::Z * v * lift
    });
    if width > 0.0 { shapes::turned_over(strip) } else { strip }
}

fn evenly(count: u32) -> Vec<f32> {
    (0..=count).map(|k| k as f32 / count as f32).collect()
}

#[test]
fn two_polylines_of_one_arc_become_one() {
    let uneven = vec![0.0, 0.1, 0.15, 0.45, 0.7, 1.0];
    for (inner, outer) in
        [(evenly(4), evenly(5)), (evenly(3), evenly(40)), (evenly(7), evenly(7)), (uneven, evenly(9))]
    {
        for lift in [-0.2, 0.0, 0.2] {
            let inner = strip_along_arc(&inner, -0.3, 0.0);
            let outer = strip_along_arc(&outer, 0.3, lift);
            let mesh = shapes::together([inner, outer]);
            let Some((mended, report)) = mended(&mesh) else {
                // The same polyline on both sides is joined already.
                assert!(Adjacency::new(&mesh).surfaces(1.0).count == 1);
                continue;
            };
            let adjacency = Adjacency::new(&mended);
            assert_eq!(adjacency.surfaces(1.0).count, 1);
            assert!(report.joined_length > 2.0 * 0.239, "{report:?}");
            assert!(report.farthest_move <= report.tolerance * 1.001, "{report:?}");
            // Whether the seam is a valley or a ridge.
            for edge in &adjacency.edges {
                let on_seam = edge.vertices.iter().all(|&v| {
                    let p = mended.positions[v as usize];
                    (p.length() - 1.0).abs() < 2e-3 && p.z.abs() < 1e-4
                });
                if on_seam && lift != 0.0 {
                    assert!(edge.kind == EdgeKind::Manifold && edge.dihedral * lift < 0.0, "{edge:?}");
                }
            }
        }
    }
}

#[test]
fn of_three_sides_those_that_one_surface_goes_on_through_belong_together() {
    // The wall's polyline lies nearer to that of the inner strip than the outer strip's does.
    let inner = strip_along_arc(&evenly(8), -0.3, 0.0);
    let outer = strip_along_arc(&evenly(3), 0.3, 0.0);
    let wall = strip_along_arc(&evenly(7), 0.01, 0.3);
    for order in [[0, 1, 2], [0, 2, 1], [2, 0, 1], [2, 1, 0], [1, 0, 2], [1, 2, 0]] {
        let strips = [&inner, &outer, &wall];
        let mesh = shapes::together(order.map(|k| strips[k].clone()));
        let (mended, _) = mended(&mesh).unwrap();
        let surfaces = Adjacency::new(&mended).surfaces(0.5);
        let is_flat = |t: &[u32; 3]| mended.corners(*t).iter().all(|p| p.z.abs() < 1e-2);
        let triangles = mended.triangles().iter().zip(&surfaces.of_triangle);
        let flat: Vec<u32> = triangles.filter(|(t, _)| is_flat(t)).map(|(_, &surface)| surface).collect();
        assert!(flat.len() >= 22 && flat.iter().all(|surface| *surface == flat[0]), "{order:?}: {flat:?}");
        assert_eq!(surfaces.count, 2, "{order:?}");
    }
}

#[test]
fn a_patch_that_is_turned_over_is_joined_as_well() {
    let outer = shapes::turned_over(strip_along_arc(&evenly(5), 0.3, 0.0));
    let mesh = shapes::together([strip_along_arc(&evenly(4), -0.3, 0.0), outer]);
    let adjacency = Adjacency::new(&mended(&mesh).unwrap().0);
    assert_eq!(adjacency.surfaces(0.5).count, 1);
    assert!(adjacency.flipped_count > 0);
}

#[test]
fn solids_in_patches_are_closed_again() {
    for (name, solid) in solids() {
        for crack in [0.0, 1e-5, 1e-4, 2e-4, 1e-3] {
            for (seed, max_cuts) in [(1, 1), (2, 2), (3, 3)] {
                let patched = Repatch { crack, seed, max_cuts, ..Repatch::default() }.apply(&solid).mesh;
                let what = format!("{name}, crack {crack}, seed {seed}");
                let before = Adjacency::new(&patched);
                let (after, report) = mended(&patched).unwrap();
                let adjacency = Adjacency::new(&after);
                assert!(adjacency.non_manifold_count == 0 && adjacency.flipped_count == 0, "{what}");
                assert!(report.joined_length >= 0.99 * report.border_length, "{what}: {report:?}");
                assert!(adjacency.is_closed() || crack > 2e-4, "{what}: {report:?}");
                assert!(report.farthest_move <= report.tolerance * 1.001, "{what}: {report:?}");
                assert!((area(&after) - area(&solid)).abs() < 2e-3 * area(&solid), "{what}");
                assert!(before.border_count > 0 || !before.overlaps.is_empty());
            }
        }
    }
}

#[test]
fn solids_whose_patches_have_no_vertex_in_common_are_closed_too() {
    for (name, solid) in solids() {
        for (common, crack) in [
            (Common::Corners, 1e-5),
            (Common::Corners, 1e-4),
            (Common::Corners, 2e-4),
            (Common::Nothing, 1e-5),
            (Common::Nothing, 1e-4),
            (Common::Nothing, 2e-4),
        ] {
            let patched = Repatch { crack, common, ..Repatch::default() }.apply(&solid).mesh;
            let (after, report) = mended(&patched).unwrap();
            let what = format!("{name}, crack {crack}, {common:?}: {report:?}");
            assert!(report.joined_length >= 0.94 * report.border_length, "{what}");
            assert!(report.farthest_move <= report.tolerance * 1.001, "{what}");
            assert_eq!(Adjacency::new(&after).non_manifold_count, 0, "{what}");
        }
    }
}

#[test]
fn only_patches_that_met_are_joined() {
    for (name, solid) in solids() {
        for crack in [1e-4, 1e-3] {
            let mut patched = Repatch { crack, max_cuts: 2, planes: 6, ..Repatch::default() }.apply(&solid);
            // The patch of a triangle, where new vertices inherit it.
            patched.mesh.colors = vec![[0; 4]; patched.mesh.positions.len()];
            for (triangle, patch) in patched.mesh.triangles().to_vec().iter().zip(&patched.patch_of_triangle)
            {
                for &v in triangle {
                    patched.mesh.colors[v as usize] = patch.to_le_bytes();
                }
            }
            let (after, _) = mended(&patched.mesh).unwrap();
            let patch = |face: u32| {
                let vertex = after.triangles()[face as usize][0];
                u32::from_le_bytes(after.colors[vertex as usize])
            };
            for edge in Adjacency::new(&after).edges.iter().filter(|e| e.kind == EdgeKind::Manifold) {
                let [a, b] = edge.faces.map(patch);
                let is_right = a == b || patched.neighbors.contains(&[a.min(b), a.max(b)]);
                assert!(is_right, "{name}, crack {crack}: {a} and {b}");
            }
        }
    }
}

#[test]
fn no_triangle_is_turned_over() {
    let solid = primitives::sphere(1.0, 12, 24);
    for crack in [1e-4, 1e-3] {
        let patched = Repatch { crack, max_cuts: 2, ..Repatch::default() }.apply(&solid).mesh;
        let (after, _) = mended(&patched).unwrap();
        for (triangle, normal) in after.triangles().iter().zip(face_normals(&after)) {
            let middle = after.corners(*triangle).iter().sum::<Vec3>();
            assert!(normal.dot(middle.normalize()) > 0.5, "crack {crack}: {normal}");
        }
    }
}

#[test]
fn each_side_keeps_its_own_attributes() {
    let mut inner = strip_along_arc(&evenly(3), -0.3, 0.0);
    let mut outer = strip_along_arc(&evenly(40), 0.3, 0.2);
    let inner_count = inner.positions.len();
    inner.normals = vec![Vec3::Z; inner_count];
    outer.normals = vec![Vec3::X; outer.positions.len()];
    let mut mesh = shapes::together([inner.clone(), outer.clone()]);
    mesh.normals = [inner.normals, outer.normals].concat();
    mesh.uvs = mesh.positions.iter().map(|p| Vec2::new(p.x, p.y)).collect();
    mesh.colors = mesh.normals.iter().map(|n| if n.z > 0.0 { [9; 4] } else { [200; 4] }).collect();
    mesh.tangents = vec![Vec3::Y.extend(-1.0); mesh.positions.len()];
    let (after, report) = mended(&mesh).unwrap();
    assert!(report.added_vertices > 30);
    let count = after.positions.len();
    assert_eq!([after.normals.len(), after.uvs.len(), after.colors.len(), after.tangents.len()], [count; 4]);
    for (v, p) in after.positions.iter().enumerate() {
        let is_inner = after.normals[v] == Vec3::Z;
        assert!(is_inner || after.normals[v] == Vec3::X);
        assert_eq!(after.colors[v], if is_inner { [9; 4] } else { [200; 4] });
        assert_eq!(after.tangents[v], Vec3::Y.extend(-1.0));
        assert!(after.uvs[v].distance(Vec2::new(p.x, p.y)) <= 1.001 * report.tolerance as f32);
    }
    for triangle in after.triangles() {
        let normals = triangle.map(|v| after.normals[v as usize]);
        assert!(normals.iter().all(|n| *n == normals[0]));
    }
}

#[test]
fn triangles_keep_their_materials() {
    let solid = primitives::torus(1.0, 0.3, 32, 16);
    let mut mesh = Repatch { crack: 1e-4, ..Repatch::default() }.apply(&solid).mesh;
    let count = mesh.indices.len() as u32;
    let first = count / 9 * 3;
    mesh.submeshes = vec![
        Submesh { first_index: 0, index_count: first, material: 4 },
        Submesh { first_index: first, index_count: count - first, material: 2 },
    ];
    let (after, _) = mended(&mesh).unwrap();
    let area_of = |mesh: &Mesh, part: usize| {
        let Submesh { first_index, index_count, .. } = mesh.submeshes[part];
        let indices = mesh.indices[first_index as usize..][..index_count as usize].to_vec();
        area(&primitives::from_triangles(mesh.positions.clone(), indices))
    };
    assert_eq!(after.submeshes.iter().map(|p| p.material).collect::<Vec<_>>(), [4, 2]);
    assert_eq!(after.submeshes[1].first_index, after.submeshes[0].index_count);
    assert_eq!(after.submeshes[0].index_count + after.submeshes[1].index_count, after.indices.len() as u32);
    for part in 0..2 {
        assert!((area_of(&after, part) / area_of(&mesh, part) - 1.0).abs() < 1e-3);
    }
}

#[test]
fn place_size_and_order_do_not_matter() {
    let solid = cut_cylinder();
    let mesh = Repatch { crack: 1e-4, max_cuts: 2, ..Repatch::default() }.apply(&solid).mesh;
    let share = |mesh: &Mesh| {
        let (_, report) = mended(mesh).unwrap();
        report.joined_length / report.border_length
    };
    let expected = share(&mesh);
    let mut reversed = mesh.clone();
    reversed.indices = mesh.triangles().iter().rev().copied().collect::<Vec<_>>().into_flattened();
    assert!((share(&reversed) - expected).abs() < 1e-3);
    for (scale, offset) in [(1.0, Vec3::ZERO), (1e-3, Vec3::ZERO), (1e4, Vec3::ONE), (1.0, Vec3::splat(3.0))]
    {
        assert!((share(&shapes::placed(&mesh, scale, offset)) - expected).abs() < 1e-3, "{scale} {offset}");
    }
}

#[test]
fn there_may_be_nothing_to_do() {
    let patched = Repatch { crack: 1e-4, ..Repatch::default() }.apply(&primitives::cube(1.0)).mesh;
    let adjacency = Adjacency::new(&patched);
    assert!(mend(&patched, &adjacency, SeamTolerance::Fraction(1e-3)).is_some());
    for tolerance in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(mend(&patched, &adjacency, SeamTolerance::Fraction(tolerance)).is_none());
    }
    let skinned = Mesh { rig: Some(std::sync::Arc::new(Rig::default())), ..patched.clone() };
    assert!(mended(&skinned).is_none());
    assert!(mended(&primitives::cube(1.0)).is_none() && mended(&Mesh::default()).is_none());
}

#[test]
fn a_tolerance_that_is_too_small_leaves_wide_cracks() {
    let patched =
        Repatch { crack: 1e-3, ..Repatch::default() }.apply(&primitives::torus(1.0, 0.3, 32, 16)).mesh;
    let adjacency = Adjacency::new(&patched);
    let joined = |share: f32| {
        mend(&patched, &adjacency, SeamTolerance::Fraction(share)).map_or(0.0, |m| {
            assert!(m.1.farthest_move <= m.1.tolerance * 1.001);
            m.1.joined_length / m.1.border_length
        })
    };
    assert!(joined(1e-4) < 0.3 && joined(1e-3) > 0.99);
}
