// Lists of pixels (column in the lower 16 bits, row in the upper ones), in any order.
#import gpu/record_list.wgsl

// While it is made.
var<storage, read_write> kept_pixels: array<u32>;
// Afterwards.
var<storage, read> listed_pixels: array<u32>;

fn pack_pixel(px: vec2<i32>) -> u32 {
    return u32(px.x) | (u32(px.y) << 16u);
}

fn unpack_pixel(px: u32) -> vec2<i32> {
    return vec2<i32>(vec2(px & 0xffffu, px >> 16u));
}

fn keep(px: vec2<i32>) {
    kept_pixels[keep_many(1u)] = pack_pixel(px);
}
