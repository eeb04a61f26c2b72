// Strokes of tonal art maps (Praun et al. 2001, "Real-Time Hatching"): tiles that repeat, on the paper (Bu et al. 2006) or by the
// texture coordinates of the model. Twins: src/hatching/tonal_art_map/.

// Of each set the three light tones, and how texels are inked when it gets darker, at several resolutions.
var light_tones: texture_2d_array<f32>;
var stroke_priorities: texture_2d_array<f32>;
var tile_of_strokes: sampler;

// Texels along the side of a tile at its finest resolution.
const TILE: f32 = 256.0;
const DIRECTIONS: u32 = 3u;
// Mean ink of one direction of strokes that come one by one before others cross it: if more of it lay as close, they would run
// together in some places.
const FULL_DIRECTION: f32 = 0.32;
// A crisp stroke goes from paper to ink within so much of the ink of a tile's texel. The middle of that step grows with the mean ink
// that is asked for, so that tones stay as dark: strokes that are few would get narrower, gaps between many would close.
const CRISP_STEP: f32 = 0.15;
const CRISP_MIDDLE: f32 = 0.447;
const CRISP_MIDDLE_BY_INK: f32 = 0.13;
// The middle of the step where strokes lie so close that they are hardly crisp: it makes up for what their soft part loses.
const SOFT_MIDDLE: f32 = 0.405;

struct LaidDirection {
    turn: f32,
    offset: vec2<f32>,
}

// As `DIRECTIONS` in src/hatching/tonal_art_map/composition.rs.
fn laid_direction(number: u32) -> LaidDirection {
    if number == 0u {
        return LaidDirection(0.0, vec2(0.0));
    }
    if number == 1u {
        return LaidDirection(1.0471976, vec2(0.37, 0.61));
    }
    return LaidDirection(-1.0471976, vec2(0.71, 0.23));
}

// Place in a tile of a point (in tiles) where strokes run at an angle: it turns by the inverse of that.
fn place_in_tile(at: vec2<f32>, angle: f32, direction: LaidDirection) -> vec2<f32> {
    let c = cos(angle + direction.turn);
    let s = sin(angle + direction.turn);
    return vec2(at.x * c + at.y * s, at.y * c - at.x * s) + direction.offset;
}

// Ink of a whole tone, 0 to 6, of which the dark ones are laid over each other.
fn composed(tone: u32, samples: array<vec3<f32>, 3>) -> f32 {
    if tone == 0u {
        return 0.0;
    }
    if tone <= 3u {
        return samples[0][tone - 1u];
    }
    let i = min(tone, 6u) - 4u;
    return 1.0 - (1.0 - samples[0].z) * (1.0 - samples[1][i]) * (1.0 - samples[2][i]);
}

// The tone, 0 to 6, that has a mean ink.
fn tone_of_ink(ink: f32) -> f32 {
    // As `COMPOSED_INKS`.
    var inks = array(0.0, 0.118, 0.245, 0.384, 0.5208, 0.6489, 0.7663);
    var tone = 6.0;
    for (var i = 5; i >= 0; i--) {
        if ink < inks[i + 1] {
            tone = f32(i) + clamp((ink - inks[i]) / (inks[i + 1] - inks[i]), 0.0, 1.0);
        }
    }
    return tone;
}

// Ink of a texel where a mean ink is asked for.
fn ink_of_priority(texel: vec4<f32>, ink: f32) -> f32 {
    return select(select(0.0, texel.y, ink > texel.x && texel.x < 0.999), texel.w, ink > texel.z && texel.z < 0.999);
}

// Ink at a place in a tile, at a resolution, 0 the finest. Priorities must not be filtered before they are compared.
fn priority_ink(place: vec2<f32>, strokes: u32, level: u32, ink: f32) -> f32 {
    let side = i32(TILE) >> level;
    let p = fract(place) * f32(side) - 0.5;
    let first = vec2<i32>(floor(p));
    let f = p - floor(p);
    var inks = vec4(0.0);
    for (var i = 0; i < 4; i++) {
        let texel = (first + vec2(i & 1, i >> 1u) + side) & vec2(side - 1);
        inks[i] = ink_of_priority(textureLoad(stroke_priorities, texel, strokes, level), ink);
    }
    return mix(mix(inks.x, inks.y, f.x), mix(inks.z, inks.w, f.x), f.y);
}

