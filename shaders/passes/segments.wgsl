// The lines that topology knows (silhouettes, borders, creases, material boundaries), where something of them is visible: the
// pixels of each segment, one per step along it, are tested side by side. passes/segment_points.wgsl draws what is found.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl
#import common/line_width.wgsl
#import common/segment_point.wgsl

// Whether any object has holes by alpha: there a line needs one of its own surfaces beside it.
override WITH_HOLES: bool = true;
// Whether the G-buffer is a depth layer: only what its own surfaces carry is a line of it.
override IN_LAYER: bool = false;

@group(1) @binding(1) var region_tex: texture_2d<u32>;
// Records of `LineSegment` in src/geometry/line_segments.rs.
@group(1) @binding(3) var<storage, read> segments: array<u32>;
// Number of a segment, and how many steps from its beginning.
@group(1) @binding(4) var<storage, read> steps: array<vec2<u32>>;
@group(1) @binding(5) var<storage, read_write> points: array<SegmentPoint>;

const RECORD_WORDS: u32 = 13u;

// So far, in pixels, may a surface lie before a line that is drawn on it.
const SLACK: f32 = 0.4;
// How far beside the spine is looked, px: just far enough that the pixel lies wholly on that side.
const BESIDE: f32 = 0.8;
// Set in the class of a segment that nobody asked for: it is not drawn, but explains why two surfaces meet here.
const HIDDEN: u32 = 0x80000000u;

struct Segment {
    // Both ends, px.
    ends: vec4<f32>,
    // Linear depth of the ends, then their position along the line, px.
    depths_arcs: vec4<f32>,
    // Dihedral angle, radians.
    angle: f32,
    // Class, object, regions of the two sides.
    ids: vec4<u32>,
}

