//! Cameras and lights of the file, as starting values in world space.

use ::gltf::json::Root;
use ::gltf::json::camera::Camera as Declared;
use ::gltf::json::extensions::scene::khr_lights_punctual::{Light as DeclaredLight, Type};
use ::gltf::json::validation::Checked;
use glam::{DMat4, DVec3, Vec3};

use crate::scene::{Camera, Light, LightKind, Projection, Scene};

/// Adds the cameras and lights of the nodes that are shown. `sources` tells for each node of the scene which node of
/// the file it is, `worlds` where that stands.
pub(super) fn add(root: &Root, sources: &[Option<usize>], worlds: &[DMat4], scene: &mut Scene) {
    let bounds = scene.bounds();
    let mut cameras = Vec::new();
    let mut lights = Vec::new();
    for (shown, source) in scene.nodes.iter().zip(sources) {
        let Some((node, world)) = source.and_then(|index| Some((root.nodes.get(index)?, worlds.get(index)?)))
        else {
            continue;
        };
        let declared = node.camera.and_then(|c| root.cameras.get(c.value()));
        if let Some(camera) = declared.and_then(|c| camera(c, world)) {
            let forward = camera.forward();
            // Orbits turn about what is seen, so the focal point lies as deep as the model's middle.
            let depth = (bounds.center() - camera.position).dot(forward);
            let depth = if depth > 0.0 { depth } else { bounds.diagonal().max(1e-6) };
            cameras.push((
                shown.name.clone(),
                Camera { focal_point: camera.position + forward * depth, ..camera },
            ));
        }
        let declared = node.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref()).and_then(|l| {
            let all = root.extensions.as_ref()?.khr_lights_punctual.as_ref()?;
            all.lights.get(l.light.value())
        });
        lights.extend(declared.and_then(|l| light(l, world)));
    }
    normalize(&mut lights);
    scene.cameras = cameras;
    scene.lights = lights;
}

/// The camera at a node, looking along its −Z; the focal point is one unit away.
fn camera(declared: &Declared, world: &DMat4) -> Option<Camera> {
    let projection = if let Some(perspective) = &declared.perspective {
        let angle = f64::from(perspective.yfov).to_degrees();
        Projection::Perspective {
            view_angle: if angle.is_finite() {
                angle.clamp(1.0, 170.0)
            } else {
                return None;
            },
        }
    } else {
        let height = 2.0 * f64::from(declared.orthographic.as_ref()?.ymag).abs();
        if !(height.is_finite() && height > 0.0) {
            return None;
        }
        Projection::Orthographic { view_height: height }
    };
    let position = world.w_axis.truncate();
    let forward = world.transform_vector3(DVec3::NEG_Z).try_normalize()?;
    let view_up = world.transform_vector3(DVec3::Y).try_normalize()?;
    Some(Camera { position, focal_point: position + forward, view_up, projection })
}

/// The light at a node, shining along its −Z; spots become points.
fn light(declared: &DeclaredLight, world: &DMat4) -> Option<Light> {
    let kind = match declared.type_ {
        Checked::Valid(Type::Directional) => {
            LightKind::Directional { direction: world.transform_vector3(DVec3::NEG_Z).try_normalize()? }
        }
        Checked::Valid(Type::Point | Type::Spot) => LightKind::Point { position: world.w_axis.truncate() },
        Checked::Invalid => return None,
    };
    let sane = |v: f32, max: f32| {
        if v.is_finite() { v.clamp(0.0, max) } else { 0.0 }
    };
    Some(Light {
        kind,
        color: Vec3::from_array(declared.color.map(|c| sane(c, 1.0))),
        intensity: sane(declared.intensity, f32::MAX),
        attached_to_camera: false,
        casts_shadow: false,
    })
}

/// Scales intensities so that the brightest is 1: a drawing needs no candela.
fn normalize(lights: &mut [Light]) {
    let brightest = lights.iter().map(|l| l.intensity).fold(0.0, f32::max);
    for light in lights {
        light.intensity = if brightest > 0.0 { light.intensity / brightest } else { 1.0 };
    }
}
