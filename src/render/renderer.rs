//! The renderer: what the window and the command line call.

use std::sync::Arc;

use glam::{DVec3, UVec2, Vec2};

use super::base::error::RenderError;
use super::base::gpu_scene::{GpuScene, UploadedTopology, Uploader};
use super::base::ids::node_of;
use super::base::intersections::{ExaminedMesh, Intersections, draws_intersections};
use super::base::lights::Lights;
use super::base::scale_bar::ScaleBar;
use super::base::scene_view::SceneView;
use super::base::section::Section;
use super::base::stripes::{GpuStripes, SolvedStripes, StripeRequest};
use super::base::stroke_maps::{StrokeMap, StrokeMaps};
use super::base::style_images::StyleImages;
use super::base::view::{REFERENCE_HEIGHT, View};
use super::drawing::DrawingInputs;
use super::drawing::objects::Objects;
use super::effects::hatching::{missing, missing_strokes};
use super::frame::{FrameInputs, FrameState, Picture};
use super::passes::accumulate::Subject;
use super::passes::coordinates::Coordinates;
use super::passes::layer_report::LayerReport;
use super::passes::layers::{LayerMethod, Reported};
use super::passes::line_blocks::LINE_BLOCK;
use super::views;
use crate::document::{Document, Glyph};
use crate::geometry::Topology;
use crate::gpu::readback::Readback;
use crate::gpu::recorder::Intermediates;
use crate::gpu::{Gpu, GpuError, Pipelines, Recorder, ShaderError, Shaders, Target, TargetPool, Timers};
use crate::hatching::tonal_art_map::generator::Recipe;
use crate::scene::{Addition, Camera, NodeId, Scene};
use crate::style::{Color, Style};

/// What to draw.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// Styles, camera, lights and view.
    pub document: &'a Document,
    /// The camera; the document's own, or one that frames everything.
    pub camera: &'a Camera,
    /// Size of the picture in pixels.
    pub size: [u32; 2],
    /// Leave the paper out: the background becomes transparent.
    pub transparent: bool,
    /// Nodes to outline.
    pub selected: &'a [NodeId],
    /// How many samples per pixel the picture is to have in the end; see [`Renderer::render`].
    pub samples: u32,
}

/// What lies under a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pick {
    /// The object; `None`: background.
    pub node: Option<NodeId>,
    /// The point hit, world space; `None`: background.
    pub point: Option<DVec3>,
}

struct PendingPick {
    /// The pixel in everything that may be in front.
    texels: Vec<Readback>,
    view: View,
    px: Vec2,
}

/// Draws documents.
pub struct Renderer {
    gpu: Gpu,
    pipelines: Pipelines,
    pool: TargetPool,
    timers: Option<Timers>,
    state: FrameState,
    scene: Option<GpuScene>,
    scene_revision: u64,
    /// What stands beside the model, the document's glyphs apart.
    additions: Vec<Addition>,
    /// The document's glyphs and paper as they were drawn last.
    glyphs: (Vec<Glyph>, Color),
    has_new_additions: bool,
    images: StyleImages,
    strokes: StrokeMaps,
    last: Option<(Picture, View)>,
    pick: Option<PendingPick>,
    shader_error: Option<ShaderError>,
    intermediates: Intermediates,
    /// How often a picture turned out to be incomplete.
    incomplete: u64,
    /// Whether one did that nobody has been told of.
    was_incomplete: bool,
    /// Whether all reports about its pictures have come.
    is_settled: bool,
}

impl Renderer {
    /// A renderer without a scene; nothing is compiled before the first frame.
    pub fn new(gpu: Gpu) -> Self {
        let (pipelines, shader_error) = Pipelines::new(&gpu, Shaders::from_environment());
        Self {
            state: FrameState::new(&gpu, pipelines.frame_layout()),
            gpu,
            pipelines,
            pool: TargetPool::default(),
            timers: None,
            scene: None,
            scene_revision: 0,
            additions: Vec::new(),
            glyphs: Default::default(),
            has_new_additions: false,
            images: StyleImages::default(),
            strokes: StrokeMaps::default(),
            last: None,
            pick: None,
            shader_error,
            intermediates: Intermediates::new(),
            incomplete: 0,
            was_incomplete: false,
            is_settled: true,
        }
    }

