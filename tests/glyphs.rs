//! Glyphs: what documents say about them, how they are drawn among other objects, and what a change of one costs.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::time::Instant;

use common::{opened, scene, session, set};
use glam::{DMat4, DVec3};
use hachure::document::Document;
use hachure::document::glyph::{Anchor, FOLDER, Glyph, LetterUnit, Shape};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Text, primitives};
use hachure::scene::Projection;
use hachure::style::{Color, Style, Technique};
use image::{Rgba, RgbaImage};

const SIDE: u32 = 160;

fn picture(session: &mut Session, opened: &Opened) -> RgbaImage {
    session.image(opened, [SIDE, SIDE], false).unwrap()
}

fn middle(image: &RgbaImage) -> Rgba<u8> {
    *image.get_pixel(image.width() / 2, image.height() / 2)
}

fn is_red(p: &Rgba<u8>) -> bool {
    p.0[0] > 140 && p.0[1] < 90 && p.0[2] < 90
}

fn reds(image: &RgbaImage) -> usize {
    image.pixels().filter(|p| is_red(p)).count()
}

/// A cube of size 2 named `shell`, with a small one named `core` in it, seen from the front.
fn nested(technique: &str) -> Opened {
    let small = DMat4::from_scale(DVec3::splat(0.4));
    let scene = scene(vec![
        ("shell", primitives::cube(2.0), DMat4::IDENTITY, [0.6, 0.6, 0.6]),
        ("core", primitives::cube(1.0), small, [0.6, 0.6, 0.6]),
    ]);
    let mut opened = opened(&scene, DVec3::new(0.2, 0.1, 1.0));
    set(&mut opened, "technique", technique);
    opened
}

fn document(text: &str) -> Document {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.hachure");
    std::fs::write(&path, text).unwrap();
    let document = Document::open(&path).unwrap().document;
    document.save(&path).unwrap();
    assert_eq!(Document::open(&path).unwrap().document, document, "saving loses nothing");
    document
}

#[test]
fn documents_with_glyphs_survive_saving_and_opening() {
    let text = r##"
        [[glyph]]
        kind = "box"
        name = "chamber"
        node = "/core"
        frame = true
        color = "#00ff00"
        [[glyph]]
        kind = "path"
        points = [[0, 0, 0], [1, 2, 3.5], [4.0, 5.0, 6.0]]
        heads = "both"
        thickness = 1.5
        [[glyph]]
        kind = "arrow"
        points = [[0, 0, 0], [1, 2, 3.5]]
        [[glyph]]
        kind = "label"
        text = "two\nlines"
        point = [0.5, 0, 0]
        unit = "model"
        right = -3
        in_front = false
        [[glyph]]
        kind = "label"
        text = "of a node"
        node = "/core"
        [nodes."glyphs/path".style]
        technique = "toon"
        [nodes."glyphs/arrow"]
        visible = false
    "##;
    let document = document(text);
    let names: Vec<_> = document.glyphs.iter().map(|g| g.name.as_str()).collect();
    assert_eq!(names, ["chamber", "path", "arrow", "label", "label.2"]);
    let Shape::Label(label) = &document.glyphs[3].shape else { panic!("{:?}", document.glyphs[3]) };
    assert_eq!((label.unit, label.offset, label.in_front), (LetterUnit::Model, [-3.0, 2.0], false));
    assert_eq!(label.anchor, Anchor::Point(DVec3::new(0.5, 0.0, 0.0)));
    let opened = nested("plain");
    assert_eq!(document.glyph_faults(&opened.scene), []);
    let scene = document.scene_with_glyphs(&opened.scene);
    let resolved = document.resolve(&scene);
    assert_eq!(resolved[2].style.technique, Technique::Unlit);
    assert_eq!(resolved[3].style.technique, Technique::Toon);
    assert!(!resolved[4].visible && resolved[2].enhanced && !resolved[5].enhanced);
}

