// The lines that topology knows (silhouettes, borders, creases, material boundaries), where something of them is visible:
// the pixels of each segment, one per step along it. Software devices run both sides of a branch, so steps are culled first,
// and only those that are left are looked at closely. passes/segment_points.wgsl puts what is found into the edge map.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl
#import common/line_width.wgsl
#import common/kept.wgsl
#import common/segment_point.wgsl
#import gpu/record_texture.wgsl
#import common/repeated.wgsl

// Whether any object has holes by alpha: there a line needs one of its own surfaces beside it.
override WITH_HOLES: bool = true;
// Whether the G-buffer is a depth layer: only what its own surfaces carry is a line of it.
override IN_LAYER: bool = false;
// Whether segments are drawn elsewhere than they are tested.
override WITH_STROKES: bool = false;

var surface_id_tex: texture_storage_2d<r32uint, read>;
// `LineSegment` of src/geometry/line_segments.rs, four texels each.
var segment_tex: texture_storage_2d<rgba32uint, read>;
// With strokes: `Tested` of src/geometry/line_segments/strokes.rs, two texels each.
var tested_tex: texture_storage_2d<rgba32uint, read>;
// Number of a segment, and how many steps from its beginning, two in a texel; at the end `NO_STEP`.
var step_tex: texture_storage_2d<rgba32uint, read>;
// Where layers are asked about each step, once for all of them: its pixel (column in the lower 16 bits, row in the upper
// ones; `NO_STEP`: nowhere), five pixels around it, of which each lies three bits (plus 4) farther in x and in y, and the
// surface ids of its two sides.
var placed_tex: texture_storage_2d<rgba32uint, write>;
// While steps are culled: those that are kept, in any order.
var<storage, read_write> keeping: Counting;
var<storage, read_write> keeping_steps: array<u32>;
var place_tex: texture_storage_2d<rgba32uint, read>;
// Without repeated lines: the spines of all nearer layers.
var nearer_lines_tex: texture_storage_2d<r32uint, read>;
// Afterwards the same.
var<storage, read> kept: Kept;
var<storage, read> kept_steps: array<u32>;
// What is found of them, in any order.
var<storage, read_write> points: array<SegmentPoint>;
// The greatest key of each pixel.
var<storage, read_write> keys: array<atomic<u32>>;
var<storage, read_write> finding: Counting;

// Steps per workgroup, as in src/render/passes/segments.rs.
const GROUP: u32 = 256u;
// Steps fill whole workgroups; this stands for none.
const NO_STEP: u32 = 0xffffffffu;

// So far, in pixels, may a surface lie before a line that is drawn on it.
const SLACK: f32 = 0.4;
// How far beside the spine is looked, px: just far enough that the pixel lies wholly on that side.
const BESIDE: f32 = 0.8;
// Set in the class of a segment that nobody asked for: it is not drawn, but explains why two surfaces meet here.
const SUPPRESSED: u32 = 0x80000000u;
// Set too in that of one which is drawn as strokes: it explains as much as if it were drawn.
const ELSEWHERE: u32 = 0x40000000u;

struct Segment {
    // Both ends, px.
    ends: vec4<f32>,
    // Linear depth of the ends, then their position along the line, px.
    depths_arcs: vec4<f32>,
    // Dihedral angle, radians.
    angle: f32,
    // Class, object, surface ids of the two sides.
    ids: vec4<u32>,
}

fn segment_at(index: u32) -> Segment {
    let ends = bitcast<vec4<f32>>(texel_at(segment_tex, 4u * index));
    let others = texel_at(segment_tex, 4u * index + 2u);
    return Segment(
        ends + frame.jitter.xyxy,
        bitcast<vec4<f32>>(texel_at(segment_tex, 4u * index + 1u)),
        bitcast<f32>(others.x),
        vec4(others.yzw, texel_at(segment_tex, 4u * index + 3u).x),
    );
}

// Where a segment is tested.
fn tested_at(v: Segment, index: u32) -> Segment {
    let ends = bitcast<vec4<f32>>(texel_at(tested_tex, 2u * index));
    return Segment(ends + frame.jitter.xyxy, v.depths_arcs, v.angle, v.ids);
}

// How a segment is drawn.
struct Hand {
    // At both ends.
    weights: vec2<f32>,
    // The greatest counts where segments share a pixel.
    precedence: f32,
    is_stroke: bool,
}

