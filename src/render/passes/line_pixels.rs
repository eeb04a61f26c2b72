//! The pixels in which lines run: they are few, and whatever is done for each of them need not look for them in all the picture.

use super::line_blocks::line_blocks;
use crate::gpu::{Gpu, RecordList, Recorder, Target};
use crate::render::base::error::RenderError;

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

/// What is known of the pixels in which lines run.
#[derive(Clone, Copy)]
pub struct FoundPixels<'a> {
    /// All of them.
    pub list: &'a RecordList,
    /// In which pixels of each block there are any, see [`line_blocks`].
    pub blocks: &'a Target,
}

/// A list of pixels in which lines run, or ran before some of them were left out; see `shaders/common/pixel_list.wgsl`.
pub struct LinePixels {
    list: RecordList,
    /// Of the lines that are listed; `None`: none are.
    blocks: Option<Target>,
}

impl LinePixels {
    /// Nothing listed yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { list: RecordList::new(gpu, "pixels of lines"), blocks: None }
    }

    /// There are other lines now.
    pub fn forget(&mut self) {
        self.blocks = None;
    }

    /// In which pixels of each block there are any, see [`line_blocks`]; `None`: nothing has been listed since [`Self::forget`].
    pub fn blocks(&self) -> Option<&Target> {
        self.blocks.as_ref()
    }

    /// Lists the pixels of lines with these spines, unless they have been listed since [`Self::forget`].
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn list(&mut self, rec: &mut Recorder<'_>, spines: &Target) -> Result<FoundPixels<'_>, RenderError> {
        let blocks = match self.blocks.take() {
            Some(blocks) => blocks,
            None => self.find(rec, spines)?,
        };
        Ok(FoundPixels { list: &self.list, blocks: self.blocks.insert(blocks) })
    }

    fn find(&mut self, rec: &mut Recorder<'_>, spines: &Target) -> Result<Target, RenderError> {
        let [width, height] = rec.size();
        rec.gpu.check_bytes_of_pixels("with lines", [width, height], 4)?;
        self.list.reserve(rec.gpu, u64::from(width) * u64::from(height) * 4)?;
        self.list.empty(rec);
        line_blocks(rec, spines, Some(&self.list))
    }
}
