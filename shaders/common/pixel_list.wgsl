// Lists of pixels, in any order.
#import common/pixel.wgsl
#import gpu/record_list.wgsl

// While it is made.
var<storage, read_write> kept_pixels: array<u32>;
// Afterwards.
var<storage, read> listed_pixels: array<u32>;

fn keep(px: vec2<i32>) {
    kept_pixels[keep_many(1u)] = pack_pixel(px);
}
