// The lines that topology knows (silhouettes, borders, creases, material boundaries): one pixel per step along each
// segment, where something of it is visible.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl
#import common/line_width.wgsl

// Whether any object has holes by alpha: there a line needs one of its own surfaces beside it.
override WITH_HOLES: bool = true;
// Whether the G-buffer is a depth layer: only what its own surfaces carry is a line of it.
override IN_LAYER: bool = false;

@group(1) @binding(1) var region_tex: texture_2d<u32>;
// Records of `LineSegment` in src/geometry/line_segments.rs.
@group(1) @binding(3) var<storage, read> segments: array<u32>;

const RECORD_WORDS: u32 = 13u;

// So far, in pixels, may a surface lie before a line that is drawn on it.
const SLACK: f32 = 0.4;
// How far beside the spine is looked, px: just far enough that the pixel lies wholly on that side.
const BESIDE: f32 = 0.8;
// Set in the class of a segment that nobody asked for: it is not drawn, but explains why two surfaces meet here.
const HIDDEN: u32 = 0x80000000u;

struct Segment {
    @builtin(position) position: vec4<f32>,
    // Both ends, px.
    @location(0) @interpolate(flat) ends: vec4<f32>,
    // Linear depth of the ends, then their position along the line, px.
    @location(1) @interpolate(flat) depths_arcs: vec4<f32>,
    // Class, object, regions of the two sides.
    @location(2) @interpolate(flat) ids: vec4<u32>,
    // Direction, the inverse of the length, and the dihedral angle (radians).
    @location(3) @interpolate(flat) tangent_length_angle: vec4<f32>,
    // The direction as it is packed.
    @location(4) @interpolate(flat) packed_tangent: u32,
}

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> Segment {
    let r = (vertex / 2u) * RECORD_WORDS;
    let ends = bitcast<vec4<f32>>(vec4(segments[r], segments[r + 1u], segments[r + 2u], segments[r + 3u]))
        + frame.jitter.xyxy;
    let depths_arcs =
        bitcast<vec4<f32>>(vec4(segments[r + 4u], segments[r + 5u], segments[r + 6u], segments[r + 7u]));
    let bend = bitcast<f32>(segments[r + 8u]);
    let ids = vec4(segments[r + 9u], segments[r + 10u], segments[r + 11u], segments[r + 12u]);
    let d = ends.zw - ends.xy;
    let major = max(max(abs(d.x), abs(d.y)), 1e-6);
    let step = select(vec2(1.0, 0.0), d / major, major > 1e-5);
    // Half a pixel longer on both sides, so that every segment meets the next one.
    let at = select(ends.xy - 0.5 * step, ends.zw + 0.5 * step, (vertex & 1u) == 1u);
    let ndc = at / frame.size * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    let length2 = dot(d, d);
    let inverse = select(0.0, inverseSqrt(length2), length2 > 1e-12);
    let tangent = select(vec2(1.0, 0.0), d * inverse, inverse > 0.0);
    return Segment(
        vec4(ndc, 0.5, 1.0), ends, depths_arcs, ids, vec4(tangent, inverse, bend), pack_tangent(tangent),
    );
}

struct Out {
    @location(0) edge: vec4<u32>,
    @location(1) spine: u32,
    @location(2) mark: f32,
    @builtin(frag_depth) depth: f32,
}

// What a pixel beside the spine shows.
struct Beside {
    surfel: Surfel,
    // How far its surface, continued to the spine, lies before it, px.
    lead: f32,
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

// Whether a layer's surface at a pixel is one of these and runs through the spine, as exactly as its slope allows: curved
// surfaces bend away from their plane the more, the steeper it is.
fn carries(px: vec2<i32>, regions: vec2<u32>, spine: vec2<f32>, nearness: f32, depth: f32) -> bool {
    let q = clamp(px, vec2(0), vec2<i32>(frame.size) - 1);
    let s = unpack_surfel(geometry_at(q));
    let plane = plane_of(q, s.depth, s.face_normal);
    let miss = abs(nearness_at(plane, spine - vec2<f32>(q) - 0.5) - nearness) - length(plane.slope);
    return any(regions == vec2(textureLoad(region_tex, q, 0).x)) && step_px(miss, depth) <= 2.0;
}

fn beside(at: vec2<f32>, spine: vec2<f32>, nearness: f32, depth: f32) -> Beside {
    let px = clamp(vec2<i32>(floor(at)), vec2(0), vec2<i32>(frame.size) - 1);
    let s = unpack_surfel(geometry_at(px));
    if s.object == 0u {
        return Beside(s, -1e9);
    }
    let plane = plane_of(px, s.depth, s.face_normal);
    let lead = step_px(nearness_at(plane, spine - vec2<f32>(px) - 0.5) - nearness, depth);
    return Beside(s, lead);
}

@fragment
fn fs_main(v: Segment) -> Out {
    let px = floor(v.position.xy);
    let center = px + 0.5;
    let tangent = v.tangent_length_angle.xy;
    let t = clamp(dot(center - v.ends.xy, tangent) * v.tangent_length_angle.z, 0.0, 1.0);
    let spine = mix(v.ends.xy, v.ends.zw, t);
    let nearness = mix(nearness_of(v.depths_arcs.x), nearness_of(v.depths_arcs.y), t);
    let depth = depth_of(nearness);
    let normal = vec2(tangent.y, -tangent.x);

    let left = beside(spine + BESIDE * normal, spine, nearness, depth);
    let right = beside(spine - BESIDE * normal, spine, nearness, depth);
    let own = v.ids.y;
    var is_visible = min(left.lead, right.lead) <= SLACK;
    if WITH_HOLES {
        is_visible = is_visible && is_beside(vec2<i32>(px), v.ids.zw);
    }
    if IN_LAYER {
        var is_carried = false;
        for (var side = -2; side <= 2; side++) {
            let at = vec2<i32>(floor(spine + f32(side) * BESIDE * normal));
            is_carried = is_carried || carries(at, v.ids.zw, spine, nearness, depth);
        }
        is_visible = is_visible && is_carried;
    }
    if !is_visible {
        discard;
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
    var weight = crease_weight(own, v.tangent_length_angle.w);
    if class_of <= OBJECT {
        // Without a threshold, what stands on a surface (or slightly in it) has a line at its foot.
        let threshold = edge_styles[own].lines[index].threshold;
        if threshold > 0.0 && step_behind < threshold {
            discard;
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
        v.packed_tangent,
        select(-1.0, 1.0, left_is_outside),
        // Of short segments only some have a pixel: each goes on to the next one that has.
        clamp(0.5 / max(v.tangent_length_angle.z, 1e-6), 0.5, 0.75) * select(0.0, 1.0, v.tangent_length_angle.z > 0.0),
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
    return Out(texel, packed, select(0.5, 1.0, is_rim || !is_hidden), order);
}
