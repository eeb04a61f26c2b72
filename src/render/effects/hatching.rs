//! Hatching: tones by strokes of a pen that follow the form (Bu et al., "Image-based Real-time Hatching of Scene Traveling", 2006).
//!
//! ```text
//! mesh ─► directions ─► stripes (once, in the background) ──┐
//! layer ─► triangle of each pixel ──────────────────────────┼─► strokes of up to three directions ─► color
//! layer, lights, shadows ─► tone ─► ink of each direction ──┘
//! ```

mod calibration;
mod indication;
mod ranks;
mod requests;
mod sets;
mod smoothstep;
mod strokes;

use std::sync::{Arc, Mutex, PoisonError};

use encase::ShaderType;
use glam::{DMat4, DVec2, Mat4, Vec2, Vec3, Vec4};

use self::calibration::Calibration;
pub use self::indication::GpuIndication;
pub use self::requests::{missing, missing_strokes, stroke_image_fault};
use self::requests::{recipe_of, request_of};
use self::sets::{OwnMap, StrokeSets, TILE, built_in};
pub use self::strokes::GpuStroke;
use super::technique::{Shaded, Styled, SurfaceTechnique};
use crate::gpu::{ArrayBuffer, Gpu, Inputs, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::gpu_scene::{GpuScene, Origin};
use crate::render::base::ids::node_of;
use crate::render::base::instances::DrawCall;
use crate::render::base::stage::Stage;
use crate::render::base::stripes::StripePlace;
use crate::render::base::view::View;
use crate::render::passes::coordinates::{Coordinates, CoordinatesPass};
use crate::render::passes::line_distance::nearest_lines;
use crate::style::hatching::{Direction, Hatching, Mapping, Set};
use crate::style::{Curve, Technique};

/// Twin of `HatchingStyle` in `shaders/effects/hatching/style.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuHatchingStyle {
    local_from_view: Mat4,
    ink: Vec3,
    ink_tint: f32,
    paper: Vec3,
    paper_tint: f32,
    stroke: GpuStroke,
    second: f32,
    third: f32,
    greatest: f32,
    directions: u32,
    shadows_cross: u32,
    ambient: f32,
    object_tone: f32,
    white: f32,
    darkest: f32,
    mapping: u32,
    frequency: f32,
    first_triangle: u32,
    grid_step: f32,
    grid_origin: Vec3,
    tile: f32,
    strokes: u32,
    strokes_in_shadow: u32,
    turn_in_shadow: f32,
    shadows_differ: u32,
    turn_step: f32,
    blends_steps: u32,
    blends_tones: u32,
    towards_light: u32,
    indication: GpuIndication,
    shows_detail: u32,
    tile_offset: Vec2,
    curve: [Vec4; 9],
}

// As in `shaders/effects/hatching/style.wgsl`.
const STRIPES: u32 = 1;
const IN_IMAGE_SPACE: u32 = 2;
const BY_UV: u32 = 3;
/// Spacing at which a texel of a tonal art map is as large as a reference pixel, reference pixels.
const SPACING_OF_TEXELS: f32 = 6.0;
/// The greatest share of ink that a direction of strokes on tiles has.
const GREATEST_OF_TILES: f32 = 0.76;
/// Samples of a tone curve.
const CURVE: usize = 33;
/// A surface, and what each direction of strokes draws on it: see `shaders/effects/hatching/inks.wgsl`.
const INKS: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;

/// Strokes of one kind, with what they need to be as dark as asked.
#[derive(Debug, Clone, PartialEq)]
struct Table {
    stroke: GpuStroke,
    calibration: Calibration,
}

/// Tables that have been made, so that a frame only makes those of strokes that are new.
static TABLES: Mutex<Vec<Table>> = Mutex::new(Vec::new());
const MAX_TABLES: usize = 32;

fn table_of(stroke: &GpuStroke) -> Table {
    let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = tables.iter().find(|table| table.stroke == *stroke) {
        return known.clone();
    }
    let table = Table { stroke: *stroke, calibration: Calibration::of(stroke) };
    if tables.len() >= MAX_TABLES {
        tables.clear();
    }
    tables.push(table.clone());
    table
}

