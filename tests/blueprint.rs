//! Blueprints: layers are what rays from the eye meet, they end where they are told to, and the layers lie correctly
//! among opaque objects.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the shares of pixels are what the heavy one is for")]

mod common;

use std::sync::Arc;

use common::{Object, object, opened, sample, scene, session, set, set_for, texels};
use glam::{DMat4, DQuat, DVec3, UVec2, Vec2, Vec3};
use hachure::export::Session;
use hachure::export::session::{Opened, initial_camera};
use hachure::geometry::bvh::Bvh;
use hachure::geometry::{Mesh, primitives};
use hachure::render::View;
use hachure::render::base::ids::object_id;
use hachure::scene::Scene;
use hachure::style::Value;

fn at(z: f64) -> DMat4 {
    DMat4::from_translation(DVec3::Z * z)
}

/// Everything as a blueprint, of which all layers are drawn.
fn blueprint(mut opened: Opened) -> Opened {
    set(&mut opened, "technique", "blueprint");
    set(&mut opened, "blueprint.max_layers", "64");
    set(&mut opened, "blueprint.min_coverage", "0");
    opened
}

/// A surface that a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Hit {
    object: u32,
    /// Linear.
    depth: f64,
}

/// All triangles of a scene, world space, and whose they are.
struct World {
    bvh: Bvh,
    objects: Vec<u32>,
}

impl World {
    fn new(scene: &Scene) -> Self {
        let (mut triangles, mut objects) = (Vec::new(), Vec::new());
        for (id, node) in scene.nodes.iter().enumerate() {
            let Some(mesh) = node.mesh.map(|m| &scene.meshes[m]) else { continue };
            for corners in mesh.indices.chunks_exact(3) {
                let corner =
                    |v: u32| node.world_from_local.transform_point3(mesh.positions[v as usize].as_dvec3());
                triangles.push([corner(corners[0]), corner(corners[1]), corner(corners[2])]);
                objects.push(object_id(id));
            }
        }
        Self { bvh: Bvh::new(&triangles), objects }
    }

    /// All that the ray through a point of the picture meets, in order of depth.
    fn hits(&self, view: &View, px: Vec2) -> Vec<Hit> {
        let origin = view.unproject(px, 0.0);
        let direction = view.unproject(px, 1.0) - origin;
        let found = std::cell::RefCell::new(Vec::new());
        self.bvh.any_hit(origin, direction, view.clip_range[0], f64::INFINITY, |hit| {
            found.borrow_mut().push(Hit { object: self.objects[hit.triangle], depth: hit.t });
            true
        });
        let mut hits = found.into_inner();
        hits.sort_by(|a, b| a.depth.total_cmp(&b.depth).then(a.object.cmp(&b.object)));
        // Two triangles that share an edge, on it.
        hits.dedup_by(|a, b| a.object == b.object && (a.depth - b.depth).abs() < 1e-9 * b.depth);
        hits
    }
}

/// Whether two lists are equal; surfaces closer than 1e-5 of the depth compare as a set. `around`: what rays close by meet,
/// as corners are snapped to fractions of a pixel.
fn agree(drawn: &[Hit], cast: &[Hit], around: &[Vec<Hit>]) -> bool {
    let is_deep = |i: usize, hit: &Hit| {
        let depths = around.iter().filter_map(|hits| hits.get(i)).map(|h| h.depth);
        let (low, high) = depths
            .fold((cast[i].depth, cast[i].depth), |(low, high), depth| (low.min(depth), high.max(depth)));
        let slack = 1e-5 * hit.depth.abs();
        low - slack <= hit.depth && hit.depth <= high + slack
    };
    let mut start = 0;
    let mut same = drawn.len() == cast.len() && drawn.iter().enumerate().all(|(i, hit)| is_deep(i, hit));
    while same && start < cast.len() {
        let run = cast[start..].windows(2).take_while(|w| w[1].depth - w[0].depth < 1e-5 * w[0].depth.abs());
        let end = start + run.count() + 1;
        let set = |hits: &[Hit]| {
            let mut objects: Vec<_> = hits[start..end].iter().map(|h| h.object).collect();
            objects.sort_unstable();
            objects
        };
        same = set(drawn) == set(cast);
        start = end;
    }
    same
}

