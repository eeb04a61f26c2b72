//! The lines that topology knows, where they are visible: each pixel of each segment is tested against a G-buffer, and what is
//! left is drawn into the edge map. Software devices run a shader for whole blocks of pixels, of which a line has few: this
//! is why lines are not drawn as such.

use super::gbuffer::GBuffer;
use crate::geometry::LineSegment;
use crate::gpu::recorder::{Draw, Input, Onto};
use crate::gpu::{DepthRule, Gpu, GpuError, Program, RecordBuffer, Recorder, Target};
use crate::render::RenderError;

/// Pixels of segments that are tested in one go; each takes 32 bytes while it is.
const MOST_STEPS: usize = 1 << 20;
/// Bytes of `SegmentPoint` in `shaders/common/segment_point.wgsl`.
const POINT_BYTES: u64 = 32;
/// Steps per workgroup, as in `passes/segments.wgsl`.
const GROUP: u32 = 64;

/// Segments on the device, ready to be drawn into the edge maps of several G-buffers.
pub struct Segments {
    records: RecordBuffer,
    /// Pixels of segments and how many there are, at most [`MOST_STEPS`] each.
    steps: Vec<(RecordBuffer, u32)>,
    points: RecordBuffer,
}

/// What they are tested against.
#[derive(Clone, Copy)]
pub struct SegmentInputs<'a> {
    /// Per-pixel geometry.
    pub gbuffer: &'a GBuffer,
    /// Edge styles by object id.
    pub edge_styles: &'a wgpu::Buffer,
    /// Switches of `passes/segments.wgsl`.
    pub switches: &'a [(&'static str, bool)],
}

impl Segments {
    /// None yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            records: RecordBuffer::new(gpu, "segments"),
            steps: Vec::new(),
            points: RecordBuffer::new(gpu, "points of segments"),
        }
    }

    /// Uploads those of a view, in place of the last ones.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn write(&mut self, gpu: &Gpu, segments: &[LineSegment]) -> Result<(), GpuError> {
        self.records.write(gpu, segments)?;
        let steps: Vec<[u32; 2]> = (0..)
            .zip(segments)
            .flat_map(|(number, segment)| (0..steps_of(segment)).map(move |step| [number, step]))
            .collect();
        let chunks = steps.len().div_ceil(MOST_STEPS);
        self.steps.resize_with(chunks, || (RecordBuffer::new(gpu, "steps of segments"), 0));
        for ((buffer, count), chunk) in self.steps.iter_mut().zip(steps.chunks(MOST_STEPS)) {
            buffer.write(gpu, chunk)?;
            *count = chunk.len() as u32;
        }
        let most = steps.len().min(MOST_STEPS) as u64;
        self.points.reserve(gpu, most.next_multiple_of(u64::from(GROUP)) * POINT_BYTES)
    }

    /// Draws them into an edge map, with spines and marks; `order` is room for the depth test.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn draw(
        &self,
        rec: &mut Recorder<'_>,
        inputs: &SegmentInputs<'_>,
        outputs: &[&Target; 3],
        order: &Target,
    ) -> Result<(), RenderError> {
        let none = [(&self.points, 0)];
        let chunks = self.steps.iter().map(|(steps, count)| (steps, *count));
        // Without any the outputs are cleared all the same.
        let none = none.into_iter().filter(|_| self.steps.is_empty());
        for (number, (steps, count)) in chunks.chain(none).enumerate() {
            let (onto, rule) = match number {
                0 => (Onto::Nothing, DepthRule::Nearest),
                _ => (Onto::Old, DepthRule::Nearer),
            };
            if count > 0 {
                rec.compute(
                    "segments",
                    Program {
                        file: "passes/segments.wgsl",
                        entry_point: "cs_main",
                        switches: inputs.switches.to_vec(),
                    },
                    &[
                        Input::Texture(&inputs.gbuffer.geometry),
                        Input::Texture(&inputs.gbuffer.region),
                        Input::Storage(inputs.edge_styles),
                        Input::Storage(self.records.buffer()),
                        Input::Storage(steps.buffer()),
                        Input::Written(self.points.buffer()),
                    ],
                    [count.div_ceil(GROUP), 1],
                )?;
            }
            rec.draw(Draw {
                label: "points of segments",
                program: Program::new("passes/segment_points.wgsl", "fs_main"),
                inputs: &[Input::Storage(self.points.buffer())],
                outputs,
                onto,
                depth: Some((order, rule)),
                points: Some(count),
            })?;
        }
        Ok(())
    }
}

/// At most so many pixels has a segment that is half a pixel longer on both sides; see `place_of` in
/// `passes/segments.wgsl`.
fn steps_of(segment: &LineSegment) -> u32 {
    let [[x0, y0], [x1, y1]] = segment.ends;
    let along = (x1 - x0).abs().max((y1 - y0).abs());
    // A hair more, as both round.
    (along + 1.001).ceil() as u32
}
