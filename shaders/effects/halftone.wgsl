// Halftone: a smooth threshold of a prioritized texture (Freudenberg et al. 2002, "Real-Time Halftoning: A Primitive For
// Non-Photorealistic Shading"), of which the mean ink is exactly what the tone asks for.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import common/surface_change.wgsl

const HALFTONE: u32 = 5u;

const SCREEN: u32 = 1u;
const TRIPLANAR: u32 = 2u;
const UV: u32 = 3u;

// Whether any object is drawn in this way, and to what textures are fixed.
override WITH_HALFTONE: bool = true;
override WITH_SCREEN: bool = true;
override WITH_TRIPLANAR: bool = true;
override WITH_UV: bool = true;

// Twin: `GpuHalftoneStyle` in src/render/effects/halftone.rs.
struct HalftoneStyle {
    // To the object's own axes, about its middle; its diagonal is 1.
    pattern_from_view: mat4x4<f32>,
    // Linear colors, and shares of the object's own.
    ink: vec3<f32>,
    ink_tint: f32,
    paper: vec3<f32>,
    paper_tint: f32,
    // Cosine and sine of the texture's angle.
    turn: vec2<f32>,
    // Side of a tile at the first step, and of what a threshold is smoothed over; pixels.
    tile: f32,
    footprint: f32,
    // Light to tone.
    ambient: f32,
    object_tone: f32,
    black: f32,
    range: f32,
    gamma: f32,
    // Which of the threshold maps.
    map: u32,
    // 0: no halftone.
    space: u32,
}

var<storage, read> halftone_styles: array<HalftoneStyle>;
// Mean threshold and twice its standard deviation; see src/render/effects/halftone/threshold_map.rs.
var thresholds: texture_2d_array<f32>;
var threshold_sampler: sampler;
// For each map the threshold for each of `PLACES` in the octave, `SIZES` of a pixel and `TONES`.
var<storage, read> calibration: array<f32>;
// Texture coordinates: see shaders/passes/coordinates.wgsl.
var coordinates_tex: texture_storage_2d<rgba32uint, read>;

// As in src/render/effects/halftone/, threshold_map.rs and calibration.rs.
const SIDE: f32 = 512.0;
const STEPS: f32 = 8.0;
const PLACES: u32 = 33u;
const SIZES: u32 = 33u;
const TONES: u32 = 33u;

// A point of a pattern, and a pixel's sides there.
struct Patch {
    center: vec2<f32>,
    dx: vec2<f32>,
    dy: vec2<f32>,
}

// Longest half axis first: a pixel's ellipse in a pattern.
struct Ellipse {
    major: vec2<f32>,
    major_length: f32,
    minor_length: f32,
}

fn ellipse(p: Patch) -> Ellipse {
    let a = p.dx.x * p.dx.x + p.dy.x * p.dy.x;
    let b = p.dx.x * p.dx.y + p.dy.x * p.dy.y;
    let c = p.dx.y * p.dx.y + p.dy.y * p.dy.y;
    let half = 0.5 * (a - c);
    let length = sqrt(max(0.5 * (a + c) + sqrt(half * half + b * b), 1e-30));
    let angle = 0.5 * atan2(b, half);
    let area = abs(p.dx.x * p.dy.y - p.dx.y * p.dy.x);
    return Ellipse(vec2(cos(angle), sin(angle)) * length, length, area / length);
}

// A place between two of `count`: the first of them, and how far from it.
struct Between {
    first: u32,
    share: f32,
}

fn between(place: f32, count: u32) -> Between {
    let inside = clamp(place, 0.0, f32(count - 1u));
    let first = min(u32(inside), count - 2u);
    return Between(first, inside - f32(first));
}

