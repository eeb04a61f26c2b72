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
mod uniforms;

pub use self::group::SketchGroup;
pub use self::images::prepare_image;
use self::images::{Prepared, SketchImages};
use self::ink::{MovedLines, SketchPass};
pub use self::uniforms::field;
use self::uniforms::{SketchObject, SketchUniform};
use super::opaque::{OpaqueInputs, OpaqueLayer, Surfaces};
use super::surface::{Look, Shading};
use super::techniques::SharedTechniques;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{
    ArrayBuffer, DepthRule, Gpu, Inputs, Program, Recorder, STENCIL, Target, UniformBuffer, inputs,
};
use crate::render::base::edge_style::EdgeUniform;
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::instances::{Instance, InstanceBuffer};
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::passes::composition::{Composition, PLACED};
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::gbuffer::GBuffer;
use crate::render::passes::layers::Reported;
use crate::render::passes::line_distance::nearest_lines;
use crate::render::passes::moved_edges::MovedEdgesPass;
use crate::render::passes::offset_field::{
    FieldBuffers, FieldUniform, LineField, LineFieldPass, NoiseSource, ObjectUniform, fill_field,
    nearest_surfaces,
};
use crate::render::passes::shadows::ShadowMap;
use crate::render::passes::traversal::GBufferPass;
use crate::style;
use crate::style::sketch::{SketchDepth as StyleDepth, Tone};

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

