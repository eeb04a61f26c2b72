//! Mirrors: what is seen in them is what the eye's mirror image sees, with edges of its own.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Object, image, scene, session, set};
use glam::{DMat4, DQuat, DVec3};
use hachure::document::lighting::Source;
use hachure::document::{Document, Role};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, Plane, primitives};
use hachure::scene::{Camera, Light, LightKind, Scene};
use image::RgbaImage;
use std::sync::Arc;

const SIDE: u32 = 160;

/// A face in the plane z = 0 whose front is towards +z.
fn glass() -> Mesh {
    primitives::plane(4.0)
}

fn cube(place: DMat4) -> Object {
    ("cube", primitives::cube(1.0), place, [0.8, 0.4, 0.3])
}

fn ball(place: DMat4) -> Object {
    ("ball", primitives::sphere(0.5, 12, 24), place, [0.3, 0.5, 0.8])
}

/// Two things before a mirror in the plane z = 0, off the line of sight to it, and how they lie.
fn places() -> [DMat4; 2] {
    let turn = DMat4::from_quat(DQuat::from_rotation_y(0.5) * DQuat::from_rotation_x(0.4));
    [
        DMat4::from_translation(DVec3::new(-1.2, 0.3, 1.2)) * turn,
        DMat4::from_translation(DVec3::new(0.9, -0.4, 0.8)),
    ]
}

/// Seen from the right of the middle, so that the things' images in the mirror lie beside them.
fn camera() -> Camera {
    Camera {
        position: DVec3::new(3.0, 1.5, 6.0),
        focal_point: DVec3::new(-0.2, 0.0, 0.0),
        ..Camera::default()
    }
}

fn seen(scene: &Arc<Scene>, camera: Camera) -> Opened {
    let light = Light {
        kind: LightKind::Directional { direction: DVec3::new(-0.5, -0.7, -0.6).normalize() },
        color: glam::Vec3::ONE,
        intensity: 1.0,
        attached_to_camera: false,
        casts_shadow: false,
    };
    let mut document = Document { camera: Some(camera), lights: vec![light], ..Document::default() };
    document.lighting.source = Source::File;
    Opened { document, scene: Arc::clone(scene) }
}

/// A perfect mirror.
fn with_mirror(mut opened: Opened, name: &str) -> Opened {
    let node = opened.scene.nodes.iter().position(|n| n.name == name).unwrap();
    opened.document.set_role(&Arc::clone(&opened.scene), &[node], Role::Mirror, true);
    set(&mut opened, "mirror.reflectivity", "1");
    opened
}

fn drawn(session: &mut Session, opened: &Opened) -> RgbaImage {
    image(session, opened, SIDE)
}

/// Largest difference of any channel.
fn difference(a: &image::Rgba<u8>, b: &image::Rgba<u8>) -> u8 {
    a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap()
}

#[test]
fn a_mirror_shows_what_stands_as_far_behind_it_with_its_edges() {
    let mut session = session();
    let [a, b] = places();
    let before = vec![cube(a), ball(b)];
    let reflection = Plane::of_mesh(&glass()).unwrap().reflection();
    let behind = vec![cube(reflection * a), ball(reflection * b)];
    let mut with_glass = before.clone();
    with_glass.push(("glass", glass(), DMat4::IDENTITY, [0.9; 3]));
    let perspective = camera();
    for camera in [perspective, perspective.with_orthographic(true)] {
        for name in ["statue", "gooch", "comic", "lines"] {
            let style = hachure::style::preset::load(name).unwrap().style;
            let mut mirrored = with_mirror(seen(&scene(with_glass.clone()), camera), "glass");
            let mut twin = seen(&scene(behind.clone()), camera);
            for opened in [&mut mirrored, &mut twin] {
                opened.document.style = style.clone();
                set(opened, "mirror.reflectivity", "1");
                set(opened, "edges.profile.width", "14");
                set(opened, "edges.inner.width", "10");
            }
            // The things behind the glass are lit as their originals are.
            for light in &mut twin.document.lights {
                if let LightKind::Directional { direction } = &mut light.kind {
                    *direction = reflection.transform_vector3(*direction);
                }
            }
            let shown = drawn(&mut session, &mirrored);
            let expected = drawn(&mut session, &twin);
            let picture = common::draw(&mut session, &mirrored, SIDE);
            let surfels = common::surfels(&mut session, &picture);
            let is_glass =
                |x: i32, y: i32| surfels.get((y * SIDE as i32 + x) as usize).is_some_and(|s| s.object == 3);
            let (mut compared, mut inked, mut wrong) = (0, 0, 0);
            for y in 6..SIDE as i32 - 6 {
                for x in 6..SIDE as i32 - 6 {
                    // Lines of what stands before the glass and its own rim reach over it.
                    let is_inside = (-6..=6).all(|dy| (-6..=6).all(|dx| is_glass(x + dx, y + dy)));
                    if is_inside {
                        let (a, b) =
                            (shown.get_pixel(x as u32, y as u32), expected.get_pixel(x as u32, y as u32));
                        compared += 1;
                        inked += u32::from(b.0[0] < 60);
                        wrong += u32::from(difference(a, b) > 24);
                    }
                }
            }
            assert!(compared > 1500 && (inked > 20), "{name}: {compared} pixels, {inked} inked");
            assert!(wrong * 200 < compared, "{name}: {wrong} of {compared} pixels differ");
        }
    }
}

