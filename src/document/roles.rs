//! The roles that few objects have: what an object is in the scene, whatever its style is.

use super::{Document, NodeSettings, Resolved};
use crate::scene::{NodeId, Scene, Warning};

/// What an object can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// It shows what is before it, if it can: see [`super::mirrors::mirror_fault`].
    Mirror,
    /// It is designated: layers of blueprints are drawn until it is uncovered, and none is made of it (blueprints paper, section 4.3).
    Mask,
}

impl NodeSettings {
    fn role_mut(&mut self, role: Role) -> &mut Option<bool> {
        match role {
            Role::Mirror => &mut self.mirror,
            Role::Mask => &mut self.mask,
        }
    }
}

impl Resolved<'_> {
    /// Whether the node has a role.
    pub fn has(&self, role: Role) -> bool {
        match role {
            Role::Mirror => self.mirror,
            Role::Mask => self.mask,
        }
    }
}

impl Document {
    /// A warning for each role that is without effect.
    pub fn role_faults(&self, scene: &Scene) -> Vec<Warning> {
        self.mirror_faults(scene).into_iter().chain(self.mask_fault(scene)).collect()
    }

    /// Gives nodes and what hangs below them a role, or takes it from them.
    pub fn set_role(&mut self, scene: &Scene, nodes: &[NodeId], role: Role, has_it: bool) {
        for &id in nodes {
            for inner in scene.subtree(id) {
                if let Some(own) = scene.nodes.get(inner).and_then(|n| self.nodes.get_mut(&n.path)) {
                    *own.role_mut(role) = None;
                }
            }
            let inherited = self.resolve(scene).get(id).is_some_and(|r| r.has(role));
            if let (true, Some(node)) = (inherited != has_it, scene.nodes.get(id)) {
                *self.node_mut(&node.path).role_mut(role) = Some(has_it);
            }
        }
        self.tidy();
    }
}
