//! glTF 2.0, as JSON with side files or as GLB.
//!
//! The typed JSON of the `gltf` crate is read, but none of its accessors, which trust the file: every index, range
//! and count is checked here.

mod accessor;
mod block;
mod buffers;
mod cameras_and_lights;
mod container;
mod fault;
mod materials;
mod meshes;
mod meshopt;
mod nodes;
mod skin;
mod tangents;
#[cfg(test)]
mod tests;

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;
use std::sync::Arc;

use ::gltf::json::Root;
use glam::DMat4;
use rayon::prelude::*;

use self::buffers::{GltfDocument, label};
use self::fault::{Fault, Result};
use self::meshes::{Built, MeshRequest};
use self::nodes::Hierarchy;
use super::names::file_stem;
use super::source::Folder;
use super::{ImportError, ImportOptions, Progress};
use crate::geometry::Mesh;
use crate::geometry::mend::mended;
use crate::scene::{Node, Scene, Up, Warning};

/// Reads a glTF or GLB file whose content is `data`; side files are looked for beside `path`.
///
/// # Errors
/// See [`ImportError`].
pub(super) fn load(
    path: &Path,
    data: &[u8],
    options: &ImportOptions,
    progress: &Progress,
) -> std::result::Result<Scene, ImportError> {
    import(path, data, options, progress).map_err(|fault| fault.of_file(path))
}

fn import(path: &Path, data: &[u8], options: &ImportOptions, progress: &Progress) -> Result<Scene> {
    let file = path.file_name().unwrap_or(path.as_os_str());
    let file = file.to_string_lossy().into_owned();
    let warning = |place: &str, message: String| Warning {
        place: if place.is_empty() { file.clone() } else { format!("{file}, {place}") },
        message,
    };
    let mut warnings = Vec::new();

    let chunks = container::split(data)?;
    let (root, repaired) = container::parse(chunks.json)?;
    if repaired {
        warnings
            .push(warning("", "its text is not UTF-8; unreadable characters in names were replaced".into()));
    }
    if root.extensions_used.iter().any(|name| name == "EXT_mesh_gpu_instancing") {
        let message =
            "it uses EXT_mesh_gpu_instancing, which is not supported: one copy of each object is shown";
        warnings.push(warning("", message.into()));
    }
    progress.report(0.1);
    let folder = Folder::of(path);
    let document = GltfDocument::open(root, data.len(), chunks.bin, &folder, progress)?;
    let root = &document.root;
    progress.report(0.3);

    let mut hierarchy = nodes::flatten(root, &file_stem(path), &document.budget)?;
    for message in std::mem::take(&mut hierarchy.warnings) {
        warnings.push(warning("", message));
    }
    let (requests, wanted) = requests(&document, &hierarchy);
    if requests.is_empty() {
        return Err(Fault::Empty(no_mesh_reason(root)));
    }
    progress.report(0.35);
    let built = build_all(&document, &requests, &hierarchy, options, progress)?;
    let mut meshes = Vec::new();
    let mut places = Vec::with_capacity(built.len());
    let (mut has_triangles, mut has_others) = (false, false);
    for (built, request) in built.into_iter().zip(&requests) {
        has_triangles |= built.has_triangles;
        has_others |= built.has_points_or_lines;
        let name = root.meshes.get(request.mesh).and_then(|m| m.name.as_ref());
        let place = label("mesh", request.mesh, name);
        warnings.extend(built.notes.into_iter().map(|note| warning(&place, note)));
        places.push(built.mesh.as_ref().map(|_| meshes.len()));
        meshes.extend(built.mesh.map(Arc::new));
    }
    if meshes.is_empty() {
        return Err(Fault::Empty(no_triangles_reason(has_triangles, has_others).into()));
    }
    hang_meshes(&mut hierarchy.nodes, &wanted, &requests, &places);
    progress.report(0.7);

    let used = used_materials(&meshes, root.materials.len() + 1);
    let mut notes = Vec::new();
    let (mut materials, textures) = materials::convert(&document, &folder, &used, progress, &mut notes)?;
    if used.last() == Some(&false) {
        materials.pop();
    }
    warnings.extend(notes.into_iter().map(|(place, note)| warning(&place, note)));

    let mut scene = Scene {
        nodes: hierarchy.nodes,
        meshes,
        materials,
        textures,
        warnings,
        up: Up::PosY,
        meters_per_unit: Some(1.0),
        ..Scene::default()
    };
    cameras_and_lights::add(root, &hierarchy.sources, &hierarchy.worlds, &mut scene);
    progress.report(1.0);
    Ok(scene)
}

