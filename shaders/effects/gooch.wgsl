// Gooch shading: cool to warm, a highlight, and the stripes of milled metal (Gooch et al. 1998, sections 3.1 and 3.2).
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import common/same_surface.wgsl
#import common/surface_id.wgsl

// How far shadows go to the cool end.
const SHADE: f32 = 0.7;

const GOOCH: u32 = 3u;

// Whether any object is drawn in this way, and whether any has stripes.
override WITH_GOOCH: bool = true;
override WITH_METAL: bool = true;

// Twin: `GpuGoochStyle` in src/render/effects/gooch.rs.
struct GoochStyle {
    // Linear colors.
    cool: vec3<f32>,
    // Shares of the object's own color.
    alpha: f32,
    warm: vec3<f32>,
    beta: f32,
    // Directions across the axis of the stripes, where the angle around it is 0° and 90°; world or view space.
    across: vec3<f32>,
    highlight: f32,
    around: vec3<f32>,
    shininess: f32,
    // Strength of the stripes, their number, and 1 where the axis is the view's.
    metal: f32,
    stripes: f32,
    is_of_view: u32,
    // 1 where stripes lie around the axes of forms.
    is_of_form: u32,
    // How far the key is turned to the side, 0 to 1.
    side_light: f32,
    // How far cool and warm are multiplied by the object's own color, 0 to 1.
    object_hue: f32,
    // Where the styles of its forms are, and how many.
    first_form: u32,
    forms: u32,
}

// By object id; behind them those of forms, with an axis of their own.
var<storage, read> gooch_styles: array<GoochStyle>;

const TAU: f32 = 6.28318530718;

