// Hatching: tones by strokes of a pen (Bu et al. 2006, "Image-based Real-time Hatching of Scene Traveling").
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import common/surface_change.wgsl
#import effects/hatching/stripes.wgsl

const HATCHING: u32 = 7u;

// Whether any object is drawn in this way, and how strokes lie on any.
override WITH_HATCHING: bool = true;
override WITH_STRIPES: bool = true;
override WITH_SECOND: bool = true;
override WITH_THIRD: bool = true;

// As in src/render/effects/hatching.rs; 0: no hatching.
const STRIPES: u32 = 1u;

// Twin: `HatchingUniform` in src/render/effects/hatching.rs.
struct HatchingStyle {
    // To local space of the object's mesh.
    local_from_view: mat4x4<f32>,
    // Linear colours, and shares of the object's own.
    ink: vec3<f32>,
    ink_tint: f32,
    paper: vec3<f32>,
    paper_tint: f32,
    stroke: Stroke,
    // Darkness from which on more directions cross, and the greatest share of ink of one of them.
    second: f32,
    third: f32,
    greatest: f32,
    directions: u32,
    shadows_cross: u32,
    ambient: f32,
    own_color: f32,
    white: f32,
    darkest: f32,
    mapping: u32,
    // Of its stripes.
    frequency: f32,
    first_triangle: u32,
}

var<storage, read> hatching_styles: array<HatchingStyle>;
// The tone curve of each object.
var<storage, read> hatching_curves: array<f32>;
// See passes/triangle_map.wgsl.
var triangle_map_tex: texture_storage_2d<rgba32uint, read>;

// As in src/render/effects/hatching.rs.
const CURVE: u32 = 33u;

fn luminance_of(linear: vec3<f32>) -> f32 {
    return dot(linear, vec3(0.2126, 0.7152, 0.0722));
}

// Share of ink that a light asks for.
fn darkness(object: u32, light: f32) -> f32 {
    // As bright as it looks, not as it measures.
    let place = pow(clamp(light, 0.0, 1.0), 1.0 / 2.2) * f32(CURVE - 1u);
    let first = min(u32(place), CURVE - 2u);
    let i = object * CURVE + first;
    let tone = mix(hatching_curves[i], hatching_curves[i + 1u], place - f32(first));
    let white = hatching_styles[object].white;
    return clamp((1.0 - tone - white) / max(1.0 - white, 1e-3), 0.0, 1.0) * hatching_styles[object].darkest;
}

// How dark a point is, and how dark it would be without shadows that are thrown on it.
struct Dark {
    all: f32,
    form: f32,
}

fn dark_at(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> Dark {
    let object = s.object;
    var lit = vec3(hatching_styles[object].ambient);
    var form = lit;
    for (var i = 0u; i < frame.light_count; i++) {
        let l = towards_light(frame.lights[i], pos_view);
        let light = frame.lights[i].color * max(dot(s.normal, l), 0.0);
        form += light;
        lit += light * visibility(px, i);
    }
    let own = mix(1.0, luminance_of(base), hatching_styles[object].own_color);
    let all = darkness(object, luminance_of(lit) * own);
    return Dark(all, min(darkness(object, luminance_of(form) * own), all));
}

// What each direction draws, so that all of them over each other leave as much paper as is wanted.
fn split(object: u32, dark: Dark) -> vec3<f32> {
    let second = hatching_styles[object].second;
    let third = hatching_styles[object].third;
    let greatest = hatching_styles[object].greatest;
    let directions = hatching_styles[object].directions;
    if directions <= 1u {
        return vec3(min(dark.all, greatest), 0.0, 0.0);
    }
    let crosses = hatching_styles[object].shadows_cross == 1u && dark.form < dark.all;
    let own = select(dark.all, dark.form, crosses);
    let first = min(select(own, second + 0.35 * (own - second), own > second), greatest);
    // What is left to the others.
    let rest = 1.0 - (1.0 - dark.all) / max(1.0 - first, 1e-3);
    let first_there = min(second + 0.35 * max(third - second, 0.0), greatest);
    let limit = select(max(1.0 - (1.0 - third) / max(1.0 - first_there, 1e-3), 0.0), 0.5, crosses);
    var next = rest;
    if directions >= 3u && rest > limit {
        next = limit + 0.35 * (rest - limit);
    }
    next = clamp(next, 0.0, greatest);
    let last = 1.0 - (1.0 - rest) / max(1.0 - next, 1e-3);
    return vec3(first, next, select(0.0, clamp(last, 0.0, greatest), directions >= 3u));
}

// Strokes on the surface.
fn stripes_ink(px: vec2<i32>, s: Surfel, pos_view: vec3<f32>, inks: vec3<f32>) -> f32 {
    let object = s.object;
    let texel = textureLoad(triangle_map_tex, px);
    if texel.x == 0u {
        return 1.0 - (1.0 - inks.x) * (1.0 - inks.y) * (1.0 - inks.z);
    }
    let m = hatching_styles[object].local_from_view;
    let linear = mat3x3(m[0].xyz, m[1].xyz, m[2].xyz);
    let per_px = 2.0 * frame.half_extent / frame.size;
    let dx = linear * pos_change(pos_view, s.face_normal, vec3(per_px.x, 0.0, 0.0));
    let dy = linear * pos_change(pos_view, s.face_normal, vec3(0.0, -per_px.y, 0.0));
    let triangle = hatching_styles[object].first_triangle + texel.x - 1u;
    let stripes = stripes_of(triangle, bitcast<vec3<f32>>(texel.yzw), dx, dy, hatching_styles[object].frequency);
    let stroke = hatching_styles[object].stroke;
    var left = 1.0 - stripe_ink(stripes, 0u, stroke, inks.x);
    if WITH_SECOND && inks.y > 0.0 {
        left *= 1.0 - stripe_ink(stripes, 1u, stroke, inks.y);
    }
    if WITH_THIRD && inks.z > 0.0 {
        left *= 1.0 - stripe_ink(stripes, 2u, stroke, inks.z);
    }
    return 1.0 - left;
}

fn hatching(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    let object = s.object;
    let inks = split(object, dark_at(px, s, base, pos_view));
    var ink = 0.0;
    if WITH_STRIPES && hatching_styles[object].mapping == STRIPES {
        ink = stripes_ink(px, s, pos_view, inks);
    }
    let paper = hatching_styles[object].paper * mix(vec3(1.0), base, hatching_styles[object].paper_tint);
    let stroke = mix(hatching_styles[object].ink, base, hatching_styles[object].ink_tint);
    return mix(paper, stroke, ink);
}
