// How much of each light that throws shadows reaches a pixel, from the maps of passes/shadow_map.wgsl.
//
// Each texel of a map is compared with the depth that the receiver's own plane has at the texel's center, which is
// known from the G-buffer's face normal: no plane shadows itself, however it is tilted.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl

// How many lights there are, whether any has central rays, and whether borders are soft.
override WITH_SECOND: bool = true;
override WITH_THIRD: bool = true;
override WITH_FOURTH: bool = true;
override WITH_CENTRAL: bool = true;
override WITH_SOFT: bool = true;

// One picture that a light sees. Light space: it looks along −Z. Twin: `GpuLightView` in
// src/render/passes/shadow_mask.rs.
struct LightView {
    light_from_view: mat4x4<f32>,
    // From x and y, for central rays at distance 1, to texels.
    scale: vec2<f32>,
    origin: vec2<f32>,
    // First and last texel of its part of the map.
    tile_min: vec2<f32>,
    tile_max: vec2<f32>,
    // Nearest and farthest distance.
    range: vec2<f32>,
    // Width of a texel, for central rays at distance 1.
    texel: f32,
    is_central: u32,
}

// Twin: `GpuShadowLight` in src/render/passes/shadow_mask.rs.
struct ShadowLight {
    // Its pictures.
    @align(16) first: u32,
    count: u32,
    // Tangent of the light's radius as seen from the receiver.
    spread: f32,
}

var<storage, read> shadow_lights: array<ShadowLight>;
var<storage, read> light_views: array<LightView>;
var map_0: texture_depth_2d;
var map_1: texture_depth_2d;
var map_2: texture_depth_2d;
var map_3: texture_depth_2d;

// How far something must stand out of the receiver's plane to shadow it, in texels' widths: at least, and for each
// texel of distance in the map, so that the far side of a valley does not shadow this one.
const LEAST: f32 = 0.5;
const PER_TEXEL: f32 = 1.5;
// More where light grazes, up to a tangent: what is known of the plane is inexact.
const PER_SLOPE: f32 = 0.2;
const STEEPEST: f32 = 10.0;
// Light that grazes a surface at less than this cosine lights nothing.
const GRAZING: f32 = 1e-3;
const TAPS: u32 = 16u;
const GOLDEN_ANGLE: f32 = 2.399963;

// A plane as a light sees it. What a map holds, its nearness, is affine over it.
struct Receiver {
    // Place in the map, texels.
    texel: vec2<f32>,
    tile_min: vec2<f32>,
    tile_max: vec2<f32>,
    nearness: f32,
    // Change of nearness per texel.
    slope: vec2<f32>,
    // Nearness per unit of length, about here.
    per_unit: f32,
    // Width of a texel here.
    width: f32,
    // Texels per unit of length here.
    texels_per_unit: vec2<f32>,
    // Tangent of the angle between the light and the plane's normal, or `STEEPEST`.
    tilt: f32,
    // Greatest height above the plane at which anything may be.
    room: f32,
    faces_light: bool,
}

fn is_central(view: u32) -> bool {
    return WITH_CENTRAL && light_views[view].is_central == 1u;
}

fn receiver(view: u32, pos_view: vec3<f32>, normal_view: vec3<f32>) -> Receiver {
    let m = light_views[view].light_from_view;
    let p = (m * vec4(pos_view, 1.0)).xyz;
    let n = (m * vec4(normal_view, 0.0)).xyz;
    let scale = light_views[view].scale;
    let range = light_views[view].range;
    var r: Receiver;
    r.tile_min = light_views[view].tile_min;
    r.tile_max = light_views[view].tile_max;
    let distance = -p.z;
    var facing = n.z;
    if is_central(view) {
        r.texel = p.xy / distance * scale + light_views[view].origin;
        r.nearness = range.x / distance;
        r.per_unit = r.nearness / distance;
        let d = dot(n, p);
        facing = -d / length(p);
        r.slope = range.x * n.xy / min(d, -1e-20) / scale;
        r.width = light_views[view].texel * distance;
        r.texels_per_unit = abs(scale) / distance;
    } else {
        r.texel = p.xy * scale + light_views[view].origin;
        r.per_unit = 1.0 / (range.y - range.x);
        r.nearness = (range.y - distance) * r.per_unit;
        r.slope = -n.xy / max(n.z, 1e-6) * r.per_unit / scale;
        r.width = light_views[view].texel;
        r.texels_per_unit = abs(scale);
    }
    r.room = distance - range.x;
    r.faces_light = facing > GRAZING;
    r.tilt = min(sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, GRAZING), STEEPEST);
    return r;
}

