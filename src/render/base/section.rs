//! The section of a scene: which objects a plane cuts, where, and the caps of the solids among them, on the device.

mod neighbors;

use std::sync::Arc;

use glam::{DMat4, DVec3, DVec4};
use rayon::prelude::*;

use self::neighbors::{CapNumber, numbers};
use super::gpu_scene::GpuScene;
use crate::document::Document;
use crate::document::section::{Fill, SectionSettings};
use crate::geometry::section::{Cap, Contour, Filling, contours, fill};
use crate::geometry::{Bounds, Mesh, Plane, Provoking, Submesh};
use crate::gpu::geometry::{MeshRange, MeshSource};
use crate::gpu::{GeometryBuffers, Gpu, GpuError};
use crate::scene::NodeId;

/// So far before the plane caps lie; share of the diagonal of everything. What lies less than half of that before the
/// plane is cut away, so that caps are not, and faces in the plane are.
const MARGIN: f64 = 1e-5;

/// Where solids reach into each other, caps lie so far above each other that depth tells them apart: by this share of the
/// margin, the smallest one topmost.
const STEP: f64 = 0.5;

/// No cap lies more steps below the topmost.
const LOWEST: u32 = 24;

/// What becomes of an object.
#[derive(Debug, Clone, PartialEq)]
pub enum SectionResult {
    /// The plane leaves all of it.
    Untouched,
    /// The plane leaves nothing of it.
    Removed,
    /// The plane cuts it open.
    Cut(SectionedObject),
}

/// An object that is cut open.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SectionedObject {
    /// Where; empty while topology is not known.
    pub contours: Vec<Contour>,
    /// How far below the other caps' plane its cap and its contours lie, scene units.
    pub depth: f64,
    /// Its cap, if it has one.
    pub cap: Option<PlacedCap>,
    /// Whether what is left of it encloses a volume.
    pub is_solid: bool,
    /// Number of bodies that the plane cuts and that have no cap because they are not solid; 0 if there are no caps.
    pub open_count: usize,
}

/// A cap on the device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedCap {
    /// Where its vertices lie.
    pub range: MeshRange,
    /// Number of its indices.
    pub index_count: u32,
    /// Its surface, which no triangle of the object has.
    pub surface: u32,
    /// The box around it, in the plane's coordinates.
    pub bounds: Bounds,
    /// A small number; objects that may touch each other have different ones.
    pub pattern: u32,
}

/// What sections depend on.
#[derive(Debug, Clone, PartialEq)]
struct Key {
    plane: Plane,
    right: DVec3,
    has_caps: bool,
    visible: Vec<NodeId>,
}

/// A section of a scene. Clones share it.
#[derive(Clone)]
pub struct Section {
    /// How it looks.
    pub style: SectionSettings,
    /// The section plane: what lies beyond it is cut away. World space, its product with (point, 1) is the distance before it.
    pub plane: DVec4,
    /// Where the topmost caps lie: x and y run in the plane, z beyond it, to what is cut away.
    world_from_plane: DMat4,
    /// Vertices of the caps.
    pub caps: GeometryBuffers,
    results: Arc<Vec<SectionResult>>,
    numbers: Arc<Vec<CapNumber>>,
    key: Key,
}

