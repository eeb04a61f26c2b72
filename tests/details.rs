//! Lines within a surface: where its color or its relief changes suddenly, and nowhere else.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "what was measured is worth reading")]

mod common;

use std::sync::Arc;

use common::line_drawing::{edge_classes, line_drawing, only, set_width};
use common::{scene, session, texels};
use glam::{DMat4, DVec2, DVec3, Vec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{EdgeClass, primitives};
use hachure::scene::material::{TextureRef, UvTransform, Wrap};
use hachure::scene::{Camera, Scene, Texture};

const SIDE: u32 = 200;
const TEXELS: u32 = 256;

/// The image that `color` paints at (u, v).
fn painted(color: impl Fn(DVec2) -> [u8; 3]) -> Texture {
    let texel = |i: u32| (f64::from(i) + 0.5) / f64::from(TEXELS);
    let rgba = (0..TEXELS * TEXELS).flat_map(|i| {
        let [r, g, b] = color(DVec2::new(texel(i % TEXELS), texel(i / TEXELS)));
        [r, g, b, 255]
    });
    Texture { name: "painted".to_owned(), width: TEXELS, height: TEXELS, rgba: rgba.collect() }
}

/// A square with an image on it: its color, or its relief.
fn picture(image: Texture, is_relief: bool) -> Arc<Scene> {
    let mut square = primitives::plane(2.0);
    square.normals = vec![glam::Vec3::Z; 4];
    square.tangents = vec![glam::Vec4::new(1.0, 0.0, 0.0, -1.0); 4];
    let mut scene = scene(vec![("square", square, DMat4::IDENTITY, [1.0; 3])]);
    let changed = Arc::make_mut(&mut scene);
    changed.textures.push(Arc::new(image));
    let texture =
        TextureRef { texture: 0, transform: UvTransform::default(), wrap: [Wrap::Clamp; 2], nearest: false };
    let material = changed.materials.first_mut().unwrap();
    if is_relief {
        material.normal_texture = Some(texture);
    } else {
        material.base_color_texture = Some(texture);
    }
    scene
}

/// Drawn with lines of one class only, from in front at a distance at which the square fills this share of the height.
fn drawing(scene: &Arc<Scene>, class: EdgeClass, share: f64, turn: f64) -> Opened {
    let camera = Camera {
        position: DVec3::new(turn.sin(), 0.0, turn.cos()) * 2.0 / (share * 2.0 * 15_f64.to_radians().tan()),
        ..Camera::default()
    };
    let mut opened = line_drawing(scene, camera);
    only(&mut opened, &[class]);
    set_width(&mut opened, 2.0, SIDE);
    opened
}

/// Spines of a class, in pixels.
fn spines(session: &mut Session, opened: &Opened, class: EdgeClass) -> Vec<DVec2> {
    session.set_scene(opened).unwrap();
    let picture = session.draw(opened, [SIDE; 2], false).unwrap();
    let classes = edge_classes(session, &picture);
    let edge_map = common::captured(session, "edge map").unwrap();
    let offsets = texels::<[u32; 4]>(session, &edge_map);
    let offset = |texel: u32, shift: u32| f64::from(texel >> shift & 255) / 127.0 - 1.0;
    let found =
        classes.iter().zip(offsets).enumerate().filter(|(_, (found, _))| found.is_some_and(|f| f.0 == class));
    found
        .map(|(i, (_, texel))| {
            let (x, y) = (i as u32 % SIDE, i as u32 / SIDE);
            DVec2::new(f64::from(x) + 0.5 + offset(texel[0], 8), f64::from(y) + 0.5 + offset(texel[0], 0))
        })
        .collect()
}

/// Distance of a point in the picture from the middle of a square that fills a share of its height, with the square's
/// half side as the unit.
fn on_square(spine: DVec2, share: f64) -> DVec2 {
    (spine - f64::from(SIDE) * 0.5) / (f64::from(SIDE) * 0.5 * share)
}

#[test]
fn a_disc_on_a_texture_is_outlined_at_every_zoom_and_nothing_else_is() {
    let mut session = session();
    let disc = |at: DVec2| if (at - 0.5).length() < 0.3 { [40, 70, 160] } else { [230, 220, 200] };
    let scene = picture(painted(disc), false);
    // The image is reduced, then enlarged up to seven times.
    for share in [0.3, 0.9, 3.0, 8.0] {
        // Enlarged, the middle of the disc fills the picture: its right border is looked at.
        let mut opened = drawing(&scene, EdgeClass::Texture, share, 0.0);
        if share > 1.2 {
            let camera = opened.document.camera.as_mut().unwrap();
            camera.position.x += 0.6;
            camera.focal_point.x += 0.6;
        }
        let moved = if share > 1.2 { DVec2::X * 0.6 } else { DVec2::ZERO };
        let spines = spines(&mut session, &opened, EdgeClass::Texture);
        let pixel = 2.0 / (f64::from(SIDE) * share);
        let error = |spine: &DVec2| ((on_square(*spine, share) + moved).length() - 0.6).abs() / pixel;
        let worst = spines.iter().map(error).fold(0.0, f64::max);
        let mean = spines.iter().map(error).sum::<f64>() / spines.len() as f64;
        println!("disc, {share} of the height: {} px, error {mean:.3}, worst {worst:.3}", spines.len());
        let length = if share > 1.2 { f64::from(SIDE) } else { std::f64::consts::TAU * 0.6 / pixel };
        // A texel is many pixels wide when it is enlarged.
        let texel = 2.0 / f64::from(TEXELS) / pixel;
        assert!(spines.len() as f64 > 0.95 * length && (spines.len() as f64) < 3.0 * length * texel.max(1.0));
        assert!(worst < 0.8 + 0.8 * texel, "{worst}");
    }
}

#[test]
fn slopes_of_color_and_faint_steps_have_no_lines() {
    let mut session = session();
    let slope = picture(painted(|at| [(at.x * 255.0) as u8, (at.y * 255.0) as u8, 128]), false);
    let faint = picture(painted(|at| if at.x < 0.5 { [200; 3] } else { [215; 3] }), false);
    for (scene, turn) in [(&slope, 0.0), (&slope, 1.0), (&faint, 0.0)] {
        let opened = drawing(scene, EdgeClass::Texture, 0.9, turn);
        assert!(spines(&mut session, &opened, EdgeClass::Texture).is_empty());
    }
    let mut opened = drawing(&faint, EdgeClass::Texture, 0.9, 0.0);
    common::set(&mut opened, "edges.texture.threshold", "0.02");
    assert!(spines(&mut session, &opened, EdgeClass::Texture).len() > 150);
}

#[test]
fn a_checkerboard_is_drawn_in_perspective() {
    let mut session = session();
    let squares =
        |at: DVec2| if ((at.x * 8.0) as i32 + (at.y * 8.0) as i32) % 2 == 0 { [20; 3] } else { [240; 3] };
    let scene = picture(painted(squares), false);
    let opened = drawing(&scene, EdgeClass::Texture, 0.9, 1.0);
    let spines = spines(&mut session, &opened, EdgeClass::Texture);
    // Every spine lies on a line of the board.
    let view = hachure::render::View::new(
        &opened.document.camera.unwrap(),
        &opened.scene.bounds(),
        glam::UVec2::splat(SIDE),
    );
    let (mut off, mut worst) = (0, 0.0_f64);
    for spine in &spines {
        let eye = opened.document.camera.unwrap().position;
        let through = view.unproject(spine.as_vec2(), 1.0) - eye;
        let hit = eye - through * (eye.z / through.z);
        let miss = [hit.x, hit.y].map(|c| (c * 4.0 - (c * 4.0).round()).abs() / 4.0);
        // In pixels: a unit is so many of them there.
        let scale = view.projector().pixel(view.view_from_world.transform_point3(hit + DVec3::Y * 0.01));
        let pixels =
            (scale - view.projector().pixel(view.view_from_world.transform_point3(hit))).length() * 100.0;
        let miss = miss[0].min(miss[1]) * pixels;
        worst = worst.max(miss);
        off += u32::from(miss > 1.0);
    }
    println!("checkerboard: {} px, {off} off, worst {worst:.2}", spines.len());
    // Where four squares meet, the directions of two lines mix.
    assert!(spines.len() > 1500 && f64::from(off) < 0.03 * spines.len() as f64 && worst < 3.0);
}

#[test]
fn a_relief_that_folds_has_lines_only_when_asked_for() {
    let mut session = session();
    // A ridge along the middle: both sides lean by 30°.
    let side = |at: DVec2| {
        let lean = 30_f64.to_radians();
        let normal = DVec3::new(if at.x < 0.5 { -lean.sin() } else { lean.sin() }, 0.0, lean.cos());
        ((normal * 0.5 + 0.5) * 255.0).round().to_array().map(|c| c as u8)
    };
    let scene = picture(painted(side), true);
    let opened = drawing(&scene, EdgeClass::Relief, 0.9, 0.2);
    let found = spines(&mut session, &opened, EdgeClass::Relief);
    assert!(found.len() > 150, "{}", found.len());
    assert!(found.iter().all(|at| (at.x - f64::from(SIDE) * 0.5).abs() < 1.0));
    let mut steeper = opened.clone();
    common::set(&mut steeper, "edges.relief.threshold", "70");
    assert!(spines(&mut session, &steeper, EdgeClass::Relief).is_empty());
    let default = line_drawing(&scene, opened.document.camera.unwrap());
    assert!(spines(&mut session, &default, EdgeClass::Relief).is_empty());
}

#[test]
fn without_a_normal_map_there_is_no_relief() {
    let columns = [-1.0_f32, -0.02, 0.02, 1.0];
    let positions =
        columns.iter().flat_map(|x| [Vec3::new(*x, -1.0, 0.0), Vec3::new(*x, 1.0, 0.0)]).collect();
    let indices = [0, 2, 4].iter().flat_map(|i| [*i, i + 2, i + 3, *i, i + 3, i + 1]).collect();
    let mut square = primitives::from_triangles(positions, indices);
    // Shaded as if it had a fold of 60°.
    let normal = |x: &f32| Vec3::new(x.signum() * 0.5, 0.0, 0.75_f32.sqrt());
    square.normals = columns.iter().flat_map(|x| [normal(x); 2]).collect();
    let scene = scene(vec![("square", square, DMat4::IDENTITY, [1.0; 3])]);
    let opened = drawing(&scene, EdgeClass::Relief, 0.9, 0.2);
    let mut session = session();
    let picture = common::draw(&mut session, &opened, SIDE);
    assert!(edge_classes(&mut session, &picture).iter().all(Option::is_none));
}

#[test]
fn the_border_of_a_cast_shadow_is_one_smooth_line_and_the_terminator_has_none() {
    let mut session = session();
    let lying = DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    // The light stands straight above: the ball's shadow is a circle of its own radius below it.
    let scene = scene(vec![
        ("floor", primitives::plane(4.0), lying, [0.8; 3]),
        ("ball", primitives::sphere(0.6, 64, 96), DMat4::from_translation(DVec3::Y * 1.5), [0.8; 3]),
    ]);
    let camera = Camera { position: DVec3::new(0.0, 2.0, 7.0), ..Camera::default() };
    let mut opened = line_drawing(&scene, camera);
    only(&mut opened, &[EdgeClass::Shadow]);
    for (key, value) in [
        ("light.key.attached", "world"),
        ("light.key.azimuth", "0"),
        ("light.key.elevation", "90"),
        ("light.shadow_softness", "0"),
    ] {
        common::set(&mut opened, key, value);
    }
    assert!(spines(&mut session, &opened, EdgeClass::Shadow).is_empty());
    common::set(&mut opened, "light.shadows", "true");
    let found = spines(&mut session, &opened, EdgeClass::Shadow);
    let view = hachure::render::View::new(&camera, &opened.scene.bounds(), glam::UVec2::splat(SIDE));
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for spine in &found {
        let through = view.unproject(spine.as_vec2(), 1.0) - camera.position;
        let hit = camera.position - through * (camera.position.y / through.y);
        let radius = hit.length();
        // From the distance on the floor to pixels of the picture.
        let project = |p: DVec3| view.projector().pixel(view.view_from_world.transform_point3(p));
        let miss = project(hit).distance(project(hit * (0.6 / radius)));
        worst = worst.max(miss);
        sum += miss;
    }
    let mean = sum / found.len() as f64;
    println!("border of a shadow: {} px, error {mean:.3}, worst {worst:.3}", found.len());
    assert!(found.len() > 60 && mean < 0.4 && worst < 1.2);
}
