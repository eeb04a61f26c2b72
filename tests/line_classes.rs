//! Each class of exact lines has a look of its own, and lines lie over each other as what they belong to does.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "what was measured is worth reading")]

mod common;

use std::sync::Arc;

use common::line_drawing::{edge_classes, line_drawing, only, set_width};
use common::line_scenes::named;
use common::outline::{hull_of, outline, projected};
use common::{at, scene, session, set, surfels, texels};
use glam::{DMat4, DVec2, DVec3};
use hachure::export::session::Opened;
use hachure::geometry::primitives::{cube, plane, sphere};
use hachure::geometry::{EdgeClass, Mesh, Submesh};
use hachure::scene::{Camera, Material, Scene};
use hachure::style::Value;
use image::RgbaImage;

const SIDE: u32 = 200;

fn name(class: EdgeClass) -> &'static str {
    class.into()
}

fn color(class: EdgeClass) -> [u8; 3] {
    [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0], [255, 0, 255], [0, 255, 255], [0, 0, 0]]
        [class as usize]
}

/// The classes that come from the shape alone.
fn shapes() -> impl Iterator<Item = EdgeClass> {
    EdgeClass::ALL.into_iter().filter(|class| !class.is_detail() && *class != EdgeClass::Section)
}

/// Objects that have lines of each of them.
fn every_class() -> Arc<Scene> {
    let mut scene = scene(vec![
        ("stairs", Mesh::clone(&named("stairs").scene.meshes[0]), at(-1.3, 0.0, 0.0), [0.7; 3]),
        ("sheet", plane(2.0), at(1.3, 0.0, 0.0), [0.7; 3]),
        ("ball", sphere(0.5, 32, 64), at(1.3, 0.3, 0.1), [0.7; 3]),
        ("backdrop", plane(3.0), at(0.0, 0.5, -2.0), [0.7; 3]),
    ]);
    let changed = Arc::make_mut(&mut scene);
    let second = changed.materials.len();
    changed.materials.push(Material::default());
    let sheet = Arc::make_mut(&mut changed.meshes[1]);
    let first = sheet.submeshes[0].material;
    sheet.submeshes = vec![
        Submesh { first_index: 0, index_count: 3, material: first },
        Submesh { first_index: 3, index_count: 3, material: second },
    ];
    scene
}

fn camera(scene: &Scene, towards_viewer: DVec3) -> Camera {
    Camera::looking_from(towards_viewer, DVec3::Y, &scene.extent(), 1.0)
}

/// All classes, in colors of their own.
fn colored(scene: &Arc<Scene>) -> Opened {
    let mut opened = line_drawing(scene, camera(scene, DVec3::new(-0.5, 0.4, 1.0)));
    only(&mut opened, &shapes().collect::<Vec<_>>());
    set_width(&mut opened, 2.0, SIDE);
    for class in shapes() {
        let [r, g, b] = color(class);
        set(&mut opened, &format!("edges.{}.color", name(class)), &format!("#{r:02x}{g:02x}{b:02x}"));
    }
    opened
}

#[test]
fn every_class_is_drawn_alone_in_its_color() {
    let mut session = session();
    let scene = every_class();
    let mut opened = colored(&scene);
    session.set_scene(&opened).unwrap();
    for class in shapes() {
        only(&mut opened, &[class]);
        let picture = session.image(&opened, [SIDE; 2], true).unwrap();
        let inked: Vec<_> = picture.pixels().filter(|p| p.0[3] > 127).collect();
        let length = inked.len() / 2;
        println!("{}: about {length} px", name(class));
        assert!(length > 20, "{} is not drawn", name(class));
        for pixel in inked {
            assert_eq!(pixel.0[..3], color(class), "{}", name(class));
        }
    }
    only(&mut opened, &[]);
    assert!(session.image(&opened, [SIDE; 2], true).unwrap().pixels().all(|p| p.0[3] == 0));
}

