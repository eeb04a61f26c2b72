// Gooch shading: cool to warm, a highlight, and the stripes of milled metal (Gooch et al. 1998, sections 3.1 and 3.2).
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import common/same_surface.wgsl

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
    // 1 where stripes lie around the axis that the surface turns about: `across`, `around` or the one across both.
    is_of_form: u32,
    // How far the key is turned to the side, 0 to 1.
    aside: f32,
    // How far cool and warm are multiplied by the object's own color, 0 to 1.
    own_hue: f32,
}

// By object id.
var<storage, read> gooch_styles: array<GoochStyle>;

const TAU: f32 = 6.28318530718;

// A number from 0 to 1 that looks like chance (the PCG hash; Jarzynski and Olano 2020).
fn chance(index: u32, seed: u32) -> f32 {
    let state = (index * 747796405u + seed) * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return f32(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}

// A direction in view space, by the axes of the stripes.
fn by_axes(style: GoochStyle, direction: vec3<f32>) -> vec3<f32> {
    var d = direction;
    if style.is_of_view == 0u {
        d = (frame.world_from_view * vec4(d, 0.0)).xyz;
    }
    return vec3(dot(d, style.across), dot(d, style.around), dot(d, cross(style.across, style.around)));
}

// The axis of the stripes, where they do not follow the form.
const OWN_AXIS: u32 = 2u;

// A direction in view space, seen along one of the axes.
fn along_axis(style: GoochStyle, axis: u32, direction: vec3<f32>) -> vec2<f32> {
    let d = by_axes(style, direction);
    return vec2(d[(axis + 1u) % 3u], d[(axis + 2u) % 3u]);
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
fn turn_slope(px: vec2<i32>, s: Surfel, style: GoochStyle, about: u32, turn: f32, axis: vec2<i32>) -> f32 {
    var change = vec2(0.0);
    for (var side = -1; side <= 1; side += 2) {
        let q = px + side * axis;
        let other = unpack_surfel(geometry_at(q));
        let is_inside = all(q >= vec2(0)) && all(q < vec2<i32>(frame.size));
        if is_inside && goes_on(px, s, q, other) {
            change += vec2(f32(side) * turned(turn, turn_of(along_axis(style, about, other.normal))), 1.0);
        }
    }
    return change.x / max(change.y, 1.0);
}

// Turns per pixel, radians, between which a surface goes from flat to rounded.
const ROUNDED: vec2<f32> = vec2(2e-4, 8e-4);

// How much a surface turns about each of the axes, all 0 where it is flat, of sum 1 where it is rounded.
fn axes_of_form(px: vec2<i32>, s: Surfel, style: GoochStyle) -> vec3<f32> {
    var turns = vec3(0.0);
    for (var i = 0; i < 2; i++) {
        // The lesser change of both sides: facets that are shaded flat are flat up to their borders.
        var change = vec3(0.0);
        var is_first = true;
        for (var side = -1; side <= 1; side += 2) {
            let q = px + side * vec2(1 - i, i);
            let other = unpack_surfel(geometry_at(q));
            let is_inside = all(q >= vec2(0)) && all(q < vec2<i32>(frame.size));
            if is_inside && goes_on(px, s, q, other) {
                let next = f32(side) * (other.normal - s.normal);
                change = select(change, next, is_first || dot(next, next) < dot(change, change));
                is_first = false;
            }
        }
        let about = by_axes(style, cross(s.normal, change));
        turns += about * about;
    }
    // The square keeps the stripes of the axes apart, and lets them change without a seam.
    let shares = turns * turns / max(dot(turns, turns), 1e-30);
    return shares * smoothstep(ROUNDED.x, ROUNDED.y, sqrt(turns.x + turns.y + turns.z));
}

// A shade in the stripes of milled metal: black at intensity 0, as it is at one half, white at 1. The paper makes the
// stripe nearest to the light white; here that one stands where the light does, so that none of them ever jumps.
fn metallic_about(
    axis: u32, px: vec2<i32>, s: Surfel, style: GoochStyle, shade: vec3<f32>, light: vec3<f32>,
) -> vec3<f32> {
    let across = along_axis(style, axis, s.normal);
    let turn = turn_of(across);
    let slope = vec2(
        turn_slope(px, s, style, axis, turn, vec2(1, 0)),
        turn_slope(px, s, style, axis, turn, vec2(0, 1)),
    );
    let footprint = length(slope) * style.stripes * frame.coverage_ramp;
    var intensity = stripes_at(turn, style.stripes, s.object, footprint);
    let light_across = along_axis(style, axis, light);
    let off = abs(turned(turn, turn_of(light_across))) * style.stripes;
    let width = max(footprint, 1.0);
    let white = max(1.0 - off / width, 0.0) / width * smoothstep(0.05, 0.3, length(light_across));
    intensity = mix(intensity, 1.0, white);
    let dark = shade * min(2.0 * intensity, 1.0);
    let color = mix(dark, vec3(1.0), max(2.0 * intensity - 1.0, 0.0));
    // What faces along the axis has no angle around it.
    return mix(shade, color, style.metal * smoothstep(0.1, 0.5, length(across)));
}

fn metallic(px: vec2<i32>, s: Surfel, style: GoochStyle, shade: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    if style.is_of_form == 0u {
        return metallic_about(OWN_AXIS, px, s, style, shade, light);
    }
    let axes = axes_of_form(px, s, style);
    var color = shade;
    for (var axis = 0u; axis < 3u; axis++) {
        if axes[axis] > 0.02 {
            color += axes[axis] * (metallic_about(axis, px, s, style, shade, light) - shade);
        }
    }
    return color;
}

// Where the key stands for Gooch shading: from where it is towards the side, across the line of sight, where the paper has it
// (section 4.1), so that the faces that are seen have all tones.
fn key_of(style: GoochStyle, l: vec3<f32>, eye: vec3<f32>) -> vec3<f32> {
    let turned = l - style.aside * dot(l, eye) * eye;
    return select(l, normalize(turned), dot(turned, turned) > 1e-4);
}

// cool + alpha · base to warm + beta · base by (1 + n·l) / 2, and a Phong highlight, with the first light as the key.
fn gooch(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    let style = gooch_styles[s.object];
    let l = towards_light(frame.lights[0], pos_view);
    let eye = towards_eye(pos_view);
    let hue = mix(vec3(1.0), base, style.own_hue);
    let cool = min(style.cool * hue + style.alpha * base, vec3(1.0));
    let warm = min(style.warm * hue + style.beta * base, vec3(1.0));
    let n_l = dot(s.normal, l);
    let lit = visibility(px, 0u);
    var warmth = 0.5 + 0.5 * dot(s.normal, key_of(style, l, eye));
    if WITH_SHADOWS {
        warmth *= 1.0 - SHADE * shadow_at(px, 0u, n_l);
    }
    var shade = mix(cool, warm, warmth);
    if WITH_METAL && style.metal > 0.0 {
        shade = metallic(px, s, style, shade, l);
    }
    let reflected = reflect(-l, s.normal);
    let gloss = pow(max(dot(reflected, eye), 0.0), style.shininess);
    return mix(shade, vec3(1.0), style.highlight * gloss * lit);
}
