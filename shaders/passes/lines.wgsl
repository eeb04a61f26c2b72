// Lines with their width and color, over the shaded surfaces.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl
#import common/coverage.wgsl
#import common/line_block.wgsl
#import common/pixel.wgsl
#import gpu/neighbors.wgsl
#import common/placed.wgsl

// Whether the operators of image-space mode have found lines of any object.
override WITH_OPERATORS: bool = true;
// Whether any object is drawn in exact mode.
override WITH_EXACT: bool = true;
// Whether lines have different widths.
override WITH_WIDTHS: bool = true;
// Whether all lines are so thin that they reach no farther than the next pixel. There is no distance field then.
override NARROW: bool = false;
// Whether they reach one pixel farther.
override NARROW_BY_TWO: bool = false;
// Whether any line is dashed.
override WITH_DASHES: bool = true;
// Whether any line takes its color from the surface.
override WITH_OBJECT_COLOR: bool = true;
// Whether lines are tested against other surfaces than those that they were found among.
override AMONG_OTHERS: bool = false;
// Whether surfaces are known all around lines: then folds end where their object does.
override ON_SURFACES: bool = false;
// Whether lines have been moved: then surfaces hide them where they come from.
override MOVED: bool = false;

var edge_map_tex: texture_storage_2d<rgba32uint, read>;
var base_color_tex: texture_2d<f32>;
// The line that reaches farthest beyond each pixel (passes/line_distance.wgsl); of narrow lines the same as `spine_tex`.
var farthest_tex: texture_2d<u32>;
// The line nearest to each pixel (passes/line_distance.wgsl); of narrow lines where there are any (passes/near_lines.wgsl).
var nearest_tex: texture_storage_2d<r32uint, read>;
// Where lines run.
var spine_tex: texture_2d<u32>;
// See passes/moved_edges.wgsl.
var source_tex: texture_storage_2d<r32uint, read>;

// A surface so far before a line, in pixels, hides it: farther than `COVERS` in passes/segments/beside.wgsl, so that no line which
// was found there is drawn in pieces.
fn slack() -> f32 {
    return select(3.0, 0.25, AMONG_OTHERS);
}

// Whether surface `g` of a pixel lies so much, px, before a line of this depth whose spine is so far from the pixel's center.
fn hides(g: Surfel, px: vec2<i32>, depth: f32, to_spine: vec2<f32>, most: f32) -> bool {
    let line = nearness_of(depth);
    let plane = plane_of(px, g.depth, g.face_direction);
    // Neither here nor where it is continued to the spine may the surface lie before the line: what an object stands
    // on does not hide the line at its foot.
    let lead = min(plane.center, nearness_at(plane, to_spine)) - line;
    return g.object != 0u && step_px(lead, depth) > most;
}

fn is_occluded(g: Surfel, px: vec2<i32>, edge: Edge, spine: vec2<f32>) -> bool {
    // As where lines are found, see passes/segments/beside.wgsl.
    let bend = select(step_px(bend_of(plane_of(px, g.depth, g.face_direction)), edge.depth), 0.0, AMONG_OTHERS);
    return g.object != edge.object && hides(g, px, edge.depth, spine - vec2<f32>(px) - 0.5, slack() + bend);
}

// Whether an edge ends before another object, or paper, that lies behind it here: what touches it there does not.
fn ends_before(g: Surfel, px: vec2<i32>, edge: Edge, spine: vec2<f32>) -> bool {
    let plane = plane_of(px, g.depth, g.face_direction);
    let farthest = max(plane.center, nearness_at(plane, spine - vec2<f32>(px) - 0.5));
    let is_behind = step_px(nearness_of(edge.depth) - farthest, edge.depth) > slack();
    return g.object == 0u || (g.object != edge.object && is_behind);
}

struct Line {
    // Linear color times coverage, and coverage.
    ink: vec4<f32>,
    // Linear depth of its spine.
    depth: f32,
    // Whether it would be here, were it not for a surface before it.
    is_occluded: bool,
    // How strong its ink is where it covers all of a pixel, 0 to 1.
    strength: f32,
    // From its spine to here, px.
    away: vec2<f32>,
    // From where it is to where it comes from, px.
    to_source: vec2<f32>,
}

