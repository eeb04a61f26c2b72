//! Hidden lines: they are where edges lie behind something, they leave nothing else behind, and off costs nothing.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::sync::Arc;

use common::{at, image, object, opened, scene, session, set, set_for};
use glam::{DMat4, DQuat, DVec2, DVec3, UVec2};
use hachure::document::Role;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::bvh::Bvh;
use hachure::geometry::primitives;
use hachure::render::View;
use hachure::scene::Scene;
use image::{Rgba, RgbaImage};

/// White surfaces on white paper with black visible lines and solid red hidden ones, both about 2 px wide at 192 px.
fn red_hidden(scene: &Arc<Scene>, towards_viewer: DVec3) -> Opened {
    let mut opened = opened(scene, towards_viewer);
    for (key, value) in [
        ("technique", "unlit"),
        ("view.background", "#ffffff"),
        ("edges.inner.color", "#000000"),
        ("edges.profile.width", "12"),
        ("edges.inner.width", "12"),
        ("edges.hidden.mode", "own"),
        ("edges.hidden.color", "#ff0000"),
        ("edges.hidden.width", "12"),
        ("edges.hidden.dashed", "false"),
        ("edges.hidden.min_coverage", "0"),
    ] {
        set(&mut opened, key, value);
    }
    opened
}

fn is_red(p: &Rgba<u8>) -> bool {
    p.0[0] > p.0[1].saturating_add(60)
}

fn red(image: &RgbaImage) -> usize {
    image.pixels().filter(|p| is_red(p)).count()
}

fn runs(session: &mut Session) -> u64 {
    session.renderer().runs().iter().find(|(name, _)| *name == "hidden lines").map(|(_, runs)| *runs).unwrap()
}

/// A cube in a cube, aslant.
fn cubes() -> Arc<Scene> {
    scene(vec![
        object("outer", primitives::cube(2.0), DMat4::IDENTITY),
        object("inner", primitives::cube(0.8), DMat4::from_rotation_y(0.3)),
    ])
}

/// Where the edges of cubes are seen or would be: place in the picture, and how many surfaces lie before it.
fn cube_edges(opened: &Opened, side: u32) -> Vec<(DVec2, usize)> {
    let view = View::new(&opened.document.camera.unwrap(), &opened.scene.bounds(), UVec2::splat(side));
    let projector = view.projector();
    let mut triangles = Vec::new();
    let mut edges = Vec::new();
    for node in &opened.scene.nodes {
        let mesh = &opened.scene.meshes[node.mesh.unwrap()];
        let place = |v: u32| node.world_from_local.transform_point3(mesh.positions[v as usize].as_dvec3());
        triangles.extend(mesh.indices.chunks_exact(3).map(|t| [place(t[0]), place(t[1]), place(t[2])]));
        let corners = mesh.bounds().corners().map(|c| node.world_from_local.transform_point3(c));
        for (i, a) in corners.iter().enumerate() {
            edges.extend([1, 2, 4].iter().filter(|bit| i & **bit == 0).map(|bit| [*a, corners[i | bit]]));
        }
    }
    let bvh = Bvh::new(&triangles);
    let mut points = Vec::new();
    for [a, b] in edges {
        for step in 1..200 {
            let point = a.lerp(b, f64::from(step) / 200.0);
            let eye = view.view_from_world.inverse().transform_point3(DVec3::ZERO);
            let before = std::cell::RefCell::new(Vec::<f64>::new());
            bvh.any_hit(eye, point - eye, 0.0, 1.0 - 1e-6, |hit| {
                before.borrow_mut().push(hit.t);
                true
            });
            let mut before = before.into_inner();
            before.sort_by(f64::total_cmp);
            // Two triangles that share an edge, on it.
            before.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
            points.push((projector.pixel(view.view_from_world.transform_point3(point)), before.len()));
        }
    }
    points
}