/// Gives each node its mesh. `wanted`: the request of each node; `places`: the mesh of each request.
fn hang_meshes(
    nodes: &mut [Node],
    wanted: &[Option<usize>],
    requests: &[MeshRequest],
    places: &[Option<usize>],
) {
    for (node, request) in nodes.iter_mut().zip(wanted) {
        let Some(request) = *request else {
            continue;
        };
        node.mesh = places.get(request).copied().flatten();
        if requests.get(request).is_some_and(|r| r.skin.is_some()) {
            // Skinning has put the vertices into world space.
            node.world_from_local = DMat4::IDENTITY;
        }
    }
}

fn no_triangles_reason(has_triangles: bool, has_others: bool) -> &'static str {
    match (has_triangles, has_others) {
        (false, true) => "it holds only points or lines, which are not drawn",
        (false, false) => "its meshes have no triangles",
        (true, _) => {
            "all its triangles are damaged or degenerate (indices out of range, coordinates that are no numbers, or \
             no area)"
        }
    }
}

/// For each of so many materials whether any triangle has it.
fn used_materials(meshes: &[Arc<Mesh>], count: usize) -> Vec<bool> {
    let mut used = vec![false; count];
    for part in meshes.iter().flat_map(|m| &m.submeshes) {
        if let Some(used) = used.get_mut(part.material) {
            *used = true;
        }
    }
    used
}

/// The different meshes that the shown nodes ask for, and for each node which of them.
fn requests(document: &GltfDocument<'_>, hierarchy: &Hierarchy) -> (Vec<MeshRequest>, Vec<Option<usize>>) {
    let root = &document.root;
    let mut requests = Vec::new();
    let mut known = HashMap::new();
    let wanted = hierarchy
        .sources
        .iter()
        .map(|source| {
            let index = (*source)?;
            let node = root.nodes.get(index)?;
            let mesh = node.mesh?.value();
            let declared = root.meshes.get(mesh);
            let morphs = declared.is_some_and(|m| m.primitives.iter().any(|p| p.targets.is_some()));
            let weights = if morphs { block::morph_weights(root, index) } else { Vec::new() };
            let request = MeshRequest {
                mesh,
                skin: node.skin.map(|s| s.value()).filter(|_| meshes::is_skinnable(document, mesh)),
                weights: weights.into_iter().map(f32::to_bits).collect(),
            };
            Some(*known.entry(request.clone()).or_insert_with(|| {
                requests.push(request);
                requests.len() - 1
            }))
        })
        .collect();
    (requests, wanted)
}

fn build_all(
    document: &GltfDocument<'_>,
    requests: &[MeshRequest],
    hierarchy: &Hierarchy,
    options: &ImportOptions,
    progress: &Progress,
) -> Result<Vec<Built>> {
    let mut poses = HashMap::new();
    for skin in requests.iter().filter_map(|r| r.skin) {
        if let Entry::Vacant(place) = poses.entry(skin) {
            place.insert(skin::pose(document, skin, &hierarchy.worlds)?);
        }
    }
    let node_of = |node: usize| hierarchy.shown_as.get(node).copied().flatten();
    requests
        .par_iter()
        .map(|request| {
            progress.check()?;
            let pose = request.skin.and_then(|skin| poses.get(&skin));
            let built = meshes::build(document, request, pose, node_of).map_err(|f| {
                let mesh = document.root.meshes.get(request.mesh);
                f.at(|| label("mesh", request.mesh, mesh.and_then(|m| m.name.as_ref())))
            })?;
            let mesh = built.mesh.map(|mesh| mended(mesh, options.seams));
            Ok(Built { mesh, ..built })
        })
        .collect()
}

fn no_mesh_reason(root: &Root) -> String {
    if root.meshes.is_empty() {
        "the file has no meshes".into()
    } else if root.nodes.is_empty() {
        "the file has meshes but no nodes that show them".into()
    } else {
        "no node of the default scene shows a mesh".into()
    }
}
