use std::f32::consts::TAU;

use glam::{Quat, Vec2, Vec3};

use super::*;
use crate::geometry::primitives::{cube, cube_split, from_triangles, plane, sphere, torus};

fn solve(mesh: &Mesh, options: &FieldOptions) -> DirectionField {
    let field = DirectionField::solve(mesh, options, &|_| true).unwrap();
    assert_eq!(field.corner_vertices.len(), mesh.indices.len());
    assert_eq!(field.directions.len(), field.normals.len());
    for (direction, normal) in field.directions.iter().zip(&field.normals) {
        assert!((direction.length() - 1.0).abs() < 1e-4 && direction.dot(*normal).abs() < 1e-4);
    }
    field
}

/// Without a preference for level strokes, so that only the form counts.
fn of_form() -> FieldOptions {
    FieldOptions { level: 0.0, ..FieldOptions::default() }
}

/// The largest angle in degrees between the direction at a corner and `expected` at its position; `None` is not looked
/// at.
fn worst(mesh: &Mesh, field: &DirectionField, expected: impl Fn(Vec3) -> Option<Vec3>) -> f32 {
    let mut worst: f32 = 0.0;
    let mut count = 0;
    for (&v, &corner) in mesh.indices.iter().zip(&field.corner_vertices) {
        if let Some(direction) = expected(mesh.positions[v as usize]) {
            let across = direction.reject_from_normalized(field.normals[corner as usize]).normalize();
            let cos = across.dot(field.directions[corner as usize]).abs();
            worst = worst.max(cos.min(1.0).acos().to_degrees());
            count += 1;
        }
    }
    assert!(count > 0);
    worst
}

/// A patch over (0..1)² whose grid is jittered and whose diagonals alternate irregularly; closed along u if `around`.
fn patch(columns: u32, rows: u32, around: bool, at: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let noise = |k: u32| (k.wrapping_mul(0x9e37_79b9) ^ 0x85eb_ca6b).wrapping_mul(0xc2b2_ae35) >> 8;
    let unit = |k: u32| noise(k) as f32 / 16_777_216.0 - 0.5;
    let mut positions = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let wrapped = if around { column % columns } else { column };
            let k = 2 * (row * (columns + 1) + wrapped);
            let inside = row > 0 && row < rows;
            let jitter = |k: u32, moves: bool| if moves { 0.5 * unit(k) } else { 0.0 };
            let u = wrapped as f32 + jitter(k, around || (column > 0 && column < columns));
            let v = row as f32 + jitter(k + 1, inside);
            positions.push(at(u / columns as f32, v / rows as f32));
        }
    }
    let mut indices = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let a = row * (columns + 1) + column;
            let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
            indices.extend(if noise(a) & 1 == 0 { [a, b, c, a, c, d] } else { [a, b, d, b, c, d] });
        }
    }
    from_triangles(positions, indices)
}

fn cylinder(segments: u32, height: f32, capped: bool) -> Mesh {
    let mut positions = Vec::new();
    let mut indices = Vec::new();
    for k in 0..segments {
        let (sin, cos) = (k as f32 / segments as f32 * TAU).sin_cos();
        positions.extend([Vec3::new(-0.5 * height, cos, sin), Vec3::new(0.5 * height, cos, sin)]);
        let (a, b) = (2 * k, 2 * ((k + 1) % segments));
        indices.extend([a, a + 1, b + 1, a, b + 1, b]);
    }
    if capped {
        for k in 1..segments - 1 {
            indices.extend([0, 2 * k, 2 * k + 2, 1, 2 * k + 3, 2 * k + 1]);
        }
    }
    from_triangles(positions, indices)
}

/// A molding around a square: its profile is a flat arch of this height, of which the angle at the corners is no crease.
fn frame(height: f32) -> Mesh {
    const PROFILE: u32 = 9;
    let mut positions = Vec::new();
    for corner in [Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0), Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0)] {
        for k in 0..PROFILE {
            let across = k as f32 / (PROFILE - 1) as f32 - 0.5;
            let rise = height * (1.0 - 4.0 * across * across);
            positions.push((corner * (1.0 + 0.1 * across)).extend(rise));
        }
    }
    let mut indices = Vec::new();
    for side in 0..4 {
        for k in 0..PROFILE - 1 {
            let (a, b) = (side * PROFILE + k, (side + 1) % 4 * PROFILE + k);
            indices.extend([a, b, b + 1, a, b + 1, a + 1]);
        }
    }
    from_triangles(positions, indices)
}

