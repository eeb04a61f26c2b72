//! The vertices of a primitive, read from its accessors.

use ::gltf::json::accessor::Accessor as Declared;
use ::gltf::json::mesh::{Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, Root};
use glam::{Vec2, Vec3, Vec4};

use super::accessor::Accessor;
use super::buffers::GltfDocument;
use super::fault::{Result, malformed};
use super::materials::SurfaceNeeds;
use super::skin::{Pose, Skinning};

/// Vertices with their attributes. Each list is empty or as long as `positions`.
#[derive(Debug, Clone, Default)]
pub(super) struct Block {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) colors: Vec<[u8; 4]>,
    pub(super) tangents: Vec<Vec4>,
    pub(super) skinning: Option<Skinning>,
}

/// What a block is read from: primitives with equal keys share their vertices.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct BlockKey {
    attributes: Vec<(Semantic, usize)>,
    targets: Vec<[Option<usize>; 3]>,
    uv_set: Option<u32>,
    tangents: bool,
}

impl BlockKey {
    /// The key of a primitive whose material has these needs.
    pub(super) fn of(primitive: &Primitive, needs: SurfaceNeeds) -> Self {
        Self {
            attributes: primitive
                .attributes
                .iter()
                .filter_map(|(semantic, accessor)| match semantic {
                    Checked::Valid(Semantic::Extras(_)) | Checked::Invalid => None,
                    Checked::Valid(semantic) => Some((semantic.clone(), accessor.value())),
                })
                .collect(),
            targets: primitive
                .targets
                .iter()
                .flatten()
                .map(|t| [t.positions, t.normals, t.tangents].map(|i| i.map(|i| i.value())))
                .collect(),
            uv_set: needs.uv_set,
            tangents: needs.tangents,
        }
    }
}

/// The accessor of an attribute.
fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<Index<Declared>> {
    primitive.attributes.get(&Checked::Valid(semantic)).copied()
}

/// Number of vertices that a primitive refers to; `None` when it has no positions.
///
/// # Errors
/// When the accessor of the positions is broken.
pub(super) fn vertex_count(document: &GltfDocument<'_>, primitive: &Primitive) -> Result<Option<usize>> {
    match attribute(primitive, Semantic::Positions) {
        Some(index) => Ok(Some(document.accessor(index)?.count)),
        None => Ok(None),
    }
}

/// Reads the vertices of a primitive, or those that `picks` names; morph targets and skin are applied.
///
/// # Errors
/// When an accessor is broken or there are no positions.
pub(super) fn read(
    document: &GltfDocument<'_>,
    primitive: &Primitive,
    needs: SurfaceNeeds,
    picks: Option<&[u32]>,
    morph_weights: &[f32],
    pose: Option<&Pose>,
    notes: &mut Vec<String>,
) -> Result<Block> {
    let Some(positions) = attribute(primitive, Semantic::Positions) else {
        return malformed("it has no POSITION attribute");
    };
    let positions = document.accessor(positions)?;
    let declared = positions.count;
    let find = |semantic: Semantic, notes: &mut Vec<String>| -> Result<Option<Accessor<'_>>> {
        let Some(index) = attribute(primitive, semantic.clone()) else {
            return Ok(None);
        };
        let accessor = document.accessor(index)?;
        if accessor.count == declared {
            return Ok(Some(accessor));
        }
        notes.push(format!(
            "its {} are for {} vertices but it has {declared}; they are left out",
            semantic.to_string(),
            accessor.count
        ));
        Ok(None)
    };
    let mut block =
        Block { positions: bytemuck::cast_vec(positions.floats::<3>(picks)?), ..Block::default() };
    if let Some(normals) = find(Semantic::Normals, notes)? {
        block.normals = bytemuck::cast_vec(normals.floats::<3>(picks)?);
    }
    if let Some(set) = needs.uv_set.or(Some(0))
        && let Some(uvs) = find(Semantic::TexCoords(set), notes)?
    {
        block.uvs = bytemuck::cast_vec(uvs.floats::<2>(picks)?);
        for uv in &mut block.uvs {
            if !uv.is_finite() {
                *uv = Vec2::ZERO;
            }
        }
    }
    if let Some(colors) = find(Semantic::Colors(0), notes)? {
        block.colors = read_colors(&colors, picks)?;
    }
    if needs.tangents
        && !block.normals.is_empty()
        && let Some(tangents) = find(Semantic::Tangents, notes)?
    {
        let tangents = tangents.floats::<4>(picks)?;
        block.tangents = tangents.into_iter().map(Vec4::from_array).collect();
    }
    apply_morph(document, primitive, picks, declared, morph_weights, &mut block)?;
    if let Some(pose) = pose
        && let Some(joints) = find(Semantic::Joints(0), notes)?
        && let Some(weights) = find(Semantic::Weights(0), notes)?
    {
        if attribute(primitive, Semantic::Joints(1)).is_some() {
            notes.push("it has more than four joints per vertex; only the first four move it".into());
        }
        let joints = joints.integers::<4>(picks)?;
        let weights = weights.floats::<4>(picks)?;
        pose.apply(joints, weights, &mut block);
    }
    Ok(block)
}

