// Puts what passes/segments.wgsl found into the edge map. Of equal points of one pixel that of the first
// segment counts, so that it does not matter in which order they are found.
#import common/frame.wgsl
#import common/pixel.wgsl
#import gpu/record_list.wgsl
#import gpu/record_texture.wgsl
#import common/segment_point.wgsl
#import common/repeated.wgsl

// As many as there are steps that were kept.
var point_tex: texture_storage_2d<rgba32uint, read>;
// The greatest key of each pixel, and 0 again once it has been put.
var<storage, read_write> keys: array<u32>;
// For each pixel the inverted number of its point's segment; 0 again once it has been put.
var<storage, read_write> winners: array<atomic<u32>>;
var edge_tex: texture_storage_2d<rgba32uint, write>;
var spine_tex: texture_storage_2d<r32uint, write>;
var mark_tex: texture_storage_2d<r32uint, write>;

// Without repeated lines: the spines of all nearer layers, and to which of them those of this one are added.
var nearer_lines_tex: texture_storage_2d<r32uint, read>;
var accumulated_lines_tex: texture_storage_2d<r32uint, write>;

// Whether more points follow that have to be compared with these.
override KEEP_KEYS: bool = false;
// Whether they are of strokes of a hand. These lie beside their edges, so no pixel is marked as explained by an edge.
override WITHOUT_MARKS: bool = false;

fn point_at(number: u32) -> SegmentPoint {
    return point_of(texel_at(point_tex, 2u * number), texel_at(point_tex, 2u * number + 1u));
}

@compute @workgroup_size(GROUP)
fn cs_compare(@builtin(global_invocation_id) id: vec3<u32>) {
    let point = point_at(id.x);
    let index = index_of_pixel(unpack_pixel(point.px));
    if id.x < list.count && point.key != 0u && point.key == keys[index] {
        atomicMax(&winners[index], ~point.segment);
    }
}

fn is_winner(point: SegmentPoint, number: u32) -> bool {
    return number < list.count && point.key != 0u && atomicLoad(&winners[index_of_pixel(unpack_pixel(point.px))]) == ~point.segment;
}

fn put(point: SegmentPoint, px: vec2<i32>, spine: u32) {
    if !KEEP_KEYS {
        keys[index_of_pixel(px)] = 0u;
    }
    atomicStore(&winners[index_of_pixel(px)], 0u);
    textureStore(edge_tex, px, point.edge);
    textureStore(spine_tex, px, vec4(spine, 0u, 0u, 0u));
    if !WITHOUT_MARKS {
        textureStore(mark_tex, px, vec4(mark_of(point), 0u, 0u, 0u));
    }
}

@compute @workgroup_size(GROUP)
fn cs_put(@builtin(global_invocation_id) id: vec3<u32>) {
    let point = point_at(id.x);
    if is_winner(point, id.x) {
        put(point, unpack_pixel(point.px), point.spine);
    }
}

@compute @workgroup_size(GROUP)
fn cs_put_unrepeated(@builtin(global_invocation_id) id: vec3<u32>) {
    let point = point_at(id.x);
    if is_winner(point, id.x) {
        let px = unpack_pixel(point.px);
        let lines = nearer_lines_at(nearer_lines_tex, px, point.spine);
        put(point, px, lines.own);
        textureStore(accumulated_lines_tex, px, vec4(lines.now, 0u, 0u, 0u));
    }
}
