// Toon shading: flat shades from a ramp, indexed by N·L (Lake et al. 2000; edge-enhancement paper, section 5, Fig. 9).
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import gpu/record_texture.wgsl
#import common/same_surface.wgsl

const TOON: u32 = 4u;

const NEAREST: u32 = 1u;
const CARTOON_MAP: u32 = 2u;
const ANALYTIC: u32 = 3u;

// Whether any object is drawn in this way, and which borders there are.
override WITH_TOON: bool = true;
override WITH_NEAREST: bool = true;
override WITH_CARTOON_MAP: bool = true;
override WITH_ANALYTIC: bool = true;

// Twin: `GpuToonStyle` in src/render/effects/toon.rs.
struct ToonStyle {
    rim_color: vec3<f32>,
    // Opacities.
    rim: f32,
    highlight: f32,
    // The highlight is where N·H is at least this, the rim where N·V is at most that.
    highlight_from: f32,
    rim_to: f32,
    // Share of the object's own color.
    tint: f32,
    // Its ramp in `toon_bands`, from shadow to light.
    first_band: u32,
    bands: u32,
    // N·L at which the ramp begins, and bands per unit of N·L.
    start: f32,
    bands_per_unit: f32,
    // 0: not a toon.
    smoothing: u32,
}

var<storage, read> toon_styles: array<ToonStyle>;
// Linear colors of all ramps.
var toon_bands: texture_storage_2d<rgba32uint, read>;
// The bands of the objects whose borders are smoothed by it.
var cartoon_map_tex: texture_2d<u32>;

// x: place on the ramp, in bands: its beginning in shadow; y: N·H past the highlight's border; z: N·V past the rim's
// border; w: N·L, negative in shadow.
fn toon_fields(px: vec2<i32>, object: u32, normal: vec3<f32>, pos_view: vec3<f32>) -> vec4<f32> {
    let l = towards_light(frame.lights[0], pos_view);
    let v = towards_eye(pos_view);
    let n_l = dot(normal, l);
    let place = (n_l - toon_styles[object].start) * toon_styles[object].bands_per_unit;
    let lit = visibility(px, 0u);
    return vec4(
        mix(min(place, 0.0), place, lit),
        dot(normal, normalize(l + v)) - toon_styles[object].highlight_from,
        toon_styles[object].rim_to - dot(normal, v),
        n_l * (2.0 * lit - 1.0),
    );
}

const BAND: u32 = 511u;
const HIGHLIGHT: u32 = 512u;
const RIM: u32 = 1024u;

// The band at a place on the ramp.
fn band_at(object: u32, place: f32) -> u32 {
    return u32(clamp(place, 0.0, f32(toon_styles[object].bands - 1u)));
}

fn band_color(object: u32, band: u32) -> vec3<f32> {
    return bitcast<vec4<f32>>(texel_at(toon_bands, toon_styles[object].first_band + band)).rgb;
}

// What there is at a point: 1 + band, highlight, rim; never 0.
fn toon_code(object: u32, fields: vec4<f32>) -> u32 {
    var code = 1u + band_at(object, fields.x);
    code |= select(0u, HIGHLIGHT, fields.y >= 0.0 && fields.w > 0.0);
    code |= select(0u, RIM, fields.z >= 0.0);
    return code;
}

// The bands' color with the object's own, and shares of highlight and rim over it.
fn toon_layers(object: u32, base: vec3<f32>, ramp: vec3<f32>, highlight: f32, rim: f32) -> vec3<f32> {
    let tinted = ramp * mix(vec3(1.0), base, toon_styles[object].tint);
    let lit = mix(tinted, vec3(1.0), toon_styles[object].highlight * highlight);
    return mix(lit, toon_styles[object].rim_color, toon_styles[object].rim * rim);
}

fn toon_color(object: u32, base: vec3<f32>, code: u32) -> vec3<f32> {
    let has = vec2((code & HIGHLIGHT) != 0u, (code & RIM) != 0u);
    let shares = select(vec2(0.0), vec2(1.0), has);
    return toon_layers(object, base, band_color(object, (code & BAND) - 1u), shares.x, shares.y);
}

// The cartoon map: what there is at each pixel, without a mean.
@fragment
fn fs_cartoon_map(@builtin(position) position: vec4<f32>) -> @location(0) u32 {
    let px = vec2<i32>(position.xy);
    let s = unpack_surfel(geometry_at(px));
    var code = 0u;
    if toon_styles[s.object].smoothing == CARTOON_MAP {
        code = toon_code(s.object, toon_fields(px, s.object, s.normal, pos_view_of(px, s.depth)));
    }
    return code;
}

fn code_at(px: vec2<i32>) -> u32 {
    return textureLoad(cartoon_map_tex, px, 0).x;
}

