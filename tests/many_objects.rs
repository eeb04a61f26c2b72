//! Scenes of many objects: that what is hidden may be left out changes no picture; and, heavy (`make quality`), how much dearer
//! many styles are than one. Ratios of frames drawn beside each other hold on noisy machines too.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the numbers are what it is for")]

mod common;

use std::sync::Arc;
use std::time::Instant;

use common::{draw, median, opened, scene, session, surfels};
use glam::{DMat4, DVec3, Vec3};
use hachure::document::Document;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, primitives};
use hachure::render::Request;
use hachure::scene::{Camera, Scene};
use hachure::style::toon::Smoothing;
use hachure::style::{Color, Style, Technique, Value, param};
use strum::VariantNames as _;

const COLUMNS: usize = 50;
const OBJECTS: usize = 2000;
const STYLES: usize = 20;
const FRAMES: u32 = 16;

/// 2,000 objects of about 200 triangles each, each with a mesh of its own.
fn many() -> Arc<Scene> {
    let names: Vec<String> = (0..OBJECTS).map(|i| format!("part.{i}")).collect();
    let objects = names.iter().enumerate().map(|(i, name)| {
        let mesh =
            if i % 2 == 0 { primitives::sphere(0.45, 8, 14) } else { primitives::torus(0.33, 0.12, 14, 7) };
        let (x, z) = ((i % COLUMNS) as f64, (i / COLUMNS) as f64);
        let place = DMat4::from_translation(DVec3::new(x, 0.3 * (x + z).sin(), z));
        (name.as_str(), mesh, place, [0.8, 0.6 - 0.2 * (i % 3) as f32, 0.4])
    });
    scene(objects.collect())
}

/// Twenty looks of surfaces, of every technique that shades them; with `lines` also of as many colors and widths.
fn styles(lines: bool) -> Vec<Style> {
    // Blueprints are not shaded, but split into layers, each group by itself.
    let techniques: Vec<_> =
        Technique::VARIANTS.iter().filter(|name| **name != <&str>::from(Technique::Blueprint)).collect();
    let style = |i: usize| {
        let shade = |by: usize| Color([(60 + 9 * i) as u8, (40 * by) as u8, (200 - 7 * i) as u8]);
        let mut style = Style::default();
        let technique = *techniques[i % techniques.len()];
        param::set(&mut style.params(), "technique", &Value::from(technique)).unwrap();
        style.plain.ambient = 0.1 + 0.02 * i as f32;
        (style.gooch.cool, style.gooch.alpha) = (shade(1), 0.2 + 0.02 * i as f32);
        (style.toon.light, style.toon.bands) = (shade(5), 2 + i as u32 / 5);
        style.toon.smoothing = [Smoothing::Nearest, Smoothing::CartoonMap, Smoothing::Analytic][i / 5 % 3];
        if lines {
            (style.edges.profile.color, style.edges.profile.width) = (shade(3), 1.0 + 0.2 * i as f32);
            (style.edges.inner.color, style.edges.inner.width) = (shade(2), 0.5 + 0.1 * i as f32);
        }
        style
    };
    (0..STYLES).map(style).collect()
}

/// The scene in these styles by turns.
fn dressed(document: &Document, scene: &Scene, styles: &[Style]) -> Document {
    let mut document = document.clone();
    for (node, style) in scene.nodes.iter().zip(styles.iter().cycle()) {
        document.node_mut(&node.path).style = Some(style.clone());
    }
    document
}

