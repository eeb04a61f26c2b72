// A pixel of a line that topology knows.

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

// What segments have in a pixel: 0, `EXPLAINED`, or both bits.
const EXPLAINED: u32 = 1u;
const DRAWN: u32 = 2u;

fn mark_of(key: u32) -> u32 {
    return EXPLAINED | ((key & 1u) * DRAWN);
}
