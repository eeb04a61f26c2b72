// Steps along segments, a pixel each.
#import common/frame.wgsl
#import gpu/record_list.wgsl
#import gpu/record_texture.wgsl

// Runs of successive steps along one segment: its number, and how many steps from its beginning the first one is; at the end
// `NO_RUN`.
var run_tex: texture_storage_2d<rgba32uint, read>;

// Steps of a run, as in src/render/passes/segments.rs; the last run of a segment goes on behind its end.
const RUN: u32 = 4u;
// Runs fill whole workgroups; this stands for none.
const NO_RUN: u32 = 0xffffffffu;

fn run_at(number: u32) -> vec2<u32> {
    return pair_at(run_tex, number);
}

// Number of a segment, and how many steps from its beginning; steps are numbered through all runs.
fn step_at(number: u32) -> vec2<u32> {
    return run_at(number / RUN) + vec2(0u, number % RUN);
}

// How steps go along the longer side of a segment, which is half a pixel longer on both sides, so that every segment meets the next
// one.
struct Stepping {
    is_steep: bool,
    // Where the pixel of the first one begins, px.
    first: f32,
    // Behind it there are none, px.
    last: f32,
    // One end, along and across.
    from_end: vec2<f32>,
    slope: f32,
}

fn stepping_of(ends: vec4<f32>) -> Stepping {
    let d = ends.zw - ends.xy;
    let is_steep = abs(d.y) > abs(d.x);
    let from_end = select(ends.xy, ends.yx, is_steep);
    let to_end = select(ends.zw, ends.wz, is_steep);
    let side = to_end - from_end;
    let first = ceil(min(from_end.x, to_end.x) - 1.0);
    let last = max(from_end.x, to_end.x) + 0.5;
    return Stepping(is_steep, first, last, from_end, select(0.0, side.y / side.x, abs(side.x) > 1e-5));
}

// The pixel of a step; `false` behind the end of its segment or beyond the picture.
struct StepPixel {
    px: vec2<f32>,
    is_on: bool,
}

fn step_pixel(stepping: Stepping, step: u32) -> StepPixel {
    let along = stepping.first + f32(step) + 0.5;
    let at = vec2(along, stepping.from_end.y + (along - stepping.from_end.x) * stepping.slope);
    let px = floor(select(at, at.yx, stepping.is_steep));
    return StepPixel(px, along < stepping.last && all(px >= vec2(0.0)) && all(px < frame.size));
}