#[test]
fn turning_a_class_off_removes_its_lines_and_nobody_elses() {
    let mut session = session();
    let scene = every_class();
    let mut opened = colored(&scene);
    session.set_scene(&opened).unwrap();
    let mut lines = |opened: &Opened| {
        let picture = session.draw(opened, [SIDE; 2], false).unwrap();
        let edge_map = common::captured(&mut session, "edge map").unwrap();
        let weights = texels::<[u32; 4]>(&mut session, &edge_map);
        let classes = edge_classes(&mut session, &picture);
        let drawn =
            classes.into_iter().zip(weights).map(|(edge, texel)| edge.filter(|_| texel[3] >> 26 != 0));
        drawn.collect::<Vec<_>>()
    };
    let all = lines(&opened);
    for class in shapes() {
        let key = format!("edges.{}.show", name(class));
        set(&mut opened, &key, "false");
        let without = lines(&opened);
        set(&mut opened, &key, "true");
        let is_class = |edge: &Option<(EdgeClass, u32)>| edge.is_some_and(|(found, _)| found == class);
        assert!(all.iter().any(is_class) && !without.iter().any(is_class), "{}", name(class));
        // Lines whose ink overlaps with it had become one with it.
        let side = SIDE as usize;
        let is_beside = |i: usize| {
            let (x, y) = (i % side, i / side);
            let rows = y.saturating_sub(2)..(y + 3).min(side);
            rows.into_iter()
                .any(|y| (x.saturating_sub(2)..(x + 3).min(side)).any(|x| is_class(&all[y * side + x])))
        };
        let changed = all.iter().zip(&without).enumerate();
        let changed = changed.filter(|(i, (before, after))| before != after && !is_beside(*i));
        let changed: Vec<_> = changed.map(|(_, both)| both).collect();
        assert!(changed.is_empty(), "{}: {} {:?}", name(class), changed.len(), changed[0]);
    }
    assert!(lines(&opened) == all);
}

#[test]
fn materials_have_no_lines_until_asked_for_and_classes_follow_their_group() {
    let mut session = session();
    let scene = every_class();
    let mut opened = line_drawing(&scene, camera(&scene, DVec3::new(-0.5, 0.4, 1.0)));
    session.set_scene(&opened).unwrap();
    let mut drawn = |opened: &Opened| {
        session.draw(opened, [SIDE; 2], false).unwrap();
        let edges = common::captured(&mut session, "edge map");
        let edges = edges.map(|edges| texels::<[u32; 4]>(&mut session, &edges));
        let found = edges.unwrap_or_default();
        let is_drawn =
            |class: EdgeClass| found.iter().any(|t| t[0] >> 28 == class as u32 + 1 && t[3] >> 26 != 0);
        EdgeClass::ALL.into_iter().filter(|class| is_drawn(*class)).collect::<Vec<_>>()
    };
    let all_but = |out: &[EdgeClass]| shapes().filter(|c| !out.contains(c)).collect::<Vec<_>>();
    assert_eq!(drawn(&opened), all_but(&[EdgeClass::Material]));
    set(&mut opened, "edges.material.show", "true");
    assert_eq!(drawn(&opened), all_but(&[]));
    set(&mut opened, "edges.profile.show", "false");
    assert!(drawn(&opened).iter().all(|class| !class.is_profile()));
    set(&mut opened, "edges.border.show", "true");
    set(&mut opened, "edges.inner.show", "false");
    set(&mut opened, "edges.material.show", "false");
    assert_eq!(drawn(&opened), [EdgeClass::Border]);
}

/// Half precision, without its special values.
fn half(bits: u32) -> f64 {
    (1.0 + f64::from(bits & 1023) / 1024.0) * f64::from((bits >> 10 & 31) as i32 - 15).exp2()
}