#[test]
fn a_molding_is_ruled_across_or_lengthwise_up_to_the_corners_of_a_frame() {
    let mesh = frame(0.02);
    // Wide in its scene, and narrow.
    for (extent, expected) in [(1.0, 0.0), (5.0, 1.0)] {
        let field = solve(&mesh, &FieldOptions { extent, ..of_form() });
        for (triangle, corners) in mesh.triangles().iter().zip(field.corner_vertices.as_chunks::<3>().0) {
            let middle = triangle.iter().map(|&v| mesh.positions[v as usize]).sum::<Vec3>() / 3.0;
            let along = if middle.x.abs() > middle.y.abs() { Vec3::Y } else { Vec3::X };
            for &corner in corners {
                let lengthwise = field.directions[corner as usize].dot(along).abs();
                assert!((lengthwise - expected).abs() < 0.02, "near {middle}: {lengthwise}");
            }
        }
    }
}

#[test]
fn a_flat_side_is_whole_whatever_strips_it_is_made_of() {
    let mesh = frame(0.0);
    let field = solve(&mesh, &of_form());
    assert_eq!(field.directions.len(), mesh.positions.len());
    assert!(field.directions.iter().all(|direction| direction.dot(field.directions[0]).abs() > 0.999));
}

#[test]
fn strokes_run_around_cylinders_of_any_number_of_facets() {
    for segments in [10, 12, 16, 24, 32, 64, 128, 256] {
        for height in [0.2, 1.0, 5.0, 40.0] {
            for extent in [0.0, 100.0] {
                let mesh = cylinder(segments, height, true);
                let field = solve(&mesh, &FieldOptions { extent, ..FieldOptions::default() });
                let around = |p: Vec3| Some(Vec3::X.cross(Vec3::new(0.0, p.y, p.z)));
                let sides = Mesh { indices: mesh.indices[..6 * segments as usize].to_vec(), ..mesh.clone() };
                let error = worst(&sides, &field, around);
                assert!(error < 3.0, "{error} degrees, {segments} facets, height {height}");
            }
        }
    }
}

#[test]
fn gutters_that_are_narrow_in_their_scene_are_ruled_lengthwise_and_poles_are_not() {
    let pole = cylinder(24, 20.0, false);
    let gutter = Mesh { indices: pole.indices[..6 * 12].to_vec(), ..pole.clone() };
    let off = |mesh: &Mesh, extent: f32| {
        let field = solve(mesh, &FieldOptions { extent, ..of_form() });
        worst(mesh, &field, |_| Some(Vec3::X))
    };
    let [narrow, wide] = [200.0, 40.0].map(|extent| off(&gutter, extent));
    assert!(narrow < 3.0 && wide > 87.0, "{narrow} {wide}");
    assert!(off(&pole, 400.0) > 87.0);
    // There is no room for several lines.
    assert!(off(&gutter, 4000.0) > 87.0);
}

#[test]
fn rings_are_ruled_around_however_narrow() {
    let mesh = cylinder(48, 0.2, false);
    let field = solve(&mesh, &FieldOptions { extent: 400.0, ..of_form() });
    let error = worst(&mesh, &field, |p| Some(Vec3::X.cross(p)));
    assert!(error < 3.0, "{error}");
}

#[test]
fn strokes_run_along_the_long_side_of_a_box() {
    for turn in [Quat::IDENTITY, Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7)] {
        let mut mesh = cube(1.0);
        for p in &mut mesh.positions {
            *p = turn * (*p * Vec3::new(3.0, 2.0, 1.0));
        }
        let field = solve(&mesh, &FieldOptions::default());
        for (corners, triangle) in field.corner_vertices.chunks(3).zip(mesh.triangles()) {
            let normal = turn.inverse() * crate::geometry::normals::face_normal(mesh.corners(*triangle));
            let long = turn * if normal.x.abs() > 0.5 { Vec3::Y } else { Vec3::X };
            for &corner in corners {
                assert!(field.directions[corner as usize].dot(long).abs() > 0.999, "{normal}");
            }
        }
    }
}

