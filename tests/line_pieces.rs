//! Where lines begin, end and stand alone: folds that only triangles have, dots, thin lines side by side, lines that end at
//! others.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "what was measured is worth reading")]

mod common;

use common::line_drawing::{Ink, edge_classes, line_drawing, only};
use common::{scene, session, set, surfels};
use glam::{DMat4, DVec2, DVec3, Vec3};
use hachure::export::Session;
use hachure::geometry::primitives::{cube, from_triangles};
use hachure::geometry::{EdgeClass, Mesh};
use hachure::scene::{Camera, Projection};

const SIDE: u32 = 270;

/// A camera that shows a unit of the scene as a pixel and the origin in the middle; `roll` and `elevation` in radians.
fn camera(roll: f64, elevation: f64) -> Camera {
    let (sin, cos) = elevation.sin_cos();
    Camera {
        position: DVec3::new(0.0, sin, cos) * 400.0,
        focal_point: DVec3::ZERO,
        view_up: DVec3::new(roll.sin(), roll.cos(), 0.0),
        projection: Projection::Orthographic { view_height: f64::from(SIDE) },
    }
}

/// Ground of square cells with these heights and slopes along z, and the normals of those slopes.
fn ground(cells: u32, size: f32, height: impl Fn(u32, f32) -> [f32; 2]) -> Mesh {
    let row = cells + 1;
    let at = |i: u32| size * (i as f32 / cells as f32 - 0.5);
    let points = (0..row * row).map(|k| (k, at(k % row), at(k / row)));
    let (positions, normals) = points
        .map(|(k, x, z)| {
            let [y, slope] = height(k, z);
            (Vec3::new(x, y, z), Vec3::new(0.0, 1.0, -slope).normalize())
        })
        .unzip();
    let indices = (0..cells * cells)
        .map(|k| k / cells * row + k % cells)
        .flat_map(|a| [a, a + row, a + 1, a + 1, a + row, a + row + 1])
        .collect();
    Mesh { normals, ..from_triangles(positions, indices) }
}

/// How many pixels have silhouettes that are not near the sides of the ground.
fn silhouettes_inside(session: &mut Session, mesh: Mesh, elevation: f64) -> usize {
    let scene = scene(vec![("ground", mesh, DMat4::IDENTITY, [0.7; 3])]);
    let mut opened = line_drawing(&scene, camera(0.0, elevation));
    only(&mut opened, &[EdgeClass::Silhouette]);
    session.set_scene(&opened).unwrap();
    let picture = session.draw(&opened, [SIDE; 2], false).unwrap();
    let (classes, buffer) = (edge_classes(session, &picture), surfels(session, &picture));
    let side = SIDE as i32;
    let is_inside = |i: usize| {
        let (x, y) = (i as i32 % side, i as i32 / side);
        let around = [(-4, 0), (4, 0), (0, -4), (0, 4)].map(|(dx, dy)| (x + dx, y + dy));
        around.iter().all(|&(x, y)| {
            (0..side).contains(&x) && (0..side).contains(&y) && buffer[(y * side + x) as usize].object != 0
        })
    };
    (0..classes.len()).filter(|&i| classes[i].is_some() && is_inside(i)).count()
}

#[test]
fn folds_of_triangles_alone_are_no_lines() {
    let mut session = session();
    // Heights off by a tenth of a cell: many triangles face away, but the surface that they stand for does not.
    let rough = |k: u32, _: f32| {
        [(k.wrapping_mul(2_654_435_761_u32.wrapping_mul(k + 7)) >> 16 & 255) as f32 / 255.0, 0.0]
    };
    let folds = silhouettes_inside(&mut session, ground(24, 240.0, rough), 0.04);
    // Waves: at each crest, where the ground behind it lies deeper than an edge is long, runs a line from side to side.
    let turn = std::f32::consts::TAU / 80.0;
    let wave = |_: u32, z: f32| [12.0 * (turn * z).cos(), -12.0 * turn * (turn * z).sin()];
    let crests = silhouettes_inside(&mut session, ground(120, 240.0, wave), 0.3);
    println!("{folds} pixels of folds, {crests} of crests");
    assert!(folds < 60, "{folds}");
    assert!(crests > 440, "{crests}");
}

/// The ink within some pixels of a place, with a box of this size on a slab.
fn ink_of_box(session: &mut Session, size: f32, shortest: &str, slab: bool) -> f64 {
    let part = |size: Vec3, at: Vec3| cube(1.0).positions.iter().map(|&p| p * size + at).collect::<Vec<_>>();
    let mut positions = part(Vec3::splat(size), Vec3::new(10.0, 5.0, 20.0));
    let mut indices = cube(1.0).indices;
    if slab {
        indices.extend(cube(1.0).indices.iter().map(|i| i + 8));
        positions.extend(part(Vec3::new(200.0, 200.0, 10.0), Vec3::ZERO));
    }
    let scene = scene(vec![("box", from_triangles(positions, indices), DMat4::IDENTITY, [0.7; 3])]);
    let mut opened = line_drawing(&scene, camera(0.0, 0.0));
    set(&mut opened, "edges.min_length", shortest);
    session.set_scene(&opened).unwrap();
    let ink = Ink::of(session, &opened, [SIDE; 2]);
    (0..50).flat_map(|y| (0..50).map(move |x| (x, y))).map(|(x, y)| ink.at(120 + x, 105 + y)).sum()
}

