//! What must hold of every picture; needs no golden file.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{at, draw, image, ink, is_rounded_alike, opened, scene, session, set, surfels};
use glam::{DMat4, DQuat, DVec3};
use hachure::document::Document;
use hachure::geometry::primitives;
use hachure::render::Request;
use std::sync::Arc;

/// Directions that are spread evenly (spherical Fibonacci).
fn directions(count: i32) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let y = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
        let angle = f64::from(i) * 2.399_963;
        let r = (1.0 - y * y).sqrt();
        DVec3::new(r * angle.cos(), y, r * angle.sin())
    })
}

/// How edges are found. `exact_lines.rs` has more of exact mode.
const MODES: [&str; 2] = ["image_space", "exact"];

#[test]
fn a_tilted_plane_has_no_inner_edge() {
    let mut session = session();
    for tilt in [0.0, 30.0, 60.0, 80.0, 88.0_f64] {
        for size in [1e-3, 1.0, 1e3] {
            let turn = DMat4::from_quat(DQuat::from_rotation_x(tilt.to_radians()));
            let scene = scene(vec![("plane", primitives::plane(size), turn, [0.7; 3])]);
            let mut opened = opened(&scene, DVec3::Z);
            set(&mut opened, "edges.mode", "image_space");
            let picture = draw(&mut session, &opened, 128);
            let buffer = surfels(&mut session, &picture);
            let ink = ink(&mut session, &picture);
            let mut inside = 0;
            for y in 1..127usize {
                for x in 1..127usize {
                    let all = [-1isize, 0, 1].iter().all(|dy| {
                        [-1isize, 0, 1].iter().all(|dx| {
                            buffer[((y as isize + dy) * 128 + x as isize + dx) as usize].object != 0
                        })
                    });
                    if all {
                        inside += 1;
                        assert_eq!(ink[y * 128 + x].0, 0.0, "tilt {tilt}, size {size}, at {x},{y}");
                    }
                }
            }
            assert!(inside > 50, "tilt {tilt}, size {size}: nothing to see");
        }
    }
}

#[test]
fn the_outline_of_a_cube_is_closed_from_any_side() {
    let mut session = session();
    let scene = scene(vec![("cube", primitives::cube(2.0), DMat4::IDENTITY, [0.7; 3])]);
    for direction in directions(32) {
        let mut opened = opened(&scene, direction);
        set(&mut opened, "edges.mode", "image_space");
        let picture = draw(&mut session, &opened, 96);
        let buffer = surfels(&mut session, &picture);
        let ink = ink(&mut session, &picture);
        let mut boundary = 0;
        for y in 1..95 {
            for x in 1..95 {
                let neighbors = [y * 96 + x - 1, y * 96 + x + 1, (y - 1) * 96 + x, (y + 1) * 96 + x];
                let here = y * 96 + x;
                if buffer[here].object != 0 && neighbors.iter().any(|n| buffer[*n].object == 0) {
                    boundary += 1;
                    assert!(
                        ink[here].0.max(ink[here].1) > 0.3,
                        "gap at {x},{y} from {direction}: {:?}",
                        ink[here]
                    );
                }
            }
        }
        assert!(boundary > 100, "nothing to see from {direction}: {boundary}");
    }
}

#[test]
fn the_order_of_objects_changes_no_pixel() {
    let objects = || {
        vec![
            ("a", primitives::sphere(1.0, 24, 36), at(0.0, 0.0, 0.0), [0.8, 0.2, 0.2]),
            ("b", primitives::cube(1.2), at(0.8, 0.2, 0.5), [0.2, 0.8, 0.2]),
            ("c", primitives::torus(1.2, 0.2, 40, 12), at(0.0, 0.3, 0.0), [0.2, 0.2, 0.8]),
        ]
    };
    let mut session = session();
    let direction = DVec3::new(0.5, 0.6, 1.0);
    let mut reversed = objects();
    reversed.reverse();
    let [forward, backward] = [objects(), reversed].map(scene);
    for mode in MODES {
        let mut drawn = |scene| {
            let mut opened = opened(scene, direction);
            set(&mut opened, "edges.mode", mode);
            image(&mut session, &opened, 160)
        };
        assert!(drawn(&forward) == drawn(&backward), "{mode}");
    }
}