fn hand_at(index: u32) -> Hand {
    if !WITH_STROKES {
        return Hand(vec2(1.0), 1.0, false);
    }
    let texel = texel_at(tested_tex, 2u * index + 1u);
    return Hand(bitcast<vec2<f32>>(texel.xy), bitcast<f32>(texel.z), texel.w == 1u);
}

fn step_at(number: u32) -> vec2<u32> {
    let both = texel_at(step_tex, number / 2u);
    return select(both.xy, both.zw, number % 2u == 1u);
}

// The pixel of a step along the longer side of a segment, which is half a pixel longer on both sides, so that every segment
// meets the next one; `false` behind its end or beyond the picture.
struct Place {
    px: vec2<f32>,
    is_on: bool,
}

fn place_of(ends: vec4<f32>, step: u32) -> Place {
    let d = ends.zw - ends.xy;
    let is_steep = abs(d.y) > abs(d.x);
    // Along, across.
    let from_end = select(ends.xy, ends.yx, is_steep);
    let to_end = select(ends.zw, ends.wz, is_steep);
    let side = to_end - from_end;
    let first = ceil(min(from_end.x, to_end.x) - 1.0);
    let along = first + f32(step) + 0.5;
    let slope = select(0.0, side.y / side.x, abs(side.x) > 1e-5);
    let at = vec2(along, from_end.y + (along - from_end.x) * slope);
    let px = floor(select(at, at.yx, is_steep));
    let is_on = along < max(from_end.x, to_end.x) + 0.5;
    return Place(px, is_on && all(px >= vec2(0.0)) && all(px < frame.size));
}

fn texel_of(at: vec2<f32>) -> vec2<i32> {
    return clamp(vec2<i32>(floor(at)), vec2(0), vec2<i32>(frame.size) - 1);
}

// How far along the normal of a spine pixels are asked for the surfaces that carry it, px.
const PLACES: array<f32, 5> = array(-2.0 * BESIDE, -BESIDE, 0.0, BESIDE, 2.0 * BESIDE);

fn texel_beside(spine: Spine, along: f32) -> vec2<i32> {
    return texel_of(spine.at + along * spine.normal);
}

// Whether one of these surfaces is seen on either side of a spine, or on it.
fn is_carried_beside(spine: Spine, surface_ids: vec2<u32>) -> bool {
    var found = false;
    for (var i = 1; i <= 3; i++) {
        found = found || any(surface_ids == vec2(textureLoad(surface_id_tex, texel_beside(spine, PLACES[i])).x));
    }
    return found;
}

// What a pixel near the spine shows.
struct Beside {
    surfel: Surfel,
    // How far its surface, continued to the spine, lies before it, px.
    lead: f32,
    // Whether a layer's surface is one of the segment's and runs through the spine, as exactly as its slope allows: curved
    // surfaces bend away from their plane the more, the steeper it is.
    carries: bool,
}

// So far along the normal of the spine, px.
fn beside(spine: Spine, along: f32, surface_ids: vec2<u32>) -> Beside {
    let px = texel_beside(spine, along);
    var surface_id = 0u;
    var texel = textureLoad(geometry_tex, px);
    if IN_LAYER {
        surface_id = textureLoad(surface_id_tex, px).x;
        // Where a layer has nothing its geometry is undefined.
        texel = select(texel, vec4(0u), surface_id == 0u);
    }
    let s = unpack_surfel(texel);
    let plane = plane_of(px, s.depth, s.face_normal);
    let lead = nearness_at(plane, spine.at - vec2<f32>(px) - 0.5) - spine.nearness;
    var carries = false;
    if IN_LAYER {
        let miss = abs(lead) - length(plane.slope);
        carries = any(surface_ids == vec2(surface_id)) && step_px(miss, spine.depth) <= 2.0;
    }
    return Beside(s, select(step_px(lead, spine.depth), -1e9, s.object == 0u), carries && s.object != 0u);
}

// The length of an edge, in scene units.
fn length_of(v: Segment) -> f32 {
    return distance(pos_view_at(v.ends.xy, v.depths_arcs.x), pos_view_at(v.ends.zw, v.depths_arcs.y));
}

// Cosine of the angle between normals of one smooth surface.
const SMOOTH: f32 = 0.96;
// The same of both sides of a fold that only the triangles of a smooth surface have, the most of it that may face the eye, and
// how far across the surface its sides may lie apart, in lengths of its edge.
const FOLDED: f32 = 0.8;
const GRAZING: f32 = 0.5;
const LIFTED: f32 = 0.05;