/// Per pixel what the layers hold, nearest first.
fn layers(session: &mut Session, opened: &Opened, side: u32) -> Vec<Vec<Hit>> {
    common::capture_layers(session);
    session.set_scene(opened).unwrap();
    session.draw(opened, [side; 2], false).unwrap();
    assert_eq!(session.renderer().last_layer_reports().len(), 1, "one group");
    let mut of_pixel = vec![Vec::new(); (side * side) as usize];
    for geometry in common::captured_layers(session, "layer geometry") {
        let surfels = texels::<[u32; 4]>(session, &geometry);
        for (hits, [_, _, depth, object]) in of_pixel.iter_mut().zip(surfels) {
            if object != 0 {
                hits.push(Hit { object: object & 0x7fff_ffff, depth: f64::from(f32::from_bits(depth)) });
            }
        }
    }
    of_pixel
}

fn check_layers(name: &str, opened: &Opened, side: u32, min_depth: usize) {
    let mut session = session();
    let opened = blueprint(opened.clone());
    let world = World::new(&opened.scene);
    let camera =
        opened.document.camera.unwrap_or_else(|| initial_camera(&opened.document, &opened.scene, 1.0));
    for camera in [camera, camera.with_orthographic(true)] {
        let opened = Opened {
            document: hachure::document::Document { camera: Some(camera), ..opened.document.clone() },
            scene: Arc::clone(&opened.scene),
        };
        let drawn = layers(&mut session, &opened, side);
        let view = View::new(&camera, &opened.scene.bounds(), UVec2::splat(side));
        let (mut compared, mut deepest, mut wrong) = (0_u32, 0, Vec::new());
        for (i, drawn) in drawn.iter().enumerate() {
            let px = Vec2::new((i as u32 % side) as f32 + 0.5, (i as u32 / side) as f32 + 0.5);
            let cast = world.hits(&view, px);
            let objects = |hits: &[Hit]| hits.iter().map(|h| h.object).collect::<Vec<_>>();
            let here = objects(&cast);
            // Within a pixel of an edge, another surface is met there.
            let is_inside = (0..16).all(|k| {
                let offset = Vec2::from_angle(k as f32 * std::f32::consts::TAU / 8.0) * [0.5, 1.0][k / 8];
                objects(&world.hits(&view, px + offset)) == here
            });
            if is_inside && !cast.is_empty() {
                compared += 1;
                deepest = deepest.max(cast.len());
                let around =
                    [Vec2::X, Vec2::NEG_X, Vec2::Y, Vec2::NEG_Y].map(|d| world.hits(&view, px + d / 64.0));
                if !agree(drawn, &cast, &around) {
                    wrong.push((px, drawn.clone(), cast));
                }
            }
        }
        assert!(compared > side * side / 12, "{name}: only {compared} pixels");
        assert!(deepest >= min_depth, "{name}: at most {deepest} layers");
        let share = wrong.len() as f64 / f64::from(compared);
        println!(
            "{name}, {}: {:.4} % of {compared} pixels have the layers that rays meet, up to {deepest}",
            if view.orthographic { "orthographic" } else { "perspective" },
            100.0 * (1.0 - share)
        );
        assert!(share <= 1e-4, "{name}: {} of {compared} pixels differ: {:#?}", wrong.len(), wrong[0]);
    }
}

#[test]
fn the_layers_of_the_samples_are_what_rays_meet() {
    check_layers("crank", &sample("crank"), 144, 8);
    check_layers("ogre", &sample("ogre"), 144, 4);
}

#[test]
#[ignore = "heavy; see `make quality`"]
fn the_layers_of_all_samples_are_what_rays_meet_in_large_pictures() {
    check_layers("crank", &sample("crank"), 512, 16);
    check_layers("ogre", &sample("ogre"), 512, 8);
    check_layers("temple", &sample("temple"), 512, 16);
}

