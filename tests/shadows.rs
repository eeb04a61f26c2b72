//! Shadows against rays that are cast from what each pixel shows to the lights, and what must hold of them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the measurement is printed")]

mod common;

use std::sync::Arc;

use common::{at, draw, image, opened, sample, scene, session, set, surfels, texels};
use glam::{DMat4, DQuat, DVec3, UVec2, Vec2, Vec3};
use hachure::document::Document;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::bvh::Bvh;
use hachure::geometry::primitives;
use hachure::render::Request;
use hachure::render::View;
use hachure::scene::{Camera, Light, LightKind, Scene};

/// As in `shaders/passes/shadow_mask.wgsl`: light that grazes a surface at less than this cosine lights nothing.
const GRAZING: f64 = 1e-3;

/// A square that faces up.
fn floor(size: f64) -> DMat4 {
    DMat4::from_scale_rotation_translation(
        DVec3::splat(size),
        DQuat::from_rotation_x(-90_f64.to_radians()),
        DVec3::ZERO,
    )
}

/// All triangles in world space.
fn triangles(scene: &Scene) -> Vec<[DVec3; 3]> {
    let objects = scene.nodes.iter().filter_map(|n| Some((n, scene.meshes.get(n.mesh?)?)));
    objects
        .flat_map(|(node, mesh)| {
            mesh.indices.chunks_exact(3).map(|corners| {
                [0, 1, 2].map(|i| {
                    let local = mesh.positions[corners[i] as usize].as_dvec3();
                    node.world_from_local.transform_point3(local)
                })
            })
        })
        .collect()
}

/// Throws shadows in the light of these lights, which stand in the world.
fn lit_by(opened: &mut Opened, kinds: &[LightKind]) {
    let light = |kind: &LightKind| Light {
        kind: *kind,
        color: Vec3::ONE,
        intensity: 1.0,
        attached_to_camera: false,
        casts_shadow: true,
    };
    opened.document.lights = kinds.iter().map(light).collect();
    set(opened, "light.source", "file");
    set(opened, "light.shadows", "on");
}

fn without_lines(opened: &mut Opened) {
    set(opened, "edges.profile.show", "off");
    set(opened, "edges.inner.show", "off");
}

fn directional(x: f64, y: f64, z: f64) -> LightKind {
    LightKind::Directional { direction: -DVec3::new(x, y, z).normalize() }
}

/// Of a picture: how many pixels are farther than 2 px from the border of a ray-cast shadow, how many of them are
/// wrong in the mask, and how many lie in shadow.
#[derive(Debug, Default, Clone, Copy)]
struct Score {
    counted: usize,
    wrong: usize,
    shadowed: usize,
}

impl Score {
    fn share(&self) -> f64 {
        self.wrong as f64 / self.counted.max(1) as f64
    }
}

/// The score of each light.
fn scores(session: &mut Session, opened: &Opened, bvh: &Bvh, side: u32) -> Vec<Score> {
    let picture = draw(session, opened, side);
    let surfels = surfels(session, &picture);
    let mask = common::captured(session, "shadow mask").unwrap();
    let mask: Vec<[u8; 4]> = texels(session, &mask);
    let bounds = opened.scene.bounds();
    let view = View::new(&opened.document.camera.unwrap(), &bounds, UVec2::splat(side));
    let world_from_view = view.view_from_world.inverse();
    // Devices interpolate depth less exactly than they store it: a ray from that far below a surface would find the surface itself.
    let step = bounds.diagonal() * 1e-5;
    let n = side as i32;
    let lights = opened.document.lights.iter().enumerate();
    lights
        .map(|(channel, light)| {
            let truth: Vec<Option<bool>> = (0..n * n)
                .map(|i| {
                    let surfel = &surfels[i as usize];
                    if surfel.object == 0 {
                        return None;
                    }
                    let px = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5);
                    let point = view.unproject(px, surfel.depth);
                    let normal = world_from_view.transform_vector3(surfel.face_normal.as_dvec3()).normalize();
                    let (towards, reach) = match light.kind {
                        LightKind::Directional { direction } => (-direction, f64::INFINITY),
                        LightKind::Point { position } => (position - point, 1.0),
                    };
                    let origin = point + normal * step;
                    let faces = normal.dot(towards.normalize()) > GRAZING;
                    Some(faces && bvh.any_hit(origin, towards, 0.0, reach, |_| false).is_none())
                })
                .collect();
            let at = |x: i32, y: i32| {
                if x < 0 || y < 0 || x >= n || y >= n { None } else { truth[(y * n + x) as usize] }
            };
            let mut score = Score::default();
            for y in 0..n {
                for x in 0..n {
                    let Some(is_lit) = at(x, y) else { continue };
                    let near_border = (-2..=2).any(|dy: i32| {
                        (-2..=2).any(|dx: i32| {
                            dx * dx + dy * dy <= 4 && at(x + dx, y + dy).is_some_and(|other| other != is_lit)
                        })
                    });
                    if near_border {
                        continue;
                    }
                    score.counted += 1;
                    score.shadowed += usize::from(!is_lit);
                    let shown = mask[(y * n + x) as usize][channel];
                    score.wrong += usize::from((shown >= 128) != is_lit);
                }
            }
            score
        })
        .collect()
}

