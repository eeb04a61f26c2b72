//! A scene on the device, and what of it decides how it can be drawn.

use std::sync::{Arc, OnceLock};

use glam::{DMat4, DVec3};

use super::groups::Source;
use super::section::{Part, Section};
use crate::document::Document;
use crate::geometry::{Bounds, FeatureEdges, NotFlat, Plane, Topology, Weld};
use crate::gpu::geometry::MeshSource;
use crate::gpu::{GeometryBuffers, Gpu, GpuError, MaterialBindings};
use crate::scene::{AlphaMode, NodeId, Scene};

/// A scene on the device. Clones share it.
#[derive(Clone)]
pub struct GpuScene {
    /// The scene itself.
    pub scene: Arc<Scene>,
    /// Its vertices.
    pub geometry: GeometryBuffers,
    /// Its materials.
    pub materials: MaterialBindings,
    /// The box of each mesh, local space.
    pub mesh_bounds: Vec<Bounds>,
    /// The edges of each mesh that may become lines; empty until topology is known.
    pub edges: Vec<Arc<FeatureEdges>>,
    /// Which vertices of each mesh are one point; empty until topology is known.
    pub welds: Vec<Arc<Weld>>,
    /// Per mesh, whether it is solid; empty until topology is known.
    is_solid: Vec<bool>,
    /// Where it is cut open, if it is.
    pub section: Option<Section>,
    /// The plane of each mesh, once somebody asked for it.
    planes: Arc<[OnceLock<Result<Plane, NotFlat>>]>,
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
            geometry: upload(gpu, scene, topology)?,
            materials: MaterialBindings::new(gpu, material_layout, scene)?,
            mesh_bounds: scene.meshes.iter().map(|m| m.bounds()).collect(),
            edges: edges(topology),
            welds: welds(topology),
            is_solid: topology.iter().map(|t| t.is_solid).collect(),
            section: None,
            planes: scene.meshes.iter().map(|_| OnceLock::new()).collect(),
            scene: Arc::clone(scene),
        })
    }

    /// Takes over what topology found out meanwhile.
    pub fn set_topology(&mut self, uploaded: UploadedTopology) {
        self.geometry = uploaded.geometry;
        self.edges = uploaded.edges;
        self.welds = uploaded.welds;
        self.section = None;
        self.is_solid = uploaded.is_solid;
    }

    /// The vertices of a kind; `None` when there are none.
    pub fn geometry_of(&self, source: Source) -> Option<&GeometryBuffers> {
        match source {
            Source::Model => Some(&self.geometry),
            Source::Caps => self.section.as_ref()?.geometry.as_ref(),
        }
    }

    /// Whether a mesh is known to enclose a volume.
    pub fn is_solid(&self, mesh: usize) -> bool {
        self.is_solid.get(mesh).copied().unwrap_or(false)
    }

    /// Cuts it open as a document asks for. Returns whether that changed anything.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn cut(&mut self, gpu: &Gpu, document: &Document) -> Result<bool, GpuError> {
        let section = Section::new(gpu, document, self, self.section.as_ref())?;
        let is_same = match (&section, &self.section) {
            (Some(new), Some(old)) => new.is_same_cut(old),
            (new, old) => new.is_none() && old.is_none(),
        };
        self.section = section;
        Ok(!is_same)
    }

    /// Whether a section leaves nothing of a node's mesh.
    pub fn is_cut_away(&self, node: NodeId) -> bool {
        self.section.as_ref().is_some_and(|section| *section.part(node) == Part::Gone)
    }

    /// Whether a node shows no inside: its mesh encloses a volume, and where it is cut open it has a cap.
    pub fn shows_no_inside(&self, node: NodeId) -> bool {
        let opened = self.section.as_ref().and_then(|section| section.opened(node));
        self.scene.nodes[node].mesh.is_some_and(|mesh| self.is_solid(mesh))
            && opened.is_none_or(|opened| opened.cap.is_some())
    }

    /// Number of triangles of a node's mesh.
    pub fn triangle_count(&self, node: NodeId) -> u32 {
        let mesh = self.scene.nodes[node].mesh.and_then(|m| self.scene.meshes.get(m));
        mesh.map_or(0, |mesh| mesh.triangle_count() as u32)
    }

    /// Which side of a node's triangles nobody can see: solids wholly before the eye show no back face.
    pub fn hidden_side(
        &self,
        node: NodeId,
        view_from_local: &DMat4,
        orthographic: bool,
    ) -> Option<wgpu::Face> {
        let is_solid = self.shows_no_inside(node);
        let mesh = self.scene.nodes[node].mesh.unwrap_or(usize::MAX);
        let is_before_the_eye = orthographic
            || self.mesh_bounds.get(mesh).is_some_and(|b| b.transformed(view_from_local).max.z < 0.0);
        let mirrored = view_from_local.determinant() < 0.0;
        (is_solid && is_before_the_eye).then_some(if mirrored { wgpu::Face::Front } else { wgpu::Face::Back })
    }

    /// Whether any material of a node has holes by alpha.
    pub fn has_holes(&self, node: NodeId) -> bool {
        let mesh = self.scene.nodes[node].mesh.and_then(|m| self.scene.meshes.get(m));
        mesh.is_some_and(|mesh| {
            mesh.parts.iter().any(|part| {
                self.scene.materials.get(part.material).is_some_and(|m| m.alpha != AlphaMode::Opaque)
            })
        })
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
        let mesh = node.mesh.and_then(|m| Some((self.planes.get(m)?, self.scene.meshes.get(m)?)));
        let (plane, mesh) = mesh.ok_or(NotFlat::NoArea)?;
        plane.get_or_init(|| Plane::of_mesh(mesh)).and_then(|p| p.transformed(&node.world_from_local))
    }

    /// The corners of the box around a node's own mesh in its own space, world space, in the order of
    /// [`Bounds::corners`].
    pub fn corners_of(&self, node: NodeId) -> [DVec3; 8] {
        let node = &self.scene.nodes[node];
        let bounds = node.mesh.and_then(|m| self.mesh_bounds.get(m)).copied().unwrap_or(Bounds::EMPTY);
        bounds.corners().map(|corner| node.world_from_local.transform_point3(corner))
    }

    /// The box of a node's own mesh, world space.
    pub fn bounds_of(&self, node: NodeId) -> Bounds {
        let node = &self.scene.nodes[node];
        node.mesh
            .and_then(|m| self.mesh_bounds.get(m))
            .map_or(Bounds::EMPTY, |b| b.transformed(&node.world_from_local))
    }
}