#[test]
fn coplanar_duplicate_and_interpenetrating_objects_lose_and_repeat_nothing() {
    let turn = DMat4::from_quat(DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.3, 0.1));
    let eye = DVec3::new(0.3, 0.2, 1.0);
    let duplicates: Vec<Object> =
        ["a", "b", "c"].map(|name| object(name, primitives::sphere(1.0, 12, 20), turn)).into();
    check_layers("duplicates", &opened(&scene(duplicates), eye), 96, 6);
    let coplanar = vec![
        object("wide", primitives::plane(2.0), turn),
        object("narrow", primitives::plane(1.0), turn),
        object("cube", primitives::cube(1.0), turn * at(0.5)),
        object("tall", primitives::cube(1.0), turn * DMat4::from_translation(DVec3::new(0.3, 0.2, 0.5))),
    ];
    check_layers("coplanar", &opened(&scene(coplanar), eye), 96, 6);
    let crossing = vec![
        object("cube", primitives::cube(1.4), turn),
        object("ball", primitives::sphere(0.9, 16, 24), DMat4::IDENTITY),
        object("ring", primitives::torus(0.8, 0.3, 24, 12), turn),
        object("wall", primitives::plane(2.4), DMat4::from_rotation_y(0.5)),
    ];
    check_layers("crossing", &opened(&scene(crossing), eye), 96, 6);
}

/// Squares behind each other, as large as given.
fn stack(sides: &[f32]) -> Opened {
    let planes = sides.iter().enumerate().map(|(i, side)| {
        (["plane", "other"][i % 2], primitives::plane(*side), at(-0.05 * i as f64), [1.0; 3])
    });
    blueprint(opened(&scene(planes.collect()), DVec3::Z))
}

/// How far layers came: the number of layers, and the pixels of each.
fn layers_of(session: &mut Session, opened: &Opened) -> (u32, Vec<u32>) {
    session.set_scene(opened).unwrap();
    session.draw(opened, [64; 2], false).unwrap();
    let reports = session.renderer().layer_reports().unwrap();
    assert_eq!(reports.len(), 1);
    (reports[0].layers, reports[0].pixels.to_vec())
}

#[test]
fn layers_end_with_the_last_surface_the_most_layers_or_the_least_pixels() {
    let mut session = session();
    let few = stack(&[2.0, 1.5, 1.0, 0.5]);
    let (count, pixels) = layers_of(&mut session, &few);
    assert_eq!(count, 4);
    assert!(pixels[..4].windows(2).all(|w| w[0] > w[1]), "{pixels:?}");
    assert!(pixels[4..].iter().all(|p| *p == 0), "{pixels:?}");

    for most in [1, 3] {
        for key in ["blueprint.max_layers", "blueprint.to"] {
            let mut fewer = few.clone();
            set(&mut fewer, key, &most.to_string());
            let (count, of_fewer) = layers_of(&mut session, &fewer);
            assert_eq!(count, most, "{key}");
            assert_eq!(of_fewer[..most as usize], pixels[..most as usize]);
        }
    }
    // The third layer has exactly so many pixels; one more ends it before.
    for (least, expected) in [(pixels[2], 3), (pixels[2] + 1, 2), (pixels[0] + 1, 0)] {
        let mut ended = few.clone();
        let percent = (f64::from(least) - 0.5) * 100.0 / 4096.0;
        set(&mut ended, "blueprint.min_coverage", &percent.to_string());
        let (count, of_ended) = layers_of(&mut session, &ended);
        assert_eq!(count, expected, "at least {least} of {pixels:?}");
        // That which ended it has been counted, and nothing after it.
        assert_eq!(of_ended[expected as usize], pixels[expected as usize]);
        assert!(of_ended[expected as usize + 1..].iter().all(|p| *p == 0), "{of_ended:?}");
    }

    let many = stack(&[1.0; 70]);
    let (count, pixels) = layers_of(&mut session, &many);
    assert_eq!(count, 64);
    assert!(pixels.iter().all(|p| *p > 300), "{pixels:?}");
}

#[test]
fn a_group_beyond_the_picture_or_without_a_triangle_is_empty_paper() {
    let mut session = session();
    let ball = scene(vec![object("ball", primitives::sphere(1.0, 12, 20), DMat4::IDENTITY)]);
    let mut away = blueprint(opened(&ball, DVec3::Z));
    if let Some(camera) = &mut away.document.camera {
        camera.focal_point = camera.position + DVec3::Y;
        camera.view_up = DVec3::Z;
    }
    let nothing = blueprint(opened(&scene(vec![object("none", Mesh::default(), DMat4::IDENTITY)]), DVec3::Z));
    for opened in [away, nothing] {
        assert_eq!(layers_of(&mut session, &opened).0, 0);
        let image = common::image(&mut session, &opened, 32);
        assert!(image.pixels().all(|p| p == image.get_pixel(0, 0)));
    }
}

