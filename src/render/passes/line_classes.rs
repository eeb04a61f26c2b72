//! Lines followed over stretches, which decides their class and leaves out dots: see `shaders/passes/line_classes.wgsl`.
//!
//! ```text
//! pixels of lines ─► links ─► sift ─► settle ─► replace ─► change ─► find short ─► leave out ─► edge map, spines
//! ```

use super::edge_map::EdgeMap;
use super::gbuffer::GBuffer;
use super::line_pixels::{FoundPixels, LinePixels};
use crate::gpu::{Gpu, Inputs, Program, RecordBuffer, RecordList, Recorder, inputs};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::edge_styles::EdgeStylesBuffer;
use crate::render::base::error::RenderError;

/// Bytes of `Change` there.
const CHANGE_BYTES: u64 = 32;
/// Most changes, as a share of all pixels: lines are thin, and few of their pixels change.
const CHANGED: u64 = 8;

const LINKS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
const CLASSES: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// What deciding needs.
pub struct LineClasses {
    /// Pixels where classes meet.
    meeting: RecordList,
    /// Pixels that may be dots or short pieces.
    short: RecordList,
    /// Pixels that change.
    changing: RecordList,
    /// What they become.
    changes: RecordBuffer,
}

impl LineClasses {
    /// Without room for any.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            meeting: RecordList::new(gpu, "pixels where classes of lines meet"),
            short: RecordList::new(gpu, "pixels of short lines"),
            changing: RecordList::new(gpu, "pixels of lines that change"),
            changes: RecordBuffer::new(gpu, "changes of lines"),
        }
    }

    /// Decides the classes of the lines of an edge map of opaque surfaces, which have these styles and of which it lists the `pixels`,
    /// and leaves out dots. (Of layers, what is a piece in one may go on in the next.) Costs nothing where all are of one class, and
    /// of any length.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn settle(
        &mut self,
        rec: &mut Recorder<'_>,
        edge_map: &EdgeMap,
        gbuffer: &GBuffer,
        edge_styles: &EdgeStylesBuffer,
        decisions: Decisions,
        pixels: &mut LinePixels,
    ) -> Result<(), RenderError> {
        let Some(spines) = edge_map.spines.as_ref().filter(|_| decisions.any()) else { return Ok(()) };
        let [width, height] = rec.size();
        let area = u64::from(width) * u64::from(height);
        self.meeting.reserve(rec.gpu, area * 4)?;
        self.short.reserve(rec.gpu, area * 4)?;
        self.changing.reserve(rec.gpu, area * 4)?;
        self.changes.reserve(rec.gpu, area.div_ceil(CHANGED) * CHANGE_BYTES)?;
        let links = rec.target("links of lines", LINKS)?;
        let settled = rec.target("settled classes", CLASSES)?;
        let FoundPixels { list: lines, blocks } = pixels.list(rec, spines)?;
        let read = inputs! {
            block_tex: blocks,
            edge_map_tex: &edge_map.edges,
            link_tex: &links,
            settled_tex: &settled,
            geometry_tex: &gbuffer.geometry,
        }
        .and(&edge_styles.inputs());
        let written = inputs! {
            linking_tex: &links,
            settling_tex: &settled,
            edge_tex: &edge_map.edges,
            changed_spine_tex: spines,
        };
        let all = read.and(&written);
        let sifting = inputs! {
            list: lines.count(),
            listed_pixels: lines.buffer(),
            keeping: self.meeting.count(),
            kept_pixels: self.meeting.buffer(),
            keeping_short: self.short.count(),
            short_pixels: self.short.buffer(),
        };
        let sifting = sifting.and(&all);
        self.meeting.empty(rec);
        self.short.empty(rec);
        rec.compute("links of lines", &program("cs_links"), &sifting, lines.count())?;
        rec.compute("sift lines", &decisions.program("cs_sift"), &sifting, lines.count())?;
        let changing = inputs! {
            list: self.changing.count(),
            listed_pixels: self.changing.buffer(),
            changes: self.changes.buffer(),
        };
        let changing = changing.and(&all);
        if decisions.classes {
            self.decide(rec, &decisions.program("cs_settle"), &all, &self.meeting)?;
            rec.compute("change classes", &program("cs_replace"), &changing, self.changing.count())?;
            rec.compute("change classes", &program("cs_change"), &changing, self.changing.count())?;
        }
        if decisions.dots {
            if decisions.classes {
                // What these were linked to may have made way.
                let short = inputs! { list: self.short.count(), listed_pixels: self.short.buffer() };
                rec.compute("links of lines", &program("cs_links"), &short.and(&all), self.short.count())?;
            }
            self.decide(rec, &decisions.program("cs_find_short"), &all, &self.short)?;
            rec.compute("leave out lines", &program("cs_leave_out"), &changing, self.changing.count())?;
        }
        Ok(())
    }

    /// Lists those of the listed pixels that are to change.
    fn decide(
        &self,
        rec: &mut Recorder<'_>,
        program: &Program,
        inputs: &Inputs<'_>,
        listed: &RecordList,
    ) -> Result<(), RenderError> {
        self.changing.empty(rec);
        let lists = inputs! {
            list: listed.count(),
            listed_pixels: listed.buffer(),
            keeping: self.changing.count(),
            kept_pixels: self.changing.buffer(),
            keeping_short: self.short.count(),
            short_pixels: self.short.buffer(),
        };
        rec.compute("classes of lines", program, &lists.and(inputs), listed.count())?;
        Ok(())
    }
}

/// What is decided of lines.
#[derive(Debug, Clone, Copy)]
pub struct Decisions {
    /// Their class.
    pub classes: bool,
    /// Whether the wider class comes first: lines have different widths.
    pub wider_first: bool,
    /// Whether they are dots: too short, and nothing continues them.
    pub dots: bool,
    /// Whether they are short pieces beside a longer line.
    pub pieces: bool,
}

impl Decisions {
    /// For lines of these styles; `crossing`: they cross each other without being one, as strokes of a hand do.
    #[must_use]
    pub fn of(styles: &[GpuEdgeStyle], crossing: bool) -> Self {
        let drawn: Vec<_> = styles.iter().flat_map(GpuEdgeStyle::drawn).collect();
        let dots = styles.iter().any(|s| s.is_exact() && s.min_length > 0.0);
        Self {
            classes: !crossing && drawn.windows(2).any(|two| two[0].0 != two[1].0),
            wider_first: drawn.windows(2).any(|two| two[0].1.width != two[1].1.width),
            dots,
            pieces: !crossing && dots,
        }
    }

    fn any(self) -> bool {
        self.classes || self.dots
    }

    fn program(self, entry_point: &'static str) -> Program {
        let switches = vec![
            ("WITH_CLASSES", self.classes),
            ("WIDER_FIRST", self.wider_first),
            ("WITH_DOTS", self.dots),
            ("WITH_PIECES", self.pieces),
        ];
        Program { switches, ..program(entry_point) }
    }
}

fn program(entry_point: &'static str) -> Program {
    Program::new("passes/line_classes.wgsl", entry_point)
}
