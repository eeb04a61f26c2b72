//! The role mask, and when it is without effect.

use super::{Document, Resolved};
use crate::scene::{NodeId, Scene, Warning};
use crate::style::Technique;

impl Document {
    /// Whether anything visible is designated.
    pub fn has_mask(&self, scene: &Scene) -> bool {
        visible_masks(scene, &self.resolve(scene)).next().is_some()
    }

    /// A warning if objects are designated and no layers are drawn for them: they are hidden, or nothing else is a blueprint.
    pub fn mask_fault(&self, scene: &Scene) -> Option<Warning> {
        let resolved = self.resolve(scene);
        let designated = objects(scene, &resolved).find(|(_, roles)| roles.mask)?.0;
        let message = if visible_masks(scene, &resolved).next().is_none() {
            "is designated but hidden, as all designated objects are: blueprints are drawn as if there were none"
        } else if !objects(scene, &resolved)
            .any(|(_, r)| r.visible && !r.mask && r.style.technique == Technique::Blueprint)
        {
            "is designated, but no layers are drawn to uncover it: no other visible object has the technique blueprint"
        } else {
            return None;
        };
        Some(Warning { place: scene.nodes.get(designated)?.path.clone(), message: message.to_owned() })
    }
}

/// The nodes that have a mesh.
fn objects<'a, 'd>(
    scene: &'a Scene,
    resolved: &'a [Resolved<'d>],
) -> impl Iterator<Item = (NodeId, &'a Resolved<'d>)> {
    resolved.iter().enumerate().filter(|(id, _)| scene.nodes.get(*id).is_some_and(|n| n.mesh.is_some()))
}

fn visible_masks<'a>(scene: &'a Scene, resolved: &'a [Resolved<'_>]) -> impl Iterator<Item = NodeId> + 'a {
    objects(scene, resolved).filter(|(_, roles)| roles.mask && roles.visible).map(|(id, _)| id)
}
