// Caps of a section: what has ink on them.
#import common/coverage.wgsl

// Twin: `GpuCap` in src/render/effects/section.rs.
struct Cap {
    // Linear color.
    fill: vec3<f32>,
    // The object's cap in the G-buffer; 0: it has none.
    surface_id: u32,
    // Linear color of the hatching.
    ink: vec3<f32>,
    // 1: it is shaded like other surfaces.
    lit: u32,
    // Unit vector across the lines, in the picture.
    across: vec2<f32>,
    // Distance of the lines, px.
    spacing: f32,
    // How far along `across` one of them runs, px.
    offset: f32,
    // Of the lines, px; 0: plain.
    width: f32,
}

// The share of a pixel of a cap that is hatched.
fn hatched_share(cap: Cap, px: vec2<i32>) -> f32 {
    if cap.width <= 0.0 {
        return 0.0;
    }
    let t = dot(vec2<f32>(px) + 0.5 - frame.jitter, cap.across) - cap.offset;
    let at = t - cap.spacing * round(t / cap.spacing);
    let half = 0.5 * cap.width;
    // With the lines on either side, whose rims may reach as far as here.
    let beside = sign(at) * cap.spacing;
    return min(strip_share(at, -half, half, cap.across) + strip_share(at - beside, -half, half, cap.across), 1.0);
}
