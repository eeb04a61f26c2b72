//! All primitives of a glTF mesh become one mesh with a part per material.

use std::collections::HashMap;
use std::sync::Arc;

use ::gltf::json::Root;
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use glam::{Vec3, Vec4};

use super::block::{self, Block, BlockKey};
use super::buffers::GltfDocument;
use super::fault::{Result, malformed};
use super::materials::{self, SurfaceNeeds};
use super::skin::{Pose, Skinning};
use super::tangents;
use crate::geometry::clean::clean;
use crate::geometry::{Mesh, Rig, Submesh};
use crate::scene::NodeId;

/// A mesh with what changes its vertices: nodes with equal requests share the result.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct MeshRequest {
    /// Index of the mesh in the file.
    pub(super) mesh: usize,
    /// Index of the skin that moves it.
    pub(super) skin: Option<usize>,
    /// Bits of the weights of its morph targets.
    pub(super) weights: Vec<u32>,
}

/// What became of a request.
#[derive(Debug)]
pub(super) struct Built {
    /// The mesh, unless no triangle is left.
    pub(super) mesh: Option<Mesh>,
    /// What a person should know.
    pub(super) notes: Vec<String>,
    /// Whether there were points or lines.
    pub(super) has_points_or_lines: bool,
    /// Whether there were triangles, good or bad.
    pub(super) has_triangles: bool,
}

/// Triangles of one material over the vertices of a block.
#[derive(Debug)]
struct Piece {
    block: usize,
    indices: Vec<u32>,
    material: usize,
    needs: SurfaceNeeds,
}

impl Piece {
    fn turn_over(&mut self) {
        for triangle in self.indices.as_chunks_mut::<3>().0 {
            triangle.swap(1, 2);
        }
    }
}

/// Whether all that is drawn of the mesh has joints and weights.
pub(super) fn is_skinnable(document: &GltfDocument<'_>, mesh: usize) -> bool {
    let has = |p: &Primitive, s| p.attributes.contains_key(&Checked::Valid(s));
    document.root.meshes.get(mesh).is_some_and(|mesh| {
        mesh.primitives
            .iter()
            .filter(|p| is_filled(p))
            .all(|p| has(p, Semantic::Joints(0)) && has(p, Semantic::Weights(0)))
    })
}

fn is_filled(primitive: &Primitive) -> bool {
    matches!(primitive.mode, Checked::Valid(Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan))
}