/// A white cube at a depth and around the origin a ball whose layers are black glass, half transparent, without lines.
fn cube_and_ball(z: f64) -> Opened {
    let objects = vec![
        object("cube", primitives::cube(0.5), at(z)),
        object("ball", primitives::sphere(1.0, 24, 48), DMat4::IDENTITY),
        // So that the camera is the same for all.
        object("around", primitives::cube(3.6), DMat4::IDENTITY),
    ];
    let mut opened = opened(&scene(objects), DVec3::Z);
    opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(true));
    opened.document.node_mut("/around").visible = Some(false);
    for (key, value) in [
        ("technique", "unlit"),
        ("edges.profile.show", "false"),
        ("edges.inner.show", "false"),
        ("view.background", "#ffffff"),
        ("blueprint.fill", "#000000"),
        ("blueprint.fill_opacity", "0.5"),
    ] {
        set(&mut opened, key, value);
    }
    set_for(&mut opened, 1, "technique", "blueprint");
    opened
}

/// How many layers of black glass leave so much of white.
fn layers_before_white(value: u8) -> u32 {
    (0..6)
        .min_by_key(|n| {
            let linear = 0.5_f64.powi(*n);
            let srgb = 1.055 * linear.powf(1.0 / 2.4) - 0.055;
            ((srgb * 255.0).round() as i32).abs_diff(i32::from(value))
        })
        .unwrap() as u32
}

#[test]
fn an_opaque_cube_hides_the_layers_behind_it_and_no_others() {
    let mut session = session();
    for (z, before_cube) in [(1.4, 0), (0.0, 1), (-1.4, 2)] {
        let image = common::image(&mut session, &cube_and_ball(z), 96);
        let seen = |x, y| layers_before_white(image.get_pixel(x, y).0[0]);
        assert_eq!(seen(48, 48), before_cube, "before the cube at {z}");
        // Beside the cube, within the ball; beyond the ball.
        assert_eq!(seen(48 + 17, 48), 2, "beside the cube at {z}");
        assert_eq!(seen(2, 2), 0);
    }
}

#[test]
fn layers_are_drawn_from_and_to_where_they_are_told() {
    let mut session = session();
    let objects = (0..5).map(|i| object("plane", primitives::plane(1.0), at(-0.1 * f64::from(i))));
    let mut opened = blueprint(opened(&scene(objects.collect()), DVec3::Z));
    for (key, value) in [
        ("edges.profile.show", "false"),
        ("edges.inner.show", "false"),
        ("view.background", "#ffffff"),
        ("blueprint.fill", "#000000"),
        ("blueprint.fill_opacity", "0.5"),
    ] {
        set(&mut opened, key, value);
    }
    for (from, to, expected) in [(1, 64, 5), (1, 2, 2), (3, 64, 3), (2, 4, 3), (5, 5, 1), (4, 3, 0)] {
        set(&mut opened, "blueprint.from", &from.to_string());
        set(&mut opened, "blueprint.to", &to.to_string());
        let image = common::image(&mut session, &opened, 32);
        let seen = layers_before_white(image.get_pixel(16, 16).0[0]);
        assert_eq!(seen, expected, "from {from} to {to}");
    }
}

/// Pixels with the color of a line.
fn inked(image: &image::RgbaImage) -> usize {
    image.pixels().filter(|p| p.0[0] < 200).count()
}

#[test]
fn hidden_lines_are_drawn_in_the_color_of_their_layer() {
    let mut session = session();
    // A cube in a cube: the inner one is hidden from all sides.
    let objects = vec![
        object("outer", primitives::cube(2.0), DMat4::IDENTITY),
        object("inner", primitives::cube(0.8), DMat4::IDENTITY),
    ];
    let mut opened = blueprint(opened(&scene(objects), DVec3::new(0.5, 0.4, 1.0)));
    for (key, value) in [
        ("view.background", "#ffffff"),
        ("blueprint.fill_opacity", "0"),
        ("blueprint.by_layer", "1"),
        ("blueprint.by_distance", "0"),
        ("blueprint.near", "#000000"),
        ("blueprint.far", "#ff0000"),
        ("edges.profile.width", "16"),
        ("edges.inner.width", "16"),
    ] {
        set(&mut opened, key, value);
    }
    let image = common::image(&mut session, &opened, 128);
    let red = image.pixels().filter(|p| p.0[0] > 200 && p.0[1] < 60).count();
    let black = inked(&image);
    assert!(red > 150 && black > 300, "{red} red, {black} black");
    // Only what a nearer layer does not hide adds ink: the first layer alone has all the black.
    set(&mut opened, "blueprint.to", "1");
    let first = common::image(&mut session, &opened, 128);
    assert_eq!(inked(&first), black);
    assert!(first.pixels().all(|p| p.0[0].abs_diff(p.0[1]) < 8), "the first layer has no red");
}