#[test]
fn every_class_has_its_own_width() {
    let mut session = session();
    let scene = every_class();
    let mut opened = colored(&scene);
    session.set_scene(&opened).unwrap();
    let width = |class: EdgeClass| 2.0 + class as u32 as f64;
    for class in shapes() {
        let reference = width(class) * 1080.0 / f64::from(SIDE);
        set(&mut opened, &format!("edges.{}.width", name(class)), &format!("{reference}"));
    }
    session.draw(&opened, [SIDE; 2], false).unwrap();
    let mut seen = [0; EdgeClass::ALL.len()];
    let edge_map = common::captured(&mut session, "edge map").unwrap();
    for texel in texels::<[u32; 4]>(&mut session, &edge_map) {
        if texel[0] != 0 {
            let class = EdgeClass::ALL[(texel[0] >> 28) as usize - 1];
            let found = 2.0 * half(texel[3] & 0xffff);
            assert!((found - width(class)).abs() < 0.02, "{}: {found}", name(class));
            seen[class as usize] += 1;
        }
    }
    assert!(shapes().all(|class| seen[class as usize] > 5), "{seen:?}");
}

/// How much of a color a pixel has beyond gray, 0 to 1; the most among it and its neighbors.
fn tint_near(picture: &RgbaImage, place: DVec2, of: impl Fn([f64; 3]) -> f64) -> f64 {
    let (x, y) = (place.x.floor() as i64, place.y.floor() as i64);
    let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
    let values =
        around.filter_map(|(x, y)| picture.get_pixel_checked(x.try_into().ok()?, y.try_into().ok()?));
    values.map(|p| of([p.0[0], p.0[1], p.0[2]].map(|c| f64::from(c) / 255.0))).fold(0.0, f64::max)
}

fn red([r, g, _]: [f64; 3]) -> f64 {
    r - g
}

/// As long as their spines are more than a pixel and a half apart: closer ones run into each other.
#[test]
fn a_thin_line_inside_a_wide_one_stays_whole() {
    let mut session = session();
    let scene = scene(vec![("cube", cube(2.0), DMat4::IDENTITY, [0.7; 3])]);
    for direction in [DVec3::new(0.7, 0.6, 1.0), DVec3::new(0.25, 0.5, 1.0), DVec3::new(0.3, 0.35, 1.0)] {
        let mut opened = line_drawing(&scene, camera(&scene, direction));
        session.set_scene(&opened).unwrap();
        only(&mut opened, &[EdgeClass::Silhouette, EdgeClass::Ridge]);
        for (key, px) in [("silhouette", 11.0), ("ridge", 2.0)] {
            set(&mut opened, &format!("edges.{key}.width"), &format!("{}", px * 1080.0 / f64::from(SIDE)));
        }
        set(&mut opened, "edges.ridge.color", "#ff0000");
        let picture = session.image(&opened, [SIDE; 2], false).unwrap();
        let hull = outline(&opened, [SIDE; 2]);
        let from_outline = |place: DVec2| {
            let sides = hull.iter().zip(hull.iter().cycle().skip(1));
            sides.map(|(a, b)| (place - a).perp_dot((b - a).normalize()).abs()).fold(f64::INFINITY, f64::min)
        };
        let corner = DVec3::ONE;
        for other in [DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, -1.0)] {
            let ends = projected(&opened, [SIDE; 2], &[corner, other]);
            let length = ends[0].distance(ends[1]);
            let steps = length as u32 * 2;
            // Where both run along one spine there is only one line.
            let places = (0..=steps).map(|i| ends[0].lerp(ends[1], f64::from(i) / f64::from(steps)));
            let broken: Vec<_> = places
                .filter(|place| from_outline(*place) > 2.0 && tint_near(&picture, *place, red) < 0.5)
                .collect();
            assert!(
                broken.is_empty(),
                "{direction}, ridge to {other}: {} of {steps}: {broken:?}",
                broken.len()
            );
        }
    }
}

