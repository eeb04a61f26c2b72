// Follows lines over stretches, and decides two things.
//
// The class: where two lines run within a pixel of each other (a part that touches another, or dips into it), chance decides in
// every pixel which of them is found there. Such lines become one: of the widest class that has no gap as long as a stretch
// there, bridged between its points. No other class shows in between on less than a stretch.
//
// Dots: pieces of lines that are too short to tell anything, and that nothing continues, are left out.
//
// 1. `cs_lines` collects the pixels of lines, which are few.
// 2. `cs_links` finds for each of them the next pixel of its line in both directions, and which classes run there.
// 3. `cs_settle` follows these links, and decides.
// 4. `cs_change` writes what changes. The last three run once more for the pixels where classes meet.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/edge_map.wgsl
#import common/line_width.wgsl
#import gpu/neighbors.wgsl
#import common/kept.wgsl
#import passes/dots.wgsl

// Whether classes are decided, and whether dots are left out.
override WITH_CLASSES: bool = true;
override WITH_DOTS: bool = true;

var edge_map_tex: texture_storage_2d<rgba32uint, read>;
// The shortest stretch, px.
var<storage, read> least: array<f32>;
// While pixels are collected (column in the lower 16 bits, row in the upper ones), in any order: those of lines, then those of
// them where classes meet.
var<storage, read_write> keeping: Counting;
var<storage, read_write> keeping_lines: array<u32>;
// Afterwards the same.
var<storage, read> kept: Kept;
var<storage, read> kept_lines: array<u32>;
// See `pack_link`. Undefined where no line is.
var linking_tex: texture_storage_2d<r32uint, write>;
var link_tex: texture_2d<u32>;
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
// Points are side by side up to this distance along their line, px.
const ABREAST: f32 = 0.75;
// Angle up to which two tangents belong to one line, of 512 for a full turn: 32 degrees.
const PARALLEL: i32 = 45;
// Most steps of a stretch that are told apart: twice as many have to fit into the bits of a number.
const MOST_STEPS: f32 = 15.0;
// Longer than any.
const ENDLESS: i32 = 1000;

fn packed(px: vec2<i32>) -> u32 {
    return u32(px.x) | (u32(px.y) << 16u);
}

fn unpacked(px: u32) -> vec2<i32> {
    return vec2<i32>(vec2(px & 0xffffu, px >> 16u));
}

fn keep(px: vec2<i32>) {
    let index = atomicAdd(&keeping.count, 1u);
    keeping_lines[index] = packed(px);
    if index % GROUP == 0u {
        atomicAdd(&keeping.groups[0], 1u);
    }
}

// Collects the pixels of lines, four at a time.
@compute @workgroup_size(16, 16)
fn cs_lines(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = 2 * vec2<i32>(id.xy);
    let spines = four_at(spine_tex, first);
    if any_of(spines) == 0u {
        return;
    }
    for (var i = 0; i < 4; i++) {
        let px = first + vec2(i & 1, i >> 1u);
        if spines[i] != 0u && all(px < vec2<i32>(frame.size)) {
            keep(px);
        }
    }
}

// The class of a line in a texel of the edge map; `NO_EDGE`: there is no ink of one.
fn line_class(texel: vec4<u32>) -> u32 {
    let class_of = class_of(texel);
    return select(NO_EDGE, class_of, (texel.w >> 26u) != 0u && class_of <= SECTION);
}

// The point of a line in a pixel.
struct Point {
    texel: vec4<u32>,
    class_of: u32,
    // px.
    at: vec2<f32>,
    // As in the edge map.
    tangent: i32,
}

fn point_at(px: vec2<i32>) -> Point {
    let texel = textureLoad(edge_map_tex, px);
    let is_inside = all(px >= vec2(0)) && all(px < vec2<i32>(frame.size));
    let class_of = select(NO_EDGE, line_class(texel), is_inside);
    return Point(texel, class_of, vec2<f32>(px) + 0.5 + offset_of(texel), i32((texel.x >> 16u) & 511u));
}

// The least angle from one tangent to another one, of 512 for a full turn, −256 to 255.
fn turn(one: Point, other: Point) -> i32 {
    return ((other.tangent - one.tangent + 256) & 511) - 256;
}

