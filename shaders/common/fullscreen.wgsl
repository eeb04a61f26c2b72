// One triangle that covers the picture.

@vertex
fn vs_fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2(f32(index & 1u), f32(index >> 1u));
    // Behind everything, but before the cleared 0: see `DepthRule` in src/gpu/depth_rules.rs.
    return vec4(corner * 4.0 - 1.0, 1e-30, 1.0);
}