#[test]
fn a_box_with_round_edges_is_ruled_straight() {
    // A square prism whose four long edges are rounded, along X; the sides are wide, the fillets narrow.
    let (half, radius, steps) = (1.0, 0.15, 6);
    let mut outline = Vec::new();
    for corner in 0..4 {
        for step in 0..=steps {
            let angle = (corner as f32 + step as f32 / steps as f32) * TAU / 4.0;
            let middle = Vec2::from_angle((corner as f32 + 0.5) * TAU / 4.0) * 2_f32.sqrt() * (half - radius);
            outline.push(middle + radius * Vec2::from_angle(angle));
        }
    }
    let n = outline.len() as u32;
    let positions = outline.iter().flat_map(|p| [-3.0, 3.0].map(|x| Vec3::new(x, p.x, p.y))).collect();
    let indices = (0..n).flat_map(|k| {
        [2 * k, 2 * k + 1, 2 * ((k + 1) % n) + 1, 2 * k, 2 * ((k + 1) % n) + 1, 2 * ((k + 1) % n)]
    });
    let mesh = from_triangles(positions, indices.collect());
    // The fillets alone are narrow in the second scene, but parts of what is not.
    for extent in [0.0, 60.0] {
        let field = solve(&mesh, &FieldOptions { extent, ..of_form() });
        // Only long edges go on: the strokes cross them, all around.
        let error = worst(&mesh, &field, |p| {
            let flat = p.y.abs().min(p.z.abs()) < half - radius + 0.01;
            flat.then_some(if p.y.abs() > p.z.abs() { Vec3::Z } else { Vec3::Y })
        });
        assert!(error < 3.0, "{error}");
    }
}

#[test]
fn flat_sides_are_cut_from_fillets_along_their_strokes() {
    let (half, radius) = (Vec3::new(2.0, 1.2, 0.7), 0.1);
    let mut mesh = sphere(1.0, 25, 48);
    mesh.normals.clear();
    for p in &mut mesh.positions {
        // Half a step, so that no point of the sphere lies on the border of two octants.
        let n = Quat::from_rotation_y(TAU / 96.0) * *p;
        *p = n * radius + n.signum() * (half - radius);
    }
    // Points along the edges, not only at their ends.
    for _ in 0..2 {
        let halves = |t: &[u32; 3]| {
            let [a, b, c] = mesh.corners(*t);
            let [d, e, f] = [a.midpoint(b), b.midpoint(c), c.midpoint(a)];
            [a, d, f, d, b, e, f, e, c, d, e, f]
        };
        let loose: Vec<Vec3> = mesh.triangles().iter().flat_map(halves).collect();
        let (points, indices) = crate::geometry::Weld::exact(&loose).indexed(&loose);
        mesh = from_triangles(points, indices);
    }
    let field = solve(&mesh, &of_form());
    for (corners, triangle) in field.corner_vertices.chunks(3).zip(mesh.triangles()) {
        let normal = crate::geometry::normals::face_normal(mesh.corners(*triangle));
        if normal.z.abs() > 0.999_9 {
            assert!(corners.iter().all(|v| field.directions[*v as usize].x.abs() > 0.99));
        }
    }
    let axis = FieldOptions { source: DirectionSource::Axis(Vec3::X), ..of_form() };
    assert!(field.directions.len() > solve(&mesh, &axis).directions.len() + 8);
}

#[test]
fn directions_agree_where_they_can() {
    let mesh = torus(2.0, 0.5, 48, 32);
    let field = solve(&mesh, &of_form());
    for corners in field.corner_vertices.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|k| field.directions[corners[k] as usize]);
        assert!(a.dot(b) > 0.0 && b.dot(c) > 0.0);
    }
}