// How far a point lies along and beside the line of another one, px; far beside if it is not of that line.
fn seen_from(own: Point, towards: vec2<f32>, point: Point) -> vec2<f32> {
    let away = point.at - own.at;
    let angle = abs(turn(own, point));
    let is_same = point.class_of != NO_EDGE && min(angle, 256 - angle) < PARALLEL;
    return vec2(dot(away, towards), select(1e9, abs(away.x * towards.y - away.y * towards.x), is_same));
}

// The pixels around one, row by row: two in each direction.
const AROUND: u32 = 25u;
const OWN: u32 = 12u;

fn away_of(place: u32) -> vec2<i32> {
    return vec2<i32>(vec2(place % 5u, place / 5u)) - 2;
}

// The next pixel of a line.
struct Link {
    // Of those around; `OWN`: the line ends here.
    place: u32,
    // Whether the tangent there points backwards.
    is_turned: bool,
    // Along the line, px, up to 2.5.
    distance: f32,
}

// Links take 10 bits: first that in the direction of the tangent, then that against it. Below them 11 bits tell which classes run
// here.
const LINK_BITS: u32 = 10u;
const CLASS_BITS: u32 = 11u;

fn pack_link(link: Link) -> u32 {
    return link.place | (select(0u, 1u, link.is_turned) << 5u) | (u32(round(6.0 * link.distance)) << 6u);
}

fn unpack_link(texel: u32, side: u32) -> Link {
    let bits = texel >> (CLASS_BITS + side * LINK_BITS);
    return Link(bits & 31u, ((bits >> 5u) & 1u) != 0u, f32((bits >> 6u) & 15u) / 6.0);
}

fn classes_in(texel: u32) -> u32 {
    return texel & ((1u << CLASS_BITS) - 1u);
}

fn bit_of(class_of: u32) -> u32 {
    return 1u << (class_of - 1u);
}

// Finds what continues a line in both directions (over a hole of a pixel too), and which classes run here.
@compute @workgroup_size(GROUP)
fn cs_links(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= kept.count {
        return;
    }
    let px = unpacked(kept_lines[id.x]);
    let own = point_at(px);
    let towards = unpack_tangent(u32(own.tangent));
    var classes = 0u;
    var ahead = Link(OWN, false, 0.0);
    var behind = ahead;
    var least_cost = vec2(1e9);
    for (var place = 0u; place < AROUND; place++) {
        let point = point_at(px + away_of(place));
        let seen = seen_from(own, towards, point);
        if seen.y < BESIDE {
            let distance = abs(seen.x);
            classes |= select(0u, bit_of(point.class_of), distance <= ABREAST);
            let cost = distance + 2.0 * seen.y;
            let link = Link(place, abs(turn(own, point)) > 128, distance);
            if seen.x > 0.3 && seen.x < 2.5 && cost < least_cost.x {
                least_cost.x = cost;
                ahead = link;
            }
            if seen.x < -0.3 && seen.x > -2.5 && cost < least_cost.y {
                least_cost.y = cost;
                behind = link;
            }
        }
    }
    let links = pack_link(ahead) | (pack_link(behind) << LINK_BITS);
    textureStore(linking_tex, px, vec4(classes | (links << CLASS_BITS), 0u, 0u, 0u));
}

// Where each class runs: the steps along a line as the bits of a number.
struct Steps {
    classes_1: vec4<u32>,
    classes_5: vec4<u32>,
    classes_9: vec4<u32>,
}

fn with_step(steps: Steps, classes: u32, step: u32) -> Steps {
    let four = (vec4(classes) >> vec4(0u, 1u, 2u, 3u)) & vec4(1u);
    let next = (vec4(classes) >> vec4(4u, 5u, 6u, 7u)) & vec4(1u);
    let last = (vec4(classes) >> vec4(8u, 9u, 10u, 11u)) & vec4(1u);
    return Steps(
        steps.classes_1 | (four << vec4(step)),
        steps.classes_5 | (next << vec4(step)),
        steps.classes_9 | (last << vec4(step)),
    );
}

