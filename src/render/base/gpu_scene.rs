//! A scene on the device, and what of it decides how it can be drawn.

use std::sync::{Arc, OnceLock};

use glam::{DMat4, DVec3};
use rayon::prelude::*;

use super::intersections::{ExaminedMesh, Intersections};
use super::section::{Section, SectionResult};
use super::stripes::{GpuStripes, SolvedStripes, StripePlace, StripeRequest};
use super::view::View;
use crate::document::Document;
use crate::geometry::{
    Bodies, Bounds, CreaseRule, FeatureEdges, FormAxis, Mesh, NotFlat, Plane, Topology, Weld, form_axes,
};
use crate::gpu::geometry::{MeshRange, MeshSource};
use crate::gpu::{GeometryBuffers, Gpu, GpuError, MaterialBindings};
use crate::scene::{Addition, AlphaMode, Material, NodeId, Scene};

/// Folds of additions that are sharper separate surfaces; radians.
const ADDED_CREASE_ANGLE: f32 = 0.5;

/// A scene on the device, and beside it what the program added to it. Clones share it.
#[derive(Clone)]
pub struct GpuScene {
    /// The scene itself, additions included.
    pub scene: Arc<Scene>,
    /// The same without them.
    model: Arc<Scene>,
    /// Its materials.
    pub materials: MaterialBindings,
    /// Of the model, which materials let something show through anywhere.
    blends: Arc<[bool]>,
    /// The meshes of the model, and those that were added: changing these touches nothing of the model.
    meshes: [MeshSet; 2],
    /// Its section, if it has one.
    pub section: Option<Section>,
    /// Diagonal of the box around the model, scene units.
    diagonal: f64,
    /// Stripes of hatching on the model; `None` while there are none for the triangles as they are.
    stripes: Option<GpuStripes>,
    /// All that have been found.
    solved: Vec<SolvedStripes>,
    /// Where the objects of the model run through each other; `None` while nobody knows.
    intersections: Option<Intersections>,
}

/// Which buffers hold a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// Those of the model.
    Model,
    /// Those of the additions.
    Added,
    /// [`Section::caps`].
    Caps,
}

/// Meshes in one set of buffers.
#[derive(Clone)]
struct MeshSet {
    geometry: GeometryBuffers,
    /// The box of each mesh, local space.
    bounds: Vec<Bounds>,
    /// The edges of each mesh that may become lines; empty until topology is known.
    edges: Vec<Arc<FeatureEdges>>,
    /// Which vertices of each mesh are one point; empty until topology is known.
    welds: Vec<Arc<Weld>>,
    /// Per mesh, whether it is solid; empty until topology is known.
    is_solid: Vec<bool>,
    /// The bodies of each mesh; empty until topology is known.
    bodies: Vec<Arc<Bodies>>,
    /// The plane of each mesh, once somebody asked for it.
    planes: Arc<[OnceLock<Result<Plane, NotFlat>>]>,
    /// The axes of the surfaces of each mesh, once somebody asked for them.
    form_axes: Arc<[OnceLock<Vec<FormAxis>>]>,
}

impl MeshSet {
    /// Uploads meshes. `topology` has one entry per mesh, or is empty: then all surface ids are 0.
    fn new(gpu: &Gpu, meshes: &[Arc<Mesh>], topology: &[Topology]) -> Result<Self, GpuError> {
        Ok(Self {
            geometry: upload(gpu, meshes, topology)?,
            bounds: meshes.iter().map(|m| m.bounds()).collect(),
            edges: edges(topology),
            welds: welds(topology),
            is_solid: topology.iter().map(|t| t.is_solid).collect(),
            bodies: bodies(topology),
            planes: meshes.iter().map(|_| OnceLock::new()).collect(),
            form_axes: meshes.iter().map(|_| OnceLock::new()).collect(),
        })
    }
}

