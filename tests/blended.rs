//! Materials that blend: the picture is what their layers make of it in depth order, whatever the order of objects.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::sync::Arc;

use common::{at, greatest_difference, image, opened, set, set_for};
use glam::{DMat4, DQuat, DVec3, Vec4, vec4};
use hachure::document::Role;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, primitives};
use hachure::scene::{AlphaMode, Scene, Texture, TextureRef, UvTransform, Wrap};
use hachure::style::Technique;
use image::{Rgba, RgbaImage};
use strum::VariantNames as _;

const SIDE: u32 = 96;

/// Name, mesh, place, and the linear color with its opacity; less than 1 blends.
type Object = (&'static str, Mesh, DMat4, Vec4);

const BLACK_GLASS: Vec4 = Vec4::new(0.0, 0.0, 0.0, 0.5);
const WHITE: Vec4 = Vec4::ONE;

fn scene(objects: Vec<Object>) -> Scene {
    let (opaque, colors): (Vec<_>, Vec<_>) =
        objects.into_iter().map(|(name, mesh, place, color)| ((name, mesh, place, [1.0; 3]), color)).unzip();
    let mut scene = Arc::unwrap_or_clone(common::scene(opaque));
    for (material, color) in scene.materials.iter_mut().zip(colors) {
        material.base_color = color;
        material.alpha = if color.w < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
    }
    scene
}

/// Unlit surfaces on white paper, without lines, in parallel projection.
fn unlit(scene: Scene, towards_viewer: DVec3) -> Opened {
    let mut opened = opened(&Arc::new(scene), towards_viewer);
    opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(true));
    for (key, value) in [
        ("technique", "unlit"),
        ("edges.profile.show", "false"),
        ("edges.inner.show", "false"),
        ("edges.inner.color", "#000000"),
        ("view.background", "#ffffff"),
    ] {
        set(&mut opened, key, value);
    }
    opened
}

fn linear(p: Rgba<u8>) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let c = f64::from(p.0[i]) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

/// Largest difference of any channel between a pixel and linear colors.
fn miss(p: Rgba<u8>, expected: [f64; 3]) -> f64 {
    linear(p).iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn middle(image: &RgbaImage) -> Rgba<u8> {
    *image.get_pixel(image.width() / 2, image.height() / 2)
}

/// Largest difference of any channel of two pixels.
fn apart(a: &Rgba<u8>, b: &Rgba<u8>) -> u8 {
    a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap()
}

#[test]
fn panes_leave_what_their_opacities_leave_of_each_other() {
    let mut session = common::session();
    for count in 1..=5 {
        let panes = (0..count).map(|i| {
            (["a", "b", "c", "d", "e"][i], primitives::plane(1.0), at(0.0, 0.0, -0.2 * i as f64), BLACK_GLASS)
        });
        let image = image(&mut session, &unlit(scene(panes.collect()), DVec3::Z), SIDE);
        assert!(miss(middle(&image), [0.5_f64.powi(count as i32); 3]) < 0.01, "{count}");
    }
    // Front to back over white, in either order.
    let (red, blue) = (vec4(0.8, 0.1, 0.0, 0.25), vec4(0.0, 0.2, 0.9, 0.6));
    for (near, far) in [(red, blue), (blue, red)] {
        let panes = vec![
            ("far", primitives::plane(1.0), at(0.0, 0.0, -0.5), far),
            ("near", primitives::plane(1.0), at(0.0, 0.0, 0.5), near),
        ];
        let image = image(&mut session, &unlit(scene(panes), DVec3::Z), SIDE);
        let behind = |color: Vec4, behind: Vec4| color * color.w + behind * (1.0 - color.w);
        let expected = behind(near, behind(far, WHITE)).truncate().to_array().map(f64::from);
        assert!(miss(middle(&image), expected) < 0.01, "{:?}", middle(&image));
    }
}

#[test]
fn what_is_opaque_hides_and_is_seen_through_what_blends() {
    let mut session = common::session();
    // A white cube before, within and behind a ball of black glass, which has two layers; and one that sticks out of it.
    for (z, before_cube) in [(1.6, 0), (0.0, 1), (-1.6, 2), (0.9, 0)] {
        let objects = vec![
            ("cube", primitives::cube(0.5), at(0.0, 0.0, z), WHITE),
            ("ball", primitives::sphere(1.0, 24, 48), DMat4::IDENTITY, BLACK_GLASS),
        ];
        let image = image(&mut session, &unlit(scene(objects), DVec3::Z), SIDE);
        assert!(
            miss(middle(&image), [0.5_f64.powi(before_cube); 3]) < 0.01,
            "cube at {z}: {:?}",
            middle(&image)
        );
        // Beside the cube, within the ball.
        let beside = *image.get_pixel(SIDE / 2 + SIDE * 20 / 96, SIDE / 2);
        assert!(miss(beside, [0.25; 3]) < 0.01, "{beside:?}");
    }
}

#[test]
fn the_order_of_objects_changes_no_pixel() {
    let mut session = common::session();
    let turn = DMat4::from_quat(DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.3, 0.1));
    let objects: Vec<Object> = vec![
        ("cube", primitives::cube(1.2), turn, vec4(0.9, 0.2, 0.1, 0.4)),
        ("ring", primitives::torus(0.8, 0.25, 32, 16), turn, vec4(0.1, 0.5, 0.9, 0.3)),
        ("ball", primitives::sphere(0.7, 24, 36), DMat4::IDENTITY, vec4(0.2, 0.8, 0.2, 0.6)),
        ("core", primitives::cube(0.5), turn, vec4(0.3, 0.3, 0.3, 1.0)),
        ("wall", primitives::plane(2.4), DMat4::from_rotation_y(0.5), vec4(0.8, 0.7, 0.1, 0.5)),
    ];
    let mut first = None;
    for order in [[0, 1, 2, 3, 4], [4, 3, 2, 1, 0], [2, 0, 4, 1, 3]] {
        let shuffled = order.map(|i: usize| objects[i].clone());
        let drawn = image(&mut session, &unlit(scene(shuffled.into()), DVec3::new(0.3, 0.2, 1.0)), SIDE);
        let first = first.get_or_insert_with(|| drawn.clone());
        assert!(*first == drawn, "{order:?}: by up to {}", greatest_difference(first, &drawn));
    }
}