#[test]
fn repeated_lines_are_drawn_only_on_demand() {
    let mut session = session();
    // The outline of the near square is where the far one's second layer ends too (paper, Fig. 5).
    let objects = vec![
        object("near", primitives::plane(1.0), at(0.2)),
        object("far", primitives::plane(2.0), at(-0.2)),
        // The papers' operators see steps in depth only within the range of the objects.
        object("behind", primitives::plane(0.1), at(-2.0)),
    ];
    let mut opened = blueprint(opened(&scene(objects), DVec3::Z));
    for (key, value) in [
        ("view.background", "#ffffff"),
        ("blueprint.fill_opacity", "0"),
        ("blueprint.to", "2"),
        ("blueprint.near", "#000000"),
        ("blueprint.by_layer", "0"),
        ("blueprint.by_distance", "0"),
        ("edges.profile.width", "16"),
    ] {
        set(&mut opened, key, value);
    }
    for mode in ["exact", "image_space"] {
        set(&mut opened, "edges.mode", mode);
        let mut ink = [true, false].map(|repeated| {
            set(&mut opened, "blueprint.repeated", &repeated.to_string());
            // The first layer is counted, not drawn: its lines are then not repeated.
            set(&mut opened, "blueprint.from", "2");
            let hidden = inked(&common::image(&mut session, &opened, 96));
            set(&mut opened, "blueprint.from", "1");
            set(&mut opened, "edges.profile.opacity", "0.4");
            let image = common::image(&mut session, &opened, 96);
            set(&mut opened, "edges.profile.opacity", "1");
            (hidden, image.pixels().map(|p| u64::from(255 - p.0[0])).sum::<u64>())
        });
        ink.reverse();
        let [(hidden, once), (hidden_too, twice)] = ink;
        assert!(hidden > 60 && hidden == hidden_too, "{mode}: {hidden} {hidden_too}");
        assert!(twice > once + once / 20, "{mode}: {once} without and {twice} with repeated lines");
    }
}

#[test]
fn without_a_blueprint_there_are_no_layers_and_without_a_change_nothing_again() {
    let mut session = session();
    let runs = |session: &mut Session| {
        session
            .renderer()
            .runs()
            .iter()
            .find(|(name, _)| *name == "blueprint")
            .map(|(_, runs)| *runs)
            .unwrap()
    };
    let ball = scene(vec![object("ball", primitives::sphere(1.0, 12, 20), DMat4::IDENTITY)]);
    let surface = opened(&ball, DVec3::Z);
    common::draw(&mut session, &surface, 32);
    assert_eq!(runs(&mut session), 0);
    assert!(session.renderer().layer_reports().unwrap().is_empty());
    let mut layered = blueprint(surface);
    session.draw(&layered, [32; 2], false).unwrap();
    session.draw(&layered, [32; 2], false).unwrap();
    assert_eq!(runs(&mut session), 1);
    set(&mut layered, "blueprint.fill_opacity", "0.3");
    session.draw(&layered, [32; 2], false).unwrap();
    assert_eq!(runs(&mut session), 2);
}