#[test]
fn irregular_tori_cylinders_saddles_and_ellipsoids_get_their_directions_of_curvature() {
    let pipe = patch(40, 30, true, |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        Vec3::new(cos, sin, 4.0 * v)
    });
    let error = worst(&pipe, &solve(&pipe, &of_form()), |p| Some(Vec3::Z.cross(p)));
    assert!(error < 3.0, "cylinder: {error}");

    let ring = patch(48, 96, true, |u, v| {
        let ((sin, cos), (sin_tube, cos_tube)) = ((v.fract() * TAU).sin_cos(), (u * TAU).sin_cos());
        Vec3::new(cos * (2.0 + 0.5 * cos_tube), sin * (2.0 + 0.5 * cos_tube), 0.5 * sin_tube)
    });
    let error = worst(&ring, &solve(&ring, &of_form()), |p| {
        let radial = p.with_z(0.0).normalize();
        let around = Vec3::Z.cross(radial);
        // Both ends of the patch are jittered differently.
        (radial.x < 0.9).then(|| around.cross(p - 2.0 * radial))
    });
    assert!(error < 3.0, "torus: {error}");

    // A parabolic cylinder that is bent the other way, but less.
    let saddle = patch(60, 60, false, |u, v| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        Vec3::new(x, y, 0.45 * x * x - 0.15 * y * y)
    });
    let error = worst(&saddle, &solve(&saddle, &of_form()), |p| {
        (p.x.abs().max(p.y.abs()) < 0.3).then(|| Vec3::new(1.0, 0.0, 0.9 * p.x))
    });
    assert!(error < 3.0, "saddle: {error}");

    // Of revolution, with its umbilics at the poles, which are left out of the mesh.
    let egg = patch(80, 80, true, |u, v| {
        let ((sin, cos), (high, wide)) = ((u * TAU).sin_cos(), ((v - 0.5) * 2.4).sin_cos());
        Vec3::new(cos * wide, sin * wide, 2.5 * high)
    });
    let error = worst(&egg, &solve(&egg, &of_form()), |p| Some(Vec3::Z.cross(p)));
    assert!(error < 3.0, "ellipsoid: {error}");
}

#[test]
fn shading_normals_help_but_are_not_believed_blindly() {
    let mesh = torus(2.0, 0.5, 48, 32);
    let around_tube = |p: Vec3| {
        let radial = p.with_y(0.0).normalize();
        Some(Vec3::Y.cross(radial).cross(p - 2.0 * radial))
    };
    for normals in [
        mesh.normals.clone(),
        Vec::new(),
        vec![Vec3::NAN; mesh.normals.len()],
        vec![Vec3::Y; mesh.normals.len()],
    ] {
        let mesh = Mesh { normals, ..mesh.clone() };
        let error = worst(&mesh, &solve(&mesh, &of_form()), around_tube);
        assert!(error < 3.0, "{error}");
    }
}

#[test]
fn a_sphere_gets_circles_around_its_vertical_axis() {
    let mesh = sphere(1.0, 24, 48);
    for up in [Vec3::Y, Vec3::Z] {
        let field = solve(&mesh, &FieldOptions { up, ..FieldOptions::default() });
        let level = |p: Vec3| (p.dot(up).abs() < 0.7).then(|| up.cross(p));
        let error = worst(&mesh, &field, level);
        assert!(error < 8.0, "{error}");
    }
}

#[test]
fn texture_and_axes_are_followed() {
    let mesh = torus(2.0, 0.5, 48, 32);
    let with = |source| FieldOptions { source, ..FieldOptions::default() };
    let around = |p: Vec3| Some(Vec3::Y.cross(p));
    let error = worst(&mesh, &solve(&mesh, &with(DirectionSource::TextureU)), around);
    assert!(error < 3.0, "U: {error}");
    let around_tube = |p: Vec3| {
        let radial = p.with_y(0.0).normalize();
        Some(Vec3::Y.cross(radial).cross(p - 2.0 * radial))
    };
    let error = worst(&mesh, &solve(&mesh, &with(DirectionSource::TextureV)), around_tube);
    assert!(error < 3.0, "V: {error}");
    let axis = Vec3::new(0.0, 7.0, 0.0);
    let upright = |p: Vec3| {
        let normal = p - 2.0 * p.with_y(0.0).normalize();
        let along = Vec3::Y - normal * normal.y / normal.length_squared();
        (along.length() > 0.5).then_some(along)
    };
    let error = worst(&mesh, &solve(&mesh, &with(DirectionSource::Axis(axis))), upright);
    assert!(error < 3.0, "axis: {error}");
}