/// Reads a mesh. `node_of` tells where a joint stands among the scene's nodes.
///
/// # Errors
/// When an accessor is broken.
pub(super) fn build(
    document: &GltfDocument<'_>,
    request: &MeshRequest,
    pose: Option<&Pose>,
    node_of: impl Fn(usize) -> Option<NodeId>,
) -> Result<Built> {
    let root = &document.root;
    let Some(declared) = root.meshes.get(request.mesh) else {
        return malformed(format!("there is no mesh {}", request.mesh));
    };
    let weights: Vec<f32> = request.weights.iter().map(|&w| f32::from_bits(w)).collect();
    let mut notes = Vec::new();
    let mut blocks: Vec<Block> = Vec::new();
    let mut shared: HashMap<BlockKey, usize> = HashMap::new();
    let mut pieces: Vec<Piece> = Vec::new();
    let mut unfilled = 0;
    for (number, primitive) in declared.primitives.iter().enumerate() {
        let mode = match primitive.mode {
            Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => mode,
            Checked::Valid(_) => {
                unfilled += 1;
                continue;
            }
            Checked::Invalid => {
                notes.push(format!("primitive {number} is of an unknown kind and is left out"));
                continue;
            }
        };
        let at = |f: super::fault::Fault| f.at(|| format!("primitive {number}"));
        let Some(count) = block::vertex_count(document, primitive).map_err(at)? else {
            notes.push(format!("primitive {number} has no positions and is left out"));
            continue;
        };
        let material = material_of(root, primitive, number, &mut notes);
        let needs = materials::needs(root, material);
        let mut indices = read_indices(document, primitive, count).map_err(at)?;
        let picks = pick_used(&mut indices, count);
        let mut first_notes = Vec::new();
        let mut read = |picks: Option<&[u32]>| {
            block::read(document, primitive, needs, picks, &weights, pose, &mut first_notes).map_err(at)
        };
        let block = match &picks {
            Some(picks) => {
                blocks.push(read(Some(picks))?);
                blocks.len() - 1
            }
            None => match shared.get(&BlockKey::of(primitive, needs)) {
                Some(&block) => block,
                None => {
                    blocks.push(read(None)?);
                    shared.insert(BlockKey::of(primitive, needs), blocks.len() - 1);
                    blocks.len() - 1
                }
            },
        };
        notes.extend(first_notes.into_iter().map(|n| format!("primitive {number}: {n}")));
        let indices = triangles(document, mode, indices, number, &mut notes).map_err(at)?;
        pieces.push(Piece { block, indices, material, needs });
    }
    notes.extend(unfilled_note(unfilled));
    let has_triangles = !pieces.is_empty();
    if pose.is_some_and(Pose::mirrors) {
        pieces.iter_mut().for_each(Piece::turn_over);
    }
    complete_normals(document, &mut blocks, &mut pieces)?;
    complete_tangents(document, &mut blocks, &mut pieces, &mut notes)?;
    let (mut mesh, skinning) = merge(blocks, pieces)?;
    if let (Some(skinning), Some(pose)) = (skinning, pose) {
        mesh.rig = rig(skinning, pose, node_of).map(Arc::new);
    }
    let (mesh, report) = clean(mesh);
    notes.extend(report.messages());
    Ok(Built {
        mesh: (!mesh.indices.is_empty()).then_some(mesh),
        notes,
        has_points_or_lines: unfilled > 0,
        has_triangles,
    })
}

/// The material of a primitive; the one behind all of the file's if it has none.
fn material_of(root: &Root, primitive: &Primitive, number: usize, notes: &mut Vec<String>) -> usize {
    let known = primitive.material.map(|index| index.value()).filter(|index| *index < root.materials.len());
    if let (None, Some(index)) = (known, primitive.material) {
        notes.push(format!("primitive {number} uses material {index}, which does not exist"));
    }
    known.unwrap_or(root.materials.len())
}

fn unfilled_note(count: usize) -> Option<String> {
    let (s, are) = if count == 1 { ("", "is") } else { ("s", "are") };
    (count > 0).then(|| format!("{count} primitive{s} of points or lines {are} not drawn"))
}

/// The indices of a primitive, or 0, 1, 2, … where it has none.
fn read_indices(document: &GltfDocument<'_>, primitive: &Primitive, vertices: usize) -> Result<Vec<u32>> {
    match primitive.indices {
        Some(index) => {
            let indices = document.accessor(index)?.integers::<1>(None)?;
            Ok(bytemuck::cast_vec(indices))
        }
        None => {
            document.budget.take(vertices as u64 * 4, || "its triangles".into())?;
            Ok((0..vertices as u32).collect())
        }
    }
}

/// Where a primitive uses only few vertices of a large shared set: those, and `indices` are changed to count them.
fn pick_used(indices: &mut [u32], vertices: usize) -> Option<Vec<u32>> {
    if vertices / 2 <= indices.len() {
        return None;
    }
    let mut used: Vec<u32> = indices.iter().copied().filter(|&i| (i as usize) < vertices).collect();
    used.sort_unstable();
    used.dedup();
    for index in indices {
        *index = used.binary_search(index).map_or(u32::MAX, |place| place as u32);
    }
    Some(used)
}

