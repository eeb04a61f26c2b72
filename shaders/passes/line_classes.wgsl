// Decides the class of lines over stretches. Where two lines run within a pixel of each other (a part that touches another, or
// dips into it), chance decides in every pixel which of them is found there. Such lines become one: of the widest class that has
// no gap as long as a stretch there, through the points of the class that has the most of them. No other class shows in between on
// less than a stretch.
//
// Lines are few, and such places on them fewer: lines are collected first, then places where classes meet are marked, and only
// lines near those are followed.
#import common/frame.wgsl
#import common/edge_map.wgsl
#import common/line_width.wgsl
#import gpu/neighbors.wgsl
#import common/kept.wgsl

var spine_tex: texture_2d<u32>;
var edge_map_tex: texture_storage_2d<rgba32uint, read>;
// The shortest stretch, px.
var<storage, read> least: array<f32>;
// While lines are collected: their pixels (column in the lower 16 bits, row in the upper ones), in any order.
var<storage, read_write> keeping: Counting;
var<storage, read_write> keeping_lines: array<u32>;
// Afterwards the same.
var<storage, read> kept: Kept;
var<storage, read> kept_lines: array<u32>;
// Not 0 for blocks of pixels in which classes meet.
var meeting_tex: texture_storage_2d<r32uint, write>;
var met_tex: texture_2d<u32>;
// What changes, in any order.
var<storage, read_write> changing: Counting;
var<storage, read_write> changes: array<Change>;
// Afterwards the same.
var<storage, read> changed: Kept;
var edge_tex: texture_storage_2d<rgba32uint, write>;
var changed_spine_tex: texture_storage_2d<r32uint, write>;

struct Change {
    edge: vec4<u32>,
    spine: u32,
    px: u32,
}

// Pixels per workgroup, as in src/render/passes/line_classes.rs.
const GROUP: u32 = 256u;

// Two lines that are closer than this, px, are one: their ink overlaps.
const BESIDE: f32 = 1.5;
// Cosine of the angle up to which two tangents belong to one line.
const PARALLEL: f32 = 0.85;
// Most steps of a stretch that are told apart: twice as many have to fit into the bits of a number.
const MOST_STEPS: f32 = 15.0;
// Longer than any.
const ENDLESS: i32 = 1000;

// The width and height of blocks, px: no stretch is longer.
fn block_size() -> i32 {
    return i32(ceil(max(least[0], 4.0)));
}

fn packed(px: vec2<i32>) -> u32 {
    return u32(px.x) | (u32(px.y) << 16u);
}

fn unpacked(px: u32) -> vec2<i32> {
    return vec2<i32>(vec2(px & 0xffffu, px >> 16u));
}

// Collects the pixels of lines, four at a time, and forgets where classes met in another picture.
@compute @workgroup_size(16, 16)
fn cs_lines(@builtin(global_invocation_id) id: vec3<u32>) {
    // Blocks are larger than four pixels.
    textureStore(meeting_tex, vec2<i32>(id.xy), vec4(0u));
    let first = 2 * vec2<i32>(id.xy);
    let spines = four_at(spine_tex, first);
    if any_of(spines) == 0u {
        return;
    }
    for (var i = 0; i < 4; i++) {
        let px = first + vec2(i & 1, i >> 1u);
        if spines[i] != 0u && all(px < vec2<i32>(frame.size)) {
            let index = atomicAdd(&keeping.count, 1u);
            keeping_lines[index] = packed(px);
            if index % GROUP == 0u {
                atomicAdd(&keeping.groups[0], 1u);
            }
        }
    }
}

// The point of a line in a pixel.
struct Point {
    // 0: there is none that this is about.
    class_of: u32,
    // px.
    at: vec2<f32>,
    tangent: vec2<f32>,
    // As in the edge map: object, and weight, phase and width.
    object: u32,
    look: u32,
}

fn point_at(px: vec2<i32>) -> Point {
    let texel = textureLoad(edge_map_tex, clamp(px, vec2(0), vec2<i32>(frame.size) - 1));
    let class_of = class_of(texel);
    let is_line = (texel.w >> 26u) != 0u && class_of <= SECTION && !is_stroke(texel);
    return Point(
        select(NO_EDGE, class_of, is_line),
        vec2<f32>(px) + 0.5 + offset_of(texel),
        unpack_tangent((texel.x >> 16u) & 511u),
        texel.y,
        texel.w,
    );
}