/// A ball and a square in all that a technique may look at: texture coordinates, a light that throws shadows.
fn lit(technique: &str, opacity: f32) -> Opened {
    let color = |r: f32| vec4(r, 0.5, 0.3, opacity);
    let objects = vec![
        ("floor", primitives::cube_split(2.0), at(0.0, -1.6, 0.0), vec4(0.8, 0.8, 0.8, 1.0)),
        ("ball", primitives::sphere(0.8, 24, 36), at(0.0, 0.2, 0.0), color(0.9)),
        ("square", primitives::plane(0.8), at(0.3, 0.9, 0.9), color(0.4)),
    ];
    let mut scene = scene(objects);
    for material in &mut scene.materials[1..] {
        material.alpha = AlphaMode::Blend;
    }
    let mut opened = unlit(scene, DVec3::new(0.3, 0.5, 1.0));
    for (key, value) in [
        ("technique", technique),
        ("light.shadows", "true"),
        ("toon.smoothing", "cartoon_map"),
        ("halftone.mapping", "uv"),
        ("gooch.highlight", "0.5"),
    ] {
        set(&mut opened, key, value);
    }
    opened
}

#[test]
fn every_technique_shades_what_blends_as_what_does_not() {
    let mut session = common::session();
    for technique in Technique::VARIANTS {
        // All but opaque: a shade of 8 bits at most is left of what lies behind.
        let blended = image(&mut session, &lit(technique, 0.9985), SIDE);
        let opaque = image(&mut session, &lit(technique, 1.0), SIDE);
        // Where a toon's bands are smoothed, they are where one surface hides the other.
        let far = blended.pixels().zip(opaque.pixels()).filter(|(a, b)| apart(a, b) > 2).count();
        // Strokes of the floor in the ball's shadow end at the ball, and go on behind one that blends.
        let most = match *technique {
            "toon" => 20,
            "hatching" => 40,
            _ => 0,
        };
        assert!(far <= most, "{technique}: {far}");
        let glass = image(&mut session, &lit(technique, 0.4), SIDE);
        // Blueprints are drawings of lines and blank paper is paper, whatever the material.
        let expected = !["blank", "blueprint"].contains(technique);
        assert_eq!(greatest_difference(&glass, &opaque) > 20, expected, "{technique}");
    }
}

#[test]
fn blueprints_do_not_care_whether_materials_blend() {
    let mut session = common::session();
    let draw = |session: &mut Session, opacity| {
        let mut opened = lit("blueprint", opacity);
        set(&mut opened, "edges.profile.show", "true");
        image(session, &opened, SIDE)
    };
    let [thin, full] = [0.3, 1.0].map(|opacity| draw(&mut session, opacity));
    assert!(thin == full && thin.pixels().any(|p| p != thin.get_pixel(0, 0)));
}

