//! Lines followed over stretches, which decides their class and leaves out dots: see `shaders/passes/line_classes.wgsl`.
//!
//! ```text
//! spines ─► lines ─► links ─► settle ─► change ─► edge map, spines
//! ```

use super::edge_map::EdgeMap;
use super::gbuffer::GBuffer;
use crate::gpu::{ArrayBuffer, Gpu, Inputs, Program, RecordList, Recorder, inputs};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::error::RenderError;
use crate::render::base::view::REFERENCE_HEIGHT;

/// No stretch of a line between two of other classes is shorter, reference pixels.
const LEAST: f32 = 8.0;
/// Pixels per side of a workgroup that collects lines, and lines per workgroup, as in `passes/line_classes.wgsl`.
const LINES_GROUP: u32 = 32;
/// Bytes of `Change` there.
const CHANGE_BYTES: u64 = 32;
/// Most changes, as a share of all pixels: lines are thin, and few of their pixels change.
const CHANGED: u64 = 8;

const LINKS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// What appends pixels to a list.
fn appended(pixels: &RecordList) -> Inputs<'_> {
    inputs! { keeping: pixels.count(), keeping_lines: pixels.buffer() }
}

/// What deciding needs.
pub struct LineClasses {
    /// Pixels of lines.
    lines: RecordList,
    /// Those that are decided once more.
    again: RecordList,
    changes: RecordList,
    least: ArrayBuffer,
}

impl LineClasses {
    /// Without room for any.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            lines: RecordList::new(gpu, "pixels of lines"),
            again: RecordList::new(gpu, "lines to decide again"),
            changes: RecordList::new(gpu, "changes of lines"),
            least: ArrayBuffer::new(gpu, "shortest stretch"),
        }
    }

    /// Decides the classes of the lines of an edge map of opaque surfaces, which have these styles, and leaves out dots. (Of
    /// layers, what is a piece in one may go on in the next.) Costs nothing where all are of one class, and of any length.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn settle(
        &mut self,
        rec: &mut Recorder<'_>,
        edge_map: &EdgeMap,
        gbuffer: &GBuffer,
        edge_styles: &ArrayBuffer,
        decisions: Decisions,
    ) -> Result<(), RenderError> {
        let Some(spines) = edge_map.spines.as_ref().filter(|_| decisions.any()) else { return Ok(()) };
        let [width, height] = rec.size();
        let pixels = u64::from(width) * u64::from(height);
        self.lines.reserve(rec.gpu, pixels * 4)?;
        self.again.reserve(rec.gpu, pixels * 4)?;
        self.changes.reserve(rec.gpu, pixels.div_ceil(CHANGED) * CHANGE_BYTES)?;
        self.least.write(rec.gpu, &vec![LEAST * height as f32 / REFERENCE_HEIGHT as f32]);
        let links = rec.target("links of lines", LINKS)?;
        let groups = [width, height].map(|side| side.div_ceil(LINES_GROUP));
        let read = inputs! {
            spine_tex: spines,
            edge_map_tex: &edge_map.edges,
            link_tex: &links,
            geometry_tex: &gbuffer.geometry,
            edge_styles: edge_styles,
            least: &self.least,
        };
        let written = inputs! { linking_tex: &links, edge_tex: &edge_map.edges, changed_spine_tex: spines };
        let all = read.and(&written);
        self.lines.empty(rec);
        rec.compute("lines to follow", &program("cs_lines"), &appended(&self.lines).and(&all), groups)?;
        let once = !decisions.classes;
        self.round(rec, &all, [&self.lines, &self.again], decisions, once)?;
        // Neighbors that decided differently, at the ends of stretches, agree the second time.
        if !once {
            self.round(rec, &all, [&self.again, &self.lines], decisions, true)?;
        }
        Ok(())
    }

    /// Decides pixels of lines; unless it is the last round, those that are to be decided `again` are listed.
    fn round(
        &self,
        rec: &mut Recorder<'_>,
        inputs: &Inputs<'_>,
        [lines, again]: [&RecordList; 2],
        decisions: Decisions,
        is_last: bool,
    ) -> Result<(), RenderError> {
        again.empty(rec);
        self.changes.empty(rec);
        let followed = inputs! { list: lines.count(), listed_lines: lines.buffer() };
        let changed = inputs! {
            changing: self.changes.count(),
            changed: self.changes.count(),
            changes: self.changes.buffer(),
        };
        let all = followed.and(&appended(again)).and(&changed).and(inputs);
        let settle = Program {
            switches: vec![
                ("WITH_CLASSES", decisions.classes),
                // What is short is decided in the last round, when lines are as they will be.
                ("WITH_DOTS", decisions.dots && is_last),
                ("WITH_PIECES", decisions.pieces),
                ("LAST_ROUND", is_last),
            ],
            ..program("cs_settle")
        };
        rec.compute("links of lines", &program("cs_links"), &all, lines.count())?;
        rec.compute("classes of lines", &settle, &all, lines.count())?;
        rec.compute("change classes", &program("cs_change"), &all, self.changes.count())?;
        Ok(())
    }
}

/// What is decided of lines.
#[derive(Debug, Clone, Copy)]
pub struct Decisions {
    /// Their class.
    pub classes: bool,
    /// Whether they are dots: too short, and nothing continues them.
    pub dots: bool,
    /// Whether they are short pieces beside a longer line.
    pub pieces: bool,
}

impl Decisions {
    /// For lines of these styles; `crossing`: they cross each other without being one, as strokes of a hand do.
    #[must_use]
    pub fn of(styles: &[GpuEdgeStyle], crossing: bool) -> Self {
        let mut classes = styles.iter().flat_map(|style| style.drawn().map(|(class, _)| class));
        let first = classes.next();
        let dots = styles.iter().any(|s| s.is_exact() && s.min_length > 0.0);
        Self {
            classes: !crossing && classes.any(|class| Some(class) != first),
            dots,
            pieces: !crossing && dots,
        }
    }

    fn any(self) -> bool {
        self.classes || self.dots
    }
}

fn program(entry_point: &'static str) -> Program {
    Program::new("passes/line_classes.wgsl", entry_point)
}