/// All visible objects that are hatched.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hatchings {
    /// By object id; empty when there are none.
    styles: Vec<GpuHatchingStyle>,
    tables: Vec<Table>,
    /// Maps of strokes that styles describe; their numbers follow those of the built-in ones.
    own: Vec<OwnMap>,
    /// Whether there may be caps of sections, which have no stripes.
    has_caps: bool,
}

impl Hatchings {
    fn set(&mut self, object: &Styled<'_>) {
        let style = &object.style.hatching;
        let request = request_of(object.scene, object.node, style, object.stripes);
        let place = request.and_then(|request| object.scene.stripe_place(&request));
        let stroke = GpuStroke::new(&style.stroke, object.scale, object.is_single);
        let known = self.tables.iter().position(|table| table.stroke == stroke);
        let table = known.unwrap_or_else(|| {
            self.tables.push(table_of(&stroke));
            self.tables.len() - 1
        });
        let greatest = self.tables.get(table).map_or(1.0, |table| table.calibration.greatest);
        let stroke = GpuStroke { table: table as u32, ..stroke };
        let mapping = match style.mapping {
            Mapping::Uv if object.scene.has_uvs(object.node) => BY_UV,
            Mapping::Stripes | Mapping::Uv if place.is_some() => STRIPES,
            // Until stripes are found.
            Mapping::Stripes | Mapping::Uv | Mapping::ImageSpace => IN_IMAGE_SPACE,
        };
        let uniform = GpuHatchingStyle {
            tile_offset: if style.cross_objects { Vec2::ZERO } else { tile_offset(object.node) },
            strokes: self.number_of(style, style.set, object),
            strokes_in_shadow: self.number_of(style, style.shadows.set, object),
            ..uniform(style, mapping, stroke, greatest, object.scale, place)
        };
        if let Some(slot) = object.entry(&mut self.styles) {
            *slot = uniform;
        }
        self.has_caps |= object.scene.section.is_some();
    }

    /// The number of a set of strokes; until those of a style have been drawn, a pen's.
    fn number_of(&mut self, style: &Hatching, set: Set, object: &Styled<'_>) -> u32 {
        if !matches!(set, Set::Own | Set::Painted) {
            return set as u32;
        }
        let recipe = recipe_of(style, set, object.images);
        let Some(map) = recipe.and_then(|recipe| object.strokes.map(&recipe)) else { return Set::Pen as u32 };
        let map = OwnMap(Arc::clone(map));
        let known = self.own.iter().position(|own| *own == map).unwrap_or_else(|| {
            self.own.push(map);
            self.own.len() - 1
        });
        (built_in() + known) as u32
    }

    /// Whether strokes of any lie so.
    fn are_mapped(&self, mapping: u32) -> bool {
        self.styles.iter().any(|style| style.mapping == mapping)
    }

    /// Whether any has fewer strokes away from details.
    fn have_indication(&self) -> bool {
        self.styles.iter().any(|style| style.indication.amount > 0.0)
    }

    /// Whether the detail that any gets is drawn instead of it.
    fn show_detail(&self) -> bool {
        self.styles.iter().any(|style| style.shows_detail == 1)
    }

    /// How far from edges strokes become fewer, px; 0: they do not.
    fn indication_reach(&self) -> f32 {
        self.styles.iter().map(|style| style.indication.reach()).fold(0.0, f32::max)
    }

    /// What has to be known of the surface of an object (by id, with or without flag).
    fn needs(&self, object: u32) -> Option<Coordinates> {
        let style = node_of(object).and_then(|node| self.styles.get(node + 1))?;
        match style.mapping {
            BY_UV => Some(Coordinates::Texture),
            0 => None,
            _ => (style.frequency > 0.0).then_some(Coordinates::Triangles),
        }
    }
}

