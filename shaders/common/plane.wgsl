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
    let pixel = 2.0 * frame.half_extent.y / frame.size.y;
    return difference * select(depth, 1.0, frame.orthographic == 1u) / pixel;
}

// Nearness of a plane at a pixel's center, and its change per pixel in x and y.
struct Plane {
    center: f32,
    slope: vec2<f32>,
}

fn plane_of(px: vec2<i32>, depth: f32, normal: vec3<f32>) -> Plane {
    let pos_view = pos_view_of(px, depth);
    let per_px = vec2(2.0, -2.0) * frame.half_extent / frame.size;
    let d = dot(normal, pos_view);
    if frame.orthographic == 1u {
        // Edge-on planes have no slope that could be trusted.
        return Plane(-depth, -normal.xy * per_px / max(abs(normal.z), 1e-4) * sign(normal.z));
    }
    let safe = select(1.0, d, abs(d) > 1e-12 * depth);
    return Plane(1.0 / depth, select(vec2(0.0), normal.xy * per_px / safe, abs(d) > 1e-12 * depth));
}

fn nearness_at(plane: Plane, offset: vec2<f32>) -> f32 {
    return plane.center + dot(plane.slope, offset);
}

// How much nearer than a plane the surface may lie that it was found on, a pixel or so away: a steep one may bend on the way.
fn bend_of(plane: Plane) -> f32 {
    return 0.5 * length(plane.slope);
}