// A number from 0 to 1 that looks like chance (the PCG hash; Jarzynski and Olano 2020).
fn chance(index: u32, seed: u32) -> f32 {
    let state = (index * 747796405u + seed) * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return f32(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}

// A direction in view space, seen along the axis of the stripes.
fn along_axis(style: GoochStyle, direction: vec3<f32>) -> vec2<f32> {
    var d = direction;
    if style.is_of_view == 0u {
        d = (frame.world_from_view * vec4(d, 0.0)).xyz;
    }
    return vec2(dot(d, style.across), dot(d, style.around));
}

// The angle of such a direction around the axis, in turns from 0 to 1.
fn turn_of(direction: vec2<f32>) -> f32 {
    if all(direction == vec2(0.0)) {
        return 0.0;
    }
    return fract(atan2(direction.y, direction.x) / TAU);
}

// From one turn to another by the shorter way, −0.5 to 0.5.
fn turned(a: f32, b: f32) -> f32 {
    return fract(b - a + 0.5) - 0.5;
}

// Middle of a stripe in stripes, and its intensity.
fn stripe(index: i32, count: i32, seed: u32) -> vec2<f32> {
    let k = u32((index + count) % count) * 2u;
    return vec2(f32(index) + 0.5 + 0.6 * (chance(k, seed) - 0.5), 0.5 * chance(k + 1u, seed));
}

// The intensity at a turn: between the middles of stripes it goes evenly from one to the other. `footprint`: stripes
// per pixel; where they are too narrow to be seen there is their mean.
fn stripes_at(turn: f32, count: f32, seed: u32, footprint: f32) -> f32 {
    let place = turn * count;
    let n = i32(count);
    var index = i32(floor(place));
    index -= select(0, 1, place < stripe(index, n, seed).x);
    let before = stripe(index, n, seed);
    let after = stripe(index + 1, n, seed);
    let intensity = mix(before.y, after.y, (place - before.x) / (after.x - before.x));
    return mix(intensity, 0.25, smoothstep(0.5, 1.0, footprint));
}

// Change of the turn per pixel along an axis of the picture, from both sides where the surface goes on there.
fn turn_slope(px: vec2<i32>, s: Surfel, style: GoochStyle, turn: f32, axis: vec2<i32>) -> f32 {
    var change = vec2(0.0);
    for (var side = -1; side <= 1; side += 2) {
        let q = px + side * axis;
        let other = unpack_surfel(geometry_at(q));
        let is_inside = all(q >= vec2(0)) && all(q < vec2<i32>(frame.size));
        if is_inside && goes_on(px, s, q, other) {
            change += vec2(f32(side) * turned(turn, turn_of(along_axis(style, other.normal))), 1.0);
        }
    }
    return change.x / max(change.y, 1.0);
}

// A shade in the stripes of milled metal: black at intensity 0, as it is at one half, white at 1. The paper makes the
// stripe nearest to the light white; here that one stands where the light does, so that none of them ever jumps.
fn metallic(px: vec2<i32>, s: Surfel, style: GoochStyle, shade: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    let across = along_axis(style, s.normal);
    let turn = turn_of(across);
    let slope = vec2(
        turn_slope(px, s, style, turn, vec2(1, 0)),
        turn_slope(px, s, style, turn, vec2(0, 1)),
    );
    let footprint = length(slope) * style.stripes * frame.coverage_ramp;
    var intensity = stripes_at(turn, style.stripes, s.object, footprint);
    let light_across = along_axis(style, light);
    let off = abs(turned(turn, turn_of(light_across))) * style.stripes;
    let width = max(footprint, 1.0);
    let white = max(1.0 - off / width, 0.0) / width * smoothstep(0.05, 0.3, length(light_across));
    intensity = mix(intensity, 1.0, white);
    let dark = shade * min(2.0 * intensity, 1.0);
    let color = mix(dark, vec3(1.0), max(2.0 * intensity - 1.0, 0.0));
    // What faces along the axis has no angle around it.
    return mix(shade, color, style.metal * smoothstep(0.1, 0.5, length(across)));
}

// The style of the form that a pixel shows.
fn style_of_form(px: vec2<i32>, object: u32, style: GoochStyle) -> GoochStyle {
    let surface = surface_of(textureLoad(surface_id_tex, px, 0).x, object);
    if surface < style.forms {
        return gooch_styles[style.first_form + surface];
    }
    var own = style;
    own.metal = 0.0;
    return own;
}

// Where the key stands for Gooch shading: from where it is towards the side, across the line of sight, where the paper has it
// (section 4.1), so that the faces that are seen have all tones.
fn key_of(style: GoochStyle, l: vec3<f32>, eye: vec3<f32>) -> vec3<f32> {
    let turned = l - style.side_light * dot(l, eye) * eye;
    return select(l, normalize(turned), dot(turned, turned) > 1e-4);
}

// cool + alpha · base to warm + beta · base by (1 + n·l) / 2, and a Phong highlight, with the first light as the key.
fn gooch(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    let style = gooch_styles[s.object];
    let l = towards_light(frame.lights[0], pos_view);
    let eye = towards_eye(pos_view);
    let hue = mix(vec3(1.0), base, style.object_hue);
    let cool = min(style.cool * hue + style.alpha * base, vec3(1.0));
    let warm = min(style.warm * hue + style.beta * base, vec3(1.0));
    let n_l = dot(s.normal, l);
    let lit = visibility(px, 0u);
    var warmth = 0.5 + 0.5 * dot(s.normal, key_of(style, l, eye));
    if WITH_SHADOWS {
        warmth *= 1.0 - SHADE * shadow_at(px, 0u, n_l);
    }
    var shade = mix(cool, warm, warmth);
    if WITH_METAL && style.metal > 0.0 && style.is_of_form == 0u {
        shade = metallic(px, s, style, shade, l);
    } else if WITH_METAL && style.metal > 0.0 {
        shade = metallic(px, s, style_of_form(px, s.object, style), shade, l);
    }
    let reflected = reflect(-l, s.normal);
    let gloss = pow(max(dot(reflected, eye), 0.0), style.shininess);
    return mix(shade, vec3(1.0), style.highlight * gloss * lit);
}