/// What has been placed: all that is opaque so far.
#[derive(Debug, Clone)]
struct Placed {
    geometry: Target,
    color: Target,
    ink: Option<Target>,
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

/// What noise depends on.
#[derive(PartialEq)]
struct FieldKey {
    /// Lines or surfaces, and the geometry that noise follows.
    of: [u64; 2],
    field: FieldUniform,
    objects: Vec<ObjectUniform>,
    uniform: FrameUniform,
}

impl FieldKey {
    /// That of noise which is of the same field, by what it is of.
    fn of(
        field: FieldUniform,
        objects: &[ObjectUniform],
        uniform: &FrameUniform,
    ) -> impl Fn([u64; 2]) -> Self {
        move |of| Self { of, field, objects: objects.to_vec(), uniform: uniform.without_background() }
    }
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
    styles: Vec<EdgeUniform>,
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
    nearest_surfaces: Stage<(u64, u32), Target>,
    field: UniformBuffer<FieldUniform>,
    field_objects: ArrayBuffer,
    line_field_pass: LineFieldPass,
    line_field: Stage<FieldKey, LineField>,
    fill_field: Stage<FieldKey, Target>,
    moved_pass: MovedEdgesPass,
    passes: Vec<SketchPass>,
    uniform: UniformBuffer<SketchUniform>,
    objects: ArrayBuffer,
    placed: Stage<PlaceKey, Placed>,
}

/// What is fetched from, drawn.
struct Fetched<'a> {
    surfaces: &'a Surfaces,
    color: Output<Target>,
    edges: Option<Output<EdgeMap>>,
    near_lines: Option<Output<Target>>,
    hidden: Option<Output<Target>>,
    /// By pass; empty: there are no exact lines.
    moved: Vec<MovedLines>,
    fill_field: Output<Target>,
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
            nearest_surfaces: Stage::default(),
            field: UniformBuffer::new(gpu, "offset field"),
            field_objects: ArrayBuffer::new(gpu, "objects of an offset field"),
            line_field_pass: LineFieldPass::new(gpu),
            line_field: Stage::default(),
            fill_field: Stage::default(),
            moved_pass: MovedEdgesPass::new(gpu),
            passes: Vec::new(),
            uniform: UniformBuffer::new(gpu, "sketch"),
            objects: ArrayBuffer::new(gpu, "objects of a sketch"),
            placed: Stage::default(),
        }
    }

    /// How often each of its stages has run, by name.
    pub fn runs(&self) -> Vec<(&'static str, u64)> {
        let mut runs = self.layer.runs().to_vec();
        runs.extend([
            ("moved edges", self.passes.iter().map(SketchPass::runs).sum()),
            ("noise", self.line_field.runs() + self.fill_field.runs()),
            ("sketch", self.placed.runs()),
        ]);
        runs
    }

    /// What has been reported about its hidden lines. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        self.layer.take_reports()
    }

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
        let key = FieldKey::of(sketch.field(), &field_objects, uniform);
        self.field.write(rec.gpu, &sketch.field());
        self.field_objects.write(rec.gpu, &field_objects);
        let moved =
            self.move_lines(rec, sketch, edges.as_ref(), (&surfaces, enlarged.as_ref()), &images, &key)?;
        let fill_field =
            self.fill_field(rec, sketch, enlarged.as_ref().unwrap_or(&surfaces.gbuffer), &key)?;
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
        self.passes.resize_with(count.max(self.passes.len()), || SketchPass::new(rec.gpu));
        let Self { layer, uniform, objects, placed, passes, .. } = self;
        let placed = placed.run(key, |key| {
            uniform.write(rec.gpu, &key.sketch);
            objects.write(rec.gpu, &key.objects);
            let own = inputs! {
                sketch: uniform.buffer(),
                sketch_objects: objects.buffer(),
                tiles: images.tile,
                paper: images.paper,
                tile_sampler: images.sampler,
            };
            let numbers: Vec<_> = (0..count).zip(passes).map(|(i, pass)| pass.number(rec.gpu, i)).collect();
            let before = &color.value;
            let drawing = Placing { sketch, layer, fetched: &fetched, composition, before, own, numbers };
            drawing.place(rec, lays_ink)
        })?;
        let Output { value: Placed { geometry, color, ink }, revision } = placed;
        let ink = ink.map(|value| Output { value, revision });
        composition.place_opaque(Output { value: geometry, revision }, ink);
        Ok(Output { value: color, revision })
    }

    /// The exact lines of each pass where noise moves them; empty: there are none.
    fn move_lines(
        &mut self,
        rec: &mut Recorder<'_>,
        sketch: &SketchGroup,
        edges: Option<&Output<EdgeMap>>,
        (surfaces, enlarged): (&Surfaces, Option<&Output<GBuffer>>),
        images: &Prepared<'_>,
        key: &impl Fn([u64; 2]) -> FieldKey,
    ) -> Result<Vec<MovedLines>, RenderError> {
        let spines = edges.and_then(|edges| Some((edges, edges.value.spines.as_ref()?)));
        let Some((edges, spines)) = spines else {
            self.line_field.clear();
            self.passes.iter_mut().for_each(SketchPass::forget);
            return Ok(Vec::new());
        };
        let (source, revision) = if sketch.is_on_screen() {
            (NoiseSource::Tile(images.tile), images.revision)
        } else if let Some(enlarged) = enlarged {
            (NoiseSource::Enlarged(&enlarged.value), enlarged.revision)
        } else {
            (NoiseSource::Lines(&surfaces.gbuffer.value), surfaces.gbuffer.revision)
        };
        let buffers = FieldBuffers { field: self.field.buffer(), objects: self.field_objects.buffer() };
        let pass = &mut self.line_field_pass;
        let count = sketch.passes().len();
        let field = self.line_field.run(key([edges.revision, revision]), |_| {
            pass.compact(rec, spines)?;
            pass.run(rec, buffers, &edges.value.edges, source, count as u32)
        })?;
        rec.note("noise of lines", Some(&field.value.first));
        self.passes.truncate(count);
        self.passes.resize_with(count, || SketchPass::new(rec.gpu));
        let Self { passes, moved_pass, line_field_pass, .. } = self;
        let pixels = line_field_pass.pixels();
        let all = passes.iter_mut().enumerate();
        all.map(|(number, pass)| pass.run(rec, moved_pass, sketch, number, edges, spines, &field, pixels))
            .collect()
    }

    /// Noise of the nearest surface around each block.
    fn fill_field(
        &mut self,
        rec: &mut Recorder<'_>,
        sketch: &SketchGroup,
        followed: &Output<GBuffer>,
        key: &impl Fn([u64; 2]) -> FieldKey,
    ) -> Result<Output<Target>, RenderError> {
        // Ink of the papers' operators follows surfaces too.
        let [lines, fill] = uniforms::bands(&sketch.style, sketch.scale);
        let band = lines.max(fill);
        let geometry = &followed.value.geometry;
        let nearest = self
            .nearest_surfaces
            .run((followed.revision, band as u32), |_| nearest_surfaces(rec, geometry, band))?;
        let buffers = FieldBuffers { field: self.field.buffer(), objects: self.field_objects.buffer() };
        self.fill_field.run(key([nearest.revision, followed.revision]), |_| {
            fill_field(rec, buffers, geometry, &nearest.value)
        })
    }

    /// The surfaces enlarged along their normals, where the noise beyond outlines follows them.
    fn enlarge(
        &mut self,
        rec: &mut Recorder<'_>,
        pass: &mut GBufferPass,
        inputs: &SketchInputs<'_>,
        surfaces: &Surfaces,
    ) -> Result<Option<Output<GBuffer>>, RenderError> {
        let SketchInputs { scene_view, sketch, uniform, .. } = *inputs;
        if !sketch.is_enlarged() {
            self.enlarged.clear();
            return Ok(None);
        }
        let [lines, fill] = uniforms::bands(&sketch.style, sketch.scale);
        // No less than the largest offset, or there were none for it.
        let px = uniforms::enlarged(&sketch.style, sketch.scale).max(lines).max(fill);
        let Self { layer, enlarged, instance_buffer, .. } = self;
        let key = (surfaces.gbuffer.revision, px);
        let drawn = enlarged.run(key, |_| {
            let layer = layer.shaded(surfaces, scene_view, uniform, None);
            let instances: Vec<_> =
                layer.instances.iter().map(|instance| Instance { enlarged: px, ..*instance }).collect();
            pass.run_enlarged(
                rec,
                scene_view.scene,
                instance_buffer,
                (&instances, layer.calls),
                scene_view.view.is_clipped(),
            )
        })?;
        Ok(Some(drawn))
    }

    fn shade(
        &mut self,
        rec: &mut Recorder<'_>,
        techniques: &mut SharedTechniques,
        inputs: &SketchInputs<'_>,
        surfaces: &Surfaces,
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

/// A sketch while it is being placed.
struct Placing<'a> {
    sketch: &'a SketchGroup,
    layer: &'a OpaqueLayer,
    fetched: &'a Fetched<'a>,
    composition: &'a Composition,
    before: &'a Target,
    /// Of the sketch itself.
    own: Inputs<'a>,
    /// Numbers of its passes.
    numbers: Vec<&'a wgpu::Buffer>,
}