// The more crisp, the more what a tile has is ink or paper; `ink`: the mean ink that is asked for.
fn crisp_ink(texel: f32, ink: f32, crispness: f32) -> f32 {
    let middle = mix(SOFT_MIDDLE, CRISP_MIDDLE, crispness) + CRISP_MIDDLE_BY_INK * ink;
    return mix(texel, clamp((texel - middle) / CRISP_STEP + 0.5, 0.0, 1.0), crispness);
}

// Ink at a point of the paper (in tiles), where strokes run at an angle; each pixel blends two neighboring tones.
fn blended_ink_at(at: vec2<f32>, angle: f32, strokes: u32, ink: f32, lod: f32) -> f32 {
    var samples = array<vec3<f32>, 3>();
    for (var i = 0u; i < DIRECTIONS; i++) {
        let place = place_in_tile(at, angle, laid_direction(i));
        samples[i] = textureSampleLevel(light_tones, tile_of_strokes, place, strokes, lod).rgb;
    }
    let tone = tone_of_ink(ink);
    let whole = u32(tone);
    return mix(composed(whole, samples), composed(whole + 1u, samples), tone - f32(whole));
}

// Mean ink of each direction, so that all of them together have that of a tone: `inks_of_layers` in
// src/hatching/tonal_art_map/composition.rs.
fn inks_of_layers(ink: f32) -> vec3<f32> {
    if ink <= FULL_DIRECTION {
        return vec3(ink, 0.0, 0.0);
    }
    let crossed = 1.0 - sqrt((1.0 - ink) / (1.0 - FULL_DIRECTION));
    return select(vec3(1.0 - pow(1.0 - ink, 1.0 / 3.0)), vec3(FULL_DIRECTION, crossed, crossed), crossed <= FULL_DIRECTION);
}

// Mean ink of a tile in a pixel, of all texels that it has there: strokes that are drawn smaller only get finer.
fn mean_priority_ink(place: vec2<f32>, strokes: u32, ink: f32, lod: f32) -> f32 {
    let side = i32(min(exp2(round(lod)), 4.0));
    var sum = 0.0;
    for (var i = 0; i < side * side; i++) {
        let aside = (vec2(f32(i % side), f32(i / side)) + 0.5) / f32(side) - 0.5;
        sum += priority_ink(place + aside * exp2(lod) / TILE, strokes, 0u, ink);
    }
    return sum / f32(side * side);
}

// Ink at a point of the paper (in tiles), where strokes run at an angle and come one by one as it gets darker.
fn ink_by_strokes_at(at: vec2<f32>, angle: f32, strokes: u32, ink: f32, lod: f32, crispness: f32) -> f32 {
    let inks = inks_of_layers(min(ink, 1.0));
    var left = 1.0;
    for (var i = 0u; i < DIRECTIONS; i++) {
        let place = place_in_tile(at, angle, laid_direction(i));
        left *= 1.0 - crisp_ink(mean_priority_ink(place, strokes, inks[i], lod), inks[i], crispness);
    }
    return 1.0 - left;
}

// Ink of one direction of strokes by texture coordinates: tiles as large as wanted between two octaves, of which the one comes as the
// other goes, stroke by stroke. `pixel`: size of a pixel in texture coordinates; `tile`: px.
fn uv_ink_of(uv: vec2<f32>, pixel: f32, tile: f32, strokes: u32, turn: f32, number: u32, ink: f32, crispness: f32) -> f32 {
    let wanted = -log2(max(pixel * tile, 1e-12));
    let octave = floor(wanted);
    let share = wanted - octave;
    let direction = laid_direction(number);
    let coarse = place_in_tile(uv * exp2(octave), turn, direction);
    let fine = place_in_tile(uv * exp2(octave + 1.0), turn, direction);
    // Both over each other leave as much paper as is wanted.
    let left = max(1.0 - ink, 0.0);
    let first = 1.0 - pow(left, 1.0 - share);
    let second = 1.0 - pow(left, share);
    // A tile that is twice as large has its strokes at twice the resolution.
    // Of two resolutions together nothing would be crisp.
    let finer = select(share, round(share), crispness > 0.0);
    let a = mix(priority_ink(coarse, strokes, 1u, first), priority_ink(coarse, strokes, 0u, first), finer);
    let b = priority_ink(fine, strokes, 1u, second);
    return 1.0 - (1.0 - crisp_ink(a, first, crispness)) * (1.0 - crisp_ink(b, second, crispness));
}