/// Milliseconds until the frame is recorded, and until it is drawn.
fn frame(session: &mut Session, document: &Document, camera: &Camera) -> [f64; 2] {
    let began = Instant::now();
    let request = Request { document, camera, size: [800; 2], transparent: false, selected: &[], samples: 1 };
    session.renderer().render(&request).unwrap();
    let recorded = began.elapsed().as_secs_f64();
    session.renderer().gpu().wait().unwrap();
    [recorded * 1e3, began.elapsed().as_secs_f64() * 1e3]
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn twenty_styles_cost_little_more_than_one() {
    let scene = many();
    let Opened { document, .. } = opened(&scene, DVec3::new(0.4, 0.8, 1.0));
    let camera = document.camera.unwrap().framing(&scene.extent(), 1.0);
    // Lines that differ much in width are looked for twice, whether in one style or in twenty.
    let mut thin_and_wide = document.clone();
    (thin_and_wide.style.edges.profile.width, thin_and_wide.style.edges.inner.width) = (4.8, 0.5);
    let documents = [
        ("one style", document.clone()),
        ("20 surface styles", dressed(&document, &scene, &styles(false))),
        ("one style, thin and wide lines", thin_and_wide),
        ("20 styles of surfaces and lines", dressed(&document, &scene, &styles(true))),
    ];
    let mut session = session();
    session.set_scene(&Opened { document: document.clone(), scene: Arc::clone(&scene) }).unwrap();
    let mut times = vec![Vec::new(); documents.len()];
    // By turns, so that a slow moment of the machine hits all alike.
    for turn in 0..FRAMES + 2 {
        for (i, ((_, document), times)) in documents.iter().zip(&mut times).enumerate() {
            // Every frame from a direction of its own, so that all of it is drawn anew.
            let camera = camera.orbited(DVec3::Y, f64::from(turn) * 2.0 + i as f64 * 0.01, 0.0);
            let ms = frame(&mut session, document, &camera);
            if turn >= 2 {
                times.push(ms);
            }
        }
    }
    let ratio_to =
        |a: &[[f64; 2]], b: &[[f64; 2]]| median(a.iter().zip(b).map(|(a, b)| a[1] / b[1]).collect());
    let triangles = scene.triangle_count();
    println!("{OBJECTS} objects, {triangles} triangles, 800 × 800, median of {FRAMES} frames:");
    println!("  {:<34}{:>12}{:>9}{:>9}", "", "recorded ms", "ms", "× one");
    for ((name, _), all) in documents.iter().zip(&times) {
        let [recorded, drawn] = [0, 1].map(|i| median(all.iter().map(|ms| ms[i]).collect()));
        println!("  {name:<34}{recorded:>12.1}{drawn:>9.1}{:>9.2}", ratio_to(all, &times[0]));
    }
    for [one, twenty] in [[0, 1], [2, 3]] {
        let ratio = ratio_to(&times[twenty], &times[one]);
        println!("  {}: × {ratio:.2} of {}", documents[twenty].0, documents[one].0);
        assert!(ratio <= 1.3);
    }
}

/// Boxes at these places, with edges of these lengths.
fn boxes(placed: &[(Vec3, Vec3)]) -> Mesh {
    let cube = primitives::cube(1.0);
    let positions = placed.iter().flat_map(|(at, size)| cube.positions.iter().map(|p| *at + *size * *p));
    let corners = cube.positions.len() as u32;
    let indices = (0..placed.len() as u32).flat_map(|i| cube.indices.iter().map(move |c| c + i * corners));
    primitives::from_triangles(positions.collect(), indices.collect())
}

/// Walls with gaps between them, and small boxes before, behind and inside them.
fn clutter() -> Vec<(Vec3, Vec3)> {
    let walls = (0..4).map(|i| (Vec3::new(2.1 * i as f32 - 3.15, 1.5, 0.0), Vec3::new(2.0, 3.0, 0.3)));
    let small = (0..400).map(|i: u32| {
        // Spread evenly (Roberts 2018).
        let share = |step: f32| (0.5 + step * i as f32).fract();
        let at = Vec3::new(9.0 * share(0.8192) - 4.5, 3.4 * share(0.6711), 4.0 * share(0.5498) - 2.0);
        (at, Vec3::splat(0.05 + 0.2 * share(0.4503)))
    });
    walls.chain(small).collect()
}

#[test]
fn what_is_hidden_is_left_out_and_nothing_else() {
    let placed = clutter();
    let names: Vec<String> = (0..placed.len()).map(|i| format!("box.{i}")).collect();
    let each = names.iter().zip(&placed);
    let many = scene(
        each.map(|(name, placed)| {
            (name.as_str(), boxes(std::slice::from_ref(placed)), DMat4::IDENTITY, [1.0; 3])
        })
        .collect(),
    );
    // A single object is drawn whole.
    let one = scene(vec![("boxes", boxes(&placed), DMat4::IDENTITY, [1.0; 3])]);
    let [mut session_of_many, mut session_of_one] = [session(), session()];
    let start = Camera::looking_from(DVec3::new(0.1, 0.2, 1.0), DVec3::Y, &many.extent(), 1.0);
    for turn in 0..12 {
        let camera = start.orbited(DVec3::Y, 30.0 * f64::from(turn), 5.0 * f64::from(turn));
        // From amid the boxes too.
        let away = start.focal_point - camera.position;
        let amid = Camera { position: start.focal_point, focal_point: start.focal_point + away, ..camera };
        for camera in [camera, camera.with_orthographic(true), amid] {
            let depths =
                [(&mut session_of_many, &many), (&mut session_of_one, &one)].map(|(session, scene)| {
                    let mut opened = opened(scene, DVec3::Z);
                    opened.document.camera = Some(camera);
                    session.renderer().capture("geometry");
                    let picture = draw(session, &opened, 150);
                    let surfels = surfels(session, &picture);
                    surfels
                        .iter()
                        .map(|s| if s.object == 0 { 0 } else { s.depth.to_bits() })
                        .collect::<Vec<_>>()
                });
            assert!(depths[0].iter().any(|depth| *depth != 0), "turn {turn}: nothing is seen");
            let lost = depths[0].iter().zip(&depths[1]).filter(|(many, one)| many != one).count();
            assert_eq!(lost, 0, "turn {turn}: pixels that differ");
        }
    }
}