/// The worst share of wrong pixels over lights and cameras is at most a thousandth.
fn check(session: &mut Session, name: &str, scene: &Arc<Scene>, kinds: &[LightKind], side: u32) {
    let bvh = Bvh::new(&triangles(scene));
    let mut worst = Score::default();
    let mut shadowed = 0;
    for (direction, parallel) in [(DVec3::new(0.4, 0.5, 1.0), false), (DVec3::new(-0.7, 0.9, 0.6), true)] {
        let mut opened = opened(scene, direction);
        opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(parallel));
        lit_by(&mut opened, kinds);
        for (light, score) in kinds.iter().zip(scores(session, &opened, &bvh, side)) {
            shadowed += score.shadowed;
            if score.share() > worst.share() {
                worst = score;
            }
            assert!(
                score.counted > 0 && score.share() <= 1e-3,
                "{name}, parallel {parallel}, {light:?}: {score:?}"
            );
        }
    }
    assert!(shadowed > 0, "{name}: no shadow to be seen");
    println!("{name:<12} worst {:.5} % ({} of {})", worst.share() * 100.0, worst.wrong, worst.counted);
}

/// Scenes that tempt shadow maps to err, each with the lights that do.
fn small_scenes() -> Vec<(&'static str, Arc<Scene>, Vec<LightKind>)> {
    let white = [0.8; 3];
    let ground = || ("floor", primitives::plane(1.0), floor(6.0), white);
    let lights = || {
        vec![
            directional(0.6, 1.0, 0.3),
            directional(-1.0, 0.25, 0.4),
            LightKind::Point { position: DVec3::new(1.5, 4.0, 2.5) },
            directional(0.0, 1.0, 0.0),
        ]
    };
    let upright = DMat4::from_rotation_y(0.5) * at(0.0, 0.75, 0.0);
    let room = vec![
        ground(),
        ("cube", primitives::cube(0.8), at(1.2, 0.4, 0.3), white),
        ("ball", primitives::sphere(0.4, 24, 36), at(-1.3, 0.6, 0.2), white),
        ("ring", primitives::torus(0.5, 0.1, 48, 16), at(0.0, 0.3, -1.4), white),
    ];
    vec![
        ("cube", scene(vec![ground(), ("cube", primitives::cube(1.5), at(0.0, 0.75, 0.0), white)]), lights()),
        (
            "sphere",
            scene(vec![ground(), ("ball", primitives::sphere(1.0, 32, 48), at(0.0, 1.0, 0.0), white)]),
            lights(),
        ),
        ("thin plate", scene(vec![ground(), ("plate", primitives::plane(1.5), upright, white)]), lights()),
        ("light amid", scene(room), vec![LightKind::Point { position: DVec3::new(0.1, 0.9, 0.2) }]),
    ]
}

fn sample_lights(scene: &Scene) -> [LightKind; 4] {
    let bounds = scene.bounds();
    let away = DVec3::new(-0.6, 0.9, 0.8).normalize() * bounds.diagonal();
    [
        directional(-0.5, 0.7, 0.75),
        directional(0.9, 0.3, 0.2),
        directional(0.1, 1.0, -0.2),
        LightKind::Point { position: bounds.center() + away },
    ]
}