/// A square whose image has as many columns as alphas are given.
fn striped(alphas: &[u8]) -> Scene {
    let mut scene = scene(vec![
        ("pane", primitives::plane(1.0), DMat4::IDENTITY, Vec4::new(0.0, 0.0, 0.0, 1.0)),
        ("around", primitives::plane(1.2), at(0.0, 0.0, -0.5), WHITE),
    ]);
    scene.textures.push(Arc::new(Texture {
        name: "stripes".to_owned(),
        width: alphas.len() as u32,
        height: 1,
        rgba: alphas.iter().flat_map(|alpha| [0, 0, 0, *alpha]).collect(),
    }));
    scene.materials[0].alpha = AlphaMode::Blend;
    scene.materials[0].base_color_texture = Some(TextureRef {
        texture: 0,
        transform: UvTransform::default(),
        wrap: [Wrap::Clamp; 2],
        nearest: true,
    });
    scene
}

#[test]
fn images_say_how_much_shows_through_and_nothing_is_drawn_where_all_does() {
    let mut session = common::session();
    let opened = unlit(striped(&[0, 64, 128, 255]), DVec3::Z);
    let drawn = image(&mut session, &opened, SIDE);
    for (i, alpha) in [0.0, 64.0 / 255.0, 128.0 / 255.0, 1.0].into_iter().enumerate() {
        // The square is 1 of the 1.2 that the picture shows, or less.
        let x = (0..SIDE).filter(|x| drawn.get_pixel(*x, SIDE / 2).0[0] == 0).min().unwrap();
        let stripe = (0..SIDE).filter(|x| drawn.get_pixel(*x, SIDE / 2).0[0] == 0).count() as u32;
        let p = *drawn.get_pixel(x + stripe / 2 - (3 - i as u32) * stripe, SIDE / 2);
        assert!(miss(p, [1.0 - alpha; 3]) < 0.01, "{alpha}: {p:?}");
    }
    // A click goes through where nothing is drawn.
    session.set_scene(&opened).unwrap();
    session.draw(&opened, [SIDE; 2], false).unwrap();
    for (x, expected) in [(SIDE / 4, 1), (SIDE * 3 / 5, 0), (SIDE * 3 / 4, 0)] {
        session.renderer().start_pick([x, SIDE / 2]).unwrap();
        session.renderer().gpu().wait().unwrap();
        assert_eq!(session.renderer().poll_pick().unwrap().node, Some(expected), "at {x}");
    }
}

#[test]
fn what_only_says_that_it_blends_is_drawn_as_opaque() {
    let mut session = common::session();
    let draw = |session: &mut Session, alpha, style: &str| {
        let mut scene = scene(vec![
            ("cube", primitives::cube_split(1.0), DMat4::from_rotation_y(0.4), vec4(0.5, 0.2, 0.1, 1.0)),
            ("ring", primitives::torus(0.8, 0.2, 32, 16), at(0.0, 0.2, 0.3), vec4(0.1, 0.5, 0.9, 1.0)),
        ]);
        for material in &mut scene.materials {
            material.alpha = alpha;
        }
        let mut opened = unlit(scene, DVec3::new(0.3, 0.2, 1.0));
        set(&mut opened, "edges.profile.show", style);
        set(&mut opened, "edges.inner.show", style);
        image(session, &opened, SIDE)
    };
    for lines in ["true", "false"] {
        assert!(draw(&mut session, AlphaMode::Blend, lines) == draw(&mut session, AlphaMode::Opaque, lines));
    }
}

#[test]
fn a_part_that_blends_shows_the_inside_of_its_own_object() {
    let mut session = common::session();
    // The cube's last side, +Z, is a window; its other sides are opaque red.
    let mut cube = primitives::cube_split(1.0);
    let window = cube.submeshes[0].index_count - 6;
    cube.submeshes[0].index_count = window;
    let mut part = cube.submeshes[0];
    (part.first_index, part.index_count, part.material) = (window, 6, 1);
    let mut scene = scene(vec![
        ("cube", cube, DMat4::IDENTITY, vec4(1.0, 0.0, 0.0, 1.0)),
        ("other", primitives::plane(0.1), at(0.0, 3.0, 0.0), vec4(0.0, 0.0, 1.0, 0.5)),
    ]);
    let mut mesh = Mesh::clone(&scene.meshes[0]);
    mesh.submeshes = vec![mesh.submeshes[0], part];
    mesh.submeshes[0].material = 0;
    scene.meshes[0] = Arc::new(mesh);
    scene.nodes.truncate(1);
    let opened = unlit(scene, DVec3::Z);
    let drawn = image(&mut session, &opened, SIDE);
    assert!(miss(middle(&drawn), [0.5, 0.0, 0.5]) < 0.01, "{:?}", middle(&drawn));
}

