//! The role mirror, and objects that cannot have it.

use super::Document;
use crate::geometry::{NotFlat, Plane};
use crate::scene::{NodeId, Scene, Warning};

/// Why a node with a mesh cannot be a mirror; `None` if it can, or if it has no mesh.
pub fn mirror_fault(scene: &Scene, node: NodeId) -> Option<NotFlat> {
    let node = scene.nodes.get(node)?;
    let mesh = scene.meshes.get(node.mesh?)?;
    Plane::of_mesh(mesh).and_then(|plane| plane.transformed(&node.world_from_local)).err()
}

impl Document {
    /// A warning for each object that is to be a mirror and cannot be one. It is drawn like any other object.
    pub fn mirror_faults(&self, scene: &Scene) -> Vec<Warning> {
        let resolved = self.resolve(scene);
        let mirrors = resolved.iter().enumerate().filter(|(_, roles)| roles.mirror && roles.visible);
        mirrors
            .filter_map(|(id, _)| {
                let fault = mirror_fault(scene, id)?;
                Some(Warning {
                    place: scene.nodes.get(id)?.path.clone(),
                    message: format!("cannot be a mirror: {fault}; choose an object that is one flat face"),
                })
            })
            .collect()
    }
}
