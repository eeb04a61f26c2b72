//! How many layers are recorded, and how much room there is, is guessed from reports about earlier pictures.

use hachure::gpu::Gpu;
use hachure::render::{LayerMethod, Reason, Reported};

use crate::common::{self, session, set};
use crate::{render, stack, way};

#[test]
fn what_a_frame_counted_is_reported_after_it() {
    let mut session = session();
    let three = stack(3, 1.0);
    session.set_scene(&three).unwrap();
    assert_eq!(session.renderer().take_reports(), Reported::Complete);
    render(&mut session, &three, [64; 2]);
    session.renderer().gpu().wait().unwrap();
    assert_eq!(session.renderer().take_reports(), Reported::Complete);
    let counted = session.renderer().layer_reports().unwrap();
    assert_eq!(counted[0].layers, 3);
    assert_eq!(session.renderer().last_layer_reports(), [Some((counted[0].clone(), LayerMethod::Lists))]);
}

#[test]
fn more_layers_than_were_guessed_are_found_missing_and_drawn() {
    let mut session = session();
    let (few, many) = (stack(3, 1.0), stack(30, 1.0));
    session.set_scene(&few).unwrap();
    session.draw(&few, [64; 2], false).unwrap();

    // So many layers nobody expected, and each picture without them all says so.
    session.set_scene(&many).unwrap();
    let mut drawn = Vec::new();
    let reported = loop {
        render(&mut session, &many, [64; 2]);
        session.renderer().gpu().wait().unwrap();
        drawn.push(session.renderer().layer_reports().unwrap()[0].layers);
        let reported = session.renderer().take_reports();
        if reported == Reported::Complete || drawn.len() == 5 {
            break reported;
        }
        assert_eq!(reported, Reported::Incomplete);
        assert!(drawn.last() < Some(&30));
    };
    assert_eq!((reported, drawn.last()), (Reported::Complete, Some(&30)), "{drawn:?}");
}

#[test]
fn no_incomplete_sample_has_a_part_in_a_picture() {
    let (mut fresh, mut used) = (session(), session());
    let (few, many) = (stack(2, 1.0), stack(12, 1.0));
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
    let three = stack(3, 1.0);
    session.set_scene(&three).unwrap();
    render(&mut session, &three, [64; 2]);
    let five = stack(5, 1.0);
    session.set_scene(&five).unwrap();
    session.draw(&five, [40, 90], false).unwrap();
    assert_eq!(session.renderer().last_layer_reports()[0].as_ref().map(|(p, _)| p.layers), Some(5));
}

#[test]
fn fragments_without_room_are_found_missing_and_get_it() {
    let mut session = session();
    let (small, large) = (blueprint_of(0.02, 1), blueprint_of(2.0, 24));
    session.set_scene(&small).unwrap();
    session.draw(&small, [64; 2], false).unwrap();
    // After a frame that needs little, little is kept.
    render(&mut session, &small, [65; 2]);
    session.renderer().gpu().wait().unwrap();

    session.set_scene(&large).unwrap();
    render(&mut session, &large, [64; 2]);
    session.renderer().gpu().wait().unwrap();
    assert_eq!(session.renderer().take_reports(), Reported::Incomplete);
    let counted = session.renderer().last_layer_reports().remove(0).unwrap().0;
    let image = session.image(&large, [64; 2], false).unwrap();
    assert_eq!(
        session.renderer().layer_reports().unwrap()[0].fragments,
        counted.fragments,
        "all were counted"
    );
    assert_eq!(way(&mut session), LayerMethod::Lists);
    let mut fresh = common::session();
    assert!(image == common::image(&mut fresh, &large, 64));
}

/// Squares behind each other with sides of this length, in a view of length 3.
fn blueprint_of(side: f32, planes: usize) -> hachure::export::session::Opened {
    let mut opened = stack(planes, side);
    opened.document.camera = Some(stack(2, 3.0).document.camera.unwrap());
    opened
}

#[test]
fn a_device_whose_fragments_cannot_write_peels_whatever_is_asked() {
    let mut gpu = Gpu::headless().unwrap();
    gpu.writes_in_fragments = false;
    let mut session = hachure::export::Session::new(gpu);
    let mut three = stack(3, 1.0);
    let expected = common::image(&mut common::session(), &three, 64);
    for by in ["auto", "lists"] {
        set(&mut three, "view.layer_method", by);
        assert!(common::image(&mut session, &three, 64) == expected);
        assert_eq!(way(&mut session), LayerMethod::Peeling(Reason::Device), "{by}");
    }
}
