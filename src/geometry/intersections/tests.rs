use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::geometry::{CreaseRule, Topology, primitives};

fn at(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_translation(DVec3::new(x, y, z))
}

fn whole<'a>(mesh: &'a Mesh, weld: &'a Weld) -> SearchedMesh<'a> {
    SearchedMesh::new(mesh, weld, &mesh.bounds())
}

/// The curves between two placed meshes, and those in the other order.
fn both_ways(one: (&Mesh, DMat4), other: (&Mesh, DMat4)) -> [Vec<IntersectionCurve>; 2] {
    let welds = [one, other].map(|(mesh, _)| Weld::near(&mesh.positions));
    let searched = [whole(one.0, &welds[0]), whole(other.0, &welds[1])];
    let placed = [(0, one.1), (1, other.1)]
        .map(|(mesh, world_from_local)| Placed { mesh: &searched[mesh], world_from_local });
    [intersections(placed[0], placed[1]), intersections(placed[1], placed[0])]
}

fn own(mesh: &Mesh) -> Vec<IntersectionCurve> {
    whole(mesh, &Weld::near(&mesh.positions)).own_intersections(&|_| true).unwrap()
}

fn together(meshes: &[(&Mesh, DVec3)]) -> Mesh {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for (mesh, by) in meshes {
        indices.extend(mesh.indices.iter().map(|i| i + positions.len() as u32));
        positions.extend(mesh.positions.iter().map(|p| *p + by.as_vec3()));
    }
    primitives::from_triangles(positions, indices)
}

/// The length of all that bends by more than an angle, radians.
fn length(curves: &[IntersectionCurve], least: f32) -> f64 {
    let segments = curves.iter().flat_map(IntersectionCurve::segments).filter(|s| s.angle > least);
    segments.map(|s| f64::from(s.ends[0].distance(s.ends[1]))).sum()
}

#[test]
fn two_balls_meet_in_a_circle() {
    let balls = [primitives::sphere(1.0, 48, 96), primitives::sphere(1.0, 40, 72)];
    let [curves, swapped] = both_ways((&balls[0], at(0.0, 0.0, 0.0)), (&balls[1], at(1.0, 0.2, 0.1)));
    assert_eq!((curves.len(), swapped.len()), (1, 1), "one curve");
    assert!(curves[0].is_closed && swapped[0].is_closed);
    // The plane between both centers, and the radius there.
    let normal = DVec3::new(1.0, 0.2, 0.1);
    let radius = (1.0 - 0.25 * normal.length_squared()).sqrt();
    for point in &curves[0].points {
        let point = point.as_dvec3();
        let height = (point - 0.5 * normal).dot(normal.normalize());
        assert!(height.abs() < 0.004 && (point.length() - 1.0).abs() < 0.004, "{point} {height}");
    }
    let lengths = [&curves, &swapped].map(|curves| length(curves, 0.0));
    assert!((lengths[0] / (TAU * radius) - 1.0).abs() < 0.01, "{lengths:?} {radius}");
    assert!((lengths[0] - lengths[1]).abs() < 1e-4, "{lengths:?}");
    // Both normals are radii, so the angle between them is that between the radii.
    let angle = 2.0 * (0.5 * normal.length()).asin();
    let found = curves[0].angles.iter().map(|a| f64::from(*a));
    assert!(found.clone().all(|a| (a - angle).abs() < 0.1), "{angle} {:?}", found.collect::<Vec<_>>());
}

#[test]
fn a_place_far_away_and_another_scale_change_nothing() {
    let ball = primitives::sphere(1.0, 24, 48);
    let cube = primitives::cube(1.0);
    let near = both_ways((&ball, DMat4::IDENTITY), (&cube, at(0.9, 0.1, 0.2)));
    let place = at(5e6, -3e6, 1e6) * DMat4::from_rotation_y(0.7) * DMat4::from_scale(DVec3::splat(0.01));
    let far = both_ways((&ball, place), (&cube, place * at(0.9, 0.1, 0.2)));
    for (near, far) in near.iter().zip(&far) {
        assert_eq!(near.len(), far.len());
        assert!((length(near, 0.0) - length(far, 0.0)).abs() < 1e-4 * length(near, 0.0));
    }
}

#[test]
fn a_mesh_that_runs_through_itself_has_the_curves_of_its_parts() {
    let (ball, cube) = (primitives::sphere(1.0, 24, 48), primitives::cube(1.0));
    let by = DVec3::new(0.9, 0.1, 0.2);
    let [between, _] = both_ways((&ball, DMat4::IDENTITY), (&cube, at(by.x, by.y, by.z)));
    let inside = own(&together(&[(&ball, DVec3::ZERO), (&cube, by)]));
    assert!(between.iter().chain(&inside).all(|curve| curve.is_closed));
    assert_eq!(between.len(), inside.len());
    assert!((length(&between, 0.0) - length(&inside, 0.0)).abs() < 1e-4);
    assert!(
        own(&ball).is_empty()
            && own(&cube).is_empty()
            && own(&primitives::torus(1.0, 0.3, 40, 20)).is_empty()
    );
}