// Whether one smooth surface goes on under a spine, whatever topology thinks: at a seam that could not be mended, at needles
// that are turned over, and where triangles fold to and fro around the contour of the surface that they stand for. The sides of
// such a fold are seen aslant, agree in their normals and lie in one tangent plane, as far as triangles of that size can tell;
// those of a contour do so only at its very end.
fn goes_on_under(spine: Spine, own: u32, edge_length: f32) -> bool {
    let one_px = texel_beside(spine, PLACES[0]);
    let other_px = texel_beside(spine, PLACES[4]);
    let surface_id = textureLoad(surface_id_tex, one_px).x;
    let one = unpack_surfel(textureLoad(geometry_tex, one_px));
    let other = unpack_surfel(textureLoad(geometry_tex, other_px));
    // Where a layer has nothing, surface id 0, its geometry is undefined.
    let alike = dot(one.normal, other.normal);
    let is_same = surface_id != 0u && surface_id == textureLoad(surface_id_tex, other_px).x
        && one.object == own && other.object == own && alike > FOLDED;
    if !is_same {
        return false;
    }
    let one_at = pos_view_of(one_px, one.depth);
    let towards = towards_eye(one_at);
    let facing = max(dot(one.normal, towards), dot(other.normal, towards));
    let across = dot(one_at - pos_view_of(other_px, other.depth), normalize(one.normal + other.normal));
    if facing < GRAZING && abs(across) < LIFTED * edge_length {
        return true;
    }
    if alike < SMOOTH {
        return false;
    }
    // Both sides meet at the spine.
    let here = plane_of(one_px, one.depth, one.face_normal);
    let there = plane_of(other_px, other.depth, other.face_normal);
    let at_spine = spine.at - 0.5;
    let gap = nearness_at(here, at_spine - vec2<f32>(one_px)) - nearness_at(there, at_spine - vec2<f32>(other_px));
    var greatest = abs(step_px(gap, one.depth));
    // Nothing may open between them, such as a narrow window.
    for (var i = 1; i < 4; i++) {
        let px = texel_beside(spine, PLACES[i]);
        let between = unpack_surfel(textureLoad(geometry_tex, px));
        let miss = min(
            abs(nearness_at(here, vec2<f32>(px - one_px)) - nearness_of(between.depth)),
            abs(nearness_at(there, vec2<f32>(px - other_px)) - nearness_of(between.depth)),
        );
        let is_there = between.object == own && textureLoad(surface_id_tex, px).x != 0u;
        greatest = max(greatest, select(1e9, step_px(miss, one.depth), is_there));
    }
    return greatest < SLACK;
}

// Whether another object lies so far before a line there that it hides its ink.
fn is_covered(there: Beside, own: u32) -> bool {
    return there.surfel.object != own && there.lead > 2.0;
}

// Whether one of the line's own surfaces is seen there.
fn is_carried(tested: Spine, spine: Spine, left: Beside, right: Beside, surface_ids: vec2<u32>) -> bool {
    if IN_LAYER {
        return left.carries || right.carries
            || beside(spine, PLACES[2], surface_ids).carries
            || beside(spine, PLACES[4], surface_ids).carries
            || beside(spine, PLACES[0], surface_ids).carries;
    }
    return !WITH_HOLES || is_carried_beside(tested, surface_ids);
}

// Where segments share a pixel the greatest counts, 0 to 1: the widest, for it would hide the others; profile edges before inner
// ones; then the nearest, so roughly that lines at one place are told apart by the object's number: which one wins does not change
// along them. A line that goes on behind a nearer object leaves the pixel to its outline. x: where it is drawn; y: where it is
// suppressed.
fn precedence_of(own: u32, depth: f32, full_width: f32, is_profile: bool, stroke_precedence: f32, ends_here: bool) -> vec2<f32> {
    let rank = f32(u32(min(full_width * 4.0, 126.0))) + select(0.0, 0.5, is_profile);
    let roughly = bitcast<f32>(bitcast<u32>(depth) & ~0xfffu);
    let clip = frame.clip_from_view * vec4(0.0, 0.0, -roughly, 1.0);
    let nearest = clip.z / clip.w * (1.0 - f32(own & 63u) / f32(64 << 12u));
    // Of strokes the same time of drawing counts everywhere, so that none tears another one along it.
    let first = select(nearest, mix(nearest, stroke_precedence, 0.5), WITH_STROKES);
    let drawn = select(rank + 1.0 + 0.499 * first, 0.5 + 0.499 * first, ends_here);
    return vec2(drawn, 0.5 * nearest) / 128.0;
}

