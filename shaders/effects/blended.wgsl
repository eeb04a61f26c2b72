// A depth layer of materials that blend: its lines over its shaded surfaces, as far as nothing opaque hides them.
#import passes/lines.wgsl
#import common/composition.wgsl

// Where nearer layers have lines; see passes/repeated.wgsl.
var nearer_lines_tex: texture_2d<u32>;
// Linear color times opacity, and opacity.
var shaded_tex: texture_2d<f32>;

// What lies so little behind an opaque surface, px, lies on it.
const ON: f32 = 0.05;

// The ink of a pixel, with the depth of its edge.
fn ink_at(px: vec2<i32>) -> Line {
    var line = lines_at(px, surface_at(px));
    if WITH_OPERATORS && textureLoad(nearer_lines_tex, px, 0).x != 0u {
        line.ink = vec4(0.0);
    }
    line.ink = beneath_opaque_ink(px, line.depth, line.ink);
    return line;
}

@fragment
fn fs_lines(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return ink_at(vec2<i32>(position.xy)).ink;
}

@fragment
fn fs_lines_placed(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let line = ink_at(vec2<i32>(position.xy));
    return pack_placed(line.ink, line.depth);
}

fn fill_at(px: vec2<i32>, depth: f32) -> vec4<f32> {
    let surface = surface_at(px);
    if surface.object != 0u && step_px(nearness_of(surface.depth) - nearness_of(depth), depth) > ON {
        discard;
    }
    return beneath_opaque_ink(px, depth, textureLoad(shaded_tex, px, 0));
}

@fragment
fn fs_fill(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    return fill_at(px, unpack_surfel(geometry_at(px)).depth);
}

@fragment
fn fs_fill_placed(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let px = vec2<i32>(position.xy);
    let depth = unpack_surfel(geometry_at(px)).depth;
    return pack_placed(fill_at(px, depth), depth);
}
