// What is opaque in the composition: what is seen through is tested against it. Twin: src/render/passes/composition.rs.
#import common/gbuffer.wgsl
#import common/placed.wgsl

// The opaque surfaces, as `geometry_tex` has those of the layer.
var surface_tex: texture_storage_2d<rgba32uint, read>;
// Their ink; see common/placed.wgsl.
var opaque_ink_tex: texture_storage_2d<rgba32uint, read>;

// Whether there are any opaque surfaces, and whether any of them has lines.
override WITH_SURFACES: bool = true;
override WITH_OPAQUE_INK: bool = false;

fn surface_at(px: vec2<i32>) -> Surfel {
    if !WITH_SURFACES {
        return unpack_surfel(vec4(0u));
    }
    return unpack_surfel(textureLoad(surface_tex, px));
}

// What lies at a depth, with the opaque ink over it that is nearer: that reaches beyond its objects. It lies beneath all of the
// layers too; what these leave of it there and what is drawn of it here adds up to all of it.
fn beneath_opaque_ink(px: vec2<i32>, depth: f32, color: vec4<f32>) -> vec4<f32> {
    if !WITH_OPAQUE_INK {
        return color;
    }
    let texel = textureLoad(opaque_ink_tex, px);
    if texel.z == 0u || bitcast<f32>(texel.z) >= depth {
        return color;
    }
    let ink = placed_color(texel);
    return vec4(ink.rgb * color.a + (1.0 - ink.a) * color.rgb, color.a);
}
