enable primitive_index;
// Which triangle of its mesh each pixel shows, and where in local space: drawn over the G-buffer's own depth for the objects whose
// style asks for it.
#import common/frame.wgsl
#import common/instance.wgsl

struct Vertex {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) local: vec3<f32>,
    @location(1) @interpolate(flat, first) first_triangle: u32,
}

@vertex
fn vs_main(instance: Instance, @location(0) position: vec3<f32>) -> Vertex {
    let pos_view = view_from_local(instance) * vec4(position, 1.0);
    return Vertex(frame.clip_from_view * pos_view, position, instance.ids.w);
}

// x: number of the triangle in its mesh, plus 1; 0: none. y, z, w: the place (bits of floats).
@fragment
fn fs_main(v: Vertex, @builtin(primitive_index) number: u32) -> @location(0) vec4<u32> {
    return vec4(v.first_triangle + number + 1u, bitcast<vec3<u32>>(v.local));
}