#[test]
fn hiding_an_object_removes_its_ink_and_nobody_elses() {
    let mut session = session();
    let scene = scene(vec![
        ("big", primitives::cube(2.0), at(0.0, 0.0, 0.0), [0.7; 3]),
        ("small", primitives::sphere(0.4, 16, 24), at(2.0, 0.0, 0.0), [0.7; 3]),
    ]);
    for mode in MODES {
        let mut all = opened(&scene, DVec3::new(0.1, 0.2, 1.0));
        set(&mut all, "edges.mode", mode);
        let with = draw(&mut session, &all, 128);
        let ink_with = ink(&mut session, &with);
        all.document.node_mut("/small").visible = Some(false);
        let without = draw(&mut session, &all, 128);
        let ink_without = ink(&mut session, &without);
        assert!(ink_with.iter().any(|i| i.2 == 2) && !ink_without.iter().any(|i| i.2 == 2), "{mode}");
        assert!(ink_with.iter().zip(&ink_without).all(|(a, b)| a.2 == 2 || a == b), "{mode}");
    }
}

#[test]
fn what_is_not_enhanced_has_no_ink_and_hides_that_of_others() {
    let mut session = session();
    let scene = scene(vec![
        ("back", primitives::cube(1.0), at(0.0, 0.0, -2.0), [0.7; 3]),
        ("front", primitives::plane(3.0), at(0.0, 0.0, 0.0), [0.7; 3]),
    ]);
    for mode in MODES {
        let mut all = opened(&scene, DVec3::Z);
        set(&mut all, "edges.mode", mode);
        all.document.node_mut("/front").enhanced = Some(false);
        let picture = draw(&mut session, &all, 128);
        assert!(ink(&mut session, &picture).iter().all(|i| i.0 + i.1 == 0.0), "the hidden cube leaks ink");
        all.document.node_mut("/front").visible = Some(false);
        let picture = draw(&mut session, &all, 128);
        assert!(ink(&mut session, &picture).iter().any(|i| i.1 > 0.9), "{mode}");
    }
}

#[test]
fn zero_strength_is_the_picture_without_edges() {
    let mut session = session();
    let scene = scene(vec![("cube", primitives::cube(2.0), DMat4::IDENTITY, [0.7, 0.5, 0.3])]);
    let direction = DVec3::new(0.5, 0.6, 1.0);
    for mode in MODES {
        let drawn = |session: &mut _, changes: [(&str, &str); 2]| {
            let mut opened = opened(&scene, direction);
            set(&mut opened, "edges.mode", mode);
            for (key, value) in changes {
                set(&mut opened, key, value);
            }
            image(session, &opened, 128)
        };
        let with = drawn(&mut session, [("edges.profile.opacity", "1"), ("edges.inner.opacity", "1")]);
        let zero = drawn(&mut session, [("edges.profile.opacity", "0"), ("edges.inner.opacity", "0")]);
        let off = drawn(&mut session, [("edges.profile.show", "false"), ("edges.inner.show", "false")]);
        assert!(zero == off && zero != with, "{mode}");
    }
}