fn uniform(
    style: &Hatching,
    mapping: u32,
    stroke: GpuStroke,
    greatest: f32,
    scale: f32,
    place: Option<StripePlace>,
) -> GpuHatchingStyle {
    let (crossing, tone) = (&style.cross_hatching, &style.tone);
    let second = crossing.second;
    GpuHatchingStyle {
        // Depends on the camera: see `placed`.
        local_from_view: Mat4::IDENTITY,
        ink: style.ink.to_linear(),
        ink_tint: style.ink_tint,
        paper: style.paper.to_linear(),
        paper_tint: style.paper_tint,
        stroke,
        second,
        third: crossing.third.max(second),
        greatest: if mapping == STRIPES { greatest } else { GREATEST_OF_TILES },
        directions: crossing.directions,
        shadows_cross: u32::from(crossing.shadows_cross),
        ambient: tone.ambient,
        object_tone: tone.object_tone,
        white: tone.lightest,
        darkest: tone.darkest,
        mapping,
        frequency: place.map_or(0.0, |place| place.cycles_per_unit),
        first_triangle: place.map_or(0, |place| place.first_triangle),
        grid_step: place.map_or(1.0, |place| place.grid.step),
        grid_origin: place.map_or(Vec3::ZERO, |place| place.grid.origin),
        // Closer than this there would be nothing but gray.
        tile: (TILE as f32 * stroke.spacing / SPACING_OF_TEXELS).max(32.0),
        // Depend on what has been drawn.
        strokes: 0,
        strokes_in_shadow: 0,
        turn_in_shadow: style.shadows.turn.to_radians(),
        shadows_differ: u32::from(style.shadows.differ && mapping != STRIPES),
        turn_step: style.turn_step.to_radians(),
        blends_steps: u32::from(style.blend_steps),
        blends_tones: u32::from(style.blend_tones && stroke.crispness == 0.0),
        towards_light: u32::from(style.direction == Direction::Light),
        indication: GpuIndication::new(&style.indication, scale),
        shows_detail: u32::from(style.shows_detail),
        // Depends on the object.
        tile_offset: Vec2::ZERO,
        curve: samples(&tone.curve),
    }
}

/// Where the strokes of an object lie that do not go on in others, in tiles: those of any two are far apart (Roberts 2018, "The
/// Unreasonable Effectiveness of Quasirandom Sequences").
fn tile_offset(node: usize) -> Vec2 {
    (node as f64 * DVec2::new(0.754_877_666, 0.569_840_291)).fract().as_vec2()
}

/// A tone curve as the shader reads it.
fn samples(curve: &Curve) -> [Vec4; 9] {
    let table = curve.table(CURVE);
    let sample = |number: usize| table.get(number).copied().unwrap_or(0.0);
    std::array::from_fn(|row| Vec4::from_array(std::array::from_fn(|column| sample(4 * row + column))))
}

/// From view space to local space of an object's mesh.
fn local_from_view(scene: &GpuScene, id: usize, view: &View) -> Option<Mat4> {
    let node = scene.scene.nodes.get(node_of(id as u32)?)?;
    let local: DMat4 = (view.view_from_world * node.world_from_local).inverse();
    local.is_finite().then(|| local.as_mat4())
}

/// What hatching of all cameras shares.
pub struct SharedHatching {
    sets: StrokeSets,
    triangles: CoordinatesPass,
    coordinates: CoordinatesPass,
}

/// What is known of stripes, on the device.
struct StripeRecords {
    triangles: Target,
    vertices: Target,
    flat_parts: Target,
}

/// Hatching on the device.
pub struct HatchingShading {
    styles: ArrayBuffer,
    tones: ArrayBuffer,
    stage: Stage<(u64, Vec<DrawCall>), Target>,
    /// The triangles of the layer that is shaded, and the records of all; `None` where nobody asks.
    triangle_map: Option<Target>,
    records: Option<StripeRecords>,
    /// What strokes draw on that layer; `None` where nothing is hatched.
    inks: Option<Target>,
    /// The nearest edge of each pixel of that layer, for indication.
    nearest_edges: Option<Target>,
    edges: Stage<(u64, u32), Target>,
    greatest_radius: ArrayBuffer,
}

