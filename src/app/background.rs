//! What happens when work beside the window is asked for, and when it is done.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use eframe::egui;

use super::jobs::Job;
use super::leaving::Leaving;
use super::loading::{self, DOCUMENT_ENDING, IMAGE_ENDINGS, Intent, LoadError, Loaded, MODEL_ENDINGS};
use super::screenshot::{self, Destination};
use super::viewer::{DialogFor, Viewer};
use super::viewport::PickFor;
use crate::document::Document;
use crate::export::session::{self, is_document};
use crate::import::{ImportError, Progress};
use crate::render::Pick;
use crate::scene::Standard;

/// How often the progress of a load is shown anew.
const PROGRESS: Duration = Duration::from_millis(100);

/// The same for screenshots: on a software device, each time costs as much as a sample.
const SAVING: Duration = Duration::from_millis(300);

impl Viewer {
    /// Starts to load files; a load that is still running is cancelled. The present scene stays until then.
    pub fn load(&mut self, context: &egui::Context, files: Vec<PathBuf>, intent: Intent) {
        let (mut paths, intent) = match intent {
            // A drawing replaces, whatever the key.
            Intent::Add if files.iter().any(|f| is_document(f)) => (Vec::new(), Intent::Open),
            Intent::Add => (self.document.models.clone(), Intent::Add),
            Intent::Open | Intent::Reload | Intent::Restore => (Vec::new(), intent),
        };
        paths.extend(files);
        let loader = self.loader.clone();
        let (uploader, angle) = (self.viewport.uploader(), self.document.view.crease_angle);
        let work =
            move |progress: &Progress| loading::load(&paths, intent, angle, &loader, &uploader, progress);
        self.jobs.load = Some(Job::start("loading", context, work));
    }

    pub(super) fn answer_jobs(&mut self, context: &egui::Context) {
        self.answer_load(context);
        self.answer_dialog(context);
        self.answer_topology(context);
        self.answer_images(context);
        self.answer_pictures(context);
        if let Some(result) = self.jobs.save.as_ref().and_then(Job::poll) {
            self.jobs.save = None;
            match result {
                Ok(Ok((path, document))) => {
                    self.notices.saved(path.clone());
                    self.state.note_opened(&path);
                    self.look_for_recent();
                    self.saved = Some((path, document));
                    if self.leaving == Leaving::AfterSaving {
                        self.leaving = Leaving::Now;
                        context.send_viewport_cmd(egui::ViewportCommand::Close);
                    }
                }
                Ok(Err(error)) => self.save_failed(&error.to_string()),
                Err(error) => self.save_failed(&error.to_string()),
            }
        }
        if let Some((purpose, pick)) = self.viewport.poll_pick(context) {
            self.answer_pick(purpose, &pick);
        }
    }

    fn answer_load(&mut self, context: &egui::Context) {
        let Some(job) = &self.jobs.load else { return };
        let Some(result) = job.poll() else {
            context.request_repaint_after(PROGRESS);
            return;
        };
        self.jobs.load = None;
        match result {
            Ok(Ok(loaded)) => self.show_loaded(loaded),
            Ok(Err(LoadError::Import(ImportError::Cancelled))) => {}
            Ok(Err(error)) => self.load_failed(&error.to_string()),
            Err(error) => self.load_failed(&error.to_string()),
        }
    }

    fn save_failed(&mut self, message: &str) {
        self.notices.error(message);
        self.leaving = Leaving::No;
    }

    fn load_failed(&mut self, message: &str) {
        self.notices.error(message);
        // After an undo the list of models may say something else than the picture.
        self.document.models.clone_from(&self.loaded);
    }

    fn show_loaded(&mut self, loaded: Loaded) {
        let Loaded { model, on_device, models, document, intent } = loaded;
        self.viewport.show(on_device);
        self.cancel_placing();
        let mut model = model;
        if intent != Intent::Open {
            model.show_glyphs(&self.document);
        }
        let selection = self.selection.carried_over(&self.model.scene, &model.scene);
        self.model = model;
        self.jobs.topology = None;
        self.topology_for = None;
        self.outliner.restart(&self.model.scene);
        self.selection = if intent == Intent::Open { Default::default() } else { selection };
        match intent {
            Intent::Open => self.begin_document(document, &models),
            Intent::Add => {
                self.document.models.clone_from(&models);
                if self.document.camera.is_none() {
                    self.look_from(Standard::Home);
                }
            }
            Intent::Reload | Intent::Restore => {}
        }
        self.loaded = models;
        if intent != Intent::Restore {
            for path in self.loaded.iter().rev().chain(self.saved.as_ref().map(|(path, _)| path)) {
                self.state.note_opened(path);
            }
            self.look_for_recent();
        }
        match intent {
            Intent::Open => self.history.restart(&self.document),
            Intent::Reload => self.notices.done("Read again"),
            Intent::Add | Intent::Restore => {}
        }
        self.model.show_glyphs(&self.document);
        let faults = self.document.role_faults(&self.model.scene);
        for fault in faults.into_iter().chain(self.document.glyph_faults(&self.model.files)) {
            self.notices.warning(fault.to_string());
        }
        let warnings = self.model.scene.warnings.len();
        if warnings > 0 && intent != Intent::Restore {
            let plural = if warnings == 1 { "" } else { "s" };
            self.notices
                .warning(format!("Loaded with {warnings} warning{plural}; the line below lists them"));
        }
    }

