// Depth as a light sees it.
#import common/frame.wgsl
#import common/material.wgsl

// Twin: `ShadowDraw` in src/render/passes/shadow_map.rs.
struct ShadowDraw {
    clip_from_local: mat4x4<f32>,
    material: Material,
    // What lies behind the section plane is left out: its product with (position, 1) is the distance before it.
    section: vec4<f32>,
}

@group(2) @binding(0) var base_tex: texture_2d<f32>;
@group(2) @binding(1) var base_sampler: sampler;

@group(3) @binding(0) var<uniform> draw: ShadowDraw;

@vertex
fn vs_main(@location(0) position: vec3<f32>) -> @builtin(position) @invariant vec4<f32> {
    return draw.clip_from_local * vec4(position, 1.0);
}

struct Clipped {
    @builtin(position) @invariant position: vec4<f32>,
    // Distance before the section plane.
    @location(0) lead: f32,
}

fn lead_of(position: vec3<f32>) -> f32 {
    return dot(draw.section, vec4(position, 1.0));
}

@vertex
fn vs_clipped(@location(0) position: vec3<f32>) -> Clipped {
    return Clipped(draw.clip_from_local * vec4(position, 1.0), lead_of(position));
}

@fragment
fn fs_clipped(v: Clipped) {
    if v.lead < 0.0 {
        discard;
    }
}

struct Holes {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) alpha: f32,
    @location(2) lead: f32,
}

@vertex
fn vs_holes(
    @location(0) position: vec3<f32>,
    @location(4) uv: vec2<f32>,
    @location(5) color: vec4<f32>,
) -> Holes {
    let uv_base = (draw.material.base_uv * vec3(uv, 1.0)).xy;
    return Holes(draw.clip_from_local * vec4(position, 1.0), uv_base, color.a, lead_of(position));
}

// Light falls through the holes that passes/gbuffer.wgsl leaves.
@fragment
fn fs_holes(v: Holes) {
    let alpha = textureSample(base_tex, base_sampler, v.uv).a * draw.material.base_color.a * v.alpha;
    if alpha < draw.material.alpha_cutoff || v.lead < 0.0 {
        discard;
    }
}
