//! Depth masks: designated objects are no blueprints, layers end with the layer that uncovers enough of them, and what is
//! counted is what processors and rays count too (blueprints paper, section 4.3).

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::sync::Arc;

use common::{Object, at, object, opened, scene, session, set, texels};
use glam::{DMat4, DVec3, UVec2, Vec2};
use hachure::document::Role;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::bvh::Bvh;
use hachure::geometry::primitives;
use hachure::render::View;
use hachure::render::base::ids::object_id;
use hachure::render::{LayerReport, LayersEnd};

const SIDE: u32 = 96;

/// Everything as a blueprint of which all layers are drawn, and object 0 designated.
fn designated(objects: Vec<Object>, towards_viewer: DVec3) -> Opened {
    let mut opened = opened(&scene(objects), towards_viewer);
    for (key, value) in [
        ("technique", "blueprint"),
        ("blueprint.max_layers", "64"),
        ("blueprint.min_coverage", "0"),
        ("view.background", "#ffffff"),
    ] {
        set(&mut opened, key, value);
    }
    designate(&mut opened, &[0], true);
    opened
}

fn designate(opened: &mut Opened, nodes: &[usize], is_mask: bool) {
    opened.document.set_role(&Arc::clone(&opened.scene), nodes, Role::Mask, is_mask);
}

/// A cube behind four sheets, of which each lets more of it be seen than the one before it.
fn behind_sheets() -> Opened {
    let sheet = |name, x: f64, z: f64| object(name, primitives::plane(2.0), at(x, 0.0, z));
    let mut opened = designated(
        vec![
            object("cube", primitives::cube(1.0), at(0.0, 0.0, -1.0)),
            sheet("a", -1.6, 0.8),
            sheet("b", -1.2, 0.6),
            sheet("c", -0.9, 0.4),
            sheet("d", -0.6, 0.2),
        ],
        DVec3::Z,
    );
    opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(true));
    opened
}

/// A blueprint with holes between a ball and the eye, and one around it.
fn among_rings() -> Opened {
    designated(
        vec![
            object("ball", primitives::sphere(0.6, 24, 32), DMat4::IDENTITY),
            object("around", primitives::sphere(1.2, 16, 24), DMat4::IDENTITY),
            object("ring", primitives::torus(0.5, 0.2, 24, 12), at(0.3, 0.1, 0.9)),
            object("box", primitives::cube(0.7), at(-0.6, 0.4, 0.7)),
            object("beside", primitives::cube(0.5), at(0.5, -0.6, -0.3)),
        ],
        DVec3::new(0.3, 0.2, 1.0),
    )
}

fn draw(session: &mut Session, opened: &Opened) -> LayerReport {
    common::capture_layers(session);
    session.set_scene(opened).unwrap();
    session.draw(opened, [SIDE; 2], false).unwrap();
    let report = session.renderer().layer_reports().unwrap();
    assert_eq!(report.len(), 1);
    report[0].clone()
}

/// The depth mask of the last picture.
fn mask_of(session: &mut Session) -> Vec<f32> {
    let mask = common::captured(session, "depth mask").unwrap();
    texels::<f32>(session, &mask)
}

/// What the processor counts in the textures: the mask's pixels, and those that pass against each layer that was drawn.
fn recount(session: &mut Session) -> (u32, Vec<u32>) {
    let mask = mask_of(session);
    let count = |passes: &dyn Fn(usize, f32) -> bool| {
        mask.iter().enumerate().filter(|(i, depth)| **depth > 0.0 && passes(*i, **depth)).count() as u32
    };
    let passed = common::captured_layers(session, "layer depth")
        .iter()
        .map(|depth| {
            let depths = texels::<f32>(session, depth);
            count(&|i, depth| depth >= depths[i])
        })
        .collect();
    (count(&|_, _| true), passed)
}

fn is_enough(passed: u32, fraction: f32, masked: u32) -> bool {
    passed as f32 >= fraction * masked as f32
}