#[test]
fn shadows_are_where_rays_find_them() {
    let mut session = session();
    for (name, scene, lights) in small_scenes() {
        check(&mut session, name, &scene, &lights, 256);
    }
    for name in ["crank", "ogre"] {
        let scene = sample(name).scene;
        check(&mut session, name, &scene, &sample_lights(&scene), 320);
    }
}

#[test]
#[ignore = "large; part of `make quality`"]
fn shadows_are_where_rays_find_them_in_large_pictures() {
    let mut session = session();
    for (name, scene, lights) in small_scenes() {
        check(&mut session, name, &scene, &lights, 800);
    }
    for name in ["crank", "ogre"] {
        let scene = sample(name).scene;
        check(&mut session, name, &scene, &sample_lights(&scene), 800);
    }
}

/// A cube above a floor, with a light that throws its shadow there.
fn cube_on_floor() -> (Arc<Scene>, Opened) {
    let white = [0.8; 3];
    let scene = scene(vec![
        ("floor", primitives::plane(1.0), floor(6.0), white),
        ("cube", primitives::cube(1.0), at(0.0, 0.9, 0.0), white),
    ]);
    let mut opened = opened(&scene, DVec3::new(0.2, 0.8, 1.0));
    lit_by(&mut opened, &[directional(0.5, 1.0, -0.3)]);
    set(&mut opened, "technique", "plain");
    without_lines(&mut opened);
    (scene, opened)
}

/// Which stages run again when a document changes.
fn runs(session: &mut Session, before: &Document, change: &dyn Fn(&mut Document)) -> Vec<&'static str> {
    let mut after = before.clone();
    change(&mut after);
    let mut counts = [before, &after].map(|document| {
        let camera: Camera = document.camera.unwrap();
        let request = Request {
            document,
            camera: &camera,
            size: [64, 64],
            transparent: false,
            selected: &[],
            samples: 1,
        };
        session.renderer().render(&request).unwrap();
        session.renderer().runs()
    });
    let [first, second] = &mut counts;
    first.iter().zip(second).filter(|(b, a)| b.1 != a.1).map(|(b, _)| b.0).collect()
}

#[test]
fn only_the_shadows_that_changed_are_found_again() {
    let mut session = session();
    let (_, opened) = cube_on_floor();
    session.set_scene(&opened).unwrap();
    let document = &opened.document;
    let mut runs = |change: &dyn Fn(&mut Document)| runs(&mut session, document, change);
    assert_eq!(runs(&|_| {}), [""; 0]);
    // A light that stands still keeps its map while the camera turns.
    assert_eq!(
        runs(&|d| d.camera = d.camera.map(|c| c.orbited(DVec3::Y, 10.0, 0.0))),
        ["g-buffer", "shadow", "surface", "image"]
    );
    assert_eq!(
        runs(&|d| d.lights[0].attached_to_camera = true),
        ["shadow", "surface", "shadow map", "image"]
    );
    assert_eq!(runs(&|d| d.lighting.shadow_density = 0.5), ["surface", "image"]);
    assert_eq!(runs(&|d| d.lighting.shadow_softness = 2.0), ["shadow", "surface", "image"]);
    assert_eq!(runs(&|d| d.view.background = Some("#ff0000".parse().unwrap())), ["image"]);
    // Without shadows nothing of them is drawn.
    let off: &dyn Fn(&mut Document) = &|d| d.lighting.shadows = false;
    assert_eq!(runs(off), ["surface", "image"]);
    let mut document = document.clone();
    off(&mut document);
    session.draw(&Opened { document, ..opened.clone() }, [64, 64], false).unwrap();
    session.draw(&Opened { document: Document::default(), ..opened }, [64, 64], false).unwrap();
    assert!(common::captured(&mut session, "shadow mask").is_none());
}

