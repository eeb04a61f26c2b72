//! Seams between the nodes of a file: where an exporter has put one body into several, one for each material or face.

use std::collections::BTreeMap;
use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::border_links::link_meshes;
use crate::geometry::{Adjacency, SeamTolerance};
use crate::scene::Scene;

/// Links the borders of nodes that stand in the same place, and mends the seams between them; they stay nodes of their own.
/// What a file places by itself may be moved by itself, and what is shown several times or has bones has other neighbors each
/// time; these stay as they are.
pub fn link_nodes(scene: &mut Scene, tolerance: SeamTolerance) {
    let mut uses = vec![0; scene.meshes.len()];
    for mesh in scene.nodes.iter().filter_map(|node| node.mesh) {
        uses[mesh] += 1;
    }
    let mut in_place: BTreeMap<[u64; 16], Vec<usize>> = BTreeMap::new();
    for node in &scene.nodes {
        if let Some(mesh) = node.mesh
            && uses[mesh] == 1
            && scene.meshes[mesh].rig.is_none()
        {
            // 0 and −0 are the same place.
            let place = node.world_from_local.to_cols_array().map(|x| (x + 0.0).to_bits());
            in_place.entry(place).or_default().push(mesh);
        }
    }
    let linked: Vec<(usize, Arc<_>)> = in_place
        .into_values()
        .filter(|meshes| meshes.len() > 1)
        .flat_map(|meshes| {
            let open: Vec<_> = meshes
                .into_par_iter()
                .map(|number| (number, scene.meshes[number].as_ref()))
                .filter(|(_, mesh)| Adjacency::new(mesh).border_count > 0)
                .collect();
            let linked = if open.len() > 1 { link_meshes(&open, tolerance) } else { Vec::new() };
            let numbers: Vec<usize> = open.iter().map(|&(number, _)| number).collect();
            numbers.into_iter().zip(linked).filter_map(|(number, mesh)| Some((number, Arc::new(mesh?))))
        })
        .collect();
    for (number, mesh) in linked {
        scene.meshes[number] = mesh;
    }
}
