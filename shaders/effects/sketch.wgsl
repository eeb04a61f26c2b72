// A sketch: lines and colors of a group of one layer, each fetched from beside where it goes, with the depth of what was fetched
// (sketchy drawings paper, sections 3.2 to 3.4), rubbed onto rough paper.
//
// Color, and ink of the papers' operators, that is drawn at x comes from y = x + F(x), as in the paper. Lines of exact mode have
// been moved, each as a whole (passes/moved_edges.wgsl).
#import passes/lines.wgsl
#import common/composition.wgsl
#import common/noise_tile.wgsl
#import gpu/neighbors.wgsl

// Twin: `PassUniform` in src/render/effects/sketch/uniforms.rs.
struct Pass {
    // From noise to offsets, px, by rows.
    matrix: vec4<f32>,
    // Linear color instead of that of the lines.
    color: vec3<f32>,
    has_color: u32,
    width: f32,
    opacity: f32,
}

// Twin: `SketchUniform` in src/render/effects/sketch/uniforms.rs.
struct Sketch {
    passes: array<Pass, 8>,
    // From noise to offsets of the fill, px, by rows.
    fill_matrix: vec4<f32>,
    // Linear color of the pigment.
    pigment: vec3<f32>,
    object_color: f32,
    // Color that lines are smudged with.
    smudge_color: vec3<f32>,
    smudge: f32,
    // Direction of the strokes of the hand: its cosine and sine.
    turn: vec2<f32>,
    stroke_width: f32,
    strokes: f32,
    opacity: f32,
    pressure: f32,
    grain: f32,
    soft: f32,
    // px.
    grain_size: f32,
    roughness: f32,
    pixels_per_reference: f32,
    // Periods of the tile of noise per px, for lines and fill.
    line_scale: f32,
    fill_scale: f32,
    count: u32,
    shows_fill: u32,
}

// Twin: `SketchObject` in src/render/effects/sketch/uniforms.rs.
struct SketchObject {
    // The middle of the object, px.
    @align(16) middle: vec2<f32>,
}

// Whether the noise follows the picture.
override ON_SCREEN: bool = false;
// Whether noise beyond outlines is that of enlarged surfaces, as in the paper.
override ENLARGED: bool = false;
// Whether ink and color have the nearer depth of both, as in the paper.
override WITH_NEARER: bool = false;
// Whether ink that has been placed before is that of other objects.
override BEFORE_IS_OTHER: bool = true;
// Whether each of these is asked for: software devices run both sides of a branch.
override WITH_GRAIN: bool = true;
override WITH_ROUGHNESS: bool = true;
override WITH_STROKES: bool = true;
override WITH_PRESSURE: bool = true;
// Whether pigment is rubbed on more densely where it is dark.
override WITH_DARKNESS: bool = true;
override WITH_SMUDGE: bool = false;
// Whether surfaces are as opaque as their materials.
override WITH_OPACITY: bool = false;
// Whether hidden lines are seen.
override WITH_HIDDEN: bool = false;

var<uniform> sketch: Sketch;
var<storage, read> sketch_objects: array<SketchObject>;
// That of the pass whose ink is drawn.
var<uniform> pass_number: u32;
// The edge map where lines come from, for the papers' operators.
var operator_map_tex: texture_storage_2d<rgba32uint, read>;
// Linear color times opacity, and opacity, of the surfaces; and which of them each pixel shows, 0: none.
var shaded_tex: texture_2d<f32>;
var surface_id_tex: texture_2d<u32>;
// The same of hidden lines.
var hidden_tex: texture_2d<f32>;
// The line next to each pixel, from as far as it is smudged; as `farthest_tex`.
var near_line_tex: texture_storage_2d<r32uint, read>;
// See passes/offset_field.wgsl.
var fill_field_tex: texture_storage_2d<rgba32uint, read>;
// A tile of noise, see common/noise_tile.wgsl; and one of paper.
var tiles: texture_2d_array<f32>;
var paper: texture_2d_array<f32>;
var tile_sampler: sampler;
// What has been placed before.
var before_tex: texture_2d<f32>;
// Geometry after this sketch's color has been placed.
var filled_tex: texture_storage_2d<rgba32uint, read>;