impl GpuScene {
    /// Uploads a scene. `topology` has one entry per mesh, or is empty: then all surface ids are 0.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    fn new(
        gpu: &Gpu,
        material_layout: &wgpu::BindGroupLayout,
        scene: &Arc<Scene>,
        topology: &[Topology],
    ) -> Result<Self, GpuError> {
        Ok(Self {
            materials: MaterialBindings::new(gpu, material_layout, scene)?,
            blends: scene.materials.par_iter().enumerate().map(|(i, m)| blends(scene, i, m)).collect(),
            meshes: [MeshSet::new(gpu, &scene.meshes, topology)?, MeshSet::new(gpu, &[], &[])?],
            model: Arc::clone(scene),
            section: None,
            diagonal: diagonal_of(scene),
            stripes: None,
            solved: Vec::new(),
            intersections: None,
            scene: Arc::clone(scene),
        })
    }

    /// Takes over what topology found out meanwhile.
    pub fn set_topology(&mut self, uploaded: UploadedTopology) {
        let [model, _] = &mut self.meshes;
        model.geometry = uploaded.geometry;
        model.edges = uploaded.edges;
        model.welds = uploaded.welds;
        model.is_solid = uploaded.is_solid;
        model.bodies = uploaded.bodies;
        self.section = None;
        // Triangles lie in another order now.
        self.stripes = None;
    }

    /// Takes over stripes of the model.
    pub fn set_stripes(&mut self, stripes: GpuStripes) {
        self.solved = stripes.solved().to_vec();
        self.stripes = Some(stripes);
    }

    /// Takes over where the objects of the model run through each other.
    pub fn set_intersections(&mut self, intersections: Intersections) {
        self.intersections = Some(intersections);
    }

    /// Where the objects of the model run through each other, once that is known.
    pub fn intersections(&self) -> Option<&Intersections> {
        self.intersections.as_ref()
    }

    /// Stripes of the model on the device.
    pub fn stripes(&self) -> Option<&GpuStripes> {
        self.stripes.as_ref()
    }

    /// Where stripes lie on the device; `None`: they are not there.
    pub fn stripe_place(&self, request: &StripeRequest) -> Option<StripePlace> {
        self.stripes.as_ref()?.place(request)
    }

    /// All stripes that have been found, on the device or not.
    pub fn solved_stripes(&self) -> &[SolvedStripes] {
        &self.solved
    }

    /// Diagonal of the box around the model, scene units.
    pub fn diagonal(&self) -> f64 {
        self.diagonal
    }

    /// Puts these objects beside the model in place of those that were there; the model stays on the device as it is.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`]; the last ones then stay.
    pub fn set_additions(
        &mut self,
        gpu: &Gpu,
        additions: impl IntoIterator<Item = Addition>,
    ) -> Result<(), GpuError> {
        let scene = self.model.with_additions(additions);
        let (_, meshes) = scene.meshes.split_at(self.model.meshes.len());
        let topology: Vec<_> = meshes
            .par_iter()
            .map(|mesh| Topology::new(mesh, ADDED_CREASE_ANGLE, CreaseRule::default()))
            .collect();
        self.meshes[1] = MeshSet::new(gpu, meshes, &topology)?;
        let (own, others) = scene.materials.split_at(self.model.materials.len());
        self.materials = self.materials.with_others(own.len(), others);
        self.scene = Arc::new(scene);
        self.section = None;
        Ok(())
    }

    /// Turns what faces the eye to this view.
    pub fn face(&mut self, view: &View) {
        for index in 0..self.scene.facing.len() {
            let Some((node, facing)) = self.scene.facing.get(index).copied() else { continue };
            let place = view.facing(&facing);
            if self.scene.nodes.get(node).is_some_and(|n| n.world_from_local != place)
                && let Some(node) = Arc::make_mut(&mut self.scene).nodes.get_mut(node)
            {
                node.world_from_local = place;
            }
        }
    }

    /// The boxes of the model's meshes, local space.
    pub fn model_bounds(&self) -> &[Bounds] {
        &self.meshes[Origin::Model as usize].bounds
    }

    /// The scene without additions.
    pub fn model(&self) -> &Arc<Scene> {
        &self.model
    }

    /// Which buffers hold a mesh, and its number in them.
    fn place(&self, mesh: usize) -> (Origin, usize) {
        match mesh.checked_sub(self.model.meshes.len()) {
            None => (Origin::Model, mesh),
            Some(added) => (Origin::Added, added),
        }
    }

    fn set(&self, mesh: usize) -> (&MeshSet, usize) {
        let (origin, number) = self.place(mesh);
        (&self.meshes[origin as usize], number)
    }

    /// Some of the buffers. Without a section there are none of caps, nor is anything drawn that would be in them.
    pub fn geometry(&self, origin: Origin) -> &GeometryBuffers {
        let [model, added] = &self.meshes;
        match (origin, &self.section) {
            (Origin::Caps, Some(section)) => &section.caps,
            (Origin::Added, _) => &added.geometry,
            (Origin::Model | Origin::Caps, _) => &model.geometry,
        }
    }

    /// Where a mesh lies in which buffers.
    pub fn range_of(&self, mesh: usize) -> Option<(Origin, MeshRange)> {
        let (origin, number) = self.place(mesh);
        Some((origin, *self.geometry(origin).meshes.get(number)?))
    }

    /// The box of a mesh, local space; empty if there is none.
    pub fn mesh_bounds(&self, mesh: usize) -> Bounds {
        let (set, number) = self.set(mesh);
        set.bounds.get(number).copied().unwrap_or(Bounds::EMPTY)
    }

    /// The edges of a mesh that may become lines, once topology is known.
    pub fn edges(&self, mesh: usize) -> Option<&FeatureEdges> {
        let (set, number) = self.set(mesh);
        set.edges.get(number).map(Arc::as_ref)
    }

    /// Which vertices of a mesh are one point, once topology is known.
    pub fn weld(&self, mesh: usize) -> Option<&Weld> {
        let (set, number) = self.set(mesh);
        set.welds.get(number).map(Arc::as_ref)
    }

    /// Whether topology of the model is known.
    pub fn is_examined(&self) -> bool {
        !self.meshes[Origin::Model as usize].welds.is_empty()
    }

    /// What topology found of each mesh of the model; empty until that is known.
    pub fn examined_meshes(&self) -> Vec<ExaminedMesh> {
        let MeshSet { welds, bodies, .. } = &self.meshes[Origin::Model as usize];
        let both = welds.iter().zip(bodies);
        both.map(|(weld, bodies)| ExaminedMesh { weld: Arc::clone(weld), bodies: Arc::clone(bodies) })
            .collect()
    }

    /// Whether a mesh is known to enclose a volume: all of its bodies do.
    pub fn is_solid(&self, mesh: usize) -> bool {
        let (set, number) = self.set(mesh);
        set.is_solid.get(number).copied().unwrap_or(false)
    }

    /// The bodies of a mesh, once topology is known.
    pub fn bodies(&self, mesh: usize) -> Option<&Bodies> {
        let (set, number) = self.set(mesh);
        set.bodies.get(number).map(Arc::as_ref)
    }

    /// Sections it as a document asks for. Returns whether that changed anything.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn set_section(&mut self, gpu: &Gpu, document: &Document) -> Result<bool, GpuError> {
        let section = Section::new(gpu, document, self, self.section.as_ref())?;
        let is_same = match (&section, &self.section) {
            (Some(new), Some(old)) => new.is_same_section(old),
            (new, old) => new.is_none() && old.is_none(),
        };
        self.section = section;
        Ok(!is_same)
    }

    /// Whether a section leaves nothing of a node's mesh.
    pub fn is_clipped_away(&self, node: NodeId) -> bool {
        self.section.as_ref().is_some_and(|section| *section.result_for(node) == SectionResult::Removed)
    }

    /// Whether a section cuts a node's mesh open.
    pub fn is_sectioned(&self, node: NodeId) -> bool {
        self.section.as_ref().is_some_and(|section| section.sectioned(node).is_some())
    }

    /// Whether a node shows no inside: its mesh, or what a section leaves of it with its cap, encloses a volume.
    pub fn shows_no_inside(&self, node: NodeId) -> bool {
        match self.section.as_ref().and_then(|section| section.sectioned(node)) {
            Some(sectioned) => sectioned.is_solid,
            None => self.scene.nodes[node].mesh.is_some_and(|mesh| self.is_solid(mesh)),
        }
    }

    /// Which side of a node's triangles nobody can see: solids wholly before the eye show no back face.
    pub fn culled_face(
        &self,
        node: NodeId,
        view_from_local: &DMat4,
        orthographic: bool,
    ) -> Option<wgpu::Face> {
        let is_solid = self.shows_no_inside(node);
        let bounds = self.scene.nodes[node].mesh.map_or(Bounds::EMPTY, |mesh| self.mesh_bounds(mesh));
        let is_before_the_eye = orthographic || bounds.transformed(view_from_local).max.z < 0.0;
        let mirrored = view_from_local.determinant() < 0.0;
        (is_solid && is_before_the_eye).then_some(if mirrored { wgpu::Face::Front } else { wgpu::Face::Back })
    }

    /// How a material uses its alpha: many files say of what is opaque everywhere that it blends.
    pub fn alpha(&self, material: usize) -> AlphaMode {
        let alpha = self.scene.materials.get(material).map_or(AlphaMode::Opaque, |m| m.alpha);
        let is_opaque = alpha == AlphaMode::Blend && self.blends.get(material) == Some(&false);
        if is_opaque { AlphaMode::Opaque } else { alpha }
    }

    /// How the materials of a node's parts use their alpha.
    pub fn alphas(&self, node: NodeId) -> impl Iterator<Item = AlphaMode> {
        let mesh = self.scene.nodes[node].mesh.and_then(|m| self.scene.meshes.get(m));
        mesh.into_iter().flat_map(|mesh| mesh.submeshes.iter().map(|part| self.alpha(part.material)))
    }

    /// Whether any material of a node has holes by alpha.
    pub fn has_holes(&self, node: NodeId) -> bool {
        self.alphas(node).any(|alpha| alpha != AlphaMode::Opaque)
    }

    /// Whether any material of a node has a relief.
    pub fn has_relief(&self, node: NodeId) -> bool {
        let mesh = self.scene.nodes[node].mesh.and_then(|m| self.scene.meshes.get(m));
        let mut materials = mesh
            .into_iter()
            .flat_map(|m| &m.submeshes)
            .filter_map(|part| self.scene.materials.get(part.material));
        materials.any(|material| material.normal_texture.is_some())
    }

    /// Whether a node's mesh has texture coordinates.
    pub fn has_uvs(&self, node: NodeId) -> bool {
        let mesh = self.scene.nodes[node].mesh.and_then(|m| self.scene.meshes.get(m));
        mesh.is_some_and(|mesh| !mesh.uvs.is_empty())
    }

    /// The plane of a node's own mesh, world space.
    ///
    /// # Errors
    /// [`NotFlat`].
    pub fn plane_of(&self, node: NodeId) -> Result<Plane, NotFlat> {
        let node = &self.scene.nodes[node];
        let plane = node.mesh.and_then(|m| {
            let (set, number) = self.set(m);
            Some((set.planes.get(number)?, self.scene.meshes.get(m)?))
        });
        let (plane, mesh) = plane.ok_or(NotFlat::NoArea)?;
        plane.get_or_init(|| Plane::of_mesh(mesh)).and_then(|p| p.transformed(&node.world_from_local))
    }

    /// The axis of each surface of a node's own mesh, local space; empty until topology is known.
    pub fn form_axes(&self, node: NodeId) -> &[FormAxis] {
        let Some(m) = self.scene.nodes[node].mesh else { return &[] };
        let (set, number) = self.set(m);
        match (set.form_axes.get(number), self.scene.meshes.get(m), set.edges.get(number)) {
            (Some(axes), Some(mesh), Some(edges)) => axes.get_or_init(|| form_axes(mesh, edges.surfaces())),
            _ => &[],
        }
    }

    /// The corners of the box around a node's own mesh in its own space, world space, in the order of
    /// [`Bounds::corners`].
    pub fn corners_of(&self, node: NodeId) -> [DVec3; 8] {
        let node = &self.scene.nodes[node];
        let bounds = node.mesh.map_or(Bounds::EMPTY, |m| self.mesh_bounds(m));
        bounds.corners().map(|corner| node.world_from_local.transform_point3(corner))
    }

    /// The box of a node's own mesh, world space; of what faces the eye only the point where it is.
    pub fn bounds_of(&self, node: NodeId) -> Bounds {
        if let Some(facing) = self.scene.facing_of(node) {
            return Bounds { min: facing.anchor, max: facing.anchor };
        }
        let node = &self.scene.nodes[node];
        node.mesh.map_or(Bounds::EMPTY, |m| self.mesh_bounds(m).transformed(&node.world_from_local))
    }
}

