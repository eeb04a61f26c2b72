// Coordinates on the surfaces of the objects whose style asks for them, drawn over the G-buffer's own depth.
#import common/frame.wgsl
#import common/instance.wgsl

struct Vertex {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@vertex
fn vs_main(instance: Instance, @location(0) position: vec3<f32>, @location(4) uv: vec2<f32>) -> Vertex {
    let pos_view = view_from_local(instance) * vec4(position, 1.0);
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
