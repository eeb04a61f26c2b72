//! The section plane: what is cut open looks as if it had been modeled so.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use common::{Object, image, scene, session, set, surfels};
use glam::{DMat4, DVec3, Vec3};
use hachure::document::{Document, Role};
use hachure::export::session::Opened;
use hachure::geometry::{Bounds, Mesh, primitives};
use hachure::scene::{Camera, Scene};
use image::RgbaImage;

const SIDE: u32 = 160;
const RED: [f32; 3] = [0.8, 0.1, 0.05];
const GRAY: [f32; 3] = [0.5; 3];

fn colored(name: &'static str, mesh: Mesh, color: [f32; 3]) -> Object {
    (name, mesh, DMat4::IDENTITY, color)
}

fn view(objects: Vec<Object>, towards_eye: DVec3, parallel: bool) -> Opened {
    let scene = scene(objects);
    let corners = Bounds { min: DVec3::splat(-2.0), max: DVec3::splat(2.0) }.corners();
    let up = if towards_eye.x == 0.0 && towards_eye.z == 0.0 { DVec3::NEG_Z } else { DVec3::Y };
    let camera = Camera::looking_from(towards_eye, up, &corners, 1.0).with_orthographic(parallel);
    Opened { document: Document { camera: Some(camera), ..Document::default() }, scene }
}

fn set_all(opened: &mut Opened, settings: &[(&str, &str)]) {
    for (key, value) in settings {
        set(opened, key, value);
    }
}

/// A cube from −1 to 1, as far as it is below a height.
fn cube_below(height: f32) -> Mesh {
    let mut mesh = primitives::cube(2.0);
    mesh.positions.iter_mut().for_each(|p| p.y = p.y.min(height));
    mesh
}

/// How many pixels differ clearly in any channel.
fn differing(a: &RgbaImage, b: &RgbaImage) -> usize {
    let differs =
        |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 12);
    a.pixels().zip(b.pixels()).filter(|pair| differs(*pair)).count()
}

/// All lines alike, so that it does not matter what a line is called.
const ALIKE: [(&str, &str); 5] = [
    ("edges.profile.width", "2"),
    ("edges.inner.width", "2"),
    ("edges.section.width", "inherit"),
    ("edges.inner.color", "#000000"),
    ("edges.profile.color", "#000000"),
];

#[test]
fn a_cut_cube_looks_like_half_a_cube() {
    let mut session = session();
    let floor = || {
        let mut mesh = primitives::plane(4.0);
        mesh.positions.iter_mut().for_each(|p| *p = Vec3::new(p.x, -1.2, p.y));
        colored("floor", mesh, GRAY)
    };
    let glass = || {
        let mut mesh = primitives::plane(2.0);
        mesh.positions.iter_mut().for_each(|p| *p = Vec3::new(p.x, 0.6 * p.y - 0.5, -1.9));
        colored("glass", mesh, GRAY)
    };
    let techniques = [("plain", "off"), ("gooch", "on"), ("toon", "on"), ("halftone", "off")];
    for (technique, shadows) in techniques {
        for (eye, parallel) in [(DVec3::new(1.0, 1.4, 2.0), false), (DVec3::new(-2.0, -0.4, 1.0), true)] {
            let [cut, modeled] = [primitives::cube(2.0), cube_below(0.3)].map(|mesh| {
                let mut opened = view(vec![colored("cube", mesh, RED), floor(), glass()], eye, parallel);
                set_all(&mut opened, &ALIKE);
                set_all(
                    &mut opened,
                    &[
                        ("technique", technique),
                        ("halftone.space", "screen"),
                        ("light.shadows", shadows),
                        ("mirror.reflectivity", "1"),
                    ],
                );
                let scene = Arc::clone(&opened.scene);
                opened.document.set_role(&scene, &[2], Role::Mirror, true);
                opened
            });
            let mut cut = cut;
            let own = hachure::style::Color(RED.map(hachure::style::color::srgb_from_linear));
            set_all(
                &mut cut,
                &[
                    ("section.show", "true"),
                    ("section.position", "0.3"),
                    ("section.cap", "plain"),
                    ("section.lit", "true"),
                    ("section.color", &own.to_string()),
                ],
            );
            let (one, other) = (image(&mut session, &cut, SIDE), image(&mut session, &modeled, SIDE));
            let differing = differing(&one, &other);
            assert!(differing <= 40, "{technique} from {eye}: {differing} pixels differ");
            set(&mut cut, "section.show", "false");
            let whole = image(&mut session, &cut, SIDE);
            assert!(self::differing(&whole, &other) > 1000, "{technique}: the section does nothing");
        }
    }
}

