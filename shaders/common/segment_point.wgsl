// A pixel of a line that topology knows.
#import common/edge_map.wgsl

// Two texels of a texture of records, in this order.
struct SegmentPoint {
    // See common/edge_map.wgsl.
    edge: vec4<u32>,
    spine: u32,
    // Of several in a pixel the greatest counts. The lowest bit is its mark: 1, or 0 if the line is not drawn but explains
    // what is there. 0: there is nothing.
    key: u32,
    // Column in the lower 16 bits, row in the upper ones.
    px: u32,
    // Number of the segment.
    segment: u32,
}

const NO_POINT: SegmentPoint = SegmentPoint(vec4<u32>(0u, 0u, 0u, 0u), 0u, 0u, 0u, 0u);

fn second_texel_of(point: SegmentPoint) -> vec4<u32> {
    return vec4(point.spine, point.key, point.px, point.segment);
}

fn point_of(texel: vec4<u32>, second: vec4<u32>) -> SegmentPoint {
    return SegmentPoint(texel, second.x, second.y, second.z, second.w);
}

// What segments have in a pixel: 0, or `EXPLAINED`, perhaps `DRAWN`, one of the last two, and above them the tangent as in the edge
// map.
const EXPLAINED: u32 = 1u;
const DRAWN: u32 = 2u;
// Whether the line is nearer to the horizontal or to the vertical one of the picture.
const LEVEL: u32 = 4u;
const UPRIGHT: u32 = 8u;

fn mark_of(point: SegmentPoint) -> u32 {
    let packed = (point.edge.x >> 16u) & 511u;
    let tangent = unpack_tangent(packed);
    let side = select(UPRIGHT, LEVEL, abs(tangent.x) >= abs(tangent.y));
    return EXPLAINED | ((point.key & 1u) * DRAWN) | side | (packed << 4u);
}

fn tangent_of(mark: u32) -> vec2<f32> {
    return unpack_tangent(mark >> 4u);
}
