//! Both ways to make layers give the same ones, texel by texel.

use glam::{DMat4, DQuat, DVec3, Vec3};
use hachure::document::Role;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, primitives};
use hachure::gpu::Gpu;
use hachure::gpu::device::{device_descriptor, instance_descriptor};
use hachure::render::{LayerMethod, Reason};
use hachure::scene::{AlphaMode, Scene, Texture, TextureRef};

use crate::common::{self, opened, sample, scene, session, set};
use crate::{blueprint, layers};

/// Draws the layers of a scene in both ways and compares them texel by texel; returns how many there are.
fn check_same_layers(name: &str, opened: &Opened, side: u32) -> u32 {
    let mut session = session();
    session.set_scene(opened).unwrap();
    let (peeled, by) = layers(&mut session, opened, side, "peeling");
    assert_eq!(by, LayerMethod::Peeling(Reason::Asked));
    let counted = session.renderer().layer_reports().unwrap().remove(0);
    let (cut, by) = layers(&mut session, opened, side, "auto");
    assert_eq!(by, LayerMethod::Lists);
    let mut counted_too = session.renderer().layer_reports().unwrap().remove(0);
    let fragments = std::mem::replace(&mut counted_too.fragments, counted.fragments);
    assert!(fragments >= counted.pixels.iter().copied().map(u64::from).sum());
    assert!(std::mem::replace(&mut counted_too.capacity, counted.capacity) >= fragments);
    assert_eq!(counted.capacity, 0);
    assert_eq!(counted, counted_too, "{name}");
    let drawn = counted.layers as usize;
    assert!(drawn > 0, "{name}");
    assert!(peeled.len() >= drawn && cut.len() >= drawn, "{name}: {} and {} kept", peeled.len(), cut.len());
    for (number, (a, b)) in peeled.iter().zip(&cut).enumerate().take(drawn) {
        assert!(a.3 == b.3, "{name}: depth of layer {number}");
        assert!(a.0 == b.0, "{name}: geometry of layer {number}");
        assert!(a.2 == b.2, "{name}: regions of layer {number}");
        assert!(a.1 == b.1, "{name}: base color of layer {number}");
    }
    counted.layers
}

#[test]
fn lists_give_the_layers_that_peeling_gives() {
    for (name, least) in [("crank", 8), ("ogre", 4), ("still_life", 4), ("temple", 8), ("cloister", 8)] {
        let count = check_same_layers(name, &blueprint(sample(name)), 160);
        assert!(count >= least, "{name}: {count}");
    }
}

/// A device with no more than the features that every device has.
fn featureless() -> Session {
    let instance = wgpu::Instance::new(instance_descriptor());
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).unwrap();
    let descriptor =
        wgpu::DeviceDescriptor { required_features: wgpu::Features::empty(), ..device_descriptor(&adapter) };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).unwrap();
    Session::new(Gpu::new(&adapter, device, queue))
}

#[test]
fn a_device_without_optional_features_gives_the_same_layers() {
    for name in ["crank", "still_life"] {
        let opened = blueprint(sample(name));
        let [all, least] = [session(), featureless()].map(|mut session| {
            session.set_scene(&opened).unwrap();
            ["auto", "peeling"].map(|by| layers(&mut session, &opened, 160, by))
        });
        assert!(all == least, "{name}");
    }
}

/// Numbers from 0 to 1 that are the same in each run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 24) as f32
    }

    /// One of a few places, so that much coincides.
    fn coarse(&mut self) -> f32 {
        (self.next() * 8.0).floor() / 4.0 - 1.0
    }
}

/// Triangles that cross each other, lie in common planes, and come twice.
fn soup(random: &mut Random, triangles: usize, is_coarse: bool) -> Mesh {
    let mut positions = Vec::new();
    for _ in 0..triangles {
        let corner = |random: &mut Random| {
            let mut number = || if is_coarse { random.coarse() } else { random.next() * 2.0 - 1.0 };
            Vec3::new(number(), number(), number())
        };
        let corners = [corner(random), corner(random), corner(random)];
        let times = if random.next() < 0.2 { 2 } else { 1 };
        positions.extend(corners.repeat(times));
    }
    let indices = (0..positions.len() as u32).collect();
    primitives::from_triangles(positions, indices)
}

