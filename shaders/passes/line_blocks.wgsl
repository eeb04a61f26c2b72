// Finds in which pixels of each block lines run, and lists them: they are few.
#import common/frame.wgsl
#import common/line_block.wgsl
#import common/pixel_list.wgsl
#import gpu/neighbors.wgsl

// Not 0 where lines run.
var spine_tex: texture_2d<u32>;
var finding_tex: texture_storage_2d<r32uint, write>;

fn lines_in(first: vec2<i32>) -> u32 {
    var lines = 0u;
    for (var i = 0; i < 4; i++) {
        let away = 2 * vec2(i & 1, i >> 1u);
        let here = vec4<u32>(four_at(spine_tex, first + away) != vec4(0u)) << vec4(0u, 1u, 4u, 5u);
        lines |= any_of(here) << u32(away.x + LINE_BLOCK * away.y);
    }
    let inside = clamp(vec2<i32>(frame.size) - first, vec2(0), vec2(LINE_BLOCK));
    let columns = ((1u << u32(inside.x)) - 1u) * FIRST_COLUMN;
    return lines & columns & ((1u << u32(LINE_BLOCK * inside.y)) - 1u);
}

fn is_in_picture(block: vec2<i32>) -> bool {
    return all(LINE_BLOCK * block < vec2<i32>(frame.size));
}

// Workgroups as in src/render/passes/line_blocks.rs.
@compute @workgroup_size(16, 16)
fn cs_find(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = vec2<i32>(id.xy);
    if is_in_picture(block) {
        textureStore(finding_tex, block, vec4(lines_in(LINE_BLOCK * block), 0u, 0u, 0u));
    }
}

// The same, and the list.
@compute @workgroup_size(16, 16)
fn cs_list(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = vec2<i32>(id.xy);
    if !is_in_picture(block) {
        return;
    }
    var lines = lines_in(LINE_BLOCK * block);
    textureStore(finding_tex, block, vec4(lines, 0u, 0u, 0u));
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
