//! Where a point of the picture lies on its object: what patterns that move with objects are fixed to.

use glam::{DMat4, DVec3};

use super::gpu_scene::GpuScene;
use super::ids::node_of;
use super::view::View;

/// From view space to the axes of an object, about the middle of its box, as large as in the world, so that a stretched object has
/// no stretched pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObjectAxes {
    /// View space to these axes, scene units.
    pub from_view: DMat4,
    /// Diagonal of its box, scene units.
    pub diagonal: f64,
    /// The middle of its box, view space.
    pub middle: DVec3,
}

impl ObjectAxes {
    /// Those of an object by its id; `None`: it has no extent.
    pub fn of(scene: &GpuScene, id: u32, view: &View) -> Option<Self> {
        let node = scene.scene.nodes.get(node_of(id)?)?;
        let bounds = scene.mesh_bounds(node.mesh?);
        let linear =
            [node.world_from_local.x_axis, node.world_from_local.y_axis, node.world_from_local.z_axis];
        let size = DVec3::from_array(linear.map(|axis| axis.truncate().length()));
        let diagonal = (size * (bounds.max - bounds.min)).length();
        let view_from_local = view.view_from_world * node.world_from_local;
        let from_view =
            DMat4::from_scale(size) * DMat4::from_translation(-bounds.center()) * view_from_local.inverse();
        let middle = view_from_local.transform_point3(bounds.center());
        let is_sound = from_view.is_finite() && diagonal > 0.0 && diagonal.is_finite();
        is_sound.then_some(Self { from_view, diagonal, middle })
    }
}
