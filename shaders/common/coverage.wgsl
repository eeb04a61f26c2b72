// How much of a pixel straight shapes cover.
#import common/frame.wgsl

// The share of a unit square on the near side of a straight edge at this signed distance from its center (positive:
// the center is inside); `normal` is the edge's.
fn square_share(distance: f32, normal: vec2<f32>) -> f32 {
    let n = abs(normal) * frame.coverage_ramp;
    // The square's shadow on the normal is a trapezoid.
    let outer = 0.5 * (n.x + n.y);
    let inner = 0.5 * abs(n.x - n.y);
    let d = min(abs(distance), outer);
    let height = 1.0 / max(outer + inner, 1e-6);
    var beyond = 0.5 * (outer - d) * (outer - d) * height / max(outer - inner, 1e-6);
    if d < inner {
        beyond = 0.5 - d * height;
    }
    return select(beyond, 1.0 - beyond, distance > 0.0);
}

// The share of a pixel that a strip covers: from `low` to `high` along `normal`, the pixel's center at `at`.
fn strip_share(at: f32, low: f32, high: f32, normal: vec2<f32>) -> f32 {
    return max(square_share(high - at, normal) - square_share(low - at, normal), 0.0);
}