    /// Another renderer of the same scene: it draws in another thread, and neither disturbs the other's pictures. Asked
    /// for the present picture, it goes on with the samples that there are.
    #[must_use]
    pub fn fork(&self) -> Self {
        let mut fork = Self::new(self.gpu.clone());
        fork.pipelines = self.pipelines.clone();
        fork.scene = self.scene.clone();
        fork.scene_revision = self.scene_revision;
        fork.glyphs = self.glyphs.clone();
        fork.has_new_additions = self.has_new_additions;
        fork.incomplete = self.incomplete;
        fork.additions = self.additions.clone();
        fork.images = self.images.clone();
        fork.strokes = self.strokes.clone();
        // Of a sample that may yet turn out to be incomplete nothing is taken over.
        if self.is_settled {
            fork.state.go_on_from(&self.state);
        }
        fork
    }

    /// The device it draws with.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Uploads scenes for this renderer, from any thread.
    pub fn uploader(&self) -> Uploader {
        Uploader::new(&self.gpu, self.state.material_layout())
    }

    /// Shows a scene, which the renderer's own [`Self::uploader`] uploaded, in place of the last one.
    pub fn show(&mut self, scene: GpuScene) {
        self.scene = Some(scene);
        self.additions.clear();
        self.glyphs = Default::default();
        self.scene_revision += 1;
    }

    /// Takes over what topology found out about the scene that is shown: from then on surfaces have ids, and back faces
    /// of solids are left out.
    pub fn show_topology(&mut self, topology: UploadedTopology) {
        if let Some(scene) = &mut self.scene {
            scene.set_topology(topology);
            self.scene_revision += 1;
        }
    }

    /// The stripes of hatching that a document asks for and that nobody has given yet; until then strokes lie on the paper, and for
    /// good where a device cannot number triangles.
    pub fn missing_stripes(&self, document: &Document) -> Vec<StripeRequest> {
        let document = document.clamped();
        let shown = document.shown();
        let document = shown.as_ref().unwrap_or(&document);
        match &self.scene {
            Some(scene) if Coordinates::Triangles.are_supported(&self.gpu) => missing(document, scene),
            _ => Vec::new(),
        }
    }

    /// Whether a document asks for intersections, and nobody has given those of the scene that is shown, though its topology is
    /// known; until then they are found pixel by pixel.
    pub fn lacks_intersections(&self, document: &Document) -> bool {
        let lacks = |scene: &GpuScene| {
            scene.intersections().is_none()
                && scene.is_examined()
                && draws_intersections(document, scene.model())
        };
        self.scene.as_ref().is_some_and(lacks)
    }

    /// What topology found of each mesh of the scene that is shown; empty until that is known.
    pub fn examined_meshes(&self) -> Vec<ExaminedMesh> {
        self.scene.as_ref().map_or(Vec::new(), GpuScene::examined_meshes)
    }

    /// Takes over the intersections of the scene that is shown.
    pub fn show_intersections(&mut self, intersections: Intersections) {
        if let Some(scene) = &mut self.scene {
            scene.set_intersections(intersections);
            self.scene_revision += 1;
        }
    }

    /// The maps of strokes that a document describes and that nobody has given yet; until then a pen's are drawn.
    pub fn missing_strokes(&self, document: &Document) -> Vec<Recipe> {
        missing_strokes(&document.clamped(), &self.strokes, &self.images)
    }

    /// Takes over a map of strokes.
    pub fn show_strokes(&mut self, map: StrokeMap) {
        self.strokes.add(map);
        self.scene_revision += 1;
    }

