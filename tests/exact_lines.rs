//! Exact lines are where edges are, all of them and nothing else.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "what was measured is worth reading")]

mod common;

use std::sync::Arc;

use common::line_drawing::{Ink, edge_classes, line_drawing, only, set_width};
use common::line_scenes::named;
use common::line_truth::directions;
use common::outline::{outline, projected};
use common::{at, scene, session, surfels};
use glam::{DMat4, DQuat, DVec2, DVec3, Mat3, Vec2, Vec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::primitives::{cube, from_triangles, plane, sphere};
use hachure::geometry::{EdgeClass, Mesh};
use hachure::scene::material::{AlphaMode, TextureRef, UvTransform};
use hachure::scene::{Camera, Projection, Texture, Wrap};

/// A square of many triangles that lies askew, so that its vertices are rounded.
fn askew(size: f32, cells: u32) -> (Mesh, DQuat) {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.5, 0.7);
    let along = |i: u32| f64::from(size) * (f64::from(i) / f64::from(cells) - 0.5);
    let corners = (0..=cells).flat_map(|j| (0..=cells).map(move |i| (i, j)));
    let positions =
        corners.map(|(i, j)| (turn * DVec3::new(along(i), along(j), 0.0)).as_vec3()).collect::<Vec<Vec3>>();
    let corner = |i: u32, j: u32| j * (cells + 1) + i;
    let indices = (0..cells * cells)
        .map(|k| (k % cells, k / cells))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [a, b, c, a, c, d]
        })
        .collect();
    (from_triangles(positions, indices), turn)
}

#[test]
fn a_tilted_plane_has_no_edge_inside() {
    let mut session = session();
    let (mut pictures, mut inside, mut wrong) = (0, 0, Vec::new());
    for unit in [1e-4, 1.0, 1e4_f32] {
        let (rounded, turn) = askew(40.0 * unit, 12);
        for (name, mesh, turn) in
            [("square", plane(40.0 * unit), DQuat::IDENTITY), ("many triangles", rounded, turn)]
        {
            let scene = scene(vec![("plane", mesh, DMat4::IDENTITY, [0.7; 3])]);
            session.set_scene(&line_drawing(&scene, Camera::default())).unwrap();
            for tilt in [0.0, 20.0, 45.0, 70.0, 80.0, 85.0, 88.0, 89.0, 89.5_f64] {
                for (reach, sides, is_near) in [(0.4, [96, 150, 223], true), (60.0, [97, 160, 256], false)] {
                    for (orthographic, side) in [(false, 0), (true, 1), (false, 2), (true, 0)] {
                        let side = sides[side];
                        let tilted =
                            turn * DQuat::from_rotation_z(0.4) * DQuat::from_rotation_x(tilt.to_radians());
                        let distance = reach * f64::from(unit) / 15.0_f64.to_radians().tan();
                        let camera = Camera {
                            position: tilted * DVec3::Z * distance,
                            focal_point: DVec3::ZERO,
                            view_up: tilted * DVec3::Y,
                            projection: Projection::Perspective { view_angle: 30.0 },
                        };
                        let opened = line_drawing(&scene, camera.with_orthographic(orthographic));
                        let picture = session.draw(&opened, [side, side], false).unwrap();
                        let buffer = surfels(&mut session, &picture);
                        let edges = edge_classes(&mut session, &picture);
                        let side = side as usize;
                        let is_inside = |x: usize, y: usize| {
                            (y - 2..=y + 2).all(|y| (x - 2..=x + 2).all(|x| buffer[y * side + x].object != 0))
                        };
                        let mut count = 0;
                        for (x, y) in (2..side - 2).flat_map(|y| (2..side - 2).map(move |x| (x, y))) {
                            if is_inside(x, y) {
                                count += 1;
                                if let Some(edge) = edges[y * side + x] {
                                    wrong.push((name, unit, tilt, is_near, orthographic, side, x, y, edge.0));
                                }
                            }
                        }
                        assert!(
                            !is_near || count > 50,
                            "{name} {unit} {tilt} {orthographic}: nothing to see"
                        );
                        inside += count;
                        pictures += 1;
                    }
                }
            }
        }
    }
    println!("{pictures} pictures, {inside} pixels inside, {} with an edge", wrong.len());
    assert!(wrong.is_empty(), "{} of {inside} pixels: {:?}", wrong.len(), &wrong[..wrong.len().min(8)]);
}

