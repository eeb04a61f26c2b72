// Lists of pixels (column in the lower 16 bits, row in the upper ones), in any order.
#import common/list_head.wgsl

// While it is made.
var<storage, read_write> keeping: Counting;
var<storage, read_write> kept_pixels: array<u32>;
// Afterwards.
var<storage, read> list: ListHead;
var<storage, read> listed_pixels: array<u32>;

// Pixels per workgroup of whatever works through it.
const GROUP: u32 = 256u;

fn pack_pixel(px: vec2<i32>) -> u32 {
    return u32(px.x) | (u32(px.y) << 16u);
}

fn unpack_pixel(px: u32) -> vec2<i32> {
    return vec2<i32>(vec2(px & 0xffffu, px >> 16u));
}

// Makes room for so many pixels; returns the index of the first.
fn keep_many(count: u32) -> u32 {
    let first = atomicAdd(&keeping.count, count);
    let groups = (first + count + GROUP - 1u) / GROUP - (first + GROUP - 1u) / GROUP;
    if groups > 0u {
        atomicAdd(&keeping.groups[0], groups);
    }
    return first;
}

fn keep(px: vec2<i32>) {
    kept_pixels[keep_many(1u)] = pack_pixel(px);
}