impl HatchingShading {
    /// What finding inks and drawing strokes both read.
    fn bind_both<'a>(&'a self, inputs: &mut Inputs<'a>) {
        inputs.set("hatching_styles", &self.styles);
        inputs.set("triangle_map_tex", self.triangle_map.as_ref());
        inputs.set("stripe_triangles", self.records.as_ref().map(|records| &records.triangles));
    }

    fn draw_inks(
        &self,
        rec: &mut Recorder<'_>,
        hatchings: &Hatchings,
        layer: &Shaded<'_>,
    ) -> Result<Target, RenderError> {
        let Shaded { gbuffer, shadow_mask, .. } = layer;
        let mut inputs = inputs! {
            geometry_tex: &gbuffer.geometry,
            surface_id_tex: &gbuffer.surface_id,
            base_color_tex: &gbuffer.base_color,
            shadow_mask_tex: shadow_mask.map(|(mask, _)| mask),
            nearest_edge_tex: self.nearest_edges.as_ref(),
            flat_parts: self.records.as_ref().map(|records| &records.flat_parts),
        };
        self.bind_both(&mut inputs);
        let switches = vec![
            ("WITH_SHADOWS", shadow_mask.is_some()),
            ("WITH_INDICATION", hatchings.have_indication()),
            ("SHOWS_DETAIL", hatchings.show_detail()),
        ];
        let program = Program { file: "effects/hatching/inks.wgsl", entry_point: "fs_main", switches };
        let inks = rec.target("inks", INKS)?;
        rec.fullscreen("inks", program, &inputs, &[&inks], Some(&gbuffer.depth))?;
        Ok(inks)
    }
}

impl SurfaceTechnique for HatchingShading {
    const TECHNIQUE: Technique = Technique::Hatching;

    type Styles = Hatchings;
    type Shared = SharedHatching;

    fn shared(gpu: &Gpu) -> SharedHatching {
        SharedHatching {
            sets: StrokeSets::new(gpu),
            triangles: CoordinatesPass::new(Coordinates::Triangles),
            coordinates: CoordinatesPass::new(Coordinates::Texture),
        }
    }

    fn new(gpu: &Gpu) -> Self {
        Self {
            styles: ArrayBuffer::new(gpu, "hatching styles"),
            tones: ArrayBuffer::new(gpu, "tones of stripes"),
            stage: Stage::default(),
            triangle_map: None,
            records: None,
            inks: None,
            nearest_edges: None,
            edges: Stage::default(),
            greatest_radius: ArrayBuffer::new(gpu, "distance of edges"),
        }
    }

    fn add(styles: &mut Hatchings, object: &Styled<'_>) {
        if object.style.technique == Technique::Hatching {
            styles.set(object);
        }
    }

    fn placed(styles: &Hatchings, scene: &GpuScene, view: &View) -> Hatchings {
        let placed = |(id, style): (usize, &GpuHatchingStyle)| {
            let place = (style.frequency > 0.0).then(|| local_from_view(scene, id, view)).flatten();
            GpuHatchingStyle { local_from_view: place.unwrap_or(Mat4::IDENTITY), ..*style }
        };
        Hatchings { styles: styles.styles.iter().enumerate().map(placed).collect(), ..styles.clone() }
    }

    fn switches(hatchings: &Hatchings) -> Vec<(&'static str, bool)> {
        let any = |directions| hatchings.styles.iter().any(|s| s.directions >= directions);
        let blends = |tones| hatchings.styles.iter().any(|s| s.mapping != 0 && s.blends_tones == tones);
        vec![
            ("WITH_HATCHING", !hatchings.styles.is_empty()),
            ("WITH_STRIPES", hatchings.are_mapped(STRIPES)),
            // Caps of sections too.
            ("WITH_IMAGE_SPACE_STROKES", hatchings.are_mapped(IN_IMAGE_SPACE) || hatchings.has_caps),
            ("WITH_BLENDED_TONES", blends(1)),
            ("WITH_STROKES_ONE_BY_ONE", blends(0)),
            ("WITH_STROKES_BY_UV", hatchings.are_mapped(BY_UV)),
            ("SHOWS_DETAIL", hatchings.show_detail()),
            ("WITH_SECOND", any(2)),
            ("WITH_THIRD", any(3)),
        ]
    }

