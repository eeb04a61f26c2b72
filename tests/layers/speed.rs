//! Heavy (`make quality`): what lists of fragments save over peeling. Ratios within one run, as machines are noisy.

use std::time::Instant;

use glam::DMat4;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::render::{LayerMethod, Request};

use crate::common::{opened, scene, session, set};
use crate::{blueprint, way};

/// Five wrinkled balls, one in the other, of 100,000 triangles each: ten layers, of which nothing is drawn.
fn nested_balls() -> Opened {
    let objects = (0..5).map(|i| {
        let radius = 1.0 - 0.15 * i as f32;
        let mut ball = primitives::sphere(radius, 224, 224);
        for p in &mut ball.positions {
            let (t, u) = ((p.y / radius).clamp(-1.0, 1.0).acos(), p.z.atan2(p.x));
            *p *= 1.0 + 0.03 * (9.0 * t).sin() * (11.0 * u).cos();
        }
        ball.normals.clear();
        ("ball", ball, DMat4::IDENTITY, [0.8; 3])
    });
    let mut opened = blueprint(opened(&scene(objects.collect()), glam::DVec3::Z));
    for (key, value) in [
        ("blueprint.max_layers", "10"),
        ("blueprint.fill_opacity", "0"),
        ("edges.profile.show", "false"),
        ("edges.inner.show", "false"),
    ] {
        set(&mut opened, key, value);
    }
    opened
}

#[test]
#[ignore = "heavy: run it in release, by `make quality`"]
fn ten_layers_of_half_a_million_triangles_cost_far_less_from_lists() {
    let mut session = session();
    let mut opened = nested_balls();
    assert!(opened.scene.triangle_count() > 490_000);
    session.renderer().set_scene(&opened.scene, &[]).unwrap();
    let camera = opened.document.camera.unwrap();
    let mut times = [Vec::new(), Vec::new()];
    for frame in 0..9 {
        for (times, by) in times.iter_mut().zip(["peeling", "lists"]) {
            set(&mut opened, "view.layer_method", by);
            let camera = camera.orbited(glam::DVec3::Y, f64::from(frame), 0.0);
            let request = Request {
                document: &opened.document,
                camera: &camera,
                size: [1280, 720],
                transparent: false,
                selected: &[],
                samples: 1,
            };
            let began = Instant::now();
            session.renderer().render(&request).unwrap();
            session.renderer().gpu().wait().unwrap();
            // The first frames compile shaders and fault pages in.
            if frame > 1 {
                times.push(began.elapsed().as_secs_f64() * 1e3);
            }
            session.renderer().take_reports();
            assert_eq!(session.renderer().layer_reports().unwrap()[0].layers, 10);
            assert_eq!(way(&mut session) == LayerMethod::Lists, by == "lists");
        }
    }
    let [peeling, lists] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    println!(
        "10 layers of 500,000 triangles, 1280 × 720: peeling {peeling:.0} ms, lists {lists:.0} ms, × {:.2}",
        lists / peeling
    );
    assert!(lists < 0.6 * peeling, "twice the goal, which is 0.3");
}