/// Strips and fans become single triangles.
fn triangles(
    document: &GltfDocument<'_>,
    mode: Mode,
    mut indices: Vec<u32>,
    number: usize,
    notes: &mut Vec<String>,
) -> Result<Vec<u32>> {
    if mode == Mode::Triangles {
        let excess = indices.len() % 3;
        if excess > 0 {
            notes.push(format!(
                "primitive {number} has {} indices, which is no multiple of 3; the last {excess} are left out",
                indices.len()
            ));
            indices.truncate(indices.len() - excess);
        }
        return Ok(indices);
    }
    let count = indices.len().saturating_sub(2);
    document.budget.take(count as u64 * 12, || format!("its {count} triangles"))?;
    let first = indices.first().copied().unwrap_or(0);
    let mut out = Vec::with_capacity(count * 3);
    for (number, window) in indices.windows(3).enumerate() {
        if let &[a, b, c] = window {
            out.extend(match mode {
                Mode::TriangleFan => [first, b, c],
                _ if number % 2 == 0 => [a, b, c],
                _ => [a, c, b],
            });
        }
    }
    Ok(out)
}

/// Missing normals stay missing (the mesh is flat), unless other parts of the mesh have some or a normal map needs
/// them: then these parts get the normals of their faces.
fn complete_normals(
    document: &GltfDocument<'_>,
    blocks: &mut Vec<Block>,
    pieces: &mut [Piece],
) -> Result<()> {
    let some_have = blocks.iter().any(|b| !b.normals.is_empty());
    for piece in pieces {
        let Some(block) = blocks.get(piece.block) else {
            continue;
        };
        let needed = some_have || (piece.needs.tangents && !block.uvs.is_empty());
        if !block.normals.is_empty() || !needed {
            continue;
        }
        document.budget.take(piece.indices.len() as u64 * 48, || "flat normals for its triangles".into())?;
        let mut flat = block.unshared(&piece.indices);
        flat.set_flat_normals();
        piece.indices = (0..flat.positions.len() as u32).collect();
        piece.block = blocks.len();
        blocks.push(flat);
    }
    Ok(())
}

/// Computes tangents for parts with a normal map that have none.
fn complete_tangents(
    document: &GltfDocument<'_>,
    blocks: &mut Vec<Block>,
    pieces: &mut [Piece],
    notes: &mut Vec<String>,
) -> Result<()> {
    for block in blocks.iter_mut() {
        block.repair_tangents();
    }
    for piece in pieces {
        let Some(block) = blocks.get_mut(piece.block) else {
            continue;
        };
        let missing = block.tangents.is_empty() && !block.normals.is_empty();
        if !(piece.needs.tangents && missing && !block.uvs.is_empty()) {
            continue;
        }
        document.budget.take(piece.indices.len() as u64 * 100, || "tangents for its triangles".into())?;
        block.normalize();
        let is_finite = |i: &u32| block.positions.get(*i as usize).is_some_and(|p| p.is_finite());
        let whole = piece.indices.as_chunks::<3>().0;
        let indices: Vec<u32> = whole.iter().filter(|t| t.iter().all(is_finite)).flatten().copied().collect();
        match tangents::generate(block, &indices) {
            Some((split, indices)) => {
                piece.indices = indices;
                piece.block = blocks.len();
                blocks.push(split);
            }
            None => notes.push(
                "the tangents that its normal map needs could not be computed (too many triangles at one vertex); \
                 export the model with tangents"
                    .into(),
            ),
        }
    }
    Ok(())
}

