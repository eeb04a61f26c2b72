// Which steps of segments are worth a close look: passes/segments.wgsl takes it.
#import common/pixel.wgsl
#import common/repeated.wgsl
#import gpu/record_list.wgsl
#import gpu/record_texture.wgsl
#import passes/segments/segment.wgsl
#import passes/segments/steps.wgsl
#import passes/segments/beside.wgsl

// Where layers are asked about each step, once for all of them: its pixel (column in the lower 16 bits, row in the upper
// ones; `NOWHERE`: none), five pixels around it, of which each lies three bits (plus 4) farther in x and in y, and the
// surface ids of its two sides.
var placed_tex: texture_storage_2d<rgba32uint, write>;
// Afterwards the same.
var place_tex: texture_storage_2d<rgba32uint, read>;
// Without repeated lines: the spines of all nearer layers.
var nearer_lines_tex: texture_storage_2d<r32uint, read>;
// Those that are kept, in any order.
var<storage, read_write> keeping_steps: array<u32>;

const NOWHERE: u32 = 0xffffffffu;

@compute @workgroup_size(GROUP)
fn cs_place(@builtin(global_invocation_id) id: vec3<u32>) {
    let run = run_at(id.x);
    let segment = segment_at(run.x);
    let stepping = stepping_of(segment.ends);
    let direction = direction_of(segment);
    for (var step = 0u; step < RUN; step++) {
        let pixel = step_pixel(stepping, run.y + step);
        let spine = spine_at(segment, direction, pixel.px);
        var around = 0u;
        for (var i = 0u; i < 5u; i++) {
            let away = vec2<u32>(texel_beside(spine, PLACES[i]) - vec2<i32>(pixel.px) + 4);
            around |= ((away.x & 7u) | ((away.y & 7u) << 3u)) << (6u * i);
        }
        let px = select(NOWHERE, pack_pixel(vec2<i32>(pixel.px)), run.x != NO_RUN && pixel.is_on);
        textureStore(placed_tex, texel_of_record(RUN * id.x + step), vec4(px, around, segment.ids.zw));
    }
}

// Keeps those steps of a run whose bits are set.
fn keep(run: u32, steps: u32) {
    if steps == 0u {
        return;
    }
    var index = keep_many(countOneBits(steps));
    for (var left = steps; left != 0u; left &= left - 1u) {
        keeping_steps[index] = RUN * run + countTrailingZeros(left);
        index++;
    }
}

// In a layer a step is worth a closer look if one of its surfaces is seen nearby, as few are, and no nearer layer has a line in
// this very pixel, as one has of every outline.
@compute @workgroup_size(GROUP)
fn cs_cull_layer(@builtin(global_invocation_id) id: vec3<u32>) {
    var steps = 0u;
    for (var step = 0u; step < RUN; step++) {
        let place = texel_at(place_tex, RUN * id.x + step);
        let px = unpack_pixel(place.x);
        var is_seen = false;
        for (var i = 0u; i < 5u; i++) {
            let away = vec2<i32>(vec2(place.y >> (6u * i), place.y >> (6u * i + 3u)) & vec2(7u)) - 4;
            is_seen = is_seen || any(place.zw == vec2(textureLoad(surface_id_tex, px + away).x));
        }
        let is_repeated = WITHOUT_REPEATED && textureLoad(nearer_lines_tex, px).x != 0u;
        steps |= select(0u, 1u << step, place.x != NOWHERE && is_seen && !is_repeated);
    }
    keep(id.x, steps);
}

// Otherwise, if no surface lies before it.
@compute @workgroup_size(GROUP)
fn cs_cull(@builtin(global_invocation_id) id: vec3<u32>) {
    let run = run_at(id.x);
    if run.x == NO_RUN {
        return;
    }
    let segment = segment_at(run.x);
    let stepping = stepping_of(segment.ends);
    let direction = direction_of(segment);
    var steps = 0u;
    for (var step = 0u; step < RUN; step++) {
        let pixel = step_pixel(stepping, run.y + step);
        let tested = tested_spine(segment, run.x, spine_at(segment, direction, pixel.px));
        let left = beside(tested, BESIDE, segment.ids.zw);
        let right = beside(tested, -BESIDE, segment.ids.zw);
        steps |= select(0u, 1u << step, pixel.is_on && min(left.lead, right.lead) <= SLACK);
    }
    keep(id.x, steps);
}