fn dark(image: &RgbaImage) -> usize {
    image.pixels().filter(|p| p.0.iter().take(3).all(|c| *c < 40)).count()
}

#[test]
fn lines_are_seen_through_glass_and_lie_over_what_is_behind_them() {
    let mut session = common::session();
    let draw = |session: &mut Session, z: f64, opacity: f32| {
        let objects = vec![
            ("cube", primitives::cube(0.8), DMat4::from_rotation_z(0.3), WHITE),
            ("pane", primitives::plane(2.0), at(0.0, 0.0, z), vec4(1.0, 0.0, 0.0, opacity)),
        ];
        let mut opened = unlit(scene(objects), DVec3::Z);
        set(&mut opened, "edges.profile.show", "true");
        set(&mut opened, "edges.profile.width", "32");
        // Wholly beyond the cube.
        set(&mut opened, "edges.alignment", "outward");
        set_for(&mut opened, 1, "edges.profile.show", "false");
        image(session, &opened, SIDE)
    };
    let alone = dark(&draw(&mut session, -1.0, 0.0));
    assert!(alone > 200);
    // Before the pane they stay black.
    assert_eq!(dark(&draw(&mut session, -1.0, 0.5)), alone);
    // Behind it they are as red as it is.
    let behind = draw(&mut session, 1.0, 0.5);
    assert_eq!(dark(&behind), 0);
    let tinted = behind.pixels().filter(|p| miss(**p, [0.5, 0.0, 0.0]) < 0.02).count();
    let alone = dark(&draw(&mut session, 1.0, 0.0));
    assert!(tinted * 100 >= alone * 98, "{tinted} of {alone}");
}

#[test]
fn the_lines_of_glass_are_drawn_once_and_seen_through_other_glass() {
    let mut session = common::session();
    let objects = vec![
        ("cube", primitives::cube(1.0), DMat4::IDENTITY, vec4(1.0, 1.0, 1.0, 0.3)),
        ("ball", primitives::sphere(1.2, 24, 36), DMat4::IDENTITY, vec4(1.0, 1.0, 1.0, 0.2)),
    ];
    let mut opened = unlit(scene(objects), DVec3::new(0.5, 0.4, 1.0));
    set(&mut opened, "edges.profile.width", "16");
    set(&mut opened, "edges.inner.width", "16");
    set_for(&mut opened, 0, "edges.profile.show", "true");
    set_for(&mut opened, 0, "edges.inner.show", "true");
    let ink = |image: &RgbaImage| image.pixels().filter(|p| p.0[0] < 250).count();
    // All twelve edges, those behind too; an opaque cube shows nine, of which the ball before it hides none.
    let glass = ink(&image(&mut session, &opened, SIDE));
    let mut scene = Arc::unwrap_or_clone(opened.scene);
    scene.materials[0].base_color.w = 1.0;
    opened.scene = Arc::new(scene);
    let opaque = ink(&image(&mut session, &opened, SIDE));
    let share = glass as f64 / opaque as f64;
    assert!((1.2..1.5).contains(&share), "{glass} and {opaque}");
}

#[test]
fn mirrors_show_what_blends_and_do_not_blend_themselves() {
    let mut session = common::session();
    let objects = vec![
        ("mirror", primitives::plane(4.0), DMat4::IDENTITY, vec4(1.0, 1.0, 1.0, 0.5)),
        ("pane", primitives::cube(0.8), at(-0.9, 0.2, 1.1), vec4(1.0, 0.0, 0.0, 0.5)),
        ("behind", primitives::plane(2.0), at(0.0, 0.0, -1.0), vec4(0.0, 0.0, 1.0, 1.0)),
    ];
    let mut opened = unlit(scene(objects), DVec3::new(0.6, 0.25, 1.0));
    set(&mut opened, "mirror.reflectivity", "1");
    let red = |image: &RgbaImage| {
        image.pixels().filter(|p| p.0[0] > p.0[1].saturating_add(60) && p.0[2] < 200).count()
    };
    let blue = |image: &RgbaImage| image.pixels().filter(|p| p.0[2] > p.0[0].saturating_add(60)).count();
    let without = image(&mut session, &opened, SIDE);
    let scene = Arc::clone(&opened.scene);
    opened.document.set_role(&scene, &[0], Role::Mirror, true);
    let with = image(&mut session, &opened, SIDE);
    assert!(blue(&without) > 300 && blue(&with) == 0, "{} and {}", blue(&without), blue(&with));
    assert!(red(&with) > red(&without) * 3 / 2, "{} and {}", red(&without), red(&with));
}