/// Share of a straight edge with ink on it, away from its ends.
fn drawn_share(session: &mut Session, opened: &Opened, side: u32, ends: [DVec3; 2]) -> f64 {
    let ink = Ink::of(session, opened, [side; 2]);
    let ends = projected(opened, [side; 2], &ends);
    let length = ends[0].distance(ends[1]);
    assert!(length > 20.0, "the edge is too short to see");
    let steps = (2.0 * length) as u32;
    let places = (4..=steps - 4).map(|i| ends[0].lerp(ends[1], f64::from(i) / f64::from(steps)));
    let (mut all, mut found) = (0.0, 0.0);
    for place in places {
        all += 1.0;
        found += f64::from(u8::from(ink.near(place) >= 0.5));
    }
    found / all
}

// Long, as its scenes are a table.
#[test]
fn the_boundary_of_objects_that_touch_is_drawn_whole() {
    let p = DVec3::new;
    let scenes = [
        (
            "side by side",
            vec![(cube(1.0), at(-0.5, 0.0, 0.0)), (cube(1.0), at(0.5, 0.0, 0.0))],
            vec![[p(0.0, -0.5, 0.5), p(0.0, 0.5, 0.5)], [p(0.0, 0.5, 0.5), p(0.0, 0.5, -0.5)]],
        ),
        (
            "flush in front, one lower",
            vec![(cube(1.0), at(-0.5, 0.0, 0.0)), (cube(0.8), at(0.4, -0.1, 0.1))],
            vec![[p(0.0, -0.5, 0.5), p(0.0, 0.3, 0.5)]],
        ),
        (
            "one upon the other, flush in front",
            vec![(cube(1.0), at(0.0, 0.0, 0.0)), (cube(0.5), at(0.1, 0.75, 0.25))],
            vec![[p(-0.15, 0.5, 0.5), p(0.35, 0.5, 0.5)]],
        ),
        (
            "one upon the other",
            vec![(cube(1.0), at(0.0, 0.0, 0.0)), (cube(0.5), at(0.1, 0.75, 0.0))],
            vec![[p(-0.15, 0.5, 0.25), p(0.35, 0.5, 0.25)], [p(-0.5, 0.5, 0.5), p(0.5, 0.5, 0.5)]],
        ),
        (
            "tiles",
            vec![(plane(1.0), at(-0.5, 0.0, 0.0)), (plane(1.0), at(0.5, 0.0, 0.0))],
            vec![[p(0.0, -0.5, 0.0), p(0.0, 0.5, 0.0)]],
        ),
        (
            "a tile upon a floor",
            vec![(plane(2.0), at(0.0, 0.0, 0.0)), (plane(1.0), at(0.1, 0.0, 1e-3))],
            vec![[p(-0.4, -0.5, 0.0), p(0.6, -0.5, 0.0)], [p(0.6, -0.5, 0.0), p(0.6, 0.5, 0.0)]],
        ),
    ];
    let mut session = session();
    let mut gaps = Vec::new();
    for (name, objects, boundaries) in scenes {
        let names = ["a", "b"];
        let objects = objects.into_iter().zip(names);
        let scene = scene(objects.map(|((mesh, place), name)| (name, mesh, place, [0.7; 3])).collect());
        let up = if name.contains("tile") { DVec3::Z } else { DVec3::Y };
        session.set_scene(&line_drawing(&scene, Camera::default())).unwrap();
        for direction in [p(0.3, 0.45, 1.0), p(-0.35, 0.3, 0.8), p(0.1, 0.8, 0.9), p(0.02, 0.3, 0.6)] {
            for orthographic in [false, true] {
                let camera = Camera::looking_from(direction, up, &scene.extent(), 1.0);
                let camera = camera.with_orthographic(orthographic).framing(&scene.extent(), 1.0);
                for (boundary, ends) in boundaries.iter().enumerate() {
                    for (look, classes) in [
                        ("all", &EdgeClass::ALL[..]),
                        (
                            "outlines",
                            &[
                                EdgeClass::Silhouette,
                                EdgeClass::Border,
                                EdgeClass::Object,
                                EdgeClass::Intersection,
                            ],
                        ),
                    ] {
                        // Where one box stands before another in one plane, its ridge is all that there is.
                        if look == "outlines" && !name.contains("tile") {
                            continue;
                        }
                        let mut opened = line_drawing(&scene, camera);
                        only(&mut opened, classes);
                        for side in [150, 240] {
                            set_width(&mut opened, 2.0, side);
                            let share = drawn_share(&mut session, &opened, side, *ends);
                            if share < 1.0 {
                                gaps.push((name, boundary, look, direction, orthographic, side, share));
                            }
                        }
                    }
                }
            }
        }
    }
    for gap in &gaps {
        println!("{gap:?}");
    }
    assert!(gaps.is_empty(), "{} boundaries have gaps", gaps.len());
}

