use glam::Vec3;

use super::{FoldEdge, bridged};
use crate::geometry::feature_edges::FeatureEdges;
use crate::geometry::feature_edges::crease_angles::CreaseAngles;
use crate::geometry::primitives::from_triangles;
use crate::geometry::{Adjacency, Mesh};

/// Which of these edges, all of one length, are creases from 30 on.
fn creases_of(angles: &[f32], is_closed: bool) -> Vec<bool> {
    let links: Vec<FoldEdge> =
        angles.iter().map(|angle| FoldEdge { angle: angle.to_radians(), length: 1.0 }).collect();
    bridged(&links, is_closed).iter().map(|angle| *angle >= 30_f32.to_radians()).collect()
}

#[test]
fn what_is_between_sharper_edges_is_a_crease_with_them() {
    assert_eq!(creases_of(&[40.0, 25.0, 24.0, 31.0], false), [true; 4]);
    // Not where it is much weaker, nor where it fades out.
    assert_eq!(creases_of(&[40.0, 10.0, 40.0], false), [true, false, true]);
    assert_eq!(creases_of(&[40.0, 31.0, 25.0], false), [true, true, false]);
    // Nor where the gap is longer than what is beside it.
    assert_eq!(creases_of(&[31.0, 25.0, 25.0, 25.0, 31.0], false), [true, false, false, false, true]);
    assert_eq!(creases_of(&[31.0, 31.0, 25.0, 25.0, 25.0, 31.0], false), [true; 6]);
}

#[test]
fn chains_are_the_same_from_both_ends() {
    let mut chain = [31.0, 25.0, 31.0, 25.0, 25.0, 25.0, 31.0];
    let mut found = creases_of(&chain, false);
    assert_eq!(found, [true, true, true, false, false, false, true]);
    chain.reverse();
    found.reverse();
    assert_eq!(creases_of(&chain, false), found);
}

#[test]
fn a_loop_has_no_ends() {
    assert_eq!(creases_of(&[25.0, 31.0, 31.0, 24.0], true), [true; 4]);
    assert_eq!(creases_of(&[25.0, 31.0, 31.0, 24.0], false), [false, true, true, false]);
}

/// A roof of squares with a ridge along x, which has at each of its points the angle that `degrees` gives.
fn roof(degrees: &[f32]) -> Mesh {
    let rows = degrees.iter().enumerate().map(|(x, degrees)| {
        let eaves = -(0.5 * degrees).to_radians().tan();
        [[-1.0, eaves], [0.0, 0.0], [1.0, eaves]].map(|[y, z]| Vec3::new(x as f32, y, z))
    });
    let squares = (0..degrees.len() as u32 - 1).flat_map(|row| [3 * row, 3 * row + 1]);
    let triangles = squares.flat_map(|a| [a, a + 3, a + 1, a + 1, a + 3, a + 4]);
    from_triangles(rows.flatten().collect(), triangles.collect())
}

/// How many edges of the ridge are creases from 30° on.
fn creases(mesh: &Mesh) -> usize {
    let adjacency = Adjacency::new(mesh);
    let edges = FeatureEdges::new(mesh, &adjacency, adjacency.surfaces(0.5));
    let angle = 30_f32.to_radians();
    let pieces = edges.pieces(mesh, CreaseAngles { ridge: angle, valley: angle });
    pieces.iter().filter(|piece| piece.ends.iter().all(|end| end.y == 0.0)).count()
}

#[test]
fn a_fold_whose_angle_wavers_is_one_line() {
    let wavering = roof(&[34.0, 34.0, 26.0, 24.0, 34.0, 34.0, 27.0, 25.0, 34.0, 34.0]);
    assert_eq!(creases(&wavering), 9);
    // The order of triangles and points is of no account.
    let mut turned = wavering.clone();
    turned.indices.reverse();
    assert_eq!(creases(&turned), creases(&roof(&[34.0; 10])));
    // What fades out ends, and what is weak all along is none.
    let fading = creases(&roof(&[34.0, 34.0, 34.0, 34.0, 20.0, 20.0, 20.0, 20.0, 20.0, 20.0]));
    assert!((3..5).contains(&fading), "{fading}");
    assert_eq!(creases(&roof(&[25.0; 10])), 0);
    // Nor does a line run through where there is no fold.
    let parted = creases(&roof(&[34.0, 34.0, 34.0, 10.0, 10.0, 10.0, 10.0, 34.0, 34.0, 34.0]));
    assert!((4..7).contains(&parted), "{parted}");
}
