//! Skinning at import: vertices are put where the pose of the file's nodes has them.

use ::gltf::json::Root;
use glam::{DMat4, Mat3, Mat4, Vec3, Vec4Swizzles};

use super::block::{Block, gather};
use super::buffers::{GltfDocument, label};
use super::fault::{Result, malformed};

/// A skin in the pose that the file's nodes give.
#[derive(Debug)]
pub(super) struct Pose {
    /// Nodes of the file that are the joints.
    pub(super) joints: Vec<usize>,
    /// For each joint the matrix from the rest pose's space to the joint's.
    pub(super) joint_from_rest: Vec<Mat4>,
    world_from_rest: Vec<Mat4>,
}

/// Skinning data of a block's vertices, each list as long as its positions.
#[derive(Debug, Clone, Default)]
pub(super) struct Skinning {
    /// Positions before skinning.
    pub(super) rest_positions: Vec<Vec3>,
    /// Normals before skinning, or empty.
    pub(super) rest_normals: Vec<Vec3>,
    /// Joints of each vertex.
    pub(super) joints: Vec<[u16; 4]>,
    /// Their weights.
    pub(super) weights: Vec<[f32; 4]>,
}

impl Skinning {
    /// The picked vertices.
    pub(super) fn gathered(&self, picks: &[u32]) -> Self {
        Self {
            rest_positions: gather(&self.rest_positions, picks),
            rest_normals: gather(&self.rest_normals, picks),
            joints: gather(&self.joints, picks),
            weights: gather(&self.weights, picks),
        }
    }
}

/// Reads a skin.
///
/// # Errors
/// When it does not exist, has a joint that does not exist, or its matrices cannot be read.
pub(super) fn pose(document: &GltfDocument<'_>, skin: usize, worlds: &[DMat4]) -> Result<Pose> {
    let root: &Root = &document.root;
    let Some(declared) = root.skins.get(skin) else {
        return malformed(format!("there is no skin {skin}"));
    };
    let place = || label("skin", skin, declared.name.as_ref());
    let joints: Vec<usize> = declared.joints.iter().map(|j| j.value()).collect();
    if joints.len() > usize::from(u16::MAX) {
        return malformed(format!("{} has {} joints", place(), joints.len()));
    }
    let mut joint_from_rest = vec![Mat4::IDENTITY; joints.len()];
    if let Some(index) = declared.inverse_bind_matrices {
        let matrices =
            document.accessor(index).and_then(|a| a.floats::<16>(None)).map_err(|f| f.at(place))?;
        for (matrix, read) in joint_from_rest.iter_mut().zip(matrices) {
            let read = Mat4::from_cols_array(&read);
            if read.is_finite() {
                *matrix = read;
            }
        }
    }
    let mut world_from_rest = Vec::with_capacity(joints.len());
    for (&joint, bind) in joints.iter().zip(&joint_from_rest) {
        let Some(world) = worlds.get(joint) else {
            return malformed(format!("{} has joint {joint}, but there is no such node", place()));
        };
        world_from_rest.push((*world * bind.as_dmat4()).as_mat4());
    }
    Ok(Pose { joints, joint_from_rest, world_from_rest })
}

impl Pose {
    /// Whether the pose mirrors what it moves, so that triangles must be wound the other way.
    pub(super) fn mirrors(&self) -> bool {
        let mirrored = self.world_from_rest.iter().filter(|m| m.determinant() < 0.0).count();
        mirrored * 2 > self.world_from_rest.len()
    }

    /// Moves a block's vertices into world space and keeps what they were.
    pub(super) fn apply(&self, joints: Vec<[u32; 4]>, weights: Vec<[f32; 4]>, block: &mut Block) {
        let mut skinning = Skinning {
            rest_positions: block.positions.clone(),
            rest_normals: block.normals.iter().map(|n| n.normalize_or(Vec3::Z)).collect(),
            joints: Vec::with_capacity(joints.len()),
            weights: Vec::with_capacity(weights.len()),
        };
        for (index, (joints, weights)) in joints.into_iter().zip(weights).enumerate() {
            let (joints, weights) = self.checked(joints, weights);
            let mut matrix = Mat4::ZERO;
            for (&joint, &weight) in joints.iter().zip(&weights) {
                if let Some(m) = self.world_from_rest.get(usize::from(joint))
                    && weight > 0.0
                {
                    matrix += *m * weight;
                }
            }
            if let Some(position) = block.positions.get_mut(index) {
                *position = matrix.transform_point3(*position);
            }
            if let Some(normal) = block.normals.get_mut(index) {
                *normal = normal_matrix(&matrix) * *normal;
            }
            if let Some(tangent) = block.tangents.get_mut(index) {
                *tangent = matrix.transform_vector3(tangent.xyz()).extend(tangent.w);
            }
            skinning.joints.push(joints);
            skinning.weights.push(weights);
        }
        block.skinning = Some(skinning);
    }

    /// Joints that exist with weights that add up to 1; all weight goes to the first joint where there is none.
    fn checked(&self, joints: [u32; 4], weights: [f32; 4]) -> ([u16; 4], [f32; 4]) {
        let mut out = ([0; 4], [0.0; 4]);
        let mut sum = 0.0;
        for (slot, (joint, weight)) in joints.into_iter().zip(weights).enumerate() {
            let exists = (joint as usize) < self.world_from_rest.len();
            if exists && weight.is_finite() && weight > 0.0 {
                if let (Some(j), Some(w)) = (out.0.get_mut(slot), out.1.get_mut(slot)) {
                    *j = joint as u16;
                    *w = weight;
                }
                sum += weight;
            }
        }
        if sum > 0.0 && sum.is_finite() {
            out.1 = out.1.map(|w| w / sum);
        } else {
            out = ([0; 4], [1.0, 0.0, 0.0, 0.0]);
        }
        out
    }
}

/// The matrix for normals: the cofactors, which also suit mirrored and flattened transforms.
fn normal_matrix(matrix: &Mat4) -> Mat3 {
    let m = Mat3::from_mat4(*matrix);
    let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    Mat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis)) * sign
}