fn read_colors(accessor: &Accessor<'_>, picks: Option<&[u32]>) -> Result<Vec<[u8; 4]>> {
    // NaN becomes 0, as all casts of floats saturate.
    let unorm = |v: f32| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    if accessor.width == 3 {
        let colors = accessor.floats::<3>(picks)?;
        Ok(colors.into_iter().map(|[r, g, b]| [unorm(r), unorm(g), unorm(b), 255]).collect())
    } else {
        let colors = accessor.floats::<4>(picks)?;
        Ok(colors.into_iter().map(|c| c.map(unorm)).collect())
    }
}

fn apply_morph(
    document: &GltfDocument<'_>,
    primitive: &Primitive,
    picks: Option<&[u32]>,
    declared: usize,
    weights: &[f32],
    block: &mut Block,
) -> Result<()> {
    for (target, &weight) in primitive.targets.iter().flatten().zip(weights) {
        if weight == 0.0 || !weight.is_finite() {
            continue;
        }
        let deltas = |index: Option<Index<Declared>>| -> Result<Vec<Vec3>> {
            let Some(index) = index else {
                return Ok(Vec::new());
            };
            let accessor = document.accessor(index)?;
            if accessor.count != declared {
                return malformed(format!(
                    "a morph target has {} vertices where {declared} are needed",
                    accessor.count
                ));
            }
            Ok(bytemuck::cast_vec(accessor.floats::<3>(picks)?))
        };
        for (position, delta) in block.positions.iter_mut().zip(deltas(target.positions)?) {
            *position += delta * weight;
        }
        if !block.normals.is_empty() {
            for (normal, delta) in block.normals.iter_mut().zip(deltas(target.normals)?) {
                *normal += delta * weight;
            }
        }
        if !block.tangents.is_empty() {
            for (tangent, delta) in block.tangents.iter_mut().zip(deltas(target.tangents)?) {
                *tangent += (delta * weight).extend(0.0);
            }
        }
    }
    Ok(())
}

impl Block {
    /// The block in which every corner of `indices` has a vertex of its own; corners out of range are left out with
    /// their triangle.
    pub(super) fn unshared(&self, indices: &[u32]) -> Self {
        let count = self.positions.len() as u64;
        let picks: Vec<u32> = indices
            .chunks_exact(3)
            .filter(|t| t.iter().all(|&i| u64::from(i) < count))
            .flatten()
            .copied()
            .collect();
        Self {
            positions: gather(&self.positions, &picks),
            normals: gather(&self.normals, &picks),
            uvs: gather(&self.uvs, &picks),
            colors: gather(&self.colors, &picks),
            tangents: gather(&self.tangents, &picks),
            skinning: self.skinning.as_ref().map(|s| s.gathered(&picks)),
        }
    }

    /// Gives the vertices of an unshared block the normals of their faces.
    pub(super) fn set_flat_normals(&mut self) {
        let flat = |positions: &[Vec3]| -> Vec<Vec3> {
            positions
                .chunks_exact(3)
                .flat_map(|corners| {
                    let normal = match corners {
                        [a, b, c] => (b - a).cross(c - a).normalize_or(Vec3::Z),
                        _ => Vec3::Z,
                    };
                    [normal; 3]
                })
                .collect()
        };
        self.normals = flat(&self.positions);
        if let Some(skinning) = &mut self.skinning {
            skinning.rest_normals = flat(&skinning.rest_positions);
        }
    }

    /// Makes normals unit length.
    pub(super) fn normalize(&mut self) {
        for normal in &mut self.normals {
            *normal = normal.normalize_or(Vec3::Z);
        }
    }

    /// Makes tangents unit length and their signs ±1.
    pub(super) fn repair_tangents(&mut self) {
        for (tangent, normal) in self.tangents.iter_mut().zip(&self.normals) {
            let direction =
                tangent.truncate().try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
            *tangent = direction.extend(if tangent.w < 0.0 { -1.0 } else { 1.0 });
        }
    }
}

/// The picked elements; empty when there are none at all.
pub(super) fn gather<T: Copy + Default>(all: &[T], picks: &[u32]) -> Vec<T> {
    if all.is_empty() {
        return Vec::new();
    }
    picks.iter().map(|&i| all.get(i as usize).copied().unwrap_or_default()).collect()
}

/// The weights of the morph targets: the node's, else the mesh's.
pub(super) fn morph_weights(root: &Root, node: usize) -> Vec<f32> {
    let Some(node) = root.nodes.get(node) else {
        return Vec::new();
    };
    let of_mesh = || {
        let mesh = root.meshes.get(node.mesh?.value())?;
        mesh.weights.clone()
    };
    node.weights.clone().or_else(of_mesh).unwrap_or_default()
}
