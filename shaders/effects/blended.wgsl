// A depth layer of materials that blend: its lines over its shaded surfaces, as far as nothing opaque hides them.
#import passes/lines.wgsl

// The opaque surfaces, as `geometry_tex` has those of the layer.
@group(1) @binding(6) var surface_tex: texture_2d<u32>;
// Their lines: coverage and linear depth.
@group(1) @binding(7) var cover_tex: texture_2d<f32>;
// Where nearer layers have lines; see passes/repeated.wgsl.
@group(1) @binding(8) var seen_tex: texture_2d<u32>;
// Linear colour times opacity, and opacity.
@group(1) @binding(9) var shaded_tex: texture_2d<f32>;

// What lies so little behind an opaque surface, px, lies on it.
const ON: f32 = 0.05;

// Whether anything opaque has lines.
override WITH_COVER: bool = false;

fn surface_at(px: vec2<i32>) -> Surfel {
    return unpack_surfel(textureLoad(surface_tex, px, 0));
}

// The share of a pixel that opaque lines leave of what lies at a depth: they reach beyond their objects.
fn uncovered(px: vec2<i32>, depth: f32) -> f32 {
    if !WITH_COVER {
        return 1.0;
    }
    let cover = textureLoad(cover_tex, px, 0);
    return select(1.0, 1.0 - cover.x, cover.y < depth);
}

@fragment
fn fs_cover(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let line = lines_at(px, unpack_surfel(geometry_at(px)));
    return vec4(line.ink.a, line.depth, 0.0, 0.0);
}

@fragment
fn fs_lines(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let line = lines_at(px, surface_at(px));
    if WITH_PAPER && textureLoad(seen_tex, px, 0).x != 0u {
        return vec4(0.0);
    }
    return line.ink * uncovered(px, line.depth);
}

@fragment
fn fs_surface(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let depth = unpack_surfel(geometry_at(px)).depth;
    let surface = surface_at(px);
    if surface.object != 0u && step_px(nearness_of(surface.depth) - nearness_of(depth), depth) > ON {
        discard;
    }
    return textureLoad(shaded_tex, px, 0) * uncovered(px, depth);
}
