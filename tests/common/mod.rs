//! What the tests of pictures share: a device, small scenes, read-back.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "what is left out is said")]
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of it")]

pub mod curved;
pub mod failures;
pub mod hatched;
pub mod line_drawing;
pub mod line_scenes;
pub mod line_truth;
pub mod outline;

use std::path::Path;
use std::sync::Arc;

use glam::{DMat4, DVec3, DVec4};
use hachure::document::Document;
use hachure::export::Session;
use hachure::export::session::{Opened, open};
use hachure::geometry::Mesh;
use hachure::gpu::{Gpu, Target, readback};
use hachure::import::Progress;
use hachure::render::{LAYERS, Picture};
use hachure::scene::{Camera, Material, Node, NodeId, Scene};
use hachure::style::Value;
use image::{Rgba, RgbaImage};

/// A device; without one the test fails and says what to install.
pub fn session() -> Session {
    match Gpu::headless() {
        Ok(gpu) => {
            let mut session = Session::new(gpu);
            for name in LOOKED_AT {
                session.renderer().capture(name);
            }
            session
        }
        Err(error) => panic!("{error}"),
    }
}

/// What tests look at of the textures that pictures are made of, where they use [`session`].
const LOOKED_AT: [&str; 8] = [
    "geometry",
    "surface ids",
    "edge map",
    "operators",
    "shadow mask",
    "cartoon map",
    "coordinates",
    "depth mask",
];

/// A texture that the last picture was made of, by its name; `None` if it was made without.
pub fn captured(session: &mut Session, name: &str) -> Option<Target> {
    session.renderer().captured(name).first().cloned()
}

/// The layers of the only blueprint, as they are kept under a name, the nearest first. They have to be asked for before.
pub fn captured_layers(session: &mut Session, name: &str) -> Vec<Target> {
    session.renderer().captured(name).to_vec()
}

/// Keeps the layers of blueprints from now on.
pub fn capture_layers(session: &mut Session) {
    for name in LAYERS {
        session.renderer().capture(name);
    }
}

/// A scene of one object per mesh: (name, mesh, place, base color).
pub fn scene(objects: Vec<(&str, Mesh, DMat4, [f32; 3])>) -> Arc<Scene> {
    let mut scene = Scene::default();
    for (name, mut mesh, world_from_local, [r, g, b]) in objects {
        for part in &mut mesh.submeshes {
            part.material = scene.materials.len();
        }
        scene.materials.push(Material { base_color: glam::vec4(r, g, b, 1.0), ..Material::default() });
        scene.nodes.push(Node {
            name: name.to_owned(),
            path: format!("/{name}"),
            parent: None,
            descendants: 0,
            world_from_local,
            mesh: Some(scene.meshes.len()),
        });
        scene.meshes.push(Arc::new(mesh));
    }
    Arc::new(scene)
}

/// An object of [`scene`].
pub type Object = (&'static str, Mesh, DMat4, [f32; 3]);

/// A white one.
pub fn object(name: &'static str, mesh: Mesh, place: DMat4) -> Object {
    (name, mesh, place, [1.0; 3])
}

/// A place.
pub fn at(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_translation(DVec3::new(x, y, z))
}

/// A sample model of `assets/models/` as the program opens it.
pub fn sample(name: &str) -> Opened {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/models/{name}.glb"));
    open(&[path], |_| {}, &Progress::default()).unwrap()
}

/// A document on a scene, seen from a direction.
pub fn opened(scene: &Arc<Scene>, towards_viewer: DVec3) -> Opened {
    let camera = Camera::looking_from(towards_viewer, DVec3::Y, &scene.extent(), 1.0);
    Opened { document: Document { camera: Some(camera), ..Document::default() }, scene: Arc::clone(scene) }
}

/// Sets a parameter.
pub fn set(opened: &mut Opened, key: &str, value: &str) {
    opened.document.set(key, &Value::parse(value)).unwrap();
}

/// Sets a parameter of one object.
pub fn set_for(opened: &mut Opened, node: NodeId, key: &str, value: &str) {
    set_value_for(opened, node, key, &Value::parse(value));
}

/// The same, with a value that has been parsed.
pub fn set_value_for(opened: &mut Opened, node: NodeId, key: &str, value: &Value) {
    let scene = Arc::clone(&opened.scene);
    opened.document.set_for(&scene, &[node], key, value).unwrap();
}

/// Uploads and draws.
pub fn draw(session: &mut Session, opened: &Opened, side: u32) -> Picture {
    session.set_scene(opened).unwrap();
    session.draw(opened, [side, side], false).unwrap()
}

/// Uploads, draws and reads the final image back.
pub fn image(session: &mut Session, opened: &Opened, side: u32) -> RgbaImage {
    session.set_scene(opened).unwrap();
    session.image(opened, [side, side], false).unwrap()
}

/// The greatest difference of any channel of any pixel.
pub fn greatest_difference(a: &RgbaImage, b: &RgbaImage) -> u8 {
    assert_eq!(a.dimensions(), b.dimensions());
    a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| a.abs_diff(*b)).max().unwrap()
}