// As in src/render/base/noise.rs.
const TOOTH_CELLS: f32 = 128.0;
const STROKE_CELLS: f32 = 64.0;
const SLOW_CELLS: f32 = 4.0;
const BLOCK: f32 = 4.0;

// How far, px, a floor goes down per pixel at most, seen from 6 degrees above it.
const STEEPEST: f32 = 9.5;

fn applied(matrix: vec4<f32>, noise: vec2<f32>) -> vec2<f32> {
    return vec2(dot(matrix.xy, noise), dot(matrix.zw, noise));
}

// Within the picture, and not on its far edges.
fn inside(at: vec2<f32>) -> vec2<f32> {
    return clamp(at, vec2(0.5), frame.size - 0.5);
}

// Noise of a block, and how much it counts for a pixel of this object; 0: any.
fn fill_noise_of(block: vec2<i32>, object: u32, weight: f32) -> vec3<f32> {
    let texel = textureLoad(fill_field_tex, block);
    let counts = select(weight, 0.0, texel.y == 0u || (object != 0u && texel.z != object));
    return vec3(unpack2x16float(texel.x) * counts, counts);
}

// Noise of the surface at a place, smoothly from block to block of the same object.
fn fill_noise(at: vec2<f32>, object: u32) -> vec2<f32> {
    if ON_SCREEN {
        return noise_of_tile(tiles, at, 0u, sketch.fill_scale);
    }
    let last = vec2<i32>(textureDimensions(fill_field_tex)) - 1;
    let p = at / BLOCK - 0.5;
    let first = vec2<i32>(floor(p));
    let f = p - floor(p);
    var sum = vec3(0.0);
    for (var i = 0; i < 4; i++) {
        let offset = vec2(i & 1, i >> 1u);
        let weights = mix(1.0 - f, f, vec2<f32>(offset));
        sum += fill_noise_of(clamp(first + offset, vec2(0), last), object, weights.x * weights.y + 1e-4);
    }
    if sum.z <= 0.0 {
        // Of an object too small for blocks: as what is around.
        sum = fill_noise_of(clamp(vec2<i32>(at / BLOCK), vec2(0), last), 0u, 1.0);
    }
    return sum.xy / max(sum.z, 1e-6);
}

struct Source {
    at: vec2<f32>,
    noise: vec2<f32>,
}

// Where the color comes from that is drawn at x.
fn fill_source(x: vec2<f32>) -> Source {
    if ON_SCREEN {
        let noise = fill_noise(x, 0u);
        return Source(inside(x + applied(sketch.fill_matrix, noise)), noise);
    }
    let near = inside(x + applied(sketch.fill_matrix, fill_noise(x, 0u)));
    // Beyond the outline, as what is nearest. Waves of color are so long that one step finds it.
    let object = geometry_at(vec2<i32>(floor(near))).w & ~ENHANCED;
    // Enlarged surfaces overlap others.
    let noise = fill_noise(near, select(object, 0u, ENLARGED));
    return Source(inside(x + applied(sketch.fill_matrix, noise)), noise);
}

// Where a pass fetches what it draws at x from.
fn line_source(x: vec2<f32>, number: u32) -> Source {
    var noise = vec2(0.0);
    if ON_SCREEN {
        noise = noise_of_tile(tiles, x, number, sketch.line_scale);
    } else {
        noise = fill_noise(x, 0u);
    }
    return Source(inside(x + applied(sketch.passes[number].matrix, noise)), noise);
}

// How densely a hand presses where the noise is this.
fn pressed(noise: vec2<f32>) -> f32 {
    return mix(1.0 - sketch.pressure, 1.0, smoothstep(-1.1, 1.1, 0.7 * (noise.x + noise.y)));
}

fn on_paper(at: vec2<f32>) -> vec4<f32> {
    return textureSampleLevel(paper, tile_sampler, at, 0, 0.0);
}