#[test]
fn the_order_of_objects_changes_no_layer() {
    let mut session = session();
    let shapes =
        [primitives::cube(1.2), primitives::torus(0.7, 0.25, 20, 10), primitives::sphere(0.8, 12, 18)];
    let place = DMat4::from_quat(DQuat::from_rotation_x(0.5));
    let mut pictures = Vec::new();
    for order in [[0, 1, 2], [2, 0, 1]] {
        let objects = order.map(|i: usize| object(["cube", "ring", "ball"][i], shapes[i].clone(), place));
        let opened = blueprint(opened(&scene(objects.into()), DVec3::new(0.2, 0.4, 1.0)));
        let depths = layers(&mut session, &opened, 64)
            .iter()
            .map(|hits| hits.iter().map(|h| h.depth).collect::<Vec<_>>())
            .collect::<Vec<_>>();
        pictures.push(depths);
    }
    assert!(pictures[0].iter().filter(|depths| depths.len() > 1).count() > 300);
    assert!(pictures[0] == pictures[1]);
}

#[test]
fn a_click_means_the_nearest_of_blueprints_and_surfaces() {
    let mut session = session();
    // A cube inside of a ball; one of them is a blueprint.
    let objects = vec![
        object("cube", primitives::cube(0.6), at(0.0)),
        object("ball", primitives::sphere(1.0, 24, 32), at(0.0)),
    ];
    let scene = scene(objects);
    for (blueprint, expected) in [(0, 1), (1, 1)] {
        let mut opened = opened(&scene, DVec3::Z);
        set_for(&mut opened, blueprint, "technique", "blueprint");
        session.set_scene(&opened).unwrap();
        session.draw(&opened, [64; 2], false).unwrap();
        session.renderer().start_pick([32, 32]).unwrap();
        session.renderer().gpu().wait().unwrap();
        assert_eq!(session.renderer().poll_pick().unwrap().node, Some(expected));
    }
    // Without its nearest layers what lies behind them is meant.
    let mut opened = opened(&scene, DVec3::Z);
    set_for(&mut opened, 1, "technique", "blueprint");
    set_for(&mut opened, 1, "blueprint.from", "2");
    session.set_scene(&opened).unwrap();
    let camera = opened.document.camera.unwrap();
    let request = hachure::render::Request {
        document: &opened.document,
        camera: &camera,
        size: [64; 2],
        transparent: false,
        selected: &[1],
        samples: 1,
    };
    let picture = session.renderer().render(&request).unwrap();
    assert!(texels::<[u8; 4]>(&mut session, &picture.selection.unwrap()).iter().any(|t| t[3] > 0));
    session.renderer().start_pick([32, 32]).unwrap();
    session.renderer().gpu().wait().unwrap();
    assert_eq!(session.renderer().poll_pick().unwrap().node, Some(0));
}

#[test]
fn a_click_on_layers_that_have_ended_means_nothing() {
    let mut session = session();
    let mut opened =
        blueprint(opened(&scene(vec![object("cube", primitives::cube(0.6), at(0.0))]), DVec3::Z));
    session.set_scene(&opened).unwrap();
    for by in ["auto", "peeling"] {
        set(&mut opened, "view.layer_method", by);
        // A cube has two; what is drawn before leaves something in the memory that the next picture uses.
        for (from, expected) in [("1", Some(0)), ("2", Some(0)), ("3", None), ("1", Some(0)), ("3", None)] {
            set(&mut opened, "blueprint.from", from);
            session.draw(&opened, [64; 2], false).unwrap();
            session.renderer().start_pick([32, 32]).unwrap();
            session.renderer().gpu().wait().unwrap();
            assert_eq!(session.renderer().poll_pick().unwrap().node, expected, "{by}, from {from}");
        }
    }
}

/// A cube alone, its lines black on white without fading, without fill.
fn outlined() -> Opened {
    let mut opened = blueprint(opened(
        &scene(vec![object("cube", primitives::cube(1.0), DMat4::IDENTITY)]),
        DVec3::new(0.5, 0.4, 1.0),
    ));
    for (key, value) in [
        ("view.background", "#ffffff"),
        ("blueprint.fill_opacity", "0"),
        ("blueprint.by_layer", "0"),
        ("blueprint.by_distance", "0"),
        ("blueprint.near", "#000000"),
        ("edges.profile.width", "16"),
        ("edges.inner.width", "16"),
    ] {
        set(&mut opened, key, value);
    }
    opened
}