fn segment_at(index: u32) -> Segment {
    let r = index * RECORD_WORDS;
    return Segment(
        bitcast<vec4<f32>>(vec4(segments[r], segments[r + 1u], segments[r + 2u], segments[r + 3u])) + frame.jitter.xyxy,
        bitcast<vec4<f32>>(vec4(segments[r + 4u], segments[r + 5u], segments[r + 6u], segments[r + 7u])),
        bitcast<f32>(segments[r + 8u]),
        vec4(segments[r + 9u], segments[r + 10u], segments[r + 11u], segments[r + 12u]),
    );
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

// Whether a pixel or one of its neighbours shows one of these surfaces.
fn is_beside(px: vec2<i32>, regions: vec2<u32>) -> bool {
    let last = vec2<i32>(frame.size) - 1;
    var found = false;
    for (var i = 0; i < 9; i++) {
        let q = clamp(px + vec2(i % 3, i / 3) - 1, vec2(0), last);
        found = found || any(regions == vec2(textureLoad(region_tex, q, 0).x));
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

fn beside(at: vec2<f32>, spine: vec2<f32>, nearness: f32, depth: f32, regions: vec2<u32>) -> Beside {
    let px = clamp(vec2<i32>(floor(at)), vec2(0), vec2<i32>(frame.size) - 1);
    let s = unpack_surfel(textureLoad(geometry_tex, px, 0));
    let plane = plane_of(px, s.depth, s.face_normal);
    let lead = nearness_at(plane, spine - vec2<f32>(px) - 0.5) - nearness;
    var carries = false;
    if IN_LAYER {
        let miss = abs(lead) - length(plane.slope);
        carries = any(regions == vec2(textureLoad(region_tex, px, 0).x)) && step_px(miss, depth) <= 2.0;
    }
    return Beside(s, select(step_px(lead, depth), -1e9, s.object == 0u), carries && s.object != 0u);
}

// What is found at a pixel of a segment; order 0: nothing.
fn point_at(v: Segment, px: vec2<f32>) -> SegmentPoint {
    let d = v.ends.zw - v.ends.xy;
    let length2 = dot(d, d);
    let inverse_length = select(0.0, inverseSqrt(length2), length2 > 1e-12);
    let tangent = select(vec2(1.0, 0.0), d * inverse_length, inverse_length > 0.0);
    let center = px + 0.5;
    let t = clamp(dot(center - v.ends.xy, tangent) * inverse_length, 0.0, 1.0);
    let spine = mix(v.ends.xy, v.ends.zw, t);
    let nearness = mix(nearness_of(v.depths_arcs.x), nearness_of(v.depths_arcs.y), t);
    let depth = depth_of(nearness);
    let normal = vec2(tangent.y, -tangent.x);

    let regions = v.ids.zw;
    let left = beside(spine + BESIDE * normal, spine, nearness, depth, regions);
    let right = beside(spine - BESIDE * normal, spine, nearness, depth, regions);
    let own = v.ids.y;
    var is_visible = min(left.lead, right.lead) <= SLACK;
    if WITH_HOLES {
        is_visible = is_visible && is_beside(vec2<i32>(px), regions);
    }
    if IN_LAYER {
        let is_carried = left.carries || right.carries
            || beside(spine, spine, nearness, depth, regions).carries
            || beside(spine + 2.0 * BESIDE * normal, spine, nearness, depth, regions).carries
            || beside(spine - 2.0 * BESIDE * normal, spine, nearness, depth, regions).carries;
        is_visible = is_visible && is_carried;
    }
    if !is_visible {
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
        if threshold > 0.0 && step_behind < threshold {
            return NO_POINT;
        }
        weight = 1.0;
    } else if class_of == MATERIAL || class_of == SECTION {
        weight = 1.0;
    }
    let is_hidden = (v.ids.x & HIDDEN) != 0u || edge_styles[own].lines[index].strength <= 0.0 || weight <= 0.0;
    let pos_view = pos_view_of(vec2<i32>(px), depth);
    let front = select(left.surfel.normal, right.surfel.normal, left_is_outside);
    let arc = mix(v.depths_arcs.z, v.depths_arcs.w, t);
    let edge = Edge(
        class_of,
        own,
        spine - center,
        pack_tangent(tangent),
        select(-1.0, 1.0, left_is_outside),
        // Of short segments only some have a pixel: each goes on to the next one that has.
        clamp(0.5 / max(inverse_length, 1e-6), 0.5, 0.75) * select(0.0, 1.0, inverse_length > 0.0),
        depth,
        half_width(own, class_of, pos_view, front),
        arc / edge_styles[own].dash_period,
        select(weight, 0.0, is_hidden),
    );
    // Where segments share a pixel the widest wins, for it would hide the others; profile edges before inner ones; then
    // the nearest; last the object's number, so that the order of drawing does not decide.
    let is_profile = class_of <= OBJECT || class_of == SECTION;
    let rank = f32(u32(min(edge.half_width * 4.0, 126.0))) + select(0.0, 0.5, is_profile);
    let clip = frame.clip_from_view * vec4(0.0, 0.0, -depth, 1.0);
    let nearest = bitcast<f32>((bitcast<u32>(clip.z / clip.w) & ~63u) | (own & 63u));
    let order = select(rank + 1.0 + 0.499 * nearest, 0.5 * nearest, is_hidden) / 128.0;
    let texel = pack_edge(edge);
    let is_rim = class_of <= OBJECT;
    let packed = spine_of(texel, halves_of(own), select(0.0, 1.0, is_profile), 1.0 - range_share(depth));
    let mark = select(0.5, 1.0, is_rim || !is_hidden);
    return SegmentPoint(texel, packed, order, mark, u32(px.x) | (u32(px.y) << 16u));
}

@compute @workgroup_size(64)
fn cs_main(@builtin(global_invocation_id) id: vec3<u32>) {
    let step = steps[id.x];
    let segment = segment_at(step.x);
    let place = place_of(segment.ends, step.y);
    var point = NO_POINT;
    if place.is_on {
        point = point_at(segment, place.px);
    }
    points[id.x] = point;
}