impl Section {
    /// The section that a document asks for, if it does. `last` is given back where it is still right.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn new(
        gpu: &Gpu,
        document: &Document,
        scene: &GpuScene,
        last: Option<&Self>,
    ) -> Result<Option<Self>, GpuError> {
        let style = &document.section;
        if !style.show {
            return Ok(None);
        }
        let up = document.up(&scene.scene);
        // Of all objects: hiding one does not move the plane.
        let nodes = 0..scene.scene.nodes.len();
        let bounds = nodes.fold(Bounds::EMPTY, |all, node| all.union(&scene.bounds_of(node)));
        let Some(plane) = style.plane(up, &bounds) else { return Ok(None) };
        let resolved = document.resolve(&scene.scene);
        let is_object = |node: &NodeId| scene.scene.nodes[*node].mesh.is_some();
        let key = Key {
            plane,
            right: up.vector().cross(plane.normal).try_normalize().unwrap_or(up.vector().cross(up.front())),
            has_caps: style.cap != Fill::None,
            visible: (0..resolved.len()).filter(|&n| resolved[n].visible).filter(is_object).collect(),
        };
        if let Some(last) = last.filter(|last| last.key == key) {
            return Ok(Some(Self { style: style.clone(), ..last.clone() }));
        }
        let margin = bounds.diagonal() * MARGIN;
        let numbers = match last.filter(|last| last.key.visible == key.visible) {
            Some(last) => Arc::clone(&last.numbers),
            None => Arc::new(numbers(scene, &key.visible, margin)),
        };
        Self::build(gpu, scene, style, margin, numbers, key).map(Some)
    }

    fn build(
        gpu: &Gpu,
        scene: &GpuScene,
        style: &SectionSettings,
        margin: f64,
        numbers: Arc<Vec<CapNumber>>,
        key: Key,
    ) -> Result<Self, GpuError> {
        let caps_at = Plane { point: key.plane.point - key.plane.normal * margin, ..key.plane };
        let world_from_plane = caps_at.world_from_plane(key.right);
        let plane_from_world = world_from_plane.inverse();
        let found: Vec<_> = key
            .visible
            .par_iter()
            .with_max_len(1)
            .map(|&node| open(scene, node, &plane_from_world, key.has_caps))
            .collect();
        let mut results = vec![SectionResult::Untouched; scene.scene.nodes.len()];
        let (mut meshes, mut capped) = (Vec::new(), Vec::new());
        for (&node, (part, cap)) in key.visible.iter().zip(found) {
            if let Some(cap) = cap {
                let mesh = scene.scene.nodes[node].mesh.and_then(|mesh| scene.scene.meshes.get(mesh));
                let surface = mesh.map_or(0, |mesh| mesh.triangle_count() as u32);
                meshes.push(mesh_of(&cap, surface));
                capped.push((node, surface));
            }
            results[node] = part;
            if let SectionResult::Cut(sectioned) = &mut results[node] {
                let level = numbers.get(node).copied().unwrap_or_default().level;
                sectioned.depth = STEP * margin * f64::from(level.min(LOWEST));
            }
        }
        let sources: Vec<_> =
            meshes.iter().map(|(mesh, surfaces)| MeshSource { mesh, surfaces: Some(surfaces) }).collect();
        let caps = GeometryBuffers::new(gpu, &sources)?;
        for (((node, surface), (mesh, _)), &range) in capped.into_iter().zip(&meshes).zip(&caps.meshes) {
            if let SectionResult::Cut(sectioned) = &mut results[node] {
                let index_count = mesh.indices.len() as u32;
                let pattern = numbers.get(node).copied().unwrap_or_default().pattern;
                sectioned.cap =
                    Some(PlacedCap { range, index_count, surface, bounds: mesh.bounds(), pattern });
            }
        }
        let plane = -(key.plane.equation() + DVec4::W * (0.5 * margin));
        let results = Arc::new(results);
        Ok(Self { style: style.clone(), plane, world_from_plane, caps, results, numbers, key })
    }

    /// What becomes of an object.
    pub fn result_for(&self, node: NodeId) -> &SectionResult {
        self.results.get(node).unwrap_or(&SectionResult::Untouched)
    }

    /// An object, if it is cut open.
    pub fn sectioned(&self, node: NodeId) -> Option<&SectionedObject> {
        match self.result_for(node) {
            SectionResult::Cut(sectioned) => Some(sectioned),
            SectionResult::Untouched | SectionResult::Removed => None,
        }
    }

    /// Where the contours of an object and its cap lie: x and y run in the plane, z is 0.
    pub fn world_from_cap(&self, sectioned: &SectionedObject) -> DMat4 {
        self.world_from_plane * DMat4::from_translation(DVec3::new(0.0, 0.0, -sectioned.depth))
    }

    /// The plane itself, and a direction in it that is as horizontal as it allows.
    pub fn place(&self) -> (Plane, DVec3) {
        (self.key.plane, self.key.right)
    }

    /// Number of bodies that it cuts and that have no cap, for they enclose no volume.
    pub fn open_bodies(&self) -> usize {
        let open = |part: &SectionResult| {
            if let SectionResult::Cut(sectioned) = part { sectioned.open_count } else { 0 }
        };
        self.results.iter().map(open).sum()
    }

    /// Whether anything has a cap.
    pub fn has_caps(&self) -> bool {
        !self.caps.meshes.is_empty()
    }

    /// Whether both cut the same objects at the same place.
    pub fn is_same_section(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.results, &other.results)
    }
}

/// What becomes of an object, and the cap of the solid bodies that are cut open.
fn open(
    scene: &GpuScene,
    node: NodeId,
    plane_from_world: &DMat4,
    has_caps: bool,
) -> (SectionResult, Option<Cap>) {
    let place = &scene.scene.nodes[node];
    let Some(number) = place.mesh else { return (SectionResult::Untouched, None) };
    let plane_from_local = *plane_from_world * place.world_from_local;
    let bounds = scene.mesh_bounds(number);
    let heights = bounds.corners().map(|corner| plane_from_local.transform_point3(corner).z);
    if bounds.is_empty() || heights.iter().all(|&z| z < 0.0) {
        return (SectionResult::Untouched, None);
    }
    if heights.iter().all(|&z| z >= 0.0) {
        return (SectionResult::Removed, None);
    }
    let known = (scene.scene.meshes.get(number), scene.weld(number), scene.bodies(number));
    let (Some(mesh), Some(weld), Some(bodies)) = known else {
        return (SectionResult::Cut(SectionedObject { is_solid: false, ..SectionedObject::default() }), None);
    };
    let contours = contours(mesh, weld, &plane_from_local);
    let Filling { cap, open_count } =
        if has_caps { fill(&contours, bodies, &plane_from_local) } else { Filling::default() };
    // Where no body is cut, each is whole or gone.
    let is_closed = contours.is_empty() || cap.is_some() && open_count == 0;
    let is_solid = scene.is_solid(number) && is_closed;
    (
        SectionResult::Cut(SectionedObject { contours, is_solid, open_count, ..SectionedObject::default() }),
        cap,
    )
}

/// A cap as a mesh, all of one surface.
fn mesh_of(cap: &Cap, surface: u32) -> (Mesh, Provoking) {
    let indices = cap.triangles.as_flattened().to_vec();
    let submeshes = vec![Submesh { first_index: 0, index_count: indices.len() as u32, material: 0 }];
    let positions: Vec<_> = cap.points.iter().map(|p| p.as_vec2().extend(0.0)).collect();
    let surface_of_vertex = vec![surface; positions.len()];
    let surfaces = Provoking { indices: indices.clone(), duplicates: Vec::new(), surface_of_vertex };
    (Mesh { positions, indices, submeshes, ..Mesh::default() }, surfaces)
}
