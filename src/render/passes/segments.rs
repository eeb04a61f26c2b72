//! The lines that topology knows, where they are visible: each pixel of each segment is tested against a G-buffer, and what is
//! left is put into the edge map.
//!
//! ```text
//! runs of steps (─► places, for layers) ─► cull ─► points ─► compare ─► put ─► edge map, spines
//!                                                    └─► keys: which of the points of a pixel counts
//! ```

use bytemuck::{Pod, Zeroable};

use super::gbuffer::GBuffer;
use super::repeated::NearerLines;
use crate::geometry::LineSegment;
use crate::geometry::line_segments::SegmentSet;
use crate::gpu::{
    Gpu, Program, RecordBuffer, RecordList, RecordTexture, Recorder, Target, frame_records, inputs,
};
use crate::render::base::edge_styles::EdgeStylesBuffer;
use crate::render::base::error::RenderError;

/// Successive steps along a segment, a pixel each, that are culled by one invocation, as in `passes/segments/steps.wgsl`.
const RUN: u32 = 4;
/// Runs that are tested in one go; each takes 216 bytes while it is.
const MAX_RUNS: usize = 1 << 18;
/// Texels of `SegmentPoint` in `shaders/common/segment_point.wgsl`.
const POINT_TEXELS: u64 = 2;
/// What decides which steps are looked at closely.
const CULL: &str = "passes/segments/cull.wgsl";
/// Runs per workgroup, as in `gpu/record_list.wgsl`.
const GROUP: u32 = 256;

/// What segments have in each pixel, see `shaders/common/segment_point.wgsl`.
pub(super) const MARKS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// Fills the last workgroup, as in `passes/segments/steps.wgsl`.
const NO_RUN: [u32; 2] = [u32::MAX; 2];

/// Segments on the device, ready to be put into the edge maps of several G-buffers.
pub struct Segments {
    records: RecordTexture,
    /// Where each is tested, if that is not where it is drawn.
    tested: RecordTexture,
    has_strokes: bool,
    parts: Vec<Part>,
    for_layers: bool,
    /// The steps that are looked at closely.
    listed_steps: RecordList,
    /// What is found of them.
    points: RecordTexture,
    /// 0 between frames, as winners are: who reads the last of them clears them.
    keys: RecordBuffer,
    winners: RecordBuffer,
}

/// A [`LineSegment`] as shaders read it; twin of `segment_at` in `shaders/passes/segments/segment.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct GpuSegment {
    ends: [[f32; 2]; 2],
    depths: [f32; 2],
    arcs: [f32; 2],
    angle: f32,
    /// Flags of the class, the class, and the object in the lowest [`OBJECT_BITS`].
    class_and_object: u32,
    surfaces: [u32; 2],
}

/// Bits of an object, below those of the class; twin in `shaders/passes/segments/segment.wgsl`. No scene has more objects.
const OBJECT_BITS: u32 = 26;
const FLAGS: u32 = LineSegment::SUPPRESSED | LineSegment::ELSEWHERE;

impl From<&LineSegment> for GpuSegment {
    fn from(segment: &LineSegment) -> Self {
        let LineSegment { ends, depths, arcs, angle, class, object, surfaces } = *segment;
        let class_and_object = class & FLAGS | (class & !FLAGS) << OBJECT_BITS | object;
        Self { ends, depths, arcs, angle, class_and_object, surfaces }
    }
}

/// Runs that are tested in one go.
struct Part {
    /// Number of a segment and of the first step along it.
    runs: RecordTexture,
    /// At most [`MAX_RUNS`].
    count: u32,
    /// Whether all of them are of strokes, which explain nothing where they are drawn.
    of_strokes: bool,
    /// For layers: `place_tex` in `passes/segments/cull.wgsl`.
    places: Option<Target>,
}

impl Part {
    fn new(gpu: &Gpu) -> Self {
        Self { runs: RecordTexture::new(gpu, "runs of steps"), count: 0, of_strokes: false, places: None }
    }
}

