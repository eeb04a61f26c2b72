//! What a job loads: model files and documents.

use std::path::PathBuf;
use std::sync::Arc;

use crate::document::{Document, DocumentError, DocumentFile, Glyph, ViewSettings};
use crate::export::session::{import_options, is_document};
use crate::geometry::Bounds;
use crate::gpu::GpuError;
use crate::import::{ImportError, ImportOptions, Progress};
use crate::render::{GpuScene, Uploader};
use crate::scene::{Extent, MeasuredMesh, Node, NodeId, Scene, Warning};
use crate::style::Color;
use glam::DVec3;

/// How models become a scene; the tests put slow or failing ones in place of [`crate::import::load_all`].
pub type Loader =
    Arc<dyn Fn(&[PathBuf], &ImportOptions, &Progress) -> Result<Scene, ImportError> + Send + Sync>;

/// What is to become of a loaded scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intent {
    /// It takes the place of everything.
    Open,
    /// It is what was there and more.
    Add,
    /// It is what was there, read again.
    Reload,
    /// An undo changed the list of models.
    Restore,
}

/// A scene with what the window needs to know about it.
#[derive(Debug, Clone, Default)]
pub struct Model {
    /// What the files hold.
    pub files: Arc<Scene>,
    /// The same with the document's glyphs: what panels and selections are about.
    pub scene: Arc<Scene>,
    /// The glyphs and the paper for which that holds, and what is wrong with them.
    glyphs: (Vec<Glyph>, Color),
    /// Glyphs that are not drawn, or not as they were meant.
    pub glyph_warnings: Vec<Warning>,
    /// The box of each mesh of the files, local space.
    mesh_bounds: Vec<Bounds>,
    /// How far each node's own mesh reaches, world space.
    pub extents: Vec<Extent>,
    /// The box around everything, in units of the scene.
    pub bounds: Bounds,
    /// Its diagonal.
    pub diagonal: f64,
    /// Triangles of each node's own mesh.
    pub triangles: Vec<usize>,
}

impl Model {
    /// Measures a scene; takes a while for large ones.
    pub fn new(scene: Scene) -> Self {
        let measured: Vec<_> = scene.meshes.iter().map(MeasuredMesh::new).collect();
        let extent = |node: &Node| {
            let own = node.mesh.and_then(|m| measured.get(m));
            own.map_or_else(Extent::default, |mesh| Extent::of_mesh(mesh, node.world_from_local))
        };
        let extents = scene.nodes.iter().map(extent).collect();
        let triangles = scene
            .nodes
            .iter()
            .map(|n| n.mesh.and_then(|m| scene.meshes.get(m)).map_or(0, |m| m.triangle_count()))
            .collect();
        let bounds = scene.bounds();
        let mesh_bounds = measured.iter().map(|m| *m.bounds()).collect();
        let files = Arc::new(scene);
        let scene = Arc::clone(&files);
        Self {
            files,
            scene,
            extents,
            bounds,
            diagonal: bounds.diagonal(),
            triangles,
            mesh_bounds,
            ..Self::default()
        }
    }

    /// Takes over a document's glyphs. Returns whether anything changed.
    pub fn show_glyphs(&mut self, document: &Document) -> bool {
        let (glyphs, paper) = document.glyph_inputs();
        if self.glyphs.0 == glyphs && (glyphs.is_empty() || self.glyphs.1 == paper) {
            return false;
        }
        let shapes = document.glyph_shapes(&self.files, &self.mesh_bounds);
        self.glyphs = (glyphs.to_vec(), paper);
        self.glyph_warnings = shapes.warnings;
        let own = self.files.nodes.len();
        self.extents.truncate(own);
        self.triangles.truncate(own);
        for addition in &shapes.additions {
            // What faces the eye has no size of its own.
            self.extents.push(if addition.facing.is_some() {
                Extent::of_point(addition.world_from_local.transform_point3(DVec3::ZERO))
            } else {
                Extent::of_mesh(
                    &MeasuredMesh::new(&Arc::new(addition.mesh.clone())),
                    addition.world_from_local,
                )
            });
            self.triangles.push(addition.mesh.triangle_count());
        }
        self.scene = Arc::new(self.files.with_additions(shapes.additions));
        true
    }

    /// Triangles of some nodes.
    pub fn triangle_count(&self, nodes: impl IntoIterator<Item = NodeId>) -> usize {
        nodes.into_iter().filter_map(|n| self.triangles.get(n)).sum()
    }

    /// How far some nodes reach, world space: what a camera has to frame.
    pub fn extent_of(&self, nodes: impl IntoIterator<Item = NodeId>) -> Extent {
        Extent::of_all(nodes.into_iter().filter_map(|n| self.extents.get(n)))
    }

    /// Those of everything that a document shows; of everything if it shows nothing.
    pub fn visible_extent(&self, document: &Document) -> Extent {
        let resolved = document.resolve(&self.scene);
        let visible = resolved.iter().enumerate().filter(|(_, r)| r.visible).map(|(n, _)| n);
        let extent = self.extent_of(visible);
        if extent.is_empty() { Extent::of_all(&self.extents) } else { extent }
    }
}

/// The result of a load.
pub struct Loaded {
    /// The scene.
    pub model: Model,
    /// The same on the device.
    pub on_device: GpuScene,
    /// All models in it.
    pub models: Vec<PathBuf>,
    /// The document that was opened, and its file.
    pub document: Option<(PathBuf, Document)>,
    /// What is to become of it.
    pub intent: Intent,
}

/// Why a load failed.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// A model.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// A document.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// The device cannot hold it.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// Loads `paths` and uploads what is in them; the first document among them is opened and brings its models along.
/// Files are read as `view` asks for; an opened document brings its own.
///
/// # Errors
/// The first file that fails.
pub fn load(
    paths: &[PathBuf],
    intent: Intent,
    view: &ViewSettings,
    loader: &Loader,
    uploader: &Uploader,
    progress: &Progress,
) -> Result<Loaded, LoadError> {
    let absolute = |p: &PathBuf| std::path::absolute(p).unwrap_or_else(|_unknown| p.clone());
    let mut models = Vec::new();
    let mut document = None;
    let mut warnings = Vec::new();
    for path in paths.iter().map(absolute) {
        if !is_document(&path) {
            models.push(path);
        } else if document.is_none() {
            let DocumentFile { document: mut opened, warnings: renamed } = Document::open(&path)?;
            warnings = renamed;
            opened.models = opened.models.iter().map(absolute).collect();
            models.extend(opened.models.iter().cloned());
            document = Some((path, opened));
        }
    }
    let view = document.as_ref().map_or(view, |(_, d)| &d.view);
    let mut scene = loader(&models, &import_options(view), progress)?;
    scene.warnings.extend(warnings);
    let model = Model::new(scene);
    let on_device = uploader.scene(&model.files, &[])?;
    Ok(Loaded { model, on_device, models, document, intent })
}
