//! Groups that are seen through and overlap: their layers are in one order, however much room there is for them, and whatever
//! the order of objects.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::sync::Arc;

use common::{opened, scene, session, set, set_for};
use glam::{DMat4, DQuat, DVec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::gpu::Gpu;
use hachure::render::{Reported, Request};
use hachure::scene::{AlphaMode, Camera};
use image::RgbaImage;

const SIDE: u32 = 120;

/// What each ring is: its technique, or glass.
const LOOKS: [&str; 4] = ["blueprint", "glass", "other blueprint", "gooch"];

/// Rings that go through each other, in this order.
fn rings(order: [usize; 4]) -> Opened {
    let place = |i: usize| {
        let turned = DMat4::from_quat(DQuat::from_rotation_x(i as f64 * 0.9));
        DMat4::from_translation(DVec3::new(i as f64 * 0.55 - 0.8, 0.0, 0.0)) * turned
    };
    let ring = |i: &usize| (LOOKS[*i], primitives::torus(0.7, 0.2, 32, 12), place(*i), [0.7, 0.5, 0.3]);
    let mut made = Arc::unwrap_or_clone(scene(order.iter().map(ring).collect()));
    let glass = order.iter().position(|i| LOOKS[*i] == "glass").unwrap();
    made.materials[glass].base_color.w = 0.4;
    made.materials[glass].alpha = AlphaMode::Blend;
    let mut opened = opened(&Arc::new(made), DVec3::new(0.2, 0.3, 1.0));
    for (node, i) in order.iter().enumerate() {
        let technique = if LOOKS[*i].ends_with("blueprint") { "blueprint" } else { "gooch" };
        set_for(&mut opened, node, "technique", technique);
        if LOOKS[*i] == "other blueprint" {
            set_for(&mut opened, node, "blueprint.fill", "#e04020");
            set_for(&mut opened, node, "blueprint.fill_opacity", "0.5");
        }
    }
    set(&mut opened, "blueprint.max_layers", "32");
    // The range of distances is that of all objects.
    set(&mut opened, "blueprint.by_distance", "0");
    opened
}

fn drawn(session: &mut Session, opened: &Opened) -> RgbaImage {
    common::image(session, opened, SIDE)
}

/// Draws frame by frame until nothing is missing: in how many bands each frame was drawn.
fn bands_of_frames(session: &mut Session, opened: &Opened) -> Vec<usize> {
    session.set_scene(opened).unwrap();
    let request = Request {
        document: &opened.document,
        camera: &opened.document.camera.unwrap(),
        size: [SIDE; 2],
        transparent: false,
        selected: &[],
        samples: 1,
    };
    let (renderer, mut bands) = (session.renderer(), Vec::new());
    loop {
        renderer.render(&request).unwrap();
        bands.push(renderer.bands());
        renderer.gpu().wait().unwrap();
        if renderer.take_reports() != Reported::Incomplete {
            return bands;
        }
    }
}

#[test]
fn with_room_for_a_few_layers_only_a_picture_is_drawn_in_bands_and_is_the_same() {
    let rings = rings([0, 1, 2, 3]);
    let mut roomy = session();
    assert_eq!(bands_of_frames(&mut roomy, &rings), [1]);
    let expected = drawn(&mut roomy, &rings);
    for room in [4_000, 900] {
        let mut gpu = Gpu::headless().unwrap();
        gpu.max_listed = room;
        let mut session = Session::new(gpu);
        // That there is too little room is known after the first frame.
        let frames = bands_of_frames(&mut session, &rings);
        let bands = frames.last().copied().unwrap_or_default();
        assert!(frames == [1, bands] && bands > 1, "room for {room}: frames of {frames:?} bands");
        assert!(drawn(&mut session, &rings) == expected, "room for {room}");
        // What is known by then is enough at once.
        assert_eq!(bands_of_frames(&mut session, &rings), [bands], "room for {room}, again");
    }
}

#[test]
fn the_order_of_objects_changes_no_pixel() {
    let mut session = session();
    let expected = drawn(&mut session, &rings([0, 1, 2, 3]));
    for order in [[3, 2, 1, 0], [1, 3, 0, 2], [2, 0, 3, 1]] {
        assert!(drawn(&mut session, &rings(order)) == expected, "{order:?}");
    }
}

#[test]
fn groups_that_overlap_no_others_are_drawn_by_themselves() {
    let mut session = session();
    let mut far = rings([0, 1, 2, 3]);
    let scene = Arc::make_mut(&mut far.scene);
    for (node, x) in [(0, -6.0), (2, 6.0)] {
        let place = &mut scene.nodes[node].world_from_local;
        *place = DMat4::from_translation(DVec3::new(x, 0.0, 0.0)) * *place;
    }
    let towards = DVec3::new(0.0, 0.3, 1.0);
    far.document.camera = Some(Camera::looking_from(towards, DVec3::Y, &far.scene.extent(), 1.0));
    // Each is in company what it is alone.
    let company = drawn(&mut session, &far);
    for node in [0, 2] {
        let mut alone = far.clone();
        for other in (0..4).filter(|other| *other != node) {
            let path = alone.scene.nodes[other].path.clone();
            alone.document.node_mut(&path).visible = Some(false);
        }
        let alone = drawn(&mut session, &alone);
        let half = if node == 0 { 0..SIDE / 4 } else { SIDE * 3 / 4..SIDE };
        for (x, y) in half.flat_map(|x| (0..SIDE).map(move |y| (x, y))) {
            assert_eq!(company.get_pixel(x, y), alone.get_pixel(x, y), "{node} at {x}, {y}");
        }
    }
}