fn diagonal_of(scene: &Scene) -> f64 {
    let meshes: Vec<Bounds> = scene.meshes.par_iter().map(|mesh| mesh.bounds()).collect();
    let boxes = scene.nodes.iter().filter_map(|node| {
        let bounds = meshes.get(node.mesh?).filter(|bounds| !bounds.is_empty())?;
        Some(bounds.transformed(&node.world_from_local))
    });
    let all = boxes.fold(Bounds::EMPTY, |all, bounds| all.union(&bounds));
    if all.is_empty() { 0.0 } else { (all.max - all.min).length() }
}

/// Whether anything shows through a material anywhere.
fn blends(scene: &Scene, number: usize, material: &Material) -> bool {
    let image = material.base_color_texture.as_ref().and_then(|t| scene.textures.get(t.texture));
    let has_alpha = |texels: &[u8]| texels.chunks_exact(4).any(|texel| texel[3] < u8::MAX);
    let mut meshes = scene.meshes.iter().filter(|m| m.submeshes.iter().any(|part| part.material == number));
    material.alpha == AlphaMode::Blend
        && (material.base_color.w < 1.0
            || image.is_some_and(|image| has_alpha(&image.rgba))
            || meshes.any(|mesh| mesh.colors.iter().any(|color| color[3] < u8::MAX)))
}

