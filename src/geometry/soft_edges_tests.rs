use std::f32::consts::TAU;

use super::*;
use crate::geometry::primitives::{cube, cube_split, from_triangles};
use crate::geometry::{Adjacency, FeatureEdges, normals};

const CREASE: f32 = 30.0 * std::f32::consts::PI / 180.0;

/// The mesh with one normal per point, as if its author had averaged them.
fn averaged(mesh: Mesh) -> Mesh {
    Mesh { has_computed_normals: false, ..normals::by_crease_angle(mesh, 180.0) }
}

/// The mesh with smooth normals, as if its author had parted them at creases above an angle in degrees.
fn parted(mesh: Mesh, degrees: f32) -> Mesh {
    Mesh { has_computed_normals: false, ..normals::by_crease_angle(mesh, degrees) }
}

/// A closed cylinder without normals.
fn cylinder(sides: u32) -> Mesh {
    let mut positions = vec![Vec3::NEG_Y, Vec3::Y];
    for side in 0..sides {
        let (sin, cos) = (TAU * side as f32 / sides as f32).sin_cos();
        positions.extend([-1.0, 1.0].map(|y| Vec3::new(cos, y, -sin)));
    }
    let indices = (0..sides).flat_map(|side| {
        let (here, next) = (2 + 2 * side, 2 + 2 * ((side + 1) % sides));
        [[here, next, here + 1], [here + 1, next, next + 1], [0, next, here], [1, here + 1, next + 1]]
    });
    from_triangles(positions, indices.flatten().collect())
}

/// Both meshes, which have normals, in one.
fn together(one: &Mesh, other: &Mesh) -> Mesh {
    let mut both = from_triangles(one.positions.clone(), one.indices.clone());
    both.normals = [one.normals.as_slice(), &other.normals].concat();
    both.positions.extend(&other.positions);
    both.indices.extend(other.indices.iter().map(|v| v + one.positions.len() as u32));
    both.submeshes[0].index_count = both.indices.len() as u32;
    both
}

fn creases(mesh: &Mesh) -> usize {
    Adjacency::new(mesh).edges.iter().filter(|edge| edge.is_crease(CREASE)).count()
}

#[test]
fn boxes_and_cylinders_keep_their_edges_however_their_normals_are_averaged() {
    assert_eq!(creases(&cube(1.0)), 12);
    assert_eq!(creases(&cube_split(1.0)), 12);
    assert_eq!(creases(&averaged(cube(1.0))), 12);
    // Between its sides there are 30°, more or less by rounding.
    assert_eq!(creases(&averaged(cylinder(12))), 24);
    assert_eq!(creases(&averaged(cylinder(8))), 16);
    assert_eq!(creases(&cylinder(8)), 24);
}

#[test]
fn where_normals_agree_the_surface_goes_on() {
    let smooth = parted(cylinder(8), 50.0);
    let adjacency = Adjacency::new(&smooth);
    assert_eq!(creases(&smooth), 16);
    assert_eq!(adjacency.surfaces(CREASE).count, 3);
    assert_eq!(adjacency.clone().with_rule(CreaseRule::Angle).surfaces(CREASE).count, 10);
    // The sides of five meet at 72°; the author parts normals at the rims, so that those that agree are meant.
    assert_eq!(creases(&parted(cylinder(5), 80.0)), 10);
    // What is turned inside out is compared as if it were not.
    let mut flipped = smooth;
    flipped.indices.as_chunks_mut::<3>().0.iter_mut().step_by(8).for_each(|t| t.swap(0, 1));
    assert_eq!(creases(&flipped), 16);
}

#[test]
fn computed_normals_do_not_decide() {
    for degrees in [20.0, 50.0, 180.0] {
        let mesh = normals::by_crease_angle(cylinder(8), degrees);
        assert!(mesh.has_computed_normals);
        assert_eq!(creases(&mesh), 24);
    }
    assert!(!normals::flat(normals::by_crease_angle(cube(1.0), 30.0)).has_computed_normals);
}

