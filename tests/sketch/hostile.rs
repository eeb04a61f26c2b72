//! What is not meant to be drawn.

use std::path::PathBuf;

use glam::{DMat4, DVec3, Vec3};
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, primitives};
use hachure::style::sketch::{Anchor, MAX_OFFSET, MAX_PASSES, Tooth};
use hachure::style::{Matrix, Style};

use super::common::{self, set};
use super::{at, drawn, seen_from, set_style, sketched, style, turned};

const SIDE: u32 = 96;

fn one(mesh: Mesh, place: DMat4, style: &Style) -> Opened {
    let scene = common::scene(vec![("thing", mesh, place, [0.8, 0.5, 0.3])]);
    let mut opened = common::opened(&scene, DVec3::Z);
    opened.document.camera = Some(seen_from(DVec3::new(0.5, 0.8, 4.0), DVec3::ZERO));
    set_style(&mut opened, 0, style);
    opened
}

fn with_matrix(numbers: [f32; 4]) -> Style {
    let mut style = sketched(style("gooch"), 4.0, 4.0);
    style.sketch.pass[0].matrix = Matrix::of_numbers(numbers);
    style.sketch.fill.matrix = Matrix::of_numbers(numbers);
    style
}

#[test]
fn numbers_that_are_none_or_too_great_are_held_back() {
    let mut session = common::session();
    let mut picture = |style: &Style| {
        let opened = one(primitives::cube(1.2), DMat4::IDENTITY, style);
        session.set_scene(&opened).unwrap();
        drawn(&mut session, &opened, SIDE, |_| true)
    };
    const MOST: f32 = MAX_OFFSET;
    let rows = [
        ([f32::NAN; 4], [0.0; 4]),
        ([f32::INFINITY, 0.0, 0.0, f32::NEG_INFINITY], [MOST, 0.0, 0.0, -MOST]),
        ([1e30, 2.0, f32::NAN, -1e30], [MOST, 2.0, 0.0, -MOST]),
        ([f32::MIN_POSITIVE, -0.0, 1e-40, 0.0], [0.0; 4]),
    ];
    for (wild, sane) in rows {
        // At this size, so that pixels are as large as reference pixels are not: what is held back is what is drawn.
        let mut styles = [with_matrix(wild), with_matrix(sane)];
        styles.iter_mut().for_each(|style| style.sketch.wander.pressure = 0.2);
        let [wild_picture, sane_picture] = styles.map(|style| picture(&style));
        assert!(wild_picture == sane_picture, "{wild:?} as {sane:?}");
    }
    let sane = with_matrix([4.0, 0.0, 0.0, 4.0]);
    for wild in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30] {
        let mut style = sane.clone();
        let sketch = &mut style.sketch;
        let (wander, fill, grain) = (&mut sketch.wander, &mut sketch.fill, &mut sketch.grain);
        for number in [&mut wander.amount, &mut wander.wave, &mut wander.detail, &mut wander.pressure] {
            *number = wild;
        }
        for number in [
            &mut fill.wave,
            &mut fill.opacity,
            &mut fill.object_color,
            &mut fill.stroke_width,
            &mut fill.angle,
        ] {
            *number = wild;
        }
        (fill.strokes, grain.amount) = (wild, wild);
        (grain.soft, grain.size, grain.roughness, grain.smudge) = (wild, wild, wild, wild);
        for pass in &mut sketch.pass {
            (pass.relative_width, pass.opacity) = (wild, wild);
        }
        picture(&style);
    }
}

