//! Many samples of one picture: where they lie, what their mean is, and that no other picture is in it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::sync::Arc;

use common::outline::{coverage, outline};
use common::{opened, scene, session, set, surfels, texels};
use glam::{DMat4, DQuat, DVec2, DVec3};
use hachure::app::screenshot::{ScreenshotError, Shot};
use hachure::document::Document;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::import::Progress;
use hachure::render::{Picture, Request, Sample};
use hachure::scene::{Camera, NodeId, Projection, Scene};

const SIDE: u32 = 48;

/// A cube in one flat color without lines.
fn cube(turn: DQuat) -> Opened {
    let scene = scene(vec![("cube", primitives::cube(2.0), DMat4::from_quat(turn), [0.8, 0.3, 0.1])]);
    let mut opened = opened(&scene, DVec3::Z);
    for (key, value) in
        [("technique", "unlit"), ("edges.profile.show", "false"), ("edges.inner.show", "false")]
    {
        set(&mut opened, key, value);
    }
    opened
}

fn slanted() -> Opened {
    cube(DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.7, 0.3))
}

fn sample(session: &mut Session, opened: &Opened, samples: u32, selected: &[NodeId]) -> Picture {
    let camera = opened.document.camera.unwrap();
    let request = Request {
        document: &opened.document,
        camera: &camera,
        size: [SIDE, SIDE],
        transparent: true,
        selected,
        samples,
    };
    session.renderer().render(&request).unwrap()
}

fn pixels(session: &mut Session, picture: &Picture) -> Vec<[u8; 4]> {
    texels(session, &picture.image)
}

/// The picture with all its samples.
fn smooth(session: &mut Session, opened: &Opened, samples: u32) -> Vec<[u8; 4]> {
    let mut picture = sample(session, opened, samples, &[]);
    while !picture.sample.is_last() {
        picture = sample(session, opened, samples, &[]);
    }
    pixels(session, &picture)
}

/// Mean absolute and mean signed difference to the exact coverage, over all pixels that are covered in part.
fn error(session: &mut Session, opened: &Opened, samples: u32) -> (f64, f64) {
    let polygon = outline(opened, [SIDE; 2]);
    let (mut count, mut absolute, mut signed) = (0.0, 0.0, 0.0);
    for (i, pixel) in smooth(session, opened, samples).into_iter().enumerate() {
        let px = DVec2::new(f64::from(i as u32 % SIDE), f64::from(i as u32 / SIDE));
        let exact = coverage(&polygon, px);
        let difference = f64::from(pixel[3]) / 255.0 - exact;
        if exact > 1e-9 && exact < 1.0 - 1e-9 {
            count += 1.0;
            absolute += difference.abs();
            signed += difference;
        } else {
            assert!(difference.abs() < 0.01, "{px}: {exact}");
        }
    }
    assert!(count > 50.0, "nothing to see");
    (absolute / count, signed / count)
}

#[test]
fn every_sample_sees_the_scene_moved_by_its_jitter() {
    let mut session = session();
    let mut opened = cube(DQuat::IDENTITY);
    // A pixel is 0.1 wide: the edges of the front are at 48/2 ± 10 pixels, and a bit to the right and up.
    let shift = DVec3::new(0.033, 0.021, 0.0);
    opened.document.camera = Some(Camera {
        position: DVec3::Z * 10.0 - shift,
        focal_point: -shift,
        view_up: DVec3::Y,
        projection: Projection::Orthographic { view_height: 0.1 * f64::from(SIDE) },
    });
    session.set_scene(&opened).unwrap();
    let (left, top) = (24.0 - 10.0 + 0.33, 24.0 - 10.0 - 0.21);
    let mut places = std::collections::BTreeSet::new();
    for index in 0..32 {
        let picture = sample(&mut session, &opened, 32, &[]);
        assert_eq!(picture.sample, Sample { index, of: 32 });
        let jitter = picture.sample.jitter().as_dvec2();
        let buffer = surfels(&mut session, &picture);
        let first = |edge: f64| (edge - 0.5).ceil() as u32;
        let (x, y) = (first(left + jitter.x), first(top + jitter.y));
        let covered = |x: u32, y: u32| buffer[(y * SIDE + x) as usize].object != 0;
        assert!(covered(x, 24) && !covered(x - 1, 24), "sample {index}: {x}");
        assert!(covered(24, y) && !covered(24, y - 1), "sample {index}: {y}");
        places.insert((x, y));
    }
    assert_eq!(places.len(), 4, "the edges move by a pixel, in both directions: {places:?}");
}