#[test]
fn a_wide_line_covers_what_lies_behind_it_and_nothing_before_it() {
    let mut session = session();
    let scene = scene(vec![
        ("near", plane(1.2), at(0.7, 0.3, 1.5), [0.7; 3]),
        ("cube", cube(2.0), DMat4::IDENTITY, [0.7; 3]),
        ("far", plane(4.0), at(-1.5, -1.2, -2.0), [0.7; 3]),
    ]);
    for orthographic in [false, true] {
        let camera = camera(&scene, DVec3::new(0.3, 0.2, 1.0)).with_orthographic(orthographic);
        let mut opened = line_drawing(&scene, camera);
        session.set_scene(&opened).unwrap();
        only(&mut opened, &[]);
        let cube = [1];
        let half_width = 5.0;
        let width = format!("{}", 2.0 * half_width * 1080.0 / f64::from(SIDE));
        for class in ["silhouette", "object"] {
            for (key, value) in [("show", "true"), ("width", &width)] {
                let key = format!("edges.{class}.{key}");
                opened.document.set_for(&scene, &cube, &key, &Value::parse(value)).unwrap();
            }
        }
        let picture = session.draw(&opened, [SIDE; 2], true).unwrap();
        let buffer = surfels(&mut session, &picture);
        let image = session.image(&opened, [SIDE; 2], true).unwrap();
        let object = |x: i64, y: i64| {
            let inside = (0..i64::from(SIDE)).contains(&x) && (0..i64::from(SIDE)).contains(&y);
            if inside { buffer[(y * i64::from(SIDE) + x) as usize].object } else { 0 }
        };
        let (mut before, mut seen) = (0, [0; 4]);
        for (x, y, pixel) in image.enumerate_pixels() {
            if object(i64::from(x), i64::from(y)) == 1 {
                before += 1;
                assert_eq!(pixel.0[3], 0, "ink over the nearer object at {x},{y}");
            }
        }
        assert!(before > 1000, "{before}");
        let corners: Vec<DVec3> = scene.meshes[1].positions.iter().map(|p| p.as_dvec3()).collect();
        let places = projected(&opened, [SIDE; 2], &corners);
        let middle = places.iter().sum::<DVec2>() / places.len() as f64;
        let hull = hull_of(places);
        for (i, &a) in hull.iter().enumerate() {
            let b = hull[(i + 1) % hull.len()];
            for step in 1..20 {
                let spine = a.lerp(b, f64::from(step) / 20.0);
                let mut outwards = (b - a).perp().normalize();
                if outwards.dot(spine - middle) < 0.0 {
                    outwards = -outwards;
                }
                // Hidden spines draw nothing.
                let is_hidden = (-3..=3)
                    .any(|dy| (-3..=3).any(|dx| object(spine.x as i64 + dx, spine.y as i64 + dy) == 1));
                let out = spine + outwards * (half_width - 1.5);
                let (x, y) = (out.x as i64, out.y as i64);
                let behind = object(x, y);
                if !is_hidden && behind != 1 && behind != 2 {
                    seen[behind as usize] += 1;
                    let ink = image.get_pixel(x as u32, y as u32).0[3];
                    assert!(ink > 230, "no ink at {out} over object {behind}: {ink}");
                }
            }
        }
        println!("ink over paper {} times, over the farther object {} times", seen[0], seen[3]);
        assert!(seen[0] > 5 && seen[3] > 5, "{seen:?}");
    }
}