#[test]
fn what_stands_behind_a_mirror_is_not_seen_in_it() {
    let mut session = session();
    let mut objects = vec![("glass", glass(), DMat4::IDENTITY, [0.9; 3])];
    let without = with_mirror(seen(&scene(objects.clone()), camera()), "glass");
    objects.push(cube(DMat4::from_translation(DVec3::new(0.0, 0.0, -1.0))));
    let with = with_mirror(seen(&scene(objects), camera()), "glass");
    let (a, b) = (drawn(&mut session, &without), drawn(&mut session, &with));
    let center = SIDE / 2;
    for y in center - 20..center + 20 {
        for x in center - 20..center + 20 {
            assert_eq!(a.get_pixel(x, y), b.get_pixel(x, y));
        }
    }
}

fn reflections_drawn(session: &mut Session, opened: &Opened) -> u64 {
    let count = |session: &mut Session| {
        session.renderer().runs().iter().find(|(name, _)| *name == "mirror").map_or(0, |(_, runs)| *runs)
    };
    session.set_scene(opened).unwrap();
    let before = count(session);
    session.draw(opened, [64; 2], false).unwrap();
    count(session) - before
}

#[test]
fn mirrors_that_cannot_be_seen_cost_nothing_and_two_that_face_each_other_end() {
    let mut session = session();
    let one = scene(vec![("glass", glass(), DMat4::IDENTITY, [0.9; 3]), cube(places()[0])]);
    let opened = with_mirror(seen(&one, camera()), "glass");
    assert_eq!(reflections_drawn(&mut session, &opened), 1);
    // Drawn again without a change, nothing of it is drawn again.
    let runs = session.renderer().runs();
    session.draw(&opened, [64; 2], false).unwrap();
    assert_eq!(session.renderer().runs(), runs);

    let behind = Camera { position: DVec3::new(1.0, 1.0, -6.0), ..camera() };
    let away = Camera { focal_point: DVec3::new(6.0, 3.0, 12.0), ..camera() };
    for camera in [behind, away] {
        let opened = with_mirror(seen(&one, camera), "glass");
        assert_eq!(reflections_drawn(&mut session, &opened), 0);
    }
    let mut both_sides = with_mirror(seen(&one, behind), "glass");
    set(&mut both_sides, "mirror.side", "both");
    assert_eq!(reflections_drawn(&mut session, &both_sides), 1);

    let opposite = DMat4::from_translation(DVec3::Z * 3.0) * DMat4::from_rotation_y(std::f64::consts::PI);
    let facing = scene(vec![
        ("glass", glass(), DMat4::IDENTITY, [0.9; 3]),
        ("other", glass(), opposite, [0.9; 3]),
        cube(DMat4::from_translation(DVec3::new(0.0, 0.0, 1.0))),
    ]);
    let (position, focal_point) = (DVec3::new(0.3, 0.2, 2.5), DVec3::new(0.25, 0.2, 0.0));
    let between = Camera { position, focal_point, ..camera() };
    let opened = with_mirror(with_mirror(seen(&facing, between), "glass"), "other");
    for depth in [0, 1, 2, 5] {
        let mut opened = opened.clone();
        set(&mut opened, "view.reflections", &depth.to_string());
        assert_eq!(reflections_drawn(&mut session, &opened), depth);
    }
}

#[test]
fn without_reflectivity_a_mirror_is_an_object_like_any_other() {
    let mut session = session();
    let scene = scene(vec![("glass", glass(), DMat4::IDENTITY, [0.9, 0.6, 0.3]), cube(places()[0])]);
    let plain = seen(&scene, camera());
    let mut mirror = with_mirror(plain.clone(), "glass");
    set(&mut mirror, "mirror.reflectivity", "0");
    set(&mut mirror, "mirror.fresnel", "0");
    assert!(drawn(&mut session, &plain) == drawn(&mut session, &mirror));
}

#[test]
fn what_is_not_flat_is_drawn_and_said() {
    let mut session = session();
    let flattened = DMat4::from_scale(DVec3::new(1.0, 0.0, 0.0));
    let scene = scene(vec![
        ball(DMat4::IDENTITY),
        ("line", glass(), flattened, [0.5; 3]),
        ("glass", glass(), DMat4::from_translation(DVec3::Z * -2.0), [0.5; 3]),
    ]);
    let plain = seen(&scene, camera());
    let mut mirrors = plain.clone();
    mirrors.document.set_role(&scene, &[0, 1], Role::Mirror, true);
    assert!(drawn(&mut session, &plain) == drawn(&mut session, &mirrors));
    let faults: Vec<_> = mirrors.document.mirror_faults(&scene).iter().map(ToString::to_string).collect();
    assert_eq!(
        faults,
        [
            "/ball: cannot be a mirror: its surface is not flat; choose an object that is one flat face",
            "/line: cannot be a mirror: its surface has no area; choose an object that is one flat face",
        ]
    );
}