// How far something stands out of the receiver's plane at a texel, towards the light.
fn height(map: texture_depth_2d, r: Receiver, texel: vec2<f32>) -> f32 {
    let at = clamp(texel, r.tile_min, r.tile_max);
    let nearness = textureLoad(map, vec2<i32>(at), 0);
    return (nearness - r.nearness - dot(r.slope, at + 0.5 - r.texel)) / r.per_unit;
}

// The share of light at hard borders: the nearest texels, weighted by a quadratic B-spline.
fn hard(map: texture_depth_2d, r: Receiver) -> f32 {
    let center = floor(r.texel);
    let f = r.texel - center - 0.5;
    let before = 0.5 * (0.5 - f) * (0.5 - f);
    let after = 0.5 * (0.5 + f) * (0.5 + f);
    let weights_x = vec3(before.x, 0.75 - f.x * f.x, after.x);
    let weights_y = vec3(before.y, 0.75 - f.y * f.y, after.y);
    var light = 0.0;
    for (var y = 0; y < 3; y++) {
        for (var x = 0; x < 3; x++) {
            let offset = vec2(f32(x), f32(y)) - 1.0;
            let free = (LEAST + PER_TEXEL * length(offset - f) + PER_SLOPE * r.tilt) * r.width;
            let is_lit = height(map, r, center + offset) <= free;
            light += select(0.0, weights_x[x] * weights_y[y], is_lit);
        }
    }
    return light;
}

// The share of light of a source that is not a point: how much of it is hidden by what stands out of the plane, on
// average as far as the blockers do (Fernando 2005, "Percentage-Closer Soft Shadows"). Only what stands high enough to
// hide a part of the source counts, so that a surface does not shadow itself.
fn soft(map: texture_depth_2d, r: Receiver, spread: f32) -> f32 {
    let free = (LEAST + PER_TEXEL + PER_SLOPE * r.tilt) * r.width;
    // Another turn in every sample, so that their mean is smooth.
    let turn = round(1.0 / frame.sample_weight) * 2.618034;
    let reach = r.room * spread;
    var blockers = 0.0;
    var total = 0.0;
    for (var i = 0u; i < TAPS; i++) {
        // Denser in the middle, where low blockers are.
        let share = (f32(i) + 0.5) / f32(TAPS);
        let radius = reach * share * share;
        let angle = f32(i) * GOLDEN_ANGLE + turn;
        let texel = r.texel + vec2(cos(angle), sin(angle)) * radius * r.texels_per_unit;
        let above = height(map, r, floor(texel));
        let blocks = above > free && above * spread >= radius;
        blockers += select(0.0, 1.0, blocks);
        total += select(0.0, above, blocks);
    }
    let radius = total / max(blockers, 1.0) * spread;
    if radius < 1.5 * r.width {
        return hard(map, r);
    }
    var light = 0.0;
    for (var i = 0u; i < TAPS; i++) {
        let at = radius * sqrt((f32(i) + 0.5) / f32(TAPS));
        let angle = f32(i) * GOLDEN_ANGLE + turn;
        let texel = r.texel + vec2(cos(angle), sin(angle)) * at * r.texels_per_unit;
        let above = height(map, r, floor(texel));
        light += select(1.0, 0.0, above > free && above * spread >= 0.25 * at);
    }
    return light / f32(TAPS);
}

// The picture of a light in which a point is seen: that whose axis is nearest.
fn view_of(light: u32, pos_view: vec3<f32>) -> u32 {
    var best = shadow_lights[light].first;
    if WITH_CENTRAL && shadow_lights[light].count > 1u {
        var farthest = 0.0;
        for (var i = 0u; i < shadow_lights[light].count; i++) {
            let view = shadow_lights[light].first + i;
            let distance = -(light_views[view].light_from_view * vec4(pos_view, 1.0)).z;
            if distance > farthest {
                farthest = distance;
                best = view;
            }
        }
    }
    return best;
}

fn light_share(map: texture_depth_2d, light: u32, pos_view: vec3<f32>, normal: vec3<f32>) -> f32 {
    let r = receiver(view_of(light, pos_view), pos_view, normal);
    if !r.faces_light {
        return 0.0;
    }
    if WITH_SOFT {
        return soft(map, r, shadow_lights[light].spread);
    }
    return hard(map, r);
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let s = unpack_surfel(geometry_at(px));
    let pos_view = pos_view_of(px, s.depth);
    var shares = vec4(1.0);
    shares.x = light_share(map_0, 0u, pos_view, s.face_normal);
    if WITH_SECOND {
        shares.y = light_share(map_1, 1u, pos_view, s.face_normal);
    }
    if WITH_THIRD {
        shares.z = light_share(map_2, 2u, pos_view, s.face_normal);
    }
    if WITH_FOURTH {
        shares.w = light_share(map_3, 3u, pos_view, s.face_normal);
    }
    return shares;
}