    /// All stripes that have been given for the scene that is shown.
    pub fn solved_stripes(&self) -> &[SolvedStripes] {
        self.scene.as_ref().map_or(&[], GpuScene::solved_stripes)
    }

    /// Takes over stripes of hatching for the scene that is shown.
    pub fn show_stripes(&mut self, stripes: GpuStripes) {
        if let Some(scene) = &mut self.scene {
            scene.set_stripes(stripes);
            self.scene_revision += 1;
        }
    }

    /// Uploads a scene and shows it. `topology` has one entry per mesh, or is empty while it is not known.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`]; the last scene then stays.
    pub fn set_scene(&mut self, scene: &Arc<Scene>, topology: &[Topology]) -> Result<(), RenderError> {
        let scene = self.uploader().scene(scene, topology)?;
        self.show(scene);
        Ok(())
    }

    /// Puts objects beside the scene that is shown, in place of the last ones; the scene itself stays as it is. Another
    /// scene comes without them. They stand behind the glyphs of the document.
    pub fn show_additions(&mut self, additions: Vec<Addition>) {
        if self.additions != additions {
            self.additions = additions;
            // The next picture puts them beside its document's glyphs.
            self.has_new_additions = true;
        }
    }

    /// Puts a document's glyphs and the other additions beside the scene, unless they are there.
    fn update_additions(&mut self, document: &Document) -> Result<(), RenderError> {
        let Some(scene) = &mut self.scene else { return Ok(()) };
        let (glyphs, paper) = document.glyph_inputs();
        let is_known = self.glyphs.0 == glyphs && (glyphs.is_empty() || self.glyphs.1 == paper);
        if is_known && !self.has_new_additions {
            return Ok(());
        }
        let shapes = document.glyph_shapes(scene.model(), scene.model_bounds());
        scene.set_additions(&self.gpu, shapes.additions.into_iter().chain(self.additions.iter().cloned()))?;
        self.glyphs = (glyphs.to_vec(), paper);
        self.has_new_additions = false;
        self.scene_revision += 1;
        Ok(())
    }

    /// The scene that is shown, on the device.
    pub fn scene(&self) -> Option<&GpuScene> {
        self.scene.as_ref()
    }

    /// Takes over the images that styles name; those that are missing are drawn without.
    pub fn set_images(&mut self, images: StyleImages) {
        if self.images.all() != images.all() {
            self.scene_revision += 1;
        }
        self.images = images;
    }

    /// Number of bodies that the section cuts and that have no cap, for they enclose no volume.
    pub fn open_bodies(&self) -> usize {
        self.scene.as_ref().and_then(|scene| scene.section.as_ref()).map_or(0, Section::open_bodies)
    }

    /// The images that it has.
    pub fn images(&self) -> &StyleImages {
        &self.images
    }

    /// Measures each pass from now on, if the device can; ask [`Self::timings`] after each frame.
    pub fn enable_timers(&mut self) {
        self.timers = Timers::new(&self.gpu);
    }

    /// Keeps the textures that have a name from now on, among those that pictures are made of, for a look at them: `geometry`,
    /// `surface ids`, `base color`, `depth` (see `passes/gbuffer.rs`), `edge map`, `shadow mask`, `cartoon map`, `coordinates`,
    /// `operators`, `depth mask`, `triangles`, of the last sketch `noise of lines`, and of the layers of a blueprint
    /// [`crate::render::LAYERS`].
    pub fn capture(&mut self, name: &'static str) {
        self.intermediates.entry(name).or_default();
    }

    /// The textures of that name that the last picture was made of; none where it was made without.
    pub fn captured(&self, name: &str) -> &[Target] {
        self.intermediates.get(name).map_or(&[], Vec::as_slice)
    }

