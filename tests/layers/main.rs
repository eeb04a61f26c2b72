//! Depth layers: from lists of fragments they are the same as by peeling, and no guess about how many there are is ever seen.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "measurements are printed")]

#[path = "../common/mod.rs"]
mod common;
mod hard;
mod reports;
mod same;
mod speed;

use common::{opened, scene, set, texels};
use glam::{DMat4, DVec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::render::{LayerMethod, Request};

/// Squares behind each other with sides of this length, of which all layers are drawn.
fn stack(planes: usize, side: f32) -> Opened {
    let objects = (0..planes).map(|i| {
        let place = DMat4::from_translation(DVec3::Z * (-0.05 * i as f64));
        ("plane", primitives::plane(side), place, [1.0; 3])
    });
    blueprint(opened(&scene(objects.collect()), DVec3::new(0.1, 0.2, 1.0)))
}

/// Draws one sample without waiting for it.
fn render(session: &mut Session, opened: &Opened, size: [u32; 2]) {
    let request = Request {
        document: &opened.document,
        camera: &opened.document.camera.unwrap(),
        size,
        transparent: false,
        selected: &[],
        samples: 1,
    };
    session.renderer().render(&request).unwrap();
}

/// What a layer consists of, texel by texel.
type Texels = (Vec<[u32; 4]>, Vec<u32>, Vec<u32>, Vec<u32>);

/// All layers of the only group, and how they were made.
fn layers(session: &mut Session, opened: &Opened, side: u32, by: &str) -> (Vec<Texels>, LayerMethod) {
    let mut opened = opened.clone();
    set(&mut opened, "view.layer_method", by);
    common::capture_layers(session);
    session.draw(&opened, [side; 2], false).unwrap();
    assert_eq!(session.renderer().last_layer_reports().len(), 1, "one group");
    let [geometry, colors, regions, depths] =
        ["layer geometry", "layer base color", "layer surface ids", "layer depth"]
            .map(|name| common::captured_layers(session, name));
    let layers = (0..geometry.len()).map(|i| {
        (
            texels(session, &geometry[i]),
            texels(session, &colors[i]),
            texels(session, &regions[i]),
            texels(session, &depths[i]),
        )
    });
    let layers = layers.collect();
    (layers, way(session))
}

/// How the layers of the first group were made.
fn way(session: &mut Session) -> LayerMethod {
    session.renderer().last_layer_reports()[0].as_ref().unwrap().1
}

fn blueprint(mut opened: Opened) -> Opened {
    for (key, value) in
        [("technique", "blueprint"), ("blueprint.max_layers", "64"), ("blueprint.min_coverage", "0")]
    {
        set(&mut opened, key, value);
    }
    opened
}