// A line's color with that of its own object's surface beside the spine: inwards, or where that is another's, as at corners and
// on thin forms, all around, most inwards first; without any where the object is not seen there.
fn with_object_color(own: vec3<f32>, object: u32, spine: vec2<f32>, inwards: vec2<f32>) -> vec3<f32> {
    let last = vec2<i32>(frame.size) - 1;
    for (var i = 0; i < 17; i++) {
        let eighth = max(i - 1, 0) % 8;
        let turn = 0.7853982 * f32((eighth + 1) / 2) * f32(1 - 2 * (eighth & 1));
        let towards = vec2(inwards.x * cos(turn) - inwards.y * sin(turn), inwards.x * sin(turn) + inwards.y * cos(turn));
        let far = select(select(1.8, 0.8, i == 0), 3.6, i > 8);
        let px = clamp(vec2<i32>(floor(spine + far * towards)), vec2(0), last);
        if (geometry_at(px).w & ~ENHANCED) == object {
            let base = textureLoad(base_color_tex, px, 0).rgb;
            let style = style_of(object);
            return mix(own, base * (1.0 - edge_styles[style].darken), edge_styles[style].object_color);
        }
    }
    return own;
}

fn no_line() -> Line {
    return Line(vec4(0.0), 0.0, false, 0.0, vec2(0.0), vec2(0.0));
}

// The line of a pixel of the edge map that was found, at a place in the picture, as far as surface `g` of the pixel there does not
// hide it.
fn line_at(at: vec2<f32>, g: Surfel, from_px: vec2<i32>, texel: vec4<u32>) -> Line {
    var to_source = vec2(0.0);
    var surface = g;
    if MOVED {
        let source = textureLoad(source_tex, from_px).x;
        to_source = vec2<f32>(unpack_pixel(source) - from_px);
        surface = unpack_surfel(geometry_at(vec2<i32>(floor(at + to_source))));
    }
    let edge = unpack_edge(texel);
    let spine = vec2<f32>(from_px) + 0.5 + edge.offset;
    // It has been found that nothing lies before the edge that is drawn so.
    let is_tested = is_stroke(texel) && !AMONG_OTHERS;
    let style = style_of(edge.object);
    let index = edge.class_of - 1u;
    let d = at - spine;
    let tangent = unpack_tangent(edge.tangent);
    let left = vec2(tangent.y, -tangent.x);
    let along = dot(d, tangent);
    let past = sign(along) * max(abs(along) - edge.extent, 0.0);
    // From the nearest point of the line's piece to here.
    let away = left * dot(d, left) + tangent * past;
    let distance = length(away);
    let normal = select(left, away / distance, distance > 1e-4);
    var low = -edge.half_width;
    var high = edge.half_width;
    var across = distance;
    if edge_styles[style].alignment != 0u && is_of_profile(edge.class_of) {
        // All of the width on one side of the spine.
        let outwards = select(-1.0, 1.0, edge_styles[style].alignment == 1u) * edge.outside;
        across = distance * select(-1.0, 1.0, dot(away, left) * outwards >= 0.0);
        low = 0.0;
        high = 2.0 * edge.half_width;
    }
    var coverage = strip_share(across, low, high, normal);
    if WITH_DASHES && edge_styles[style].lines[index].dashed == 1u {
        let period = edge_styles[style].dash_period;
        let ink = edge_styles[style].dash_share * period;
        let arc = fract(edge.phase + along / period) * period;
        let inside = min(arc, ink - arc);
        let until_next = max(inside, arc - period);
        coverage *= clamp(until_next / frame.coverage_ramp + 0.5, 0.0, 1.0);
    }
    let strength = edge_styles[style].lines[index].opacity * edge.weight;
    coverage *= strength;
    // The round end of a fold that is wider than the outline there would stand out beyond it.
    let is_fold = edge.class_of == RIDGE || edge.class_of == VALLEY;
    let ends_with_object = ON_SURFACES && !NARROW && is_fold && !is_stroke(texel)
        && edge_styles[style].lines[SILHOUETTE - 1u].opacity > 0.0;
    let at_source = vec2<i32>(floor(at + to_source));
    let is_cut = ends_with_object && ends_before(surface, at_source, edge, spine + to_source);
    if coverage <= 0.0 || is_cut || (!is_tested && is_occluded(surface, at_source, edge, spine + to_source)) {
        return Line(vec4(0.0), edge.depth, coverage > 0.0, 0.0, d, to_source);
    }
    var color = edge_styles[style].lines[index].color;
    if WITH_OBJECT_COLOR {
        color = with_object_color(color, edge.object, spine + to_source, -left * edge.outside);
    }
    return Line(vec4(color, 1.0) * coverage, edge.depth, false, strength, d, to_source);
}

// A pixel's own line.
fn own_line(px: vec2<i32>) -> u32 {
    return select(0u, found_at(px), textureLoad(spine_tex, px, 0).x != 0u);
}

