// One depth layer into a G-buffer: fragments that do not lie behind the last layer are rejected, of the others the ordinary
// depth test leaves the nearest (blueprints paper, section 3, Fig. 2).
#import passes/gbuffer.wgsl
#import common/layer_color.wgsl

// Sort keys of the last layer; before the first one, depth 1 and order 0 everywhere. For `color`: of the layer itself.
@group(1) @binding(0) var last_key_tex: texture_storage_2d<rg32uint, read>;

struct Layer {
    @location(0) geometry: vec4<u32>,
    @location(1) surface_id: u32,
    // Reversed depth, as bits, and of which draw and surface it is; 0: nothing.
    @location(2) sort_key: vec2<u32>,
    // Where it is asked for.
    @location(3) base_color: vec4<f32>,
}

fn sort_key_of(position: vec4<f32>, ids: vec4<u32>) -> vec2<u32> {
    return vec2(bitcast<u32>(position.z), order_of(ids));
}

fn layer(position: vec4<f32>, ids: vec4<u32>, drawn: GBuffer) -> Layer {
    let last = textureLoad(last_key_tex, vec2<i32>(position.xy)).xy;
    let sort_key = sort_key_of(position, ids);
    // Bits of positive numbers are ordered as these are.
    let is_behind = sort_key.x < last.x || (sort_key.x == last.x && sort_key.y > last.y);
    if !is_behind {
        discard;
    }
    return Layer(drawn.geometry, drawn.surface_id, sort_key, unpack_layer_color(pack_layer_color(drawn.base_color)));
}

@fragment
fn fs_lean_layer(v: Lean) -> Layer {
    return layer(v.position, v.ids, lean(v));
}

@fragment
fn fs_smooth_layer(v: Smooth) -> Layer {
    return layer(v.position, v.ids, smooth_surface(v));
}

@fragment
fn fs_colored_layer(v: Colored) -> Layer {
    return layer(v.position, v.ids, colored(v));
}

@fragment
fn fs_full_layer(v: Full) -> Layer {
    return layer(v.position, v.ids, full(v));
}

// Where a layer has anything, and nothing else of it.

@fragment
fn fs_lean_counted(v: Lean) -> @location(0) u32 {
    return layer(v.position, v.ids, lean(v)).surface_id;
}

@fragment
fn fs_smooth_counted(v: Smooth) -> @location(0) u32 {
    return layer(v.position, v.ids, smooth_surface(v)).surface_id;
}

@fragment
fn fs_colored_counted(v: Colored) -> @location(0) u32 {
    return layer(v.position, v.ids, colored(v)).surface_id;
}

@fragment
fn fs_full_counted(v: Full) -> @location(0) u32 {
    return layer(v.position, v.ids, full(v)).surface_id;
}

// The base color of a layer that has been drawn, where a pass has no room for it beside the rest.

fn color(position: vec4<f32>, ids: vec4<u32>, drawn: GBuffer) -> vec4<f32> {
    if any(sort_key_of(position, ids) != textureLoad(last_key_tex, vec2<i32>(position.xy)).xy) {
        discard;
    }
    return unpack_layer_color(pack_layer_color(drawn.base_color));
}

@fragment
fn fs_lean_color(v: Lean) -> @location(0) vec4<f32> {
    return color(v.position, v.ids, lean(v));
}

@fragment
fn fs_smooth_color(v: Smooth) -> @location(0) vec4<f32> {
    return color(v.position, v.ids, smooth_surface(v));
}

@fragment
fn fs_colored_color(v: Colored) -> @location(0) vec4<f32> {
    return color(v.position, v.ids, colored(v));
}

@fragment
fn fs_full_color(v: Full) -> @location(0) vec4<f32> {
    return color(v.position, v.ids, full(v));
}
