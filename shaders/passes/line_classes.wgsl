// Follows lines over stretches, and decides two things.
//
// The class: where two lines run within a pixel of each other (a part that touches another, or dips into it), chance decides in
// every pixel which of them is found there. Such lines become one: of the widest class that has no gap as long as a stretch
// there and is found at one step of three or more, bridged between its points. No other class shows in between on less than a
// stretch. A line makes way only for one that stays itself: of three side by side both outer ones are drawn.
//
// Dots: pieces of lines that are too short to tell anything, and that nothing continues but a line beside them, are left out.
//
// 1. `cs_links` finds for each pixel of a line the next one in both directions, and which classes run there.
// 2. `cs_sift` follows these links, and lists the few pixels about which there is something to decide.
// 3. `cs_settle` decides about those.
// 4. `cs_change` writes what changes. Links, deciding and changes take a second round.
#import common/frame.wgsl
#import common/edge_map.wgsl
#import common/line_width.wgsl
#import common/pixel_list.wgsl
#import gpu/neighbors.wgsl
#import passes/line_classes/links.wgsl
#import passes/line_classes/stretch.wgsl
#import passes/line_classes/dots.wgsl

// Whether classes are decided, and whether dots and short pieces beside longer lines are left out.
override WITH_CLASSES: bool = true;
override WITH_DOTS: bool = true;
override WITH_PIECES: bool = true;
// Whether this is the last round of deciding: lines are as they will be.
override LAST_ROUND: bool = true;

// See `pack_link`.
var linking_tex: texture_storage_2d<r32uint, write>;
// The class that each pixel is to have, if all changes are made; `NO_EDGE`: it is left out. Undefined where no line is.
var settling_tex: texture_storage_2d<r32uint, write>;
// Afterwards the same.
var settled_tex: texture_2d<u32>;
// What changes, in any order.
var<storage, read_write> changing: Counting;
var<storage, read_write> changes: array<Change>;
// Afterwards the same.
var<storage, read> changed: ListHead;
var edge_tex: texture_storage_2d<rgba32uint, write>;
var changed_spine_tex: texture_storage_2d<r32uint, write>;

struct Change {
    edge: vec4<u32>,
    spine: u32,
    px: u32,
    // The pixel of the line that it makes way for, and its class: nothing changes unless that stays. `NO_EDGE`: always.
    beside: u32,
    beside_class: u32,
}

// Beside a line, px; and farther than anything that is looked at.
const NEARBY: f32 = 2.5;
const FAR: f32 = 100.0;

const ALL_CLASSES: u32 = (1u << SECTION) - 1u;

// The places around a pixel in which lines run, as the bits of a number.
fn lines_around(px: vec2<i32>) -> u32 {
    var lines = 0u;
    for (var i = 0; i < 9; i++) {
        let away = 2 * vec2(i % 3, i / 3);
        let four = vec4<u32>(four_at(spine_tex, px + away - 2) != vec4(0u));
        // The last column and the last row are beyond them.
        let is_around = vec4(true, away.x < 4, away.y < 4, all(away < vec2(4)));
        let place = u32(away.x + 5 * away.y);
        lines |= any_of(select(vec4(0u), four, is_around) << vec4(place, place + 1u, place + 5u, place + 6u));
    }
    return lines;
}

// Finds what continues a line in both directions (over a hole of a pixel too), and which classes run here.
@compute @workgroup_size(GROUP)
fn cs_links(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    let own = point_at(px);
    let towards = unpack_tangent(u32(own.tangent));
    var classes = 0u;
    var ahead = PixelLink(OWN, false, 0.0);
    var behind = ahead;
    var min_cost = vec2(1e9);
    for (var places = lines_around(px); places != 0u; places &= places - 1u) {
        let place = countTrailingZeros(places);
        let point = point_at(px + away_of(place));
        let seen = seen_from(own, towards, point);
        let distance = abs(seen.x);
        let is_here = distance <= ABREAST && seen.y < MERGING;
        classes |= select(0u, bit_of(point.class_of), is_here);
        if seen.y < BESIDE {
            let cost = distance + 2.0 * seen.y;
            let link = PixelLink(place, abs(turn(own, point)) > 128, distance);
            if seen.x > 0.3 && seen.x < 2.5 && cost < min_cost.x {
                min_cost.x = cost;
                ahead = link;
            }
            if seen.x < -0.3 && seen.x > -2.5 && cost < min_cost.y {
                min_cost.y = cost;
                behind = link;
            }
        }
    }
    let links = pack_link(ahead) | (pack_link(behind) << LINK_BITS);
    textureStore(linking_tex, px, vec4(classes | (links << CLASS_BITS), 0u, 0u, 0u));
}

fn add(change: Change) {
    let index = atomicAdd(&changing.count, 1u);
    if index >= arrayLength(&changes) {
        return;
    }
    if index % GROUP == 0u {
        atomicAdd(&changing.groups[0], 1u);
    }
    changes[index] = change;
}

// Below this length, px, an object's pieces are dots.
fn shortest_of(object: u32) -> f32 {
    return min(edge_styles[object].min_length, f32(FARTHEST));
}

