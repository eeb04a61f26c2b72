//! What happens when work in the background is asked for, and when it is done.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use eframe::egui;

use super::{DialogFor, Viewer};
use crate::app::dialogs::{Choice, Dialog};
use crate::app::jobs::Job;
use crate::app::loading::{self, Intent, LoadError, Loaded};
use crate::app::navigation;
use crate::app::screenshot::{self, Destination};
use crate::app::unsaved::{Replacement, Saved};
use crate::app::viewport::PickFor;
use crate::document::{DOCUMENT_ENDING, Document};
use crate::export::session::{self, is_document};
use crate::hatching::cache::Cache;
use crate::import::{Format, IMAGE_ENDINGS, ImportError, Progress};
use crate::render::{Intersections, Pick, SolvedStripes, StrokeMap};
use crate::scene::Standard;

/// How often the progress of a load is shown anew.
const PROGRESS: Duration = Duration::from_millis(100);

/// The same for screenshots: on a software device, each time costs as much as a sample.
const SAVING: Duration = Duration::from_millis(300);

impl Viewer {
    /// Loads files; asks first if they take the place of a drawing that would be lost.
    pub fn load(&mut self, context: &egui::Context, files: Vec<PathBuf>, intent: Intent) {
        // A drawing replaces, whatever the key.
        let is_replaced =
            intent == Intent::Open || intent == Intent::Add && files.iter().any(|f| is_document(f));
        if is_replaced {
            self.leave_for(context, Replacement::Open(files));
        } else {
            self.start_loading(context, files, intent);
        }
    }

    /// Starts to load files; a load that is still running is canceled. The present scene stays until then.
    pub(super) fn start_loading(&mut self, context: &egui::Context, files: Vec<PathBuf>, intent: Intent) {
        let mut paths = if intent == Intent::Add { self.document.models.clone() } else { Vec::new() };
        paths.extend(files);
        if intent != Intent::Open {
            self.given_up = None;
        }
        let loader = self.loader.clone();
        let (uploader, view) = (self.viewport.uploader(), self.document.view.clone());
        let work =
            move |progress: &Progress| loading::load(&paths, intent, &view, &loader, &uploader, progress);
        self.jobs.load = Some(Job::start("loading", context, work));
    }

