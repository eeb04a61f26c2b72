// Draws what passes/segments.wgsl found, a point each; where several share a pixel, the depth test decides.
#import common/frame.wgsl
#import common/segment_point.wgsl

@group(1) @binding(0) var<storage, read> points: array<SegmentPoint>;

struct Point {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) edge: vec4<u32>,
    @location(1) @interpolate(flat) spine: u32,
    @location(2) @interpolate(flat) mark: f32,
}

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> Point {
    let point = points[index];
    let px = vec2(f32(point.px & 0xffffu), f32(point.px >> 16u)) + 0.5;
    let ndc = px / frame.size * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    // What is nothing lies before the near plane.
    let depth = select(2.0, point.order, point.order > 0.0);
    return Point(vec4(ndc, depth, 1.0), point.edge, point.spine, point.mark);
}

struct Out {
    @location(0) edge: vec4<u32>,
    @location(1) spine: u32,
    @location(2) mark: f32,
}

@fragment
fn fs_main(point: Point) -> Out {
    return Out(point.edge, point.spine, point.mark);
}