    fn reads_lines(hatchings: &Hatchings) -> bool {
        hatchings.indication_reach() > 0.0
    }

    fn upload(
        &mut self,
        shared: &mut SharedHatching,
        gpu: &Gpu,
        hatchings: &Hatchings,
    ) -> Result<(), RenderError> {
        if !hatchings.styles.is_empty() {
            shared.sets.prepare(gpu, &hatchings.own)?;
            self.styles.write(gpu, &hatchings.styles);
            let tones: Vec<f32> =
                hatchings.tables.iter().flat_map(|table| &table.calibration.tones).copied().collect();
            self.tones.write(gpu, &tones);
        }
        Ok(())
    }

    fn begin(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut SharedHatching,
        hatchings: &Hatchings,
        layer: &Shaded<'_>,
    ) -> Result<(), RenderError> {
        let needs = |call: &DrawCall| {
            let object = layer.instances.get(call.instance as usize).map(|instance| instance.object)?;
            hatchings.needs(object).filter(|_| call.origin != Origin::Caps)
        };
        let calls: Vec<DrawCall> = layer.calls.iter().filter(|call| needs(call).is_some()).copied().collect();
        let (scene, has_any) = (layer.scene_view.scene, !calls.is_empty());
        let SharedHatching { triangles, coordinates, .. } = shared;
        let mut draw = |calls: &[DrawCall]| {
            let (on_triangles, by_uv): (Vec<_>, Vec<_>) =
                calls.iter().partition(|call| needs(call) == Some(Coordinates::Triangles));
            let (gbuffer, instance_buffer) = (layer.gbuffer, layer.instance_buffer);
            let drawn = triangles.run(rec, scene, gbuffer, instance_buffer, &on_triangles, None)?;
            if by_uv.is_empty() {
                return Ok(drawn);
            }
            coordinates.run(rec, scene, gbuffer, instance_buffer, &by_uv, Some(&drawn))
        };
        self.triangle_map = match layer.revision {
            Some(revision) if has_any => {
                Some(self.stage.run((revision, calls), |(_, calls)| draw(calls))?.value)
            }
            None if has_any => Some(draw(&calls)?),
            _ => None,
        };
        self.nearest_edges = match layer.spines {
            Some((spines, revision)) => {
                let (reach, radius) = (hatchings.indication_reach().ceil(), &mut self.greatest_radius);
                let key = (revision, reach as u32);
                Some(self.edges.run(key, |_| nearest_lines(rec, spines, reach, radius))?.value)
            }
            None => None,
        };
        self.records = scene.stripes().map(|stripes| StripeRecords {
            triangles: stripes.triangles().clone(),
            vertices: stripes.vertices().clone(),
            flat_parts: stripes.patches().clone(),
        });
        if layer.revision.is_some() {
            rec.note("triangles", self.triangle_map.as_ref());
        }
        let is_asked = !hatchings.styles.is_empty();
        self.inks = if is_asked { Some(self.draw_inks(rec, hatchings, layer)?) } else { None };
        Ok(())
    }

    fn bind<'a>(&'a self, shared: &'a SharedHatching, inputs: &mut Inputs<'a>) {
        inputs.set("light_tones", shared.sets.tones.view());
        inputs.set("stroke_priorities", shared.sets.priorities.view());
        inputs.set("tile_of_strokes", &shared.sets.sampler);
        self.bind_both(inputs);
        inputs.set("stripe_tones", &self.tones);
        inputs.set("stripe_vertices", self.records.as_ref().map(|records| &records.vertices));
        inputs.set("inks_tex", self.inks.as_ref());
    }
}
