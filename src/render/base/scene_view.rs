//! The scene as one camera sees it, in one sample of a picture.

use glam::Vec4;

use super::gpu_scene::GpuScene;
use super::lights::Lights;
use super::sample::Sample;
use super::view::View;
use crate::document::LayersBy;

/// The scene as one camera sees it, in one sample of a picture.
#[derive(Clone, Copy)]
pub struct SceneView<'a> {
    /// The scene on the device.
    pub scene: &'a GpuScene,
    /// Changes when the scene does.
    pub scene_revision: u64,
    /// The camera, moved by the sample's jitter.
    pub view: &'a View,
    /// Which sample of the picture this is.
    pub sample: Sample,
    /// The lights.
    pub lights: &'a Lights,
    /// Paper: linear color and opacity.
    pub background: Vec4,
    /// Pixels per reference pixel.
    pub scale: f32,
    /// Above it edges separate surfaces; radians.
    pub crease_angle: f32,
    /// How depth layers are to be made.
    pub layers_by: LayersBy,
}