// The point of a segment's line next to the center of a pixel.
struct Spine {
    // px.
    at: vec2<f32>,
    // Share of the way from one end to the other.
    t: f32,
    tangent: vec2<f32>,
    // To its left.
    normal: vec2<f32>,
    // 0 for a segment without a length.
    inverse_length: f32,
    nearness: f32,
    depth: f32,
}

// A direction, and the inverse of the length; 0 for a segment without one.
fn direction_of(v: Segment) -> vec3<f32> {
    let d = v.ends.zw - v.ends.xy;
    let length2 = dot(d, d);
    let inverse_length = select(0.0, inverseSqrt(length2), length2 > 1e-12);
    return vec3(select(vec2(1.0, 0.0), d * inverse_length, inverse_length > 0.0), inverse_length);
}

fn spine_at(v: Segment, px: vec2<f32>) -> Spine {
    let direction = direction_of(v);
    let t = clamp(dot(px + 0.5 - v.ends.xy, direction.xy) * direction.z, 0.0, 1.0);
    return spine_along(v, direction, t);
}

// The point for which another one stands that is as far along.
fn tested_spine(v: Segment, number: u32, spine: Spine) -> Spine {
    if !WITH_STROKES {
        return spine;
    }
    let tested = tested_at(v, number);
    return spine_along(tested, direction_of(tested), spine.t);
}

fn spine_along(v: Segment, direction: vec3<f32>, t: f32) -> Spine {
    let tangent = direction.xy;
    let at = mix(v.ends.xy, v.ends.zw, t);
    let nearness = mix(nearness_of(v.depths_arcs.x), nearness_of(v.depths_arcs.y), t);
    return Spine(at, t, tangent, vec2(tangent.y, -tangent.x), direction.z, nearness, depth_of(nearness));
}

// What is found at a pixel of a segment.
fn point_at(v: Segment, number: u32, px: vec2<f32>) -> SegmentPoint {
    let spine = spine_at(v, px);
    let depth = spine.depth;
    let surface_ids = v.ids.zw;
    let tested = tested_spine(v, number, spine);
    let hand = hand_at(number);
    let left = beside(tested, PLACES[3], surface_ids);
    let right = beside(tested, PLACES[1], surface_ids);
    let own = v.ids.y;
    if min(left.lead, right.lead) > SLACK || !is_carried(tested, spine, left, right, surface_ids) {
        return NO_POINT;
    }
    // The outside is where the line's own object ends, or else where the surface lies farther back.
    let left_is_own = left.surfel.object == own;
    let left_is_outside = select(left.lead < right.lead, !left_is_own, left_is_own != (right.surfel.object == own));
    let behind = select(right.surfel.object, left.surfel.object, left_is_outside);
    let step_behind = -select(right.lead, left.lead, left_is_outside);

    var class_of = (v.ids.x & 15u) + 1u;
    if class_of <= BORDER && behind != 0u && behind != own {
        class_of = OBJECT;
    }
    let index = class_of - 1u;
    var weight = crease_weight(own, v.angle);
    if class_of <= OBJECT {
        // Without a threshold, what stands on a surface (or slightly in it) has a line at its foot.
        let threshold = edge_styles[own].lines[index].threshold;
        if threshold > 0.0 && step_behind < threshold || goes_on_under(tested, own, length_of(v)) {
            return NO_POINT;
        }
        weight = 1.0;
    } else if class_of == MATERIAL || class_of == SECTION {
        weight = 1.0;
    }
    let is_drawn = edge_styles[own].lines[index].strength > 0.0 && weight > 0.0;
    let is_suppressed = (v.ids.x & SUPPRESSED) != 0u || !is_drawn;
    let pos_view = pos_view_of(vec2<i32>(px), depth);
    let front = select(left.surfel.normal, right.surfel.normal, left_is_outside);
    let full_width = half_width(own, class_of, pos_view, front);
    var width = full_width;
    if WITH_STROKES {
        // A hand that presses less draws lines paler and thinner.
        let pressed = mix(hand.weights.x, hand.weights.y, spine.t);
        weight *= mix(1.0, pressed, 0.7);
        width *= mix(1.0, pressed, 0.6);
    }
    let arc = mix(v.depths_arcs.z, v.depths_arcs.w, spine.t);
    let edge = Edge(
        class_of,
        own,
        spine.at - px - 0.5,
        pack_tangent(spine.tangent),
        select(-1.0, 1.0, left_is_outside),
        // Of short segments only some have a pixel: each goes on to the next one that has.
        clamp(0.5 / max(spine.inverse_length, 1e-6), 0.5, 0.75) * select(0.0, 1.0, spine.inverse_length > 0.0),
        depth,
        width,
        arc / edge_styles[own].dash_period,
        select(weight, 0.0, is_suppressed),
    );
    let ends_here = is_covered(left, own) || is_covered(right, own);
    let is_profile = is_of_profile(class_of);
    let precedence = precedence_of(own, depth, full_width, is_profile, hand.precedence, ends_here);
    let order = select(precedence.x, precedence.y, is_suppressed);
    var texel = pack_edge(edge);
    texel.w |= select(0u, STROKE, hand.is_stroke);
    let is_rim = class_of <= OBJECT;
    // Strokes cross each other: there is no room around any line.
    let nearness = select(1.0 - range_share(depth), 0.0, WITH_STROKES);
    let packed = spine_of(texel, halves_of(own, class_of), select(0.0, 1.0, is_profile && !WITH_STROKES), nearness);
    let mark = select(0u, 1u, is_rim || !is_suppressed || (is_drawn && (v.ids.x & ELSEWHERE) != 0u));
    // Positive numbers have the order of their bits, and those below 1 leave two of them.
    return SegmentPoint(texel, packed, (bitcast<u32>(order) << 1u) | mark, u32(px.x) | (u32(px.y) << 16u), number);
}