/// Ink across a line at this place.
fn width_at(ink: &Ink, place: DVec2, across: DVec2, reach: f64) -> f64 {
    let steps = (reach * 4.0) as i32;
    (-steps..=steps).map(|i| ink.sampled(place + across * f64::from(i) * 0.25) * 0.25).sum()
}

#[test]
fn the_outline_of_a_cube_is_closed_and_evenly_wide_from_any_side() {
    const SIDE: u32 = 128;
    const WIDTH: f64 = 6.0;
    let mut session = session();
    let scene = scene(vec![("cube", cube(2.0), DMat4::IDENTITY, [0.7; 3])]);
    session.set_scene(&line_drawing(&scene, Camera::default())).unwrap();
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for direction in directions(32) {
        for orthographic in [false, true] {
            let camera = Camera::looking_from(direction, DVec3::Y, &scene.extent(), 1.25);
            let camera = camera.with_orthographic(orthographic);
            let distant = Camera { position: camera.position * 1.15, ..camera };
            let mut opened = line_drawing(&scene, distant);
            only(&mut opened, &[EdgeClass::Silhouette]);
            set_width(&mut opened, WIDTH, SIDE);
            let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
            let hull = outline(&opened, [SIDE; 2]);
            let middle = hull.iter().sum::<DVec2>() / hull.len() as f64;
            let reached = ink.paper_from_corner();
            let center = middle.y as usize * SIDE as usize + middle.x as usize;
            assert!(reached[0] && !reached[center], "the outline is open from {direction}, {orthographic}");
            let mut measured = 0;
            for (i, &a) in hull.iter().enumerate() {
                let b = hull[(i + 1) % hull.len()];
                let length = a.distance(b);
                let across = (b - a).perp() / length;
                let mut place = 9.0;
                while place < length - 9.0 {
                    let here = a.lerp(b, place / length);
                    if here.min_element() > 10.0 && here.max_element() < f64::from(SIDE) - 10.0 {
                        let width = width_at(&ink, here, across, 8.0);
                        (least, most) = (least.min(width), most.max(width));
                        assert!(
                            (width - WIDTH).abs() <= 1.0,
                            "{width} px wide at {here} from {direction}, {orthographic}"
                        );
                        measured += 1;
                    }
                    place += 1.0;
                }
            }
            assert!(measured > 50, "nothing to see from {direction}: {measured}");
        }
    }
    println!("outline of a cube: {least:.2} to {most:.2} px wide, {WIDTH} wanted");
}