    /// Examines the meshes of a new scene beside the window, and again when the crease angle has changed.
    fn answer_topology(&mut self, context: &egui::Context) {
        if let Some(result) = self.jobs.topology.as_ref().and_then(Job::poll) {
            self.jobs.topology = None;
            let shown = match result {
                Ok(Ok(topology)) => {
                    self.viewport.show_topology(topology);
                    Ok(())
                }
                Ok(Err(error)) => Err(error.to_string()),
                Err(error) => Err(error.to_string()),
            };
            if let Err(message) = shown {
                self.notices.error(message);
            }
        }
        let angle = self.document.view.crease_angle;
        let is_wanted = !self.model.files.meshes.is_empty();
        if is_wanted && self.topology_for != Some(angle) && context.input(|i| !i.pointer.any_down()) {
            self.topology_for = Some(angle);
            let scene = Arc::clone(&self.model.files);
            let uploader = self.viewport.uploader();
            let work = move |_: &Progress| uploader.topology(&scene, &session::topology(&scene, angle));
            self.jobs.topology = Some(Job::start("examining the meshes", context, work));
        }
    }

    fn begin_document(&mut self, document: Option<(PathBuf, Document)>, models: &[PathBuf]) {
        let scene = &self.model.scene;
        if let Some((path, document)) = document {
            self.saved = Some((path, document.clone()));
            self.document = document;
        } else {
            self.saved = None;
            let memory = models.first().and_then(|m| self.state.memory(m));
            // What was set by hand for everything goes on with the next model.
            self.document = Document {
                up: memory.and_then(|m| m.up),
                metres_per_unit: memory.and_then(|m| m.metres_per_unit),
                lighting: self.document.lighting.clone(),
                style: self.document.style.clone(),
                view: self.document.view.clone(),
                ..Document::default()
            };
            self.document.use_lights_of(scene);
        }
        self.document.models = models.to_vec();
        if let Some(style) = self.start_style.take() {
            self.document.style = style;
        }
        if self.document.camera.is_none() {
            self.look_from(Standard::Home);
        }
    }

    fn answer_pick(&mut self, purpose: PickFor, pick: &Pick) {
        match (purpose, pick.node, pick.point) {
            (PickFor::Select { add }, Some(node), _) if node < self.model.scene.nodes.len() => {
                if add {
                    self.selection.toggle(node);
                } else {
                    self.selection.set(node);
                }
                self.outliner.reveal(node, &self.model.scene);
            }
            (PickFor::Place { is_last }, ..) => self.place_point(pick, is_last),
            (PickFor::Select { add: false }, ..) => self.selection.clear(),
            (PickFor::Center, _, Some(point)) => {
                if let Some(camera) = &mut self.document.camera {
                    *camera = super::navigation::moved(camera, point - camera.focal_point);
                }
            }
            _ => {}
        }
    }

