//! The window: what it holds and how a frame of it runs.

mod background;
mod execute;
mod images;
mod layout;
mod leaving;
mod placing;

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::command::Command;
use super::dialogs::{self, Dialogs};
use super::images::ImageFiles;
use super::jobs::Job;
use super::loading::{Intent, LoadError, Loaded, Loader, Model};
use super::notices::Notices;
use super::panels::{Choosing, help, outliner::Outliner};
use super::placing::Placing;
use super::screenshot::{Destination, ScreenshotError, Shot};
use super::selection::Selection;
use super::state::AppState;
use super::unsaved::{Leaving, Saved};
use super::viewport::Viewport;
use super::{AppError, theme};
use crate::document::{Creases, Document, DocumentError, History};
use crate::geometry::SeamTolerance;
use crate::gpu::GpuError;
use crate::hatching::tonal_art_map::generator::Recipe;
use crate::import::{self, ImageCache, ImportError};
use crate::render::{GpuStripes, Intersections, StripeRequest, StrokeMap, UploadedTopology};
use crate::style::Style;
use crate::style::preset::{self, Preset};

/// Where eframe keeps [`AppState`].
const STATE_KEY: &str = "hachure";

/// What the window starts with.
#[derive(Clone)]
pub struct Launch {
    /// Models and documents to open.
    pub files: Vec<PathBuf>,
    /// The style of everything that has none of its own.
    pub style: Option<Style>,
    /// What turns models into a scene.
    pub loader: Loader,
    /// What asks for files.
    pub dialogs: Dialogs,
}

impl Default for Launch {
    fn default() -> Self {
        Self {
            files: Vec::new(),
            style: None,
            loader: Arc::new(import::load_all),
            dialogs: Arc::new(dialogs::system),
        }
    }
}

/// Which of the floating windows are open.
#[derive(Debug, Default)]
struct Open {
    help: bool,
    warnings: bool,
}

/// What a file dialog was opened for.
#[derive(Debug, Clone, PartialEq, Eq)]
enum DialogFor {
    Open,
    Add,
    Save,
    Screenshot,
    Image(Choosing),
}

/// Work that runs in the background; see [`super::jobs`]. A new kind of work is a new field, started where it is asked
/// for and answered in `viewer/background.rs`.
#[derive(Default)]
struct Jobs {
    load: Option<Job<Result<Loaded, LoadError>>>,
    dialog: Option<(DialogFor, Job<Vec<PathBuf>>)>,
    topology: Option<Job<Result<UploadedTopology, GpuError>>>,
    /// `None` comes of it when it was canceled.
    stripes: Option<Job<Option<Result<GpuStripes, GpuError>>>>,
    strokes: Option<Job<Option<StrokeMap>>>,
    intersections: Option<Job<Option<Intersections>>>,
    save: Option<Job<Result<(PathBuf, Document), DocumentError>>>,
    images: Option<Job<Result<(ImageCache, crate::render::StyleImages), ImportError>>>,
    picture: Option<Job<Result<PathBuf, ScreenshotError>>>,
    /// Pictures that are taken after that one, so that no two of them get the same number.
    waiting: VecDeque<(Shot, Destination)>,
}

/// The window's application.
pub struct Viewer {
    document: Document,
    history: History,
    model: Model,
    selection: Selection,
    viewport: Viewport,
    jobs: Jobs,
    notices: Notices,
    state: AppState,
    outliner: Outliner,
    presets: Vec<Preset>,
    commands: Vec<Command>,
    open: Open,
    /// What would not be lost.
    saved: Saved,
    /// The models that the scene was made of.
    loaded: Vec<PathBuf>,
    /// The crease angle of the topology that the renderer has or is about to get.
    topology_for: Option<Creases>,
    /// How far apart seams may have been when the models were read.
    mended_for: SeamTolerance,
    /// Stripes of hatching that the person did not want to wait for.
    stripes_refused: Vec<StripeRequest>,
    /// Strokes that styles describe and that the person did not want to wait for.
    strokes_refused: Vec<Recipe>,
    /// Whether the person did not want to wait for intersections.
    intersections_refused: bool,
    /// The images that the styles name.
    images: ImageFiles,
    loader: Loader,
    dialogs: Dialogs,
    start_style: Option<Style>,
    can_reload_shaders: bool,
    is_dark: bool,
    recent: Vec<(PathBuf, bool)>,
    title: String,
    /// The glyph that is being placed.
    placing: Option<Placing>,
    /// Whether the drawing is on its way out.
    leaving: Leaving,
    /// The drawing that the person said need not be saved; after any change to it they are asked again.
    given_up: Option<Document>,
}

