//! Depth layers: how many are recorded is guessed from reports about earlier pictures, and no guess is ever seen.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{opened, scene, session, set};
use glam::{DMat4, DVec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::render::{Reported, Request};

/// Squares behind each other, of which all layers are drawn.
fn stack(planes: usize) -> Opened {
    let objects = (0..planes).map(|i| {
        let place = DMat4::from_translation(DVec3::Z * (-0.05 * i as f64));
        ("plane", primitives::plane(1.0), place, [1.0; 3])
    });
    let mut opened = opened(&scene(objects.collect()), DVec3::new(0.1, 0.2, 1.0));
    for (key, value) in [("technique", "blueprint"), ("blueprint.layers", "64"), ("blueprint.least", "0")] {
        set(&mut opened, key, value);
    }
    opened
}

/// Draws one sample without waiting for it.
fn render(session: &mut Session, opened: &Opened) {
    let request = Request {
        document: &opened.document,
        camera: &opened.document.camera.unwrap(),
        size: [64; 2],
        transparent: false,
        selected: &[],
        samples: 1,
    };
    session.renderer().render(&request).unwrap();
}

#[test]
fn what_a_frame_counted_is_reported_after_it() {
    let mut session = session();
    let three = stack(3);
    session.set_scene(&three).unwrap();
    assert_eq!(session.renderer().take_reports(), Reported::Complete);
    render(&mut session, &three);
    session.renderer().gpu().wait().unwrap();
    assert_eq!(session.renderer().take_reports(), Reported::Complete);
    let counted = session.renderer().peeled().unwrap();
    assert_eq!(counted[0].layers, 3);
    assert_eq!(session.renderer().last_peeled(), [Some(counted[0].clone())]);
}

#[test]
fn more_layers_than_were_guessed_are_found_missing_and_drawn() {
    let mut session = session();
    let (few, many) = (stack(3), stack(30));
    session.set_scene(&few).unwrap();
    session.draw(&few, [64; 2], false).unwrap();

    // So many layers nobody expected, and the first picture says so.
    session.set_scene(&many).unwrap();
    render(&mut session, &many);
    session.renderer().gpu().wait().unwrap();
    assert!(session.renderer().peeled().unwrap()[0].layers < 30);
    assert_eq!(session.renderer().take_reports(), Reported::Incomplete);
    render(&mut session, &many);
    session.renderer().gpu().wait().unwrap();
    assert_eq!(session.renderer().take_reports(), Reported::Complete);
    assert_eq!(session.renderer().peeled().unwrap()[0].layers, 30);
}

#[test]
fn no_incomplete_sample_has_a_part_in_a_picture() {
    let (mut fresh, mut used) = (session(), session());
    let (few, many) = (stack(2), stack(12));
    for session in [&mut fresh, &mut used] {
        session.set_samples(4);
    }
    used.set_scene(&few).unwrap();
    used.draw(&few, [64; 2], false).unwrap();
    let [expected, image] = [fresh, used].map(|mut session| common::image(&mut session, &many, 64));
    assert!(image == expected);
}

#[test]
fn a_report_that_is_outstanding_survives_a_resize_and_another_scene() {
    let mut session = session();
    let three = stack(3);
    session.set_scene(&three).unwrap();
    render(&mut session, &three);
    let five = stack(5);
    session.set_scene(&five).unwrap();
    session.draw(&five, [40, 90], false).unwrap();
    assert_eq!(session.renderer().last_peeled()[0].as_ref().map(|p| p.layers), Some(5));
}