/// The findings of topology on the device, for the scene from which they were made.
pub struct UploadedTopology {
    geometry: GeometryBuffers,
    edges: Vec<Arc<FeatureEdges>>,
    welds: Vec<Arc<Weld>>,
    is_solid: Vec<bool>,
    bodies: Vec<Arc<Bodies>>,
}

fn edges(topology: &[Topology]) -> Vec<Arc<FeatureEdges>> {
    topology.iter().map(|t| Arc::clone(&t.edges)).collect()
}

fn welds(topology: &[Topology]) -> Vec<Arc<Weld>> {
    topology.iter().map(|t| Arc::clone(&t.weld)).collect()
}

fn bodies(topology: &[Topology]) -> Vec<Arc<Bodies>> {
    topology.iter().map(|t| Arc::clone(&t.bodies)).collect()
}

/// Uploads scenes, from any thread: large ones take longer than a window may wait. Clones share the device.
#[derive(Clone)]
pub struct Uploader {
    gpu: Gpu,
    material_layout: wgpu::BindGroupLayout,
}

impl Uploader {
    /// Uploads to this device, for pipelines with this layout of materials.
    pub fn new(gpu: &Gpu, material_layout: &wgpu::BindGroupLayout) -> Self {
        Self { gpu: gpu.clone(), material_layout: material_layout.clone() }
    }

