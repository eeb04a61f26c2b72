// A look at the buffers that the picture is made from.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/color.wgsl
#import common/edge_map.wgsl

// Silhouette, border, object boundary, ridge, valley, material boundary, intersection, texture, relief,
// shadow, section.
const CLASS_COLORS = array<vec3<f32>, 11>(
    vec3(0.0), vec3(0.0, 0.35, 0.8), vec3(0.45, 0.0, 0.6), vec3(0.85, 0.25, 0.0), vec3(0.0, 0.5, 0.15),
    vec3(0.5, 0.4, 0.0), vec3(0.9, 0.0, 0.35), vec3(0.0, 0.6, 0.6),
    vec3(0.6, 0.3, 0.5), vec3(0.35, 0.35, 0.45), vec3(0.9, 0.6, 0.0),
);

var surface_id_tex: texture_2d<u32>;
var base_color_tex: texture_2d<f32>;
var edge_map_tex: texture_storage_2d<rgba32uint, read>;
var operators_tex: texture_2d<f32>;

fn surfel(px: vec2<i32>) -> Surfel {
    return unpack_surfel(geometry_at(px));
}

// A light color for each number; none is close to the white of the background.
fn color_of(number: u32) -> vec3<f32> {
    var h = number * 2654435769u;
    h ^= h >> 15u;
    h *= 2246822519u;
    h ^= h >> 13u;
    return 0.15 + 0.7 * vec3(f32(h & 255u), f32((h >> 8u) & 255u), f32((h >> 16u) & 255u)) / 255.0;
}

@fragment
fn fs_normals(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let s = surfel(vec2<i32>(position.xy));
    let n = select(vec3(0.0, 0.0, 1.0), s.normal, s.object != 0u);
    return vec4(0.5 + 0.5 * n, 1.0);
}

@fragment
fn fs_face_normals(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let s = surfel(vec2<i32>(position.xy));
    let n = select(vec3(0.0, 0.0, 1.0), s.face_normal, s.object != 0u);
    return vec4(0.5 + 0.5 * n, 1.0);
}

@fragment
fn fs_depth(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let s = surfel(vec2<i32>(position.xy));
    let range = frame.depth_range;
    let z = clamp((s.depth - range.x) / (range.y - range.x), 0.0, 1.0);
    return vec4(vec3(select(1.0, z, s.object != 0u)), 1.0);
}

@fragment
fn fs_objects(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let s = surfel(vec2<i32>(position.xy));
    return vec4(select(vec3(1.0), color_of(s.object), s.object != 0u), 1.0);
}

@fragment
fn fs_surfaces(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let s = surfel(px);
    let surface_id = textureLoad(surface_id_tex, px, 0).x;
    return vec4(select(vec3(1.0), color_of(surface_id), s.object != 0u), 1.0);
}

@fragment
fn fs_base_color(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let base = textureLoad(base_color_tex, px, 0).rgb;
    return vec4(select(vec3(1.0), srgb_from_linear(base), surfel(px).object != 0u), 1.0);
}

@fragment
fn fs_normal_operator(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return vec4(vec3(max(textureLoad(operators_tex, vec2<i32>(position.xy), 0).x, 0.0)), 1.0);
}

@fragment
fn fs_depth_operator(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return vec4(vec3(textureLoad(operators_tex, vec2<i32>(position.xy), 0).y), 1.0);
}

@fragment
fn fs_c1_operator(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return vec4(vec3(1.0 - textureLoad(operators_tex, vec2<i32>(position.xy), 0).z), 1.0);
}

@fragment
fn fs_edge_map(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let texel = textureLoad(edge_map_tex, vec2<i32>(position.xy));
    if class_of(texel) == OPERATOR_INK {
        let ink = operator_ink(texel);
        return vec4(vec3(1.0 - max(ink.x, ink.y)), 1.0);
    }
    // A color for each class.
    let weight = unpack_edge(texel).weight * select(0.0, 1.0, texel.x != 0u);
    return vec4(mix(vec3(1.0), CLASS_COLORS[max(class_of(texel), 1u) - 1u], weight), 1.0);
}
