// Pieces of lines that are too short to tell anything and that nothing continues.
#import common/frame.wgsl
#import common/gbuffer.wgsl

var spine_tex: texture_2d<u32>;

// Pieces are followed so far, px: a row of what is around a pixel is the bits of a number.
const FARTHEST: i32 = 15;
const ROWS: i32 = 2 * FARTHEST + 1;

// Beyond the picture lines may go on.
fn is_line(px: vec2<i32>) -> bool {
    let is_inside = all(px >= vec2(0)) && all(px < vec2<i32>(frame.size));
    return !is_inside || textureLoad(spine_tex, px, 0).x != 0u;
}

// The corners of the box around all that is connected to a pixel of a line, as far as it is within `reach` of it, px. A gap of one
// pixel interrupts no line.
fn box_around(px: vec2<i32>, reach: i32) -> vec4<i32> {
    let last = 2 * reach;
    var lines: array<u32, ROWS>;
    var own: array<u32, ROWS>;
    for (var y = 0; y <= last; y++) {
        for (var x = 0; x <= last; x++) {
            lines[y] |= select(0u, 1u << u32(x), is_line(px + vec2(x, y) - reach));
        }
    }
    own[reach] = 1u << u32(reach);
    var is_growing = true;
    while is_growing {
        is_growing = false;
        for (var y = 0; y <= last; y++) {
            let beside = own[max(y - 1, 0)] | own[y] | own[min(y + 1, last)];
            let rows = own[max(y - 2, 0)] | beside | own[min(y + 2, last)];
            let grown = (rows | (rows << 1u) | (rows >> 1u) | (rows << 2u) | (rows >> 2u)) & lines[y];
            is_growing = is_growing || grown != own[y];
            own[y] = grown;
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