/// What they are tested against.
#[derive(Clone, Copy)]
pub struct SegmentInputs<'a> {
    /// Per-pixel geometry.
    pub gbuffer: &'a GBuffer,
    /// The edge styles of its objects.
    pub edge_styles: &'a EdgeStylesBuffer,
    /// Switches of `passes/segments.wgsl`.
    pub switches: &'a [(&'static str, bool)],
}

impl Segments {
    /// None yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            records: RecordTexture::new(gpu, "segments"),
            tested: RecordTexture::new(gpu, "where segments are tested"),
            has_strokes: false,
            parts: Vec::new(),
            for_layers: false,
            listed_steps: RecordList::new(gpu, "listed steps"),
            points: RecordTexture::new(gpu, "points of segments"),
            keys: RecordBuffer::new(gpu, "keys of segments"),
            winners: RecordBuffer::new(gpu, "points of pixels"),
        }
    }

    /// Uploads those of a view, in place of the last ones; `for_layers`: they are put into the edge maps of depth layers,
    /// which may lie behind a segment that belongs to a nearer one; layers have no strokes of a hand.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn write(
        &mut self,
        rec: &mut Recorder<'_>,
        SegmentSet { segments, tested }: &SegmentSet,
        for_layers: bool,
    ) -> Result<(), RenderError> {
        let gpu = rec.gpu;
        self.for_layers = for_layers;
        self.records.write(gpu, &segments.iter().map(GpuSegment::from).collect::<Vec<_>>())?;
        self.has_strokes = !tested.is_empty();
        if self.has_strokes {
            self.tested.write(gpu, tested)?;
        }
        // What explains what is there comes first.
        let is_stroke = |number: u32| tested.get(number as usize).is_some_and(|t| t.is_stroke == 1);
        let runs = [false, true].map(|of_strokes| {
            let mut runs: Vec<[u32; 2]> = Vec::new();
            for (number, segment) in (0..).zip(segments) {
                if is_stroke(number) == of_strokes {
                    runs.extend((0..steps_of(segment)).step_by(RUN as usize).map(|first| [number, first]));
                }
            }
            runs.resize(runs.len().next_multiple_of(GROUP as usize), NO_RUN);
            runs
        });
        let chunks =
            || runs.iter().zip([false, true]).flat_map(|(s, is)| s.chunks(MAX_RUNS).map(move |c| (c, is)));
        self.parts.resize_with(chunks().count(), || Part::new(gpu));
        for (part, (chunk, of_strokes)) in self.parts.iter_mut().zip(chunks()) {
            part.count = chunk.len() as u32;
            part.of_strokes = of_strokes;
            part.runs.write_pairs(gpu, chunk)?;
        }
        let most = chunks().map(|(chunk, _)| chunk.len()).max().unwrap_or(0) as u64 * u64::from(RUN);
        self.listed_steps.reserve(gpu, most * 4)?;
        self.points.reserve(gpu, (most * POINT_TEXELS) as usize)?;
        // Lines of images, as in image-space mode, need none.
        if most > 0 {
            gpu.check_bytes_of_pixels("with lines", rec.size(), 4)?;
            let [width, height] = rec.size().map(u64::from);
            self.keys.reserve(gpu, width * height * 4)?;
            self.winners.reserve(gpu, width * height * 4)?;
        }
        for part in 0..self.parts.len() {
            self.parts[part].places =
                if for_layers { Some(self.place(rec, &self.parts[part])?) } else { None };
        }
        Ok(())
    }

    /// Finds for each of these steps, once for all layers, what they are asked.
    fn place(&self, rec: &mut Recorder<'_>, part: &Part) -> Result<Target, RenderError> {
        let places = frame_records(rec, "places of steps", part.count * RUN)?;
        let inputs = inputs! {
            segment_tex: self.records.target(),
            run_tex: part.runs.target(),
            placed_tex: &places,
        };
        rec.compute(
            "place segments",
            &Program::new(CULL, "cs_place"),
            &inputs,
            [part.count.div_ceil(GROUP), 1],
        )?;
        Ok(places)
    }

    /// Puts them into an edge map, its spines and the marks of segments, over what is there, without those that
    /// lie on lines of `nearer` layers.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn put(
        &self,
        rec: &mut Recorder<'_>,
        inputs: &SegmentInputs<'_>,
        [edge_map, spines, marks]: [&Target; 3],
        nearer: Option<&NearerLines>,
    ) -> Result<(), RenderError> {
        let has_parts = self.parts.len() > 1;
        for part in &self.parts {
            self.find(rec, inputs, part, nearer)?;
            let found = inputs! {
                point_tex: self.points.target(),
                list: self.listed_steps.count(),
                keys: self.keys.buffer(),
                winners: self.winners.buffer(),
                edge_tex: edge_map,
                spine_tex: spines,
                mark_tex: marks,
                nearer_lines_tex: nearer.map(|nearer| &nearer.before),
                accumulated_lines_tex: nearer.map(|nearer| &nearer.now),
            };
            let program = |entry_point| Program {
                file: "passes/segment_points.wgsl",
                entry_point,
                switches: vec![
                    ("WITHOUT_REPEATED", nearer.is_some()),
                    ("KEEP_KEYS", has_parts),
                    ("WITHOUT_MARKS", part.of_strokes),
                ],
            };
            rec.compute("compare points", &program("cs_compare"), &found, self.listed_steps.count())?;
            let put = if nearer.is_some() { "cs_put_unrepeated" } else { "cs_put" };
            rec.compute("put points", &program(put), &found, self.listed_steps.count())?;
        }
        if has_parts {
            rec.encoder.clear_buffer(self.keys.buffer(), 0, None);
        }
        Ok(())
    }

    /// Finds the points of these steps, without those that a nearer layer has in the same pixel.
    fn find(
        &self,
        rec: &mut Recorder<'_>,
        inputs: &SegmentInputs<'_>,
        part: &Part,
        nearer: Option<&NearerLines>,
    ) -> Result<(), RenderError> {
        let own = [("IN_LAYER", self.for_layers), ("WITH_STROKES", self.has_strokes)];
        let tested = inputs! {
            geometry_tex: &inputs.gbuffer.geometry,
            surface_id_tex: &inputs.gbuffer.surface_id,
            segment_tex: self.records.target(),
            tested_tex: self.has_strokes.then(|| self.tested.target()),
            run_tex: part.runs.target(),
        };
        // Where the recorder's predicate is disabled nobody counts any.
        self.listed_steps.empty(rec);
        let culling = inputs! {
            keeping: self.listed_steps.count(),
            keeping_steps: self.listed_steps.buffer(),
            place_tex: part.places.as_ref(),
            nearer_lines_tex: nearer.map(|nearer| &nearer.before),
        };
        let without_repeated = ("WITHOUT_REPEATED", part.places.is_some() && nearer.is_some());
        let cull = Program {
            file: CULL,
            entry_point: if part.places.is_some() { "cs_cull_layer" } else { "cs_cull" },
            switches: own.into_iter().chain([without_repeated]).collect(),
        };
        let groups = [part.count.div_ceil(GROUP), 1];
        rec.compute("cull segments", &cull, &culling.and(&tested), groups)?;
        let found = inputs! {
            list: self.listed_steps.count(),
            listed_steps: self.listed_steps.buffer(),
            point_tex: self.points.target(),
            keys: self.keys.buffer(),
        };
        let points = Program {
            file: "passes/segments.wgsl",
            entry_point: "cs_points",
            switches: inputs.switches.iter().copied().chain(own).collect(),
        };
        let found = found.and(&inputs.edge_styles.inputs());
        rec.compute("segments", &points, &tested.and(&found), self.listed_steps.count())?;
        Ok(())
    }
}

/// At most so many pixels has a segment that is half a pixel longer on both sides; see `place_of` in
/// `passes/segments/steps.wgsl`.
fn steps_of(segment: &LineSegment) -> u32 {
    let [[x0, y0], [x1, y1]] = segment.ends;
    let along = (x1 - x0).abs().max((y1 - y0).abs());
    // A hair more, as both round.
    (along + 1.001).ceil() as u32
}