// The greater side of the box around the last pixels of both stretches, px.
fn extent_of(ahead: Stretch, behind: Stretch) -> f32 {
    let extent = abs(ahead.last - behind.last);
    return f32(max(extent.x, extent.y));
}

fn own_length(ahead: Stretch, behind: Stretch) -> f32 {
    return ahead.own_length + behind.own_length;
}

// Whether a piece that ends or runs into another line on both sides is shorter than a stretch.
fn is_piece(ahead: Stretch, behind: Stretch) -> bool {
    return own_length(ahead, behind) < least[0];
}

// Whether what is followed from a pixel is too short, and nothing else continues it.
fn is_dot(px: vec2<i32>, object: u32, ahead: Stretch, behind: Stretch) -> bool {
    let shortest = shortest_of(object);
    return extent_of(ahead, behind) < shortest && is_short(px, object, shortest);
}

// The nearest pixel in which a line of these classes, which are bits of a number, runs beside a point, farther than `above` and nearer
// than `below`, px; `px` itself: there is none.
fn nearest_beside(px: vec2<i32>, own: Point, classes: u32, above: f32, below: f32) -> vec2<i32> {
    let towards = unpack_tangent(u32(own.tangent));
    var nearest = below;
    var beside = px;
    for (var place = 0u; place < AROUND; place++) {
        let other = px + away_of(place);
        let point = point_at(other);
        let seen = seen_from(own, towards, point);
        let is_asked = (classes & bit_of(point.class_of)) != 0u;
        if is_asked && abs(seen.x) <= ABREAST && seen.y > above && seen.y < nearest {
            nearest = seen.y;
            beside = other;
        }
    }
    return beside;
}

// Whether a pixel of a piece that ends or runs into another line on both sides lies beside a longer one: of two lines that are so
// near each other, chance shows now and then both.
fn is_beside_longer(px: vec2<i32>, own: Point, length: f32) -> bool {
    let beside = nearest_beside(px, own, ALL_CLASSES, 0.5, NEARBY);
    let links = textureLoad(link_tex, beside, 0).x;
    return any(beside != px) && own_length(followed(beside, links, 0u), followed(beside, links, 1u)) > length;
}

// Whether several classes meet here.
fn is_meeting(ahead: Stretch, behind: Stretch) -> bool {
    let classes = ahead.classes | behind.classes;
    return WITH_CLASSES && (classes & (classes - 1u)) != 0u;
}

// Lists the pixels where classes meet, and those of pieces that may be too short: a stretch tells.
@compute @workgroup_size(GROUP)
fn cs_sift(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    let own = point_at(px);
    let links = textureLoad(link_tex, px, 0).x;
    let ahead = follow(px, links, 0u, stretch_length());
    let behind = follow(px, links, 1u, stretch_length());
    let is_short = WITH_PIECES && is_piece(ahead, behind);
    let may_be_dot = WITH_DOTS && extent_of(ahead, behind) < shortest_of(own.texel.y);
    if is_meeting(ahead, behind) || is_short || may_be_dot {
        keep(px);
    }
    textureStore(settling_tex, px, vec4(own.class_of));
}

@compute @workgroup_size(GROUP)
fn cs_settle(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    let own = point_at(px);
    if own.class_of == NO_EDGE {
        // It was left out the first time.
        return;
    }
    let links = textureLoad(link_tex, px, 0).x;
    let ahead = followed(px, links, 0u);
    let behind = followed(px, links, 1u);
    if LAST_ROUND && ((WITH_DOTS && is_dot(px, own.texel.y, ahead, behind))
        || (WITH_PIECES && is_piece(ahead, behind) && is_beside_longer(px, own, own_length(ahead, behind)))) {
        add(Change(vec4(0u), 0u, pack_pixel(px), 0u, NO_EDGE));
        textureStore(settling_tex, px, vec4(NO_EDGE));
        return;
    }
    var class_of = own.class_of;
    if is_meeting(ahead, behind) {
        class_of = settled(px, own.class_of, links, ahead, behind);
    }
    textureStore(settling_tex, px, vec4(class_of));
    if class_of == own.class_of {
        return;
    }
    if (classes_in(links) & bit_of(class_of)) != 0u {
        // It runs through another pixel here.
        add(Change(vec4(0u), 0u, pack_pixel(px), pack_pixel(nearest_beside(px, own, bit_of(class_of), -1.0, FAR)), class_of));
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
    let spine = spine_of(edge, halves_of(look.y, class_of), rank, 1.0 - range_share(depth));
    add(Change(edge, spine, pack_pixel(px), 0u, NO_EDGE));
}

@compute @workgroup_size(GROUP)
fn cs_change(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= min(changed.count, arrayLength(&changes)) {
        return;
    }
    let px = unpack_pixel(changes[id.x].px);
    let beside_class = changes[id.x].beside_class;
    let settled = textureLoad(settled_tex, unpack_pixel(changes[id.x].beside), 0).x;
    if beside_class != NO_EDGE && settled != beside_class {
        return;
    }
    textureStore(edge_tex, px, changes[id.x].edge);
    textureStore(changed_spine_tex, px, vec4(changes[id.x].spine, 0u, 0u, 0u));
}