#[test]
fn above_sixty_degrees_a_mesh_is_believed_that_parts_most_of_its_normals() {
    let (small, large) = (averaged(cube(1.0)), averaged(cube(3.0)));
    let split = cube_split(2.0);
    assert_eq!(creases(&together(&split, &small)), 12);
    assert_eq!(creases(&together(&split, &large)), 24);
}

/// A roof with a ridge of 90° along y from 0 to 1, and the normals of its two sides there: at its start, at its end.
fn roof(start: [Vec3; 2], end: [Vec3; 2]) -> Mesh {
    let p = |x: f32, y: f32| Vec3::new(x, y, -x.abs() * 0.5);
    let positions = vec![p(-1.0, 0.5), p(0.0, 0.0), p(0.0, 1.0), p(1.0, 0.5), p(0.0, 0.0), p(0.0, 1.0)];
    let normals = vec![Vec3::Z, start[0], end[0], Vec3::Z, start[1], end[1]];
    Mesh { normals, ..from_triangles(positions, vec![0, 1, 2, 3, 5, 4]) }
}

#[test]
fn normals_that_differ_at_one_end_make_a_crease() {
    let up = [Vec3::Z; 2];
    let tilt =
        |degrees: f32| [Vec3::Z, Vec3::new(degrees.to_radians().sin(), 0.0, degrees.to_radians().cos())];
    for (start, end, count) in [
        (up, up, 0),
        (tilt(4.9), up, 0),
        (tilt(5.1), up, 1),
        (up, tilt(20.0), 1),
        (tilt(40.0), tilt(40.0), 1),
        ([Vec3::ZERO; 2], up, 1),
        ([Vec3::NAN; 2], up, 1),
    ] {
        assert_eq!(creases(&roof(start, end)), count, "{start:?} {end:?}");
    }
    let mut short = roof(up, up);
    short.normals.pop();
    assert_eq!(creases(&short), 1);
}

#[test]
fn the_two_sides_of_a_leaf_are_not_one_surface() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    let leaf = Mesh { normals: vec![Vec3::Z; 3], ..from_triangles(corners, vec![0, 1, 2, 0, 2, 1]) };
    assert_eq!((creases(&leaf), Adjacency::new(&leaf).surfaces(CREASE).count), (3, 2));
}

#[test]
fn normals_are_compared_along_t_junctions() {
    // One side has a single edge along x = 0, the other two; both turn their normals from one end to the other.
    let at = |y: f32| Vec3::new(0.0, (y - 0.5).sin(), (y - 0.5).cos());
    let p = |x: f32, y: f32| Vec3::new(x, y, -x.abs() * 0.4);
    let places = [p(-1.0, 0.5), p(0.0, 0.0), p(0.0, 1.0), p(1.0, 0.5), p(0.0, 0.0), p(0.0, 0.6), p(0.0, 1.0)];
    let mesh = |middle: Vec3| {
        let mut normals: Vec<Vec3> = places.iter().map(|p| at(p.y)).collect();
        normals[5] = middle;
        Mesh { normals, ..from_triangles(places.to_vec(), vec![0, 1, 2, 3, 5, 4, 3, 6, 5]) }
    };
    let smooth = Adjacency::new(&mesh(at(0.6)));
    assert!(
        smooth.overlaps.len() == 2
            && smooth.overlaps.iter().all(|overlap| overlap.is_soft && overlap.dihedral > 0.6)
    );
    assert_eq!(smooth.surfaces(CREASE).count, 1);
    let sharp = Adjacency::new(&mesh(Vec3::X));
    assert_eq!(sharp.surfaces(CREASE).count, 2);
    // Of the soft edges one lies within the divided side.
    let edges = |mesh: &Mesh, adjacency: &Adjacency| {
        let edges = FeatureEdges::new(mesh, adjacency, adjacency.surfaces(CREASE));
        edges.traits.iter().filter(|traits| traits.any(super::super::feature_edges::Traits::SOFT)).count()
    };
    assert_eq!((edges(&mesh(at(0.6)), &smooth), edges(&mesh(Vec3::X), &sharp)), (3, 1));
}
