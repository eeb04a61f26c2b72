use glam::{DMat4, DVec2, DVec3, Vec3};

use super::*;
use crate::geometry::{Bodies, BodyKind, Bounds, CreaseRule, Topology, primitives};

/// The contours of a mesh in a plane, and the coordinates of that.
fn cut(mesh: &Mesh, point: DVec3, normal: DVec3) -> (Vec<Contour>, DMat4) {
    let plane = Plane { point, normal: normal.normalize() };
    let world_from_plane = plane.world_from_plane(DVec3::new(0.3, -0.7, 0.64));
    (contours(mesh, &Weld::near(&mesh.positions), &world_from_plane.inverse()), world_from_plane)
}

fn bodies(mesh: &Mesh) -> Bodies {
    (*Topology::new(mesh, 0.5, CreaseRule::Normals).bodies).clone()
}

fn filling(mesh: &Mesh, point: DVec3, normal: DVec3) -> Filling {
    let (contours, world_from_plane) = cut(mesh, point, normal);
    fill(&contours, &bodies(mesh), &world_from_plane.inverse())
}

fn area_of(filling: &Filling) -> f64 {
    filling.cap.as_ref().map_or(0.0, Cap::area)
}

fn area(mesh: &Mesh, point: DVec3, normal: DVec3) -> f64 {
    area_of(&filling(mesh, point, normal))
}

fn length(contours: &[Contour]) -> f64 {
    contours.iter().flat_map(Contour::segments).map(|([a, b], _)| a.distance(b)).sum()
}

fn inside_out(mut mesh: Mesh) -> Mesh {
    mesh.indices.chunks_exact_mut(3).for_each(|t| t.swap(0, 1));
    mesh
}

fn moved(mut mesh: Mesh, by: Vec3) -> Mesh {
    mesh.positions.iter_mut().for_each(|p| *p += by);
    mesh
}

fn together(meshes: &[Mesh]) -> Mesh {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for mesh in meshes {
        indices.extend(mesh.indices.iter().map(|i| i + positions.len() as u32));
        positions.extend(&mesh.positions);
    }
    primitives::from_triangles(positions, indices)
}

#[test]
#[ignore = "a measurement: cargo test --release --lib section::tests::speed -- --ignored --nocapture"]
#[expect(clippy::print_stdout, reason = "a measurement")]
fn speed() {
    let ball = primitives::sphere(1.0, 512, 1024);
    let tube = primitives::torus(1.0, 0.3, 1100, 500);
    for (name, mesh) in [("ball", ball), ("tube", tube)] {
        let weld = Weld::near(&mesh.positions);
        let bodies = bodies(&mesh);
        for normal in [DVec3::X, DVec3::Y, DVec3::new(0.3, 0.5, 0.8)] {
            let plane = Plane { point: normal * 0.05, normal: normal.normalize() };
            let plane_from_local = plane.world_from_plane(DVec3::ONE).inverse();
            let mut times: Vec<[f64; 2]> = (0..15)
                .map(|_| {
                    let start = std::time::Instant::now();
                    let found = contours(&mesh, &weld, &plane_from_local);
                    let cut = start.elapsed();
                    assert!(fill(&found, &bodies, &plane_from_local).cap.is_some());
                    [cut, start.elapsed() - cut].map(|time| 1e3 * time.as_secs_f64())
                })
                .collect();
            times.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let [contours, cap] = times[times.len() / 2];
            println!(
                "{name}, {} triangles: contours {contours:.2} ms, cap {cap:.2} ms",
                mesh.triangle_count()
            );
        }
    }
}

#[test]
fn a_cube_is_cut_into_a_square_a_hexagon_and_a_triangle() {
    for mesh in [primitives::cube(2.0), primitives::cube_split(2.0)] {
        let (square, _) = cut(&mesh, DVec3::new(0.0, 0.3, 0.0), DVec3::Y);
        assert_eq!(square.len(), 1);
        assert!(square[0].is_closed && (length(&square) - 8.0).abs() < 1e-9);
        assert!((area(&mesh, DVec3::new(0.0, 0.3, 0.0), DVec3::Y) - 4.0).abs() < 1e-7);
        // Through the middle, across the space diagonal: a regular hexagon with sides of √2.
        let hexagon = 1.5 * 3.0_f64.sqrt() * 2.0;
        assert!((area(&mesh, DVec3::ZERO, DVec3::ONE) - hexagon).abs() < 1e-7);
        // One corner cut off, at distance 1 along each edge: an equilateral triangle with sides of √2.
        let triangle = 3.0_f64.sqrt() / 2.0;
        assert!((area(&mesh, DVec3::new(1.0, 1.0, 0.0), DVec3::ONE) - triangle).abs() < 1e-7);
    }
}