#[test]
fn counts_equal_a_recount_and_layers_end_with_the_first_layer_that_uncovers_enough() {
    let mut session = session();
    let mut ends = Vec::new();
    for scene in [behind_sheets(), among_rings()] {
        let mut all = scene.clone();
        set(&mut all, "blueprint.fraction", "1");
        let whole = draw(&mut session, &all);
        let (masked, passed) = recount(&mut session);
        assert!(masked > 300, "{masked}");
        for fraction in ["0", "0.2", "0.35", "0.5", "0.8", "0.97", "1"] {
            let mut part = scene.clone();
            set(&mut part, "blueprint.fraction", fraction);
            let report = draw(&mut session, &part);
            assert_eq!(recount(&mut session).0, masked);
            assert_eq!(report.masked, masked, "Q");
            let fraction: f32 = fraction.parse().unwrap();
            let expected = passed.iter().position(|r| is_enough(*r, fraction, masked)).unwrap() as u32 + 1;
            assert_eq!(report.layers, expected, "fraction {fraction} of {masked}: {passed:?}");
            assert_eq!(report.ended, LayersEnd::MaskUncovered);
            let drawn = expected as usize;
            assert_eq!(report.passed[..drawn], passed[..drawn], "R");
            assert_eq!(report.pixels[..drawn], whole.pixels[..drawn]);
            assert!(report.pixels[drawn..].iter().chain(&report.passed[drawn..]).all(|n| *n == 0));
            assert_eq!(report.uncovered(), passed[drawn - 1]);
            assert_eq!(report.shortfall(), None);
            // What comes after the last layer was never drawn.
            let left = common::captured_layers(&mut session, "layer surface ids").split_off(drawn);
            let is_empty = |regions: &hachure::gpu::Target| {
                texels::<u32>(&mut session, regions).iter().all(|region| *region == 0)
            };
            assert!(left.iter().all(is_empty));
            ends.push(expected);
        }
    }
    ends.dedup();
    assert!(ends.len() >= 7, "different fractions end at different layers: {ends:?}");
}

/// What rays through a pixel meet of the designated object 0, and of the others: depths, nearest first.
struct Rays {
    bvh: Bvh,
    is_mask: Vec<bool>,
    view: View,
}

impl Rays {
    fn new(opened: &Opened) -> Self {
        let (mut triangles, mut is_mask) = (Vec::new(), Vec::new());
        for (id, node) in opened.scene.nodes.iter().enumerate() {
            let mesh = &opened.scene.meshes[node.mesh.unwrap()];
            for corners in mesh.indices.chunks_exact(3) {
                let corner =
                    |v: u32| node.world_from_local.transform_point3(mesh.positions[v as usize].as_dvec3());
                triangles.push([corner(corners[0]), corner(corners[1]), corner(corners[2])]);
                is_mask.push(id == 0);
            }
        }
        let camera = opened.document.camera.unwrap();
        let view = View::new(&camera, &opened.scene.bounds(), UVec2::splat(SIDE));
        Self { bvh: Bvh::new(&triangles), is_mask, view }
    }

    /// How many surfaces lie before the mask; `None` beside it.
    fn before_mask(&self, px: Vec2) -> Option<usize> {
        let origin = self.view.unproject(px, 0.0);
        let direction = self.view.unproject(px, 1.0) - origin;
        let (mut mask, mut others) = (f64::INFINITY, Vec::new());
        let hits = std::cell::RefCell::new(Vec::new());
        self.bvh.any_hit(origin, direction, self.view.clip_range[0], f64::INFINITY, |hit| {
            hits.borrow_mut().push((hit.t, self.is_mask[hit.triangle]));
            true
        });
        for (depth, is_mask) in hits.into_inner() {
            if is_mask { mask = mask.min(depth) } else { others.push(depth) }
        }
        others.sort_by(f64::total_cmp);
        // Two triangles that share an edge, on it.
        others.dedup_by(|a, b| (*a - *b).abs() < 1e-9 * *b);
        mask.is_finite().then(|| others.iter().filter(|depth| **depth < mask).count())
    }
}