/// The findings of topology on the device, for the scene from which they were made.
pub struct UploadedTopology {
    geometry: GeometryBuffers,
    edges: Vec<Arc<FeatureEdges>>,
    welds: Vec<Arc<Weld>>,
    is_solid: Vec<bool>,
}

fn edges(topology: &[Topology]) -> Vec<Arc<FeatureEdges>> {
    topology.iter().map(|t| Arc::clone(&t.edges)).collect()
}

fn welds(topology: &[Topology]) -> Vec<Arc<Weld>> {
    topology.iter().map(|t| Arc::clone(&t.weld)).collect()
}

/// Uploads scenes, from any thread: large ones take longer than a window may wait. Clones share the device.
#[derive(Clone)]
pub struct Uploader {
    gpu: Gpu,
    material_layout: wgpu::BindGroupLayout,
}

impl Uploader {
    /// Uploads to this device, for pipelines with this layout of materials.
    pub(super) fn new(gpu: &Gpu, material_layout: &wgpu::BindGroupLayout) -> Self {
        Self { gpu: gpu.clone(), material_layout: material_layout.clone() }
    }

    /// Uploads a scene. `topology` has one entry per mesh, or is empty while it is not known.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn scene(&self, scene: &Arc<Scene>, topology: &[Topology]) -> Result<GpuScene, GpuError> {
        GpuScene::new(&self.gpu, &self.material_layout, scene, topology)
    }

    /// Uploads what topology found out about the meshes of a scene, one entry each.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn topology(&self, scene: &Scene, topology: &[Topology]) -> Result<UploadedTopology, GpuError> {
        Ok(UploadedTopology {
            geometry: upload(&self.gpu, scene, topology)?,
            edges: edges(topology),
            welds: welds(topology),
            is_solid: topology.iter().map(|t| t.is_solid).collect(),
        })
    }
}

fn upload(gpu: &Gpu, scene: &Scene, topology: &[Topology]) -> Result<GeometryBuffers, GpuError> {
    let sources: Vec<_> = scene
        .meshes
        .iter()
        .enumerate()
        .map(|(i, mesh)| MeshSource { mesh, surfaces: topology.get(i).map(|t| &t.provoking) })
        .collect();
    GeometryBuffers::new(gpu, &sources)
}
