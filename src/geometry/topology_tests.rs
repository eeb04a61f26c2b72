use std::f32::consts::FRAC_PI_2;

use super::*;
use crate::geometry::primitives::{cube, cube_split, from_triangles, plane, sphere, torus};

fn angles(adjacency: &Adjacency) -> Vec<f32> {
    let mut angles: Vec<f32> = adjacency.edges.iter().map(|e| e.dihedral).collect();
    angles.sort_by(f32::total_cmp);
    angles
}

#[test]
fn a_cube_has_twelve_ridges_and_six_flat_diagonals_however_its_corners_are_stored() {
    for mesh in [cube(2.0), cube_split(2.0)] {
        let adjacency = Adjacency::new(&mesh);
        assert_eq!(adjacency.edges.len(), 18);
        assert!(adjacency.is_closed());
        assert_eq!((adjacency.weld.count, adjacency.flipped_count), (8, 0));
        let angles = angles(&adjacency);
        assert!(angles[..6].iter().all(|a| a.abs() < 1e-6));
        assert!(angles[6..].iter().all(|a| (a - FRAC_PI_2).abs() < 1e-6));
    }
}

#[test]
fn a_cube_turned_inside_out_has_valleys() {
    let mut mesh = cube(2.0);
    mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|t| t.swap(0, 1));
    assert!((angles(&Adjacency::new(&mesh))[0] + FRAC_PI_2).abs() < 1e-6);
}

#[test]
fn the_angle_does_not_depend_on_unit_or_place() {
    for (scale, offset) in [(1e-6, 0.0), (1e6, 0.0), (1e-15, 0.0), (1.0, 1000.0)] {
        let mut mesh = cube(2.0);
        for p in &mut mesh.positions {
            *p = *p * scale + Vec3::splat(offset);
        }
        let adjacency = Adjacency::new(&mesh);
        assert!(adjacency.is_closed());
        assert!((angles(&adjacency)[17] - FRAC_PI_2).abs() < 1e-5, "{scale}");
    }
}

#[test]
fn seams_and_poles_are_no_borders() {
    for mesh in [sphere(1.0, 16, 24), torus(2.0, 0.5, 24, 16)] {
        let adjacency = Adjacency::new(&mesh);
        assert!(adjacency.is_closed());
        assert_eq!(adjacency.edges.len() * 2, mesh.triangle_count() * 3);
    }
}

#[test]
fn a_plane_has_borders() {
    let adjacency = Adjacency::new(&plane(1.0));
    assert_eq!((adjacency.edges.len(), adjacency.border_count), (5, 4));
    assert!(!adjacency.is_closed());
    let border = adjacency.edges[adjacency.edge_between(0, 1).unwrap()];
    assert_eq!((border.kind, border.faces), (EdgeKind::Border, [0, NO_FACE]));
    assert_eq!(adjacency.edge_between(1, 3), None);
}

#[test]
fn a_flipped_triangle_is_marked_and_measured_as_if_turned() {
    let mut mesh = cube(2.0);
    mesh.indices.swap(0, 1);
    let adjacency = Adjacency::new(&mesh);
    assert_eq!(adjacency.flipped_count, 3);
    assert!(adjacency.is_closed());
    let flat = adjacency.edges[adjacency.edge_between(0, 6).unwrap()];
    assert_eq!(flat.kind, EdgeKind::Flipped);
    assert!(flat.dihedral.abs() < 1e-6);
}

#[test]
fn three_leaves_of_a_book_meet_in_a_non_manifold_edge() {
    let positions = vec![Vec3::ZERO, Vec3::Y, Vec3::X, Vec3::Z, Vec3::NEG_X];
    let mesh = from_triangles(positions, vec![0, 1, 2, 0, 1, 3, 0, 1, 4]);
    let adjacency = Adjacency::new(&mesh);
    assert_eq!(adjacency.non_manifold_count, 1);
    assert_eq!(adjacency.border_count, 6);
    let edge = adjacency.edge_between(1, 0).unwrap() as u32;
    assert_eq!(adjacency.non_manifold, [(edge, 0), (edge, 1), (edge, 2)]);
}

#[test]
fn a_sliver_that_welding_collapses_opens_no_seam() {
    let up = Vec3::new(0.5, 1.0, 0.0);
    let nearly = Vec3::new(1e-9, 0.0, 0.0);
    let positions = vec![Vec3::ZERO, nearly, up, Vec3::NEG_X, Vec3::X];
    let mesh = from_triangles(positions, vec![0, 1, 2, 0, 2, 3, 1, 4, 2]);
    let adjacency = Adjacency::new(&mesh);
    assert_eq!(adjacency.collapsed.len(), 1);
    assert_eq!(adjacency.border_count, 4);
    assert_eq!(adjacency.surfaces(0.1).count, 1);
}

#[test]
fn an_empty_mesh_has_no_edges() {
    let adjacency = Adjacency::new(&Mesh::default());
    assert!(adjacency.edges.is_empty() && !adjacency.is_closed());
    assert_eq!(adjacency.surfaces(0.5).count, 0);
}
