//! Sketches: groups of one layer whose geometry, shade and ink are made as everybody's, and whose place is their own: lines and
//! colours are fetched from beside where they go, with the depth of what was fetched (Nienhaus and Döllner, "Sketchy Drawings",
//! 2004).
//!
//! ```text
//! geometry ─► shade ──────────────► colour ─► placed by its depth ─┐
//!    │  └───► noise of surfaces ──────┘                            ├─► composition
//!    └─► edge map ─► nearest lines ─► ink ──► placed by its depth ─┘
//!            └─────► noise of lines ──┘
//! ```

mod images;
mod uniforms;

use glam::Vec2;

pub use self::images::prepare_image;
use self::images::{Paper, SketchImages};
pub use self::uniforms::field;
use self::uniforms::{SketchObject, SketchUniform};
use super::hidden::Hidden;
use super::opaque::{OpaqueInputs, OpaqueLayer, Surfaces};
use super::surface::{Look, Shading};
use super::techniques::SharedTechniques;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{ArrayBuffer, DepthRule, Gpu, Inputs, Program, Recorder, Target, UniformBuffer, inputs};
use crate::render::base::edge_style::EdgeUniform;
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::group::Group;
use crate::render::base::ids::object_id;
use crate::render::base::instances::{Instance, Instances};
use crate::render::base::object_axes::ObjectAxes;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::base::strokes::StrokeStyle;
use crate::render::base::style_images::StyleImages;
use crate::render::passes::composition::{Composition, PLACED};
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::gbuffer::GBuffer;
use crate::render::passes::layers::Reported;
use crate::render::passes::line_distance::{Reach, have_widths, nearest_lines};
use crate::render::passes::lines::Lines;
use crate::render::passes::offset_field::{
    FieldBuffers, FieldUniform, LineField, LineFieldPass, ObjectUniform, fill_field, nearest_surfaces,
};
use crate::render::passes::shadows::ShadowMap;
use crate::render::passes::traversal::GBufferPass;
use crate::scene::AlphaMode;
use crate::style::sketch::{Anchor, DepthRule as StyleDepth, Exterior, Tone};
use crate::style::{self, Style, Technique};

/// Objects that are drawn as by hand in one way, together.
#[derive(Clone, PartialEq)]
pub struct Sketch {
    /// The objects.
    pub group: Group,
    /// Their hidden lines.
    pub hidden: Hidden,
    style: style::Sketch,
    paper: Paper,
    /// Whether something shows through any of them.
    blends: bool,
    /// Pixels per reference pixel.
    scale: f32,
}

impl Sketch {
    /// Whether a style is drawn as by hand; one that moves and roughens nothing is not.
    pub fn moves(style: &Style) -> bool {
        let sketch = &style.sketch;
        let style::sketch::Sketch { wander, passes, pass, fill, grain, strokes, .. } = sketch;
        let still = style::Sketch::default();
        let is_still = |matrix: style::Matrix| wander.amount <= 0.0 || matrix == style::Matrix::ZERO;
        let is_plain_pass = |pass: &style::sketch::Pass| {
            is_still(pass.matrix) && pass.color.is_none() && pass.width == 1.0 && pass.density == 1.0
        };
        let is_plain_fill = fill.show
            && is_still(fill.matrix)
            && (fill.density, fill.tone, fill.surface_color, fill.strokes)
                == (1.0, still.fill.tone, 1.0, 0.0);
        let is_plain_grain = grain.amount <= 0.0 && grain.roughness <= 0.0 && grain.smudge <= 0.0;
        let is_plain = *passes == 1
            && is_plain_pass(&pass[0])
            && is_plain_fill
            && is_plain_grain
            && wander.pressure <= 0.0
            && !strokes.enabled;
        sketch.enabled && style.technique != Technique::Blueprint && !is_plain
    }