#[test]
fn planes_through_vertices_edges_and_faces_leave_no_crack() {
    let cube = primitives::cube(2.0);
    // Along a diagonal of two faces: through four vertices and two edges.
    assert!((area(&cube, DVec3::ZERO, DVec3::new(1.0, 0.0, -1.0)) - 2.0 * 8.0_f64.sqrt()).abs() < 1e-7);
    assert!((area(&cube, DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0)) - 2.0 * 8.0_f64.sqrt()).abs() < 1e-7);
    // In a face: what touches the plane from below is kept up to it; what lies over it is cut away whole.
    assert!((area(&cube, DVec3::Y, DVec3::Y) - 4.0).abs() < 1e-7);
    assert_eq!(area(&cube, DVec3::NEG_Y, DVec3::Y), 0.0);
    let sphere = primitives::sphere(1.0, 16, 24);
    // Through the equator's vertices, and through the poles along meridians.
    for normal in [DVec3::Y, DVec3::X, DVec3::Z, DVec3::new(1.0, 1.0, 0.0)] {
        let (contours, _) = cut(&sphere, DVec3::ZERO, normal);
        assert!(contours.iter().all(|c| c.is_closed) && contours.len() == 1, "{normal}");
    }
}

#[test]
fn spheres_and_tori_have_the_areas_of_their_formulas() {
    let sphere = primitives::sphere(1.0, 256, 512);
    for (height, normal) in [(0.0, DVec3::Y), (0.37, DVec3::Z), (-0.81, DVec3::new(1.0, -2.0, 0.5))] {
        let exact = std::f64::consts::PI * (1.0 - height * height);
        let found = area(&sphere, normal.normalize() * height, normal);
        assert!((found / exact - 1.0).abs() < 2e-3, "{height}: {found}, {exact}");
    }
    // Lying in its plane a ring, upright two discs, along its axis at the tube's height a ring again.
    let torus = primitives::torus(1.0, 0.3, 512, 256);
    let pi = std::f64::consts::PI;
    let axis = [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .min_by(|a, b| extent(&torus, *a).total_cmp(&extent(&torus, *b)))
        .unwrap();
    let across = axis.any_orthonormal_vector();
    let ring = pi * (1.3 * 1.3 - 0.7 * 0.7);
    assert!((area(&torus, DVec3::ZERO, axis) / ring - 1.0).abs() < 2e-3);
    assert!((area(&torus, DVec3::ZERO, across) / (2.0 * pi * 0.09) - 1.0).abs() < 2e-3);
    assert_eq!(cut(&torus, DVec3::ZERO, axis).0.len(), 2);
}

fn extent(mesh: &Mesh, axis: DVec3) -> f64 {
    let Bounds { min, max } = mesh.bounds();
    (max - min).dot(axis)
}

#[test]
fn nested_and_touching_shells_are_filled_by_what_they_enclose() {
    let (outer, inner) = (primitives::cube(2.0), primitives::cube(1.0));
    let hollow = together(&[outer.clone(), inside_out(inner.clone())]);
    assert!((area(&hollow, DVec3::ZERO, DVec3::Y) - 3.0).abs() < 1e-7);
    let ball_in_it = together(&[hollow, primitives::cube(0.5)]);
    assert!((area(&ball_in_it, DVec3::ZERO, DVec3::Y) - 3.25).abs() < 1e-7);
    let overlapping = together(&[outer.clone(), moved(inner.clone(), Vec3::X)]);
    assert!((area(&overlapping, DVec3::ZERO, DVec3::Y) - 4.5).abs() < 1e-6);
    let swallowed = together(&[outer, inner]);
    assert!((area(&swallowed, DVec3::ZERO, DVec3::Y) - 4.0).abs() < 1e-7);
}

#[test]
fn each_body_is_filled_for_itself() {
    let mut open = moved(primitives::cube(1.0), Vec3::X * 2.0);
    open.indices.truncate(30);
    let lone = inside_out(moved(primitives::cube(1.0), Vec3::X * 4.0));
    let all = together(&[primitives::cube(2.0), inside_out(primitives::cube(1.0)), open, lone]);
    assert_eq!(bodies(&all).kinds(), [BodyKind::Solid, BodyKind::Cavity, BodyKind::Open, BodyKind::Open]);
    let found = filling(&all, DVec3::ZERO, DVec3::Y);
    assert!((area_of(&found) - 3.0).abs() < 1e-7 && found.open_count == 2, "{found:?}");
}

#[test]
fn boxes_that_touch_along_an_edge_are_filled() {
    let boxes = together(&[primitives::cube(1.0), moved(primitives::cube(1.0), Vec3::new(1.0, 0.0, 1.0))]);
    for (point, normal, exact) in [
        (DVec3::ZERO, DVec3::Y, 2.0),
        (DVec3::new(0.5, 0.0, 0.5), DVec3::new(1.0, 0.0, -1.0), 8.0_f64.sqrt()),
        (DVec3::new(0.1, 0.1, 0.1), DVec3::new(0.1, 1.0, 0.2), 2.0 * (1.0 + 0.05_f64).sqrt()),
    ] {
        let found = filling(&boxes, point, normal);
        assert!((area_of(&found) - exact).abs() < 1e-6 && found.open_count == 0, "{normal}: {found:?}");
    }
}

/// A box whose lid shares no vertices with its walls. It is cut into strips, whose ends lie `gap` too high between the
/// corners. Of the four sides, which are loose as well, so many are there.
fn loose_box(strips: u32, gap: f32, sides: usize) -> Mesh {
    let mut walls = primitives::cube_split(1.0);
    walls.normals.clear();
    walls.uvs.clear();
    let of_lid = |t: &&[u32; 3]| t.iter().all(|&v| walls.positions[v as usize].y > 0.0);
    let of_floor = |t: &&[u32; 3]| t.iter().all(|&v| walls.positions[v as usize].y < 0.0);
    let is_side = |t: &&[u32; 3]| !of_lid(t) && !of_floor(t);
    let triangles = walls.triangles();
    let kept = triangles.iter().filter(is_side).take(2 * sides).chain(triangles.iter().filter(of_floor));
    let walls = primitives::from_triangles(walls.positions.clone(), kept.flatten().copied().collect());
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for i in 0..=strips {
        let height = if i == 0 || i == strips { 0.5 } else { 0.5 + gap };
        positions.extend([-0.5, 0.5].map(|z| Vec3::new(i as f32 / strips as f32 - 0.5, height, z)));
    }
    for a in (0..2 * strips).step_by(2) {
        indices.extend([a, a + 1, a + 2, a + 2, a + 1, a + 3]);
    }
    together(&[walls, primitives::from_triangles(positions, indices)])
}

#[test]
fn contours_are_joined_where_faces_are_divided_differently() {
    for (strips, gap) in [(1, 0.0), (2, 0.0), (5, 0.0), (5, 2e-3)] {
        let mesh = loose_box(strips, gap, 4);
        assert_eq!(bodies(&mesh).kinds(), [BodyKind::Solid], "{strips} {gap}");
        let oblique = DVec3::new(1.0, 0.0, 1.0);
        for (normal, exact) in [(DVec3::X, 1.0), (DVec3::Z, 1.0), (oblique, 2.0_f64.sqrt())] {
            let found = filling(&mesh, DVec3::new(0.01, 0.0, -0.01), normal);
            assert!(found.open_count == 0, "{strips} {gap} {normal}: {found:?}");
            assert!((area_of(&found) / exact - 1.0).abs() < 0.01, "{strips} {gap} {normal}");
        }
    }
}

#[test]
fn wide_gaps_open_a_body_even_if_they_face_each_other() {
    for mesh in [loose_box(5, 0.05, 4), loose_box(2, 0.0, 3), loose_box(2, 0.0, 2), loose_box(2, 0.0, 0)] {
        assert!(bodies(&mesh).kinds().iter().all(|kind| *kind == BodyKind::Open));
        assert_eq!(filling(&mesh, DVec3::ZERO, DVec3::X).cap, None);
    }
}

#[test]
fn contours_with_wide_gaps_are_left_open() {
    let point = |x: f64, y: f64| DVec2::new(x, y);
    let cube = primitives::cube(1.0);
    let reach = bodies(&cube).widest_gap();
    let filled = |gap: f64| {
        let half = |points: Vec<DVec2>| Contour { points, triangles: vec![0; 2], is_closed: false };
        let lower = half(vec![point(0.0, 0.0), point(1.0, 0.0), point(1.0, 1.0)]);
        let upper = half(vec![point(1.0 - gap, 1.0), point(0.0, 1.0), point(0.0, gap)]);
        fill(&[lower, upper], &bodies(&cube), &DMat4::IDENTITY)
    };
    assert!((area_of(&filled(0.5 * reach)) - 1.0).abs() < reach);
    assert_eq!(filled(1.5 * reach), Filling { cap: None, open_count: 1 });
}

#[test]
fn what_one_side_keeps_the_other_one_cuts_away() {
    let mesh = primitives::torus(1.0, 0.3, 33, 17);
    for normal in [DVec3::X, DVec3::new(0.2, 0.9, -0.4)] {
        let point = normal.normalize() * 0.123;
        let (one, other) = (area(&mesh, point, normal), area(&mesh, point, -normal));
        assert!(one > 0.1 && (one - other).abs() < 1e-7, "{one} {other}");
    }
}

#[test]
fn where_a_mesh_lies_turns_its_contours_but_not_inside_out() {
    let mesh = primitives::sphere(1.0, 12, 16);
    let plane = Plane { point: DVec3::new(0.2, 0.0, 0.0), normal: DVec3::X };
    let plane_from_world = plane.world_from_plane(DVec3::Y).inverse();
    let places = [DMat4::IDENTITY, DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0))];
    let areas = places.map(|place| {
        let plane_from_local = plane_from_world * place;
        let found = contours(&mesh, &Weld::near(&mesh.positions), &plane_from_local);
        area_of(&fill(&found, &bodies(&mesh), &plane_from_local))
    });
    assert!(areas[0] > 2.5 && (areas[0] - areas[1]).abs() < 1e-7, "{areas:?}");
}

