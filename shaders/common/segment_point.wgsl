// A pixel of a line that topology knows.

struct SegmentPoint {
    // See common/edge_map.wgsl.
    edge: vec4<u32>,
    spine: u32,
    // Of several in a pixel the greatest counts, 0 to 1; 0: there is nothing.
    order: f32,
    // 1, or 0.5 if it is only an explanation; see passes/discontinuities.wgsl.
    mark: f32,
    // Column in the lower 16 bits, row in the upper ones.
    px: u32,
}

const NO_POINT: SegmentPoint = SegmentPoint(vec4<u32>(0u, 0u, 0u, 0u), 0u, 0.0, 0.0, 0u);