// Ink or pigment of a density, 0 to 1, on rough paper: where that stands out it takes some first.
fn deposited(density: f32, x: vec2<f32>) -> f32 {
    if !WITH_GRAIN {
        return density;
    }
    let tooth = on_paper(x / (sketch.grain_size * TOOTH_CELLS)).x;
    let height = tooth * (1.0 - 2.0 * sketch.soft) + sketch.soft;
    let taken = smoothstep(1.0 - density - sketch.soft, 1.0 - density + sketch.soft, height);
    return mix(density, taken * min(1.6 * density + 0.1, 1.0), sketch.grain) * step(1e-4, density);
}

// By how much grains are off, px.
fn roughened(x: vec2<f32>) -> vec2<f32> {
    if !WITH_ROUGHNESS {
        return vec2(0.0);
    }
    // Correlated over less than a reference pixel: of single pixels it would look digital.
    let at = x / (0.7 * sketch.pixels_per_reference * TOOTH_CELLS);
    let noise = vec2(on_paper(at).x, on_paper(at.yx + vec2(0.37, 0.71)).x);
    return (noise - 0.5) * 3.46 * sketch.roughness;
}

// The share that the strokes of a hand leave, which move with the object.
fn stroke_share(x: vec2<f32>, object: u32) -> f32 {
    if !WITH_STROKES {
        return 1.0;
    }
    let p = x - sketch_objects[object].middle;
    let along = dot(p, sketch.turn);
    var across = dot(p, vec2(-sketch.turn.y, sketch.turn.x));
    // A hand does not rule lines.
    let slow = on_paper(p / (400.0 * sketch.pixels_per_reference * SLOW_CELLS)).z - 0.5;
    across += 80.0 * sketch.pixels_per_reference * slow;
    let width = sketch.stroke_width * STROKE_CELLS;
    let rank = on_paper(vec2(along / (16.0 * width), across / width)).y;
    return 1.0 - sketch.strokes * smoothstep(0.35, 1.0, 1.0 - rank);
}

// So far, px, may what is fetched from y with a depth lie behind another surface at x: a foot that is drawn lower lies behind the
// floor there by as much as that goes down from x to y; `least`: at least so much per pixel.
fn tolerance(px: vec2<i32>, y: vec2<f32>, depth: f32, other: Surfel, least: f32) -> f32 {
    let off = y - vec2<f32>(px) - 0.5;
    let away = length(off);
    let lower = step_px(-dot(plane_of(px, other.depth, other.face_direction).slope, off), depth);
    return clamp(lower, least * away, STEEPEST * away);
}

// Ink may lie farther behind than color, which must not cover what lies just before its own surface.
const INK_TOLERANCE: f32 = 4.0;
const FILL_TOLERANCE: f32 = 1.0;

// Whether a surface at a pixel hides what has this depth.
fn is_behind(other: Surfel, depth: f32, slack: f32) -> bool {
    return other.object != 0u && step_px(nearness_of(other.depth) - nearness_of(depth), depth) > slack;
}

// The nearest of all fetches from the depth map (sketchy drawings paper, section 3.3); 0: all are exterior.
fn nearest_depth(x: vec2<f32>, rough: vec2<f32>) -> f32 {
    var nearest = 0.0;
    for (var i = 0u; i <= sketch.count; i++) {
        var y = x;
        if i < sketch.count {
            y = line_source(x, i).at;
        } else if sketch.shows_fill == 1u {
            y = fill_source(x).at;
        }
        let s = unpack_surfel(geometry_at(vec2<i32>(floor(inside(y + rough)))));
        if s.object != 0u && (nearest == 0.0 || s.depth < nearest) {
            nearest = s.depth;
        }
    }
    return nearest;
}

// Marks where anything of the group can be.
@fragment
fn fs_filled(@builtin(position) position: vec4<f32>) {
    let last = vec2<i32>(textureDimensions(fill_field_tex)) - 1;
    if textureLoad(fill_field_tex, clamp(vec2<i32>(position.xy / BLOCK), vec2(0), last)).y == 0u {
        discard;
    }
}

struct Filled {
    // Linear color times opacity, and opacity.
    @location(0) color: vec4<f32>,
    // Where anything is placed among it.
    @location(1) geometry: vec4<u32>,
}