#[test]
fn lines_are_drawn_where_edges_lie_behind_so_many_surfaces() {
    const SIDE: u32 = 192;
    let mut session = session();
    for mode in ["exact", "image_space"] {
        for (layers, most, deepest) in [("next", "12", 1), ("all", "2", 2), ("all", "12", 12)] {
            let mut opened = red_hidden(&cubes(), DVec3::new(0.5, 0.4, 1.0));
            set(&mut opened, "edges.mode", mode);
            // So that the operators find no steps in faces that are seen aslant.
            set(&mut opened, "edges.profile.gain", "2");
            set(&mut opened, "edges.hidden.layers", layers);
            set(&mut opened, "edges.hidden.max_layers", most);
            let image = image(&mut session, &opened, SIDE);
            let edges = cube_edges(&opened, SIDE);
            let nearest = |px: DVec2, found: &dyn Fn(usize) -> bool| {
                let of = edges.iter().filter(|(_, before)| found(*before));
                of.map(|(at, _)| at.distance(px)).fold(f64::INFINITY, f64::min)
            };
            let is_drawn = |before: usize| (1..=deepest).contains(&before);
            let (mut seen, mut missed) = (0, 0);
            for (px, before) in edges.iter().filter(|(_, before)| is_drawn(*before)) {
                // Visible lines lie over hidden ones, and a layer ends where that before it does.
                let is_clear = nearest(*px, &|other| other != *before) > 4.0;
                if is_clear {
                    seen += 1;
                    let around = |dx: u32, dy: u32| {
                        is_red(image.get_pixel(px.x as u32 + dx - 1, px.y as u32 + dy - 1))
                    };
                    if !(0..9).any(|i| around(i % 3, i / 3)) {
                        missed += 1;
                    }
                }
            }
            assert!(seen > 300, "{mode}, {layers} of {most}: {seen}");
            assert!(
                missed * 50 <= seen,
                "{mode}, {layers} of {most}: {missed} of {seen} points have no line"
            );
            for (x, y, p) in image.enumerate_pixels().filter(|(.., p)| is_red(p)) {
                let px = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let away = nearest(px, &is_drawn);
                assert!(away < 4.0, "{mode}, {layers} of {most}: {p:?} at {x}, {y}, {away} px off any edge");
            }
        }
    }
}

#[test]
fn off_runs_nothing_and_draws_nothing_else() {
    let mut session = session();
    let mut opened = red_hidden(&cubes(), DVec3::new(0.5, 0.4, 1.0));
    set(&mut opened, "edges.hidden.mode", "off");
    let without = image(&mut session, &opened, 96);
    assert_eq!((runs(&mut session), red(&without)), (0, 0));
    set(&mut opened, "edges.hidden.mode", "own");
    let with = image(&mut session, &opened, 96);
    assert!(runs(&mut session) == 1 && red(&with) > 50);
    // Neither a light nor the paper draws them again, a line does; and visible lines stay as they are.
    set(&mut opened, "view.background", "#fffff0");
    session.draw(&opened, [96; 2], false).unwrap();
    assert_eq!(runs(&mut session), 1);
    set(&mut opened, "edges.hidden.width", "20");
    session.draw(&opened, [96; 2], false).unwrap();
    assert_eq!(runs(&mut session), 2);
    let dark = |p: &Rgba<u8>| p.0[0] < 20;
    assert!(without.pixels().zip(with.pixels()).all(|(a, b)| dark(a) <= dark(b)));
    set(&mut opened, "edges.hidden.mode", "off");
    set(&mut opened, "view.background", "#ffffff");
    assert!(image(&mut session, &opened, 96) == without);
}

#[test]
fn a_smooth_solid_has_none() {
    let mut session = session();
    for (mesh, modes) in [
        (primitives::sphere(1.0, 48, 96), ["exact", "image_space"].as_slice()),
        // To the operators its facets are folds.
        (primitives::sphere(1.0, 9, 13), &["exact"]),
    ] {
        for mode in modes {
            let ball = scene(vec![object("ball", mesh.clone(), DMat4::from_rotation_x(0.4))]);
            let mut opened = red_hidden(&ball, DVec3::new(0.3, 0.2, 1.0));
            set(&mut opened, "edges.mode", mode);
            assert_eq!(red(&image(&mut session, &opened, 160)), 0, "{mode}");
        }
    }
}

/// A plate before a smaller plate before a larger box, seen from the front: the plate in the middle is hidden.
fn plates() -> Arc<Scene> {
    scene(vec![
        object("front", primitives::plane(2.2), at(0.0, 0.0, 1.0)),
        object("middle", primitives::plane(0.9), at(0.1, 0.0, 0.6)),
        object("solid", primitives::cube(0.3), at(-0.3, 0.1, 0.3)),
        object("back", primitives::plane(1.6), at(0.0, 0.0, -0.4)),
        object("wall", primitives::plane(2.2), at(0.0, 0.0, -0.8)),
    ])
}

