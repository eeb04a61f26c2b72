//! Sketches: groups of one layer whose geometry, shade and ink are made as everybody's, and whose place is their own: lines and
//! colors are drawn beside where they belong, with the depth of where they come from (Nienhaus and Döllner, "Sketchy Drawings",
//! 2004).
//!
//! ```text
//! geometry ─► shade ──────────────► color, fetched from beside ─► placed by its depth ─┐
//!    │  └───► noise of surfaces ──────┘                                                 ├─► composition
//!    └─► edge map ─► moved edge map ─► ink ──────────────────────► placed by its depth ─┘
//!            └─► noise of lines ┘
//! ```

mod group;
mod images;
mod ink;
mod noise;
mod placing;
mod uniforms;

pub use self::group::SketchGroup;
use self::images::SketchImages;
pub use self::images::prepare_image;
use self::ink::{MovedLines, SketchPasses};
use self::noise::{NoiseInputs, SketchNoise};
use self::placing::{Fetched, Placed, Placing};
pub use self::uniforms::field;
use self::uniforms::{SketchObject, SketchUniform};
use super::opaque::{OpaqueInputs, OpaqueLayer, OpaqueSurfaces};
use super::surface::{Look, Shading};
use super::techniques::SharedTechniques;
use crate::gpu::{ArrayBuffer, Gpu, Recorder, Target, UniformBuffer, inputs};
use crate::render::base::edge_styles::EdgeStyles;
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::instances::{Instance, InstanceBuffer};
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::passes::composition::Composition;
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::gbuffer::GBuffer;
use crate::render::passes::layers::Reported;
use crate::render::passes::line_distance::nearest_lines;
use crate::render::passes::line_pixels::ListedLines;
use crate::render::passes::offset_field::NoiseSource;
use crate::render::passes::shadows::ShadowMap;
use crate::render::passes::traversal::{DrawList, GBufferPass};
use crate::style;

/// What sketches of all cameras share.
pub struct SharedSketches {
    images: SketchImages,
}

impl SharedSketches {
    /// Makes nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { images: SketchImages::new(gpu) }
    }
}

/// What a sketch is drawn with.
pub struct Sketching<'a> {
    /// Draws geometry.
    pub gbuffer: &'a mut GBufferPass,
    /// What techniques share.
    pub techniques: &'a mut SharedTechniques,
    /// What sketches share.
    pub shared: &'a mut SharedSketches,
}

/// A sketch as a camera sees it.
#[derive(Clone, Copy)]
pub struct SketchInputs<'a> {
    /// The scene as the camera sees it.
    pub scene_view: SceneView<'a>,
    /// What is drawn.
    pub sketch: &'a SketchGroup,
    /// All that is in bind group 0.
    pub uniform: &'a FrameUniform,
    /// How surfaces look.
    pub look: &'a Look,
    /// The maps of the lights that throw shadows, by channel.
    pub shadow_maps: &'a [ShadowMap],
}

/// What the color of the surfaces depends on.
#[derive(PartialEq)]
struct ShadeKey {
    gbuffer: u64,
    /// Where shading goes by lines.
    lines: Option<u64>,
    shadows: Option<u64>,
    look: Look,
    uniform: FrameUniform,
    blends: bool,
}

/// What is placed depends on this.
#[derive(PartialEq)]
struct PlaceKey {
    shaders: u64,
    color: u64,
    geometry: u64,
    edges: Option<u64>,
    near_lines: Option<u64>,
    hidden: Option<u64>,
    fill_field: u64,
    /// Of the lines that reach each pixel, by pass.
    moved: Vec<u64>,
    before: [Option<u64>; 3],
    lays_ink: bool,
    sketch: SketchUniform,
    objects: Vec<SketchObject>,
    styles: EdgeStyles,
    uniform: FrameUniform,
    images: u64,
    /// Says what is asked of the shader at all.
    style: style::Sketch,
}

/// What of a sketch lives across frames.
pub struct SketchState {
    layer: OpaqueLayer,
    shading: Shading,
    color: Stage<ShadeKey, Target>,
    near_radius: ArrayBuffer,
    /// For smudges.
    near_lines: Stage<(u64, u32), Target>,
    enlarged: Stage<(u64, f32), GBuffer>,
    instance_buffer: InstanceBuffer,
    noise: SketchNoise,
    passes: SketchPasses,
    uniform: UniformBuffer<SketchUniform>,
    objects: ArrayBuffer,
    placed: Stage<PlaceKey, Placed>,
}

