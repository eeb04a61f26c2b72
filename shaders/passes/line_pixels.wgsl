// Lists the pixels in which lines run, which are few.
#import common/frame.wgsl
#import common/line_block.wgsl
#import common/pixel_list.wgsl

var block_tex: texture_2d<u32>;

// Workgroups as in src/render/passes/line_blocks.rs.
@compute @workgroup_size(16, 16)
fn cs_main(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = vec2<i32>(id.xy);
    if any(LINE_BLOCK * block >= vec2<i32>(frame.size)) {
        return;
    }
    var lines = textureLoad(block_tex, block, 0).x;
    if lines == 0u {
        return;
    }
    var index = keep_many(countOneBits(lines));
    for (; lines != 0u; lines &= lines - 1u) {
        let place = i32(countTrailingZeros(lines));
        kept_pixels[index] = pack_pixel(LINE_BLOCK * block + vec2(place % LINE_BLOCK, place / LINE_BLOCK));
        index++;
    }
}
