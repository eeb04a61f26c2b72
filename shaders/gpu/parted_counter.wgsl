// Software devices draw each tile of 64 by 64 pixels on one processor. So that adjacent ones do not wait for each other's
// memory, they count for themselves, in so many parts, and write runs of entries of their own. Twin: src/gpu/parted_counter.rs.
const PARTS: u32 = 4u;
// Entries of one part that lie together, before those of the next part.
const RUN: u32 = 1024u;

// The part that counts a pixel.
fn part_of(px: vec2<u32>) -> u32 {
    let tile = px / 64u % 2u;
    return 2u * tile.y + tile.x;
}

// The word that a part counts in.
fn word_of(part: u32) -> u32 {
    return part * 64u / PARTS;
}

// Where a part puts what it counted as this number, from 0.
fn index_of(part: u32, number: u32) -> u32 {
    return (number / RUN * PARTS + part) * RUN + number % RUN;
}