@compute @workgroup_size(GROUP)
fn cs_place(@builtin(global_invocation_id) id: vec3<u32>) {
    let step = step_at(id.x);
    let segment = segment_at(step.x);
    let place = place_of(segment.ends, step.y);
    let spine = spine_at(segment, place.px);
    var around = 0u;
    for (var i = 0u; i < 5u; i++) {
        let away = vec2<u32>(texel_beside(spine, PLACES[i]) - vec2<i32>(place.px) + 4);
        around |= ((away.x & 7u) | ((away.y & 7u) << 3u)) << (6u * i);
    }
    let is_on = step.x != NO_STEP && place.is_on;
    let px = select(NO_STEP, u32(place.px.x) | (u32(place.px.y) << 16u), is_on);
    textureStore(placed_tex, texel_of_record(id.x), vec4(px, around, segment.ids.zw));
}

fn keep(number: u32) {
    let index = atomicAdd(&keeping.count, 1u);
    keeping_steps[index] = number;
    if index % GROUP == 0u {
        atomicAdd(&keeping.groups[0], 1u);
    }
}

// In a layer a step is worth a closer look if one of its surfaces is seen nearby, as few are, and no nearer layer has a line in
// this very pixel, as one has of every outline.
@compute @workgroup_size(GROUP)
fn cs_cull_layer(@builtin(global_invocation_id) id: vec3<u32>) {
    let place = texel_at(place_tex, id.x);
    let px = vec2<i32>(vec2(place.x & 0xffffu, place.x >> 16u));
    var is_seen = false;
    for (var i = 0u; i < 5u; i++) {
        let away = vec2<i32>(vec2(place.y >> (6u * i), place.y >> (6u * i + 3u)) & vec2(7u)) - 4;
        is_seen = is_seen || any(place.zw == vec2(textureLoad(surface_id_tex, px + away).x));
    }
    let is_repeated = WITHOUT_REPEATED && textureLoad(nearer_lines_tex, px).x != 0u;
    if place.x != NO_STEP && is_seen && !is_repeated {
        keep(id.x);
    }
}

// Otherwise, if no surface lies before it.
@compute @workgroup_size(GROUP)
fn cs_cull(@builtin(global_invocation_id) id: vec3<u32>) {
    let step = step_at(id.x);
    let segment = segment_at(step.x);
    let place = place_of(segment.ends, step.y);
    let spine = spine_at(segment, place.px);
    let tested = tested_spine(segment, step.x, spine);
    let left = beside(tested, BESIDE, segment.ids.zw);
    let right = beside(tested, -BESIDE, segment.ids.zw);
    if step.x != NO_STEP && place.is_on && min(left.lead, right.lead) <= SLACK {
        keep(id.x);
    }
}

@compute @workgroup_size(GROUP)
fn cs_points(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= kept.count {
        return;
    }
    let step = step_at(kept_steps[id.x]);
    let segment = segment_at(step.x);
    let point = point_at(segment, step.x, place_of(segment.ends, step.y).px);
    if point.key != 0u {
        let index = atomicAdd(&finding.count, 1u);
        points[index] = point;
        if index % GROUP == 0u {
            atomicAdd(&finding.groups[0], 1u);
        }
        atomicMax(&keys[(point.px >> 16u) * u32(frame.size.x) + (point.px & 0xffffu)], point.key);
    }
}