#[test]
fn away_from_edges_a_pixel_passes_with_the_layer_before_which_rays_meet_the_mask() {
    let mut session = session();
    for scene in [behind_sheets(), among_rings()] {
        let mut all = scene;
        set(&mut all, "blueprint.fraction", "1");
        let report = draw(&mut session, &all);
        let rays = Rays::new(&all);
        let mask = mask_of(&mut session);
        let layers: Vec<Vec<f32>> = common::captured_layers(&mut session, "layer depth")
            .iter()
            .take(report.layers as usize)
            .map(|depth| texels::<f32>(&mut session, depth))
            .collect();
        let (mut compared, mut deepest) = (0, 0);
        for i in 0..mask.len() {
            let px = Vec2::new((i as u32 % SIDE) as f32 + 0.5, (i as u32 / SIDE) as f32 + 0.5);
            let before = rays.before_mask(px);
            let is_inside = (0..8).all(|k| {
                rays.before_mask(px + Vec2::from_angle(k as f32 * std::f32::consts::FRAC_PI_4)) == before
            });
            if !is_inside {
                continue;
            }
            compared += 1;
            let passes_first = layers.iter().position(|depths| mask[i] >= depths[i]);
            let drawn = (mask[i] > 0.0).then_some(passes_first).flatten();
            deepest = deepest.max(before.unwrap_or(0));
            assert_eq!(drawn, before, "pixel {px}");
        }
        assert!(
            compared > SIDE * SIDE / 2 && deepest >= 3,
            "{compared} pixels, at most {deepest} before the mask"
        );
    }
}

#[test]
fn a_designated_object_is_in_no_layer_and_stands_in_the_picture_in_its_own_style() {
    let mut session = session();
    let mut scene = behind_sheets();
    for (key, value) in [
        ("edges.profile.show", "false"),
        ("edges.inner.show", "false"),
        ("blueprint.fill_opacity", "0"),
        ("blueprint.fraction", "1"),
        ("blueprint.designated_color", "#ff0000"),
    ] {
        set(&mut scene, key, value);
    }
    draw(&mut session, &scene);
    let mut seen = 0;
    for geometry in common::captured_layers(&mut session, "layer geometry") {
        let surfels = texels::<[u32; 4]>(&mut session, &geometry);
        seen += surfels.iter().filter(|s| s[3] != 0).count();
        assert!(surfels.iter().all(|s| s[3] & 0x7fff_ffff != object_id(0)));
    }
    assert!(seen > 1000, "{seen}");
    let image = |session: &mut Session, opened: &Opened| common::image(session, opened, SIDE);
    let mask = mask_of(&mut session);
    let middle = mask.chunks(SIDE as usize).nth(SIDE as usize / 2).unwrap();
    let x = middle.iter().rposition(|depth| *depth > 0.0).unwrap() as u32 - 3;
    let [r, g, b, _] = image(&mut session, &scene).get_pixel(x, SIDE / 2).0;
    assert!(r > 250 && g == 0 && b == 0, "its highlight color: {r} {g} {b}");
    // Of any other technique it is what it is without the role.
    for technique in ["unlit", "gooch", "toon", "halftone"] {
        let mut own = scene.clone();
        let nodes = Arc::clone(&own.scene);
        let value = hachure::style::Value::Text(technique.to_owned());
        own.document.set_for(&nodes, &[0], "technique", &value).unwrap();
        let with = image(&mut session, &own);
        designate(&mut own, &[0], false);
        assert!(with == image(&mut session, &own), "{technique}");
    }
}

#[test]
fn what_opaque_objects_hide_of_the_mask_is_counted_and_told() {
    let mut session = session();
    let mut scene = behind_sheets();
    set(&mut scene, "blueprint.fraction", "1");
    let report = draw(&mut session, &scene);
    assert_eq!((report.hidden, report.shortfall()), (0, None));
    // The foremost sheet hides a strip on the left.
    let nodes = Arc::clone(&scene.scene);
    scene
        .document
        .set_for(&nodes, &[4], "technique", &hachure::style::Value::Text("unlit".to_owned()))
        .unwrap();
    let report = draw(&mut session, &scene);
    let mask = mask_of(&mut session);
    let geometry = common::captured(&mut session, "geometry").unwrap();
    let front = texels::<[u32; 4]>(&mut session, &geometry);
    let hidden =
        mask.iter().zip(&front).filter(|(m, f)| **m > 0.0 && f[3] & 0x7fff_ffff == object_id(4)).count();
    assert!(hidden > 100, "{hidden}");
    assert_eq!(report.hidden as usize, hidden);
    assert!(report.shortfall().unwrap().contains("opaque objects hide"), "{:?}", report.shortfall());
}