impl SketchState {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            layer: OpaqueLayer::new(gpu),
            shading: Shading::new(gpu),
            color: Stage::default(),
            near_radius: ArrayBuffer::new(gpu, "distance of lines"),
            near_lines: Stage::default(),
            enlarged: Stage::default(),
            instance_buffer: InstanceBuffer::new(gpu),
            noise: SketchNoise::new(gpu),
            passes: SketchPasses::new(gpu),
            uniform: UniformBuffer::new(gpu, "sketch"),
            objects: ArrayBuffer::new(gpu, "objects of a sketch"),
            placed: Stage::default(),
        }
    }

    /// How often each of its stages has run, by name.
    pub fn runs(&self) -> Vec<(&'static str, u64)> {
        let mut runs = self.layer.runs().to_vec();
        runs.extend([
            ("moved edges", self.passes.runs()),
            ("noise", self.noise.runs()),
            ("sketch", self.placed.runs()),
        ]);
        runs
    }

    /// What has been reported about its hidden lines. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        self.layer.take_reports()
    }

    // Long, as its key names everything that the placed sketch is made of.
    /// Places the sketch among what is opaque, of which `color` is the color without lines; returns that with the sketch, and with
    /// its ink if `is_last`: nothing is placed among it any more.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn place(
        &mut self,
        rec: &mut Recorder<'_>,
        with: Sketching<'_>,
        inputs: &SketchInputs<'_>,
        composition: &mut Composition,
        color: &Output<Target>,
        is_last: bool,
    ) -> Result<Output<Target>, RenderError> {
        let SketchInputs { scene_view, sketch, uniform, shadow_maps, .. } = *inputs;
        let Sketching { gbuffer: pass, techniques, shared } = with;
        let group = &sketch.group;
        let own = OpaqueInputs { scene_view, group, uniform, shadow_maps };
        let surfaces = self.layer.surfaces(rec, pass, &own)?;
        let edges = if group.have_lines() { Some(self.layer.edges(rec, &own, &surfaces)?) } else { None };
        let hidden = self.layer.hidden_lines(rec, pass, &own, &sketch.hidden, edges.as_ref())?;
        let shaded = self.shade(rec, techniques, inputs, &surfaces, edges.as_ref())?;
        let noise = sketch.is_on_screen().then_some(&sketch.style.wander);
        let paper = sketch.has_paper().then_some(&sketch.paper);
        let images = shared.images.prepare(rec.gpu, noise, paper)?;
        let (field_objects, objects) = sketch.objects(&scene_view);
        let enlarged = self.enlarge(rec, pass, inputs, &surfaces)?;
        let noise = NoiseInputs { sketch, objects: &field_objects, uniform };
        self.noise.write(rec.gpu, &noise);
        let source = if sketch.is_on_screen() {
            Output { value: NoiseSource::Tile(images.tile), revision: images.revision }
        } else if let Some(Output { value, revision }) = &enlarged {
            Output { value: NoiseSource::Enlarged(value), revision: *revision }
        } else {
            let Output { value, revision } = &surfaces.gbuffer;
            Output { value: NoiseSource::Lines(value), revision: *revision }
        };
        let moved = self.move_lines(rec, &noise, edges.as_ref(), &source)?;
        let followed = enlarged.as_ref().unwrap_or(&surfaces.gbuffer);
        let fill_field = self.noise.of_surfaces(rec, &noise, followed)?;
        let near_lines = self.near_lines(rec, sketch, edges.as_ref())?;
        let lays_ink = is_last && composition.ink.is_none();
        let key = PlaceKey {
            shaders: rec.pipelines.generation(),
            color: shaded.revision,
            geometry: surfaces.gbuffer.revision,
            edges: edges.as_ref().map(|edges| edges.revision),
            near_lines: near_lines.as_ref().map(|near| near.revision),
            hidden: hidden.as_ref().map(|hidden| hidden.revision),
            fill_field: fill_field.revision,
            moved: moved.iter().map(|moved| moved.line_distance.revision).collect(),
            before: [
                Some(composition.surfaces.revision),
                composition.ink.as_ref().map(|ink| ink.revision),
                Some(color.revision),
            ],
            lays_ink,
            sketch: SketchUniform::new(&sketch.style, sketch.scale),
            objects,
            styles: group.edge_styles.clone(),
            uniform: uniform.without_background(),
            images: images.revision,
            style: sketch.style.clone(),
        };
        let fetched =
            Fetched { surfaces: &surfaces, color: shaded, edges, near_lines, hidden, moved, fill_field };
        // Ink that is there is placed anew once.
        let count = if fetched.edges.is_some() { sketch.passes().len() } else { 1 };
        let Self { layer, uniform, objects, placed, passes, .. } = self;
        let placed = placed.run(key, |key| {
            uniform.write(rec.gpu, &key.sketch);
            objects.write(rec.gpu, &key.objects);
            let own = inputs! {
                sketch: uniform.buffer(),
                sketch_objects: &*objects,
                tiles: images.tile,
                paper: images.paper,
                tile_sampler: images.sampler,
            };
            let numbers = passes.numbers(rec.gpu, count);
            let before = &color.value;
            let drawing = Placing { sketch, layer, fetched: &fetched, composition, before, own, numbers };
            drawing.place(rec, lays_ink)
        })?;
        let Output { value: Placed { geometry, color, ink }, revision } = placed;
        let of_this = |value| Output { value, revision };
        let Output { value: GBuffer { geometry: own, .. }, revision: drawn } = surfaces.gbuffer.clone();
        let own = Output { value: own, revision: drawn };
        composition.place_sketch(own, geometry.map(of_this), ink.map(of_this));
        Ok(Output { value: color, revision })
    }

    /// The exact lines of each pass where noise moves them; empty: there are none.
    fn move_lines(
        &mut self,
        rec: &mut Recorder<'_>,
        noise: &NoiseInputs<'_>,
        edges: Option<&Output<EdgeMap>>,
        source: &Output<NoiseSource<'_>>,
    ) -> Result<Vec<MovedLines>, RenderError> {
        let spines = edges.and_then(|edges| Some((edges, edges.value.spines.as_ref()?)));
        let Some((edges, spines)) = spines else {
            self.noise.forget_lines();
            self.passes.forget();
            return Ok(Vec::new());
        };
        let pixels = self.layer.line_pixels(rec, spines)?;
        let listed = ListedLines { edges: &edges.value.edges, spines, pixels };
        let lines = Output { value: listed, revision: edges.revision };
        let field = self.noise.of_lines(rec, noise, &lines, source)?;
        self.passes.run(rec, noise.sketch, &lines, &field)
    }

    /// The surfaces enlarged along their normals, where the noise beyond outlines follows them.
    fn enlarge(
        &mut self,
        rec: &mut Recorder<'_>,
        pass: &mut GBufferPass,
        inputs: &SketchInputs<'_>,
        surfaces: &OpaqueSurfaces,
    ) -> Result<Option<Output<GBuffer>>, RenderError> {
        let SketchInputs { scene_view, sketch, uniform, .. } = *inputs;
        if !sketch.is_enlarged() {
            self.enlarged.clear();
            return Ok(None);
        }
        let [lines, fill] = uniforms::reaches(&sketch.style, sketch.scale);
        // No less than the largest offset, or there were none for it.
        let px = uniforms::enlarged(&sketch.style, sketch.scale).max(lines).max(fill);
        let Self { layer, enlarged, instance_buffer, .. } = self;
        let key = (surfaces.gbuffer.revision, px);
        let drawn = enlarged.run(key, |_| {
            let layer = layer.shaded(surfaces, scene_view, uniform, None);
            let instances: Vec<_> =
                layer.instances.iter().map(|instance| Instance { enlarged: px, ..*instance }).collect();
            let draw_list = DrawList {
                scene: scene_view.scene,
                instances: &instances,
                calls: layer.calls,
                is_clipped: scene_view.view.is_clipped(),
            };
            pass.run_enlarged(rec, &draw_list, instance_buffer)
        })?;
        Ok(Some(drawn))
    }

    fn shade(
        &mut self,
        rec: &mut Recorder<'_>,
        techniques: &mut SharedTechniques,
        inputs: &SketchInputs<'_>,
        surfaces: &OpaqueSurfaces,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Output<Target>, RenderError> {
        let SketchInputs { scene_view, sketch, uniform, look, .. } = *inputs;
        self.shading.upload(techniques, rec.gpu, look)?;
        let spines = look.lines(edges);
        let key = ShadeKey {
            lines: spines.map(|(_, revision)| revision),
            gbuffer: surfaces.gbuffer.revision,
            shadows: surfaces.shadow_mask.as_ref().map(|mask| mask.revision),
            look: look.clone(),
            uniform: uniform.without_background(),
            blends: sketch.blends,
        };
        let Self { layer, shading, color, .. } = self;
        color.run(key, |key| {
            let layer = layer.shaded(surfaces, scene_view, &key.uniform, spines);
            shading.shade(rec, techniques, &key.look, &layer, sketch.blends)
        })
    }

    /// The line next to each pixel, from as far as it is smudged; `None`: none is.
    fn near_lines(
        &mut self,
        rec: &mut Recorder<'_>,
        sketch: &SketchGroup,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Option<Output<Target>>, RenderError> {
        let distance = uniforms::smudged(&sketch.style, sketch.scale);
        let spines = edges.and_then(|edges| Some((edges.revision, edges.value.spines.as_ref()?)));
        let Some((revision, spines)) = spines.filter(|_| distance > 0.0) else {
            self.near_lines.clear();
            return Ok(None);
        };
        let radius = &mut self.near_radius;
        let key = (revision, distance.ceil() as u32);
        self.near_lines.run(key, |_| nearest_lines(rec, spines, distance.ceil(), radius)).map(Some)
    }
}
