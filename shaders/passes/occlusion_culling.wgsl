// Leaves out draws that lie behind what has been drawn, by their boxes.
#import common/frame.wgsl
#import gpu/neighbors.wgsl

// Pixels per side of a block; twin of `BLOCK` in src/render/passes/occlusion_culling.rs.
const BLOCK: i32 = 8;
// Draws in a row of workgroups; twin of `COLUMNS` there.
const COLUMNS: u32 = 1024u;

// Reversed: 0 where nothing is drawn.
var depth_tex: texture_depth_2d;
// Bits of floats.
var finding_tex: texture_storage_2d<r32uint, write>;
// The same.
var farthest_tex: texture_2d<u32>;

// The farthest depth of each block.
@compute @workgroup_size(8, 8)
fn cs_farthest(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = BLOCK * vec2<i32>(id.xy);
    if any(first >= vec2<i32>(frame.size)) {
        return;
    }
    var farthest = vec4(1.0);
    for (var i = 0; i < BLOCK * BLOCK / 4; i++) {
        // Four pixels around a corner; beyond the picture those at its border.
        let corner = first + 2 * vec2(i % (BLOCK / 2), i / (BLOCK / 2)) + 1;
        farthest = min(farthest, textureGather(depth_tex, nearest, vec2<f32>(corner) / frame.size));
    }
    let least = min(min(farthest.x, farthest.y), min(farthest.z, farthest.w));
    textureStore(finding_tex, vec2<i32>(id.xy), vec4(bitcast<u32>(least), 0u, 0u, 0u));
}

// Twin: `Extent` in src/render/base/view.rs.
struct Extent {
    // Left, top, right and bottom edge, px.
    rect: vec4<u32>,
    // Reversed depth of its nearest point.
    nearest: f32,
}

// Arguments of an indirect draw.
struct Draw {
    index_count: u32,
    instance_count: u32,
    first_index: u32,
    base_vertex: u32,
    first_instance: u32,
}

var<storage, read> extents: array<Extent>;
var<storage, read_write> draws: array<Draw>;

var<workgroup> is_seen: atomic<u32>;

// Each workgroup tests one draw.
@compute @workgroup_size(64)
fn cs_cull(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) index: u32) {
    let number = group.y * COLUMNS + group.x;
    if number >= arrayLength(&draws) {
        return;
    }
    let extent = extents[number];
    let first = vec2<i32>(extent.rect.xy) / BLOCK;
    let size = (vec2<i32>(extent.rect.zw) + BLOCK - 1) / BLOCK - first;
    var seen = false;
    for (var i = i32(index); i < size.x * size.y && !seen; i += 64) {
        let block = first + vec2(i % size.x, i / size.x);
        seen = bitcast<f32>(textureLoad(farthest_tex, block, 0).x) <= extent.nearest;
    }
    if seen {
        atomicStore(&is_seen, 1u);
    }
    workgroupBarrier();
    if index == 0u {
        draws[number].instance_count = atomicLoad(&is_seen);
    }
}
