//! What the program adds to a scene is drawn like what is in it, and touches nothing of it.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::sync::Arc;

use common::{is_rounded_alike, opened, scene, session, set};
use glam::{DMat4, DVec3};
use hachure::document::Document;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, primitives};
use hachure::render::Origin;
use hachure::scene::{Addition, Material, NodeId, Scene};
use image::RgbaImage;

const SIDE: u32 = 96;

fn addition(path: &str, owner: Option<NodeId>, mesh: Mesh, place: DMat4) -> Addition {
    let material = Material { base_color: glam::vec4(0.9, 0.2, 0.1, 1.0), ..Material::default() };
    Addition { path: path.to_owned(), owner, mesh, world_from_local: place, material, facing: None }
}

fn picture(session: &mut Session, opened: &Opened) -> RgbaImage {
    session.image(opened, [SIDE, SIDE], false).unwrap()
}

/// Pixels that are not the same, but for how a device rounds what another pipeline draws.
fn differences(a: &RgbaImage, b: &RgbaImage) -> usize {
    a.pixels().zip(b.pixels()).filter(|(a, b)| !is_rounded_alike(a, b)).count()
}

#[test]
fn additions_are_drawn_like_objects_of_the_files() {
    // Where objects of files run through each other, layers behind the first have lines that no pixel shows.
    let (into, before) = (DVec3::new(0.3, 0.5, 0.6), DVec3::new(0.3, 0.5, 1.1));
    let (color, red) = ([0.3, 0.5, 0.9], [0.9, 0.2, 0.1]);
    let (lean, rich) = (|| primitives::cube(1.0), || primitives::cube_split(1.0));
    for (own, added) in [(lean(), rich()), (rich(), lean()), (rich(), rich())] {
        let model = scene(vec![("own", own.clone(), DMat4::IDENTITY, color)]);
        for (technique, space, at) in
            [("plain", "screen", into), ("blueprint", "screen", before), ("halftone", "surface", into)]
        {
            let place = DMat4::from_translation(at);
            let objects =
                vec![("own", own.clone(), DMat4::IDENTITY, color), ("added", added.clone(), place, red)];
            let mut expected = opened(&scene(objects), DVec3::new(1.0, 0.8, 2.0));
            expected.document.lighting.shadows = true;
            let mut session = session();
            set(&mut expected, "technique", technique);
            set(&mut expected, "halftone.space", space);
            session.set_scene(&expected).unwrap();
            let expected_picture = picture(&mut session, &expected);
            let opened = Opened { document: expected.document.clone(), scene: Arc::clone(&model) };
            session.set_scene(&opened).unwrap();
            let without = picture(&mut session, &opened);
            assert!(differences(&without, &expected_picture) > 200, "{technique}");
            let additions = vec![addition("added", None, added.clone(), place)];
            session.renderer().show_additions(additions);
            let with = picture(&mut session, &opened);
            assert_eq!(differences(&with, &expected_picture), 0, "{technique}");
        }
    }
}

/// A cube with a smaller one on its top that belongs to it.
fn cube_with_knob(session: &mut Session) -> Opened {
    let model: Arc<Scene> = scene(vec![("cube", primitives::cube(1.0), DMat4::IDENTITY, [0.5; 3])]);
    let opened = opened(&model, DVec3::Z);
    session.set_scene(&opened).unwrap();
    session.renderer().show_additions(vec![knob(0.9)]);
    opened
}

fn knob(height: f64) -> Addition {
    let place = DMat4::from_translation(DVec3::new(0.0, 0.0, height));
    addition("caps/cube", Some(0), primitives::cube(0.5), place)
}

#[test]
fn a_pick_of_what_belongs_to_a_node_is_one_of_the_node() {
    let mut session = session();
    let opened = cube_with_knob(&mut session);
    let picture = session.draw(&opened, [SIDE, SIDE], false).unwrap();
    let objects = common::objects_in_front(&mut session, &picture);
    let middle = (SIDE / 2 * SIDE + SIDE / 2) as usize;
    assert_eq!(objects[middle], 2, "the knob is in front");
    session.renderer().start_pick([SIDE / 2, SIDE / 2]).unwrap();
    session.renderer().gpu().wait().unwrap();
    let pick = session.renderer().poll_pick().unwrap();
    assert_eq!(pick.node, Some(0));
    assert!(pick.point.unwrap().z > 1.0, "{pick:?}");
}

#[test]
fn what_belongs_to_a_node_looks_and_hides_like_it() {
    let mut session = session();
    let mut opened = cube_with_knob(&mut session);
    let shown = picture(&mut session, &opened);
    assert_ne!(shown.get_pixel(SIDE / 2, SIDE / 2), shown.get_pixel(0, 0));
    opened.document.node_mut("/cube").visible = Some(false);
    let hidden = picture(&mut session, &opened);
    assert!(hidden.pixels().all(|p| p == hidden.get_pixel(0, 0)));
}

#[test]
fn a_changed_addition_uploads_nothing_of_the_model() {
    let mut session = session();
    let opened = cube_with_knob(&mut session);
    let buffers = |session: &mut Session| {
        let scene = session.renderer().scene().unwrap();
        let [model, added] = [Origin::Model, Origin::Added].map(|o| scene.geometry(o).positions.clone());
        (model, added, Arc::as_ptr(&scene.scene.meshes[0]))
    };
    let before = buffers(&mut session);
    let first = picture(&mut session, &opened);
    session.renderer().show_additions(vec![knob(0.6)]);
    let after = buffers(&mut session);
    assert!(before.0 == after.0 && before.1 != after.1 && before.2 == after.2);
    assert!(differences(&first, &picture(&mut session, &opened)) > 0);
    session.renderer().show_additions(Vec::new());
    let alone = picture(&mut session, &opened);
    let mut bare = Session::new(session.renderer().gpu().clone());
    bare.set_scene(&opened).unwrap();
    assert_eq!(differences(&alone, &picture(&mut bare, &opened)), 0);
}

#[test]
fn another_scene_comes_without_the_additions_of_the_last_one() {
    let mut session = session();
    let opened = cube_with_knob(&mut session);
    session.set_scene(&opened).unwrap();
    assert_eq!(session.renderer().scene().unwrap().scene.added, 0);
    let empty = Opened { document: Document::default(), scene: Arc::default() };
    session.set_scene(&empty).unwrap();
    session.renderer().show_additions(vec![knob(0.0)]);
    let drawn = picture(&mut session, &empty);
    assert!(drawn.pixels().all(|p| p.0[3] == 255), "an owner that is not there is no reason to fail");
}