    /// The sketch to which an object of this style belongs, in a scene with `count` object ids; `scale`: pixels per reference
    /// pixel.
    pub fn group_of<'a>(
        all: &'a mut Vec<Self>,
        style: &Style,
        count: usize,
        images: &StyleImages,
        scale: f32,
    ) -> &'a mut Self {
        let found = all.iter().position(|sketch| sketch.style == style.sketch);
        let index = found.unwrap_or(all.len());
        if found.is_none() {
            let strokes = StrokeStyle::new(&style.sketch.strokes, style.sketch.wander.seed, scale);
            all.push(Self {
                group: Group::new(count).with_strokes(strokes),
                hidden: Hidden::default(),
                style: style.sketch.clone(),
                paper: Paper::of(&style.sketch, images),
                blends: false,
                scale,
            });
        }
        &mut all[index]
    }

    /// Tells it what an object that was added is made of.
    pub fn add_alphas(&mut self, mut alphas: impl Iterator<Item = AlphaMode>) {
        self.blends |= alphas.any(|alpha| alpha == AlphaMode::Blend);
    }

    /// Greatest distance from where it belongs at which anything is drawn, px.
    pub fn greatest_reach(&self) -> f32 {
        let [lines, fill] = uniforms::bands(&self.style, self.scale);
        (self.group.greatest_reach() * self.widest() + lines).max(fill)
    }

    fn widest(&self) -> f32 {
        self.passes().iter().map(|pass| pass.width.clamp(0.1, 4.0)).fold(1.0, f32::max)
    }

    fn passes(&self) -> &[style::sketch::Pass] {
        let all = &self.style.pass;
        let count = (self.style.passes as usize).clamp(1, all.len());
        all.get(..count).unwrap_or(all)
    }

    fn is_enlarged(&self) -> bool {
        self.style.wander.exterior == Exterior::Enlarged && !self.is_on_screen()
    }

    fn is_on_screen(&self) -> bool {
        self.style.wander.anchor == Anchor::Screen
    }

    /// Whether anything of the tile of paper is seen.
    fn has_paper(&self) -> bool {
        let style::Sketch { fill, grain, .. } = &self.style;
        grain.amount > 0.0 || grain.roughness > 0.0 || fill.strokes > 0.0
    }

    fn field(&self) -> FieldUniform {
        uniforms::field(&self.style, self.scale)
    }

    /// How noise is found for each of its objects, and where their middles are.
    fn objects(&self, seen: &SceneView<'_>) -> (Vec<ObjectUniform>, Vec<SketchObject>) {
        let count = self.group.edge_styles.len();
        let mut fields = vec![ObjectUniform::default(); count];
        let mut places = vec![SketchObject::default(); count];
        // The noise does not shake with the samples of a picture.
        let view = seen.view.moved(Vec2::ZERO);
        let projector = view.projector();
        for object in self.group.visible() {
            let id = object_id(object.node);
            let Some(axes) = ObjectAxes::of(seen.scene, id, &view) else { continue };
            let (Some(field), Some(place)) = (fields.get_mut(id as usize), places.get_mut(id as usize))
            else {
                continue;
            };
            field.from_view = axes.from_view.as_mat4();
            field.seed = if self.style.wander.by_object { id } else { 0 };
            let middle = projector.pixel(axes.middle);
            place.middle = if middle.is_finite() { middle.as_vec2() } else { Vec2::ZERO };
        }
        (fields, places)
    }
}

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
    pub seen: SceneView<'a>,
    /// What is drawn.
    pub sketch: &'a Sketch,
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

