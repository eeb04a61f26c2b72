//! The node hierarchy: which nodes a scene shows, where they stand, what they are called. No recursion, so that the
//! depth of a file's hierarchy does not matter.

use ::gltf::json::{Node as Declared, Root};
use glam::{DMat4, DQuat, DVec3};

use super::buffers::label;
use super::fault::{Result, malformed};
use crate::import::memory_budget::MemoryBudget;
use crate::import::names::SiblingNames;
use crate::scene::{Node, NodeId};

/// The nodes of the scene that is shown.
#[derive(Debug)]
pub(super) struct Hierarchy {
    /// The file's root first, then the scene's nodes, depth first. Meshes are not filled in.
    pub(super) nodes: Vec<Node>,
    /// For each of `nodes` the index of the node in the file; `None` for the root.
    pub(super) sources: Vec<Option<usize>>,
    /// For each node of the file where it stands.
    pub(super) worlds: Vec<DMat4>,
    /// For each node of the file its place in `nodes`.
    pub(super) shown_as: Vec<Option<NodeId>>,
    /// What a person should know.
    pub(super) warnings: Vec<String>,
}

/// Flattens the file's default scene below a root of the given name.
///
/// # Errors
/// When the nodes do not form trees, refer to nodes that do not exist, or their names would take too much memory.
pub(super) fn flatten(root: &Root, file_name: &str, budget: &MemoryBudget) -> Result<Hierarchy> {
    let mut warnings = Vec::new();
    let parents = parents(root)?;
    let order = top_down(root, &parents)?;
    let worlds = worlds(root, &parents, &order, &mut warnings);
    let roots = scene_roots(root, &parents, &order, &mut warnings)?;

    let name = SiblingNames::default().unique(file_name);
    let path = format!("/{name}");
    let mut out = Hierarchy {
        nodes: vec![Node {
            name,
            path,
            parent: None,
            descendants: 0,
            world_from_local: DMat4::IDENTITY,
            mesh: None,
        }],
        sources: vec![None],
        shown_as: vec![None; root.nodes.len()],
        worlds,
        warnings,
    };

    let mut waiting: Vec<(usize, NodeId, String)> = Vec::new();
    let push_children = |waiting: &mut Vec<_>, children: &[usize], parent: NodeId| {
        let mut names = SiblingNames::default();
        let first = waiting.len();
        for &child in children {
            waiting.push((child, parent, names.unique(&wanted_name(root, child))));
        }
        if let Some(new) = waiting.get_mut(first..) {
            new.reverse();
        }
    };
    push_children(&mut waiting, &roots, 0);
    while let Some((source, parent, name)) = waiting.pop() {
        let id = out.nodes.len();
        let above = out.nodes.get(parent).map_or("", |n| n.path.as_str());
        let length = above.len() + 1 + name.len();
        budget.take((length + name.len() + 256) as u64, || "the paths of the nodes".into())?;
        let mut path = String::with_capacity(length);
        path.push_str(above);
        path.push('/');
        path.push_str(&name);
        out.nodes.push(Node {
            path,
            name,
            parent: Some(parent),
            descendants: 0,
            world_from_local: out.worlds.get(source).copied().unwrap_or_default(),
            mesh: None,
        });
        out.sources.push(Some(source));
        if let Some(place) = out.shown_as.get_mut(source) {
            *place = Some(id);
        }
        let children: Vec<usize> = children_of(root.nodes.get(source)).collect();
        push_children(&mut waiting, &children, id);
    }
    count_descendants(&mut out.nodes);
    Ok(out)
}

/// Fills in `descendants` of nodes in depth-first order.
pub(super) fn count_descendants(nodes: &mut [Node]) {
    for id in (0..nodes.len()).rev() {
        let Some((below, parent)) = nodes.get(id).map(|n| (n.descendants + 1, n.parent)) else {
            continue;
        };
        if let Some(above) = parent.and_then(|p| nodes.get_mut(p)) {
            above.descendants += below;
        }
    }
}

fn children_of(node: Option<&Declared>) -> impl Iterator<Item = usize> + '_ {
    node.and_then(|n| n.children.as_ref()).into_iter().flatten().map(|c| c.value())
}

/// The node's own name, else that of its mesh, camera, …
fn wanted_name(root: &Root, index: usize) -> String {
    let Some(node) = root.nodes.get(index) else {
        return String::new();
    };
    let mesh_name = || {
        let mesh = root.meshes.get(node.mesh?.value())?;
        mesh.name.clone().filter(|n| !n.is_empty())
    };
    let camera_name = || {
        let camera = root.cameras.get(node.camera?.value())?;
        camera.name.clone().filter(|n| !n.is_empty())
    };
    node.name.clone().filter(|n| !n.is_empty()).or_else(mesh_name).or_else(camera_name).unwrap_or_default()
}