#[test]
fn hostile_glyphs_are_told_and_the_rest_is_drawn() {
    let path = |points: &str| format!("kind = \"path\"\npoints = [{points}]");
    let many = (0..10_000).map(|i| format!("[{}, 1.5, 0.0]", f64::from(i % 100) * 0.01)).collect::<Vec<_>>();
    let label = |text: &str| format!("kind = \"label\"\nnode = \"/core\"\ntext = \"{text}\"");
    for (table, expected) in [
        ("kind = \"blob\"".to_owned(), "`blob` is no kind of glyph; there are box, arrow, path, label"),
        ("name = \"x\"".to_owned(), "missing field `kind`"),
        ("kind = \"path\"".to_owned(), "a glyph of kind `path` needs `points`"),
        ("kind = \"box\"".to_owned(), "a glyph of kind `box` needs `node`"),
        ("kind = \"label\"\ntext = \"x\"".to_owned(), "needs `point` or `node`"),
        (path(""), "needs two different points"),
        (path("[1, 2, 3]"), "needs two different points"),
        (path("[1, 2, 3], [1, 2, 3]"), "needs two different points"),
        (path("[0, 0, 0], [nan, 0, 0]"), "its point 2 has a coordinate that is no number"),
        (path("[0, 0, 0], [0, -inf, 0]"), "its point 2 has a coordinate that is no number"),
        (path("[0, 0, 0], [0, 1e300, 0]"), "too far"),
        (path("[0, 0], [1, 1]"), "invalid length 2"),
        (path("[0, 0, 0], [1, 1, 1]") + "\nthicknes = 3", "did you mean `glyph.thickness`?"),
        (path(&many.join(", ")), "has 10000 points; only the first 2000 are drawn"),
        ("kind = \"box\"\nnode = \"/cor\"".to_owned(), "no node `/cor`; did you mean `/core`?"),
        (label(""), "it has no text"),
        (label("漢字"), "the font has no `漢字`"),
        (label("x") + "\nsize = nan", "out of range"),
        (label("x") + "\npoint = [nan, 0, 0]", "its point 1 has"),
        (label(&"x".repeat(5000)), "only its first 1000 letters"),
    ] {
        let good = "[[glyph]]\nkind = \"box\"\nname = \"good\"\nnode = \"/shell\"\n";
        let mut opened = nested("plain");
        let camera = opened.document.camera;
        opened.document = document(&format!("{good}[[glyph]]\n{table}\n"));
        opened.document.camera = camera;
        let faults: Vec<_> =
            opened.document.glyph_faults(&opened.scene).iter().map(|f| f.to_string()).collect();
        assert!(faults.len() == 1 && faults[0].contains(expected), "{table:.200}\n{faults:?}");
        if !table.contains("漢字") && !table.contains("xxx") {
            let mut session = session();
            session.set_scene(&opened).unwrap();
            assert!(is_red(&middle(&picture(&mut session, &opened))), "{table:.200}");
        }
    }
}

#[test]
fn a_box_is_seen_through_blueprints_and_hidden_by_surfaces() {
    for (technique, is_seen) in [("blueprint", true), ("plain", false)] {
        let mut opened = nested(technique);
        opened.document.add_glyph(Glyph::new("box".to_owned(), Shape::around("/core".to_owned())));
        let mut session = session();
        session.set_scene(&opened).unwrap();
        let drawn = picture(&mut session, &opened);
        assert_eq!(is_red(&middle(&drawn)), is_seen, "{technique}: {:?}", middle(&drawn));
        // All of its front, lines of the shell's edges apart.
        assert_eq!(reds(&drawn) > 300, is_seen, "{technique}: {}", reds(&drawn));
        opened.document.node_mut("glyphs/box").visible = Some(false);
        assert_eq!(reds(&picture(&mut session, &opened)), 0, "{technique}, hidden");
    }
}

