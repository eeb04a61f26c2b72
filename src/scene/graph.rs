//! The scene graph: a flat list of nodes in tree order.

use std::sync::Arc;

use glam::DMat4;

use super::additions::Facing;
use super::extent::{Extent, MeasuredMesh};
use super::{Camera, Light, Material, Texture};
use crate::geometry::{Bounds, Mesh};

/// Index into [`Scene::nodes`].
pub type NodeId = usize;

/// Everything loaded from one or more files.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// Nodes in depth-first order: a parent stands before its children, a subtree is contiguous. Behind them those that
    /// the program added, which belong to no subtree.
    pub nodes: Vec<Node>,
    /// How many nodes the program added: the last ones.
    pub added: usize,
    /// Those of them that face the eye.
    pub facing: Vec<(NodeId, Facing)>,
    /// Meshes; several nodes may show the same one.
    pub meshes: Vec<Arc<Mesh>>,
    /// Materials that mesh parts refer to.
    pub materials: Vec<Material>,
    /// Decoded images that materials refer to.
    pub textures: Vec<Arc<Texture>>,
    /// Cameras found in the files, in world space, with the name of their node. Starting values only.
    pub cameras: Vec<(String, Camera)>,
    /// Lights found in the files, in world space. Starting values only.
    pub lights: Vec<Light>,
    /// What could not be loaded or was repaired, for a person to read.
    pub warnings: Vec<Warning>,
    /// The axis that the first file's format declares to be up.
    pub up: Up,
    /// Meters per unit where the format states it (glTF: 1).
    pub meters_per_unit: Option<f64>,
}

/// A signed coordinate axis that points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum Up {
    /// +X
    #[serde(rename = "+X")]
    PosX,
    /// −X
    #[serde(rename = "-X")]
    NegX,
    /// +Y, as in glTF
    #[default]
    #[serde(rename = "+Y")]
    PosY,
    /// −Y
    #[serde(rename = "-Y")]
    NegY,
    /// +Z, as in STL
    #[serde(rename = "+Z")]
    PosZ,
    /// −Z
    #[serde(rename = "-Z")]
    NegZ,
}

/// One node of the hierarchy. A node with a mesh is an *object*.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Name of the node, unique among its siblings, without `/`.
    pub name: String,
    /// The names from the root down, each after a `/`: `/crank/rod.3`. Unique in the scene.
    pub path: String,
    /// The node above; `None` for the root of each file.
    pub parent: Option<NodeId>,
    /// Number of nodes below this one (children, their children, …); they follow it directly.
    pub descendants: usize,
    /// Transform of the node in the file's coordinates.
    pub world_from_local: DMat4,
    /// Index into [`Scene::meshes`].
    pub mesh: Option<usize>,
}

/// Something that a person should know about a file, after which loading went on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Where: the file, with a line, node or image where known.
    pub place: String,
    /// What happened and, where something can be done, what to do.
    pub message: String,
}

impl Warning {
    /// A warning about something in `place`.
    pub fn new(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self { place: place.into(), message: message.into() }
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

impl Scene {
    /// The box around the given nodes' meshes in world space.
    pub fn bounds_of(&self, nodes: impl IntoIterator<Item = NodeId>) -> Bounds {
        nodes
            .into_iter()
            .filter_map(|id| {
                let node = self.nodes.get(id)?;
                let mesh = self.meshes.get(node.mesh?)?;
                Some(mesh.bounds().transformed(&node.world_from_local))
            })
            .fold(Bounds::EMPTY, |all, b| all.union(&b))
    }

    /// The box around everything.
    pub fn bounds(&self) -> Bounds {
        self.bounds_of(0..self.nodes.len())
    }

    /// How far the given nodes reach: what a camera has to frame.
    pub fn extent_of(&self, nodes: impl IntoIterator<Item = NodeId>) -> Extent {
        let mut known = std::collections::HashMap::new();
        let extents: Vec<_> = nodes
            .into_iter()
            .filter_map(|id| Some((id, self.nodes.get(id)?)))
            .filter_map(|(id, node)| Some((id, node, self.meshes.get(node.mesh?)?)))
            .map(|(id, node, mesh)| match self.facing_of(id) {
                // What faces the eye has no size of its own.
                Some(facing) => Extent::of_point(facing.anchor),
                None => {
                    let measured = known.entry(Arc::as_ptr(mesh)).or_insert_with(|| MeasuredMesh::new(mesh));
                    Extent::of_mesh(measured, node.world_from_local)
                }
            })
            .collect();
        Extent::of_all(&extents)
    }

    /// [`Self::extent_of`] everything.
    pub fn extent(&self) -> Extent {
        self.extent_of(0..self.nodes.len())
    }

    /// The node itself and all nodes below it.
    pub fn subtree(&self, id: NodeId) -> std::ops::Range<NodeId> {
        id..id + 1 + self.nodes.get(id).map_or(0, |n| n.descendants)
    }

    /// The node with this path.
    pub fn find(&self, path: &str) -> Option<NodeId> {
        self.nodes.iter().position(|n| n.path == path)
    }

    /// Adds the contents of another scene behind this one's. Root names are not made unique.
    ///
    /// `up` and `meters_per_unit` stay those of this scene.
    pub fn append(&mut self, other: Self) {
        let (nodes, meshes) = (self.nodes.len(), self.meshes.len());
        let (materials, textures) = (self.materials.len(), self.textures.len());
        self.nodes.extend(other.nodes.into_iter().map(|mut node| {
            node.parent = node.parent.map(|p| p + nodes);
            node.mesh = node.mesh.map(|m| m + meshes);
            node
        }));
        self.meshes.extend(other.meshes.into_iter().map(|mut mesh| {
            let moved = Arc::make_mut(&mut mesh);
            for part in &mut moved.submeshes {
                part.material += materials;
            }
            for beyond in &mut moved.border_links {
                beyond.mesh += meshes;
            }
            if let Some(rig) = &mut moved.rig {
                for joint in &mut Arc::make_mut(rig).joints {
                    *joint += nodes;
                }
            }
            mesh
        }));
        self.materials.extend(other.materials.into_iter().map(|mut material| {
            for texture in
                [&mut material.base_color_texture, &mut material.normal_texture].into_iter().flatten()
            {
                texture.texture += textures;
            }
            material
        }));
        self.textures.extend(other.textures);
        self.cameras.extend(other.cameras);
        self.lights.extend(other.lights);
        self.warnings.extend(other.warnings);
    }

    /// Number of triangles drawn, counting a mesh once for every node that shows it.
    pub fn triangle_count(&self) -> usize {
        self.nodes.iter().filter_map(|n| self.meshes.get(n.mesh?)).map(|m| m.triangle_count()).sum()
    }
}