/// Objects with a plane at y = `height`, seen in parallel projection from straight above.
fn plan(objects: Vec<Object>, height: &str) -> Opened {
    let mut opened = view(objects, DVec3::Y, true);
    set_all(&mut opened, &[("section.show", "true"), ("section.position", height)]);
    opened
}

#[test]
fn a_capped_solid_shows_no_inside_and_is_picked_by_its_cap() {
    let mut session = session();
    let mut opened = plan(vec![colored("ball", primitives::sphere(1.5, 24, 48), RED)], "0.2");
    let picture = common::draw(&mut session, &opened, SIDE);
    let capped = surfels(&mut session, &picture);
    // All that is within the cut lies in its plane.
    let shown: Vec<_> = capped.iter().filter(|s| s.object == 1).collect();
    let depth = shown.iter().map(|s| s.depth).fold(f32::INFINITY, f32::min);
    let (flat, rim): (Vec<&common::Surfel>, Vec<_>) =
        shown.iter().partition(|s| (s.depth - depth).abs() < 1e-3);
    let pixel = 2.0 * half_height(&opened) / f64::from(SIDE);
    let radius2 = 1.5 * 1.5 - 0.2 * 0.2;
    let area = flat.len() as f64 * pixel * pixel;
    assert!((area / (std::f64::consts::PI * radius2) - 1.0).abs() < 0.02, "{area}");
    assert!(flat.iter().all(|s| s.face_normal.z > 0.999) && rim.iter().all(|s| s.depth > depth));
    // Without a cap one looks into it.
    set(&mut opened, "section.cap", "none");
    let picture = common::draw(&mut session, &opened, SIDE);
    let deepest =
        surfels(&mut session, &picture).iter().filter(|s| s.object == 1).map(|s| s.depth).fold(0.0, f32::max);
    assert!((deepest - depth - 1.7).abs() < 0.01, "{deepest} {depth}");
}

fn half_height(opened: &Opened) -> f64 {
    match opened.document.camera.unwrap().projection {
        hachure::scene::Projection::Orthographic { view_height } => 0.5 * view_height,
        hachure::scene::Projection::Perspective { .. } => panic!("no parallel projection"),
    }
}

#[test]
fn flip_leaves_what_was_cut_away() {
    let mut session = session();
    let torus = || vec![colored("torus", primitives::torus(1.0, 0.4, 48, 24), RED)];
    let mut opened = view(torus(), DVec3::new(0.2, 0.3, 1.0), true);
    let mut covered = |settings: &[(&str, &str)]| -> Vec<bool> {
        set_all(&mut opened, settings);
        let picture = common::draw(&mut session, &opened, SIDE);
        surfels(&mut session, &picture).iter().map(|s| s.object == 1).collect()
    };
    let whole = covered(&[("section.axis", "x"), ("section.position", "0.25")]);
    let kept = covered(&[("section.show", "true")]);
    let rest = covered(&[("section.flip", "true")]);
    let seen = |i: usize| kept[i] || rest[i];
    assert!((0..whole.len()).all(|i| whole[i] == seen(i)));
    let count = |pixels: &[bool]| pixels.iter().filter(|p| **p).count();
    assert!(count(&kept) > count(&rest) && count(&rest) > 500);
    // Both show the cut, which lies in the same pixels.
    let both = (0..whole.len()).filter(|&i| kept[i] && rest[i]).count();
    assert!(both > 50 && both < count(&rest) / 2, "{both}");
}