    /// How far the layers of each blueprint came of the last picture. Waits for it.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn layer_reports(&self) -> Result<Vec<LayerReport>, RenderError> {
        self.state.drawing().layer_reports(&self.gpu)
    }

    /// Milliseconds of each pass of the last frame, in order; empty without timers. Waits for the frame.
    ///
    /// # Errors
    /// [`GpuError::Lost`].
    pub fn timings(&mut self) -> Result<Vec<(&'static str, f64)>, RenderError> {
        Ok(match &mut self.timers {
            Some(timers) => timers.take(&self.gpu)?,
            None => Vec::new(),
        })
    }

    /// Draws one sample of a picture. Whoever wants a smooth one asks again with the same request until
    /// [`Picture::sample`] is the last one; each answer shows the mean of all samples so far. After any change the next
    /// request begins anew, so no picture holds anything of another one. Without a scene, or with nothing visible, that is empty paper.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn render(&mut self, request: &Request<'_>) -> Result<Picture, RenderError> {
        let document = request.document.clamped();
        let shown = document.shown();
        self.render_as_it_is(&Request { document: shown.as_ref().unwrap_or(&document), ..*request })
    }

    fn render_as_it_is(&mut self, request: &Request<'_>) -> Result<Picture, RenderError> {
        if self.scene.is_none() {
            self.set_scene(&Arc::new(Scene::default()), &[])?;
        }
        self.update_additions(request.document)?;
        self.note_reports();
        let Some(scene) = &mut self.scene else {
            return Err(GpuError::Lost("no scene".to_owned()).into());
        };
        if scene.set_section(&self.gpu, request.document)? {
            self.scene_revision += 1;
        }
        let size = request.size.map(|s| s.max(1));
        let scale = size[1] as f32 / REFERENCE_HEIGHT as f32;
        let is_single = request.samples <= 1;
        let objects = Objects::new(request.document, scene, &self.images, &self.strokes, scale, is_single);
        let subject = Subject {
            shaders: self.pipelines.generation(),
            scene_revision: self.scene_revision,
            document: request.document.clone(),
            camera: *request.camera,
            size,
            is_single,
            incomplete: self.incomplete,
        };
        let sample = self.state.next_sample(subject, request.samples);
        let view = View::new(request.camera, &objects.visible_bounds, UVec2::from_array(size));
        scene.face(&view);
        let scene = &*scene;
        let view =
            view.moved(sample.jitter()).with_section(scene.section.as_ref().map(|section| section.plane));
        let paper = request.document.paper().to_linear();
        let background = paper.extend(if request.transparent { 0.0 } else { 1.0 });
        let timers = self.timers.as_mut();
        let frame = self.state.drawing().frame_group().clone();
        let mut recorder = Recorder::new(
            &self.gpu,
            &mut self.pipelines,
            &mut self.pool,
            timers,
            frame,
            size,
            &mut self.intermediates,
        );
        let lights = Lights::new(request.document, &scene.scene, &view.view_from_world);
        let meters = request.document.meters_per_unit(&scene.scene);
        let shows_bar = request.document.view.scale_bar;
        let bar = shows_bar.then(|| ScaleBar::new(request.camera, meters, size, scale, paper)).flatten();
        let inputs = FrameInputs {
            drawing: DrawingInputs {
                scene_view: SceneView {
                    scene,
                    scene_revision: self.scene_revision,
                    view: &view,
                    sample,
                    lights: &lights,
                    background,
                    scale,
                    crease_angle: request.document.view.crease_angle.to_radians(),
                    layers_by: request.document.view.layer_method,
                },
                objects: &objects,
                shadow_maps: &[],
                reflections: request.document.view.reflections.round() as u32,
            },
            view: views::DebugView { show: request.document.view.show, layer: request.document.view.layer },
            scale_bar: bar.as_ref(),
            selected: request.selected,
        };
        // The old picture's textures may be drawn into again.
        self.last = None;
        let picture = self.state.record(&mut recorder, &inputs)?;
        recorder.submit();
        self.pool.shrink_to(&[size, size.map(|side| side.div_ceil(LINE_BLOCK))]);
        self.state.shrink(&self.gpu);
        self.last = Some((picture.clone(), view));
        self.note_reports();
        Ok(picture)
    }

    /// What the device has reported about the pictures so far. Never waits: a report is there at the latest when the device
    /// is done with the picture. After [`Reported::Incomplete`] the same request begins anew, with room enough.
    pub fn take_reports(&mut self) -> Reported {
        let reported = self.note_reports();
        if std::mem::take(&mut self.was_incomplete) { Reported::Incomplete } else { reported }
    }

    fn note_reports(&mut self) -> Reported {
        self.gpu.poll();
        let reported = self.state.take_reports();
        self.is_settled = reported == Reported::Complete;
        if reported == Reported::Incomplete {
            self.incomplete += 1;
            self.was_incomplete = true;
        }
        reported
    }

    /// How far the layers of each blueprint came in the last picture whose report has arrived, and how they were made; in
    /// the order of [`Objects::blueprints`].
    pub fn last_layer_reports(&self) -> Vec<Option<(LayerReport, LayerMethod)>> {
        self.state.drawing().last_layer_reports()
    }

    /// The same of the blueprint that objects of this style are in; `None` if there is none, or if nothing is known yet.
    pub fn last_layer_report_of(&self, style: &Style) -> Option<&(LayerReport, LayerMethod)> {
        self.state.drawing().last_layer_report_of(style)
    }

    /// In how many bands of rows the groups of the last picture that overlap were drawn, as far as there was room; 0: none do.
    pub fn bands(&self) -> usize {
        self.state.drawing().bands()
    }

    /// How often each stage has run so far.
    pub fn runs(&self) -> Vec<(&'static str, u64)> {
        self.state.runs()
    }

    /// Asks what lies under a pixel of the last picture; the answer comes through [`Self::poll_pick`].
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn start_pick(&mut self, px: [u32; 2]) -> Result<(), RenderError> {
        let Some((picture, view)) = &self.last else { return Ok(()) };
        let [w, h] = picture.front.surfaces.size();
        let px = [px[0].min(w - 1), px[1].min(h - 1)];
        let texel = |target| Readback::start(&self.gpu, target, px, [1, 1]);
        let texels = picture.front.all().map(texel).collect::<Result<_, _>>()?;
        let px = Vec2::new(px[0] as f32 + 0.5, px[1] as f32 + 0.5);
        self.pick = Some(PendingPick { texels, view: *view, px });
        Ok(())
    }

    /// The answer to the last [`Self::start_pick`], once, as soon as it is there. Never waits.
    pub fn poll_pick(&mut self) -> Option<Pick> {
        let pending = self.pick.as_ref()?;
        let texels: Vec<Vec<u8>> = pending.texels.iter().map(|t| t.poll(&self.gpu)).collect::<Option<_>>()?;
        let found = texels.iter().filter_map(|texel| {
            let texel: Vec<u32> = bytemuck::pod_collect_to_vec(texel);
            Some((node_of(*texel.get(3)?)?, f32::from_bits(*texel.get(2)?)))
        });
        let nearest = found.min_by(|(_, a), (_, b)| a.total_cmp(b));
        let point = nearest.map(|(_, depth)| pending.view.unproject(pending.px, depth));
        self.pick = None;
        let node = nearest.map(|(node, _)| self.scene.as_ref().map_or(node, |s| s.scene.meant_by(node)));
        Some(Pick { node, point })
    }

    /// Whether an answer is still on its way.
    pub fn is_picking(&self) -> bool {
        self.pick.is_some()
    }

    /// Whether shaders come from a folder and can be reloaded.
    pub fn can_reload_shaders(&self) -> bool {
        Shaders::from_environment().can_change()
    }

    /// Reads changed shaders again; when one is wrong, everything stays as it was.
    ///
    /// # Errors
    /// The mistake, with file and line.
    pub fn reload_shaders(&mut self) -> Result<(), ShaderError> {
        self.pipelines.reload()
    }

    /// The mistake that was found in the shaders at the start, once.
    pub fn take_shader_error(&mut self) -> Option<ShaderError> {
        self.shader_error.take()
    }
}