// How many of the lines around a pixel are looked at.
fn around_count() -> i32 {
    return 9 * select(5, select(1, 2, NARROW_BY_TWO), NARROW);
}

// The line of a pixel around another, in its neighborhood or farther and farther away.
fn found_around(px: vec2<i32>, k: i32) -> u32 {
    let reach = 1 << u32(k / 9);
    let q = clamp(px + reach * (vec2(k % 3, k / 3 % 3) - 1), vec2(0), vec2<i32>(frame.size) - 1);
    if NARROW || reach == 1 {
        return own_line(q);
    }
    return textureLoad(farthest_tex, q, 0).x;
}

// A line that has been found, and how far within its reach the pixel lies: the least counts.
struct Nearby {
    found: u32,
    power: f32,
}

fn nearer_of(best: Nearby, spine: u32, px: vec2<i32>, away: vec2<i32>) -> Nearby {
    let q = px + away;
    let r = unpack2x16float(spine >> 16u).x + 1.25;
    let d = vec2<f32>(away) + vec2(f32((spine >> 8u) & 255u), f32(spine & 255u)) / 127.0 - 1.0;
    let is_there = spine != 0u && all(vec2<u32>(q) < vec2<u32>(frame.size));
    let power = select(0.0, dot(d, d) - r * r, is_there);
    return Nearby(select(best.found, found_at(q), power < best.power), min(best.power, power));
}

// As `cs_rows` in passes/line_distance.wgsl finds it, among the neighbors.
fn found_nearby(px: vec2<i32>) -> u32 {
    var best = Nearby(0u, 0.0);
    if NARROW_BY_TWO {
        for (var i = 0; i < 9; i++) {
            let first = 2 * vec2(i % 3, i / 3) - 2;
            let spines = four_at(farthest_tex, px + first);
            for (var k = 0; k < 4; k++) {
                best = nearer_of(best, spines[k], px, first + vec2(k & 1, k >> 1u));
            }
        }
        return best.found;
    }
    // The same texture as `farthest_tex`: it is read once more for lines beside.
    var spines = nine_at(spine_tex, px);
    for (var i = 0; i < 9; i++) {
        best = nearer_of(best, spines[i], px, vec2(i % 3, i / 3) - 1);
    }
    return best.found;
}

// So far apart, px, are spines at least that are not of one line, and so far along it at most is looked.
const APART: f32 = 0.9;
const ALONG: f32 = 1.0;
// Half the width, px, up to which lines are thin: they have no ink beyond the pixels around their spine.
const THIN: f32 = 1.0;
// Angle up to which lines run side by side, of 512 for a full turn: 14 degrees.
const PARALLEL: u32 = 20u;

// A line as far as those are compared with it that are beside it.
struct Spine {
    // px.
    at: vec2<f32>,
    tangent: vec2<f32>,
    // The same as in the edge map.
    angle: u32,
    half_width: f32,
}

fn spine_at(px: vec2<i32>, texel: vec4<u32>) -> Spine {
    let edge = unpack_edge(texel);
    return Spine(vec2<f32>(px) + edge.offset, unpack_tangent(edge.tangent), edge.tangent, edge.half_width);
}

// How far a point lies across a line, px.
fn across(line: Spine, at: vec2<f32>) -> f32 {
    return abs(dot(at - line.at, vec2(line.tangent.y, -line.tangent.x)));
}

fn along(line: Spine, at: vec2<f32>) -> f32 {
    return abs(dot(at - line.at, line.tangent));
}

// Whether the line in a pixel runs along another one.
fn runs_along(px: vec2<i32>, line: Spine) -> bool {
    let turn = (unpack_edge(textureLoad(edge_map_tex, px)).tangent - line.angle) & 255u;
    return min(turn, 256u - turn) <= PARALLEL;
}

// The line that runs beside a thin one that was found at a pixel; 0: none.
fn found_beside(px: vec2<i32>, found: u32, line: Spine) -> u32 {
    var best = Nearby(0u, 0.0);
    var spines = nine_at(spine_tex, px);
    for (var i = 0; i < 9; i++) {
        let away = vec2(i % 3, i / 3) - 1;
        let offset = vec2(f32((spines[i] >> 8u) & 255u), f32(spines[i] & 255u)) / 127.0 - 1.0;
        let at = vec2<f32>(px + away) + offset;
        let next = nearer_of(best, spines[i], px, away);
        if next.found != best.found && across(line, at) > APART && along(line, at) < ALONG {
            best = next;
        }
    }
    let is_thin = found != 0u && line.half_width <= THIN;
    return select(0u, best.found, best.found != 0u && is_thin && runs_along(pixel_of(best.found), line));
}

