// Coordinates on the surfaces of the objects whose style asks for them, drawn over the G-buffer's own depth.
#import common/frame.wgsl
#import common/material.wgsl

// As in shaders/passes/gbuffer.wgsl.
struct Draw {
    view_from_local: mat4x4<f32>,
    normal_from_local: mat3x3<f32>,
    material: Material,
    object: u32,
    is_flat: u32,
    first_surface: u32,
}

@group(3) @binding(0) var<uniform> draw: Draw;

struct Vertex {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@vertex
fn vs_main(@location(0) position: vec3<f32>, @location(4) uv: vec2<f32>) -> Vertex {
    let pos_view = draw.view_from_local * vec4(position, 1.0);
    return Vertex(frame.clip_from_view * pos_view, uv);
}

// Half precision has its digits between 2^-14 and 2^16; changes per pixel are smaller than that.
const CHANGE_SCALE: f32 = 4096.0;

// x, y: texture coordinates (bits of floats); z, w: their change to the next pixel to the right and below, scaled, as
// pairs of halves.
@fragment
fn fs_main(v: Vertex) -> @location(0) vec4<u32> {
    let dx = clamp(dpdx(v.uv) * CHANGE_SCALE, vec2(-65000.0), vec2(65000.0));
    let dy = clamp(dpdy(v.uv) * CHANGE_SCALE, vec2(-65000.0), vec2(65000.0));
    return vec4(bitcast<vec2<u32>>(v.uv), pack2x16float(dx), pack2x16float(dy));
}