#[test]
fn glass_is_picked_and_throws_shadows_where_it_is_more_opaque_than_not() {
    let mut session = common::session();
    let objects = vec![
        ("cube", primitives::cube(0.6), DMat4::IDENTITY, WHITE),
        ("ball", primitives::sphere(1.0, 24, 32), DMat4::IDENTITY, BLACK_GLASS),
    ];
    let opened = unlit(scene(objects), DVec3::Z);
    session.set_scene(&opened).unwrap();
    session.draw(&opened, [64; 2], false).unwrap();
    session.renderer().start_pick([32, 32]).unwrap();
    session.renderer().gpu().wait().unwrap();
    assert_eq!(session.renderer().poll_pick().unwrap().node, Some(1));

    let shadow = |session: &mut Session, opacity: f32| {
        let objects = vec![
            ("floor", primitives::cube(2.0), at(0.0, -2.0, 0.0), WHITE),
            ("ball", primitives::sphere(0.4, 16, 24), at(0.0, 0.3, 0.0), vec4(1.0, 1.0, 1.0, opacity)),
        ];
        let mut opened = unlit(scene(objects), DVec3::new(0.1, 1.0, 0.6));
        set(&mut opened, "technique", "plain");
        set_for(&mut opened, 1, "technique", "blank");
        set(&mut opened, "light.shadows", "true");
        image(session, &opened, SIDE)
    };
    let [thin, dense] = [0.4, 0.6].map(|opacity| shadow(&mut session, opacity));
    assert!(greatest_difference(&thin, &dense) > 40, "{}", greatest_difference(&thin, &dense));
}

#[test]
fn no_pixel_changes_where_glass_is_not() {
    let mut session = common::session();
    let objects = |color| {
        vec![
            ("floor", primitives::cube(1.6), at(0.0, -1.0, 0.0), vec4(0.8, 0.6, 0.4, 1.0)),
            ("ring", primitives::torus(0.7, 0.2, 32, 16), at(0.1, 0.2, 0.2), vec4(0.3, 0.5, 0.8, 1.0)),
            ("glass", primitives::sphere(0.5, 24, 36), at(-0.2, 0.4, 0.3), color),
        ]
    };
    let of_glass = {
        let white = image(&mut session, &unlit(scene(objects(WHITE)), DVec3::new(0.3, 0.4, 1.0)), SIDE);
        let red = image(
            &mut session,
            &unlit(scene(objects(vec4(1.0, 0.0, 0.0, 1.0))), DVec3::new(0.3, 0.4, 1.0)),
            SIDE,
        );
        let is_glass = |x: u32, y: u32| white.get_pixel(x, y) != red.get_pixel(x, y);
        // Its far side is drawn too, which may reach a pixel that the near one does not.
        let is_near = |x: u32, y: u32| {
            (0..9).any(|i| {
                let (x, y) = ((x + i % 3).saturating_sub(1), (y + i / 3).saturating_sub(1));
                x < SIDE && y < SIDE && is_glass(x, y)
            })
        };
        (0..SIDE * SIDE).map(|i| is_near(i % SIDE, i / SIDE)).collect::<Vec<_>>()
    };
    assert!(of_glass.iter().filter(|is| **is).count() > 300);
    for technique in Technique::VARIANTS.iter().filter(|t| **t != "blueprint") {
        let draw = |session: &mut Session, color| {
            let mut opened = unlit(scene(objects(color)), DVec3::new(0.3, 0.4, 1.0));
            set(&mut opened, "technique", technique);
            set(&mut opened, "edges.profile.show", "true");
            set_for(&mut opened, 2, "technique", "unlit");
            set_for(&mut opened, 2, "edges.profile.show", "false");
            image(session, &opened, SIDE)
        };
        let a = draw(&mut session, vec4(1.0, 0.0, 0.0, 0.3));
        let b = draw(&mut session, vec4(0.0, 0.0, 1.0, 0.7));
        let differing = a.pixels().zip(b.pixels()).zip(&of_glass).filter(|((a, b), _)| a != b);
        let (inside, outside): (Vec<_>, Vec<_>) = differing.partition(|(_, is_inside)| **is_inside);
        assert!(inside.len() > 300 && outside.is_empty(), "{technique}: {} outside", outside.len());
    }
}
