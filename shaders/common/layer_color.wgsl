// The base color of a layer (with the sRGB curve, as in passes/gbuffer.wgsl) as fragment lists keep it, so that both ways to
// make layers round it alike.

// Whether anybody asks for it; otherwise it is black.
override WITH_COLOR: bool = true;

fn pack_layer_color(color: vec4<f32>) -> u32 {
    if !WITH_COLOR {
        return 0u;
    }
    return pack4x8unorm(color);
}

fn unpack_layer_color(packed: u32) -> vec4<f32> {
    if !WITH_COLOR {
        return vec4(0.0, 0.0, 0.0, 1.0);
    }
    return unpack4x8unorm(packed);
}
