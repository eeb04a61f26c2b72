// Whether any thin line can reach a block of pixels.
#import common/frame.wgsl
#import common/line_block.wgsl

var block_tex: texture_2d<u32>;
var near_tex: texture_storage_2d<r32uint, write>;

// Whether lines reach two pixels far.
override NARROW_BY_TWO: bool = false;

// The pixels of the block so far away, in blocks, from which lines reach one.
fn reaching(away: vec2<i32>) -> u32 {
    let many = select(1u, 3u, NARROW_BY_TWO);
    let columns = select(many, many << select(3u, 2u, NARROW_BY_TWO), away.x < 0) * FIRST_COLUMN;
    let rows = select(1u, 0x11u, NARROW_BY_TWO) * FIRST_ROW;
    let beside = select(columns, 0xffffu, away.x == 0);
    let over = select(rows, rows << select(12u, 8u, NARROW_BY_TWO), away.y < 0);
    return beside & select(over, 0xffffu, away.y == 0);
}

// Workgroups as in src/render/passes/line_blocks.rs.
@compute @workgroup_size(16, 16)
fn cs_main(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = vec2<i32>(id.xy);
    let last = (vec2<i32>(frame.size) - 1) / LINE_BLOCK;
    if any(block > last) {
        return;
    }
    var lines = 0u;
    for (var i = 0; i < 9; i++) {
        let away = vec2(i % 3, i / 3) - 1;
        // Beyond the picture it is a block that counts already.
        lines |= textureLoad(block_tex, clamp(block + away, vec2(0), last), 0).x & reaching(away);
    }
    textureStore(near_tex, block, vec4(lines, 0u, 0u, 0u));
}
