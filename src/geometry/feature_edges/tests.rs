use glam::Vec3;

use super::*;
use crate::geometry::{Submesh, primitives};

fn edges_of(mesh: &Mesh) -> FeatureEdges {
    let adjacency = Adjacency::new(mesh);
    let surfaces = adjacency.surfaces(0.5);
    FeatureEdges::new(mesh, &adjacency, surfaces)
}

fn count(edges: &FeatureEdges, traits: Traits) -> usize {
    edges.traits.iter().filter(|t| t.any(traits)).count()
}

/// Total length of the edges that have a trait, in units of the mesh.
fn length(mesh: &Mesh, edges: &FeatureEdges, is: impl Fn(Traits, f32) -> bool) -> f32 {
    (0..edges.len())
        .filter(|&e| is(edges.traits[e], edges.dihedral[e]))
        .map(|e| {
            let [a, b] = edges.ends[e].map(|v| mesh.positions[v as usize]);
            a.distance(b)
        })
        .sum()
}

#[test]
fn edges_of_split_vertices_meet() {
    let (shared, split) = (edges_of(&primitives::cube(1.0)), edges_of(&primitives::cube_split(1.0)));
    for edges in [shared, split] {
        assert_eq!(edges.len(), 18);
        assert_eq!(edges.dihedral.iter().filter(|angle| **angle > 1.5).count(), 12);
        let mut ends: Vec<u32> = edges.ends.iter().flatten().copied().collect();
        ends.sort_unstable();
        ends.dedup();
        assert_eq!(ends.len(), 8);
        assert_eq!(count(&edges, Traits(15)), 0);
    }
}

#[test]
fn materials_and_flips_and_borders_are_known() {
    let mut mesh = primitives::plane(1.0);
    mesh.submeshes = vec![
        Submesh { first_index: 0, index_count: 3, material: 4 },
        Submesh { first_index: 3, index_count: 3, material: 2 },
    ];
    let edges = edges_of(&mesh);
    assert_eq!((count(&edges, Traits::MATERIAL), count(&edges, Traits::BORDER)), (1, 4));
    mesh.submeshes[1].material = 4;
    assert_eq!(count(&edges_of(&mesh), Traits::MATERIAL), 0);
    mesh.indices.swap(0, 1);
    let edges = edges_of(&mesh);
    assert_eq!((count(&edges, Traits::FLIPPED), count(&edges, Traits::BORDER)), (1, 4));
    assert_eq!(edges.dihedral.iter().filter(|angle| angle.abs() > 0.1).count(), 0);
}

#[test]
fn walls_that_were_modeled_twice_still_end() {
    for order in [[0, 1, 2, 0, 2, 1], [0, 1, 2, 0, 1, 2]] {
        let mesh = primitives::from_triangles(vec![Vec3::ZERO, Vec3::X, Vec3::Y], order.to_vec());
        let edges = edges_of(&mesh);
        assert_eq!((edges.len(), count(&edges, Traits::BORDER)), (3, 3), "{order:?}");
    }
}

#[test]
fn an_edge_of_three_walls_is_not_manifold() {
    let mut positions = vec![Vec3::ZERO, Vec3::Z];
    positions.extend([Vec3::X, Vec3::Y, Vec3::NEG_X]);
    let mesh = primitives::from_triangles(positions, vec![0, 1, 2, 1, 0, 3, 0, 1, 4]);
    let edges = edges_of(&mesh);
    let found: Vec<u32> =
        (0..edges.len() as u32).filter(|&e| edges.traits[e as usize].any(Traits::NON_MANIFOLD)).collect();
    assert_eq!(found.len(), 1);
    let faces: Vec<u32> = edges.faces_around(found[0]).iter().map(|&(_, face)| face).collect();
    assert_eq!(faces, [0, 1, 2]);
    assert!(edges.faces_around(found[0] + 1).is_empty() && count(&edges, Traits::BORDER) == 6);
}

/// Two rectangles that meet along x = 0, divided differently there; the second one lies at `angle` to the first.
pub(in crate::geometry) fn junction(angle: f32) -> Mesh {
    let (sin, cos) = angle.sin_cos();
    let mut positions = vec![Vec3::new(-1.0, -1.0, 0.0), Vec3::new(-1.0, 1.0, 0.0)];
    positions.extend([-1.0, 1.0].map(|y| Vec3::new(0.0, y, 0.0)));
    positions.extend([-1.0, -0.3, 0.4, 1.0].map(|y| Vec3::new(0.0, y, 0.0)));
    positions.push(Vec3::new(cos, 0.0, sin));
    primitives::from_triangles(positions, vec![0, 2, 3, 0, 3, 1, 4, 8, 5, 5, 8, 6, 6, 8, 7])
}

#[test]
fn at_t_junctions_every_stretch_has_two_sides() {
    for angle in [0.0, 1.0, -1.0] {
        let mesh = junction(angle);
        let edges = edges_of(&mesh);
        let on_seam =
            (0..edges.len()).filter(|&e| edges.ends[e].iter().all(|&v| mesh.positions[v as usize].x == 0.0));
        let mut total = 0.0;
        for e in on_seam {
            assert!(!edges.traits[e].any(Traits::BORDER));
            assert!((edges.dihedral[e] + angle).abs() < 1e-5, "{}", edges.dihedral[e]);
            let [a, b] = edges.ends[e].map(|v| mesh.positions[v as usize].y);
            total += (a - b).abs();
        }
        assert!((total - 2.0).abs() < 1e-5, "{total}");
    }
}

#[test]
fn what_lies_beyond_a_junction_is_border() {
    // The second side covers only the lower half of the first one's edge.
    let p = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    let mesh = primitives::from_triangles(
        vec![p(-1.0, 0.0), p(0.0, -1.0), p(0.0, 1.0), p(1.0, 0.0), p(0.0, 0.0)],
        vec![0, 1, 2, 1, 3, 4],
    );
    let edges = edges_of(&mesh);
    let inner = length(&mesh, &edges, |traits, _| !traits.any(Traits::BORDER));
    let border = length(&mesh, &edges, |traits, _| traits.any(Traits::BORDER));
    assert!((inner - 1.0).abs() < 1e-5, "{inner}");
    assert!((border - (3.0 * 2_f32.sqrt() + 1.0 + 1.0)).abs() < 1e-5, "{border}");
}

#[test]
fn a_large_mesh_takes_little() {
    let mesh = primitives::torus(1.0, 0.3, 300, 200);
    let edges = edges_of(&mesh);
    assert_eq!(edges.len(), 180_000);
    let per_triangle = edges.size_in_bytes() as f64 / mesh.triangle_count() as f64;
    // 45 MB for 1.1 million triangles.
    assert!(per_triangle < 40.0, "{per_triangle}");
}