#[test]
fn a_search_says_how_far_it_is_and_can_be_stopped() {
    let tube = primitives::torus(1.0, 0.3, 200, 100);
    let weld = Weld::near(&tube.positions);
    let searched = whole(&tube, &weld);
    let done = AtomicUsize::new(0);
    let count = |triangles: usize| done.fetch_add(triangles, Ordering::Relaxed) < usize::MAX;
    assert!(searched.own_intersections(&count).is_some());
    assert_eq!(done.into_inner(), tube.triangle_count());
    assert_eq!(searched.own_intersections(&|_| false), None);
}

#[test]
fn a_region_that_holds_the_curves_is_enough() {
    let (ball, cube) = (primitives::sphere(1.0, 24, 48), primitives::cube(1.0));
    let by = DVec3::new(0.9, 0.1, 0.2);
    let both = together(&[(&ball, DVec3::ZERO), (&cube, by)]);
    let bodies = Topology::new(&both, 0.5, CreaseRule::default()).bodies;
    let region = bodies.shared_region(&both);
    let expected = ball.bounds().intersection(&cube.bounds().transformed(&at(by.x, by.y, by.z)));
    assert!(region.min.distance(expected.min).max(region.max.distance(expected.max)) < 1e-6, "{region:?}");
    let weld = Weld::near(&both.positions);
    let part = SearchedMesh::new(&both, &weld, &region);
    assert!(part.triangle_count() < both.triangle_count() / 2);
    let curves = part.own_intersections(&|_| true).unwrap();
    assert!((length(&curves, 0.0) - length(&own(&both), 0.0)).abs() < 1e-6);
    let alone = Topology::new(&ball, 0.5, CreaseRule::default()).bodies;
    assert!(alone.shared_region(&ball).is_empty());
}

#[test]
fn what_touches_along_its_own_edges_has_no_curve() {
    let cube = primitives::cube(1.0);
    let [beside, _] = both_ways((&cube, DMat4::IDENTITY), (&cube, at(1.0, 0.0, 0.0)));
    assert_eq!(length(&beside, 0.0), 0.0, "{beside:?}");
    let [apart, _] = both_ways((&cube, DMat4::IDENTITY), (&cube, at(3.0, 0.0, 0.0)));
    assert!(apart.is_empty());
}

#[test]
fn round_surfaces_on_each_other_bend_nowhere() {
    let (one, other) = (primitives::sphere(1.0, 32, 60), primitives::sphere(1.0, 29, 47));
    let [curves, _] = both_ways((&one, DMat4::IDENTITY), (&other, DMat4::from_rotation_x(0.3)));
    assert!(length(&curves, 0.5_f32.to_radians()) < 0.01, "{curves:?}");
    let flat = |mesh: &Mesh| Mesh { normals: Vec::new(), ..mesh.clone() };
    let [curves, _] = both_ways((&flat(&one), DMat4::IDENTITY), (&flat(&other), DMat4::from_rotation_x(0.3)));
    assert!(length(&curves, 2.0_f32.to_radians()) > 1.0, "their triangles do run through each other");
}

#[test]
fn squeezed_meshes_meet_at_the_angle_that_is_seen() {
    let plane = primitives::plane(2.0);
    let tilted = DMat4::from_rotation_x(0.5) * DMat4::from_rotation_z(0.1);
    let squeezed = DMat4::from_scale(DVec3::new(1.0, 1.0, 0.25)) * tilted;
    let seen = |world_from_local: DMat4| {
        let [a, b, c] = plane.corners(plane.triangles()[0]).map(|p| p.as_dvec3());
        let normal = |m: DMat4| {
            let [one, other] = [b - a, c - a].map(|side| m.transform_vector3(side));
            one.cross(other).normalize()
        };
        normal(world_from_local).dot(normal(DMat4::IDENTITY)).abs().acos()
    };
    for place in [tilted, squeezed] {
        let [curves, _] = both_ways((&plane, DMat4::IDENTITY), (&plane, place));
        let angles: Vec<f32> = curves.iter().flat_map(|c| c.angles.clone()).collect();
        assert!(!angles.is_empty());
        assert!(angles.iter().all(|a| (f64::from(*a) - seen(place)).abs() < 1e-3), "{angles:?}");
    }
}

#[test]
#[ignore = "a measurement: cargo test --release --lib intersections::tests::speed -- --ignored --nocapture"]
#[expect(clippy::print_stdout, reason = "a measurement")]
fn speed() {
    let tube = primitives::torus(1.0, 0.3, 1100, 500);
    let ball = primitives::sphere(1.0, 256, 512);
    let welds = [&tube, &ball].map(|mesh| Weld::near(&mesh.positions));
    let start = std::time::Instant::now();
    let tube = whole(&tube, &welds[0]);
    let built = start.elapsed();
    let ball = whole(&ball, &welds[1]);
    let start = std::time::Instant::now();
    let own = tube.own_intersections(&|_| true).unwrap().len();
    println!("{own} curves of 1.1 million triangles: tree {built:.0?}, search {:.0?}", start.elapsed());
    let placed = |mesh| Placed { mesh, world_from_local: DMat4::IDENTITY };
    let start = std::time::Instant::now();
    let curves = intersections(placed(&tube), placed(&ball));
    let segments: usize = curves.iter().map(|c| c.faces.len()).sum();
    println!("{} curves, {segments} segments with a ball of 262,144: {:.0?}", curves.len(), start.elapsed());
}
