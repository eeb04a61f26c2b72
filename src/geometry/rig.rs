//! What a skinned mesh keeps so that it can be posed again.

use glam::{Mat4, Vec3};

/// Skinning data of a mesh. All per-vertex lists are as long as `Mesh::positions`, which hold the pose of the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rig {
    /// Indices into `Scene::nodes` of the joints.
    pub joints: Vec<usize>,
    /// For each joint the matrix from the rest pose's space to the joint's.
    pub joint_from_rest: Vec<Mat4>,
    /// Positions before skinning (default morph weights applied), in the rest pose's space.
    pub rest_positions: Vec<Vec3>,
    /// Unit normals before skinning; empty when the mesh has none.
    pub rest_normals: Vec<Vec3>,
    /// For each vertex up to four indices into `joints`.
    pub vertex_joints: Vec<[u16; 4]>,
    /// For each vertex the weights of these joints; they add up to 1.
    pub vertex_weights: Vec<[f32; 4]>,
}

impl Rig {
    /// The same joints for a mesh whose vertex `i` is vertex `sources[i]` of this one's; sources must be in range.
    #[must_use]
    pub fn gather(&self, sources: &[u32]) -> Self {
        fn pick<T: Copy>(from: &[T], sources: &[u32]) -> Vec<T> {
            let picked = sources.iter().map(|&v| from.get(v as usize).copied());
            picked.flatten().collect()
        }
        Self {
            joints: self.joints.clone(),
            joint_from_rest: self.joint_from_rest.clone(),
            rest_positions: pick(&self.rest_positions, sources),
            rest_normals: pick(&self.rest_normals, sources),
            vertex_joints: pick(&self.vertex_joints, sources),
            vertex_weights: pick(&self.vertex_weights, sources),
        }
    }

    /// Appends the vertices of a rig with the same joints.
    pub(super) fn append_vertices(&mut self, more: &Self) {
        self.rest_positions.extend(&more.rest_positions);
        self.rest_normals.extend(&more.rest_normals);
        self.vertex_joints.extend(&more.vertex_joints);
        self.vertex_weights.extend(&more.vertex_weights);
    }
}