impl Placing<'_> {
    /// Places color, then ink: over the color if it `lays_ink`.
    fn place(&self, rec: &mut Recorder<'_>, lays_ink: bool) -> Result<Placed, RenderError> {
        let Self { composition, before, .. } = *self;
        let [geometry, color] = [&composition.surfaces.value, before].map(|target| target.format());
        let geometry = rec.target("geometry with sketch", geometry)?;
        let color = rec.target("color with sketch", color)?;
        self.place_color(rec, &geometry, &color)?;
        let ink = if self.fetched.edges.is_none() && composition.ink.is_none() {
            None
        } else if lays_ink {
            for number in 0..self.numbers.len() {
                self.draw_ink(rec, number, (&geometry, None), (&color, "fs_lay_ink", Onto::Over))?;
            }
            None
        } else {
            let mut before = composition.ink.as_ref().map(|ink| ink.value.clone());
            for number in 0..self.numbers.len() {
                let ink = rec.target("ink with sketch", PLACED)?;
                self.draw_ink(rec, number, (&geometry, before.as_ref()), (&ink, "fs_ink", Onto::Clear))?;
                before = Some(ink);
            }
            before
        };
        Ok(Placed { geometry, color, ink })
    }

    /// What color and ink read.
    fn inputs(&self) -> Inputs<'_> {
        let Self { fetched, composition, .. } = self;
        self.own.clone().and(&composition.tested()).and(&inputs! {
            geometry_tex: &fetched.surfaces.gbuffer.value.geometry,
            fill_field_tex: &fetched.fill_field.value,
        })
    }

    fn switches(&self) -> Vec<(&'static str, bool)> {
        let Self { sketch, fetched, composition, .. } = self;
        let style = &sketch.style;
        let mut switches = vec![
            ("ON_SCREEN", sketch.is_on_screen()),
            ("ENLARGED", sketch.is_enlarged()),
            ("WITH_NEARER", style.wander.depth == StyleDepth::Nearer),
            ("WITH_GRAIN", style.grain.amount > 0.0),
            ("WITH_ROUGHNESS", style.grain.roughness > 0.0),
            ("WITH_STROKES", style.fill.strokes > 0.0),
            ("WITH_PRESSURE", style.wander.pressure > 0.0),
            ("WITH_DARKNESS", style.fill.tone == Tone::Darkness),
            ("WITH_SMUDGE", fetched.near_lines.is_some()),
            ("WITH_OPACITY", sketch.blends),
            ("WITH_HIDDEN", fetched.hidden.is_some()),
        ];
        switches.extend(composition.switches());
        switches
    }

    fn place_color(
        &self,
        rec: &mut Recorder<'_>,
        geometry: &Target,
        color: &Target,
    ) -> Result<(), RenderError> {
        let Self { fetched, composition, before, .. } = self;
        let inputs = self.inputs().and(&inputs! {
            shaded_tex: &fetched.color.value,
            hidden_tex: fetched.hidden.as_ref().map(|hidden| &hidden.value),
            near_line_tex: fetched.near_lines.as_ref().map(|near| &near.value),
            before_tex: *before,
        });
        let onto = if composition.has_surfaces {
            rec.copy(&composition.surfaces.value, geometry);
            rec.copy(before, color);
            Onto::Load
        } else {
            Onto::Clear
        };
        let filled = rec.target("covered by color", STENCIL)?;
        rec.draw(Draw {
            label: "sketched color",
            program: Program {
                file: "effects/sketch.wgsl",
                entry_point: "fs_fill",
                switches: self.switches(),
            },
            inputs: &inputs,
            outputs: &[geometry, color],
            onto,
            depth: Some((&filled, DepthRule::Where("fs_filled"))),
        })?;
        Ok(())
    }

    /// Draws the ink of a pass, with that `before` it.
    fn draw_ink(
        &self,
        rec: &mut Recorder<'_>,
        number: usize,
        (geometry, before): (&Target, Option<&Target>),
        (output, entry_point, onto): (&Target, &'static str, Onto),
    ) -> Result<(), RenderError> {
        let Self { sketch, layer, fetched, .. } = self;
        let moved = fetched.moved.get(number);
        let edges = moved.map(|moved| moved.edges.edge_map());
        let edges = edges.as_ref().or(fetched.edges.as_ref().map(|edges| &edges.value));
        let mut inputs = self.inputs();
        let mut switches = self.switches();
        if let Some(edges) = edges {
            let line_distance = moved.map(|moved| &moved.line_distance.value);
            let lines = layer.lines(&sketch.group, fetched.surfaces, edges, line_distance);
            inputs.extend(&lines.inputs());
            switches.extend(lines.switches());
        } else {
            // What is new hides ink that is there.
            switches.extend([("WITH_PAPER", false), ("WITH_EXACT", false)]);
        }
        inputs.extend(&inputs! {
            pass_number: self.numbers[number],
            paper_map_tex: fetched.edges.as_ref().map(|edges| &edges.value.edges),
            source_tex: moved.map(|moved| &moved.edges.sources),
            filled_tex: geometry,
            opaque_ink_tex: before,
        });
        switches.retain(|(name, _)| *name != "WITH_OPAQUE_INK");
        switches.extend([
            ("MOVED", true),
            ("WITH_OPAQUE_INK", before.is_some()),
            ("BEFORE_IS_OTHER", number == 0),
        ]);
        let inked = rec.target("covered by ink", STENCIL)?;
        rec.draw(Draw {
            label: "sketched ink",
            program: Program { file: "effects/sketch.wgsl", entry_point, switches },
            inputs: &inputs,
            outputs: &[output],
            onto,
            depth: Some((&inked, DepthRule::Where("fs_inked"))),
        })?;
        Ok(())
    }
}