#[test]
fn a_light_that_reaches_everything_draws_what_it_draws_without_shadows() {
    let mut session = session();
    let ball = scene(vec![("ball", primitives::sphere(1.0, 48, 64), DMat4::IDENTITY, [0.7, 0.5, 0.3])]);
    for technique in ["plain", "gooch", "toon"] {
        let mut opened = opened(&ball, DVec3::new(0.2, 0.3, 1.0));
        lit_by(&mut opened, &[directional(0.2, 0.3, 1.0)]);
        set(&mut opened, "technique", technique);
        without_lines(&mut opened);
        set(&mut opened, "light.shadow_density", "0");
        let zero = image(&mut session, &opened, 128);
        set(&mut opened, "light.shadows", "off");
        let off = image(&mut session, &opened, 128);
        assert!(zero == off, "{technique}: no density is no shadow");
        if technique != "gooch" {
            set(&mut opened, "light.shadows", "on");
            set(&mut opened, "light.shadow_density", "1");
            let on = image(&mut session, &opened, 128);
            let differing = on.pixels().zip(off.pixels()).filter(|(a, b)| a != b).count();
            assert!(differing < 40, "{technique}: {differing} pixels of a lit ball changed");
        }
    }
}

#[test]
fn light_falls_through_holes_and_past_what_is_hidden() {
    let mut session = session();
    let (scene, mut opened) = cube_on_floor();
    let dark = |session: &mut Session, opened: &Opened| {
        let picture = draw(session, opened, 128);
        let surfels = surfels(session, &picture);
        let mask = common::captured(session, "shadow mask").unwrap();
        let mask: Vec<[u8; 4]> = texels(session, &mask);
        surfels.iter().zip(&mask).filter(|(s, m)| s.object == 1 && m[0] < 128).count()
    };
    assert!(dark(&mut session, &opened) > 100, "the floor has a shadow");
    opened.document.node_mut("/cube").visible = Some(false);
    assert_eq!(dark(&mut session, &opened), 0, "what is hidden throws none");
    opened.document.node_mut("/cube").visible = None;
    let mut holes = (*scene).clone();
    holes.materials[1].alpha = hachure::scene::AlphaMode::Mask(0.5);
    holes.materials[1].base_color.w = 0.2;
    let mut mesh = primitives::cube_split(1.0);
    mesh.submeshes.iter_mut().for_each(|part| part.material = 1);
    holes.meshes[1] = Arc::new(mesh);
    opened.scene = Arc::new(holes);
    assert_eq!(dark(&mut session, &opened), 0, "what is all holes throws none");
}

#[test]
fn soft_borders_are_wider_the_farther_they_fall_and_smooth_in_the_mean() {
    let mut session = session();
    let white = [0.8; 3];
    // Seen from above, the shadow of an upright plate runs away from it along X.
    let upright = at(0.0, 1.0, 0.0) * DMat4::from_rotation_y(90_f64.to_radians());
    let scene = scene(vec![
        ("floor", primitives::plane(1.0), floor(8.0), white),
        ("plate", primitives::plane(2.0), upright, white),
    ]);
    let mut opened = opened(&scene, DVec3::new(0.0, 1.0, 0.001));
    opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(true));
    lit_by(&mut opened, &[directional(-1.0, 1.0, 0.0)]);
    set(&mut opened, "light.shadow_softness", "4");
    draw(&mut session, &opened, 256);
    let mask = common::captured(&mut session, "shadow mask").unwrap();
    let mask: Vec<[u8; 4]> = texels(&mut session, &mask);
    // How wide the soft border along the shadow's side is in a column.
    let gray = |x: usize| (0..256).filter(|y| (16..240).contains(&mask[y * 256 + x][0])).count();
    let (near, far) = (gray(133), gray(180));
    assert!(near <= 4 && far >= near + 4, "near {near} px, far {far} px");
    session.set_samples(16);
    set(&mut opened, "technique", "plain");
    let mean = image(&mut session, &opened, 256);
    let column: Vec<u8> = (0..128).map(|y| mean.get_pixel(180, y).0[0]).collect();
    let steps = column.windows(2).map(|w| w[0].abs_diff(w[1])).max().unwrap();
    let range = column.iter().max().unwrap() - column.iter().min().unwrap();
    assert!(range > 60 && steps < range / 2, "a step of {steps} in {range}");
}