#[test]
fn what_has_no_lines_leaves_no_trace_in_those_of_others() {
    let mut session = session();
    let mut opened = red_hidden(&plates(), DVec3::new(0.02, 0.03, 1.0));
    let all = red(&image(&mut session, &opened, 128));
    for node in [1, 2] {
        set_for(&mut opened, node, "edges.hidden.mode", "off");
    }
    let off = image(&mut session, &opened, 128);
    opened.document.node_mut("/middle").visible = Some(false);
    opened.document.node_mut("/solid").visible = Some(false);
    let gone = image(&mut session, &opened, 128);
    assert!(off == gone);
    assert!(all > red(&gone) + 100 && red(&gone) > 100, "{all} with, {} without", red(&gone));
}

#[test]
fn each_object_says_how_deep_its_own_are_drawn() {
    let mut session = session();
    let planes = (0..5).map(|i| {
        object(
            ["a", "b", "c", "d", "e"][i as usize],
            primitives::plane(2.0 - 0.3 * i as f32),
            at(0.0, 0.0, -0.1 * f64::from(i)),
        )
    });
    let mut opened = red_hidden(&scene(planes.collect()), DVec3::Z);
    set(&mut opened, "edges.hidden.mode", "off");
    let squares = |session: &mut Session, opened: &Opened| {
        // Along the middle row to the right, each border is a run of red.
        let image = image(session, opened, 128);
        let row: Vec<bool> = (64..128).map(|x| is_red(image.get_pixel(x, 64))).collect();
        row.windows(2).filter(|w| !w[0] && w[1]).count()
    };
    assert_eq!(squares(&mut session, &opened), 0);
    // Those of the planes 1 and 3 lie in the layers 1 and 3.
    for (depth, expected) in [("1", 1), ("2", 1), ("3", 2)] {
        for node in [1, 3] {
            set_for(&mut opened, node, "edges.hidden.mode", "own");
            set_for(&mut opened, node, "edges.hidden.max_layers", depth);
        }
        assert_eq!(squares(&mut session, &opened), expected, "{depth}");
    }
    set_for(&mut opened, 1, "edges.hidden.layers", "next");
    set_for(&mut opened, 2, "edges.hidden.mode", "own");
    assert_eq!(squares(&mut session, &opened), 3);
    set_for(&mut opened, 2, "edges.hidden.layers", "next");
    assert_eq!(squares(&mut session, &opened), 2);
}

#[test]
fn faint_ones_are_paler_and_narrower_and_dashed_ones_have_dashes() {
    let mut session = session();
    let two = || {
        scene(vec![
            object("front", primitives::plane(2.2), at(0.0, 0.0, 0.5)),
            object("back", primitives::plane(1.2), at(0.0, 0.0, 0.0)),
        ])
    };
    let mut opened = red_hidden(&two(), DVec3::Z);
    set(&mut opened, "edges.profile.width", "48");
    set(&mut opened, "edges.hidden.mode", "faint");
    set(&mut opened, "edges.hidden.opacity", "0.5");
    set(&mut opened, "edges.hidden.relative_width", "0.25");
    // The rows above the middle one cross the left border of the square, which is black by half and 12 · 128 / 1080 px wide.
    let ink = |p: &Rgba<u8>| 1.0 - (f64::from(p.0[0]) / 255.0).powf(2.2);
    let faint = image(&mut session, &opened, 128);
    let across: f64 = (20..60).map(|x| ink(faint.get_pixel(x, 64))).sum();
    assert!((across - 0.5 * 12.0 * 128.0 / 1080.0).abs() < 0.06, "{across}");

    set(&mut opened, "edges.hidden.mode", "dashed");
    set(&mut opened, "edges.hidden.dash", "60");
    set(&mut opened, "edges.hidden.gap", "20");
    let dashed = image(&mut session, &opened, 128);
    let total = |image: &RgbaImage| -> f64 {
        (32..96).flat_map(|y| (20..108).map(move |x| (x, y))).map(|(x, y)| ink(image.get_pixel(x, y))).sum()
    };
    let share = total(&dashed) / total(&faint);
    assert!((share - 0.75).abs() < 0.06, "{share}");
    // Along the border: dashes of 60 and gaps of 20 reference pixels.
    let column: Vec<bool> =
        (34..94).map(|y| (20..60).map(|x| ink(dashed.get_pixel(x, y))).fold(0.0, f64::max) > 0.2).collect();
    let changes: Vec<usize> = (1..column.len()).filter(|i| column[*i] != column[i - 1]).collect();
    assert!(changes.len() >= 10, "{changes:?}");
    for pair in changes.windows(3) {
        let period = (pair[2] - pair[0]) as f64;
        // Loops are stretched by up to a tenth.
        assert!((period - 80.0 * 128.0 / 1080.0).abs() < 2.0, "{changes:?}");
    }
}

