// The base color of a layer as fragment lists keep it, so that both ways to make layers round it alike.
#import common/color.wgsl

// Whether anybody asks for it; otherwise it is black.
override WITH_COLOR: bool = true;

fn pack_color(color: vec4<f32>) -> u32 {
    if !WITH_COLOR {
        return 0u;
    }
    return pack4x8unorm(vec4(srgb_from_linear(color.rgb), color.a));
}

fn unpack_color(packed: u32) -> vec4<f32> {
    if !WITH_COLOR {
        return vec4(0.0, 0.0, 0.0, 1.0);
    }
    let color = unpack4x8unorm(packed);
    return vec4(linear_from_srgb(color.rgb), color.a);
}
