//! Hatching: tones by strokes of a pen that follow the form (Bu et al., "Image-based Real-time Hatching of Scene Traveling", 2006).
//!
//! ```text
//! mesh ─► directions ─► stripes (once, beside the window) ──┐
//! layer ─► triangle of each pixel ──────────────────────────┼─► strokes of up to three directions ─► colour
//! layer, lights, shadows ─► tone ─► share of each direction ┘
//! ```

mod calibration;
mod requests;
mod strokes;

use std::sync::{Mutex, PoisonError};

use encase::ShaderType;
use glam::{DMat4, Mat4, Vec3};

use self::calibration::{calibration, greatest_ink};
pub use self::requests::missing;
use self::requests::request_of;
pub use self::strokes::StrokeUniform;
use super::technique::{Shaded, Styled, SurfaceTechnique};
use crate::gpu::{ArrayBuffer, Gpu, Inputs, Recorder, Target};
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::View;
use crate::render::base::gpu_scene::{GpuScene, Origin};
use crate::render::base::ids::node_of;
use crate::render::base::instances::DrawCall;
use crate::render::base::stage::Stage;
use crate::render::base::stripes::StripePlace;
use crate::render::passes::coordinates::{Coordinates, CoordinatesPass};
use crate::style::Technique;
use crate::style::hatching::Hatching;

/// Twin of `HatchingStyle` in `shaders/effects/hatching.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct HatchingUniform {
    local_from_view: Mat4,
    ink: Vec3,
    ink_tint: f32,
    paper: Vec3,
    paper_tint: f32,
    stroke: StrokeUniform,
    second: f32,
    third: f32,
    greatest: f32,
    directions: u32,
    shadows_cross: u32,
    ambient: f32,
    own_color: f32,
    white: f32,
    darkest: f32,
    mapping: u32,
    frequency: f32,
    first_triangle: u32,
}

// As in `shaders/effects/hatching.wgsl`.
const STRIPES: u32 = 1;
/// Samples of a tone curve.
const CURVE: usize = 33;

/// What strokes of one kind need to be as dark as asked.
#[derive(Debug, Clone, PartialEq)]
struct Table {
    stroke: StrokeUniform,
    tones: Vec<f32>,
    greatest: f32,
}

/// Tables that have been made, so that a frame only makes those of strokes that are new.
static TABLES: Mutex<Vec<Table>> = Mutex::new(Vec::new());
const MOST_TABLES: usize = 32;

fn table_of(stroke: &StrokeUniform) -> Table {
    let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = tables.iter().find(|table| table.stroke == *stroke) {
        return known.clone();
    }
    let table = Table { stroke: *stroke, tones: calibration(stroke), greatest: greatest_ink(stroke) };
    if tables.len() >= MOST_TABLES {
        tables.clear();
    }
    tables.push(table.clone());
    table
}

/// All visible objects that are hatched.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hatchings {
    /// By object id; empty when there are none.
    styles: Vec<HatchingUniform>,
    /// Of each object id, [`CURVE`] samples.
    curves: Vec<f32>,
    tables: Vec<Table>,
}

impl Hatchings {
    fn set(&mut self, object: &Styled<'_>) {
        let style = &object.style.hatching;
        let request = request_of(object.scene, object.node, style);
        let place = request.and_then(|request| object.scene.stripe_place(&request));
        let stroke = StrokeUniform::new(&style.stroke, object.scale);
        let known = self.tables.iter().position(|table| table.stroke == stroke);
        let table = known.unwrap_or_else(|| {
            self.tables.push(table_of(&stroke));
            self.tables.len() - 1
        });
        let greatest = self.tables.get(table).map_or(1.0, |table| table.greatest);
        let uniform = uniform(style, StrokeUniform { table: table as u32, ..stroke }, greatest, place);
        if let Some(slot) = object.entry(&mut self.styles) {
            *slot = uniform;
        }
        self.curves.resize(object.count * CURVE, 0.0);
        let first = object.id * CURVE;
        if let Some(slot) = self.curves.get_mut(first..first + CURVE) {
            slot.copy_from_slice(&style.tone.curve.table(CURVE));
        }
    }

    /// Whether an object (by id, with or without flag) lies in stripes.
    fn need_triangles(&self, object: u32) -> bool {
        let style = node_of(object).and_then(|node| self.styles.get(node + 1));
        style.is_some_and(|s| s.frequency > 0.0)
    }
}

fn uniform(
    style: &Hatching,
    stroke: StrokeUniform,
    greatest: f32,
    place: Option<StripePlace>,
) -> HatchingUniform {
    let share = |value: f32| if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) };
    let (layers, tone) = (&style.layers, &style.tone);
    let second = share(layers.second);
    HatchingUniform {
        // Depends on the camera: see `placed`.
        local_from_view: Mat4::IDENTITY,
        ink: style.ink.to_linear(),
        ink_tint: share(style.ink_tint),
        paper: style.paper.to_linear(),
        paper_tint: share(style.paper_tint),
        stroke,
        second,
        third: share(layers.third).max(second),
        greatest,
        directions: layers.count.clamp(1, 3),
        shadows_cross: u32::from(layers.shadows_cross),
        ambient: share(tone.ambient),
        own_color: share(tone.own_color),
        white: share(tone.white),
        darkest: share(tone.darkest),
        mapping: STRIPES,
        frequency: place.map_or(0.0, |place| place.cycles_per_unit),
        first_triangle: place.map_or(0, |place| place.first_triangle),
    }
}

