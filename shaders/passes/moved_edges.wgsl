// The edge map of a sketch: each line where its noise moves it, as a whole, so that no part of it is lost or seen twice. What is
// made of it is made as of any other edge map; `source_tex` says where a line comes from.
#import common/frame.wgsl
#import common/plane.wgsl
#import common/edge_map.wgsl
#import common/pixel_list.wgsl
#import common/next_on_line.wgsl

// A pixel of a line becomes so many, or it would break up where it is longer.
const POINTS: u32 = 2u;

// Twin: `MovementUniform` in src/render/passes/moved_edges.rs.
struct Movement {
    // From noise to offsets, px, by rows.
    matrix: vec4<f32>,
    // Factor of all widths.
    width: f32,
    // So much farther, px, are lines looked for.
    margin: f32,
    // How much the pressure of the hand varies, 0 to 1.
    pressure: f32,
    // Which of the four noises of a texel is meant.
    component: u32,
}

var<uniform> movement: Movement;
// Not 0 where lines run.
var spine_tex: texture_2d<u32>;
// See passes/offset_field.wgsl.
var line_field_tex: texture_storage_2d<rgba32uint, read>;
// The greatest key of each pixel, and the greatest source of those that have it; 0 again once it has been put.
var<storage, read_write> keys: array<atomic<u32>>;
var<storage, read_write> winners: array<atomic<u32>>;
var moved_edge_tex: texture_storage_2d<rgba32uint, write>;
var moved_spine_tex: texture_storage_2d<r32uint, write>;
// The pixel of the edge map that a line comes from: column in the lower 16 bits, row in the upper ones.
var source_tex: texture_storage_2d<r32uint, write>;

fn noise_at(px: vec2<i32>) -> vec2<f32> {
    return unpack2x16float(textureLoad(line_field_tex, px)[movement.component]);
}

fn applied(noise: vec2<f32>) -> vec2<f32> {
    return vec2(dot(movement.matrix.xy, noise), dot(movement.matrix.zw, noise));
}

// How the offset changes per pixel along a line.
fn offset_along(px: vec2<i32>, edge: Edge, spine: vec2<f32>, tangent: vec2<f32>) -> vec2<f32> {
    let before = next_on_line(px, edge, spine, tangent, -1);
    let after = next_on_line(px, edge, spine, tangent, 1);
    let along = dot(after.away - before.away, tangent);
    return applied(noise_at(after.px) - noise_at(before.px)) / max(along, 0.5);
}

// How densely a hand presses where the noise is this.
fn pressed(noise: vec2<f32>) -> f32 {
    return mix(1.0 - movement.pressure, 1.0, smoothstep(-1.1, 1.1, 0.7 * (noise.x + noise.y)));
}

// A pixel of a line where it has been moved to.
struct Moved {
    edge: vec4<u32>,
    spine: u32,
    px: vec2<i32>,
    // The greatest counts: the nearest.
    key: u32,
    // Tells points of one depth apart, whatever order they are found in.
    rank: u32,
    source: u32,
    is_there: bool,
}

fn key_of(depth: f32) -> u32 {
    let bits = bitcast<u32>(nearness_of(depth));
    return max(select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u), 1u);
}

// A pixel of a line before it is moved.
struct Source {
    px: vec2<i32>,
    number: u32,
    edge: Edge,
    spine: vec2<f32>,
    noise: vec2<f32>,
    // Its tangent, as much longer as the line is where it has been moved to.
    turned: vec2<f32>,
}

// Whether a line runs at one of the listed pixels; others had one that was left out.
fn is_line(number: u32) -> bool {
    return textureLoad(spine_tex, unpack_pixel(number), 0).x != 0u;
}

fn source_at(number: u32) -> Source {
    let px = unpack_pixel(number);
    let edge = unpack_edge(textureLoad(edge_map_tex, px));
    let spine = vec2<f32>(px) + 0.5 + edge.offset;
    let tangent = unpack_tangent(edge.tangent);
    // What is drawn at x comes from x and its offset.
    return Source(px, number, edge, spine, noise_at(px), tangent - offset_along(px, edge, spine, tangent));
}

fn moved(source: Source, number: u32) -> Moved {
    let elongation = length(source.turned);
    // What is hardly longer stays as it is.
    let is_longer = elongation > 1.2;
    let share = select(0.0, (f32(number) + 0.5) / f32(POINTS) - 0.5, is_longer);
    let away = share * source.turned - applied(source.noise);
    // The pixel that its spine was found for moves with it, unless it would come to lie too far from it.
    let at = source.spine + away;
    let with_px = floor(vec2<f32>(source.px) + 0.5 + away);
    let to = select(floor(at), with_px, all(abs(at - with_px - 0.5) <= vec2(1.0)));
    var e = source.edge;
    e.offset = at - to - 0.5;
    e.extent = select(e.extent, max(e.extent, min(0.25 * elongation, 0.75)), is_longer);
    e.half_width = e.half_width * movement.width;
    e.weight = e.weight * pressed(source.noise);
    if elongation > 0.05 {
        e.tangent = pack_tangent(source.turned / elongation);
    }
    var texel = pack_edge(e);
    // As a stroke of a hand it stays one.
    texel.w |= textureLoad(edge_map_tex, source.px).w & STROKE;
    let own = textureLoad(spine_tex, source.px, 0).x;
    let radius = unpack2x16float(own >> 16u).x * movement.width + movement.margin;
    let found = (pack2x16float(vec2(radius, 0.0)) << 16u) | (texel.x & 0xffffu);
    let is_there = all(to >= vec2(0.0)) && all(to < frame.size) && (is_longer || number == 0u);
    let rank = (source.number << 1u) | number;
    return Moved(texel, found, vec2<i32>(to), key_of(e.depth), rank, source.number, is_there);
}

@compute @workgroup_size(GROUP)
fn cs_move(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count || !is_line(listed_pixels[id.x]) {
        return;
    }
    let source = source_at(listed_pixels[id.x]);
    for (var i = 0u; i < POINTS; i++) {
        let point = moved(source, i);
        if point.is_there {
            atomicMax(&keys[index_of_pixel(point.px)], point.key);
        }
    }
}

@compute @workgroup_size(GROUP)
fn cs_compare(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count || !is_line(listed_pixels[id.x]) {
        return;
    }
    let source = source_at(listed_pixels[id.x]);
    for (var i = 0u; i < POINTS; i++) {
        let point = moved(source, i);
        if point.is_there && atomicLoad(&keys[index_of_pixel(point.px)]) == point.key {
            atomicMax(&winners[index_of_pixel(point.px)], point.rank + 1u);
        }
    }
}

@compute @workgroup_size(GROUP)
fn cs_put(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count || !is_line(listed_pixels[id.x]) {
        return;
    }
    let source = source_at(listed_pixels[id.x]);
    for (var i = 0u; i < POINTS; i++) {
        let point = moved(source, i);
        if point.is_there && atomicLoad(&winners[index_of_pixel(point.px)]) == point.rank + 1u {
            // Nobody else asks any more: only one has this rank.
            atomicStore(&keys[index_of_pixel(point.px)], 0u);
            atomicStore(&winners[index_of_pixel(point.px)], 0u);
            textureStore(moved_edge_tex, point.px, point.edge);
            textureStore(moved_spine_tex, point.px, vec4(point.spine, 0u, 0u, 0u));
            textureStore(source_tex, point.px, vec4(point.source, 0u, 0u, 0u));
        }
    }
}
