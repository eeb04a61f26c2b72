//! Where the objects of a model run through each other and through themselves: found once, in the background.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::document::Document;
use crate::geometry::intersections::{Placed, SearchedMesh, intersections};
use crate::geometry::{Bounds, EdgeClass, IntersectionCurve, Weld};
use crate::scene::{NodeId, Scene};
use crate::style::{EdgeMode, Edges};

/// All intersections of a model. Clones share them.
#[derive(Debug, Clone)]
pub struct Intersections {
    /// By mesh, where it runs through itself.
    within: Arc<Vec<Vec<IntersectionCurve>>>,
    between: Arc<Vec<Between>>,
}

/// Where two objects run through each other.
#[derive(Debug)]
struct Between {
    nodes: [NodeId; 2],
    curves: Vec<IntersectionCurve>,
}

/// Where two objects run through each other, or one through itself.
#[derive(Debug, Clone, Copy)]
pub struct Meeting<'a> {
    /// The objects, which may be one.
    pub nodes: [NodeId; 2],
    /// The curves, in the space of the first object.
    pub curves: &'a [IntersectionCurve],
}

impl Intersections {
    /// Finds all intersections of a scene, whose meshes are welded as `welds` say: about a second per million triangles on two cores, and more where many objects
    /// share the same place. `progress` is given the share that is done, 0 to 1, and says whether to go on: `None` when it did not.
    pub fn find(scene: &Scene, welds: &[Arc<Weld>], progress: &(dyn Fn(f32) -> bool + Sync)) -> Option<Self> {
        // Trees take as long as what is done with them.
        let all = 2 * scene.meshes.iter().map(|mesh| mesh.triangle_count()).sum::<usize>().max(1);
        let done = AtomicUsize::new(0);
        let goes_on = |triangles: usize| {
            let before = done.fetch_add(triangles, Ordering::Relaxed);
            progress((before + triangles) as f32 / all as f32)
        };
        let searched = scene.meshes.par_iter().zip(welds).with_max_len(1).map(|(mesh, weld)| {
            let searched = SearchedMesh::new(mesh, weld);
            goes_on(mesh.triangle_count()).then_some(searched)
        });
        let searched = searched.collect::<Option<Vec<_>>>()?;
        let within = searched.par_iter().with_max_len(1).map(|mesh| mesh.own_intersections(&goes_on));
        let within = within.collect::<Option<Vec<_>>>()?;
        let between = overlapping_pairs(scene).into_par_iter().with_max_len(1).map(|nodes| {
            let placed = nodes.map(|node| {
                let node = scene.nodes.get(node)?;
                Some(Placed { mesh: searched.get(node.mesh?)?, world_from_local: node.world_from_local })
            });
            let [Some(one), Some(other)] = placed else {
                return Some(Between { nodes, curves: Vec::new() });
            };
            goes_on(0).then(|| Between { nodes, curves: intersections(one, other) })
        });
        let mut between = between.collect::<Option<Vec<_>>>()?;
        between.retain(|between| !between.curves.is_empty());
        Some(Self { within: Arc::new(within), between: Arc::new(between) })
    }

    /// All of them, for the scene that they were found in.
    pub fn iter<'a>(&'a self, scene: &'a Scene) -> impl Iterator<Item = Meeting<'a>> {
        let within = scene.nodes.iter().enumerate().filter_map(|(number, node)| {
            let curves = self.within.get(node.mesh?)?;
            Some(Meeting { nodes: [number; 2], curves })
        });
        let between =
            self.between.iter().map(|between| Meeting { nodes: between.nodes, curves: &between.curves });
        within.filter(|meeting| !meeting.curves.is_empty()).chain(between)
    }
}

/// The pairs of objects whose boxes overlap. The order of the pairs, and that within them, depends on the boxes alone: the order in
/// which a file lists its objects changes no picture.
fn overlapping_pairs(scene: &Scene) -> Vec<[NodeId; 2]> {
    let meshes: Vec<Bounds> = scene.meshes.par_iter().map(|mesh| mesh.bounds()).collect();
    let boxes = scene.nodes.iter().enumerate().filter_map(|(number, node)| {
        let bounds = meshes.get(node.mesh?).filter(|bounds| !bounds.is_empty())?;
        Some((number, bounds.transformed(&node.world_from_local)))
    });
    let mut boxes: Vec<(NodeId, Bounds)> = boxes.collect();
    let corners = |b: &Bounds| [b.min.to_array(), b.max.to_array()];
    boxes.sort_by(|(_, one), (_, other)| {
        corners(one).partial_cmp(&corners(other)).unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut pairs: Vec<[NodeId; 2]> = Vec::new();
    for (i, (one, own)) in boxes.iter().enumerate() {
        for (other, bounds) in boxes.iter().skip(i + 1).take_while(|(_, b)| b.min.x <= own.max.x) {
            if own.min.cmple(bounds.max).all() && bounds.min.cmple(own.max).all() {
                pairs.push([*one, *other]);
            }
        }
    }
    pairs
}

/// Whether a document draws lines where objects of a scene run through each other.
pub fn draws_intersections(document: &Document, scene: &Scene) -> bool {
    let are_drawn = |edges: &Edges| edges.mode == EdgeMode::Exact && edges.line(EdgeClass::Intersection).show;
    let resolved = document.resolve(scene);
    resolved.iter().any(|node| node.visible && node.enhanced && are_drawn(&node.style.edges))
}
