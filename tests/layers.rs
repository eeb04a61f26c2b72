//! Depth layers: how many are recorded is guessed from reports about earlier pictures, and no guess is ever seen.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::path::Path;

use common::{opened, scene, session, set, texels};
use glam::{DMat4, DVec3};
use hachure::export::Session;
use hachure::export::session::{Opened, open};
use hachure::geometry::primitives;
use hachure::import::Progress;
use hachure::render::{LayersBy, Reported, Request};

/// Squares behind each other, of which all layers are drawn.
fn stack(planes: usize) -> Opened {
    let objects = (0..planes).map(|i| {
        let place = DMat4::from_translation(DVec3::Z * (-0.05 * i as f64));
        ("plane", primitives::plane(1.0), place, [1.0; 3])
    });
    blueprint(opened(&scene(objects.collect()), DVec3::new(0.1, 0.2, 1.0)))
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
    assert_eq!(session.renderer().last_peeled(), [Some((counted[0].clone(), LayersBy::Lists))]);
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
    assert_eq!(session.renderer().last_peeled()[0].as_ref().map(|(p, _)| p.layers), Some(5));
}

/// What a layer consists of, texel by texel.
type Texels = (Vec<[u32; 4]>, Vec<u32>, Vec<u32>, Vec<u32>, Vec<u32>);

/// All layers of the only group, and how they were made.
fn layers(session: &mut Session, opened: &Opened, side: u32, by: &str) -> (Vec<Texels>, LayersBy) {
    let mut opened = opened.clone();
    set(&mut opened, "view.layers", by);
    session.renderer().keep_layers();
    let picture = session.draw(&opened, [side; 2], false).unwrap();
    assert_eq!(picture.layers.len(), 1, "one group");
    let layers = picture.layers[0].iter().map(|layer| {
        (
            texels(session, &layer.gbuffer.geometry),
            texels(session, &layer.gbuffer.base_color),
            texels(session, &layer.gbuffer.region),
            texels(session, &layer.gbuffer.depth),
            texels(session, &layer.order),
        )
    });
    let layers = layers.collect();
    (layers, session.renderer().last_peeled()[0].as_ref().unwrap().1)
}

/// Draws the layers of a scene in both ways and compares them texel by texel; returns how many there are.
fn check_same_layers(name: &str, opened: &Opened, side: u32) -> u32 {
    let mut session = session();
    session.set_scene(opened).unwrap();
    let (peeled, by) = layers(&mut session, opened, side, "peeling");
    assert_eq!(by, LayersBy::Peeling);
    let counted = session.renderer().peeled().unwrap().remove(0);
    let (cut, by) = layers(&mut session, opened, side, "auto");
    assert_eq!(by, LayersBy::Lists);
    let mut counted_too = session.renderer().peeled().unwrap().remove(0);
    assert!(counted_too.fragments >= counted.pixels.iter().sum());
    counted_too.fragments = 0;
    assert_eq!(counted, counted_too, "{name}");
    let drawn = counted.layers as usize;
    assert!(drawn > 0, "{name}");
    for (number, (a, b)) in peeled.iter().zip(&cut).enumerate().take(drawn) {
        assert!(a.4 == b.4, "{name}: order of layer {number}");
        assert!(a.3 == b.3, "{name}: depth of layer {number}");
        assert!(a.0 == b.0, "{name}: geometry of layer {number}");
        assert!(a.2 == b.2, "{name}: regions of layer {number}");
        assert!(a.1 == b.1, "{name}: base colour of layer {number}");
    }
    counted.layers
}

fn blueprint(mut opened: Opened) -> Opened {
    for (key, value) in [("technique", "blueprint"), ("blueprint.layers", "64"), ("blueprint.least", "0")] {
        set(&mut opened, key, value);
    }
    opened
}

fn sample(name: &str) -> Opened {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/models/{name}.glb"));
    blueprint(open(&[path], None, &Progress::default()).unwrap())
}

#[test]
fn lists_give_the_layers_that_peeling_gives() {
    for (name, least) in [("crank", 8), ("ogre", 4), ("still_life", 4), ("temple", 8)] {
        let count = check_same_layers(name, &sample(name), 160);
        assert!(count >= least, "{name}: {count}");
    }
}