/// Objects of such triangles; some are the same one once more.
fn random_objects(seed: u64) -> Vec<(&'static str, Mesh, DMat4, [f32; 3])> {
    let mut random = Random(seed);
    let mut objects = Vec::new();
    for name in ["a", "b", "c", "d"] {
        let mesh = soup(&mut random, 12, seed.is_multiple_of(2));
        let color = [random.next(), random.next(), random.next()];
        objects.push((name, mesh.clone(), DMat4::IDENTITY, color));
        if random.next() < 0.5 {
            objects.push(("again", mesh, DMat4::IDENTITY, [1.0, 0.5, 0.2]));
        }
    }
    objects
}

#[test]
fn both_give_the_same_of_random_scenes_in_whatever_order_they_are_drawn() {
    for seed in 1..=6 {
        let objects = random_objects(seed);
        let towards = DVec3::new(0.3, 0.2 * seed as f64, 1.0);
        let mut depths = Vec::new();
        for turn in [0, 3] {
            let mut objects = objects.clone();
            let count = objects.len();
            objects.rotate_left(turn % count);
            let opened = blueprint(opened(&scene(objects), towards));
            let count = check_same_layers(&format!("soup {seed}"), &opened, 64);
            assert!(count >= 8, "soup {seed}: {count}");
            let mut session = session();
            session.set_scene(&opened).unwrap();
            let (layers, _) = layers(&mut session, &opened, 64, "lists");
            depths.push(layers.into_iter().take(count as usize).map(|layer| layer.3).collect::<Vec<_>>());
        }
        assert!(depths[0] == depths[1], "soup {seed}: the order of drawing decides");
    }
}

/// A scene whose objects have holes in a pattern.
fn with_holes(objects: Vec<(&str, Mesh, DMat4, [f32; 3])>) -> Scene {
    let mut scene = (*scene(objects)).clone();
    let side = 16;
    let rgba = (0..side * side).flat_map(|i| {
        let is_hole = (i % side / 2 + i / side / 2) % 3 == 0;
        [200, 90, 40, if is_hole { 0 } else { 255 }]
    });
    let texture = Texture { name: String::new(), width: side, height: side, rgba: rgba.collect() };
    scene.textures.push(texture.into());
    for material in &mut scene.materials {
        material.base_color_texture = Some(TextureRef {
            texture: 0,
            transform: Default::default(),
            wrap: Default::default(),
            nearest: true,
        });
        material.alpha = AlphaMode::Mask(0.5);
    }
    scene
}

/// Leaves behind each other, turned at random.
fn foliage(leaves: usize) -> Opened {
    let mut random = Random(7);
    let objects = (0..leaves).map(|i| {
        let turn = DQuat::from_euler(
            glam::EulerRot::XYZ,
            f64::from(random.next()) - 0.5,
            f64::from(random.next()) - 0.5,
            f64::from(random.next()) * 6.0,
        );
        let place = DMat4::from_rotation_translation(turn, DVec3::Z * (-0.04 * i as f64));
        ("leaf", primitives::plane(1.0 + random.next()), place, [1.0; 3])
    });
    let scene = with_holes(objects.collect());
    blueprint(opened(&scene.into(), DVec3::Z))
}

#[test]
fn many_leaves_with_holes_give_as_many_layers_as_are_drawn_at_all() {
    assert_eq!(check_same_layers("foliage", &foliage(120), 64), 64);
}

#[test]
fn a_mirror_cuts_off_the_same() {
    let objects = vec![
        ("mirror", primitives::plane(3.0), DMat4::IDENTITY, [0.8; 3]),
        ("ball", primitives::sphere(0.6, 12, 20), DMat4::from_translation(DVec3::Z * 0.4), [0.5, 0.2, 0.1]),
        ("ring", primitives::torus(0.8, 0.2, 20, 10), DMat4::from_translation(DVec3::Z), [0.1, 0.4, 0.7]),
    ];
    let scene = scene(objects);
    let mut opened = blueprint(opened(&scene, DVec3::new(0.6, 0.4, 1.0)));
    let technique = hachure::style::Value::parse("plain");
    opened.document.set_for(&scene, &[0], "technique", &technique).unwrap();
    opened.document.set_role(&scene, &[0], Role::Mirror, true);
    let mut session = session();
    let images = ["peeling", "lists"].map(|by| {
        set(&mut opened, "view.layer_method", by);
        common::image(&mut session, &opened, 96)
    });
    assert!(images[0] == images[1]);
    opened.document.set_role(&scene, &[0], Role::Mirror, false);
    assert!(common::image(&mut session, &opened, 96) != images[0], "the mirror shows something");
}