/// What the colour of the surfaces depends on.
#[derive(PartialEq)]
struct ShadeKey {
    gbuffer: u64,
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

/// What is placed depends on this.
#[derive(PartialEq)]
struct PlaceKey {
    shaders: u64,
    color: u64,
    geometry: u64,
    edges: Option<u64>,
    near_lines: Option<u64>,
    hidden: Option<u64>,
    fields: [Option<u64>; 2],
    before: [Option<u64>; 3],
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
    near_lines: Stage<(u64, u32), Target>,
    enlarged: Stage<(u64, f32), GBuffer>,
    instances: Instances,
    nearest_surfaces: Stage<(u64, u32), Target>,
    field: UniformBuffer<FieldUniform>,
    field_objects: ArrayBuffer,
    line_field_pass: LineFieldPass,
    line_field: Stage<FieldKey, LineField>,
    fill_field: Stage<FieldKey, Target>,
    uniform: UniformBuffer<SketchUniform>,
    objects: ArrayBuffer,
    placed: Stage<PlaceKey, Placed>,
}

/// What is fetched from, drawn.
struct Fetched<'a> {
    surfaces: &'a Surfaces,
    color: Output<Target>,
    edges: Option<Output<EdgeMap>>,
    reach: Option<Reach>,
    near_lines: Option<Output<Target>>,
    hidden: Option<Output<Target>>,
    line_field: Option<Output<LineField>>,
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
            instances: Instances::new(gpu),
            nearest_surfaces: Stage::default(),
            field: UniformBuffer::new(gpu, "offset field"),
            field_objects: ArrayBuffer::new(gpu, "objects of an offset field"),
            line_field_pass: LineFieldPass::new(gpu),
            line_field: Stage::default(),
            fill_field: Stage::default(),
            uniform: UniformBuffer::new(gpu, "sketch"),
            objects: ArrayBuffer::new(gpu, "objects of a sketch"),
            placed: Stage::default(),
        }
    }

    /// How often each of its stages has run, by name.
    pub fn runs(&self) -> Vec<(&'static str, u64)> {
        let mut runs = self.layer.runs().to_vec();
        runs.extend([
            ("line distance", self.near_lines.runs()),
            ("noise", self.line_field.runs() + self.fill_field.runs()),
            ("sketch", self.placed.runs()),
        ]);
        runs
    }

    /// What has been reported about its hidden lines. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        self.layer.take_reports()
    }

    /// Places the sketch among what is opaque, of which `color` is the colour without lines; returns that with the sketch.
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
    ) -> Result<Output<Target>, RenderError> {
        let SketchInputs { seen, sketch, uniform, shadow_maps, .. } = *inputs;
        let Sketching { gbuffer: pass, techniques, shared } = with;
        let group = &sketch.group;
        let own = OpaqueInputs { seen, group, uniform, shadow_maps };
        let surfaces = self.layer.surfaces(rec, pass, &own)?;
        let edges = if group.have_lines() { Some(self.layer.edges(rec, &own, &surfaces)?) } else { None };
        let hidden = self.layer.hidden_lines(rec, pass, &own, &sketch.hidden, edges.as_ref())?;
        let shaded = self.shade(rec, techniques, inputs, &surfaces)?;
        let (field_objects, objects) = sketch.objects(&seen);
        let [line_band, fill_band] = uniforms::bands(&sketch.style, sketch.scale);
        let near_lines = self.near_lines(rec, sketch, edges.as_ref(), line_band)?;
        let reach = match (&near_lines, have_widths(&group.edge_styles)) {
            (Some(near), false) => Some(Reach::Wide { farthest: near.value.clone(), nearest: None }),
            (Some(near), true) => {
                let reach = self.layer.reach(rec, group, edges.as_ref())?;
                match reach.map(|reach| reach.value) {
                    Some(Reach::Wide { farthest, .. }) => {
                        Some(Reach::Wide { farthest, nearest: Some(near.value.clone()) })
                    }
                    other => other,
                }
            }
            (None, _) => None,
        };
        let geometry = &surfaces.gbuffer;
        // Lines of the papers' operators follow surfaces too.
        let band = line_band.max(fill_band);
        let enlarged = self.enlarge(rec, pass, inputs, &surfaces)?;
        let followed = enlarged.as_ref().unwrap_or(geometry);
        let nearest = self.nearest_surfaces.run((followed.revision, band as u32), |_| {
            nearest_surfaces(rec, &followed.value.geometry, band)
        })?;
        let field = sketch.field();
        let key = |of| FieldKey {
            of,
            field,
            objects: field_objects.clone(),
            uniform: uniform.without_background(),
        };
        self.field.write(rec.gpu, &field);
        self.field_objects.write(rec.gpu, &field_objects);
        let buffers = FieldBuffers { field: self.field.buffer(), objects: self.field_objects.buffer() };
        let line_field = match &edges {
            Some(Output { value: EdgeMap { edges, spines: Some(spines), .. }, revision })
                if !sketch.is_on_screen() =>
            {
                let pass = &mut self.line_field_pass;
                let drawn = match (&enlarged, &near_lines) {
                    (Some(_), Some(near)) => (None, &near.value),
                    _ => (Some(edges), spines),
                };
                Some(self.line_field.run(key([*revision, followed.revision]), |_| {
                    pass.run(rec, buffers, &followed.value, drawn, field.passes)
                })?)
            }
            _ => {
                self.line_field.clear();
                None
            }
        };
        rec.note("noise of lines", line_field.as_ref().map(|field| &field.value.first));
        let fill_field = self.fill_field.run(key([nearest.revision, followed.revision]), |_| {
            fill_field(rec, buffers, &followed.value.geometry, &nearest.value)
        })?;
        let fetched = Fetched {
            surfaces: &surfaces,
            color: shaded,
            edges,
            reach,
            near_lines,
            hidden,
            line_field,
            fill_field,
        };
        let noise = sketch.is_on_screen().then_some(&sketch.style.wander);
        let paper = sketch.has_paper().then_some(&sketch.paper);
        let images = shared.images.prepare(rec.gpu, noise, paper)?;
        let key = PlaceKey {
            shaders: rec.pipelines.generation(),
            color: fetched.color.revision,
            geometry: geometry.revision,
            edges: fetched.edges.as_ref().map(|edges| edges.revision),
            near_lines: fetched.near_lines.as_ref().map(|near| near.revision),
            hidden: fetched.hidden.as_ref().map(|hidden| hidden.revision),
            fields: [
                fetched.line_field.as_ref().map(|field| field.revision),
                Some(fetched.fill_field.revision),
            ],
            before: [
                Some(composition.surfaces.revision),
                composition.ink.as_ref().map(|ink| ink.revision),
                Some(color.revision),
            ],
            sketch: SketchUniform::new(&sketch.style, sketch.scale),
            objects,
            styles: group.edge_styles.clone(),
            uniform: uniform.without_background(),
            images: images.revision,
            style: sketch.style.clone(),
        };
        let Self { layer, uniform, objects, placed, .. } = self;
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
            let drawing = Placing { sketch, layer, fetched: &fetched, composition, before: &color.value };
            drawing.place(rec, own)
        })?;
        let Output { value: Placed { geometry, color, ink }, revision } = placed;
        let ink = ink.map(|value| Output { value, revision });
        composition.place_opaque(Output { value: geometry, revision }, ink);
        Ok(Output { value: color, revision })
    }

    /// The surfaces enlarged along their normals, where the noise beyond outlines follows them.
    fn enlarge(
        &mut self,
        rec: &mut Recorder<'_>,
        pass: &mut GBufferPass,
        inputs: &SketchInputs<'_>,
        surfaces: &Surfaces,
    ) -> Result<Option<Output<GBuffer>>, RenderError> {
        let SketchInputs { seen, sketch, uniform, .. } = *inputs;
        if !sketch.is_enlarged() {
            self.enlarged.clear();
            return Ok(None);
        }
        let [lines, fill] = uniforms::bands(&sketch.style, sketch.scale);
        // No less than the largest offset, or there were none for it.
        let px = uniforms::enlarged(&sketch.style, sketch.scale).max(lines).max(fill);
        let Self { layer, enlarged, instances, .. } = self;
        let key = (surfaces.gbuffer.revision, px);
        let drawn = enlarged.run(key, |_| {
            let layer = layer.shaded(surfaces, seen, uniform);
            let draws: Vec<_> = layer.draws.iter().map(|draw| Instance { enlarged: px, ..*draw }).collect();
            pass.run_enlarged(rec, seen.scene, instances, (&draws, layer.calls), seen.view.has_cuts())
        })?;
        Ok(Some(drawn))
    }

    fn shade(
        &mut self,
        rec: &mut Recorder<'_>,
        techniques: &mut SharedTechniques,
        inputs: &SketchInputs<'_>,
        surfaces: &Surfaces,
    ) -> Result<Output<Target>, RenderError> {
        let SketchInputs { seen, sketch, uniform, look, .. } = *inputs;
        self.shading.upload(techniques, rec.gpu, look)?;
        let key = ShadeKey {
            gbuffer: surfaces.gbuffer.revision,
            shadows: surfaces.shadow_mask.as_ref().map(|mask| mask.revision),
            look: look.clone(),
            uniform: uniform.without_background(),
            blends: sketch.blends,
        };
        let Self { layer, shading, color, .. } = self;
        color.run(key, |key| {
            let layer = layer.shaded(surfaces, seen, &key.uniform);
            shading.shade(rec, techniques, &key.look, &layer, sketch.blends)
        })
    }

    /// The line next to each pixel, from as far as offsets go.
    fn near_lines(
        &mut self,
        rec: &mut Recorder<'_>,
        sketch: &Sketch,
        edges: Option<&Output<EdgeMap>>,
        band: f32,
    ) -> Result<Option<Output<Target>>, RenderError> {
        let spines = edges.and_then(|edges| Some((edges.revision, edges.value.spines.as_ref()?)));
        let Some((revision, spines)) = spines else {
            self.near_lines.clear();
            return Ok(None);
        };
        let distance = band + (sketch.group.greatest_radius() * sketch.widest()).ceil();
        let radius = &mut self.near_radius;
        let near = self
            .near_lines
            .run((revision, distance as u32), |_| nearest_lines(rec, spines, distance, radius))?;
        Ok(Some(near))
    }
}