/// A node's name for messages.
pub(super) fn node_label(root: &Root, index: usize) -> String {
    let name = root.nodes.get(index).and_then(|n| n.name.as_ref());
    label("node", index, name)
}

fn parents(root: &Root) -> Result<Vec<Option<usize>>> {
    let mut parents: Vec<Option<usize>> = vec![None; root.nodes.len()];
    for (index, node) in root.nodes.iter().enumerate() {
        for child in children_of(Some(node)) {
            let Some(parent) = parents.get_mut(child) else {
                return malformed(format!(
                    "{} has a child {child}, but there is no such node",
                    node_label(root, index)
                ));
            };
            if let Some(first) = parent.replace(index) {
                return malformed(format!(
                    "{} has two parents ({} and {}); a node may hang below one only",
                    node_label(root, child),
                    node_label(root, first),
                    node_label(root, index)
                ));
            }
        }
    }
    Ok(parents)
}

/// All nodes, parents before children.
fn top_down(root: &Root, parents: &[Option<usize>]) -> Result<Vec<usize>> {
    let mut order: Vec<usize> = Vec::with_capacity(parents.len());
    let mut placed = vec![false; parents.len()];
    for (index, parent) in parents.iter().enumerate() {
        if parent.is_none() {
            order.push(index);
        }
    }
    let mut at = 0;
    while let Some(&index) = order.get(at) {
        if let Some(p) = placed.get_mut(index) {
            *p = true;
        }
        order.extend(children_of(root.nodes.get(index)));
        at += 1;
    }
    match placed.iter().position(|p| !p) {
        None => Ok(order),
        Some(index) => {
            malformed(format!("{} is its own ancestor; the node graph has a cycle", node_label(root, index)))
        }
    }
}

fn worlds(root: &Root, parents: &[Option<usize>], order: &[usize], warnings: &mut Vec<String>) -> Vec<DMat4> {
    let mut worlds = vec![DMat4::IDENTITY; root.nodes.len()];
    for &index in order {
        let Some(node) = root.nodes.get(index) else {
            continue;
        };
        let parent = parents.get(index).copied().flatten();
        let above = parent.and_then(|p| worlds.get(p)).copied().unwrap_or_default();
        let mut world = above * local_transform(node);
        if !world.is_finite() {
            warnings.push(format!(
                "{} has a transform that is not finite; it stays where its parent is",
                node_label(root, index)
            ));
            world = above;
        }
        if let Some(place) = worlds.get_mut(index) {
            *place = world;
        }
    }
    worlds
}

fn local_transform(node: &Declared) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |v: Option<[f32; 3]>, default| v.map_or(default, |v| DVec3::from_array(v.map(f64::from)));
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |q| {
        let q = DQuat::from_array(q.0.map(f64::from));
        let length = q.length();
        if length.is_finite() && length > 0.0 { q / length } else { DQuat::IDENTITY }
    });
    DMat4::from_translation(vector(node.translation, DVec3::ZERO))
        * DMat4::from_quat(rotation)
        * DMat4::from_scale(vector(node.scale, DVec3::ONE))
}

/// The top nodes of the default scene, else of the first one, else all nodes without a parent.
fn scene_roots(
    root: &Root,
    parents: &[Option<usize>],
    order: &[usize],
    warnings: &mut Vec<String>,
) -> Result<Vec<usize>> {
    let chosen = root.scene.map_or(0, |s| s.value());
    let Some(scene) = root.scenes.get(chosen) else {
        if root.scene.is_some() {
            return malformed(format!(
                "the default scene is number {chosen}, but there are {} scenes",
                root.scenes.len()
            ));
        }
        return Ok((0..parents.len()).filter(|&n| parents.get(n).copied().flatten().is_none()).collect());
    };
    let mut listed = vec![false; parents.len()];
    let mut roots = Vec::with_capacity(scene.nodes.len());
    for node in scene.nodes.iter().map(|n| n.value()) {
        match listed.get_mut(node) {
            Some(seen) if *seen => {}
            Some(seen) => {
                *seen = true;
                roots.push(node);
            }
            None => {
                return malformed(format!("scene {chosen} shows node {node}, but there is no such node"));
            }
        }
    }
    // A node that is listed although an ancestor is listed too must not be shown twice.
    let mut covered = vec![false; parents.len()];
    for &node in order {
        let Some(Some(parent)) = parents.get(node).copied() else {
            continue;
        };
        let is_covered = listed.get(parent) == Some(&true) || covered.get(parent) == Some(&true);
        if let Some(place) = covered.get_mut(node) {
            *place = is_covered;
        }
    }
    roots.retain(|&node| {
        let twice = covered.get(node) == Some(&true);
        if twice {
            warnings.push(format!(
                "{} is listed as a root of the scene and hangs below another of its nodes; it is shown once",
                node_label(root, node)
            ));
        }
        !twice
    });
    Ok(roots)
}
