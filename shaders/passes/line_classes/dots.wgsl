// Pieces of lines that are too short to tell anything and that nothing continues.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/line_block.wgsl
#import passes/line_classes/links.wgsl

// Pieces are followed so far, px: a row of what is around a pixel is the bits of a number.
const FARTHEST: i32 = 15;
const ROWS: i32 = 2 * FARTHEST + 1;

// The lowest bits, 0 to 31 of them.
fn lowest_bits(count: i32) -> u32 {
    return (1u << u32(clamp(count, 0, 31))) - 1u;
}

// The rows of pixels with lines in them, from `first` to `last`. Beyond the picture lines may go on.
fn rows_of_lines(first: vec2<i32>, last: vec2<i32>) -> array<u32, ROWS> {
    var rows: array<u32, ROWS>;
    let block = first / LINE_BLOCK;
    let count = last / LINE_BLOCK - block + 1;
    for (var i = 0; i < count.x * count.y; i++) {
        let at = block + vec2(i % count.x, i / count.x);
        let lines = textureLoad(block_tex, at).x;
        let place = LINE_BLOCK * at - first;
        for (var y = 0; y < LINE_BLOCK; y++) {
            let row = (lines >> u32(LINE_BLOCK * y)) & lowest_bits(LINE_BLOCK);
            let is_inside = place.y + y >= 0 && place.y + y < ROWS;
            let moved = select(row << u32(max(place.x, 0)), row >> u32(max(-place.x, 0)), place.x < 0);
            rows[clamp(place.y + y, 0, ROWS - 1)] |= select(0u, moved, is_inside);
        }
    }
    let outside = lowest_bits(-first.x) | ~lowest_bits(i32(frame.size.x) - first.x);
    for (var y = 0; y <= last.y - first.y; y++) {
        let is_inside = first.y + y >= 0 && first.y + y < i32(frame.size.y);
        rows[y] = (rows[y] | select(~0u, outside, is_inside)) & lowest_bits(last.x - first.x + 1);
    }
    return rows;
}

// The corners of the box around all that is connected to a pixel of a line, as far as it is within `reach` of it, px. A gap of one
// pixel interrupts no line.
fn box_around(px: vec2<i32>, reach: i32) -> vec4<i32> {
    let last = 2 * reach;
    var lines = rows_of_lines(px - reach, px + reach);
    var own: array<u32, ROWS>;
    own[reach] = 1u << u32(reach);
    var is_growing = true;
    while is_growing {
        is_growing = false;
        // Down and up again; the last two rows.
        var rows = vec2(0u);
        for (var i = 0; i < 2 * (last + 1); i++) {
            let y = min(i, 2 * last + 1 - i);
            let beside = own[y] | rows.x | rows.y;
            let grown = (beside | (beside << 1u) | (beside >> 1u) | (beside << 2u) | (beside >> 2u)) & lines[y];
            is_growing = is_growing || grown != own[y];
            own[y] = grown;
            rows = vec2(grown, rows.x);
        }
    }
    var columns = 0u;
    var top = reach;
    var bottom = reach;
    for (var y = 0; y <= last; y++) {
        columns |= own[y];
        top = select(top, min(top, y), own[y] != 0u);
        bottom = select(bottom, y, own[y] != 0u);
    }
    let sides = vec4(i32(firstTrailingBit(columns)), top, i32(firstLeadingBit(columns)), bottom);
    return sides - reach + px.xyxy;
}

// Whether an object is seen around a box, so far from its middle, px.
fn is_around(object: u32, box: vec4<i32>, distance: i32) -> bool {
    var is_seen = false;
    for (var i = 0; i < 9; i++) {
        let px = (box.xy + box.zw) / 2 + distance * (vec2(i % 3, i / 3) - 1);
        is_seen = is_seen || (i != 4 && unpack_surfel(geometry_at(px)).object == object);
    }
    return is_seen;
}

// Whether all that is connected to a pixel of an object's line is shorter than so much, px, up to `FARTHEST`.
fn is_short(px: vec2<i32>, object: u32, shortest: f32) -> bool {
    let reach = i32(ceil(shortest));
    let box = box_around(px, reach);
    let sides = box.zw - box.xy;
    // What is all that is seen of a small object stays.
    return f32(max(sides.x, sides.y)) < shortest && is_around(object, box, reach + 1);
}