/// Whether two pixels are the same but for the last step of a channel, which graphics cards round differently.
pub fn is_rounded_alike(Rgba(a): &Rgba<u8>, Rgba(b): &Rgba<u8>) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1)
}

/// A channel of a picture from linear light.
pub fn to_srgb(linear: f32) -> u8 {
    let c = linear.clamp(0.0, 1.0);
    let c = if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    (c * 255.0).round() as u8
}

/// Premultiplied linear light of a pixel.
pub fn to_linear(Rgba([r, g, b, a]): Rgba<u8>) -> DVec4 {
    let [r, g, b] = [r, g, b].map(|c| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    });
    let a = f64::from(a) / 255.0;
    DVec4::new(r * a, g * a, b * a, a)
}

/// The middle one of these.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The texels of a target as numbers.
pub fn texels<T: bytemuck::Pod>(session: &mut Session, target: &Target) -> Vec<T> {
    bytemuck::pod_collect_to_vec(&readback::read(session.renderer().gpu(), target).unwrap())
}

/// One texel of the G-buffer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surfel {
    pub normal: glam::Vec3,
    pub face_normal: glam::Vec3,
    pub depth: f32,
    pub object: u32,
    pub enhanced: bool,
}

fn octahedral(packed: u32) -> glam::Vec3 {
    let [x, y] =
        [packed as u16 as i16, (packed >> 16) as u16 as i16].map(|c| (f32::from(c) / 32767.0).max(-1.0));
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    let unfold = |c: f32| if c >= 0.0 { c - fold } else { c + fold };
    glam::vec3(unfold(x), unfold(y), z).normalize()
}

/// The object in front at each pixel; 0: none.
pub fn objects_in_front(session: &mut Session, picture: &Picture) -> Vec<u32> {
    let fronts: Vec<Vec<[u32; 4]>> = picture.front.all().map(|target| texels(session, target)).collect();
    (0..fronts[0].len())
        .map(|px| {
            let there = fronts.iter().map(|front| front[px]).filter(|texel| texel[3] != 0);
            let nearest = there.min_by(|a, b| f32::from_bits(a[2]).total_cmp(&f32::from_bits(b[2])));
            nearest.map_or(0, |texel| texel[3] & 0x7fff_ffff)
        })
        .collect()
}

/// The G-buffer of a picture, row by row.
pub fn surfels(session: &mut Session, picture: &Picture) -> Vec<Surfel> {
    let geometry = captured(session, "geometry").unwrap();
    assert_eq!(geometry.size(), picture.image.size());
    texels::<[u32; 4]>(session, &geometry)
        .into_iter()
        .map(|[normal, face, depth, object]| Surfel {
            normal: octahedral(normal),
            face_normal: octahedral(face),
            depth: f32::from_bits(depth),
            object: object & 0x7fff_ffff,
            enhanced: object >> 31 == 1,
        })
        .collect()
}

/// Inner and profile ink per pixel, 0 to 1, and whose it is. See `shaders/common/edge_map.wgsl`.
pub fn ink(session: &mut Session, picture: &Picture) -> Vec<(f32, f32, u32)> {
    let Some(edge_map) = captured(session, "edge map") else {
        return vec![(0.0, 0.0, 0); (picture.image.size()[0] * picture.image.size()[1]) as usize];
    };
    texels::<[u32; 4]>(session, &edge_map)
        .into_iter()
        .map(|[class, object, _, ink]| match class >> 28 {
            0 => (0.0, 0.0, 0),
            PAPER => ((ink & 0xffff) as f32 / 65535.0, (ink >> 16) as f32 / 65535.0, object),
            class => {
                let weight = (ink >> 26) as f32 / 63.0;
                if class <= LAST_PROFILE { (0.0, weight, object) } else { (weight, 0.0, object) }
            }
        })
        .collect()
}

/// Classes in the edge map: the papers' operators, and the last of the profile edges.
const PAPER: u32 = 15;
const LAST_PROFILE: u32 = 3;
