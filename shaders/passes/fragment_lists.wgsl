// All fragments of a group into lists, in one traversal. Those for which there is no room are counted all the same.
#import passes/gbuffer.wgsl
#import common/fragments.wgsl
#import common/counted.wgsl
#import common/layer_color.wgsl
#import gpu/parted_counter.wgsl

@group(1) @binding(0) var<storage, read_write> counted: Counted;
// The last fragment so far of each pixel.
@group(1) @binding(1) var<storage, read_write> heads: array<atomic<u32>>;
@group(1) @binding(2) var node_tex: texture_storage_2d<rgba32uint, write>;
@group(1) @binding(3) var payload_tex: texture_storage_2d<rgba32uint, write>;
@group(1) @binding(4) var<storage, read_write> colors: array<u32>;

fn next_index(px: vec2<u32>) -> u32 {
    let part = part_of(px);
    return index_of(part, atomicAdd(&counted.fragments[word_of(part)], 1u));
}

fn append(position: vec4<f32>, ids: vec4<u32>, drawn: GBuffer) {
    let index = next_index(vec2<u32>(position.xy));
    let capacity = textureDimensions(node_tex);
    if index < capacity.x * capacity.y {
        let next = atomicExchange(&heads[index_of_pixel(vec2<i32>(position.xy))], index + 1u);
        let node = FragmentNode(next, bitcast<u32>(position.z), order_of(ids), drawn.geometry.x);
        let payload = Payload(drawn.geometry.y, drawn.geometry.z, drawn.geometry.w, drawn.surface_id);
        textureStore(node_tex, texel_of_record(index), texel_of_node(node));
        textureStore(payload_tex, texel_of_record(index), texel_of_payload(payload));
        if WITH_COLOR {
            colors[index] = pack_layer_color(drawn.base_color);
        }
    }
}

@fragment
fn fs_lean_list(v: Lean) {
    append(v.position, v.ids, lean(v));
}

@fragment
fn fs_smooth_list(v: Smooth) {
    append(v.position, v.ids, smooth_surface(v));
}

@fragment
fn fs_colored_list(v: Colored) {
    append(v.position, v.ids, colored(v));
}

@fragment
fn fs_full_list(v: Full) {
    append(v.position, v.ids, full(v));
}