// Color between the middles of pixels, of which the nearest one shows a surface: where colors meet that wander there are no stairs,
// and what does not wander stays as it is.
fn shaded_at(y: vec2<f32>) -> vec4<f32> {
    let first = vec2<i32>(floor(y - 0.5));
    let f = y - 0.5 - vec2<f32>(first);
    let is_surface = four_at(surface_id_tex, first) != vec4(0u);
    let weights = select(vec4(0.0), vec4(1.0 - f.x, f.x, 1.0 - f.x, f.x) * vec4(1.0 - f.yy, f.yy), is_surface);
    let last = vec2<i32>(frame.size) - 1;
    var sum = vec4(0.0);
    for (var i = 0; i < 4; i++) {
        let px = clamp(first + vec2(i & 1, i >> 1u), vec2(0), last);
        sum += weights[i] * textureLoad(shaded_tex, px, 0);
    }
    return sum / max(dot(weights, vec4(1.0)), 1e-6);
}

@fragment
fn fs_fill(@builtin(position) position: vec4<f32>) -> Filled {
    let px = vec2<i32>(position.xy);
    let x = vec2<f32>(px) + 0.5;
    let rough = roughened(x);
    var source = Source(x, vec2(0.0));
    if sketch.shows_fill == 1u {
        source = fill_source(x);
    }
    let y = inside(source.at + rough);
    var texel = geometry_at(vec2<i32>(floor(y)));
    let s = unpack_surfel(texel);
    if s.object == 0u {
        discard;
    }
    var depth = s.depth;
    let other = surface_at(px);
    var slack = tolerance(px, source.at, depth, other, FILL_TOLERANCE);
    if WITH_NEARER {
        depth = nearest_depth(x, rough);
        slack = 0.0;
        texel.z = bitcast<u32>(depth);
    }
    if is_behind(other, depth, slack) {
        discard;
    }
    var color = vec4(0.0);
    var opacity = 1.0;
    if sketch.shows_fill == 1u {
        let shaded = shaded_at(y);
        opacity = select(1.0, shaded.a, WITH_OPACITY);
        let own = shaded.rgb / max(shaded.a, 1e-4);
        var density = sketch.opacity;
        if WITH_DARKNESS {
            // As dark as it looks; and pigment that covers so much of bright paper looks so much darker.
            let light = pow(clamp(dot(own, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0), 1.0 / 2.2);
            density = 1.0 - pow(1.0 - density * (1.0 - light), 2.2);
        }
        density *= min(shaded.a / max(opacity, 1e-4), 1.0);
        var pigment = mix(sketch.pigment, own, sketch.object_color);
        density *= stroke_share(x, s.object);
        if WITH_PRESSURE {
            density *= pressed(source.noise);
        }
        if WITH_SMUDGE {
            let found = textureLoad(near_line_tex, px).x;
            if found != 0u {
                let near_px = pixel_of(found);
                let away = distance(vec2<f32>(near_px) + 0.5, x) / (9.0 * sketch.pixels_per_reference);
                let smudged = sketch.smudge * exp(-away * away);
                pigment = mix(pigment, sketch.smudge_color, smudged / max(smudged + density, 1e-4));
                density = smudged + density * (1.0 - smudged);
            }
        }
        color = vec4(pigment, 1.0) * deposited(density, x) * opacity;
    }
    if WITH_HIDDEN {
        let noise = select(fill_noise(x, s.object), source.noise, sketch.shows_fill == 1u);
        let from_px = vec2<i32>(inside(x + rough + applied(sketch.passes[0].matrix, noise)));
        color = over(textureLoad(hidden_tex, from_px, 0), color);
    }
    if WITH_OPACITY {
        color += (1.0 - opacity) * textureLoad(before_tex, px, 0);
    }
    return Filled(color, texel);
}

// Marks where ink of this sketch or of what is placed already can be.
@fragment
fn fs_inked(@builtin(position) position: vec4<f32>) {
    let px = vec2<i32>(position.xy);
    var any = covered_by_lines(px);
    if WITH_OPERATORS {
        let last = vec2<i32>(textureDimensions(fill_field_tex)) - 1;
        any |= textureLoad(fill_field_tex, clamp(px / i32(BLOCK), vec2(0), last)).y;
    }
    if WITH_OPAQUE_INK {
        any |= textureLoad(opaque_ink_tex, px).z;
    }
    if any == 0u {
        discard;
    }
}

// Whether what has been placed at a pixel hides a line that comes from y.
fn is_covered(line: Line, px: vec2<i32>, y: vec2<f32>, other: Surfel) -> bool {
    let most = tolerance(px, y, line.depth, other, INK_TOLERANCE) + slack();
    return !WITH_NEARER && hides(other, px, line.depth, -line.away, most);
}

// Ink of the pass at a pixel.
fn drawn_ink(px: vec2<i32>, other: Surfel, rough: vec2<f32>) -> Line {
    let x = vec2<f32>(px) + 0.5;
    let sketched = sketch.passes[pass_number];
    var line = no_line();
    if WITH_EXACT {
        line = lines_at_place(inside(x + rough), unpack_surfel(vec4(0u)));
        if line.ink.a > 0.0 && is_covered(line, px, x + line.to_source, other) {
            line = no_line();
        }
    }
    if WITH_OPERATORS {
        let source = line_source(x, pass_number);
        let y = inside(source.at + rough);
        let from_px = vec2<i32>(floor(y));
        var ink = with_operator_ink(no_line(), textureLoad(operator_map_tex, from_px), unpack_surfel(geometry_at(from_px)));
        if WITH_PRESSURE {
            ink.ink *= pressed(source.noise);
        }
        if ink.ink.a > 0.0 && !is_covered(ink, px, source.at, other) {
            ink.ink = over(ink.ink, line.ink);
            line = ink;
        }
    }
    if line.ink.a <= 0.0 {
        return no_line();
    }
    let color = select(line.ink.rgb / line.ink.a, sketched.color, sketched.has_color == 1u);
    line.ink = vec4(color, 1.0) * deposited(line.ink.a * sketched.opacity, x);
    return line;
}

// Ink and its depth, with what has been placed before.
struct Inked {
    ink: vec4<f32>,
    depth: f32,
    // Whether what is in front is of this sketch.
    is_own: bool,
}

fn inked(px: vec2<i32>) -> Inked {
    let other = surface_at(px);
    let rough = roughened(vec2<f32>(px) + 0.5);
    let line = drawn_ink(px, other, rough);
    var ink = line.ink;
    var depth = line.depth;
    var is_own = ink.a > 0.0;
    if WITH_NEARER && ink.a > 0.0 {
        let nearest = nearest_depth(vec2<f32>(px) + 0.5, rough);
        depth = select(depth, nearest, nearest != 0.0);
        if nearest == 0.0 || is_behind(other, depth, 0.0) {
            ink = vec4(0.0);
        }
    }
    if WITH_OPAQUE_INK {
        let texel = textureLoad(opaque_ink_tex, px);
        let before = placed_color(texel);
        let before_depth = bitcast<f32>(texel.z);
        var is_occluded = false;
        if BEFORE_IS_OTHER {
            let filled = unpack_surfel(textureLoad(filled_tex, px));
            // Only what this sketch has put before it can hide it.
            let is_new = filled.object != other.object || filled.depth != other.depth;
            is_occluded = is_new && is_behind(filled, before_depth, 2.0);
        }
        if before.a > 0.0 && !is_occluded {
            // Earlier passes lie beneath, wherever their lines come from.
            let is_earlier = !BEFORE_IS_OTHER && texel.w == 1u;
            let is_nearer = ink.a > 0.0 && (is_earlier || depth <= before_depth);
            is_own = is_nearer || is_earlier;
            ink = select(over(before, ink), over(ink, before), is_nearer);
            depth = select(before_depth, min(depth, before_depth), is_nearer);
        }
    }
    return Inked(ink, depth, is_own);
}

// Ink to be tested against what is placed later.
@fragment
fn fs_ink(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let inked = inked(vec2<i32>(position.xy));
    var texel = pack_placed(inked.ink, inked.depth);
    texel.w = select(0u, 1u, inked.is_own && inked.ink.a > 0.0);
    return texel;
}

// Ink over the color.
@fragment
fn fs_lay_ink(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return inked(vec2<i32>(position.xy)).ink;
}