#[test]
fn a_threshold_leaves_faint_lines_out_and_makes_all_others_full() {
    let mut session = session();
    let mut opened = outlined();
    let mut drawn = |session: &mut Session, settings: &[(&str, &str)]| {
        for (key, value) in settings {
            set(&mut opened, key, value);
        }
        common::image(session, &opened, 96)
    };
    for mode in ["exact", "image_space"] {
        let full = drawn(&mut session, &[("edges.mode", mode), ("blueprint.threshold", "0")]);
        let faint = drawn(&mut session, &[("edges.inner.opacity", "0.5")]);
        let some = drawn(&mut session, &[("blueprint.threshold", "0.3")]);
        let few = drawn(&mut session, &[("blueprint.threshold", "0.7")]);
        let none = drawn(&mut session, &[("edges.inner.show", "false"), ("edges.inner.opacity", "1")]);
        drawn(&mut session, &[("edges.inner.show", "true")]);
        let [full, faint, some, few, none] = [&full, &faint, &some, &few, &none].map(inked);
        assert!(none > 100 && full > none + 100 && faint > none, "{mode}: {none} {faint} {full}");
        // The papers' operators have soft ink of their own.
        let slack = if mode == "exact" { 12 } else { full / 5 };
        assert!(few.abs_diff(none) <= slack, "{mode}: {few}, {none} without inner edges");
        assert!(some.abs_diff(full) <= slack, "{mode}: {some}, {full} of full ink");
    }
    // A line thinner than a pixel is a fine one, not a broken one.
    let thin = [("edges.mode", "exact"), ("edges.profile.width", "4"), ("edges.inner.width", "4")];
    let with = drawn(&mut session, &[&thin[..], &[("blueprint.threshold", "0.7")]].concat());
    let without = drawn(&mut session, &[("blueprint.threshold", "0")]);
    assert!(with == without && with.pixels().any(|p| p.0[0] < 240));
}

#[test]
fn a_threshold_leaves_flat_folds_out_of_exact_lines() {
    let mut session = session();
    // A fold of 35° has as much ink as the operators of the papers would give it: 0.72.
    let slope = 17.5_f32.to_radians().tan();
    let corner = |x: f32, y: f32| Vec3::new(x, y, -slope * y.abs());
    let corners = [-1.0, 0.0, 1.0].iter().flat_map(|y| [corner(-1.0, *y), corner(1.0, *y)]).collect();
    let roof = primitives::from_triangles(corners, vec![0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4]);
    let mut opened = blueprint(opened(&scene(vec![object("roof", roof, DMat4::IDENTITY)]), DVec3::Z));
    for (key, value) in
        [("blueprint.fill_opacity", "0"), ("edges.profile.width", "16"), ("edges.inner.width", "16")]
    {
        set(&mut opened, key, value);
    }
    let mut drawn = |threshold: &str| {
        set(&mut opened, "blueprint.threshold", threshold);
        inked(&common::image(&mut session, &opened, 96))
    };
    let [all, some, few] = ["0", "0.6", "0.8"].map(&mut drawn);
    assert!(all == some && few + 40 < some, "{all} {some} {few}");
}

#[test]
fn a_class_with_a_color_of_its_own_keeps_it_in_a_blueprint() {
    let mut session = session();
    let mut opened = outlined();
    let count = |session: &mut Session, opened: &Opened, is: fn([u8; 4]) -> bool| {
        common::image(session, opened, 96).pixels().filter(|p| is(p.0)).count()
    };
    let green = |[r, g, b, _]: [u8; 4]| g > 100 && r < 60 && b < 60;
    let black = |[r, g, b, _]: [u8; 4]| r < 30 && g < 30 && b < 30;
    assert_eq!(count(&mut session, &opened, green), 0);
    let all = count(&mut session, &opened, black);
    set(&mut opened, "edges.ridge.color", "#00c000");
    let (ridges, others) = (count(&mut session, &opened, green), count(&mut session, &opened, black));
    assert!(ridges > 60 && others > 100 && ridges + others <= all + 40, "{ridges} + {others} of {all}");
    // It fades as all lines do.
    // From within, the far edges are valleys.
    set(&mut opened, "edges.valley.color", "#00c000");
    set(&mut opened, "blueprint.from", "2");
    assert!(count(&mut session, &opened, green) > 30);
    set(&mut opened, "blueprint.far", "#ffffff");
    set(&mut opened, "blueprint.by_layer", "1");
    assert_eq!(count(&mut session, &opened, green), 0);
}