#[test]
fn hatching_covers_its_share_and_differs_between_neighbors() {
    let mut session = session();
    let at = |x: f32| {
        let mut mesh = primitives::cube(1.5);
        mesh.positions.iter_mut().for_each(|p| p.x += x);
        mesh
    };
    let mut opened = plan(vec![colored("left", at(-0.75), RED), colored("right", at(0.75), GRAY)], "0.1");
    let lines = ["edges.profile.show", "edges.inner.show", "edges.section.show"];
    set_all(&mut opened, &lines.map(|key| (key, "false")));
    // In pixels of this picture: 12 apart and 3 wide.
    let scale = 1080.0 / f64::from(SIDE);
    let (spacing, width) = ((12.0 * scale).to_string(), (3.0 * scale).to_string());
    set_all(
        &mut opened,
        &[
            ("section.hatch.spacing", &spacing),
            ("section.hatch.width", &width),
            ("section.hatch.color", "#000000"),
            ("section.color", "#ffffff"),
        ],
    );
    let picture = image(&mut session, &opened, SIDE);
    let ink = |x: u32, y: u32| {
        1.0 - f64::from(hachure::style::color::linear_from_srgb(picture.get_pixel(x, y).0[0]))
    };
    // Well inside of each: the middle of the picture is where they meet.
    let pixel = 2.0 * half_height(&opened) / f64::from(SIDE);
    let size = (1.5 / pixel) as u32;
    let mut along = Vec::new();
    for left in [SIDE / 2 - size + 4, SIDE / 2 + 4] {
        let columns = left..left + size - 8;
        let rows = SIDE / 2 - size / 2 + 4..SIDE / 2 + size / 2 - 4;
        let inside: Vec<_> = columns.flat_map(|x| rows.clone().map(move |y| (x, y))).collect();
        let share = inside.iter().map(|&(x, y)| ink(x, y)).sum::<f64>() / inside.len() as f64;
        assert!((share - 0.25).abs() < 0.03, "{share}");
        // How little changes along the two diagonals.
        let change = |dx: i32| {
            inside
                .iter()
                .map(|&(x, y)| (ink(x, y) - ink(x.wrapping_add_signed(dx), y + 1)).abs())
                .sum::<f64>()
                / inside.len() as f64
        };
        along.push([change(1), change(-1)]);
    }
    let [a, b] = [along[0], along[1]];
    assert!(a[0].min(a[1]) < 0.02 && a[0].max(a[1]) > 0.1, "{a:?}");
    assert!((a[0] < a[1]) != (b[0] < b[1]), "both run alike: {a:?} {b:?}");
}

