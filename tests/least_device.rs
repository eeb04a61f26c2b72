//! A device that offers no more than WebGPU promises of every device, and none of what is optional, draws the same pictures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{greatest_difference, sample, session, set};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::gpu::device::instance_descriptor;
use hachure::gpu::{Gpu, IntegerTextures};
use hachure::style::preset;

const SIDE: u32 = 192;

/// Exactly what every device has.
fn least() -> Session {
    let instance = wgpu::Instance::new(instance_descriptor());
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).unwrap();
    let descriptor = wgpu::DeviceDescriptor {
        required_features: wgpu::Features::empty(),
        required_limits: wgpu::Limits::default(),
        ..wgpu::DeviceDescriptor::default()
    };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).unwrap();
    let limits = device.limits();
    assert_eq!(limits.max_storage_textures_per_shader_stage, 4);
    assert_eq!(limits.max_color_attachment_bytes_per_sample, 32);
    let gpu = Gpu::new(&adapter, device, queue);
    assert_eq!(gpu.integer_textures, IntegerTextures::Sampled);
    Session::new(gpu)
}

/// A sample in a preset, with some parameters changed.
fn drawing(model: &str, style: &str, changes: &[(&str, &str)]) -> Opened {
    let mut opened = sample(model);
    opened.document.style = preset::load(style).unwrap().style;
    for (key, value) in changes {
        set(&mut opened, key, value);
    }
    opened
}

const STROKES: (&str, &str) = ("hatching.direction", "light");

/// Model, preset and changes of each picture. Strokes do not follow the form: for that triangles have to be numbered, which is
/// optional, and without it they lie on the paper.
const PICTURES: [(&str, &str, &[(&str, &str)]); 16] = [
    ("crank", "gooch", &[]),
    ("crank", "lines", &[]),
    ("ogre", "lines", &[("edges.mode", "image_space")]),
    ("crank", "lines", &[("edges.profile.width", "16"), ("edges.inner.width", "12")]),
    ("crank", "lines", &[("edges.shadow.show", "on"), ("light.shadows", "on")]),
    ("ogre", "newspaper", &[("halftone.space", "surface")]),
    ("ogre", "comic", &[("toon.smoothing", "cartoon_map")]),
    ("still_life", "matcap", &[("light.shadows", "on")]),
    ("crank", "blueprint", &[]),
    ("crank", "blueprint", &[("view.layer_method", "peeling")]),
    ("crank", "hidden-lines", &[]),
    ("crank", "x-ray", &[("view.layer_method", "peeling")]),
    ("cloister", "loose-ink", &[]),
    ("ogre", "charcoal", &[]),
    (
        "ogre",
        "pencil-hatching",
        &[("hatching.mapping", "image_space"), STROKES, ("hatching.indication.amount", "0.7")],
    ),
    ("still_life", "cross-hatch", &[("hatching.mapping", "uv"), STROKES]),
];

#[test]
fn the_least_device_draws_what_the_best_one_here_draws() {
    let (mut best, mut least) = (session(), least());
    let mut faults = Vec::new();
    for (model, style, changes) in PICTURES {
        let opened = drawing(model, style, changes);
        let [a, b] = [&mut best, &mut least].map(|session| common::image(session, &opened, SIDE));
        let apart = greatest_difference(&a, &b);
        if apart > 0 {
            let differing = a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count();
            faults.push(format!("{model}, {style}, {changes:?}: {differing} pixels by up to {apart}"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Layers with colors of their own, in both ways to make them.
#[test]
fn what_is_translucent_is_the_same_too() {
    let (mut best, mut least) = (session(), least());
    for by in ["auto", "peeling"] {
        let mut opened = drawing("still_life", "plain", &[("view.layer_method", by)]);
        let mut scene = (*opened.scene).clone();
        for material in &mut scene.materials {
            material.alpha = hachure::scene::AlphaMode::Blend;
            material.base_color.w *= 0.6;
        }
        opened.scene = scene.into();
        let [a, b] = [&mut best, &mut least].map(|session| common::image(session, &opened, SIDE));
        assert_eq!(greatest_difference(&a, &b), 0, "{by}");
    }
}