#[test]
fn where_the_near_plane_cuts_there_is_no_line() {
    const SIDE: u32 = 160;
    let mut session = session();
    // The eye is so near to the left wall of a box that the near plane cuts it, and sees a screen through the opening.
    for with_screen in [false, true] {
        let screen = ("screen", plane(40.0), at(0.0, 0.0, -5.0), [0.7; 3]);
        let mut objects = vec![("box", cube(2.0), DMat4::IDENTITY, [0.7; 3])];
        objects.extend(with_screen.then_some(screen));
        let scene = scene(objects);
        let depth = if with_screen { 5.5 } else { 1.5 };
        let distance = 1e-6 * depth;
        let camera = Camera {
            position: DVec3::new(-1.0 + distance, 0.0, 0.5),
            focal_point: DVec3::new(-1.0 + distance, 0.0, 0.0),
            ..Camera::default()
        };
        let mut opened = line_drawing(&scene, camera);
        session.set_scene(&opened).unwrap();
        only(&mut opened, &EdgeClass::ALL);
        set_width(&mut opened, 2.0, SIDE);
        let picture = session.draw(&opened, [SIDE; 2], false).unwrap();
        let buffer = surfels(&mut session, &picture);
        let row = (SIDE / 2 * SIDE) as usize;
        // A tenth of the cut's depth away, so the wall ends that far from the middle.
        let cut = (0.1 / 15.0_f64.to_radians().tan() * f64::from(SIDE) * 0.5) as usize;
        let [outside, wall] = [cut + 4, cut - 4].map(|left| buffer[row + SIDE as usize / 2 - left].object);
        assert_eq!(
            (outside, wall),
            (if with_screen { 2 } else { 0 }, 1),
            "the near plane does not cut the wall"
        );
        let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
        let corner = SIDE as i32 / 2;
        for (x, y) in (0..SIDE as i32).flat_map(|y| (0..SIDE as i32).map(move |x| (x, y))) {
            if (x - corner).abs() > 3 {
                assert_eq!(ink.at(x, y), 0.0, "a line at {x},{y}; with a screen: {with_screen}");
            }
        }
        assert!((0..SIDE as i32).all(|y| ink.near(DVec2::new(f64::from(corner), f64::from(y))) > 0.5));
    }
}

#[test]
fn inside_a_box_only_its_edges_are_drawn() {
    const SIDE: u32 = 160;
    let mut session = session();
    let scene = scene(vec![("box", cube(2.0), DMat4::IDENTITY, [0.7; 3])]);
    let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) * 2.0 - 1.0;
    for towards in directions(12) {
        let position = DVec3::new(0.1, -0.2, 0.15);
        let camera = Camera {
            position,
            focal_point: position - towards,
            projection: Projection::Perspective { view_angle: 100.0 },
            ..Camera::default()
        };
        let mut opened = line_drawing(&scene, camera);
        session.set_scene(&opened).unwrap();
        only(&mut opened, &EdgeClass::ALL);
        set_width(&mut opened, 2.0, SIDE);
        let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
        let mut is_edge = vec![false; ink.values.len()];
        for (a, b) in (0..8).flat_map(|a| [1, 2, 4].map(|axis| (a, a ^ axis))).filter(|(a, b)| a < b) {
            let steps = 2000;
            for i in 0..=steps {
                let point = corner(a).lerp(corner(b), f64::from(i) / f64::from(steps));
                let is_before = (point - position).dot(camera.forward()) > 0.01;
                let place = projected(&opened, [SIDE; 2], &[point])[0];
                if is_before && place.min_element() >= 0.0 && place.max_element() < f64::from(SIDE) {
                    is_edge[place.y as usize * SIDE as usize + place.x as usize] = true;
                    assert!(ink.near(place) > 0.5, "a gap at {place}, towards {towards}");
                }
            }
        }
        assert!(is_edge.iter().filter(|edge| **edge).count() > 100);
        for (i, _) in ink.values.iter().enumerate().filter(|(_, value)| **value > 0.0) {
            let (x, y) = (i as i32 % SIDE as i32, i as i32 / SIDE as i32);
            let near = (y - 3..=y + 3).flat_map(|y| (x - 3..=x + 3).map(move |x| (x, y)));
            let inside = |c: i32| (0..SIDE as i32).contains(&c);
            let mut near = near.filter(|(x, y)| inside(*x) && inside(*y));
            assert!(
                near.any(|(x, y)| is_edge[(y * SIDE as i32 + x) as usize]),
                "a line at {x},{y}, towards {towards}"
            );
        }
    }
}