// What following a line in one direction comes to.
struct Stretch {
    steps: Steps,
    // All classes that are met.
    classes: u32,
    // The step behind which nothing continues the line, or else `ENDLESS`.
    end: i32,
    // The last pixel.
    last: vec2<i32>,
}

fn steps_per_px() -> f32 {
    return min(1.0, MOST_STEPS / least[0]);
}

fn step_at(distance: f32) -> u32 {
    return u32(distance * steps_per_px() + 0.5);
}

fn follow(px: vec2<i32>, links: u32, first_side: u32) -> Stretch {
    let farthest = 2.0 * min(least[0], MOST_STEPS / steps_per_px());
    var stretch = Stretch(Steps(vec4(0u), vec4(0u), vec4(0u)), 0u, ENDLESS, px);
    var texel = links;
    var side = first_side;
    var distance = 0.0;
    while stretch.end == ENDLESS && distance < farthest {
        let classes = classes_in(texel);
        stretch.classes |= classes;
        stretch.steps = with_step(stretch.steps, classes, step_at(distance));
        let link = unpack_link(texel, side);
        if link.place == OWN {
            stretch.end = i32(step_at(distance));
        }
        stretch.last += away_of(link.place);
        side ^= select(0u, 1u, link.is_turned);
        distance += link.distance;
        texel = textureLoad(link_tex, stretch.last, 0).x;
    }
    return stretch;
}

fn steps_in(steps: Steps, class_of: u32) -> u32 {
    let index = class_of - 1u;
    let four = select(select(steps.classes_9, steps.classes_5, index < 8u), steps.classes_1, index < 4u);
    return four[index % 4u];
}

// Of a class, in both directions.
fn steps_of(ahead: Stretch, behind: Stretch, class_of: u32) -> vec2<u32> {
    return vec2(steps_in(ahead.steps, class_of), steps_in(behind.steps, class_of));
}

