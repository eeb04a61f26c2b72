// A depth layer of materials that blend: its lines over its shaded surfaces, as far as nothing opaque hides them.
#import passes/lines.wgsl

// The opaque surfaces, as `geometry_tex` has those of the layer.
var surface_tex: texture_storage_2d<rgba32uint, read>;
// Their lines. x, y: linear colour times coverage, and coverage, as halves; z: linear depth (bits of a float).
var cover_tex: texture_storage_2d<rgba32uint, read>;
// Where nearer layers have lines; see passes/repeated.wgsl.
var seen_tex: texture_2d<u32>;
// Linear colour times opacity, and opacity.
var shaded_tex: texture_2d<f32>;

// What lies so little behind an opaque surface, px, lies on it.
const ON: f32 = 0.05;

// Whether anything opaque has lines.
override WITH_COVER: bool = false;

fn surface_at(px: vec2<i32>) -> Surfel {
    return unpack_surfel(textureLoad(surface_tex, px));
}

// What lies at a depth, with the opaque lines over it that are nearer: they reach beyond their objects. They lie beneath
// all of the layers too; what these leave of them there and what is drawn of them here adds up to all of them.
fn beneath_lines(px: vec2<i32>, depth: f32, color: vec4<f32>) -> vec4<f32> {
    if !WITH_COVER {
        return color;
    }
    let cover = textureLoad(cover_tex, px);
    if cover.z == 0u || bitcast<f32>(cover.z) >= depth {
        return color;
    }
    let ink = vec4(unpack2x16float(cover.x), unpack2x16float(cover.y));
    return vec4(ink.rgb * color.a + (1.0 - ink.a) * color.rgb, color.a);
}

@fragment
fn fs_cover(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let px = vec2<i32>(position.xy);
    let line = lines_at(px, unpack_surfel(geometry_at(px)));
    return vec4(pack2x16float(line.ink.rg), pack2x16float(line.ink.ba), bitcast<u32>(line.depth), 0u);
}

@fragment
fn fs_lines(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let line = lines_at(px, surface_at(px));
    if WITH_PAPER && textureLoad(seen_tex, px, 0).x != 0u {
        return vec4(0.0);
    }
    return beneath_lines(px, line.depth, line.ink);
}

@fragment
fn fs_surface(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let depth = unpack_surfel(geometry_at(px)).depth;
    let surface = surface_at(px);
    if surface.object != 0u && step_px(nearness_of(surface.depth) - nearness_of(depth), depth) > ON {
        discard;
    }
    return beneath_lines(px, depth, textureLoad(shaded_tex, px, 0));
}
