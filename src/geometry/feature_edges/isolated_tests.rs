use glam::Vec3;

use crate::geometry::feature_edges::crease_angles::CreaseAngles;
use crate::geometry::feature_edges::{FeatureEdges, Traits};
use crate::geometry::primitives::from_triangles;
use crate::geometry::{Adjacency, CreaseRule, Mesh, normals};

const ANGLE: f32 = 30.0;

/// A surface of `2 half` by `2 half` squares over whole x and y.
fn surface(half: i32, height: impl Fn(f32, f32) -> f32) -> Mesh {
    let across = 2 * half + 1;
    let places = (-half..=half).flat_map(|y| (-half..=half).map(move |x| (x as f32, y as f32)));
    let positions = places.map(|(x, y)| Vec3::new(x, y, height(x, y))).collect();
    let squares = (0..2 * half).flat_map(|y| (0..2 * half).map(move |x| y * across + x));
    let triangles = squares.flat_map(|a| [a, a + 1, a + across, a + across, a + 1, a + across + 1]);
    from_triangles(positions, triangles.map(|v| v as u32).collect())
}

/// A fold along x that fades out beyond `length` to both sides.
fn fold(degrees: f32, length: f32) -> Mesh {
    let slopes = [0.5, 0.25].map(|part| (part * degrees).to_radians().tan());
    let share = |x: f32| (1.0 - (x.abs() - length) / 8.0).clamp(0.0, 1.0);
    surface(20, |x, y| {
        let y = y.abs();
        -share(x) * (slopes[0] * y.min(1.0) + slopes[1] * (y - 1.0).clamp(0.0, 2.0))
    })
}

/// How many creases there are, and how many of them are isolated.
fn counts(mesh: &Mesh, rule: CreaseRule) -> [usize; 2] {
    let adjacency = Adjacency::new(mesh).with_rule(rule);
    let edges = FeatureEdges::new(mesh, &adjacency, adjacency.surfaces(ANGLE.to_radians()));
    let angles = CreaseAngles { ridge: ANGLE.to_radians(), valley: ANGLE.to_radians() };
    let creases = edges.pieces(mesh, angles).into_iter().filter(|piece| {
        let traits = edges.traits[piece.edge as usize];
        !traits.any(Traits::BORDER)
    });
    let isolated = edges.isolated(mesh, angles);
    let is_isolated: Vec<bool> = creases.map(|piece| isolated.contains(piece.edge)).collect();
    [is_isolated.len(), is_isolated.iter().filter(|is| **is).count()]
}

#[test]
fn a_short_weak_fold_is_isolated_and_others_are_not() {
    let count = |mesh: &Mesh| counts(mesh, CreaseRule::Normals);
    let [all, isolated] = count(&fold(40.0, 0.0));
    assert!(all > 2 && isolated == all, "short: {isolated} of {all}");
    let [all, isolated] = count(&fold(40.0, 10.0));
    assert!(all > 10 && isolated == 0, "long: {isolated} of {all}");
    let [all, isolated] = count(&fold(70.0, 0.0));
    assert!(all > 2 && isolated == 0, "steep: {isolated} of {all}");
    // Its edges enclose what is on top.
    let slope = 40_f32.to_radians().tan();
    let table = surface(150, |x, y| -slope * (x.abs().max(y.abs()) - 1.0).clamp(0.0, 1.0));
    let [all, isolated] = count(&table);
    assert!(all > 12 && isolated == 0, "table: {isolated} of {all}");
}

#[test]
fn only_meshes_without_normals_have_isolated_creases_and_only_if_these_are_asked() {
    let short = fold(40.0, 0.0);
    assert_eq!(counts(&short, CreaseRule::Angle)[1], 0);
    let computed = normals::by_crease_angle(short, ANGLE);
    let [all, isolated] = counts(&computed, CreaseRule::Normals);
    assert!(all > 2 && isolated == all, "computed: {isolated} of {all}");
    let own = Mesh { has_computed_normals: false, ..computed };
    assert_eq!(counts(&own, CreaseRule::Normals)[1], 0);
}