/// The foot of a wall that runs away from the eye and dips into the ground by more pixels at its near end than at its far one.
#[test]
fn the_foot_of_what_dips_into_a_surface_is_of_one_class() {
    let mut session = session();
    let ground = DMat4::from_translation(DVec3::Y * -1.0) * DMat4::from_scale(DVec3::new(80.0, 2.0, 80.0));
    for dip in [0.06, 0.07, 0.08] {
        let wall = DMat4::from_translation(DVec3::new(0.0, 2.0 - dip, 0.0))
            * DMat4::from_scale(DVec3::new(1.0, 4.0, 30.0));
        let scene = scene(vec![("ground", cube(1.0), ground, [0.7; 3]), ("wall", cube(1.0), wall, [0.7; 3])]);
        let seen = Camera {
            position: DVec3::new(10.0, 8.0, 26.0),
            focal_point: DVec3::new(0.0, 0.0, 4.0),
            ..camera(&scene, DVec3::Z)
        };
        let opened = line_drawing(&scene, seen);
        session.set_scene(&opened).unwrap();
        let picture = session.draw(&opened, [SIDE; 2], true).unwrap();
        let classes = edge_classes(&mut session, &picture);
        let ends = [DVec3::new(0.5, 0.0, -13.0), DVec3::new(0.5, 0.0, 13.0)];
        let ends = projected(&opened, [SIDE; 2], &ends);
        let mut found = [0; EdgeClass::ALL.len()];
        for step in 0..=100 {
            let at = ends[0].lerp(ends[1], f64::from(step) / 100.0);
            let near = (-2..=2).flat_map(|y| (-2..=2).map(move |x| [at.x as i64 + x, at.y as i64 + y]));
            for [x, y] in near.filter(|px| px.iter().all(|v| (0..i64::from(SIDE)).contains(v))) {
                if let Some((class, _)) = classes[(y * i64::from(SIDE) + x) as usize] {
                    found[class as usize] += 1;
                }
            }
        }
        println!("dips by {dip}: {found:?}");
        let all: usize = found.iter().sum();
        assert!(all > 100, "{found:?}");
        assert_eq!(found[EdgeClass::Intersection as usize], all, "dips by {dip}: {found:?}");
    }
}

/// A board's upper edge, the line in which a tilted strip comes out of its front, and the outline of that strip below.
#[test]
fn of_three_lines_side_by_side_both_outer_ones_are_whole() {
    let mut session = session();
    for height in [0.1, 0.105, 0.11] {
        let front = DMat4::from_translation(DVec3::Z * 0.5);
        let board = DMat4::from_scale(DVec3::new(6.0, height, 1.0));
        let strip = front
            * DMat4::from_rotation_x(-0.4)
            * DMat4::from_translation(DVec3::Z * -0.01)
            * DMat4::from_scale(DVec3::new(6.2, height, 0.02));
        let scene = scene(vec![("board", cube(1.0), board, [0.7; 3]), ("strip", cube(1.0), strip, [0.7; 3])]);
        let mut opened = line_drawing(&scene, camera(&scene, DVec3::new(0.3, 0.35, 1.0)));
        session.set_scene(&opened).unwrap();
        only(
            &mut opened,
            &[EdgeClass::Silhouette, EdgeClass::Object, EdgeClass::Ridge, EdgeClass::Intersection],
        );
        set_width(&mut opened, 2.0, SIDE);
        set(&mut opened, "edges.ridge.width", &format!("{}", 1080.0 / f64::from(SIDE)));
        let picture = session.draw(&opened, [SIDE; 2], true).unwrap();
        let classes = edge_classes(&mut session, &picture);
        let half = DVec3::new(2.8, height / 2.0, 0.5);
        let ends = projected(&opened, [SIDE; 2], &[half * DVec3::new(-1.0, 1.0, 1.0), half]);
        let steps = ends[0].distance(ends[1]) as u32 * 2;
        let (mut no_ridge, mut no_outline, mut intersections) = (0, 0, 0);
        for step in 0..=steps {
            let at = ends[0].lerp(ends[1], f64::from(step) / f64::from(steps));
            let near = |above: i64, below: i64| {
                let rows =
                    (-above..=below).flat_map(|y| (-1..=1).map(move |x| [at.x as i64 + x, at.y as i64 + y]));
                rows.filter_map(|[x, y]| classes[(y * i64::from(SIDE) + x) as usize]).map(|(class, _)| class)
            };
            no_ridge += u32::from(near(1, 1).all(|class| class != EdgeClass::Ridge));
            no_outline += u32::from(near(0, 5).all(|class| class != EdgeClass::Silhouette));
            intersections += near(1, 1).filter(|class| *class == EdgeClass::Intersection).count();
        }
        println!("{height}: of {steps} places {no_ridge} without ridge, {no_outline} without outline");
        assert!(intersections > 100, "{height}: nothing runs between");
        assert_eq!((no_ridge, no_outline), (0, 0), "{height}");
    }
}