#[test]
fn dots_are_left_out() {
    let mut session = session();
    assert!(ink_of_box(&mut session, 1.5, "0", true) > 0.5);
    // 16 reference pixels are 4 here.
    assert_eq!(ink_of_box(&mut session, 1.5, "16", true), 0.0);
    assert!(ink_of_box(&mut session, 9.0, "16", true) > 10.0);
    // What is all that is seen of an object stays.
    assert!(ink_of_box(&mut session, 1.5, "16", false) > 0.5);
}

#[test]
fn thin_lines_side_by_side_add_up() {
    let mut session = session();
    // Strips that end a pixel apart, a little aslant: an even gray.
    let (strips, step) = (60, 1.0_f32);
    let corners = |i: u32| {
        let (y, z) = (step * (i as f32 - 30.0), -(i as f32));
        let at = |x: f32, y: f32| Vec3::new(x, y + 0.02 * x, z);
        [at(-100.0, y - 90.0), at(100.0, y - 90.0), at(100.0, y), at(-100.0, y)]
    };
    let positions = (0..strips).flat_map(corners).collect();
    let indices = (0..strips).flat_map(|i| [0, 1, 2, 0, 2, 3].map(|k| 4 * i + k)).collect();
    let scene = scene(vec![("strips", from_triangles(positions, indices), DMat4::IDENTITY, [0.7; 3])]);
    let mut opened = line_drawing(&scene, camera(0.0, 0.0));
    set(&mut opened, "edges.profile.width", "1.6");
    session.set_scene(&opened).unwrap();
    let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
    let inks: Vec<f64> = (-20..20)
        .flat_map(|y| (-60..60).map(move |x| (x, y)))
        .map(|(x, y)| ink.at(135 + x, 135 + y))
        .collect();
    let count = inks.len() as f64;
    let mean = inks.iter().sum::<f64>() / count;
    let deviation = (inks.iter().map(|ink| (ink - mean) * (ink - mean)).sum::<f64>() / count).sqrt();
    println!("ink {mean:.3} ± {deviation:.3}");
    assert!((mean - 0.4).abs() < 0.02 && deviation < 0.02, "{mean} ± {deviation}");
}

/// A bar like a roof, whose ridge and upper side run along x from −90 to behind a box that begins at 20.
fn bar_behind_a_box() -> std::sync::Arc<hachure::scene::Scene> {
    let end = |x: f32| [Vec3::new(x, -20.0, -40.0), Vec3::new(x, 20.0, -40.0), Vec3::new(x, 0.0, -20.0)];
    let positions = [end(-90.0), end(60.0)].concat();
    let indices = vec![0, 2, 1, 3, 4, 5, 0, 3, 5, 0, 5, 2, 2, 5, 4, 2, 4, 1, 0, 1, 4, 0, 4, 3];
    let place = DMat4::from_translation(DVec3::new(55.0, 0.0, 10.0))
        * DMat4::from_scale(DVec3::new(70.0, 120.0, 20.0));
    scene(vec![
        ("bar", from_triangles(positions, indices), DMat4::IDENTITY, [0.7; 3]),
        ("box", cube(1.0), place, [0.7; 3]),
    ])
}

/// How far a line of the bar stops before those at which it ends, and how far it goes on beyond them; px.
fn misses(ink: &Ink, roll: f64, y: f64, profile: f64) -> [f64; 2] {
    let at = |x: f64, y: f64| {
        let turned = DVec2::from_angle(roll).rotate(DVec2::new(x, y));
        ink.sampled(DVec2::new(turned.x, -turned.y) + 0.5 * f64::from(SIDE))
    };
    let here = |x: f64| [-1.0, -0.5, 0.0, 0.5, 1.0].map(|d| at(x, y + d)).into_iter().fold(0.0, f64::max);
    let xs = || (-500..300).map(|i| 0.25 * f64::from(i));
    let missing = xs().filter(|&x| x > -90.0 && x < 20.0 && here(x) < 0.4).count();
    let beyond = |x: f64| (x - 20.0).max(-90.0 - x) - 0.5 * profile;
    let over = xs().filter(|&x| beyond(x) > 0.0 && here(x) > 0.3).map(beyond).fold(0.0, f64::max);
    [0.25 * missing as f64, over]
}

#[test]
fn lines_end_at_lines() {
    let mut session = session();
    let scene = bar_behind_a_box();
    for (roll, name) in [(0.0, "straight"), (0.35, "rolled")] {
        for profile in [1.0, 2.0, 4.0, 8.0, 16.0] {
            for inner in [1.0, 2.0, 4.0, 8.0, 16.0] {
                let mut opened = line_drawing(&scene, camera(roll, 0.0));
                // 4 reference pixels are 1 here.
                set(&mut opened, "edges.profile.width", &format!("{}", 4.0 * profile));
                set(&mut opened, "edges.inner.width", &format!("{}", 4.0 * inner));
                session.set_scene(&opened).unwrap();
                let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
                for (y, line) in [(0.0, "ridge"), (20.0, "outline")] {
                    let [short, over] = misses(&ink, roll, y, profile);
                    let case =
                        format!("{name} {line}, widths {profile} and {inner}: {short} short, {over} over");
                    assert!(short <= 0.5 && over <= 1.0, "{case}");
                }
            }
        }
    }
}
