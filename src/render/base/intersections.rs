//! Where the objects of a model run through each other and through themselves: found once, in the background.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::document::Document;
use crate::geometry::intersections::{Placed, SearchedMesh, intersections};
use crate::geometry::{Bodies, Bounds, EdgeClass, IntersectionCurve, Weld, touching};
use crate::scene::{Node, NodeId, Scene};
use crate::style::{EdgeMode, Edges};

/// All intersections of a model. Clones share them.
#[derive(Debug, Clone)]
pub struct Intersections {
    /// By mesh, where it runs through itself.
    within: Arc<Vec<Vec<IntersectionCurve>>>,
    between: Arc<Vec<Between>>,
}

/// What topology found of a mesh.
#[derive(Debug, Clone)]
pub struct ExaminedMesh {
    /// Which of its vertices are one point.
    pub weld: Arc<Weld>,
    /// Its bodies.
    pub bodies: Arc<Bodies>,
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
    /// Finds the intersections of a scene, of whose meshes topology found `examined`: about a second per million triangles on two
    /// cores, as far as they lie where boxes of objects, or of bodies of one mesh, overlap. Elsewhere nothing is looked for: one
    /// body alone seldom runs through itself. `progress` is given the share that is done, 0 to 1, and says whether to go on: `None`
    /// when it did not.
    pub fn find(
        scene: &Scene,
        examined: &[ExaminedMesh],
        progress: &(dyn Fn(f32) -> bool + Sync),
    ) -> Option<Self> {
        let boxes = Boxes::new(scene);
        let pairs = touching(&boxes.of_nodes, 0.0);
        let regions = boxes.regions(scene, examined, &pairs);
        let searched = scene.meshes.par_iter().zip(examined).zip(&regions).with_max_len(1);
        let searched: Vec<SearchedMesh<'_>> = searched
            .map(|((mesh, examined), region)| SearchedMesh::new(mesh, &examined.weld, region))
            .collect();
        let all = searched.iter().map(SearchedMesh::triangle_count).sum::<usize>().max(1);
        let done = AtomicUsize::new(0);
        let goes_on = |triangles: usize| {
            let before = done.fetch_add(triangles, Ordering::Relaxed);
            progress((before + triangles) as f32 / all as f32)
        };
        let within = searched.par_iter().with_max_len(1).map(|mesh| mesh.own_intersections(&goes_on));
        let within = within.collect::<Option<Vec<_>>>()?;
        let between = pairs.into_par_iter().with_max_len(1).map(|nodes| {
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

/// The boxes of a scene.
struct Boxes {
    /// Local space.
    of_meshes: Vec<Bounds>,
    /// World space; empty where there is no mesh.
    of_nodes: Vec<Bounds>,
}

impl Boxes {
    fn new(scene: &Scene) -> Self {
        let of_meshes: Vec<Bounds> = scene.meshes.par_iter().map(|mesh| mesh.bounds()).collect();
        let of_node = |node: &Node| {
            let bounds = node.mesh.and_then(|mesh| of_meshes.get(mesh));
            bounds.map_or(Bounds::EMPTY, |bounds| bounds.transformed(&node.world_from_local))
        };
        let of_nodes = scene.nodes.iter().map(of_node).collect();
        Self { of_meshes, of_nodes }
    }

    /// Where in each mesh boxes of other objects, or of other bodies of its own, overlap; local space.
    fn regions(&self, scene: &Scene, examined: &[ExaminedMesh], pairs: &[[NodeId; 2]]) -> Vec<Bounds> {
        let own = scene.meshes.par_iter().zip(examined).map(|(mesh, own)| own.bodies.shared_region(mesh));
        let mut regions: Vec<Bounds> = own.collect();
        for &[one, other] in pairs {
            for (node, neighbor) in [(one, other), (other, one)] {
                let Some(node) = scene.nodes.get(node) else { continue };
                let neighbor = self.of_nodes[neighbor].transformed(&node.world_from_local.inverse());
                let mesh =
                    node.mesh.and_then(|mesh| Some((regions.get_mut(mesh)?, self.of_meshes.get(mesh)?)));
                if let Some((region, bounds)) = mesh {
                    *region = region.union(&neighbor.intersection(bounds));
                }
            }
        }
        regions
    }
}

/// Whether a document draws lines where objects of a scene run through each other.
pub fn draws_intersections(document: &Document, scene: &Scene) -> bool {
    let are_drawn = |edges: &Edges| edges.mode == EdgeMode::Exact && edges.line(EdgeClass::Intersection).show;
    let resolved = document.resolve(scene);
    resolved.iter().any(|node| node.visible && node.enhanced && are_drawn(&node.style.edges))
}
