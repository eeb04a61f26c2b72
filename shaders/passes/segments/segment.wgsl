// Segments, and the points of their lines.
#import common/frame.wgsl
#import common/plane.wgsl
#import gpu/record_texture.wgsl

// Whether segments are drawn elsewhere than they are tested.
override WITH_STROKES: bool = false;

// `GpuSegment` of src/render/passes/segments.rs, three texels each.
var segment_tex: texture_storage_2d<rgba32uint, read>;
// With strokes: `Tested` of src/geometry/line_segments/hand_strokes.rs, two texels each.
var tested_tex: texture_storage_2d<rgba32uint, read>;

// Set in the class of a segment that nobody asked for: it is not drawn, but explains why two surfaces meet here.
const SUPPRESSED: u32 = 0x80000000u;
// Set too in that of one which is drawn as strokes: it explains as much as if it were drawn.
const ELSEWHERE: u32 = 0x40000000u;

// Bits of an object, below those of the class; twin in src/render/passes/segments.rs.
const OBJECT_BITS: u32 = 26u;

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
    let ends = bitcast<vec4<f32>>(texel_at(segment_tex, 3u * index));
    let depths_arcs = bitcast<vec4<f32>>(texel_at(segment_tex, 3u * index + 1u));
    let others = texel_at(segment_tex, 3u * index + 2u);
    let class_of = extractBits(others.y, OBJECT_BITS, 4u) | (others.y & (SUPPRESSED | ELSEWHERE));
    let own = extractBits(others.y, 0u, OBJECT_BITS);
    return Segment(ends + frame.jitter.xyxy, depths_arcs, bitcast<f32>(others.x), vec4(class_of, own, others.zw));
}

// Where a segment is tested.
fn tested_at(v: Segment, index: u32) -> Segment {
    let ends = bitcast<vec4<f32>>(texel_at(tested_tex, 2u * index));
    return Segment(ends + frame.jitter.xyxy, v.depths_arcs, v.angle, v.ids);
}

// The length of an edge, in scene units.
fn length_of(v: Segment) -> f32 {
    return distance(pos_view_at(v.ends.xy, v.depths_arcs.x), pos_view_at(v.ends.zw, v.depths_arcs.y));
}

// How a segment is drawn.
struct StrokeWeights {
    // At both ends.
    weights: vec2<f32>,
    // The greatest counts where segments share a pixel.
    precedence: f32,
    is_stroke: bool,
}

fn stroke_weights_at(index: u32) -> StrokeWeights {
    if !WITH_STROKES {
        return StrokeWeights(vec2(1.0), 1.0, false);
    }
    let texel = texel_at(tested_tex, 2u * index + 1u);
    return StrokeWeights(bitcast<vec2<f32>>(texel.xy), bitcast<f32>(texel.z), texel.w == 1u);
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

// `direction`: that of the segment.
fn spine_at(v: Segment, direction: vec3<f32>, px: vec2<f32>) -> Spine {
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