#[test]
fn contours_lie_on_the_mesh_and_know_their_triangles() {
    let mesh = primitives::torus(1.0, 0.3, 20, 10);
    let (found, world_from_plane) = cut(&mesh, DVec3::new(0.1, 0.2, 0.05), DVec3::new(0.5, 1.0, 0.3));
    assert!(!found.is_empty());
    for ([a, b], triangle) in found.iter().flat_map(Contour::segments) {
        let corners = mesh.corners(mesh.triangles()[triangle as usize]).map(|p| p.as_dvec3());
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        for end in [a, b] {
            let world = world_from_plane.transform_point3(end.extend(0.0));
            assert!(normal.dot(world - corners[0]).abs() < 1e-6);
        }
        // Material is to the left, so that the outside is to the right.
        let outside = -(b - a).perp();
        assert!(world_from_plane.transform_vector3(outside.extend(0.0)).dot(normal) > -1e-9);
    }
}

#[test]
fn open_surfaces_have_contours_and_no_cap() {
    let mut open = primitives::cube(2.0);
    open.indices.truncate(30);
    open.submeshes[0].index_count = 30;
    let found: Vec<_> =
        [DVec3::X, DVec3::Y, DVec3::Z].into_iter().map(|n| cut(&open, DVec3::ZERO, n).0).collect();
    assert!(found.iter().all(|c| !c.is_empty()));
    let is_open = |c: &&Vec<Contour>| c.iter().any(|c| !c.is_closed);
    assert_eq!(found.iter().filter(is_open).count(), 2);
    for normal in [DVec3::X, DVec3::Y, DVec3::Z] {
        assert_eq!(filling(&open, DVec3::ZERO, normal), Filling { cap: None, open_count: 1 });
    }
    let (line, _) = cut(&primitives::plane(2.0), DVec3::ZERO, DVec3::X);
    assert!(line.len() == 1 && !line[0].is_closed && (length(&line) - 2.0).abs() < 1e-9);
    assert_eq!(line[0].points.len(), line[0].triangles.len() + 1);
}

