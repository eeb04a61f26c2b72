//! Layers of several groups in depth order: where groups overlap, the ink and the fill of each layer are appended, with their
//! depths, to one list per pixel, which is then put in order and blended once (Yang et al. 2010, "Real-Time Concurrent Linked
//! List Construction on the GPU"). Within a group the order of layers stays: a depth counts as no less than those before it.
//!
//! There is room for a limited number of entries. The device counts them all, row by row; where there were more than that, the
//! picture is drawn again with more of it, at last in bands of rows, one after the other.

use std::ops::Range;

use encase::ShaderType;

use super::layers::Reported;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{
    Gpu, GpuError, Program, RecordBuffer, RecordTexture, Recorder, Reports, Target, UniformBuffer, inputs,
};
use crate::render::base::error::RenderError;

/// Entries per pixel, as long as nobody has counted them.
const FIRST_GUESS: u64 = 4;

/// Pixels of a row per workgroup, as in `passes/layer_lists.wgsl`.
const GROUP: u32 = 64;

/// Twin of `Band` in `shaders/passes/layer_lists.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct BandUniform {
    first_row: u32,
    end_row: u32,
    capacity: u32,
}

/// The lists of a picture.
pub struct LayerLists {
    heads: RecordBuffer,
    /// The greatest depth so far of the group that is appended.
    deepest: RecordBuffer,
    entries: RecordTexture,
    /// Entries that were appended in this band, then those of each row.
    counts: RecordBuffer,
    band: UniformBuffer<BandUniform>,
    reports: Reports<Recorded>,
    /// Entries of each row in the last picture of which that is known.
    known: Vec<u32>,
    size: [u32; 2],
}

/// What a picture had room for.
#[derive(Debug, Clone)]
struct Recorded {
    /// Entries of each band.
    capacity: u64,
    bands: Vec<Range<u32>>,
}