// From a pixel to itself and its eight neighbors, row by row.
fn neighbor_offset(n: u32) -> vec2<i32> {
    return vec2<i32>(vec2(n % 3u, n / 3u)) - 1;
}

fn inside(px: vec2<i32>) -> vec2<i32> {
    return clamp(px, vec2(0), vec2<i32>(frame.size) - 1);
}

// The mean of the neighbors' shades in the cartoon map, weighted 1 2 1, 2 8 2, 1 2 1: a mean that is wider smooths
// more, but errs more than it mends. The more samples are averaged anyway, the less the neighbors count. Where the
// surface does not go on, the pixel stands for its neighbor. Only the bands are averaged, never the object's own
// color, so that images on it stay sharp.
fn smoothed(px: vec2<i32>, s: Surfel, base: vec3<f32>) -> vec3<f32> {
    let code = code_at(px);
    let color = toon_color(s.object, base, code);
    // Bit by bit the neighbors that differ: nearly everywhere there are none, and then nothing more is read.
    var differing = 0u;
    for (var n = 0u; n < 9u; n++) {
        let other = code_at(inside(px + neighbor_offset(n)));
        differing |= select(0u, 1u << n, other != code && other != 0u);
    }
    var change = vec3(0.0);
    while differing != 0u {
        let offset = neighbor_offset(firstTrailingBit(differing));
        let q = inside(px + offset);
        differing &= differing - 1u;
        if goes_on(px, s, q, unpack_surfel(geometry_at(q))) {
            let weight = f32((2 - abs(offset.x)) * (2 - abs(offset.y)));
            change += weight * (toon_color(s.object, base, code_at(q)) - color);
        }
    }
    return color + change * frame.coverage_ramp / (8.0 + 12.0 * frame.coverage_ramp);
}

struct Change {
    fields: vec4<f32>,
    // 1 if it is known, else all is 0.
    weight: f32,
}

// Change of the fields from a pixel to a near one, if the surface goes on there.
fn toon_change(px: vec2<i32>, s: Surfel, fields: vec4<f32>, step: vec2<i32>) -> Change {
    let q = px + step;
    let other = unpack_surfel(geometry_at(q));
    let is_inside = all(q >= vec2(0)) && all(q < vec2<i32>(frame.size));
    if !is_inside || !goes_on(px, s, q, other) {
        return Change(vec4(0.0), 0.0);
    }
    return Change(toon_fields(q, s.object, other.normal, pos_view_of(q, other.depth)) - fields, 1.0);
}

// Change of the fields per pixel along an axis, from both sides where the surface goes on there.
fn toon_slope(px: vec2<i32>, s: Surfel, fields: vec4<f32>, axis: vec2<i32>) -> vec4<f32> {
    let after = toon_change(px, s, fields, axis);
    let before = toon_change(px, s, fields, -axis);
    return (after.fields - before.fields) / max(after.weight + before.weight, 1.0);
}

// The bands' shares in the pixel, from the slopes of the fields.
fn analytic(px: vec2<i32>, s: Surfel, base: vec3<f32>) -> vec3<f32> {
    let fields = toon_fields(px, s.object, s.normal, pos_view_of(px, s.depth));
    let dx = toon_slope(px, s, fields, vec2(1, 0));
    let dy = toon_slope(px, s, fields, vec2(0, 1));
    // Where nothing changes, a border is a step.
    let softness = max(sqrt(dx * dx + dy * dy) * frame.coverage_ramp, vec4(1e-6));
    // From the first to the last band that the pixel touches.
    let last = band_at(s.object, fields.x + 0.5 * softness.x);
    var band = band_at(s.object, fields.x - 0.5 * softness.x);
    var ramp = band_color(s.object, band);
    while band < last {
        band++;
        let share = clamp((fields.x - f32(band)) / softness.x + 0.5, 0.0, 1.0);
        ramp += share * (band_color(s.object, band) - band_color(s.object, band - 1u));
    }
    let shares = clamp(fields / softness + 0.5, vec4(0.0), vec4(1.0));
    return toon_layers(s.object, base, ramp, shares.y * shares.w, shares.z);
}

fn toon(px: vec2<i32>, s: Surfel, base: vec3<f32>) -> vec3<f32> {
    let smoothing = toon_styles[s.object].smoothing;
    var color = base;
    if WITH_CARTOON_MAP && smoothing == CARTOON_MAP {
        color = smoothed(px, s, base);
    }
    if WITH_ANALYTIC && smoothing == ANALYTIC {
        color = analytic(px, s, base);
    }
    if WITH_NEAREST && smoothing == NEAREST {
        let fields = toon_fields(px, s.object, s.normal, pos_view_of(px, s.depth));
        color = toon_color(s.object, base, toon_code(s.object, fields));
    }
    return color;
}