// The threshold at which so much of a tile is ink as a tone asks for; `level`: size of a pixel in texels, as a power of
// two.
fn calibrated(map: u32, step: f32, level: f32, tone: f32) -> f32 {
    let place = between(step / STEPS * f32(PLACES - 1u), PLACES);
    let size = between((level + 2.0) * 4.0, SIZES);
    let column = between(tone * f32(TONES - 1u), TONES);
    var thresholds: vec4<f32>;
    for (var corner = 0u; corner < 4u; corner++) {
        let row = (map * PLACES + place.first + (corner >> 1u)) * SIZES + size.first + (corner & 1u);
        let i = row * TONES + column.first;
        thresholds[corner] = mix(calibration[i], calibration[i + 1u], column.share);
    }
    let by_size = mix(thresholds.xz, thresholds.yw, size.share);
    return mix(by_size.x, by_size.y, place.share);
}

// A pixel is never smoothed from more places than this.
const MAX_TAPS: f32 = 4.0;

// Share of ink in a pixel of a tiled pattern, at a step of its octave, 0 to 8. Along the longer axis of the pixel's
// ellipse several places are taken; in each, thresholds are spread evenly about their mean, and the share of those
// above the tone is ink. Beyond the resolution of the picture nothing but the tone remains.
fn ink_share(map: u32, tile: Patch, step: f32, tone: f32) -> f32 {
    let e = ellipse(tile);
    let taps = clamp(round(e.major_length / max(e.minor_length, 1e-9)), 1.0, MAX_TAPS);
    let texels = max(e.minor_length, e.major_length / taps) * SIDE;
    let level = log2(max(texels, 1e-9));
    // An enlarged texel changes only a little within a pixel.
    let sharpness = min(texels, 1.0);
    // Nothing is ink in white, and all is in black, whatever the rounding.
    let threshold = calibrated(map, step, level, tone) * 1.002 - 0.001;
    let layer = map * (u32(STEPS) + 1u) + min(u32(step), u32(STEPS) - 1u);
    let next = step - min(floor(step), STEPS - 1.0);
    var ink = 0.0;
    for (var i = 0.0; i < taps; i += 1.0) {
        let q = tile.center + ((i + 0.5) / taps - 0.5) * e.major;
        let here = textureSampleLevel(thresholds, threshold_sampler, q, layer, level).xy;
        var mixed = here;
        // On the screen it never is.
        if next > 0.0 {
            let there = textureSampleLevel(thresholds, threshold_sampler, q, layer + 1u, level).xy;
            mixed = mix(here, there, next);
        }
        // An even spread over a width w has the deviation w / √12.
        let width = min(sqrt(3.0) * mixed.y * sharpness, 2.0 * min(mixed.x, 1.0 - mixed.x));
        ink += clamp((mixed.x - threshold) / max(width, 1e-4) + 0.5, 0.0, 1.0);
    }
    return ink / taps;
}

fn turned_by(v: vec2<f32>, turn: vec2<f32>) -> vec2<f32> {
    return vec2(v.x * turn.x + v.y * turn.y, v.y * turn.x - v.x * turn.y);
}

// Share of ink on a surface: the tile's size is the power of two that is nearest to what is wanted on the screen, the
// step is what is left of the octave.
fn surface_ink(object: u32, pattern: Patch, tone: f32) -> f32 {
    let turn = halftone_styles[object].turn;
    let p = Patch(turned_by(pattern.center, turn), turned_by(pattern.dx, turn), turned_by(pattern.dy, turn));
    let e = ellipse(p);
    // A tilted pattern is as much too dense across as it is too wide along.
    let pixel = max(sqrt(e.major_length * e.minor_length), e.major_length / 3.0);
    if !(pixel > 1e-12 && pixel < 1e12) {
        return 1.0 - tone;
    }
    let wanted = log2(pixel * halftone_styles[object].tile);
    let octave = ceil(wanted);
    let per_unit = exp2(-octave);
    let side = halftone_styles[object].footprint * frame.coverage_ramp * per_unit;
    let tile = Patch(p.center * per_unit, p.dx * side, p.dy * side);
    return ink_share(halftone_styles[object].map, tile, (octave - wanted) * STEPS, tone);
}