#[test]
fn the_limit_of_layers_is_lifted_until_enough_is_uncovered() {
    let mut session = session();
    for scene in [behind_sheets(), among_rings()] {
        let mut all = scene;
        set(&mut all, "blueprint.fraction", "1");
        let unlimited = draw(&mut session, &all);
        set(&mut all, "blueprint.max_layers", "2");
        let limited = draw(&mut session, &all);
        assert_eq!(limited.ended, LayersEnd::MaskUncovered);
        assert!(
            limited.layers > 2 && limited.layers == unlimited.layers && limited.pixels == unlimited.pixels
        );
        assert_eq!(limited.shortfall(), None);
        // Where nothing of it is in the picture there is nothing to lift it for, in the first picture and in the next.
        Arc::make_mut(&mut all.scene).nodes[0].world_from_local =
            DMat4::from_translation(DVec3::new(90.0, 0.0, -1.0));
        for _ in 0..2 {
            let outside = draw(&mut session, &all);
            assert_eq!((outside.masked, outside.layers, outside.ended), (0, 2, LayersEnd::MaxLayers));
        }
    }
}

#[test]
fn what_cannot_be_uncovered_is_told() {
    let mut session = session();
    let mut scene = behind_sheets();
    set(&mut scene, "blueprint.fraction", "1");
    set(&mut scene, "blueprint.to", "2");
    let report = draw(&mut session, &scene);
    assert_eq!((report.layers, report.ended), (2, LayersEnd::MaxLayers));
    let told = report.shortfall().unwrap();
    assert!(told.contains("after 2 layers, not 100 %") && told.contains("blueprint.to"), "{told}");
    assert!(report.share_uncovered() > 0.0 && report.share_uncovered() < 0.9);

    // No layer has so many pixels: not even the first one is drawn, and R is that of the layer which ended it.
    set(&mut scene, "blueprint.to", "64");
    set(&mut scene, "blueprint.min_coverage", "90");
    let report = draw(&mut session, &scene);
    assert_eq!((report.layers, report.ended), (0, LayersEnd::TooFewPixels));
    assert!(report.passed[0] > 0 && report.uncovered() == report.passed[0]);
    assert!(report.shortfall().unwrap().contains("blueprint.min_coverage"));
}

#[test]
fn without_a_mask_in_the_picture_the_plain_rules_hold() {
    let mut session = session();
    let plain = {
        let mut scene = behind_sheets();
        designate(&mut scene, &[0], false);
        scene.document.node_mut("/cube").visible = Some(false);
        scene
    };
    assert!(plain.document.role_faults(&plain.scene).is_empty());
    let report = draw(&mut session, &plain);
    assert!(common::captured(&mut session, "depth mask").is_none());
    assert_eq!((report.layers, report.masked), (4, 0));

    let mut hidden = behind_sheets();
    hidden.document.node_mut("/cube").visible = Some(false);
    let of_hidden = draw(&mut session, &hidden);
    assert!(common::captured(&mut session, "depth mask").is_none());
    assert_eq!(of_hidden.pixels, report.pixels);
    assert!(
        hidden.document.role_faults(&hidden.scene)[0].to_string().contains("/cube: is designated but hidden")
    );

    let mut outside = behind_sheets();
    Arc::make_mut(&mut outside.scene).nodes[0].world_from_local =
        DMat4::from_translation(DVec3::new(90.0, 0.0, -1.0));
    set(&mut outside, "blueprint.fraction", "0");
    let of_outside = draw(&mut session, &outside);
    assert!(mask_of(&mut session).iter().all(|d| *d == 0.0));
    assert_eq!((of_outside.masked, &of_outside.pixels), (0, &report.pixels));
    assert_eq!((of_outside.ended, of_outside.shortfall()), (LayersEnd::TooFewPixels, None));

    let mut all = behind_sheets();
    designate(&mut all, &[0, 1, 2, 3, 4], true);
    session.set_scene(&all).unwrap();
    session.draw(&all, [SIDE; 2], false).unwrap();
    assert!(session.renderer().layer_reports().unwrap().is_empty());
    assert!(
        all.document.role_faults(&all.scene)[0].to_string().contains("no layers are drawn to uncover it")
    );
}

