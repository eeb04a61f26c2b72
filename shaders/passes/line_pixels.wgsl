// Lists the pixels in which lines run, which are few.
#import common/frame.wgsl
#import common/pixel_list.wgsl
#import gpu/neighbors.wgsl

// Not 0 where lines run.
var spine_tex: texture_2d<u32>;

// Pixels per side of a block: software devices take as long for the first pixel of one as for all of them.
const BLOCK: i32 = 4;

// The pixels of a block in which lines run, as the bits of a number.
fn lines_in(first: vec2<i32>) -> u32 {
    var lines = 0u;
    for (var i = 0; i < 4; i++) {
        let away = 2 * vec2(i & 1, i >> 1u);
        let here = vec4<u32>(four_at(spine_tex, first + away) != vec4(0u)) << vec4(0u, 1u, 4u, 5u);
        lines |= any_of(here) << u32(away.x + BLOCK * away.y);
    }
    let inside = clamp(vec2<i32>(frame.size) - first, vec2(0), vec2(BLOCK));
    let columns = ((1u << u32(inside.x)) - 1u) * 0x1111u;
    return lines & columns & ((1u << u32(BLOCK * inside.y)) - 1u);
}

// Workgroups as in src/render/passes/line_pixels.rs.
@compute @workgroup_size(16, 16)
fn cs_main(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = BLOCK * vec2<i32>(id.xy);
    var lines = lines_in(first);
    if lines == 0u {
        return;
    }
    var index = keep_many(countOneBits(lines));
    for (; lines != 0u; lines &= lines - 1u) {
        let place = i32(countTrailingZeros(lines));
        kept_pixels[index] = pack_pixel(first + vec2(place % BLOCK, place / BLOCK));
        index++;
    }
}
