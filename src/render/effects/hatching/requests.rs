//! Which stripes hatching asks for, and where they lie on the device.

use glam::{DVec3, Vec3};

use crate::document::Document;
use crate::geometry::{DirectionSource, FieldOptions};
use crate::render::base::gpu_scene::GpuScene;
use crate::render::base::stripes::StripeRequest;
use crate::scene::NodeId;
use crate::style::hatching::{Direction, Hatching};
use crate::style::{Style, Technique};

/// How far directions reach into places that have none of their own, in diagonals of the scene: between what suits things that grew
/// (0.08) and things that were constructed (0.05).
const SMOOTHING: f32 = 0.06;

/// The stripes that an object of a style asks for; `None`: none, or it is no part of the model.
pub(super) fn request_of(scene: &GpuScene, node: NodeId, style: &Hatching) -> Option<StripeRequest> {
    let data = scene.scene.nodes.get(node)?;
    let mesh = data.mesh?;
    if scene.scene.is_added(node) {
        return None;
    }
    let linear = [data.world_from_local.x_axis, data.world_from_local.y_axis, data.world_from_local.z_axis];
    let size = linear.map(|axis| axis.truncate().length()).iter().sum::<f64>() / 3.0;
    let extent = (scene.diagonal() / size) as f32;
    let local_from_world = data.world_from_local.inverse();
    let local = |axis: DVec3| local_from_world.transform_vector3(axis).as_vec3().normalize_or(Vec3::Y);
    let has_uvs = scene.has_uvs(node);
    let source = match style.direction {
        Direction::TextureU if has_uvs => DirectionSource::TextureU,
        Direction::TextureV if has_uvs => DirectionSource::TextureV,
        Direction::X => DirectionSource::Axis(local(DVec3::X)),
        Direction::Y => DirectionSource::Axis(local(DVec3::Y)),
        Direction::Z => DirectionSource::Axis(local(DVec3::Z)),
        Direction::Curvature | Direction::TextureU | Direction::TextureV | Direction::Light => {
            DirectionSource::Curvature
        }
    };
    let options = FieldOptions {
        extent: if extent.is_finite() { extent } else { 0.0 },
        source,
        smoothing: SMOOTHING,
        up: local(scene.scene.up.vector()),
        ..FieldOptions::default()
    };
    Some(StripeRequest { mesh, options })
}

/// The stripes that a document asks for and that are not on the device yet, each once.
pub fn missing(document: &Document, scene: &GpuScene) -> Vec<StripeRequest> {
    let mut missing = Vec::new();
    for (node, resolved) in document.resolve(&scene.scene).iter().enumerate() {
        if !resolved.visible || !asks(resolved.style) {
            continue;
        }
        let request = request_of(scene, node, &resolved.style.hatching);
        if let Some(request) = request.filter(|r| scene.stripe_place(r).is_none() && !missing.contains(r)) {
            missing.push(request);
        }
    }
    missing
}

fn asks(style: &Style) -> bool {
    style.technique == Technique::Hatching
}
