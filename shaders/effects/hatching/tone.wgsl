// How dark hatching is at a pixel, and what of it each direction of strokes draws.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import common/pixel.wgsl
#import effects/hatching/indication.wgsl
#import effects/hatching/stripes.wgsl
#import effects/hatching/style.wgsl
#import gpu/record_texture.wgsl

override WITH_INDICATION: bool = false;

// As in src/render/effects/hatching.rs.
const CURVE: u32 = 33u;

fn tone_sample(object: u32, number: u32) -> f32 {
    return hatching_styles[object].curve[number / 4u][number % 4u];
}

fn luminance_of(linear: vec3<f32>) -> f32 {
    return dot(linear, vec3(0.2126, 0.7152, 0.0722));
}

// Share of ink that a light asks for.
fn darkness(object: u32, light: f32) -> f32 {
    // As bright as it looks, not as it measures.
    let place = pow(clamp(light, 0.0, 1.0), 1.0 / 2.2) * f32(CURVE - 1u);
    let first = min(u32(place), CURVE - 2u);
    let tone = mix(tone_sample(object, first), tone_sample(object, first + 1u), place - f32(first));
    let white = hatching_styles[object].white;
    return clamp((1.0 - tone - white) / max(1.0 - white, 1e-3), 0.0, 1.0) * hatching_styles[object].darkest;
}

// How dark a point is, and how dark it would be without shadows that are thrown on it.
struct Dark {
    all: f32,
    form: f32,
    // Whether the first light does not reach it.
    is_in_shadow: bool,
}

fn dark_at(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> Dark {
    let object = s.object;
    var lit = vec3(hatching_styles[object].ambient);
    var form = lit;
    var first = 0.0;
    for (var i = 0u; i < frame.light_count; i++) {
        let l = towards_light(frame.lights[i], pos_view);
        let light = frame.lights[i].color * max(dot(s.normal, l), 0.0);
        form += light;
        let reaches = visibility(px, i);
        lit += light * reaches;
        if i == 0u {
            first = reaches * dot(s.normal, l);
        }
    }
    let own = mix(1.0, luminance_of(base), hatching_styles[object].object_tone);
    let all = darkness(object, luminance_of(lit) * own);
    return Dark(all, min(darkness(object, luminance_of(form) * own), all), first < 0.02);
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

// How much detail a pixel gets, 0 to 1.
fn detail_at(px: vec2<i32>, texel: vec4<u32>, s: Surfel) -> f32 {
    let object = s.object;
    let indication = hatching_styles[object].indication;
    if indication.by_fields == 1u {
        var part = 0u;
        if hatching_styles[object].frequency > 0.0 && texel.x != 0u && hatching_styles[object].mapping != BY_UV {
            part = texel_at(stripe_triangles, hatching_styles[object].first_triangle + texel.x - 1u).w;
        }
        let w1 = patch_field(part, bitcast<vec3<f32>>(texel.yzw), indication);
        let w2 = silhouette_field(px, s, indication);
        return clamp(indication.patch_share * w1 + indication.silhouette_share * w2, 0.0, 1.0);
    }
    // A layer without lines has nothing that strokes could be near to.
    if textureDimensions(nearest_edge_tex).x <= 1u {
        return 1.0;
    }
    let found = textureLoad(nearest_edge_tex, px).x;
    let edge = pixel_of(found);
    // No farther has been looked.
    let most = 8.0 * indication.distance;
    let away = select(distance(vec2<f32>(edge), vec2<f32>(px)), most, found == 0u);
    // The line may be that of an object which attracts details, and is not hatched itself.
    let owner = unpack_surfel(geometry_at(edge)).object;
    let attraction = select(indication.attraction, hatching_styles[owner].indication.attraction, found != 0u && hatching_styles[owner].mapping != 0u);
    return line_field(indication, attraction, min(away, most));
}

// Darkness with fewer strokes where there is little detail; darks keep theirs.
fn indicated(object: u32, detail: f32, dark: f32) -> f32 {
    return dark * (1.0 - hatching_styles[object].indication.amount * (1.0 - detail) * (1.0 - smoothstep(0.45, 0.8, dark)));
}

// With fewer strokes away from details.
fn indicated_dark_at(px: vec2<i32>, texel: vec4<u32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> Dark {
    var dark = dark_at(px, s, base, pos_view);
    if WITH_INDICATION && hatching_styles[s.object].indication.amount > 0.0 {
        let detail = detail_at(px, texel, s);
        dark.all = indicated(s.object, detail, dark.all);
        dark.form = indicated(s.object, detail, dark.form);
    }
    return dark;
}