#[test]
fn beyond_the_mask_nothing_is_drawn_on_demand() {
    let mut session = session();
    let mut scene = designated(
        vec![
            object("cube", primitives::cube(0.5), DMat4::IDENTITY),
            object("before", primitives::plane(1.0), at(0.3, 0.3, 0.8)),
            object("behind", primitives::plane(2.0), at(0.0, 0.0, -0.8)),
        ],
        DVec3::Z,
    );
    set(&mut scene, "blueprint.by_distance", "0");
    set(&mut scene, "blueprint.fill_opacity", "0.3");
    let whole = common::image(&mut session, &scene, SIDE);
    set(&mut scene, "blueprint.beyond", "false");
    let cut = common::image(&mut session, &scene, SIDE);
    let mut without = scene.clone();
    without.document.node_mut("/behind").visible = Some(false);
    let expected = common::image(&mut session, &without, SIDE);
    assert!(cut == expected && cut != whole);
    // Beside the mask too: it is farther than all of it.
    assert_ne!(whole.get_pixel(20, 70), cut.get_pixel(20, 70));
    // Without a mask there is nothing beyond it.
    designate(&mut scene, &[0], false);
    let plain = common::image(&mut session, &scene, SIDE);
    set(&mut scene, "blueprint.beyond", "true");
    assert!(plain == common::image(&mut session, &scene, SIDE));
}

#[test]
fn mirrors_show_layers_of_their_own_view() {
    let mut session = session();
    // A ball in a box, before a mirror that stands beside them.
    let mut scene = designated(
        vec![
            object("ball", primitives::sphere(0.3, 16, 24), DMat4::IDENTITY),
            object("box", primitives::cube(1.0), DMat4::IDENTITY),
            ("glass", primitives::plane(4.0), DMat4::from_translation(DVec3::NEG_Z), [1.0; 3]),
        ],
        DVec3::new(0.8, 0.3, 1.0),
    );
    let nodes = Arc::clone(&scene.scene);
    scene.document.set_role(&nodes, &[2], Role::Mirror, true);
    let parameters = [("technique", "unlit"), ("edges.profile.show", "false"), ("edges.inner.show", "false")];
    for (key, value) in parameters {
        scene.document.set_for(&nodes, &[2], key, &hachure::style::Value::parse(value)).unwrap();
    }
    set(&mut scene, "blueprint.fill_opacity", "0.1");
    set(&mut scene, "blueprint.designated_color", "#ff0000");
    let mut pictures = ["0", "1"].map(|fraction| {
        set(&mut scene, "blueprint.fraction", fraction);
        session.set_scene(&scene).unwrap();
        let picture = session.draw(&scene, [SIDE; 2], false).unwrap();
        let objects = common::objects_in_front(&mut session, &picture);
        let image = common::image(&mut session, &scene, SIDE);
        let seen: Vec<[u8; 4]> = objects
            .into_iter()
            .zip(image.pixels())
            .map(|(object, pixel)| if object == object_id(2) { pixel.0 } else { [0; 4] })
            .collect();
        seen
    });
    let [none, all] = &mut pictures;
    let differ = none.iter().zip(all.iter()).filter(|(a, b)| a != b).count();
    assert!(differ > 100, "{differ} pixels of the mirror");
    let red = |pixels: &[[u8; 4]]| pixels.iter().filter(|p| p[0] / 2 > p[1] && p[3] > 0).count();
    assert!(red(none) > 20 && red(all) > 20, "the ball in the mirror");
}
