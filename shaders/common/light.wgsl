// Which share of a light reaches a pixel.
#import common/frame.wgsl

// Whether any light throws shadows.
override WITH_SHADOWS: bool = true;

// Of passes/shadow_mask.wgsl.
var shadow_mask_tex: texture_2d<f32>;

// 1: lit, 0: nothing of the light is left.
fn visibility(px: vec2<i32>, light: u32) -> f32 {
    let channel = frame.lights[light].shadow;
    if !WITH_SHADOWS || channel == 0u {
        return 1.0;
    }
    let mask = textureLoad(shadow_mask_tex, px, 0);
    return 1.0 - frame.shadow_density * (1.0 - mask[channel - 1u]);
}

// Up to which N·L a form's own shadow reaches.
const TERMINATOR: f32 = 0.25;

// How much of a light is missing at a pixel, for techniques that do not go by N·L alone. Towards the terminator the form's own
// shadow begins, softly where the surface is smooth: so that shadows neither end there nor show the facets of the mesh.
fn shadow_at(px: vec2<i32>, light: u32, n_l: f32) -> f32 {
    let own = frame.shadow_density * (1.0 - smoothstep(0.0, TERMINATOR, n_l));
    return max(1.0 - visibility(px, light), own * f32(frame.lights[light].shadow != 0u));
}

// What reaches a surface from all lights together, as a factor of its color.
fn light_at(px: vec2<i32>, normal: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    var light = vec3(0.0);
    for (var i = 0u; i < frame.light_count; i++) {
        let l = towards_light(frame.lights[i], pos_view);
        light += frame.lights[i].color * max(dot(normal, l), 0.0) * visibility(px, i);
    }
    return light;
}
