// The plane of a surfel on the screen. Nearness is 1/depth in perspective and −depth in parallel projection: both are
// affine in the picture over any plane, so that nothing depends on how a plane is tilted.
#import common/frame.wgsl

fn nearness_of(depth: f32) -> f32 {
    return select(1.0 / depth, -depth, frame.orthographic == 1u);
}

fn depth_of(nearness: f32) -> f32 {
    return select(1.0 / nearness, -nearness, frame.orthographic == 1u);
}

// A difference of nearness at a depth as a step in depth, in pixels' widths there.
fn step_px(difference: f32, depth: f32) -> f32 {
    return difference * perspective_scale(depth) * frame.px_per_view;
}

// Nearness of a plane at a pixel's center, and its change per pixel in x and y.
struct Plane {
    center: f32,
    slope: vec2<f32>,
}

// `normal`: of any length.
fn plane_of(px: vec2<i32>, depth: f32, normal: vec3<f32>) -> Plane {
    let is_parallel = frame.orthographic == 1u;
    // Edge-on planes have no slope that could be trusted.
    let d = select(dot(normal, pos_view_of(px, depth)), -sign(normal.z) * max(abs(normal.z), 1e-4), is_parallel);
    let has_slope = abs(d) > select(1e-12 * depth, 0.0, is_parallel);
    return Plane(nearness_of(depth), normal.xy * frame.view_per_px * select(0.0, 1.0 / d, has_slope));
}

fn nearness_at(plane: Plane, offset: vec2<f32>) -> f32 {
    return plane.center + dot(plane.slope, offset);
}

// How much nearer than a plane the surface may lie that it was found on, a pixel or so away: a steep one may bend on the way.
fn bend_of(plane: Plane) -> f32 {
    return 0.5 * length(plane.slope);
}
