//! A count of what fragments append, in parts that do not wait for each other. Twin: `shaders/gpu/parted_counter.wgsl`.

/// Parts of a picture that count for themselves, and how many of one lie together.
const PARTS: u64 = 4;
const RUN: u64 = 1024;

/// Words of the counters: each part has a line of the processor's cache to itself.
pub const COUNTER_WORDS: usize = 64;

/// So much there has to be room for: each part takes as much as the fullest one.
pub fn room(words: &[u32; COUNTER_WORDS]) -> u64 {
    let fullest = words.iter().max().map_or(0, |&most| u64::from(most));
    fullest.next_multiple_of(RUN) * PARTS
}
