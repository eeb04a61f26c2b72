// Pixels as numbers: column in the lower 16 bits, row in the upper ones.
#import common/frame.wgsl

fn pack_pixel(px: vec2<i32>) -> u32 {
    return u32(px.x) | (u32(px.y) << 16u);
}

fn unpack_pixel(px: u32) -> vec2<i32> {
    return vec2<i32>(vec2(px & 0xffffu, px >> 16u));
}

// The same plus 1, so that 0 says that none has been found.
fn found_at(px: vec2<i32>) -> u32 {
    return pack_pixel(px) + 1u;
}

fn pixel_of(found: u32) -> vec2<i32> {
    return unpack_pixel(found - 1u);
}

// Where a buffer of all pixels has it, row by row.
fn index_of_pixel(px: vec2<i32>) -> u32 {
    return u32(px.y) * u32(frame.size.x) + u32(px.x);
}