// Where several thin lines run through a pixel, each covers its share: their sum is an even gray, the nearest one alone is not.
fn with_ink_beside(ink: vec4<f32>, first: Spine, beside: vec4<f32>, second: Spine) -> vec4<f32> {
    let width = first.half_width + second.half_width;
    let share = clamp(across(first, second.at) / max(width, 1e-6), 0.0, 1.0);
    return ink + beside * min(share, (1.0 - ink.a) / max(beside.a, 1e-6));
}

fn farthest_at(px: vec2<i32>) -> u32 {
    if NARROW {
        return found_nearby(px);
    }
    return textureLoad(farthest_tex, px, 0).x;
}

// Opacity, 0 to 1, of a thin line over a wide one that covers it. The thin one is a stroke: 1, as strokes cross each other.
// Both run along one spine, within a pixel or so: 0, as they are one line, which has the greater width. Farther apart it grows
// to 1. Where half widths differ by no more than a pixel it is 0: such lines are looked for only where the picture has others
// that differ more (WITH_WIDTHS), and must not depend on those.
fn apart(thin: Spine, wide: Spine) -> f32 {
    if wide.half_width - thin.half_width <= 1.0 {
        return 0.0;
    }
    return max(smoothstep(0.75, 1.5, across(wide, thin.at)), smoothstep(1.5, 3.0, along(wide, thin.at)));
}

fn over(front: vec4<f32>, back: vec4<f32>) -> vec4<f32> {
    return front + back * (1.0 - front.a);
}

// Not 0 where exact lines can reach a pixel, and for some beside.
fn covered_by_lines(px: vec2<i32>) -> u32 {
    var covered = 0u;
    if WITH_EXACT {
        if NARROW {
            covered |= textureLoad(nearest_tex, px / LINE_BLOCK).x;
        } else {
            covered |= textureLoad(farthest_tex, px, 0).x;
        }
        if WITH_WIDTHS {
            covered |= textureLoad(nearest_tex, px).x;
        }
    }
    return covered;
}

// Marks the pixels that lines can reach, and some beside them.
@fragment
fn fs_covered(@builtin(position) position: vec4<f32>) {
    let px = vec2<i32>(position.xy);
    var covered = covered_by_lines(px);
    if WITH_OPERATORS {
        covered |= textureLoad(edge_map_tex, px).x;
    }
    if covered == 0u {
        discard;
    }
}

// With ink of the papers' operators over it, as far as surface `g` does not hide that; `texel`: of the edge map.
fn with_operator_ink(lines: Line, texel: vec4<u32>, g: Surfel) -> Line {
    let depth = bitcast<f32>(texel.z);
    let is_occluded = g.object != 0u && step_px(nearness_of(g.depth) - nearness_of(depth), depth) > slack();
    if class_of(texel) != OPERATOR_INK || is_occluded {
        return lines;
    }
    // Edge-enhancement paper, section 5: inner edges first, then profile edges over them.
    let style = style_of(texel.y);
    let ink = operator_ink(texel) * vec2(edge_styles[style].inner_opacity, edge_styles[style].profile_opacity);
    let inner = vec4(edge_styles[style].inner_color, 1.0) * ink.x;
    let profile = vec4(edge_styles[style].profile_color, 1.0) * ink.y;
    let both = over(over(profile, inner), lines.ink);
    return Line(both, depth, false, both.a, vec2(0.0), vec2(0.0));
}

// What a pixel has of lines, as far as surface `g` does not hide them.
fn lines_at(px: vec2<i32>, g: Surfel) -> Line {
    return lines_at_place(vec2<f32>(px) + 0.5, g);
}

// The same of a place in the picture; `g`: of the pixel there.
fn lines_at_place(at: vec2<f32>, g: Surfel) -> Line {
    var lines = no_line();
    if WITH_EXACT {
        lines = exact_lines_at(at, g);
    }
    if WITH_OPERATORS && !MOVED {
        lines = with_operator_ink(lines, textureLoad(edge_map_tex, vec2<i32>(floor(at))), g);
    }
    return lines;
}