#[test]
fn a_paper_that_is_missing_is_said_and_the_generated_one_is_used() {
    let mut session = common::session();
    let mut style = sketched(style("gooch"), 4.0, 4.0);
    (style.sketch.grain.amount, style.sketch.fill.opacity) = (0.8, 0.6);
    let mut missing = style.clone();
    missing.sketch.grain.texture = Tooth::Image;
    missing.sketch.grain.image = Some(PathBuf::from("no/such/paper.png"));
    let [generated, missing_picture] = [&style, &missing].map(|style| {
        let opened = one(primitives::cube(1.2), DMat4::IDENTITY, style);
        session.set_scene(&opened).unwrap();
        drawn(&mut session, &opened, SIDE, |_| true)
    });
    assert!(generated == missing_picture);
    let folder = tempfile::tempdir().unwrap();
    let model = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/models/crank.glb");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_hachure"))
        .args(["render", "--resolution", "32,32", "-o", "out.png"])
        .args(["--set", "sketch.enabled=true", "--set", "sketch.grain.amount=0.5"])
        .args(["--set", "sketch.grain.texture=image", "--set", "sketch.grain.image=missing.png"])
        .arg(model)
        .env_remove("HACHURE_SHADERS")
        .current_dir(folder.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(
        said.contains("warning: sketch.grain.image: ") && said.contains("cannot read missing.png"),
        "{said}"
    );
}

#[test]
fn pictures_and_objects_of_any_size_are_drawn() {
    let mut session = common::session();
    let mut rich = sketched(style("gooch"), 20.0, 30.0);
    rich.sketch.passes = MAX_PASSES as u32;
    (rich.sketch.grain.amount, rich.sketch.grain.roughness, rich.sketch.grain.smudge) = (0.5, 2.0, 0.5);
    (rich.sketch.fill.strokes, rich.sketch.wander.pressure) = (0.5, 0.4);
    let mut bare = rich.clone();
    (bare.edges.profile.show, bare.edges.inner.show) = (false, false);
    let mut by_paper = rich.clone();
    by_paper.edges.mode = "image_space".parse().unwrap();
    let triangle = primitives::from_triangles(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![0, 1, 2]);
    let empty = primitives::from_triangles(vec![], vec![]);
    let point = primitives::from_triangles(vec![Vec3::ZERO; 3], vec![0, 1, 2]);
    let cube = || primitives::cube(1.2);
    let beside_eye = at(0.5, 0.8, 3.8);
    let around_eye = at(0.5, 0.8, 4.0) * DMat4::from_scale(DVec3::splat(3.0));
    let outside = at(30.0, 0.0, 0.0);
    let rows = [
        ("cube", cube(), DMat4::IDENTITY, true),
        ("triangle", triangle, DMat4::IDENTITY, true),
        ("empty", empty, DMat4::IDENTITY, false),
        ("point", point, DMat4::IDENTITY, false),
        ("partly behind the eye", cube(), beside_eye, true),
        ("around the eye", cube(), around_eye, true),
        ("outside", cube(), outside, false),
        ("flat", cube(), DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)), true),
    ];
    for (name, mesh, place, is_seen) in &rows {
        for (kind, look) in [("rich", &rich), ("bare", &bare), ("paper", &by_paper)] {
            for anchor in [Anchor::Surface, Anchor::Screen, Anchor::Depth] {
                let mut look = look.clone();
                look.sketch.wander.anchor = anchor;
                let opened = one(mesh.clone(), *place, &look);
                session.set_scene(&opened).unwrap();
                let picture = drawn(&mut session, &opened, SIDE, |_| true);
                let paper = *drawn(&mut session, &opened, 4, |_| false).get_pixel(0, 0);
                let inked = picture.pixels().filter(|p| **p != paper).count();
                assert_eq!(inked > 0, *is_seen, "{name}, {kind}, {anchor:?}: {inked} pixels");
                for size in [[1, 1], [3, 1], [1, 50]] {
                    session.image(&opened, size, false).unwrap();
                }
            }
        }
    }
}

#[test]
fn a_small_thing_without_edges_is_drawn_by_its_color() {
    let mut session = common::session();
    let mut look = sketched(style("unlit"), 4.0, 4.0);
    look.sketch.pass[0].matrix = turned(30.0);
    let mut opened = one(primitives::cube(0.02), DMat4::IDENTITY, &look);
    set(&mut opened, "edges.profile.show", "false");
    session.set_scene(&opened).unwrap();
    let [nothing, thing] = [false, true].map(|shown| drawn(&mut session, &opened, SIDE, |_| shown));
    assert_ne!(nothing, thing);
}
