//! Buffers and buffer views: where the bytes of a model are, and the unpacking of compressed views.

use std::sync::Arc;

use ::gltf::json::{self, Root};
use rayon::prelude::*;

use super::fault::{Fault, Result, malformed};
use super::meshopt;
use crate::import::Progress;
use crate::import::memory_budget::MemoryBudget;
use crate::import::source::{Folder, shorten};

/// The content of one buffer.
#[derive(Debug)]
enum Content<'a> {
    /// The binary chunk of the GLB.
    Chunk(&'a [u8]),
    /// A data URI or a side file.
    Fetched(Arc<Vec<u8>>),
    /// Nothing: a placeholder behind compressed views, or an error in the file that matters once it is used.
    Absent,
}

/// A parsed model with its bytes.
#[derive(Debug)]
pub(super) struct GltfDocument<'a> {
    /// The typed JSON. Its indices are not checked.
    pub(super) root: Root,
    /// What may still be allocated.
    pub(super) budget: MemoryBudget,
    buffers: Vec<Content<'a>>,
    unpacked: Vec<Option<Vec<u8>>>,
}

/// The bytes of a buffer view.
#[derive(Debug, Clone, Copy)]
pub(super) struct BufferView<'a> {
    /// Exactly the view's bytes.
    pub(super) bytes: &'a [u8],
    /// Distance between elements, where declared.
    pub(super) stride: Option<usize>,
}

impl<'a> GltfDocument<'a> {
    /// Fetches all buffers and unpacks compressed views.
    ///
    /// # Errors
    /// When a side file cannot be read or lies outside the folder, or a compressed view is damaged.
    pub(super) fn open(
        root: Root,
        file_size: usize,
        bin: Option<&'a [u8]>,
        folder: &Folder,
        progress: &Progress,
    ) -> Result<Self> {
        let mut buffers = Vec::with_capacity(root.buffers.len());
        let mut input = file_size as u64;
        for (index, buffer) in root.buffers.iter().enumerate() {
            progress.check()?;
            buffers.push(match (&buffer.uri, bin) {
                _ if meshopt::is_fallback(buffer) => Content::Absent,
                (Some(uri), _) => {
                    let bytes =
                        folder.fetch(uri).map_err(|e| Fault::from(e).at(|| format!("buffer {index}")))?;
                    if !uri.starts_with("data:") {
                        input = input.saturating_add(bytes.len() as u64);
                    }
                    Content::Fetched(bytes)
                }
                (None, Some(bin)) if index == 0 => Content::Chunk(bin),
                _ => Content::Absent,
            });
        }
        let mut document =
            Self { budget: MemoryBudget::for_input(input), unpacked: Vec::new(), buffers, root };
        document.unpacked = document
            .root
            .buffer_views
            .par_iter()
            .enumerate()
            .map(|(index, view)| {
                let Some(packed) = meshopt::packing_of(view) else {
                    return Ok(None);
                };
                progress.check()?;
                let unpack = |packed: Result<meshopt::Packing>| {
                    let packed = packed?;
                    let bytes = document.slice(packed.buffer, packed.offset, packed.length)?;
                    meshopt::unpack(&packed, bytes, &document.budget)
                };
                unpack(packed).map(Some).map_err(|f| f.at(|| format!("compressed buffer view {index}")))
            })
            .collect::<Result<_>>()?;
        Ok(document)
    }

    /// A range of a buffer.
    fn slice(&self, buffer: usize, offset: u64, length: u64) -> Result<&[u8]> {
        let bytes: &[u8] = match self.buffers.get(buffer) {
            Some(Content::Chunk(bytes)) => bytes,
            Some(Content::Fetched(bytes)) => bytes,
            Some(Content::Absent) => {
                return malformed(format!(
                    "buffer {buffer} has neither a URI nor a binary chunk, so its content is missing"
                ));
            }
            None => return malformed(format!("there is no buffer {buffer}")),
        };
        let range = usize::try_from(offset)
            .ok()
            .zip(usize::try_from(length).ok())
            .and_then(|(start, len)| Some(start..start.checked_add(len)?));
        match range.and_then(|r| bytes.get(r)) {
            Some(part) => Ok(part),
            None => malformed(format!(
                "bytes {offset} to {} lie outside buffer {buffer}, which has {} bytes; the file is incomplete",
                u128::from(offset) + u128::from(length),
                bytes.len()
            )),
        }
    }

    /// The bytes of a buffer view.
    ///
    /// # Errors
    /// When the view or its buffer does not exist or is too small.
    pub(super) fn view(&self, index: json::Index<json::buffer::View>) -> Result<BufferView<'_>> {
        let index = index.value();
        let Some(view) = self.root.buffer_views.get(index) else {
            return malformed(format!("there is no buffer view {index}"));
        };
        let stride = view.byte_stride.map(|s| s.0);
        if let Some(Some(bytes)) = self.unpacked.get(index) {
            return Ok(BufferView { bytes, stride });
        }
        let bytes = self
            .slice(view.buffer.value(), view.byte_offset.unwrap_or_default().0, view.byte_length.0)
            .map_err(|f| f.at(|| format!("buffer view {index}")))?;
        Ok(BufferView { bytes, stride })
    }
}

/// A name for messages: the kind, the number and, where given, the name.
pub(super) fn label(kind: &str, index: usize, name: Option<&String>) -> String {
    match name {
        Some(name) if !name.is_empty() => format!("{kind} {index} \"{}\"", shorten(name)),
        _ => format!("{kind} {index}"),
    }
}