#[test]
fn only_what_changed_runs_again() {
    let mut session = session();
    let scene = scene(vec![("cube", primitives::cube(2.0), DMat4::IDENTITY, [0.7; 3])]);
    let mut opened = opened(&scene, DVec3::new(0.5, 0.6, 1.0));
    set(&mut opened, "edges.mode", "image_space");
    session.set_scene(&opened).unwrap();
    let mut runs = |change: &dyn Fn(&mut Document)| {
        let mut document = opened.document.clone();
        change(&mut document);
        let renderer = session.renderer();
        let camera = document.camera.unwrap();
        let request = |document| Request {
            document,
            camera: &camera,
            size: [64, 64],
            transparent: false,
            selected: &[],
            samples: 1,
        };
        renderer.render(&request(&opened.document)).unwrap();
        let before = renderer.runs();
        renderer.render(&request(&document)).unwrap();
        let after = renderer.runs();
        before.iter().zip(&after).filter(|(b, a)| b != a).map(|(b, _)| b.0).collect::<Vec<_>>()
    };
    assert_eq!(runs(&|_| {}), [""; 0]);
    assert_eq!(runs(&|d| d.style.edges.profile.threshold = 0.5), ["edge map", "surface", "image"]);
    assert_eq!(runs(&|d| d.style.gooch.alpha = 0.1), ["surface", "image"]);
    assert_eq!(runs(&|d| d.view.background = Some("#ff0000".parse().unwrap())), ["image"]);
    assert_eq!(runs(&|d| d.camera = d.camera.map(|c| c.orbited(DVec3::Y, 1.0, 0.0))), [""; 0]);
    // Nothing else has lines here, so there is no edge map any more.
    assert_eq!(runs(&|d| d.node_mut("/cube").enhanced = Some(false)), ["g-buffer", "surface", "image"]);
}

#[test]
fn mirrored_transforms_and_flipped_windings_draw_the_same_picture() {
    let mut session = session();
    let direction = DVec3::new(0.5, 0.6, 1.0);
    let cube = || ("cube", primitives::cube(2.0), DMat4::IDENTITY, [0.7, 0.6, 0.5]);
    let mut mirrored = cube();
    mirrored.2 = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let mut flipped = cube();
    for triangle in flipped.1.indices.chunks_exact_mut(3) {
        triangle.swap(0, 1);
    }
    let scenes = [cube(), mirrored, flipped].map(|object| scene(vec![object]));
    for mode in MODES {
        let [normal, mirrored, flipped] = [0, 1, 2].map(|i: usize| {
            let mut opened = opened(&scenes[i], direction);
            set(&mut opened, "edges.mode", mode);
            image(&mut session, &opened, 128)
        });
        // A mirrored vertex is the exact negative; only which triangle of a side owns a pixel may differ.
        let differing = |a: &image::RgbaImage| {
            normal.pixels().zip(a.pixels()).filter(|(a, b)| !is_rounded_alike(a, b)).count()
        };
        let [mirrored, flipped] = [&mirrored, &flipped].map(differing);
        assert!(mirrored < 40 && flipped < 40, "{mode}: {mirrored} {flipped}");
    }
}

#[test]
fn nothing_visible_is_empty_paper_and_a_picture_of_one_pixel_is_drawn() {
    let mut session = session();
    let scene = scene(vec![("cube", primitives::cube(2.0), DMat4::IDENTITY, [0.7; 3])]);
    let mut opened = opened(&scene, DVec3::Z);
    assert_eq!(image(&mut session, &opened, 1).dimensions(), (1, 1));
    opened.document.node_mut("/cube").visible = Some(false);
    let paper = opened.document.paper().0;
    assert!(image(&mut session, &opened, 32).pixels().all(|p| p.0[..3] == paper));
    let empty = common::opened(&Arc::default(), DVec3::Z);
    assert!(image(&mut session, &empty, 32).pixels().all(|p| p.0[..3] == paper));
}

#[test]
fn shaders_and_program_number_surfaces_alike() {
    let mut session = session();
    let cubes = ["a", "b"].map(|name| (name, primitives::cube(2.0), DMat4::IDENTITY, [0.7; 3]));
    let picture = draw(&mut session, &opened(&scene(cubes.to_vec()), DVec3::new(0.3, 0.5, 1.0)), 64);
    let regions = common::captured(&mut session, "surface ids").unwrap();
    let regions = common::texels::<u32>(&mut session, &regions);
    let surfels = common::surfels(&mut session, &picture);
    assert!(surfels.iter().any(|s| s.object != 0));
    let mut seen = std::collections::BTreeSet::new();
    for (region, surfel) in regions.into_iter().zip(surfels).filter(|(_, s)| s.object != 0) {
        let is_its =
            |surface: &u32| region == hachure::render::base::ids::surface_id(surfel.object, *surface);
        seen.insert((0..6).find(is_its).unwrap());
    }
    assert!(seen.len() >= 3, "three sides are seen: {seen:?}");
}