    /// Opens a file dialog beside the window.
    pub(super) fn ask_for_file(&mut self, context: &egui::Context, purpose: DialogFor) {
        if self.jobs.dialog.is_some() {
            return;
        }
        let mut dialog = rfd::AsyncFileDialog::new();
        if let Some(folder) = &self.state.last_folder {
            dialog = dialog.set_directory(folder);
        }
        let name = self.name();
        let models_and_documents: Vec<_> = MODEL_ENDINGS.into_iter().chain([DOCUMENT_ENDING]).collect();
        // Futures are made here because some systems open dialogs only from this thread.
        let job = match &purpose {
            DialogFor::Open | DialogFor::Add => {
                if matches!(purpose, DialogFor::Open) {
                    dialog = dialog
                        .set_title("Open")
                        .add_filter("All supported", &models_and_documents)
                        .add_filter("Hachure drawing", &[DOCUMENT_ENDING]);
                } else {
                    dialog = dialog.set_title("Add").add_filter("All supported", &MODEL_ENDINGS);
                }
                let chosen = dialog
                    .add_filter("glTF", &["glb", "gltf"])
                    .add_filter("Wavefront OBJ", &["obj"])
                    .add_filter("STL", &["stl"])
                    .add_filter("PLY", &["ply"])
                    .add_filter("All files", &["*"])
                    .pick_files();
                Job::start("file dialog", context, move |_| {
                    let files = pollster::block_on(chosen).unwrap_or_default();
                    files.iter().map(|f| f.path().to_owned()).collect()
                })
            }
            DialogFor::Image(_) => {
                let chosen = dialog
                    .set_title("Choose an image")
                    .add_filter("Images", &IMAGE_ENDINGS)
                    .add_filter("All files", &["*"])
                    .pick_file();
                Job::start("file dialog", context, move |_| {
                    pollster::block_on(chosen).map(|f| f.path().to_owned()).into_iter().collect()
                })
            }
            DialogFor::Save | DialogFor::Screenshot => {
                let (title, ending) = match purpose {
                    DialogFor::Save => ("Save drawing", DOCUMENT_ENDING),
                    _ => ("Save screenshot", "png"),
                };
                let chosen = dialog
                    .set_title(title)
                    .add_filter(title, &[ending])
                    .set_file_name(format!("{name}.{ending}"))
                    .save_file();
                Job::start("file dialog", context, move |_| {
                    let file = pollster::block_on(chosen);
                    file.map(|f| with_ending(f.path(), ending)).into_iter().collect()
                })
            }
        };
        self.jobs.dialog = Some((purpose, job));
    }

    fn answer_dialog(&mut self, context: &egui::Context) {
        let Some((purpose, job)) = self.jobs.dialog.take() else { return };
        let Some(result) = job.poll() else {
            self.jobs.dialog = Some((purpose, job));
            return;
        };
        let paths = match result {
            Ok(paths) => paths,
            Err(error) => {
                self.notices.error(error.to_string());
                return;
            }
        };
        let Some(first) = paths.first().cloned() else { return };
        self.state.last_folder = first.parent().map(Path::to_owned);
        match purpose {
            DialogFor::Open => self.load(context, paths, Intent::Open),
            DialogFor::Add => self.load(context, paths, Intent::Add),
            DialogFor::Save => self.save_document(context, first),
            DialogFor::Screenshot => self.capture(context, false, Destination::File(first)),
            DialogFor::Image(choosing) => self.take_image(&choosing, &first),
        }
    }

    /// Writes the document beside the window.
    pub(super) fn save_document(&mut self, context: &egui::Context, path: PathBuf) {
        let document = self.document.clone();
        let work = move |_: &_| document.save(&path).map(|()| (path, document));
        self.jobs.save = Some(Job::start("saving", context, work));
    }

    /// Asks for a screenshot of what is shown now.
    pub(super) fn capture(&mut self, context: &egui::Context, transparent: bool, destination: Destination) {
        let shot = self.viewport.shot(&self.document, transparent, self.state.samples.in_screenshots());
        self.jobs.waiting.push_back((shot, destination));
        self.answer_pictures(context);
    }

    fn answer_pictures(&mut self, context: &egui::Context) {
        if let Some(result) = self.jobs.picture.as_ref().and_then(Job::poll) {
            self.jobs.picture = None;
            match result {
                Ok(Ok(path)) => self.notices.saved(path),
                Ok(Err(error)) => self.notices.error(format!("No screenshot: {error}")),
                Err(error) => self.notices.error(error.to_string()),
            }
        }
        if self.jobs.picture.is_none()
            && let Some((shot, destination)) = self.jobs.waiting.pop_front()
        {
            let work = move |progress: &Progress| screenshot::save(&shot.take(progress)?, &destination);
            self.jobs.picture = Some(Job::start("saving a screenshot", context, work));
        }
        if self.jobs.picture.is_some() {
            context.request_repaint_after(SAVING);
        }
    }

    /// The name that files made from this get: that of the document or of the first model.
    pub(super) fn name(&self) -> String {
        let path = self.saved.as_ref().map(|(path, _)| path).or(self.document.models.first());
        let stem = path.and_then(|p| p.file_stem());
        stem.map_or_else(|| "drawing".to_owned(), |s| s.to_string_lossy().into_owned())
    }

    /// Looks which of the recent files are still there.
    pub(super) fn look_for_recent(&mut self) {
        self.recent = self.state.recent().map(|p| (p.to_owned(), p.exists())).collect();
    }
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending)) {
        return path.to_owned();
    }
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}