    /// Uploads a scene. `topology` has one entry per mesh, or is empty while it is not known.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn scene(&self, scene: &Arc<Scene>, topology: &[Topology]) -> Result<GpuScene, GpuError> {
        GpuScene::new(&self.gpu, &self.material_layout, scene, topology)
    }

    /// Uploads stripes of a scene; `topology`: of its meshes, as they are on the device.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn stripes(
        &self,
        scene: &Scene,
        topology: &[Topology],
        solved: Vec<SolvedStripes>,
    ) -> Result<GpuStripes, GpuError> {
        GpuStripes::new(&self.gpu, scene, topology, solved)
    }

    /// Uploads what topology found out about the meshes of a scene, one entry each.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn topology(&self, scene: &Scene, topology: &[Topology]) -> Result<UploadedTopology, GpuError> {
        Ok(UploadedTopology {
            geometry: upload(&self.gpu, &scene.meshes, topology)?,
            edges: edges(topology),
            welds: welds(topology),
            is_solid: topology.iter().map(|t| t.is_solid).collect(),
            bodies: bodies(topology),
        })
    }
}

fn upload(gpu: &Gpu, meshes: &[Arc<Mesh>], topology: &[Topology]) -> Result<GeometryBuffers, GpuError> {
    let sources: Vec<_> = meshes
        .iter()
        .enumerate()
        .map(|(i, mesh)| MeshSource { mesh, surfaces: topology.get(i).map(|t| &t.provoking) })
        .collect();
    GeometryBuffers::new(gpu, &sources)
}