// How far a point lies along and beside the line of another one; far beside if it is not of that line.
fn seen_from(at: vec2<f32>, towards: vec2<f32>, point: Point) -> vec2<f32> {
    let away = point.at - at;
    let is_same = point.class_of != NO_EDGE && abs(dot(towards, point.tangent)) > PARALLEL;
    return vec2(dot(away, towards), select(1e9, abs(away.x * towards.y - away.y * towards.x), is_same));
}

// Marks where classes meet along a line.
@compute @workgroup_size(GROUP)
fn cs_meetings(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= kept.count {
        return;
    }
    let px = unpacked(kept_lines[id.x]);
    let own = point_at(px);
    var is_met = false;
    for (var i = 0; i < 25; i++) {
        let other = point_at(px + vec2(i % 5, i / 5) - 2);
        let seen = seen_from(own.at, own.tangent, other);
        is_met = is_met || (other.class_of != own.class_of && seen.y < BESIDE);
    }
    if is_met && own.class_of != NO_EDGE {
        textureStore(meeting_tex, px / block_size(), vec4(1u, 0u, 0u, 0u));
    }
}

fn is_near_meeting(px: vec2<i32>) -> bool {
    var near = 0u;
    for (var i = 0; i < 9; i++) {
        near |= textureLoad(met_tex, px / block_size() + vec2(i % 3, i / 3) - 1, 0).x;
    }
    return near != 0u;
}

// Of each class on which steps it is there, in both directions; the object and the look of the first point of it.
var<private> steps_of: array<vec2<u32>, 12>;
var<private> objects: array<u32, 12>;
var<private> looks: array<u32, 12>;
// Of each class that is here a point, and the normal of its line.
var<private> places: array<vec2<f32>, 12>;
var<private> normals: array<vec2<f32>, 12>;

fn note(point: Point, step: u32, side: u32) {
    let class_of = point.class_of;
    if all(steps_of[class_of] == vec2(0u)) {
        objects[class_of] = point.object;
        looks[class_of] = point.look;
    }
    steps_of[class_of][side] |= 1u << step;
}

// Follows a line from a point in one direction; the steps up to where it ends, or else `ENDLESS`.
fn follow(own: Point, first: vec2<f32>, side: u32) -> i32 {
    let per_px = min(1.0, MOST_STEPS / least[0]);
    let farthest = 2.0 * min(least[0] * per_px, MOST_STEPS);
    var at = own.at;
    var towards = first;
    var distance = 0.0;
    var end = ENDLESS;
    var goes_on = true;
    // Over a hole of a pixel too.
    var ahead = 1.0;
    while goes_on {
        let px = vec2<i32>(floor(at + ahead * towards));
        var next = Point(NO_EDGE, at, towards, 0u, 0u);
        var least_cost = 1e9;
        var along = 0.0;
        for (var i = 0; i < 9; i++) {
            let point = point_at(px + vec2(i % 3, i / 3) - 1);
            let seen = seen_from(at, towards, point);
            if seen.x > 0.3 && seen.x < 2.5 && seen.y < BESIDE {
                let step = u32((distance + seen.x) * per_px + 0.5);
                if step < 32u {
                    note(point, step, side);
                }
                let cost = seen.x + 2.0 * seen.y + select(2.0, 0.0, point.class_of == own.class_of);
                if cost < least_cost {
                    least_cost = cost;
                    next = point;
                    along = seen.x;
                }
            }
        }
        if next.class_of == NO_EDGE && ahead == 1.0 {
            ahead = 2.0;
        } else if next.class_of == NO_EDGE {
            end = i32(distance * per_px + 0.5);
            goes_on = false;
        } else {
            distance += along;
            ahead = 1.0;
            at = next.at;
            towards = next.tangent * sign(dot(next.tangent, towards));
            goes_on = distance * per_px < farthest;
        }
    }
    return end;
}

// The last of these steps that is reached from one of them without a gap as long as a stretch.
fn last_step(steps: u32, first: i32, longest: i32) -> i32 {
    var last = first;
    for (var step = first + 1; step <= last + longest && step < 32; step++) {
        if (steps & (1u << u32(step))) != 0u {
            last = step;
        }
    }
    return last;
}

// Steps without a class that are no gap in it.
fn longest_gap() -> i32 {
    return i32(min(ceil(least[0]), MOST_STEPS));
}

fn count_of(class_of: u32, near: u32) -> u32 {
    return countOneBits(steps_of[class_of].x & near) + countOneBits(steps_of[class_of].y & near);
}