#[test]
fn holes_by_alpha_are_outlined_and_have_no_lines_in_them() {
    const SIDE: u32 = 240;
    let mut session = session();
    // Once as they are, and once moved, so that holes run over the border of the sheet.
    for moved in [0.0, 0.11] {
        let mut scene = named("perforated").scene;
        let texture = Arc::make_mut(&mut scene).materials[0].base_color_texture.as_mut().unwrap();
        texture.transform.0 = Mat3::from_translation(Vec2::splat(moved));
        texture.wrap = [Wrap::Repeat; 2];
        for (direction, orthographic) in [
            (DVec3::new(0.2, 0.15, 1.0), false),
            (DVec3::new(0.2, 0.15, 1.0), true),
            (DVec3::new(-0.6, 0.5, 1.0), false),
        ] {
            let camera = Camera::looking_from(direction, DVec3::Y, &scene.extent(), 1.0);
            let mut opened = line_drawing(&scene, camera.with_orthographic(orthographic));
            session.set_scene(&opened).unwrap();
            only(&mut opened, &[EdgeClass::Silhouette, EdgeClass::Border, EdgeClass::Object]);
            set_width(&mut opened, 2.0, SIDE);
            let picture = session.draw(&opened, [SIDE; 2], false).unwrap();
            let buffer = surfels(&mut session, &picture);
            let edges = edge_classes(&mut session, &picture);
            let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
            let object = |x: i32, y: i32| buffer[(y * SIDE as i32 + x) as usize].object;
            let (mut gaps, mut floating, mut boundary) = (Vec::new(), Vec::new(), 0);
            for (x, y) in (3..SIDE as i32 - 3).flat_map(|y| (3..SIDE as i32 - 3).map(move |x| (x, y))) {
                let is_end =
                    [(1, 0), (-1, 0), (0, 1), (0, -1)].iter().any(|(i, j)| object(x + i, y + j) != 1);
                if object(x, y) == 1 && is_end {
                    boundary += 1;
                    if ink.near(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)) < 0.5 {
                        gaps.push((x, y));
                    }
                }
                let differs = |reach: i32| {
                    (-reach..=reach).any(|j| (-reach..=reach).any(|i| object(x + i, y + j) != object(x, y)))
                };
                if edges[(y * SIDE as i32 + x) as usize].is_some_and(|(_, owner)| owner == 1) && !differs(2) {
                    floating.push((x, y));
                }
            }
            println!(
                "holes moved by {moved}, {direction}: {boundary} px of outline, {} gaps, {} floating",
                gaps.len(),
                floating.len()
            );
            assert!(boundary > 800);
            assert!(gaps.is_empty() && floating.is_empty(), "gaps {gaps:?}, floating {floating:?}");
        }
    }
}

#[test]
fn where_alpha_fails_on_both_sides_of_an_edge_there_is_no_line() {
    const SIDE: u32 = 100;
    const TEXELS: u32 = 256;
    let mut session = session();
    // A folded card of 80 by 80 pixels, and how many texels beside the fold are holes: 4 of them are 1.25 pixels.
    for (holes, is_drawn) in [(0, true), (4, false)] {
        let corners = [(0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 1.0), (1.0, 1.0)];
        let at = |(u, v): (f32, f32)| Vec3::new(u - 0.5, v - 0.5, 0.5 - (u - 0.5).abs()) * 80.0;
        let mut card = from_triangles(corners.map(at).to_vec(), vec![0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4]);
        card.uvs = corners.map(Vec2::from).to_vec();
        let mut scene = scene(vec![("card", card, DMat4::IDENTITY, [0.7; 3])]);
        let changed = Arc::make_mut(&mut scene);
        let is_hole = |i: u32| (TEXELS / 2 - holes..TEXELS / 2 + holes).contains(&(i % TEXELS));
        let rgba = (0..TEXELS * TEXELS).flat_map(|i| [255, 255, 255, if is_hole(i) { 0 } else { 255 }]);
        let (name, rgba) = ("leaves".to_owned(), rgba.collect());
        changed.textures.push(Arc::new(Texture { name, width: TEXELS, height: TEXELS, rgba }));
        let material = &mut changed.materials[0];
        material.alpha = AlphaMode::Mask(0.5);
        material.base_color_texture = Some(TextureRef {
            texture: 0,
            transform: UvTransform::default(),
            wrap: [Wrap::Clamp; 2],
            nearest: true,
        });
        let camera = Camera {
            position: DVec3::Z * 100.0,
            projection: Projection::Orthographic { view_height: f64::from(SIDE) },
            ..Camera::default()
        };
        let mut opened = line_drawing(&scene, camera);
        session.set_scene(&opened).unwrap();
        only(&mut opened, &[EdgeClass::Ridge, EdgeClass::Valley]);
        let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
        let length = ink.values.iter().filter(|value| **value > 0.0).count();
        assert!(if is_drawn { length > 60 } else { length == 0 }, "{holes} texels of holes: {length} px");
    }
}