/// Puts the pieces together, one part per material.
fn merge(blocks: Vec<Block>, mut pieces: Vec<Piece>) -> Result<(Mesh, Option<Skinning>)> {
    pieces.sort_by_key(|p| p.material);
    let mut used = vec![false; blocks.len()];
    for piece in &pieces {
        if let Some(used) = used.get_mut(piece.block) {
            *used = true;
        }
    }
    let shown = |i: &usize| used.get(*i) == Some(&true);
    let any = |has: fn(&Block) -> bool| blocks.iter().enumerate().any(|(i, b)| shown(&i) && has(b));
    let has_normals = any(|b| !b.normals.is_empty());
    let has_uvs = any(|b| !b.uvs.is_empty());
    let has_colors = any(|b| !b.colors.is_empty());
    let has_tangents = any(|b| !b.tangents.is_empty());
    let skinned = any(|b| b.skinning.is_some());

    let mut mesh = Mesh::default();
    let mut skin = Skinning::default();
    // For each block its first vertex in the mesh and the number of its vertices.
    let mut places = Vec::with_capacity(blocks.len());
    for (index, mut block) in blocks.into_iter().enumerate() {
        let count = if shown(&index) { block.positions.len() } else { 0 };
        places.push((mesh.positions.len(), count));
        if count == 0 {
            continue;
        }
        let filled = |wanted: bool, is_empty: bool| wanted && is_empty;
        if filled(has_normals, block.normals.is_empty()) {
            block.normals = vec![Vec3::Z; count];
        }
        if filled(has_uvs, block.uvs.is_empty()) {
            block.uvs = vec![glam::Vec2::ZERO; count];
        }
        if filled(has_colors, block.colors.is_empty()) {
            block.colors = vec![[255; 4]; count];
        }
        if filled(has_tangents, block.tangents.is_empty()) {
            block.tangents =
                block.normals.iter().map(|n| n.any_orthonormal_vector().extend(1.0)).collect::<Vec<Vec4>>();
        }
        if skinned {
            append_skinning(&mut skin, block.skinning.take().unwrap_or_default(), count, has_normals);
        }
        append(&mut mesh.positions, block.positions);
        append(&mut mesh.normals, block.normals);
        append(&mut mesh.uvs, block.uvs);
        append(&mut mesh.colors, block.colors);
        append(&mut mesh.tangents, block.tangents);
    }
    let index_count: usize = pieces.iter().map(|p| p.indices.len()).sum();
    if u32::try_from(mesh.positions.len().max(index_count)).is_err() {
        return malformed("it has more than 4294967295 vertices or indices");
    }
    let total = mesh.positions.len();
    for piece in pieces {
        let (first, count) = places.get(piece.block).copied().unwrap_or_default();
        let mut indices = piece.indices;
        if (first, count) != (0, total) {
            for index in &mut indices {
                *index = if (*index as usize) < count { *index + first as u32 } else { u32::MAX };
            }
        }
        let index_count = indices.len() as u32;
        match mesh.submeshes.last_mut() {
            Some(last) if last.material == piece.material => last.index_count += index_count,
            _ => mesh.submeshes.push(Submesh {
                first_index: mesh.indices.len() as u32,
                index_count,
                material: piece.material,
            }),
        }
        append(&mut mesh.indices, indices);
    }
    Ok((mesh, skinned.then_some(skin)))
}

/// Appends the skinning of so many vertices, of which it may have none.
fn append_skinning(skin: &mut Skinning, mut more: Skinning, count: usize, has_normals: bool) {
    more.rest_positions.resize(count, Vec3::ZERO);
    if has_normals {
        more.rest_normals.resize(count, Vec3::Z);
    }
    more.joints.resize(count, [0; 4]);
    more.weights.resize(count, [1.0, 0.0, 0.0, 0.0]);
    append(&mut skin.rest_positions, more.rest_positions);
    append(&mut skin.rest_normals, more.rest_normals);
    append(&mut skin.joints, more.joints);
    append(&mut skin.weights, more.weights);
}

/// Appends without a copy where there is nothing yet.
fn append<T: Copy>(all: &mut Vec<T>, more: Vec<T>) {
    if all.is_empty() {
        *all = more;
    } else {
        all.extend_from_slice(&more);
    }
}

/// The rig, unless a joint is no node of the scene.
fn rig(skinning: Skinning, pose: &Pose, node_of: impl Fn(usize) -> Option<NodeId>) -> Option<Rig> {
    Some(Rig {
        joints: pose.joints.iter().map(|&j| node_of(j)).collect::<Option<_>>()?,
        joint_from_rest: pose.joint_from_rest.clone(),
        rest_positions: skinning.rest_positions,
        rest_normals: skinning.rest_normals,
        vertex_joints: skinning.joints,
        vertex_weights: skinning.weights,
    })
}
