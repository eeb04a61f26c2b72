// Blocks of pixels, each with the pixels in which lines run as the bits of a number, row by row. Software devices take as long for
// the first pixel of a block as for all of them. Twin: `LINE_BLOCK` in src/render/passes/line_blocks.rs.

// Pixels per side.
const LINE_BLOCK: i32 = 4;
const FIRST_ROW: u32 = 0x000fu;
const FIRST_COLUMN: u32 = 0x1111u;