#[test]
fn surfaces_that_bend_alike_have_a_whole_line_where_they_meet() {
    let mut session = session();
    for angle in [4.0, 8.0, 16.0_f64] {
        let apart = 2.0 * (0.5 * angle.to_radians()).sin();
        let balls = [0.0, apart].map(|y| ("ball", sphere(1.0, 96, 192), at(0.0, y, 0.0), [0.7; 3]));
        let scene = scene(balls.to_vec());
        let camera = Camera::looking_from(DVec3::new(0.1, 0.4, 1.0), DVec3::Y, &scene.extent(), 1.0);
        let mut opened = line_drawing(&scene, camera);
        only(&mut opened, &[EdgeClass::Intersection]);
        set_width(&mut opened, 2.0, 120);
        session.set_scene(&opened).unwrap();
        let ink = Ink::of(&mut session, &opened, [120; 2]);
        let radius = (0.5 * angle.to_radians()).cos();
        // The half that is seen, without the ends, where balls hide each other.
        let front = (-60..=60).map(|degrees| f64::from(degrees).to_radians());
        let circle: Vec<DVec3> =
            front.map(|a| DVec3::new(radius * a.sin(), 0.5 * apart, radius * a.cos())).collect();
        let places = projected(&opened, [120; 2], &circle);
        let found = places.iter().filter(|place| ink.near(**place) >= 0.5).count();
        println!("{angle} degrees: {found} of {}", places.len());
        assert_eq!(found, places.len(), "{angle}");
    }
}

#[test]
fn a_coarse_ball_that_is_sunk_in_a_wall_has_no_outline_within_it() {
    let mut session = session();
    let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let wall = from_triangles(corners.to_vec(), vec![0, 1, 2, 0, 2, 3]);
    for sunk in [0.08, 0.1, 0.15, 0.2] {
        let scene = scene(vec![
            ("ball", sphere(1.0, 12, 24), at(0.0, 0.0, 0.0), [0.7; 3]),
            ("wall", wall.clone(), at(0.0, 0.0, sunk), [0.7; 3]),
        ]);
        let mut camera = Camera::looking_from(DVec3::new(0.02, 0.03, 1.0), DVec3::Y, &scene.extent(), 1.0);
        camera.projection = Projection::Orthographic { view_height: 3.0 };
        let mut opened = line_drawing(&scene, camera);
        set_width(&mut opened, 2.0, 120);
        session.set_scene(&opened).unwrap();
        let picture = session.draw(&opened, [120; 2], false).unwrap();
        let classes = edge_classes(&mut session, &picture);
        let count = |class| classes.iter().flatten().filter(|(found, _)| *found == class).count();
        // The outline lies a little behind the wall, beside the line that is seen by hardly a pixel.
        let [within, seen] = [EdgeClass::Object, EdgeClass::Intersection].map(count);
        println!("sunk by {sunk}: {within} px of outline, {seen} of intersection");
        assert!(seen > 200 && within == 0, "{sunk}");
    }
}
