// Which steps of segments are worth a close look: passes/segments.wgsl takes it.
#import common/list_head.wgsl
#import common/repeated.wgsl
#import gpu/record_texture.wgsl
#import passes/segments/segment.wgsl
#import passes/segments/steps.wgsl
#import passes/segments/beside.wgsl

// Where layers are asked about each step, once for all of them: its pixel (column in the lower 16 bits, row in the upper
// ones; `NO_STEP`: nowhere), five pixels around it, of which each lies three bits (plus 4) farther in x and in y, and the
// surface ids of its two sides.
var placed_tex: texture_storage_2d<rgba32uint, write>;
// Afterwards the same.
var place_tex: texture_storage_2d<rgba32uint, read>;
// Without repeated lines: the spines of all nearer layers.
var nearer_lines_tex: texture_storage_2d<r32uint, read>;
// Those that are kept, in any order.
var<storage, read_write> keeping: Counting;
var<storage, read_write> keeping_steps: array<u32>;

// A step with the point of its segment's line.
struct PlacedStep {
    segment_number: u32,
    segment: Segment,
    pixel: StepPixel,
    spine: Spine,
}

fn placed_step(number: u32) -> PlacedStep {
    let step = step_at(number);
    let segment = segment_at(step.x);
    let pixel = step_pixel(segment.ends, step.y);
    return PlacedStep(step.x, segment, pixel, spine_at(segment, pixel.px));
}

@compute @workgroup_size(GROUP)
fn cs_place(@builtin(global_invocation_id) id: vec3<u32>) {
    let step = placed_step(id.x);
    let pixel = step.pixel;
    var around = 0u;
    for (var i = 0u; i < 5u; i++) {
        let away = vec2<u32>(texel_beside(step.spine, PLACES[i]) - vec2<i32>(pixel.px) + 4);
        around |= ((away.x & 7u) | ((away.y & 7u) << 3u)) << (6u * i);
    }
    let is_on = step.segment_number != NO_STEP && pixel.is_on;
    let px = select(NO_STEP, u32(pixel.px.x) | (u32(pixel.px.y) << 16u), is_on);
    textureStore(placed_tex, texel_of_record(id.x), vec4(px, around, step.segment.ids.zw));
}

fn keep(number: u32) {
    let index = atomicAdd(&keeping.count, 1u);
    keeping_steps[index] = number;
    if index % GROUP == 0u {
        atomicAdd(&keeping.groups[0], 1u);
    }
}

// In a layer a step is worth a closer look if one of its surfaces is seen nearby, as few are, and no nearer layer has a line in
// this very pixel, as one has of every outline.
@compute @workgroup_size(GROUP)
fn cs_cull_layer(@builtin(global_invocation_id) id: vec3<u32>) {
    let place = texel_at(place_tex, id.x);
    let px = vec2<i32>(vec2(place.x & 0xffffu, place.x >> 16u));
    var is_seen = false;
    for (var i = 0u; i < 5u; i++) {
        let away = vec2<i32>(vec2(place.y >> (6u * i), place.y >> (6u * i + 3u)) & vec2(7u)) - 4;
        is_seen = is_seen || any(place.zw == vec2(textureLoad(surface_id_tex, px + away).x));
    }
    let is_repeated = WITHOUT_REPEATED && textureLoad(nearer_lines_tex, px).x != 0u;
    if place.x != NO_STEP && is_seen && !is_repeated {
        keep(id.x);
    }
}

// Otherwise, if no surface lies before it.
@compute @workgroup_size(GROUP)
fn cs_cull(@builtin(global_invocation_id) id: vec3<u32>) {
    let step = placed_step(id.x);
    let tested = tested_spine(step.segment, step.segment_number, step.spine);
    let left = beside(tested, BESIDE, step.segment.ids.zw);
    let right = beside(tested, -BESIDE, step.segment.ids.zw);
    if step.segment_number != NO_STEP && step.pixel.is_on && min(left.lead, right.lead) <= SLACK {
        keep(id.x);
    }
}
