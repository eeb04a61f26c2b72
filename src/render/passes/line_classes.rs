//! The class of lines, decided over stretches: see `shaders/passes/line_classes.wgsl`.
//!
//! ```text
//! spines ─► lines ─► where classes meet ─► settle ─► change ─► edge map, spines
//! ```

use wgpu::util::{BufferInitDescriptor, DeviceExt};

use super::edge_map::EdgeMap;
use crate::gpu::{ArrayBuffer, Gpu, Program, RecordBuffer, Recorder, inputs};
use crate::render::base::edge_style::EdgeUniform;
use crate::render::base::error::RenderError;
use crate::render::base::view::REFERENCE_HEIGHT;

/// No stretch of a line between two of other classes is shorter, reference pixels.
const LEAST: f32 = 8.0;
/// Pixels per side of a workgroup that collects lines, and lines per workgroup, as in `passes/line_classes.wgsl`.
const LINES_GROUP: u32 = 32;
/// Neighbors that decide differently, at the ends of stretches, agree the second time.
const ROUNDS: usize = 2;
/// Bytes of `Change` there.
const CHANGE_BYTES: u64 = 32;
/// Most changes, as a share of all pixels: lines are thin, and few of their pixels change.
const CHANGED: u64 = 8;

const BLOCKS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// No workgroups, and no lines.
const NONE: [u32; 4] = [0, 1, 1, 0];

/// What deciding needs.
pub struct LineClasses {
    lines: RecordBuffer,
    changes: RecordBuffer,
    /// Workgroups of both, and how many they are: `Kept` in `common/kept.wgsl`.
    kept: wgpu::Buffer,
    changed: wgpu::Buffer,
    /// What both begin with.
    none: wgpu::Buffer,
    least: ArrayBuffer,
}

impl LineClasses {
    /// Without room for any.
    pub fn new(gpu: &Gpu) -> Self {
        let counted = |label, usage| {
            let contents = bytemuck::bytes_of(&NONE);
            gpu.device.create_buffer_init(&BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let used = wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        Self {
            lines: RecordBuffer::new(gpu, "pixels of lines"),
            changes: RecordBuffer::new(gpu, "changes of lines"),
            kept: counted("workgroups of lines", used),
            changed: counted("workgroups of changes", used),
            none: counted("no lines", wgpu::BufferUsages::COPY_SRC),
            least: ArrayBuffer::new(gpu, "shortest stretch"),
        }
    }

    /// Decides the classes of the lines of an edge map, which have these styles. Costs nothing where all are of one class.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn settle(
        &mut self,
        rec: &mut Recorder<'_>,
        edge_map: &EdgeMap,
        styles: &[EdgeUniform],
        edge_styles: &wgpu::Buffer,
    ) -> Result<(), RenderError> {
        let mut classes = styles.iter().flat_map(|style| style.drawn().map(|(class, _)| class));
        let first = classes.next();
        let Some(spines) = edge_map.spines.as_ref().filter(|_| classes.any(|class| Some(class) != first))
        else {
            return Ok(());
        };
        let [width, height] = rec.size();
        let pixels = u64::from(width) * u64::from(height);
        let least = LEAST * height as f32 / REFERENCE_HEIGHT as f32;
        let block = least.max(4.0).ceil() as u32;
        self.lines.reserve(rec.gpu, pixels * 4)?;
        self.changes.reserve(rec.gpu, pixels.div_ceil(CHANGED) * CHANGE_BYTES)?;
        self.least.write(rec.gpu, &vec![least]);
        let meetings =
            rec.target_of("where classes meet", BLOCKS, [width, height].map(|side| side.div_ceil(block)))?;
        rec.encoder.copy_buffer_to_buffer(&self.none, 0, &self.kept, 0, None);
        let common =
            inputs! { edge_map_tex: &edge_map.edges, edge_styles: edge_styles, least: self.least.buffer() };
        let collected = inputs! {
            spine_tex: spines,
            meeting_tex: &meetings,
            keeping: &self.kept,
            keeping_lines: self.lines.buffer(),
        };
        let groups = [width, height].map(|side| side.div_ceil(LINES_GROUP));
        rec.compute("lines of classes", &program("cs_lines"), &collected, groups)?;
        let lines = common.and(&inputs! { kept: &self.kept, kept_lines: self.lines.buffer() });
        let met = inputs! { meeting_tex: &meetings }.and(&lines);
        rec.compute("where classes meet", &program("cs_meetings"), &met, &self.kept)?;
        let settled = inputs! { met_tex: &meetings, changing: &self.changed, changes: self.changes.buffer() }
            .and(&lines);
        let changed = inputs! {
            changed: &self.changed,
            changes: self.changes.buffer(),
            edge_tex: &edge_map.edges,
            changed_spine_tex: spines,
        };
        for _ in 0..ROUNDS {
            rec.encoder.copy_buffer_to_buffer(&self.none, 0, &self.changed, 0, None);
            rec.compute("classes of stretches", &program("cs_settle"), &settled, &self.kept)?;
            rec.compute("change classes", &program("cs_change"), &changed, &self.changed)?;
        }
        Ok(())
    }
}

fn program(entry_point: &'static str) -> Program {
    Program::new("passes/line_classes.wgsl", entry_point)
}