#[test]
fn nothing_and_broken_numbers_give_nothing() {
    let cube = primitives::cube(1.0);
    assert!(cut(&cube, DVec3::new(0.0, 2.0, 0.0), DVec3::Y).0.is_empty());
    assert!(cut(&cube, DVec3::new(0.0, -2.0, 0.0), DVec3::Y).0.is_empty());
    assert!(contours(&Mesh::default(), &Weld::near(&[]), &DMat4::IDENTITY).is_empty());
    let weld = Weld::near(&cube.positions);
    for broken in
        [DMat4::ZERO, DMat4::from_scale(DVec3::splat(f64::NAN)), DMat4::from_scale(DVec3::splat(1e100))]
    {
        let filling = fill(&contours(&cube, &weld, &broken), &bodies(&cube), &broken);
        assert!(area_of(&filling).is_finite());
    }
    let point = |x: f64| DVec2::new(x, 0.0);
    let flat = Contour { points: vec![point(0.0), point(1.0)], triangles: vec![0, 1], is_closed: true };
    assert_eq!(fill(&[flat], &bodies(&cube), &DMat4::IDENTITY).cap, None);
    assert_eq!(fill(&[], &bodies(&cube), &DMat4::IDENTITY), Filling::default());
    assert_eq!(fill(&[Contour::default()], &bodies(&Mesh::default()), &DMat4::NAN).open_count, 1);
}