fn screen_ink(object: u32, px: vec2<i32>, tone: f32) -> f32 {
    let style = halftone_styles[object].turn / halftone_styles[object].tile;
    // Fixed to the picture, whatever sample of it this is.
    let position = vec2<f32>(px) + 0.5 - frame.jitter;
    let side = halftone_styles[object].footprint * frame.coverage_ramp;
    let tile = Patch(turned_by(position, style), turned_by(vec2(side, 0.0), style), turned_by(vec2(0.0, side), style));
    return ink_share(halftone_styles[object].map, tile, 0.0, tone);
}

fn uv_ink(object: u32, px: vec2<i32>, tone: f32) -> f32 {
    let texel = textureLoad(coordinates_tex, px);
    let uv = bitcast<vec2<f32>>(texel.xy);
    let pattern = Patch(uv, unpack2x16float(texel.z) / 4096.0, unpack2x16float(texel.w) / 4096.0);
    return surface_ink(object, pattern, tone);
}

// Projections along the axes count as much as the surface faces them.
const FACING_POWER: f32 = 8.0;

// Three projections; where two meet, each draws so much of the tone that both together draw all of it, as ink upon ink
// leaves the product of what each of them leaves.
fn triplanar_ink(object: u32, s: Surfel, pos_view: vec3<f32>, tone: f32) -> f32 {
    let m = halftone_styles[object].pattern_from_view;
    let linear = mat3x3(m[0].xyz, m[1].xyz, m[2].xyz);
    let p = (m * vec4(pos_view, 1.0)).xyz;
    let dx = linear * pos_change(pos_view, s.normal, vec3(frame.view_per_px.x, 0.0, 0.0));
    let dy = linear * pos_change(pos_view, s.normal, vec3(0.0, frame.view_per_px.y, 0.0));
    let facing = pow(abs(normalize(linear * s.normal)), vec3(FACING_POWER));
    // Without the least ones, which would cost as much as the others.
    let kept = max(facing / (facing.x + facing.y + facing.z) - 0.05, vec3(0.0));
    let shares = kept / (kept.x + kept.y + kept.z);
    var left = 1.0;
    if shares.x > 0.0 {
        left *= 1.0 - surface_ink(object, Patch(p.zy, dx.zy, dy.zy), pow(tone, shares.x));
    }
    if shares.y > 0.0 {
        left *= 1.0 - surface_ink(object, Patch(p.xz, dx.xz, dy.xz), pow(tone, shares.y));
    }
    if shares.z > 0.0 {
        left *= 1.0 - surface_ink(object, Patch(p.xy, dx.xy, dy.xy), pow(tone, shares.z));
    }
    return 1.0 - left;
}

fn luminance(linear: vec3<f32>) -> f32 {
    return dot(linear, vec3(0.2126, 0.7152, 0.0722));
}

// Desired share of paper, from the light.
fn halftone_tone(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> f32 {
    let object = s.object;
    let light = halftone_styles[object].ambient + light_at(px, s.normal, pos_view);
    let reflected = luminance(light) * mix(1.0, luminance(base), halftone_styles[object].object_tone);
    let linear = (reflected - halftone_styles[object].black) / halftone_styles[object].range;
    return pow(clamp(linear, 0.0, 1.0), halftone_styles[object].gamma);
}

fn halftone(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    let tone = halftone_tone(px, s, base, pos_view);
    let space = halftone_styles[s.object].space;
    var ink = 1.0 - tone;
    if WITH_SCREEN && space == SCREEN {
        ink = screen_ink(s.object, px, tone);
    }
    if WITH_TRIPLANAR && space == TRIPLANAR {
        ink = triplanar_ink(s.object, s, pos_view, tone);
    }
    if WITH_UV && space == UV {
        ink = uv_ink(s.object, px, tone);
    }
    let paper = halftone_styles[s.object].paper * mix(vec3(1.0), base, halftone_styles[s.object].paper_tint);
    let stroke = mix(halftone_styles[s.object].ink, base, halftone_styles[s.object].ink_tint);
    return mix(paper, stroke, ink);
}