#[test]
fn texture_without_area_takes_the_direction_of_its_neighbors() {
    let mut mesh = patch(20, 20, false, |u, v| Vec3::new(u, v, 0.0));
    mesh.uvs = mesh.positions.iter().map(|p| Vec2::new(p.x + p.y, p.x - p.y)).collect();
    for (v, uv) in mesh.uvs.iter_mut().enumerate().filter(|(v, _)| v % 5 == 2) {
        *uv = if v % 2 == 0 { Vec2::NAN } else { *uv };
    }
    let options = FieldOptions { source: DirectionSource::TextureU, ..FieldOptions::default() };
    let error = worst(&mesh, &solve(&mesh, &options), |_| Some(Vec3::new(1.0, 1.0, 0.0)));
    assert!(error < 3.0, "{error}");
}

#[test]
fn creases_cut_and_smooth_edges_do_not() {
    assert_eq!(solve(&cube(1.0), &FieldOptions::default()).directions.len(), 24);
    assert_eq!(solve(&cube_split(1.0), &FieldOptions::default()).directions.len(), 24);
    let uncut =
        FieldOptions { crease_angle: 3.0, source: DirectionSource::Axis(Vec3::X), ..FieldOptions::default() };
    assert_eq!(solve(&cube_split(1.0), &uncut).directions.len(), 8);
    // Seams of texture are no creases: 16 * 24 points.
    assert_eq!(solve(&torus(2.0, 0.5, 24, 16), &FieldOptions::default()).directions.len(), 384);
}

#[test]
fn hostile_meshes_have_a_field() {
    let options = FieldOptions::default();
    let corner = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X];
    let loose = |positions: Vec<Vec3>, indices: Vec<u32>| Mesh { positions, indices, ..Mesh::default() };
    solve(&Mesh::default(), &options);
    solve(&loose(corner.clone(), Vec::new()), &options);
    solve(&loose(corner.clone(), vec![0, 1, 2]), &options);
    solve(&loose(corner.clone(), vec![0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 1, 2]), &options);
    solve(&loose(corner.clone(), vec![0, 0, 1, 2, 2, 2]), &options);
    solve(&loose(vec![Vec3::ONE; 3], vec![0, 1, 2]), &options);
    solve(&loose(corner.clone(), vec![0, 1, 9]), &options);
    solve(&loose(corner.clone(), vec![0, 1, 2, 3]), &options);
    solve(&loose(vec![Vec3::NAN, Vec3::X, Vec3::Y], vec![0, 1, 2]), &options);
    for scale in [1e-30, 1e-12, 1e12, 1e30] {
        let mut mesh = torus(2.0, 0.5, 24, 16);
        mesh.positions.iter_mut().for_each(|p| *p *= scale);
        for extent in [0.0, f32::NAN, f32::MAX, f32::MIN_POSITIVE, -1.0] {
            solve(&mesh, &FieldOptions { extent, smoothing: f32::NAN, up: Vec3::ZERO, ..options });
        }
    }
    let axis = DirectionSource::Axis(Vec3::NAN);
    solve(
        &plane(1.0),
        &FieldOptions { source: axis, up: Vec3::NAN, level: f32::NAN, crease_angle: f32::NAN, ..options },
    );
}

#[test]
fn the_field_can_be_canceled_and_does_not_depend_on_threads() {
    let mesh = torus(2.0, 0.5, 200, 100);
    assert!(DirectionField::solve(&mesh, &of_form(), &|done| done < 0.5).is_none());
    let with_threads = |count| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| solve(&mesh, &of_form()))
    };
    assert!(with_threads(1) == with_threads(4));
}
