//! What the program itself puts beside the nodes of the files: glyphs, the caps of a section.

use std::sync::Arc;

use glam::{DMat4, DVec3};

use super::{Material, Node, NodeId, Scene};
use crate::geometry::{Mesh, Submesh};

/// An object that the program made.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Its path, unique among all additions: `glyphs/route`. Paths of files' nodes begin with `/`; its must not.
    pub path: String,
    /// The node of a file to which it belongs: it has that one's style and roles, is hidden with it, and who picks it
    /// picks that one. `None`: it stands for itself.
    pub owner: Option<NodeId>,
    /// Its triangles; the parts are not read, all of it has one material.
    pub mesh: Mesh,
    /// Where the mesh lies, in the files' coordinates.
    pub world_from_local: DMat4,
    /// What it is made of; images are not shown.
    pub material: Material,
    /// Whether it turns to the eye: then `world_from_local` is found for each camera.
    pub facing: Option<Facing>,
}

/// How something flat, in x and y about its origin, faces the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facing {
    /// Where its origin is seen, in the files' coordinates.
    pub anchor: DVec3,
    /// How large it is.
    pub size: LetterSize,
    /// Whether it stands before everything else; otherwise what is before its anchor hides it.
    pub in_front: bool,
}

/// What a length of 1 becomes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LetterSize {
    /// So many reference pixels.
    ReferencePixels(f64),
    /// So many units of the scene.
    Units(f64),
}

impl Scene {
    /// The same with objects behind all of its own, which keep their numbers: addition `i` is node `nodes.len() + i`.
    /// An addition without triangles is a node without a mesh.
    #[must_use]
    pub fn with_additions(&self, additions: impl IntoIterator<Item = Addition>) -> Self {
        let mut scene = self.clone();
        for addition in additions {
            let Addition { path, owner, mut mesh, world_from_local, material, facing } = addition;
            let has_triangles = !mesh.indices.is_empty();
            scene.facing.extend(facing.map(|facing| (scene.nodes.len(), facing)));
            scene.nodes.push(Node {
                name: path.rsplit('/').next().unwrap_or(&path).to_owned(),
                path,
                parent: owner,
                descendants: 0,
                world_from_local,
                mesh: has_triangles.then_some(scene.meshes.len()),
            });
            scene.added += 1;
            if has_triangles {
                let index_count = mesh.indices.len() as u32;
                mesh.submeshes =
                    vec![Submesh { first_index: 0, index_count, material: scene.materials.len() }];
                scene.meshes.push(Arc::new(mesh));
                scene.materials.push(material);
            }
        }
        scene
    }

    /// The nodes of the files.
    pub fn own_nodes(&self) -> &[Node] {
        self.nodes.split_at(self.nodes.len().saturating_sub(self.added)).0
    }

    /// Whether the program made a node.
    pub fn is_added(&self, id: NodeId) -> bool {
        id >= self.own_nodes().len()
    }

    /// How a node faces the eye, if it does.
    pub fn facing_of(&self, id: NodeId) -> Option<&Facing> {
        if !self.is_added(id) {
            return None;
        }
        self.facing.iter().find(|(node, _)| *node == id).map(|(_, facing)| facing)
    }

    /// The node that is meant by a node: the owner of an addition that has one, else itself.
    pub fn meant_by(&self, id: NodeId) -> NodeId {
        let owner = if self.is_added(id) { self.nodes.get(id).and_then(|n| n.parent) } else { None };
        owner.unwrap_or(id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives;

    fn addition(path: &str, owner: Option<NodeId>, mesh: Mesh) -> Addition {
        let (world_from_local, material) = (DMat4::IDENTITY, Material::default());
        Addition { path: path.to_owned(), owner, mesh, world_from_local, material, facing: None }
    }

    #[test]
    fn additions_stand_behind_all_that_was_there() {
        let model = Scene::default().with_additions([addition("/a", None, primitives::cube(1.0))]);
        let model = Scene { added: 0, ..model };
        let cap = addition("caps/0", Some(0), primitives::plane(1.0));
        let empty = addition("glyphs/empty", None, Mesh::default());
        let scene = model.with_additions([cap, empty]);
        assert_eq!(scene.own_nodes(), model.nodes);
        assert_eq!((scene.meant_by(0), scene.meant_by(1), scene.meant_by(2)), (0, 0, 2));
        assert!(!scene.is_added(0) && scene.is_added(1) && scene.is_added(2));
        assert!(Arc::ptr_eq(&scene.meshes[0], &model.meshes[0]), "the model's meshes are shared");
        assert_eq!(scene.meshes[1].submeshes[0].material, 1);
        assert_eq!((scene.nodes[1].name.as_str(), scene.nodes[2].mesh), ("0", None));
    }
}
