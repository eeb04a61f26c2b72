//! The picture in the window: when it is drawn again, and how long that takes.

mod pointer;
mod shown_texture;
pub mod wave_easing;

use std::time::{Duration, Instant};

use eframe::egui::{self, Rect, Ui};
use eframe::egui_wgpu;

pub use self::pointer::{Moved, PickFor};
use self::shown_texture::ShownTexture;
use self::wave_easing::WaveEasing;
use super::gesture::Gestures;
use super::jobs::Job;
use super::refining::Refining;
use super::screenshot::Shot;
use crate::document::Document;
use crate::gpu::Gpu;
use crate::hatching::tonal_art_map::generator::Recipe;
use crate::render::LayerReport;
use crate::render::{
    ExaminedMesh, GpuScene, GpuStripes, Intersections, LayerMethod, RenderError, Renderer, Reported, Request,
    SolvedStripes, StripeRequest, StrokeMap, StyleImages, UploadedTopology, Uploader,
};
use crate::scene::NodeId;
use crate::style::Style;

/// All that a picture depends on, its outlines apart.
#[derive(PartialEq)]
struct PictureInputs {
    document: Document,
    size: [u32; 2],
    samples_at_rest: u32,
    generation: u64,
}

/// The picture and everything that draws it.
pub struct Viewport {
    renderer: Renderer,
    state: egui_wgpu::RenderState,
    image: ShownTexture,
    outline: ShownTexture,
    has_outline: bool,
    drawn: Option<PictureInputs>,
    selected: Vec<NodeId>,
    refining: Refining,
    wave_easing: WaveEasing,
    measures: bool,
    generation: u64,
    pick: Option<PickFor>,
    gestures: Gestures,
    rect: Rect,
    size: [u32; 2],
    is_laid_out: bool,
    measuring: Option<Job<f64>>,
    awaiting: Option<Job<()>>,
    is_paused: bool,
    is_placing: bool,
    is_covered: bool,
    milliseconds: f64,
    pictures: u64,
}