/// A sketch while it is being placed.
struct Placing<'a> {
    sketch: &'a Sketch,
    layer: &'a OpaqueLayer,
    fetched: &'a Fetched<'a>,
    composition: &'a Composition,
    before: &'a Target,
}

impl Placing<'_> {
    fn place(&self, rec: &mut Recorder<'_>, own: Inputs<'_>) -> Result<Placed, RenderError> {
        let Self { sketch, layer, fetched, composition, before } = *self;
        let group = &sketch.group;
        let style = &sketch.style;
        let near_lines = fetched.near_lines.as_ref().map(|near| &near.value);
        let line_field = fetched.line_field.as_ref().map(|field| &field.value);
        let no_edges = fetched.edges.is_none();
        let lines = fetched
            .edges
            .as_ref()
            .map(|edges| layer.lines(group, fetched.surfaces, edges, fetched.reach.as_ref()));
        let mut inputs = own.and(&composition.tested()).and(&inputs! {
            geometry_tex: &fetched.surfaces.gbuffer.value.geometry,
            shaded_tex: &fetched.color.value,
            hidden_tex: fetched.hidden.as_ref().map(|hidden| &hidden.value),
            near_line_tex: near_lines,
            line_field_tex: line_field.map(|field| &field.first),
            more_line_field_tex: line_field.and_then(|field| field.more.as_ref()),
            fill_field_tex: &fetched.fill_field.value,
            before_tex: before,
        });
        if let Some(lines) = &lines {
            inputs.extend(&lines.inputs());
        }
        let mut switches = vec![
            ("ON_SCREEN", sketch.is_on_screen()),
            ("BY_PIXEL", sketch.is_enlarged()),
            ("WITH_NEARER", style.wander.depth == StyleDepth::Nearer),
            ("WITH_MORE_PASSES", line_field.is_some_and(|field| field.more.is_some())),
            ("WITH_GRAIN", style.grain.amount > 0.0),
            ("WITH_ROUGHNESS", style.grain.roughness > 0.0),
            ("WITH_STROKES", style.fill.strokes > 0.0),
            ("WITH_PRESSURE", style.wander.pressure > 0.0),
            ("WITH_DARKNESS", style.fill.tone == Tone::Darkness),
            ("WITH_SMUDGE", style.grain.smudge > 0.0 && near_lines.is_some()),
            ("WITH_OPACITY", sketch.blends),
            ("WITH_HIDDEN", fetched.hidden.is_some()),
            ("WITH_NEAREST", near_lines.is_some()),
        ];
        switches.extend(composition.switches());
        switches.extend(lines.as_ref().map(Lines::switches).unwrap_or_default());
        let [geometry, color] = [&composition.surfaces.value, before].map(|target| target.format());
        let geometry = rec.target("geometry with sketch", geometry)?;
        let color = rec.target("color with sketch", color)?;
        let onto = if composition.has_surfaces {
            rec.copy(&composition.surfaces.value, &geometry);
            rec.copy(before, &color);
            Onto::Old
        } else {
            Onto::Nothing
        };
        let program = |entry_point, switches: &[(&'static str, bool)]| Program {
            file: "effects/sketch.wgsl",
            entry_point,
            switches: switches.to_vec(),
        };
        let depth = wgpu::TextureFormat::Depth32Float;
        let filled = rec.target("reached by color", depth)?;
        rec.draw(Draw {
            label: "sketched color",
            program: program("fs_fill", &switches),
            inputs: &inputs,
            outputs: &[&geometry, &color],
            onto,
            depth: Some((&filled, DepthRule::Marked("fs_filled"))),
        })?;
        if no_edges && composition.ink.is_none() {
            return Ok(Placed { geometry, color, ink: None });
        }
        if no_edges {
            // What is new hides ink that is there.
            switches.extend([("WITH_PAPER", false), ("WITH_EXACT", false)]);
        }
        inputs.set("filled_tex", &geometry);
        let ink = rec.target("ink with sketch", PLACED)?;
        let inked = rec.target("reached by ink", depth)?;
        rec.draw(Draw {
            label: "sketched ink",
            program: program("fs_ink", &switches),
            inputs: &inputs,
            outputs: &[&ink],
            onto: Onto::Nothing,
            depth: Some((&inked, DepthRule::Marked("fs_inked"))),
        })?;
        Ok(Placed { geometry, color, ink: Some(ink) })
    }
}