#[test]
fn glyphs_have_styles_of_their_own() {
    let mut opened = nested("plain");
    opened.document.add_glyph(Glyph::new("box".to_owned(), Shape::around("/shell".to_owned())));
    let mut session = session();
    session.set_scene(&opened).unwrap();
    assert!(is_red(&middle(&picture(&mut session, &opened))));
    set(&mut opened, "technique", "blank");
    assert!(
        is_red(&middle(&picture(&mut session, &opened))),
        "what is set for all objects is not for glyphs"
    );
    opened.document.node_mut("glyphs/box").style =
        Some(Style { technique: Technique::Blank, ..Style::default() });
    let paper = opened.document.paper().0;
    assert_eq!(middle(&picture(&mut session, &opened)).0[..3], paper);
    opened.document.rename_glyph(0, "chamber/1");
    assert_eq!(opened.document.glyphs[0].path(), format!("{FOLDER}chamber-1"));
    assert_eq!(middle(&picture(&mut session, &opened)).0[..3], paper, "the style goes along");
    opened.document.remove_glyph(0);
    assert!(opened.document.nodes.is_empty() && opened.document.glyphs.is_empty());
    assert_eq!(reds(&picture(&mut session, &opened)), 0);
}

#[test]
fn picking_a_glyph_gives_the_node_behind_those_of_the_files() {
    let mut opened = nested("blueprint");
    opened.document.add_glyph(Glyph::new("first".to_owned(), Shape::around("/core".to_owned())));
    opened.document.add_glyph(Glyph::new("second".to_owned(), Shape::around("/shell".to_owned())));
    let mut session = session();
    session.set_scene(&opened).unwrap();
    picture(&mut session, &opened);
    session.renderer().start_pick([SIDE / 2, SIDE / 2]).unwrap();
    session.renderer().gpu().wait().unwrap();
    let node = session.renderer().poll_pick().unwrap().node.unwrap();
    assert_eq!(node, 3);
    assert_eq!(session.renderer().scene().unwrap().scene.nodes[node].path, "glyphs/second");
}

/// A black label on a red plate, before and behind a cube.
fn labeled(in_front: bool, unit: LetterUnit, anchor: DVec3) -> Opened {
    let mut opened = nested("plain");
    opened.document.view.background = Some(Color([255, 0, 0]));
    let mut shape = Shape::label("HI".to_owned(), Anchor::Point(anchor));
    if let Shape::Label(label) = &mut shape {
        (label.in_front, label.unit, label.offset, label.size) = (in_front, unit, [0.0, 0.0], 200.0);
    }
    let mut glyph = Glyph::new("label".to_owned(), shape);
    glyph.color = Color::BLACK;
    opened.document.add_glyph(glyph);
    opened
}

/// Left, top, right and bottom end of what is black.
fn black_box(image: &RgbaImage) -> Option<[u32; 4]> {
    let black = image.enumerate_pixels().filter(|(.., p)| p.0[..3].iter().all(|c| *c < 40));
    black.fold(None, |found, (x, y, _)| {
        let [l, t, r, b] = found.unwrap_or([x, y, x, y]);
        Some([l.min(x), t.min(y), r.max(x), b.max(y)])
    })
}

#[test]
fn labels_face_the_eye_and_have_their_size_from_everywhere() {
    let text = Text::new("HI");
    let em = 200.0 * f64::from(SIDE) / 1080.0;
    let cap = f64::from(text.max.y) * em;
    let mut session = session();
    for orthographic in [false, true] {
        for towards in [DVec3::Z, DVec3::new(1.0, 0.4, 0.2), DVec3::new(-0.3, 0.95, -0.6)] {
            let mut opened = labeled(true, LetterUnit::Pixel, DVec3::ZERO);
            opened.document.style.edges.profile.show = false;
            opened.document.style.edges.inner.show = false;
            opened.document.camera = Some(
                common::opened(&opened.scene, towards)
                    .document
                    .camera
                    .unwrap()
                    .with_orthographic(orthographic),
            );
            session.set_scene(&opened).unwrap();
            let [l, t, r, b] = black_box(&picture(&mut session, &opened)).unwrap();
            let (width, height) = (f64::from(r + 1 - l), f64::from(b + 1 - t));
            assert!((height - cap).abs() <= 1.5, "{towards}: {height} of {cap}");
            // Two letters that are narrower than their places.
            assert!((0.6..1.1).contains(&(width / (f64::from(text.max.x) * em))), "{towards}: {width}");
            let center = [f64::from(l + r + 1) * 0.5, f64::from(t + b + 1) * 0.5];
            let camera = opened.document.camera.unwrap();
            let origin = camera.view_from_world().transform_point3(DVec3::ZERO);
            let half = match camera.projection {
                Projection::Perspective { view_angle } => -origin.z * (view_angle * 0.5).to_radians().tan(),
                Projection::Orthographic { view_height } => view_height * 0.5,
            };
            let seen = |along: f64| (1.0 + along / half) * f64::from(SIDE) * 0.5;
            let off = [center[0] - seen(origin.x), center[1] - seen(-origin.y)];
            // Capitals stand a little above the middle of a line.
            assert!(off[0].abs() < 2.0 && (-5.0..0.0).contains(&off[1]), "{towards}: {off:?}");
        }
    }
}