#[test]
fn a_point_picked_in_any_sample_lies_on_the_surface() {
    let mut session = session();
    let opened = slanted();
    session.set_scene(&opened).unwrap();
    let local_from_world = opened.scene.nodes[0].world_from_local.inverse();
    for _ in 0..8 {
        let picture = sample(&mut session, &opened, 8, &[]);
        session.renderer().start_pick([20, 27]).unwrap();
        session.renderer().gpu().wait().unwrap();
        let point = session.renderer().poll_pick().unwrap().point.unwrap();
        let distance = local_from_world.transform_point3(point).abs().max_element() - 1.0;
        assert!(distance.abs() < 1e-4, "{:?}: {distance}", picture.sample);
    }
}

#[test]
fn the_mean_of_64_samples_is_the_covered_area() {
    let mut session = session();
    for parallel in [false, true] {
        let mut opened = slanted();
        opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(parallel));
        session.set_scene(&opened).unwrap();
        let [one, four, sixteen, many] = [1, 4, 16, 64].map(|n| error(&mut session, &opened, n));
        assert!(many.0 < 0.03 && many.1.abs() < 0.01, "{many:?}");
        assert!(one.0 > four.0 && four.0 > sixteen.0 && sixteen.0 > many.0);
    }
}

#[test]
fn the_first_sample_and_what_is_flat_are_the_plain_picture() {
    let mut session = session();
    let opened = slanted();
    session.set_scene(&opened).unwrap();
    let first = sample(&mut session, &opened, 64, &[]);
    let first = pixels(&mut session, &first);
    session.set_scene(&opened).unwrap();
    let plain = smooth(&mut session, &opened, 1);
    assert!(first == plain);
    // But it is no part of a picture of more.
    assert_eq!(sample(&mut session, &opened, 64, &[]).sample, Sample { index: 0, of: 64 });
    // Inside the cube and outside of it, the mean of equal colors is that color, bit for bit.
    let many = smooth(&mut session, &opened, 64);
    let polygon = outline(&opened, [SIDE; 2]);
    let differing = (0..many.len()).filter(|&i| many[i] != plain[i]).collect::<Vec<_>>();
    assert!(differing.len() > 50);
    for i in differing {
        let px = DVec2::new(f64::from(i as u32 % SIDE), f64::from(i as u32 / SIDE));
        assert!((1e-9..1.0 - 1e-9).contains(&coverage(&polygon, px)), "{px}");
    }
}

/// Strokes of a picture of one sample are crisp: they must not come from the first of many, nor go into their mean.
#[test]
fn a_hatched_picture_of_one_sample_is_the_same_whatever_was_drawn_before() {
    let mut session = session();
    let mut opened = slanted();
    set(&mut opened, "technique", "hatching");
    // So far apart that they are crisp in a small picture too.
    set(&mut opened, "hatching.stroke.spacing", "40");
    let mut images = |samples: [u32; 2]| {
        session.set_scene(&opened).unwrap();
        samples.map(|samples| {
            session.set_samples(samples);
            session.image(&opened, [240; 2], true).unwrap()
        })
    };
    let [one, four] = images([1, 4]);
    assert!(one != four);
    assert!(images([4, 1]) == [four, one]);
}