// Steps without a class that are no gap in it.
fn longest_gap() -> i32 {
    return i32(min(ceil(least[0]), MOST_STEPS));
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

// The first step of a class in both directions.
fn first_of(steps: vec2<u32>) -> vec2<i32> {
    return vec2<i32>(select(countTrailingZeros(steps), vec2<u32>(u32(ENDLESS)), steps == vec2(0u)));
}

// Where a class runs nearest along a line, in one direction.
struct Nearest {
    // Of the edge map.
    texel: vec4<u32>,
    // From the line to the left of it there, px.
    shift: f32,
}

fn nearest_of(class_of: u32, px: vec2<i32>, links: u32, first_side: u32) -> Nearest {
    var at = px;
    var texel = links;
    var side = first_side;
    for (var i = 0; i < 64 && (classes_in(texel) & bit_of(class_of)) == 0u; i++) {
        let link = unpack_link(texel, side);
        at += away_of(link.place);
        side ^= select(0u, 1u, link.is_turned);
        texel = textureLoad(link_tex, at, 0).x;
    }
    let line = point_at(at);
    let towards = unpack_tangent(u32(line.tangent));
    let left = vec2(towards.y, -towards.x) * select(-1.0, 1.0, side == first_side);
    var nearest = Nearest(line.texel, 0.0);
    var least_distance = 1e9;
    for (var place = 0u; place < AROUND; place++) {
        let point = point_at(at + away_of(place));
        let seen = seen_from(line, towards, point);
        let distance = abs(seen.x) + seen.y;
        if point.class_of == class_of && seen.y < BESIDE && abs(seen.x) <= ABREAST && distance < least_distance {
            least_distance = distance;
            nearest = Nearest(point.texel, dot(point.at - line.at, left));
        }
    }
    return nearest;
}

// The class of a line here.
fn settled(px: vec2<i32>, own: u32, links: u32, ahead: Stretch, behind: Stretch) -> u32 {
    let longest = longest_gap();
    let ends = vec2(ahead.end, behind.end);
    var settled = NO_EDGE;
    var greatest = -1.0;
    // The nearest other class on either side.
    var nearest = vec2<i32>(ENDLESS);
    var beside = vec2<u32>(NO_EDGE);
    for (var left = ahead.classes | behind.classes; left != 0u; left &= left - 1u) {
        let class_of = countTrailingZeros(left) + 1u;
        let steps = steps_of(ahead, behind, class_of);
        let first = first_of(steps);
        if first.x + first.y <= longest {
            let last = vec2(last_step(steps.x, first.x, longest), last_step(steps.y, first.y, longest));
            if last.x + last.y + 1 >= longest || any(last + 1 >= ends) {
                // Of equal ones the first.
                let side = select(0u, 1u, first.y < first.x);
                let width = half_width_of(nearest_of(class_of, px, links, side).texel);
                if width > greatest + 0.01 {
                    greatest = width;
                    settled = class_of;
                }
            }
        }
        if class_of != own {
            beside = select(beside, vec2(class_of), first < nearest);
            nearest = min(nearest, first);
        }
    }
    if settled != NO_EDGE {
        return settled;
    }
    // No class has a stretch here: the line is as beside it.
    let is_between = all(beside != vec2(NO_EDGE)) && all(nearest <= vec2(longest));
    return select(own, min(beside.x, beside.y), is_between);
}

fn change(px: vec2<i32>, edge: vec4<u32>, spine: u32) {
    let index = atomicAdd(&changing.count, 1u);
    if index >= arrayLength(&changes) {
        return;
    }
    if index % GROUP == 0u {
        atomicAdd(&changing.groups[0], 1u);
    }
    changes[index] = Change(edge, spine, packed(px));
}

// Whether what is followed from a pixel is too short, and nothing else continues it.
fn is_dot(px: vec2<i32>, object: u32, ahead: Stretch, behind: Stretch) -> bool {
    let shortest = min(edge_styles[object].shortest, f32(FARTHEST));
    let extent = abs(ahead.last - behind.last);
    return f32(max(extent.x, extent.y)) < shortest && is_short(px, object, shortest);
}

@compute @workgroup_size(GROUP)
fn cs_settle(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= kept.count {
        return;
    }
    let px = unpacked(kept_lines[id.x]);
    let links = textureLoad(link_tex, px, 0).x;
    let ahead = follow(px, links, 0u);
    let behind = follow(px, links, 1u);
    let classes = ahead.classes | behind.classes;
    let is_one_class = (classes & (classes - 1u)) == 0u;
    if WITH_DOTS {
        let own = textureLoad(edge_map_tex, px);
        if is_dot(px, own.y, ahead, behind) {
            change(px, vec4(0u), 0u);
            return;
        }
    }
    if !WITH_CLASSES || is_one_class {
        return;
    }
    keep(px);
    let own = point_at(px);
    let class_of = settled(px, own.class_of, links, ahead, behind);
    if class_of == own.class_of {
        return;
    }
    if (classes_in(links) & bit_of(class_of)) != 0u {
        // It runs through another pixel here.
        change(px, vec4(0u), 0u);
        return;
    }
    // Between the pixels that have it.
    let first = first_of(steps_of(ahead, behind, class_of));
    let next = nearest_of(class_of, px, links, 0u);
    let last = nearest_of(class_of, px, links, 1u);
    var share = f32(first.x) / f32(first.x + first.y);
    share = select(share, 1.0, first.x == ENDLESS);
    share = select(share, 0.0, first.y == ENDLESS);
    let tangent = unpack_tangent(u32(own.tangent));
    let depth = mix(bitcast<f32>(next.texel.z), bitcast<f32>(last.texel.z), share);
    let shift = mix(next.shift, last.shift, share) * vec2(tangent.y, -tangent.x);
    let offset = pack_offset(offset_of(own.texel) + shift);
    let look = select(last.texel, next.texel, vec4(first.x <= first.y));
    let phase = 1023u << 16u;
    let edge = vec4(
        (class_of << 28u) | (own.texel.x & 0x0fff0000u) | offset,
        look.y,
        bitcast<u32>(depth),
        (look.w & ~phase) | (own.texel.w & phase),
    );
    let rank = select(0.0, 1.0, is_of_profile(class_of));
    change(px, edge, spine_of(edge, halves_of(look.y, class_of), rank, 1.0 - range_share(depth)));
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