/// From view space to local space of an object's mesh.
fn local_from_view(scene: &GpuScene, id: usize, view: &View) -> Option<Mat4> {
    let node = scene.scene.nodes.get(node_of(id as u32)?)?;
    let local: DMat4 = (view.view_from_world * node.world_from_local).inverse();
    local.is_finite().then(|| local.as_mat4())
}

/// Hatching on the device.
pub struct HatchingShading {
    styles: ArrayBuffer,
    curves: ArrayBuffer,
    tones: ArrayBuffer,
    stage: Stage<(u64, Vec<DrawCall>), Target>,
    /// The triangles of the layer that is shaded, and the records of all; `None` where nobody asks.
    triangle_map: Option<Target>,
    records: Option<[Target; 2]>,
}

impl SurfaceTechnique for HatchingShading {
    type Styles = Hatchings;
    type Shared = CoordinatesPass;

    fn shared(_gpu: &Gpu) -> CoordinatesPass {
        CoordinatesPass::new(Coordinates::Triangles)
    }

    fn new(gpu: &Gpu) -> Self {
        Self {
            styles: ArrayBuffer::new(gpu, "hatching styles"),
            curves: ArrayBuffer::new(gpu, "tone curves"),
            tones: ArrayBuffer::new(gpu, "tones of stripes"),
            stage: Stage::default(),
            triangle_map: None,
            records: None,
        }
    }

    fn add(styles: &mut Hatchings, object: &Styled<'_>) {
        if object.style.technique == Technique::Hatching {
            styles.set(object);
        }
    }

    fn placed(styles: &Hatchings, scene: &GpuScene, view: &View) -> Hatchings {
        let placed = |(id, style): (usize, &HatchingUniform)| {
            let place = (style.frequency > 0.0).then(|| local_from_view(scene, id, view)).flatten();
            HatchingUniform { local_from_view: place.unwrap_or(Mat4::IDENTITY), ..*style }
        };
        Hatchings { styles: styles.styles.iter().enumerate().map(placed).collect(), ..styles.clone() }
    }

    fn switches(hatchings: &Hatchings) -> Vec<(&'static str, bool)> {
        let any = |directions| hatchings.styles.iter().any(|s| s.directions >= directions);
        vec![
            ("WITH_HATCHING", !hatchings.styles.is_empty()),
            ("WITH_STRIPES", !hatchings.styles.is_empty()),
            ("WITH_SECOND", any(2)),
            ("WITH_THIRD", any(3)),
        ]
    }

    fn upload(
        &mut self,
        _shared: &mut CoordinatesPass,
        gpu: &Gpu,
        hatchings: &Hatchings,
    ) -> Result<(), RenderError> {
        if !hatchings.styles.is_empty() {
            self.styles.write(gpu, &hatchings.styles);
            self.curves.write(gpu, &hatchings.curves);
            let tones: Vec<f32> = hatchings.tables.iter().flat_map(|table| &table.tones).copied().collect();
            self.tones.write(gpu, &tones);
        }
        Ok(())
    }

    fn begin(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut CoordinatesPass,
        hatchings: &Hatchings,
        layer: &Shaded<'_>,
    ) -> Result<(), RenderError> {
        let asks = |call: &&DrawCall| {
            let object = layer.draws.get(call.draw as usize).map(|draw| draw.object);
            call.origin == Origin::Model && object.is_some_and(|object| hatchings.need_triangles(object))
        };
        let calls: Vec<DrawCall> = layer.calls.iter().filter(asks).copied().collect();
        let (scene, has_any) = (layer.seen.scene, !calls.is_empty());
        let mut draw = |calls: &[DrawCall]| shared.run(rec, scene, layer.gbuffer, layer.instances, calls);
        self.triangle_map = match layer.revision {
            Some(revision) if has_any => {
                Some(self.stage.run((revision, calls), |(_, calls)| draw(calls))?.value)
            }
            None if has_any => Some(draw(&calls)?),
            _ => None,
        };
        self.records =
            scene.stripes().map(|stripes| [stripes.triangles().clone(), stripes.vertices().clone()]);
        if layer.revision.is_some() {
            rec.note("triangles", self.triangle_map.as_ref());
        }
        Ok(())
    }

    fn bind<'a>(&'a self, _shared: &'a CoordinatesPass, inputs: &mut Inputs<'a>) {
        let [triangles, vertices] = match &self.records {
            Some([triangles, vertices]) => [Some(triangles), Some(vertices)],
            None => [None, None],
        };
        inputs.set("hatching_styles", self.styles.buffer());
        inputs.set("hatching_curves", self.curves.buffer());
        inputs.set("stripe_tones", self.tones.buffer());
        inputs.set("triangle_map_tex", self.triangle_map.as_ref());
        inputs.set("stripe_triangles", triangles);
        inputs.set("stripe_vertices", vertices);
    }
}