#[test]
fn hidden_lines_that_run_over_each_other_are_no_stronger() {
    let mut session = session();
    let sheet = |name, side: f32, turn: f64, z: f64| {
        object(name, primitives::plane(side), at(0.0, 0.0, z) * DMat4::from_rotation_z(turn))
    };
    let sheets = vec![sheet("front", 2.2, 0.0, 0.5), sheet("a", 1.2, 0.0, 0.2), sheet("b", 1.2, 0.8, 0.0)];
    let mut opened = red_hidden(&scene(sheets), DVec3::Z);
    for (key, value) in [
        ("edges.profile.width", "60"),
        ("edges.hidden.mode", "faint"),
        ("edges.hidden.opacity", "0.5"),
        ("edges.hidden.relative_width", "0.4"),
    ] {
        set(&mut opened, key, value);
    }
    let image = image(&mut session, &opened, 128);
    let inside = || (32..96).flat_map(|y| (32..96).map(move |x| (x, y)));
    let values: Vec<u8> = inside().map(|(x, y)| image.get_pixel(x, y).0[0]).collect();
    let (darkest, count) = (values.iter().min().unwrap(), values.iter().filter(|v| **v < 200).count());
    // Black of which half is left, in sRGB.
    assert!(count > 300 && (186..=190).contains(darkest), "{count} pixels, the darkest {darkest}");
}

#[test]
fn mirrors_show_them() {
    let mut session = session();
    let turn = DMat4::from_quat(DQuat::from_rotation_y(0.5) * DQuat::from_rotation_x(0.4));
    let objects = vec![
        object("glass", primitives::plane(4.0), DMat4::IDENTITY),
        object("cube", primitives::cube(1.0), at(-0.9, 0.2, 1.1) * turn),
    ];
    let mut opened = red_hidden(&scene(objects), DVec3::new(0.6, 0.25, 1.0));
    let scene = Arc::clone(&opened.scene);
    set_for(&mut opened, 0, "edges.hidden.mode", "off");
    let before = red(&image(&mut session, &opened, 160));
    opened.document.set_role(&scene, &[0], Role::Mirror, true);
    set(&mut opened, "mirror.reflectivity", "1");
    let after = red(&image(&mut session, &opened, 160));
    assert!(before > 60 && after > before + 40, "{before} without a mirror, {after} with one");
}

#[test]
fn hidden_lines_take_the_color_of_their_surfaces() {
    let mut session = session();
    let outer = ("outer", primitives::cube(2.0), DMat4::IDENTITY, [1.0; 3]);
    let inner = ("inner", primitives::cube(0.8), DMat4::IDENTITY, [1.0, 0.0, 0.0]);
    let mut opened = red_hidden(&scene(vec![outer, inner]), DVec3::new(0.5, 0.4, 1.0));
    set(&mut opened, "edges.hidden.mode", "faint");
    set(&mut opened, "edges.hidden.layers", "all");
    set(&mut opened, "edges.darken", "0");
    let of_style = red(&image(&mut session, &opened, 192));
    set(&mut opened, "edges.object_color", "1");
    let of_surface = red(&image(&mut session, &opened, 192));
    assert!(of_style == 0 && of_surface > 200, "{of_style}, {of_surface}");
}

#[test]
fn the_order_of_objects_changes_no_pixel() {
    let mut session = session();
    let shapes =
        [primitives::cube(1.2), primitives::torus(0.7, 0.25, 48, 24), primitives::sphere(0.8, 24, 36)];
    let turn = DMat4::from_quat(DQuat::from_rotation_x(0.5));
    let [first, second] = [[0, 1, 2], [2, 0, 1]].map(|order| {
        // Intersections are of either object, as its number has it: none here.
        let place = |i: usize| at(0.2 * i as f64, 0.1, -2.0 * i as f64) * turn;
        let objects = order.map(|i: usize| object(["cube", "ring", "ball"][i], shapes[i].clone(), place(i)));
        image(&mut session, &red_hidden(&scene(objects.into()), DVec3::new(0.2, 0.4, 1.0)), 128)
    });
    assert!(red(&first) > 100);
    let differing = first.pixels().zip(second.pixels()).filter(|(a, b)| a != b).count();
    assert_eq!(differing, 0);
}