    pub(super) fn answer_jobs(&mut self, context: &egui::Context) {
        self.answer_load(context);
        self.answer_dialog(context);
        self.read_again_for_seams(context);
        self.answer_topology(context);
        self.answer_intersections(context);
        self.answer_stripes(context);
        self.answer_strokes(context);
        self.answer_images(context);
        self.answer_pictures(context);
        if let Some(result) = Job::take(&mut self.jobs.save) {
            match result {
                Ok(Ok((path, document))) => {
                    self.notices.saved(path.clone());
                    self.state.note_opened(&path);
                    self.look_for_recent();
                    self.saved = Saved::in_file(path, document);
                    self.go_on_after_saving(context);
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
        // Two questions at a time would be one too many.
        let Some(job) = self.jobs.load.as_ref().filter(|_| !self.is_asking()) else { return };
        if !self.viewport.is_laid_out() {
            // A model is framed for the picture as it is, and nobody has seen that yet.
            context.request_repaint();
            return;
        }
        let Some(result) = job.poll() else {
            context.request_repaint_after(PROGRESS);
            return;
        };
        self.jobs.load = None;
        match result {
            // The drawing may have been changed since it was left for this one.
            Ok(Ok(loaded)) if loaded.intent == Intent::Open => {
                self.leave_for(context, Replacement::Show(Box::new(loaded)));
            }
            Ok(Ok(loaded)) => self.show_loaded(loaded),
            Ok(Err(LoadError::Import(ImportError::Canceled))) => self.stay(),
            Ok(Err(error)) => self.load_failed(&error.to_string()),
            Err(error) => self.load_failed(&error.to_string()),
        }
    }

    fn save_failed(&mut self, message: &str) {
        self.notices.error(message);
        self.stay();
    }

    fn load_failed(&mut self, message: &str) {
        self.notices.error(message);
        // After an undo the list of models may say something else than the picture.
        self.document.models.clone_from(&self.loaded);
        self.stay();
    }

    pub(super) fn show_loaded(&mut self, loaded: Loaded) {
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
        self.jobs.stripes = None;
        self.stripes_refused.clear();
        self.jobs.intersections = None;
        self.intersections_refused = false;
        self.outliner.restart(&self.model.scene);
        self.selection = if intent == Intent::Open { Default::default() } else { selection };
        match intent {
            Intent::Open => self.begin_document(document, &models),
            Intent::Add => {
                self.document.models.clone_from(&models);
                if self.document.camera.is_none() {
                    self.look_from(Standard::Home);
                }
                // Added to nothing, they are as if opened.
                if self.loaded.is_empty() && self.saved.file.is_none() {
                    self.saved = Saved::models(&self.document);
                }
            }
            Intent::Reload | Intent::Restore => {}
        }
        self.loaded = models;
        if intent == Intent::Open {
            self.mended_for = self.document.view.seam_tolerance();
        }
        if intent != Intent::Restore {
            for path in self.loaded.iter().rev().chain(&self.saved.file) {
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
        let without_coordinates = self.document.coordinate_faults(&self.model.files);
        let glyphs = self.document.glyph_faults(&self.model.files);
        for fault in faults.into_iter().chain(glyphs).chain(without_coordinates) {
            self.notices.warning(fault.to_string());
        }
        let warnings = self.model.scene.warnings.len();
        if warnings > 0 && intent != Intent::Restore {
            let plural = if warnings == 1 { "" } else { "s" };
            self.notices
                .warning(format!("Loaded with {warnings} warning{plural}; the line below lists them"));
        }
    }

    /// Reads the models again when their seams are to be mended otherwise.
    fn read_again_for_seams(&mut self, context: &egui::Context) {
        let wanted = self.document.view.seam_tolerance();
        let is_idle = self.jobs.load.is_none() && context.input(|i| !i.pointer.any_down());
        if wanted != self.mended_for && is_idle && !self.is_asking() {
            self.mended_for = wanted;
            if !self.loaded.is_empty() {
                self.start_loading(context, self.loaded.clone(), Intent::Reload);
            }
        }
    }

    /// Examines the meshes of a new scene in the background, and again when something else decides about creases.
    fn answer_topology(&mut self, context: &egui::Context) {
        if let Some(result) = Job::take(&mut self.jobs.topology) {
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
        let creases = self.document.view.creases();
        let is_wanted = !self.model.files.meshes.is_empty();
        if is_wanted && self.topology_for != Some(creases) && context.input(|i| !i.pointer.any_down()) {
            self.topology_for = Some(creases);
            let scene = Arc::clone(&self.model.files);
            let uploader = self.viewport.uploader();
            let work = move |_: &Progress| uploader.topology(&scene, &session::topology(&scene, creases));
            self.jobs.topology = Some(Job::start("examining the meshes", context, work));
        }
    }

    /// Finds where objects run through each other, if styles ask for that, once the meshes have been examined.
    fn answer_intersections(&mut self, context: &egui::Context) {
        if let Some(result) = Job::take(&mut self.jobs.intersections) {
            match result {
                Ok(Some(found)) => self.viewport.show_intersections(found),
                Ok(None) => {}
                Err(error) => {
                    self.intersections_refused = true;
                    self.notices.error(error.to_string());
                }
            }
        }
        if self.jobs.intersections.is_some() {
            context.request_repaint_after(PROGRESS);
            return;
        }
        let is_idle = self.has_topology() && !context.input(|i| i.pointer.any_down());
        if is_idle && !self.intersections_refused && self.viewport.lacks_intersections(&self.document) {
            let (scene, examined) = (Arc::clone(&self.model.files), self.viewport.examined_meshes());
            let work = move |progress: &Progress| {
                Intersections::find(&scene, &examined, &|share| progress.goes_on(share))
            };
            self.jobs.intersections = Some(Job::start("intersecting the meshes", context, work));
        }
    }

    /// Finds the strokes of hatching that styles ask for, once the meshes have been examined.
    fn answer_stripes(&mut self, context: &egui::Context) {
        if let Some(result) = Job::take(&mut self.jobs.stripes) {
            match result {
                // Triangles may lie in another order meanwhile.
                Ok(Some(Ok(stripes))) if self.has_topology() => self.viewport.show_stripes(stripes),
                Ok(Some(Ok(_)) | None) => {}
                Ok(Some(Err(error))) => self.notices.error(error.to_string()),
                Err(error) => self.notices.error(error.to_string()),
            }
        }
        if self.jobs.stripes.is_some() {
            context.request_repaint_after(PROGRESS);
            return;
        }
        if !self.has_topology() || context.input(|i| i.pointer.any_down()) {
            return;
        }
        let missing = self.viewport.missing_stripes(&self.document);
        if missing.iter().all(|request| self.stripes_refused.contains(request)) {
            return;
        }
        let (scene, creases) = (Arc::clone(&self.model.files), self.document.view.creases());
        let (uploader, known) = (self.viewport.uploader(), self.viewport.solved_stripes());
        let work = move |progress: &Progress| {
            let found =
                SolvedStripes::solve(&Cache::of_user(), &scene, &missing, &|share| progress.goes_on(share))?;
            let all = known.into_iter().chain(found).collect();
            Some(uploader.stripes(&scene, &session::topology(&scene, creases), all))
        };
        self.jobs.stripes = Some(Job::start("hatching", context, work));
    }

    /// Draws the strokes that styles describe.
    fn answer_strokes(&mut self, context: &egui::Context) {
        if let Some(result) = Job::take(&mut self.jobs.strokes) {
            match result {
                Ok(Some(map)) => {
                    if let Err(error) = &map.map {
                        self.notices.error(error.to_string());
                    }
                    self.viewport.show_strokes(map);
                }
                Ok(None) => {}
                Err(error) => self.notices.error(error.to_string()),
            }
        }
        if self.jobs.strokes.is_some() {
            context.request_repaint_after(PROGRESS);
            return;
        }
        if context.input(|i| i.pointer.any_down()) {
            return;
        }
        let mut missing = self.viewport.missing_strokes(&self.document).into_iter();
        let Some(recipe) = missing.find(|recipe| !self.strokes_refused.contains(recipe)) else { return };
        let work = move |progress: &Progress| {
            StrokeMap::draw(&Cache::of_user(), &recipe, &|share| progress.goes_on(share))
        };
        self.jobs.strokes = Some(Job::start("drawing strokes", context, work));
    }

    fn begin_document(&mut self, document: Option<(PathBuf, Document)>, models: &[PathBuf]) {
        let scene = &self.model.scene;
        let is_saved = document.is_some();
        if let Some((path, document)) = document {
            self.saved = Saved::in_file(path, document.clone());
            self.document = document;
        } else {
            let memory = models.first().and_then(|m| self.state.memory(m));
            // What was set by hand for everything goes on with the next model.
            self.document = Document {
                up: memory.and_then(|m| m.up),
                meters_per_unit: memory.and_then(|m| m.meters_per_unit),
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
        if !is_saved {
            self.saved = Saved::models(&self.document);
        }
        self.given_up = None;
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
                    *camera = navigation::moved(camera, point - camera.focal_point);
                }
            }
            _ => {}
        }
    }

    /// Opens a file dialog in the background.
    pub(super) fn ask_for_file(&mut self, context: &egui::Context, purpose: DialogFor) {
        if self.jobs.dialog.is_some() {
            self.notices.warning("A dialog is open already; answer that one first");
            self.stay();
            return;
        }
        let dialog = self.dialog(&purpose);
        let ending = match &dialog.choice {
            Choice::Name(_) => dialog.filters.first().and_then(|(_, endings)| endings.first().copied()),
            Choice::File | Choice::Files => None,
        };
        let answer = (self.dialogs)(dialog);
        let job = Job::start("file dialog", context, move |_| {
            let files = pollster::block_on(answer);
            files.into_iter().map(|f| ending.map_or(f.clone(), |ending| with_ending(&f, ending))).collect()
        });
        self.jobs.dialog = Some((purpose, job));
    }

    fn dialog(&self, purpose: &DialogFor) -> Dialog {
        let models: Vec<_> = Format::all_endings().collect();
        let each: Vec<_> =
            Format::ALL.iter().map(|format| (format.name(), format.endings().to_vec())).collect();
        let any = [("All files", vec!["*"])];
        let (title, choice, filters) = match purpose {
            DialogFor::Open => {
                let supported = [models, vec![DOCUMENT_ENDING]].concat();
                let first = vec![("All supported", supported), ("Hachure drawing", vec![DOCUMENT_ENDING])];
                ("Open", Choice::Files, [first, each, any.into()].concat())
            }
            DialogFor::Add => {
                let first = vec![("All supported", models)];
                ("Add", Choice::Files, [first, each, any.into()].concat())
            }
            DialogFor::Image(_) => {
                let images = vec![("Images", IMAGE_ENDINGS.to_vec())];
                ("Choose an image", Choice::File, [images, any.into()].concat())
            }
            DialogFor::Save => (
                "Save drawing",
                self.proposed(DOCUMENT_ENDING),
                vec![("Hachure drawing", vec![DOCUMENT_ENDING])],
            ),
            DialogFor::Screenshot => ("Save screenshot", self.proposed("png"), vec![("PNG", vec!["png"])]),
        };
        Dialog { title, filters, folder: self.state.last_folder.clone(), choice }
    }

    fn proposed(&self, ending: &str) -> Choice {
        Choice::Name(format!("{}.{ending}", self.name()))
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
                self.stay();
                return;
            }
        };
        let Some(first) = paths.first().cloned() else {
            self.stay();
            return;
        };
        self.state.last_folder = first.parent().map(Path::to_owned);
        match purpose {
            DialogFor::Open => self.load(context, paths, Intent::Open),
            DialogFor::Add => self.load(context, paths, Intent::Add),
            DialogFor::Save => self.save_document(context, first),
            DialogFor::Screenshot => self.capture(context, false, Destination::File(first)),
            DialogFor::Image(choosing) => self.take_image(&choosing, &first),
        }
    }

    /// Writes the document in the background.
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
        if let Some(result) = Job::take(&mut self.jobs.picture) {
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
        let path = self.saved.file.as_ref().or(self.document.models.first());
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