#[test]
fn lines_of_all_layers_take_the_color_of_their_surfaces() {
    let mut session = session();
    let red = ("red", primitives::cube(1.0), DMat4::IDENTITY, [1.0, 0.0, 0.0]);
    let green = ("green", primitives::cube(0.4), DMat4::IDENTITY, [0.0, 1.0, 0.0]);
    let two = opened(&scene(vec![red, green]), DVec3::new(0.5, 0.4, 1.0));
    let mut opened = Opened { scene: two.scene, document: outlined().document };
    opened.document.camera = two.document.camera;
    set(&mut opened, "edges.object_color", "1");
    set(&mut opened, "edges.darken", "0");
    for by in ["lists", "peeling"] {
        set(&mut opened, "view.layer_method", by);
        let image = common::image(&mut session, &opened, 96);
        let count = |of: usize| {
            let others = move |p: &image::Rgba<u8>| (0..3).filter(|c| *c != of).all(|c| p.0[c] < 60);
            image.pixels().filter(|p| p.0[of] > 200 && others(p)).count()
        };
        let (red, green) = (count(0), count(1));
        assert!(red > 200 && green > 60, "by {by}: {red} red, {green} green");
        assert!(image.pixels().all(|p| p.0[..2].iter().any(|c| *c > 120)), "by {by}: none is black");
    }
}

#[test]
fn the_paper_is_that_of_the_whole_drawings_style_unless_the_view_has_its_own() {
    let mut session = session();
    let mut opened = outlined();
    let corner = |session: &mut Session, opened: &Opened| {
        common::image(session, opened, 32).get_pixel(0, 0).0[..3].to_vec()
    };
    set(&mut opened, "paper", "#204060");
    assert_eq!(corner(&mut session, &opened), [255; 3]);
    opened.document.set("view.background", &Value::Inherit).unwrap();
    assert_eq!(corner(&mut session, &opened), [0x20, 0x40, 0x60]);
    set_for(&mut opened, 0, "paper", "#ff0000");
    assert_eq!(corner(&mut session, &opened), [0x20, 0x40, 0x60]);
}

#[test]
fn a_buffer_is_shown_of_any_layer() {
    let mut session = session();
    // Depth is shown from black (near) to white (far, and nothing).
    let sheets = [(0.4, 1.0), (0.0, 2.0), (-0.4, 3.0)];
    let objects = sheets.map(|(z, side)| object("sheet", primitives::plane(side), at(z)));
    let mut opened = opened(&scene(objects.into()), DVec3::Z);
    opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(true));
    let shown = |session: &mut Session, opened: &mut Opened, show: &str, layer: u32| {
        set(opened, "view.show", show);
        set(opened, "view.layer", &layer.to_string());
        common::image(session, opened, 96)
    };
    let depths: Vec<u8> = (1..=4)
        .map(|layer| shown(&mut session, &mut opened, "depth", layer).get_pixel(48, 48).0[0])
        .collect();
    assert!(depths[0] < 5 && depths[1].abs_diff(128) < 5 && depths[2] > 250, "{depths:?}");
    let objects: Vec<_> =
        (1..=4).map(|layer| shown(&mut session, &mut opened, "objects", layer).get_pixel(48, 48).0).collect();
    assert!(objects[0] != objects[1] && objects[1] != objects[2], "{objects:?}");
    // Behind the last one there is nothing, whatever was shown before.
    for show in ["objects", "edge_map", "depth", "normal_operator"] {
        let nothing = shown(&mut session, &mut opened, show, 4);
        assert!(nothing.pixels().all(|p| p.0[..3] == [255; 3]), "{show}");
    }
    // The outline of the middle sheet is in the second layer, nearer to the picture's middle than that of the last one.
    let edges = shown(&mut session, &mut opened, "edge_map", 2);
    let row: Vec<usize> =
        (0..96).filter(|x| edges.get_pixel(*x, 48).0[..3] != [255; 3]).map(|x| x as usize).collect();
    assert!(!row.is_empty() && row[0] > 4, "{row:?}");
    let first = shown(&mut session, &mut opened, "edge_map", 1);
    assert!(first != edges);
    set(&mut opened, "view.show", "picture");
    let picture = common::image(&mut session, &opened, 96);
    set(&mut opened, "view.layer", "1");
    assert!(picture == common::image(&mut session, &opened, 96), "the picture is made of all layers");
}
