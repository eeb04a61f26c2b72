//! From files to a picture: what the command line and the tests do.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use image::RgbaImage;

use crate::document::{Creases, DOCUMENT_ENDING, Document, DocumentError, DocumentFile, ViewSettings};
use crate::geometry::Topology;
use crate::gpu::{Gpu, GpuError, readback};
use crate::hatching::cache::Cache;
use crate::import::{ImportError, ImportOptions, Progress, load_all};
use crate::render::{
    Intersections, Picture, RenderError, Renderer, Reported, Request, SolvedStripes, StrokeMap,
};
use crate::scene::{Camera, Scene};

/// Files that were opened: a document and its scene.
#[derive(Debug, Clone)]
pub struct Opened {
    /// The document; new where only models were given.
    pub document: Document,
    /// What the models hold.
    pub scene: Arc<Scene>,
}

/// Why files could not be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// A document.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// A model.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// A document stands among other files.
    #[error("{}: a .hachure document is opened by itself, without further files", path.display())]
    DocumentAmongFiles {
        /// The document.
        path: PathBuf,
    },
}

/// Whether a path names a document and not a model.
pub fn is_document(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(DOCUMENT_ENDING))
}

/// What a view asks of importers.
pub fn import_options(view: &ViewSettings) -> ImportOptions {
    ImportOptions { crease_angle: view.crease_angle, seams: view.seam_tolerance() }
}

/// Opens models, or one document with its models; `adjust` may change its view before, for some of that matters while models
/// are read.
///
/// # Errors
/// [`OpenError`].
pub fn open(
    files: &[PathBuf],
    adjust: impl FnOnce(&mut ViewSettings),
    progress: &Progress,
) -> Result<Opened, OpenError> {
    let document = match files {
        [file] if is_document(file) => Some(Document::open(file)?),
        _ => None,
    };
    if document.is_none()
        && let Some(path) = files.iter().find(|f| is_document(f))
    {
        return Err(OpenError::DocumentAmongFiles { path: path.clone() });
    }
    let is_new = document.is_none();
    let DocumentFile { mut document, warnings } = document.unwrap_or_else(|| DocumentFile {
        document: Document { models: files.to_vec(), ..Document::default() },
        warnings: Vec::new(),
    });
    let mut view = document.view.clone();
    adjust(&mut view);
    let mut scene = load_all(&document.models, &import_options(&view), progress)?;
    scene.warnings.extend(warnings);
    if is_new {
        document.use_lights_of(&scene);
    }
    Ok(Opened { document, scene: Arc::new(scene) })
}

/// The camera of a new drawing: the whole scene from the front, turned 30° and raised 20°.
pub fn initial_camera(document: &Document, scene: &Scene, aspect: f64) -> Camera {
    let up = document.up(scene);
    let extent = document.scene_with_glyphs(scene).extent();
    Camera::looking_from(up.front(), up.vector(), &extent, aspect)
        .orbited(up.vector(), 30.0, 20.0)
        .framing(&extent, aspect)
}

/// What topology finds out about all meshes. Takes about 0.1 s per million triangles.
pub fn topology(scene: &Scene, creases: Creases) -> Vec<Topology> {
    scene.meshes.iter().map(|mesh| Topology::new(mesh, creases.angle.to_radians(), creases.rule)).collect()
}

/// A renderer that gives its pictures back.
pub struct Session {
    renderer: Renderer,
    samples: u32,
    /// What takes long is kept there.
    cache: Cache,
}

impl Session {
    /// Takes over a device.
    pub fn new(gpu: Gpu) -> Self {
        Self { renderer: Renderer::new(gpu), samples: 1, cache: Cache::nowhere() }
    }

    /// Keeps results that take long there from now on; at first nowhere.
    pub fn set_cache(&mut self, cache: Cache) {
        self.cache = cache;
    }

    /// The renderer.
    pub fn renderer(&mut self) -> &mut Renderer {
        &mut self.renderer
    }

    /// How many samples per pixel pictures have from now on; at first one.
    pub fn set_samples(&mut self, samples: u32) {
        self.samples = samples;
    }

    /// Uploads what was opened, with its topology: exact lines come from it.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn set_scene(&mut self, opened: &Opened) -> Result<(), RenderError> {
        let topology = topology(&opened.scene, opened.document.view.creases());
        self.renderer.set_scene(&opened.scene, &topology)
    }

    /// Finds where the objects of the scene that was set run through each other, if a document asks for that and nobody has
    /// found it yet. Takes about a second per million triangles.
    pub fn find_intersections(&mut self, document: &Document, scene: &Scene) {
        if self.renderer.lacks_intersections(document)
            && let Some(found) = Intersections::find(scene, &self.renderer.examined_meshes(), &|_| true)
        {
            self.renderer.show_intersections(found);
        }
    }

    /// Finds the stripes and draws the strokes of hatching that a document asks for, for the scene that was set, and that are not
    /// there yet. Takes seconds where a model is large.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn find_stripes(&mut self, document: &Document, scene: &Scene) -> Result<(), RenderError> {
        for recipe in self.renderer.missing_strokes(document) {
            let drawn = StrokeMap::draw(&self.cache, &recipe, &|_| true);
            if let Some(map) = drawn {
                map.map.clone()?;
                self.renderer.show_strokes(map);
            }
        }
        let missing = self.renderer.missing_stripes(document);
        if missing.is_empty() {
            return Ok(());
        }
        let found = SolvedStripes::solve(&self.cache, scene, &missing, &|_| true);
        let mut solved = self.renderer.solved_stripes().to_vec();
        solved.extend(found.unwrap_or_default());
        let topology = topology(scene, document.view.creases());
        let stripes = self.renderer.uploader().stripes(scene, &topology, solved)?;
        self.renderer.show_stripes(stripes);
        Ok(())
    }

    /// Draws a document on the scene that was set, with its own camera or the initial one.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn draw(
        &mut self,
        opened: &Opened,
        size: [u32; 2],
        transparent: bool,
    ) -> Result<Picture, RenderError> {
        let aspect = f64::from(size[0].max(1)) / f64::from(size[1].max(1));
        let camera =
            opened.document.camera.unwrap_or_else(|| initial_camera(&opened.document, &opened.scene, aspect));
        let request = Request {
            document: &opened.document,
            camera: &camera,
            size,
            transparent,
            selected: &[],
            samples: self.samples,
        };
        self.find_intersections(&opened.document, &opened.scene);
        self.find_stripes(&opened.document, &opened.scene)?;
        loop {
            let picture = self.renderer.render(&request)?;
            // One sample at a time, so that not all of them lie in the queue at once, and each is known to be complete.
            self.renderer.gpu().wait()?;
            if self.renderer.take_reports() != Reported::Incomplete && picture.sample.is_last() {
                return Ok(picture);
            }
        }
    }

    /// Draws and reads the picture back.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn image(
        &mut self,
        opened: &Opened,
        size: [u32; 2],
        transparent: bool,
    ) -> Result<RgbaImage, RenderError> {
        let picture = self.draw(opened, size, transparent)?;
        let bytes = readback::read(self.renderer.gpu(), &picture.image)?;
        let [width, height] = picture.image.size();
        RgbaImage::from_raw(width, height, bytes)
            .ok_or_else(|| GpuError::Lost("the picture came back incomplete".to_owned()).into())
    }
}