#[test]
fn any_change_begins_a_new_picture_without_ghosts() {
    let mut session = session();
    let start = slanted();
    let other: Arc<Scene> = scene(vec![("ball", primitives::sphere(1.0, 24, 36), DMat4::IDENTITY, [0.2; 3])]);
    let turned = start.document.camera.unwrap().orbited(DVec3::Y, 20.0, 0.0);
    let changes: [(&str, &dyn Fn(&mut Document)); 7] = [
        ("camera", &|d| d.camera = Some(turned)),
        ("style", &|d| d.style.technique = hachure::style::Technique::Plain),
        ("lines", &|d| d.style.edges.profile.show = true),
        ("visibility", &|d| d.node_mut("/cube").visible = Some(false)),
        ("light", &|d| d.lighting.key.show = false),
        ("paper", &|d| d.view.background = Some(hachure::style::Color([1, 2, 3]))),
        ("nothing at all", &|_| {}),
    ];
    for (what, change) in changes {
        let mut changed = start.clone();
        change(&mut changed.document);
        session.set_scene(&start).unwrap();
        let fresh = smooth(&mut session, &changed, 16);
        session.set_scene(&start).unwrap();
        for _ in 0..9 {
            sample(&mut session, &start, 16, &[]);
        }
        let again = smooth(&mut session, &changed, 16);
        assert!(again == fresh, "{what}");
    }
    let ball = Opened { scene: other, ..start.clone() };
    session.set_scene(&ball).unwrap();
    assert_eq!(sample(&mut session, &ball, 16, &[]).sample.index, 0);
    // A buffer is shown as it is; afterwards the drawing begins anew.
    let mut buffer = ball.clone();
    set(&mut buffer, "view.show", "normals");
    assert!(sample(&mut session, &buffer, 16, &[]).sample.is_last());
    assert_eq!(sample(&mut session, &ball, 16, &[]).sample.index, 0);
    assert_eq!(sample(&mut session, &ball, 16, &[]).sample.index, 1);
    assert!(sample(&mut session, &ball, 1, &[]).sample.is_last(), "fewer samples than there are");
}

#[test]
fn a_screenshot_is_drawn_beside_the_window_and_disturbs_nothing() {
    let mut session = session();
    let opened = slanted();
    session.set_scene(&opened).unwrap();
    let shot = |session: &mut Session| Shot {
        renderer: session.renderer().fork(),
        document: opened.document.clone(),
        size: [SIDE, SIDE],
        transparent: true,
        samples: 16,
    };
    sample(&mut session, &opened, 64, &[]);
    let progress = Progress::default();
    let beside = shot(&mut session);
    let taken = std::thread::scope(|scope| {
        let taken = scope.spawn(|| beside.take(&progress).unwrap());
        for index in 1..20 {
            assert_eq!(sample(&mut session, &opened, 64, &[]).sample.index, index);
        }
        taken.join().unwrap()
    });
    assert_eq!(progress.share(), 1.0);
    session.set_scene(&opened).unwrap();
    assert!(taken.pixels().map(|p| p.0).collect::<Vec<_>>() == smooth(&mut session, &opened, 16));
    // What is complete already is not drawn once more, and more samples go on from there.
    let complete = sample(&mut session, &opened, 16, &[]);
    assert!(complete.sample.is_last());
    let mut fork = session.renderer().fork();
    let mut again = |samples| {
        let camera = opened.document.camera.unwrap();
        let (document, size) = (&opened.document, [SIDE, SIDE]);
        let request = Request { document, camera: &camera, size, transparent: true, selected: &[], samples };
        fork.render(&request).unwrap()
    };
    let (same, finer) = (again(16), again(20));
    assert_eq!((same.sample.index, finer.sample.index), (15, 16));
    assert!(pixels(&mut session, &same) == pixels(&mut session, &complete));
    progress.cancel();
    assert!(matches!(shot(&mut session).take(&progress), Err(ScreenshotError::Canceled)));
}

#[test]
fn a_complete_picture_stays_and_a_selection_changes_nothing_in_it() {
    let mut session = session();
    let opened = slanted();
    session.set_scene(&opened).unwrap();
    let mut outlines = Vec::new();
    for index in 0..8 {
        let picture = sample(&mut session, &opened, 8, if index < 2 { &[] } else { &[0] });
        assert_eq!(picture.sample.index, index, "a selection does not begin a new picture");
        if let Some(outline) = &picture.selection {
            outlines.push(texels::<[u8; 4]>(&mut session, outline));
        }
    }
    assert!(outlines.len() == 6 && outlines.iter().all(|o| *o == outlines[0]), "outlines stand still");
    let before = session.renderer().runs();
    let complete = sample(&mut session, &opened, 8, &[0]);
    assert!(complete.sample.is_last());
    assert_eq!(session.renderer().runs(), before);
    assert!(pixels(&mut session, &complete) == smooth(&mut session, &opened, 8));
}
