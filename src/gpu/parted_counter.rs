//! A count of what fragments append to a buffer, in parts that do not wait for each other. Twin:
//! `shaders/gpu/parted_counter.wgsl`.

/// Parts of the picture, each with a count of its own.
const PARTS: u64 = 4;
/// A square with sides of so many pixels has as many of each part.
pub const SQUARE: u32 = 128;
/// The buffer is dealt out in runs of so many entries: one to each part in turn.
const RUN: u64 = 1024;

/// Words of the counters: each part has a line of the processor's cache to itself.
pub const COUNTER_WORDS: usize = 64;

/// So many entries there has to be room for: as runs are dealt out in turn, each part takes as much as the fullest one.
pub fn capacity(words: &[u32; COUNTER_WORDS]) -> u64 {
    let fullest = words.iter().max().map_or(0, |&most| u64::from(most));
    fullest.next_multiple_of(RUN) * PARTS
}