impl Viewer {
    /// Makes the application for a new window and starts to load its files.
    ///
    /// # Errors
    /// When the window has no graphics device of the kind that is needed.
    pub fn new(creation: &eframe::CreationContext<'_>, launch: Launch) -> Result<Self, AppError> {
        let render_state = creation.wgpu_render_state.clone().ok_or(AppError::NoDevice)?;
        theme::apply(&creation.egui_ctx);
        let state =
            creation.storage.and_then(|s| eframe::get_value::<AppState>(s, STATE_KEY)).unwrap_or_default();
        theme::choose(&creation.egui_ctx, state.dark);
        let mut viewport = Viewport::new(render_state);
        let can_reload_shaders = viewport.renderer().can_reload_shaders();
        let mut document = Document::default();
        if let Some(style) = &launch.style {
            document.style = style.clone();
        }
        let mut viewer = Self {
            history: History::default(),
            model: Model::default(),
            selection: Selection::default(),
            viewport,
            jobs: Jobs::default(),
            notices: Notices::default(),
            state,
            outliner: Outliner::default(),
            presets: preset::all(),
            commands: Vec::new(),
            open: Open::default(),
            saved: Saved::default(),
            loaded: Vec::new(),
            topology_for: None,
            mended_for: SeamTolerance::default(),
            stripes_refused: Vec::new(),
            strokes_refused: Vec::new(),
            intersections_refused: false,
            images: ImageFiles::default(),
            loader: launch.loader,
            dialogs: launch.dialogs,
            start_style: launch.style,
            can_reload_shaders,
            is_dark: false,
            recent: Vec::new(),
            title: String::new(),
            placing: None,
            leaving: Leaving::default(),
            given_up: None,
            document,
        };
        viewer.history.restart(&viewer.document);
        viewer.look_for_recent();
        if let Some(error) = viewer.viewport.renderer().take_shader_error() {
            viewer.notices.error(error.to_string());
        }
        if !launch.files.is_empty() {
            viewer.load(&creation.egui_ctx, launch.files, Intent::Open);
        }
        Ok(viewer)
    }

    /// The document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The loaded scene and what is known about it.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The selected nodes.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The messages that are shown.
    pub fn notices(&self) -> &Notices {
        &self.notices
    }

    /// What is remembered.
    pub fn state(&self) -> &AppState {
        &self.state
    }

    /// The picture.
    pub fn viewport(&self) -> &Viewport {
        &self.viewport
    }

    /// Whether the meshes have been examined for the present crease angle.
    pub fn has_topology(&self) -> bool {
        self.topology_for == Some(self.document.view.creases()) && self.jobs.topology.is_none()
    }

    /// Whether all strokes of hatching that are asked for have been found.
    pub fn has_stripes(&self) -> bool {
        self.jobs.stripes.is_none()
            && self.jobs.strokes.is_none()
            && self.viewport.missing_stripes(&self.document).is_empty()
            && self.viewport.missing_strokes(&self.document).is_empty()
    }

    /// Whether all intersections that are asked for have been found.
    pub fn has_intersections(&self) -> bool {
        self.jobs.intersections.is_none() && !self.viewport.lacks_intersections(&self.document)
    }

    /// What the person is to do next, while a glyph is being placed.
    pub fn hint(&self) -> Option<&'static str> {
        self.placing.as_ref().map(Placing::hint)
    }

    /// Whether it is still to be found out what was clicked.
    pub fn is_picking(&self) -> bool {
        self.viewport.is_picking()
    }

    /// Whether files are being loaded.
    pub fn is_loading(&self) -> bool {
        self.jobs.load.is_some()
    }

    /// Asks for a command; it is carried out in the next frame.
    pub fn ask(&mut self, command: Command) {
        self.commands.push(command);
    }

    fn run_commands(&mut self, context: &egui::Context) {
        let commands = std::mem::take(&mut self.commands);
        if !commands.is_empty() {
            context.request_repaint();
        }
        for command in commands {
            if self.is_enabled(command) {
                self.execute(context, command);
            }
        }
    }

    fn take_dropped_files(&mut self, context: &egui::Context) {
        let files: Vec<_> =
            context.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
        if !files.is_empty() {
            let adding = context.input(|i| i.modifiers.command);
            self.load(context, files, if adding { Intent::Add } else { Intent::Open });
        }
    }

    /// A change becomes a step to go back to once no button, key or wheel is at work any more.
    fn note_change(&mut self, context: &egui::Context) {
        const QUIET: f32 = 0.3;
        let (busy, since_scroll) = context.input(|i| {
            let busy = i.pointer.any_down() || !i.keys_down.is_empty();
            (busy, i.time_since_last_scroll())
        });
        if since_scroll < QUIET {
            context.request_repaint_after(std::time::Duration::from_secs_f32(QUIET - since_scroll + 0.01));
        } else if !busy && !context.text_edit_focused() && self.placing.is_none() {
            self.history.commit(&self.document);
            self.state.remember(&self.document);
        }
    }

    fn show_title(&mut self, context: &egui::Context) {
        let is_empty = self.saved.file.is_none() && self.document.models.is_empty();
        let mark = if self.is_unsaved() { "*" } else { "" };
        let name = (!is_empty).then(|| format!("{}{mark}", self.file_name()));
        let title = name.map_or_else(|| "Hachure".to_owned(), |name| format!("{name} - Hachure"));
        if title != self.title {
            context.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

impl eframe::App for Viewer {
    fn logic(&mut self, context: &egui::Context, _frame: &mut eframe::Frame) {
        // While a question is on the screen, keys and files are not for what lies behind it.
        if !self.is_asking() {
            self.take_placing_keys(context);
            self.commands.extend(Command::take_pressed(context));
            self.take_dropped_files(context);
        }
        self.answer_jobs(context);
        self.run_commands(context);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.is_dark = ui.visuals().dark_mode;
        self.panels(ui);
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| self.picture(ui));
        let context = ui.ctx().clone();
        if self.open.help {
            help::help_ui(&context, &mut self.open.help);
        }
        if self.open.warnings {
            let warnings = [self.images.warnings.as_slice(), &self.model.scene.warnings].concat();
            help::warnings_ui(&context, &mut self.open.warnings, &warnings);
        }
        self.notices.show(&context, self.viewport.rect());
        self.hold_open(&context);
        self.question_ui(&context);
        self.run_commands(&context);
        self.note_change(&context);
        self.show_title(&context);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, STATE_KEY, &self.state);
    }
}