impl Viewport {
    /// Takes over the device of the window.
    pub fn new(state: egui_wgpu::RenderState) -> Self {
        let gpu = Gpu::new(&state.adapter, state.device.clone(), state.queue.clone());
        Self {
            renderer: Renderer::new(gpu),
            state,
            image: ShownTexture::default(),
            outline: ShownTexture::default(),
            has_outline: false,
            drawn: None,
            selected: Vec::new(),
            refining: Refining::default(),
            wave_easing: WaveEasing::default(),
            measures: false,
            generation: 0,
            pick: None,
            gestures: Gestures::default(),
            rect: Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(16.0, 10.0)),
            size: [16, 10],
            is_laid_out: false,
            measuring: None,
            awaiting: None,
            is_paused: false,
            is_placing: false,
            is_covered: false,
            milliseconds: 0.0,
            pictures: 0,
        }
    }

    /// What draws.
    pub fn renderer(&mut self) -> &mut Renderer {
        &mut self.renderer
    }

    /// Name of the graphics driver.
    pub fn adapter_name(&self) -> String {
        self.renderer.gpu().adapter_name.clone()
    }

    /// Whether its place in the window, and with it [`Self::aspect`], is known.
    pub fn is_laid_out(&self) -> bool {
        self.is_laid_out
    }

    /// Width by height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1].max(1))
    }

    /// Whether to measure how long pictures take.
    pub fn set_measures(&mut self, measures: bool) {
        if measures && !self.measures {
            self.draw_again();
        }
        self.measures = measures;
    }

    /// Whether the picture at rest leaves the device to other work for now.
    pub fn pause(&mut self, is_paused: bool) {
        self.is_paused = is_paused;
    }

    /// Whether it is still to be found out what was clicked.
    pub fn is_picking(&self) -> bool {
        self.pick.is_some()
    }

    /// Whether clicks place points.
    pub fn set_placing(&mut self, is_placing: bool) {
        self.is_placing = is_placing;
    }

    /// Whether a question lies over the picture, so that the mouse does nothing to it.
    pub fn set_covered(&mut self, is_covered: bool) {
        self.is_covered = is_covered;
    }

    /// How many pictures have been drawn so far.
    pub fn pictures(&self) -> u64 {
        self.pictures
    }

    /// Milliseconds from the request of a picture, or of one sample more, until the device was done with it, as last
    /// measured.
    pub fn milliseconds(&mut self) -> f64 {
        self.take_measurement();
        self.milliseconds
    }

    fn take_measurement(&mut self) {
        if let Some(Ok(milliseconds)) = self.measuring.as_ref().and_then(Job::poll) {
            self.milliseconds = milliseconds;
            self.measuring = None;
        }
    }

    /// Measures the picture that was just asked for, unless another one is still being measured.
    fn measure(&mut self, context: &egui::Context, began: Instant) {
        if self.measuring.is_some() {
            return;
        }
        let submitted = self.renderer.gpu().submitted();
        self.measuring = Some(Job::start("measuring", context, move |progress| {
            submitted.wait(|| progress.is_canceled());
            began.elapsed().as_secs_f64() * 1000.0
        }));
    }

    /// Draws again what was incomplete, and wakes the window when the device has reported about the last picture.
    fn heed_reports(&mut self, context: &egui::Context) {
        let reported = self.renderer.take_reports();
        if reported == Reported::Incomplete {
            self.draw_again();
            context.request_repaint();
        }
        self.awaiting.take_if(|job| job.poll().is_some());
        if reported == Reported::Waiting && self.awaiting.is_none() {
            let submitted = self.renderer.gpu().submitted();
            self.awaiting = Some(Job::start("awaiting reports", context, move |progress| {
                submitted.wait(|| progress.is_canceled());
            }));
        }
    }

    /// Uploads scenes for the picture, from any thread.
    pub fn uploader(&self) -> Uploader {
        self.renderer.uploader()
    }

    /// Shows another scene.
    pub fn show(&mut self, scene: GpuScene) {
        self.pick = None;
        self.wave_easing.forget();
        self.renderer.show(scene);
        self.draw_again();
    }

    /// How far the blueprint of that style came in the last picture whose report has arrived.
    pub fn last_layer_report(&self, style: &Style) -> Option<&(LayerReport, LayerMethod)> {
        self.renderer.last_layer_report_of(style)
    }

    /// The images that styles name, as far as the renderer has them.
    pub fn images(&self) -> &StyleImages {
        self.renderer.images()
    }

    /// Takes over the images that styles name.
    pub fn show_images(&mut self, images: StyleImages) {
        self.renderer.set_images(images);
        self.draw_again();
    }

    /// Takes over what topology found out about the scene's meshes.
    pub fn show_topology(&mut self, topology: UploadedTopology) {
        self.renderer.show_topology(topology);
        self.draw_again();
    }

    /// The stripes of hatching that a document asks for and that nobody has given yet.
    pub fn missing_stripes(&self, document: &Document) -> Vec<StripeRequest> {
        self.renderer.missing_stripes(document)
    }

    /// Whether a document asks for intersections that nobody has found yet.
    pub fn lacks_intersections(&self, document: &Document) -> bool {
        self.renderer.lacks_intersections(document)
    }

    /// What topology found of each mesh of the scene; empty until that is known.
    pub fn examined_meshes(&self) -> Vec<ExaminedMesh> {
        self.renderer.examined_meshes()
    }

    /// Takes over the intersections of the scene.
    pub fn show_intersections(&mut self, intersections: Intersections) {
        self.renderer.show_intersections(intersections);
        self.draw_again();
    }

    /// The strokes that a document describes and that nobody has drawn yet.
    pub fn missing_strokes(&self, document: &Document) -> Vec<Recipe> {
        self.renderer.missing_strokes(document)
    }

    /// Takes over strokes that a document describes.
    pub fn show_strokes(&mut self, map: StrokeMap) {
        self.renderer.show_strokes(map);
        self.draw_again();
    }

    /// Number of bodies that the section cuts and that have no cap.
    pub fn open_bodies(&self) -> usize {
        self.renderer.open_bodies()
    }

    /// All stripes of hatching that have been found for the scene.
    pub fn solved_stripes(&self) -> Vec<SolvedStripes> {
        self.renderer.solved_stripes().to_vec()
    }

    /// Takes over stripes of hatching.
    pub fn show_stripes(&mut self, stripes: GpuStripes) {
        self.renderer.show_stripes(stripes);
        self.draw_again();
    }

    /// Draws in the next frame even if nothing changed that is known here.
    pub fn draw_again(&mut self) {
        self.generation += 1;
    }

    /// Draws the picture if anything changed that it depends on, and shows it. When nothing has moved for a moment, it
    /// gets one sample more, and so on up to `samples_at_rest`.
    ///
    /// # Errors
    /// When it cannot be drawn; once per cause.
    pub fn draw(
        &mut self,
        ui: &Ui,
        document: &Document,
        selected: Vec<NodeId>,
        samples_at_rest: u32,
    ) -> Result<(), RenderError> {
        self.heed_reports(ui.ctx());
        let seconds = ui.input(|input| input.time);
        let (document, lasts) = document.at(seconds);
        if let Some(lasts) = lasts {
            ui.ctx().request_repaint_after(lasts);
        }
        let wave_scale = self.wave_scale(&document, seconds);
        if wave_scale != 1.0 {
            ui.ctx().request_repaint();
        }
        let document = document.with_wave_scale(wave_scale);
        let document = document.as_ref();
        let inputs = PictureInputs {
            document: document.clone(),
            size: self.size,
            samples_at_rest,
            generation: self.generation,
        };
        let is_changed = self.drawn.as_ref() != Some(&inputs);
        if is_changed {
            self.refining.begin(samples_at_rest);
            self.drawn = Some(inputs);
        }
        self.take_measurement();
        let cost = Duration::from_secs_f64(self.milliseconds.max(0.0) * 1e-3);
        let is_refined = self.refining.is_due(ui.ctx(), cost, self.is_paused || self.measuring.is_some());
        let mut result = Ok(());
        if is_changed || is_refined || self.selected != selected {
            self.selected = selected;
            result = self.render(ui.ctx(), document);
            self.heed_reports(ui.ctx());
        }
        let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
        let outline = self.outline.id().filter(|_| self.has_outline);
        for id in self.image.id().into_iter().chain(outline) {
            ui.painter().image(id, self.rect, whole, egui::Color32::WHITE);
        }
        result
    }

    fn wave_scale(&mut self, document: &Document, seconds: f64) -> f32 {
        match &document.camera {
            Some(camera) if document.has_waves_on_surfaces() => self.wave_easing.scale(camera, seconds),
            _ => {
                self.wave_easing.forget();
                1.0
            }
        }
    }

    fn render(&mut self, context: &egui::Context, document: &Document) -> Result<(), RenderError> {
        let camera = document.camera.unwrap_or_default();
        let began = Instant::now();
        let drawn = self.renderer.render(&Request {
            document,
            camera: &camera,
            size: self.size,
            transparent: false,
            selected: &self.selected,
            samples: self.refining.samples(),
        });
        // What the device could not make is not shown; the last picture stays.
        let drawn = drawn.and_then(|picture| Ok(self.renderer.gpu().check().map(|()| picture)?));
        self.refining.note(drawn.as_ref().ok().map(|picture| picture.sample));
        let picture = drawn?;
        self.pictures += 1;
        if self.measures || !self.refining.is_complete() {
            self.measure(context, began);
        }
        self.image.show(&self.state, &picture.image);
        self.has_outline = picture.selection.is_some();
        if let Some(outline) = &picture.selection {
            self.outline.show(&self.state, outline);
        }
        Ok(())
    }

    /// How far the picture at rest is.
    pub fn refining(&self) -> &Refining {
        &self.refining
    }

    /// The picture as it is in the window, without outline, or without paper, to be taken in the background.
    pub fn shot(&self, document: &Document, transparent: bool, samples: u32) -> Shot {
        let (renderer, size) = (self.renderer.fork(), self.size);
        Shot { renderer, document: document.clone(), size, transparent, samples }
    }

    /// The place of the picture in the window.
    pub fn rect(&self) -> Rect {
        self.rect
    }
}