#[test]
fn the_cut_has_lines_of_its_own_class() {
    let mut session = session();
    let mut opened = plan(vec![colored("ball", primitives::sphere(1.5, 24, 48), RED)], "0.2");
    let half = half_height(&opened);
    set_all(
        &mut opened,
        &[("section.color", "#ffffff"), ("section.cap", "plain"), ("edges.section.color", "#00ff00")],
    );
    let mut green = |settings: &[(&str, &str)]| {
        set_all(&mut opened, settings);
        let picture = image(&mut session, &opened, SIDE);
        picture.pixels().filter(|p| p.0[1] > 200 && p.0[0] < 60 && p.0[2] < 60).count()
    };
    // 4 px wide by default, a heavy line; 16 reference pixels are about 2.4 px here.
    let wide = green(&[("edges.section.width", "16")]);
    let radius = (1.5_f64 * 1.5 - 0.04).sqrt() / half * f64::from(SIDE) * 0.5;
    assert!(wide > (1.5 * radius) as usize, "{wide}, {radius}");
    let dashed =
        green(&[("edges.section.dashed", "true"), ("edges.dash.length", "40"), ("edges.dash.gap", "40")]);
    assert!(dashed > wide / 5 && dashed < wide * 4 / 5, "{dashed} of {wide}");
    assert_eq!(green(&[("edges.section.show", "false")]), 0);
    // In a blueprint too, of every layer.
    let in_blueprint = |opened: &mut Opened| set_all(opened, &[("technique", "blueprint")]);
    in_blueprint(&mut opened);
    set_all(
        &mut opened,
        &[
            ("edges.section.show", "false"),
            ("edges.profile.show", "false"),
            ("edges.inner.show", "false"),
            ("section.hatch.width", "0.25"),
            ("section.cap", "hatched"),
            ("section.hatch.spacing", "200"),
        ],
    );
    let without = image(&mut session, &opened, SIDE);
    set(&mut opened, "edges.section.show", "true");
    set(&mut opened, "edges.section.dashed", "false");
    assert!(differing(&image(&mut session, &opened, SIDE), &without) > (1.5 * radius) as usize);
}

/// Where lines run a few pixels apart, others that are wide enough to reach over both change what is seen of them.
#[test]
fn section_lines_do_not_count_where_nothing_is_cut() {
    let mut session = session();
    // A ridge two pixels beside a silhouette, with lines a little less wide.
    let cube = colored("cube", primitives::cube(2.0), RED);
    let mut opened = view(vec![cube], DVec3::new(0.04, 0.3, 1.0), true);
    set_all(&mut opened, &[("edges.profile.width", "12"), ("edges.inner.width", "12")]);
    for (show, position) in [("false", "0"), ("true", "5")] {
        set_all(&mut opened, &[("section.show", show), ("section.position", position)]);
        let mut with_width = |width| {
            set(&mut opened, "edges.section.width", width);
            image(&mut session, &opened, SIDE)
        };
        assert!(with_width("64") == with_width("1"), "{position}");
    }
}

#[test]
fn a_plane_that_leaves_nothing_leaves_paper_and_says_so() {
    let mut session = session();
    let mut opened = plan(vec![colored("ball", primitives::sphere(1.0, 12, 16), RED)], "-5");
    let empty = Opened { scene: Arc::new(Scene::default()), ..opened.clone() };
    assert_eq!(image(&mut session, &opened, SIDE), image(&mut session, &empty, SIDE));
    set(&mut opened, "section.flip", "true");
    let whole = image(&mut session, &opened, SIDE);
    set(&mut opened, "section.show", "false");
    assert_eq!(image(&mut session, &opened, SIDE), whole);

    let folder = tempfile::tempdir().unwrap();
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/models/crank.glb");
    let render = |args: &[&str]| {
        let output = folder.path().join("a.png");
        Command::new(env!("CARGO_BIN_EXE_hachure"))
            .arg("render")
            .arg(&model)
            .args(["--resolution", "64,64", "--output"])
            .arg(output)
            .args(args)
            // Without it a library complains.
            .env("XDG_RUNTIME_DIR", folder.path())
            .output()
            .unwrap()
    };
    let told = render(&["--section", "y=-100"]);
    let text = String::from_utf8_lossy(&told.stderr);
    assert!(told.status.success() && text.contains("nothing is left; move the plane or flip it"), "{text}");
    assert!(render(&["--section", "x"]).stderr.is_empty());
    let wrong = render(&["--section", "w=1"]);
    let text = String::from_utf8_lossy(&wrong.stderr);
    assert!(wrong.status.code() == Some(2) && text.contains("write x, y or z and a position"), "{text}");
    let wrong = render(&["--set", "section.position=nan"]);
    assert_eq!(wrong.status.code(), Some(1), "{}", String::from_utf8_lossy(&wrong.stderr));
}