#[test]
fn labels_before_everything_are_never_hidden_and_others_are_by_what_is_before_them() {
    let mut session = session();
    for (in_front, depth, is_seen) in
        [(true, -0.9, true), (false, -0.9, false), (false, 1.001, true), (true, 1.001, true)]
    {
        let opened = labeled(in_front, LetterUnit::Pixel, DVec3::new(0.0, 0.0, depth));
        session.set_scene(&opened).unwrap();
        let drawn = picture(&mut session, &opened);
        let plate = drawn
            .enumerate_pixels()
            .filter(|(x, y, p)| x.abs_diff(80) < 14 && y.abs_diff(80) < 10 && is_red(p));
        assert_eq!(plate.count() > 100, is_seen, "in front: {in_front}, at {depth}");
    }
}

#[test]
fn a_label_in_units_of_the_model_grows_with_it() {
    let mut session = session();
    let mut heights = Vec::new();
    for zoom in [1.0, 2.0] {
        let mut opened = labeled(true, LetterUnit::Model, DVec3::ZERO);
        opened.document.style.edges.profile.show = false;
        opened.document.style.edges.inner.show = false;
        let camera = opened.document.camera.as_mut().unwrap();
        camera.position = camera.focal_point + (camera.position - camera.focal_point) / zoom;
        session.set_scene(&opened).unwrap();
        let [_, t, _, b] = black_box(&picture(&mut session, &opened)).unwrap();
        heights.push(f64::from(b + 1 - t));
    }
    assert!((heights[1] / heights[0] - 2.0).abs() < 0.2, "{heights:?}");
}

#[test]
fn an_edit_of_a_glyph_beside_a_million_triangles_takes_a_moment() {
    let big = primitives::sphere(1.0, 700, 720);
    let scene = scene(vec![("big", big, DMat4::IDENTITY, [0.5; 3])]);
    assert!(scene.triangle_count() > 1_000_000);
    let mut opened = opened(&scene, DVec3::Z);
    let mut session = session();
    session.renderer().set_scene(&scene, &[]).unwrap();
    let points = (0..20).map(|i| DVec3::new(f64::from(i) * 0.1, f64::from(i % 2), 1.5)).collect();
    opened.document.add_glyph(Glyph::new("way".to_owned(), Shape::path(points)));
    opened.document.add_glyph(Glyph::new("box".to_owned(), Shape::around("/big".to_owned())));
    let gpu = session.renderer().gpu().clone();
    let mut on_device = session.renderer().scene().unwrap().clone();
    let fastest = (0..10)
        .map(|_| {
            let began = Instant::now();
            let shapes = opened.document.glyph_shapes(&scene, on_device.model_bounds());
            on_device.set_additions(&gpu, shapes.additions).unwrap();
            began.elapsed().as_secs_f64() * 1000.0
        })
        .fold(f64::MAX, f64::min);
    assert!(fastest < 20.0, "{fastest} ms");
    assert_eq!(on_device.scene.added, 2);
}