// The class that a point's line has here.
fn settled(own: Point, ends: vec2<i32>) -> u32 {
    let longest = longest_gap();
    var settled = NO_EDGE;
    var greatest = -1.0;
    // The nearest other class on either side.
    var nearest = vec2<i32>(ENDLESS);
    var beside = vec2<u32>(NO_EDGE);
    for (var class_of = 1u; class_of <= SECTION; class_of++) {
        let steps = steps_of[class_of];
        if all(steps == vec2(0u)) {
            continue;
        }
        let first = vec2<i32>(select(countTrailingZeros(steps), vec2<u32>(u32(ENDLESS)), steps == vec2(0u)));
        if first.x + first.y <= longest {
            let last = vec2(last_step(steps.x, first.x, longest), last_step(steps.y, first.y, longest));
            let is_whole = last.x + last.y + 1 >= longest || any(last + 1 >= ends);
            // Of equal ones the first.
            let width = half_width_of(vec4(0u, 0u, 0u, looks[class_of]));
            if is_whole && width > greatest + 0.01 {
                greatest = width;
                settled = class_of;
            }
        }
        if class_of != own.class_of {
            beside = select(beside, vec2(class_of), first < nearest);
            nearest = min(nearest, first);
        }
    }
    if settled != NO_EDGE {
        return settled;
    }
    // No class has a stretch here: the line is as beside it.
    let is_between = all(beside != vec2(NO_EDGE)) && all(nearest <= vec2(longest));
    return select(own.class_of, min(beside.x, beside.y), is_between);
}

// The class whose points the line goes through: of those that are one with it the most complete.
fn carrier_of(settled: u32) -> u32 {
    let near = (1u << (u32(longest_gap()) + 1u)) - 1u;
    var carrier = settled;
    var most = count_of(settled, near);
    for (var class_of = 1u; class_of <= SECTION; class_of++) {
        let count = count_of(class_of, near);
        // Where two are as complete the one whose class it is stays.
        if count > most + count_of(settled, near) / 4u {
            most = count;
            carrier = class_of;
        }
    }
    return carrier;
}

@compute @workgroup_size(GROUP)
fn cs_settle(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= kept.count {
        return;
    }
    let px = unpacked(kept_lines[id.x]);
    let own = point_at(px);
    if own.class_of == NO_EDGE || !is_near_meeting(px) {
        return;
    }
    for (var i = 0; i < 12; i++) {
        steps_of[i] = vec2(0u);
    }
    for (var i = 0; i < 25; i++) {
        let point = point_at(px + vec2(i % 5, i / 5) - 2);
        let seen = seen_from(own.at, own.tangent, point);
        if abs(seen.x) <= 0.75 && seen.y < BESIDE {
            note(point, 0u, 0u);
            note(point, 0u, 1u);
            places[point.class_of] = point.at;
            normals[point.class_of] = vec2(point.tangent.y, -point.tangent.x);
        }
    }
    let ends = vec2(follow(own, own.tangent, 0u), follow(own, -own.tangent, 1u));
    let class_of = settled(own, ends);
    let carrier = carrier_of(class_of);
    let is_left_out = own.class_of != class_of && (steps_of[class_of].x & 1u) != 0u;
    let is_moved = own.class_of != carrier && (steps_of[carrier].x & 1u) != 0u;
    if class_of == own.class_of && !is_moved {
        return;
    }
    let index = atomicAdd(&changing.count, 1u);
    if index >= arrayLength(&changes) {
        return;
    }
    if index % GROUP == 0u {
        atomicAdd(&changing.groups[0], 1u);
    }
    if is_left_out {
        changes[index] = Change(vec4(0u), 0u, packed(px));
        return;
    }
    let texel = textureLoad(edge_map_tex, px);
    let object = objects[class_of];
    let look = (looks[class_of] & ~(1023u << 16u)) | (texel.w & (1023u << 16u));
    let moved = pack_offset(own.at + dot(places[carrier] - own.at, normals[carrier]) * normals[carrier] - vec2<f32>(px) - 0.5);
    let offset = select(texel.x & 0xffffu, moved, is_moved);
    let edge = vec4((class_of << 28u) | (texel.x & 0x0fff0000u) | offset, object, texel.z, look);
    let rank = select(0.0, 1.0, is_of_profile(class_of));
    let spine = spine_of(edge, halves_of(object, class_of), rank, 1.0 - range_share(bitcast<f32>(texel.z)));
    changes[index] = Change(edge, spine, packed(px));
}

@compute @workgroup_size(GROUP)
fn cs_change(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= min(changed.count, arrayLength(&changes)) {
        return;
    }
    let px = unpacked(changes[id.x].px);
    textureStore(edge_tex, px, changes[id.x].edge);
    textureStore(changed_spine_tex, px, vec4(changes[id.x].spine, 0u, 0u, 0u));
}
