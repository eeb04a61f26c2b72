//! The pixels in which lines run: they are few, and whatever is done for each of them need not look for them in all the picture.

use crate::gpu::{Gpu, Program, RecordList, Recorder, Target, inputs};
use crate::render::base::error::RenderError;

/// Pixels per side of a workgroup, as in `shaders/passes/line_pixels.wgsl`.
const GROUP: u32 = 64;

/// The exact lines of an edge map.
#[derive(Clone, Copy)]
pub struct ListedLines<'a> {
    /// The edge map.
    pub edges: &'a Target,
    /// Where their spines run and how wide they are.
    pub spines: &'a Target,
    /// The pixels of [`LinePixels`].
    pub pixels: &'a RecordList,
}

/// A list of pixels in which lines run, or ran before some of them were left out; see `shaders/common/pixel_list.wgsl`.
pub struct LinePixels {
    list: RecordList,
    is_listed: bool,
}

impl LinePixels {
    /// Nothing listed yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { list: RecordList::new(gpu, "pixels of lines"), is_listed: false }
    }

    /// There are other lines now.
    pub fn forget(&mut self) {
        self.is_listed = false;
    }

    /// Lists the pixels of lines with these spines, unless they have been listed since [`Self::forget`].
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn list(&mut self, rec: &mut Recorder<'_>, spines: &Target) -> Result<&RecordList, RenderError> {
        if !self.is_listed {
            let [width, height] = rec.size();
            rec.gpu.check_bytes_of_pixels("with lines", [width, height], 4)?;
            self.list.reserve(rec.gpu, u64::from(width) * u64::from(height) * 4)?;
            self.list.empty(rec);
            let inputs = inputs! {
                spine_tex: spines,
                keeping: self.list.count(),
                kept_pixels: self.list.buffer(),
            };
            let groups = [width, height].map(|side| side.div_ceil(GROUP));
            rec.compute(
                "pixels of lines",
                &Program::new("passes/line_pixels.wgsl", "cs_main"),
                &inputs,
                groups,
            )?;
            self.is_listed = true;
        }
        Ok(&self.list)
    }
}
