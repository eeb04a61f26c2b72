// Steps along segments, a pixel each.
#import common/frame.wgsl
#import gpu/record_texture.wgsl

// Number of a segment, and how many steps from its beginning; at the end `NO_STEP`.
var step_tex: texture_storage_2d<rgba32uint, read>;

// Steps per workgroup, as in src/render/passes/segments.rs.
const GROUP: u32 = 256u;
// Steps fill whole workgroups; this stands for none.
const NO_STEP: u32 = 0xffffffffu;

fn step_at(number: u32) -> vec2<u32> {
    return pair_at(step_tex, number);
}

// The pixel of a step along the longer side of a segment, which is half a pixel longer on both sides, so that every segment
// meets the next one; `false` behind its end or beyond the picture.
struct StepPixel {
    px: vec2<f32>,
    is_on: bool,
}

fn step_pixel(ends: vec4<f32>, step: u32) -> StepPixel {
    let d = ends.zw - ends.xy;
    let is_steep = abs(d.y) > abs(d.x);
    // Along, across.
    let from_end = select(ends.xy, ends.yx, is_steep);
    let to_end = select(ends.zw, ends.wz, is_steep);
    let side = to_end - from_end;
    let first = ceil(min(from_end.x, to_end.x) - 1.0);
    let along = first + f32(step) + 0.5;
    let slope = select(0.0, side.y / side.x, abs(side.x) > 1e-5);
    let at = vec2(along, from_end.y + (along - from_end.x) * slope);
    let px = floor(select(at, at.yx, is_steep));
    let is_on = along < max(from_end.x, to_end.x) + 0.5;
    return StepPixel(px, is_on && all(px >= vec2(0.0)) && all(px < frame.size));
}