impl LayerLists {
    /// Without room for anything.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            heads: RecordBuffer::new(gpu, "heads of layers"),
            deepest: RecordBuffer::new(gpu, "depths of groups"),
            entries: RecordTexture::new(gpu, "layers of groups"),
            counts: RecordBuffer::new(gpu, "counts of layers"),
            band: UniformBuffer::new(gpu, "band of rows"),
            reports: Reports::default(),
            known: Vec::new(),
            size: [0; 2],
        }
    }

    /// What has been reported since the last call. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        if let Some((recorded, bytes)) = self.reports.take() {
            let words = bytes.chunks_exact(4).filter_map(|w| w.try_into().ok()).map(u32::from_le_bytes);
            let known: Vec<u32> = words.skip(1).take(self.size[1] as usize).collect();
            let entries = |band: &Range<u32>| {
                let rows = known.get(band.start as usize..band.end as usize).unwrap_or_default();
                rows.iter().map(|&row| u64::from(row)).sum::<u64>()
            };
            let fits = recorded.bands.iter().all(|band| entries(band) <= recorded.capacity);
            self.known = known;
            if !fits {
                return Reported::Incomplete;
            }
        }
        if self.reports.is_waiting() { Reported::Waiting } else { Reported::Complete }
    }

    /// The bands of rows in which a picture of this size is to be drawn, and makes room for the fullest of them.
    ///
    /// # Errors
    /// [`GpuError`].
    pub fn plan(&mut self, gpu: &Gpu, size: [u32; 2]) -> Result<Vec<Range<u32>>, GpuError> {
        if self.size != size {
            (self.known, self.size) = (Vec::new(), size);
        }
        let [width, height] = size.map(u64::from);
        let most = gpu.max_listed.min(RecordTexture::max_texels(gpu));
        let total: u64 = self.known.iter().map(|&row| u64::from(row)).sum();
        // A quarter more than there were, as there may be more by now.
        let wanted = if self.known.is_empty() { FIRST_GUESS * width * height } else { total + total / 4 + 1 };
        let capacity = wanted.min(most);
        let bands = if total <= capacity {
            std::iter::once(0..size[1]).collect()
        } else {
            // A row has fewer entries than there is room for.
            bands_of(&self.known, capacity * 4 / 5)
                .unwrap_or_else(|| (0..size[1]).map(|row| row..row + 1).collect())
        };
        self.entries.reserve(gpu, capacity as usize)?;
        self.heads.reserve(gpu, width * height * 4)?;
        self.deepest.reserve(gpu, width * height * 4)?;
        self.counts.reserve(gpu, (1 + height) * 4)?;
        Ok(bands)
    }

    /// Begins a band; what is recorded for it has to be submitted before the next one begins.
    pub fn begin_band(&mut self, rec: &mut Recorder<'_>, band: &Range<u32>, is_first: bool) {
        let capacity = u32::try_from(self.entries.capacity()).unwrap_or(u32::MAX);
        self.band.write(rec.gpu, &BandUniform { first_row: band.start, end_row: band.end, capacity });
        rec.encoder.clear_buffer(self.heads.buffer(), 0, None);
        // The rows are counted through all bands.
        rec.encoder.clear_buffer(self.counts.buffer(), 0, (!is_first).then_some(4));
    }

    /// Begins the layers of the next group.
    pub fn begin_group(&self, rec: &mut Recorder<'_>) {
        rec.encoder.clear_buffer(self.deepest.buffer(), 0, None);
    }

    /// Appends a layer of that group: its ink, and its fill beneath that; see `shaders/common/placed.wgsl`.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn append(
        &self,
        rec: &mut Recorder<'_>,
        ink: Option<&Target>,
        fill: Option<&Target>,
    ) -> Result<(), RenderError> {
        let program = Program {
            file: "passes/layer_lists.wgsl",
            entry_point: "cs_append",
            switches: vec![("WITH_INK", ink.is_some()), ("WITH_FILL", fill.is_some())],
        };
        let inputs = inputs! {
            band: self.band.buffer(),
            heads: self.heads.buffer(),
            deepest: self.deepest.buffer(),
            counts: self.counts.buffer(),
            new_entry_tex: self.entries.target(),
            ink_tex: ink,
            fill_tex: fill,
        };
        let [width, height] = rec.size();
        Ok(rec.compute("append layer", &program, &inputs, [width.div_ceil(GROUP), height])?)
    }

    /// Blends the layers of a band onto `color`, of which other rows stay as they are.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn blend(
        &self,
        rec: &mut Recorder<'_>,
        band: &Range<u32>,
        color: &Target,
    ) -> Result<(), RenderError> {
        let [width, _] = rec.size();
        let outer = rec.scissor_rect.replace([0, band.start, width, band.end]);
        let inputs = inputs! { listed: self.heads.buffer(), entry_tex: self.entries.target() };
        let blended = rec.draw(Draw {
            label: "blend layers",
            program: Program::new("passes/layer_lists.wgsl", "fs_blend"),
            inputs: &inputs,
            outputs: &[color],
            onto: Onto::Load,
            depth: None,
        });
        rec.scissor_rect = outer;
        Ok(blended?)
    }

    /// Reports how many entries all bands had.
    pub fn report(&mut self, rec: &mut Recorder<'_>, bands: Vec<Range<u32>>) {
        let recorded = Recorded { capacity: self.entries.capacity(), bands };
        self.reports.send(rec, self.counts.buffer(), recorded);
    }
}

/// Consecutive rows that together have no more entries than there is room for; `None` if a row alone has more.
fn bands_of(rows: &[u32], capacity: u64) -> Option<Vec<Range<u32>>> {
    let mut bands: Vec<Range<u32>> = Vec::new();
    let mut sum = 0;
    for (row, &entries) in (0..).zip(rows) {
        let entries = u64::from(entries);
        if entries > capacity {
            return None;
        }
        match bands.last_mut() {
            Some(band) if sum + entries <= capacity => {
                band.end = row + 1;
                sum += entries;
            }
            _ => {
                bands.push(row..row + 1);
                sum = entries;
            }
        }
    }
    Some(bands)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_have_no_more_entries_than_room_and_leave_no_row_out() {
        let ends = |rows: &[u32], capacity| -> Option<Vec<[u32; 2]>> {
            Some(bands_of(rows, capacity)?.iter().map(|band| [band.start, band.end]).collect())
        };
        assert_eq!(ends(&[3, 3, 3], 9), Some(vec![[0, 3]]));
        assert_eq!(ends(&[3, 3, 3], 8), Some(vec![[0, 2], [2, 3]]));
        assert_eq!(ends(&[5, 0, 0, 6, 2], 6), Some(vec![[0, 3], [3, 4], [4, 5]]));
        assert_eq!(ends(&[5, 7], 6), None);
    }
}
