//! Sketches in company and by themselves: what hides what, as cast rays say, where lines are missing, what a parameter changes, what
//! is drawn again, and what nothing may break.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "how much was measured is said")]
#![allow(unreachable_pub, reason = "modules of a test program")]

#[path = "../common/mod.rs"]
mod common;
mod company;
mod contact;
mod depth;
mod hostile;
mod order;
mod parameters;
mod picking;
mod plain;
mod profiles;
mod random;
mod rays;
mod stages;
mod twins;

use std::sync::Arc;

use common::{at, to_linear};
use glam::DVec3;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::scene::{Camera, NodeId};
use hachure::style::halftone::Space;
use hachure::style::toon::Smoothing;
use hachure::style::{Matrix, Style, Technique};
use image::{Rgba, RgbaImage};
use strum::VariantNames as _;

/// The techniques of surfaces.
fn surface_techniques() -> Vec<&'static str> {
    Technique::VARIANTS.iter().copied().filter(|name| *name != "blueprint").collect()
}

/// A technique, without what depends on what else is in the picture.
fn style(technique: &str) -> Style {
    let mut style = Style { technique: technique.parse().unwrap(), ..Style::default() };
    style.halftone.space = Space::Screen;
    style.toon.smoothing = Smoothing::Nearest;
    style.edges.profile.width = 8.0;
    style.edges.inner.width = 6.0;
    style
}

/// The same as a sketch whose lines and colors are off by about so many reference pixels.
fn sketched(mut style: Style, lines: f32, fill: f32) -> Style {
    style.sketch.enabled = true;
    for pass in &mut style.sketch.pass {
        pass.matrix = turned(lines);
    }
    style.sketch.fill.matrix = turned(fill);
    style
}

/// A matrix that turns a little, with so great offsets on average.
fn turned(rms: f32) -> Matrix {
    Matrix([[0.95 * rms, 0.31 * rms], [-0.31 * rms, 0.95 * rms]])
}

fn seen_from(position: DVec3, focal_point: DVec3) -> Camera {
    Camera { position, focal_point, ..Camera::default() }
}

fn set_style(opened: &mut Opened, node: NodeId, style: &Style) {
    let scene = Arc::clone(&opened.scene);
    opened.document.set_style(&scene, &[node], style);
}

/// A picture with only some of the nodes.
fn drawn(session: &mut Session, opened: &Opened, side: u32, shown: impl Fn(NodeId) -> bool) -> RgbaImage {
    drawn_on(session, opened, side, shown, false)
}

/// The same on nothing.
fn alone(session: &mut Session, opened: &Opened, side: u32, shown: impl Fn(NodeId) -> bool) -> RgbaImage {
    drawn_on(session, opened, side, shown, true)
}

fn drawn_on(
    session: &mut Session,
    opened: &Opened,
    side: u32,
    shown: impl Fn(NodeId) -> bool,
    transparent: bool,
) -> RgbaImage {
    let mut opened = opened.clone();
    for (node, data) in opened.scene.nodes.iter().enumerate() {
        opened.document.node_mut(&data.path).visible = Some(shown(node));
    }
    let picture = session.image(&opened, [side; 2], transparent).unwrap();
    if let Some(folder) = std::env::var_os("HACHURE_SKETCH_DIR") {
        static COUNT: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
        let count = COUNT.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        picture.save(std::path::Path::new(&folder).join(format!("{count:05}.png"))).unwrap();
    }
    picture
}

/// Largest difference of any channel, per pixel.
fn apart(a: &RgbaImage, b: &RgbaImage) -> Vec<u8> {
    let most =
        |(a, b): (&Rgba<u8>, &Rgba<u8>)| a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
    a.pixels().zip(b.pixels()).map(most).collect()
}

/// How many pixels differ by more than that.
fn differing(a: &RgbaImage, b: &RgbaImage, most: u8) -> usize {
    apart(a, b).into_iter().filter(|apart| *apart > most).count()
}

/// Whether each pixel differs by more than roundings: those of light are more of a picture's numbers where it is dark.
fn is_other(a: &RgbaImage, b: &RgbaImage, light: f64) -> Vec<bool> {
    let lights = a.pixels().zip(b.pixels()).map(|(a, b)| (to_linear(*a) - to_linear(*b)).abs().max_element());
    apart(a, b).into_iter().zip(lights).map(|(apart, most)| apart > 2 && most > light).collect()
}