// Why a line is looked at, in this order.
const LOOK_FARTHEST: u32 = 0u;
// A hidden line may have won against one that is not: of the lines of the pixels around, the one that covers most. Right beside
// it that has been found nowhere if the hidden one is wider.
const LOOK_AROUND: u32 = 1u;
// A wide line is found farther from it than it has ink: one that ends at it is not to stop before.
const LOOK_ENDING: u32 = 2u;
const LOOK_BESIDE_FARTHEST: u32 = 3u;
// A thin line inside a wide one is the nearer one.
const LOOK_NEAREST: u32 = 4u;
const LOOK_BESIDE_NEAREST: u32 = 5u;

// Lines are looked at one after the other in one loop: what a device does for a line is then done once where there is only one.
fn exact_lines_at(at: vec2<f32>, g: Surfel) -> Line {
    let px = vec2<i32>(floor(at));
    let with_beside = !MOVED && !NARROW_BY_TWO && (NARROW || WITH_WIDTHS);
    let farthest = farthest_at(px);
    var nearest = farthest;
    if WITH_WIDTHS {
        nearest = textureLoad(nearest_tex, px).x;
    }
    let own = own_line(px);
    let may_end = !NARROW && !MOVED && own != farthest && own != nearest;

    var lines = no_line();
    var thin = no_line();
    var thin_opacity = 1.0;
    var first = Spine(vec2(0.0), vec2(0.0), 0u, 0.0);
    var beside = 0u;
    var tried = farthest;
    var around = 0;
    var step = LOOK_FARTHEST;
    var found = farthest;
    loop {
        let from_px = pixel_of(found);
        let texel = textureLoad(edge_map_tex, from_px);
        let spine = spine_at(from_px, texel);
        var line = no_line();
        if found != 0u {
            line = line_at(at, g, from_px, texel);
        }
        if step == LOOK_FARTHEST {
            lines = line;
        } else if step == LOOK_AROUND && line.ink.a > lines.ink.a {
            lines = line;
        } else if step == LOOK_ENDING {
            lines.depth = select(lines.depth, line.depth, lines.ink.a == 0.0);
            lines.strength = max(lines.strength, line.strength);
            lines.ink = over(lines.ink, line.ink);
        } else if step == LOOK_BESIDE_FARTHEST {
            lines.ink = with_ink_beside(lines.ink, first, line.ink, spine);
        } else if step == LOOK_NEAREST {
            thin = line;
            if farthest != 0u && found != 0u && !is_stroke(texel) {
                thin_opacity = apart(spine, first);
            }
        } else if step == LOOK_BESIDE_NEAREST {
            thin.ink = with_ink_beside(thin.ink, first, line.ink, spine);
        }
        if step == LOOK_FARTHEST || step == LOOK_NEAREST {
            first = spine;
            if with_beside {
                beside = found_beside(px, found, spine);
            }
        }

        found = 0u;
        if step == LOOK_FARTHEST && line.is_occluded {
            lines = no_line();
            step = LOOK_AROUND;
        }
        while step == LOOK_AROUND && around < around_count() && found == 0u {
            let next = found_around(px, around);
            found = select(next, 0u, next == tried || next == farthest);
            tried = next;
            around += 1;
        }
        if found == 0u && step < LOOK_ENDING && may_end && lines.ink.a < 1.0 {
            found = own;
            step = LOOK_ENDING;
        }
        if found == 0u && step < LOOK_BESIDE_FARTHEST && lines.ink.a < 1.0 {
            found = beside;
            step = LOOK_BESIDE_FARTHEST;
        }
        if found == 0u && step < LOOK_NEAREST && nearest != farthest {
            found = nearest;
            step = LOOK_NEAREST;
        }
        if found == 0u && step == LOOK_NEAREST && thin.ink.a < 1.0 {
            found = beside;
            step = LOOK_BESIDE_NEAREST;
        }
        if found == 0u {
            break;
        }
    }
    if nearest != farthest {
        let ink = thin.ink * thin_opacity;
        let strength = select(lines.strength, thin.strength, ink.a > 0.0);
        let depth = select(lines.depth, thin.depth, ink.a > 0.0);
        let away = select(lines.away, thin.away, ink.a > 0.0);
        let to_source = select(lines.to_source, thin.to_source, ink.a > 0.0);
        // Where both are translucent they are one ink.
        let both = over(ink, lines.ink);
        let most = max(thin.strength, lines.strength);
        lines = Line(both * min(most / max(both.a, 1e-6), 1.0), depth, false, strength, away, to_source);
    }
    return lines;
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    return lines_at(px, unpack_surfel(geometry_at(px))).ink;
}

// The same with the depth of the edge.
@fragment
fn fs_placed(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let px = vec2<i32>(position.xy);
    let line = lines_at(px, unpack_surfel(geometry_at(px)));
    return pack_placed(line.ink, line.depth);
}
