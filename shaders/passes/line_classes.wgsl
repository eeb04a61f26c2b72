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
// 3. `cs_settle` decides about classes.
// 4. `cs_replace` finds what the pixels become that change, and `cs_change` writes it: until then lines are as they were.
// 5. `cs_find_short` lists what is too short, once links no longer lead to what made way, and `cs_leave_out` leaves it out.
#import common/frame.wgsl
#import common/edge_map.wgsl
#import common/line_width.wgsl
#import common/pixel_list.wgsl
#import passes/line_classes/links.wgsl
#import passes/line_classes/stretch.wgsl
#import passes/line_classes/dots.wgsl

// Whether classes are decided, and whether dots and short pieces beside longer lines are left out.
override WITH_CLASSES: bool = true;
override WITH_DOTS: bool = true;
override WITH_PIECES: bool = true;

// See `pack_link`.
var linking_tex: texture_storage_2d<r32uint, write>;
// The class that each pixel is to have, if all changes are made. Undefined where no line is.
var settling_tex: texture_storage_2d<r32uint, write>;
// Afterwards the same.
var settled_tex: texture_storage_2d<r32uint, read>;
// The pixels that may be dots or short pieces.
var<storage, read_write> keeping_short: Counting;
var<storage, read_write> short_pixels: array<u32>;
// What the pixels that change become, in their order.
var<storage, read_write> changes: array<Change>;
var edge_tex: texture_storage_2d<rgba32uint, write>;
var changed_spine_tex: texture_storage_2d<r32uint, write>;

struct Change {
    edge: vec4<u32>,
    spine: u32,
}

// Half the width of a hairline, px.
const HAIRLINE: f32 = 0.5;
// Beside a line, px.
const NEARBY: f32 = 2.5;

const ALL_CLASSES: u32 = (1u << SECTION) - 1u;

// Finds what continues a line in both directions (over a hole of a pixel too), and which classes run here.
@compute @workgroup_size(GROUP)
fn cs_links(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    let own = point_at(px);
    let towards = unpack_tangent(u32(own.tangent));
    var classes = select(bit_of(own.class_of), 0u, own.class_of == NO_EDGE);
    var ahead = PixelLink(OWN, false, 0.0);
    var behind = ahead;
    var min_cost = vec2(1e9);
    for (var places = lines_around(px) & ~(1u << OWN); places != 0u; places &= places - 1u) {
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

// Below this length, px, an object's pieces are dots.
fn shortest_of(object: u32) -> f32 {
    return min(edge_styles[style_of(object)].min_length, f32(FARTHEST));
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
    return own_length(ahead, behind) < shortest_stretch();
}

// Whether what is followed from a pixel is too short, and nothing else continues it.
fn is_dot(px: vec2<i32>, object: u32, ahead: Stretch, behind: Stretch) -> bool {
    let shortest = shortest_of(object);
    let is_far = extent_of(ahead, behind) >= shortest || extent_around(lines_around(px)) >= shortest;
    return !is_far && is_short(px, object, shortest);
}

// The nearest pixel in which a line of these classes, which are bits of a number, runs beside a point, farther than `above` and nearer
// than `below`, px; `px` itself: there is none.
fn nearest_beside(px: vec2<i32>, own: Point, classes: u32, above: f32, below: f32) -> vec2<i32> {
    let towards = unpack_tangent(u32(own.tangent));
    var nearest = below;
    var beside = px;
    for (var places = lines_around(px); places != 0u; places &= places - 1u) {
        let other = px + away_of(countTrailingZeros(places));
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
    let links = textureLoad(link_tex, beside).x;
    let ahead = follow(beside, links, 0u, stretch_length());
    let behind = follow(beside, links, 1u, stretch_length());
    return any(beside != px) && own_length(ahead, behind) > length;
}

// Whether several classes meet here.
fn is_meeting(ahead: Stretch, behind: Stretch) -> bool {
    let classes = ahead.classes | behind.classes;
    return WITH_CLASSES && (classes & (classes - 1u)) != 0u;
}

// Whether it may be a dot or a short piece.
fn may_be_short(own: Point, ahead: Stretch, behind: Stretch) -> bool {
    let may_be_dot = WITH_DOTS && extent_of(ahead, behind) < shortest_of(own.texel.y);
    return may_be_dot || (WITH_PIECES && is_piece(ahead, behind));
}

// As `keep`: functions can't be told which list they add to.
fn keep_short(px: vec2<i32>) {
    let index = atomicAdd(&keeping_short.count, 1u);
    if index % GROUP == 0u {
        atomicAdd(&keeping_short.groups[0], 1u);
    }
    short_pixels[index] = pack_pixel(px);
}

// Lists the pixels where classes meet, and those of pieces that may be too short: a stretch tells.
@compute @workgroup_size(GROUP)
fn cs_sift(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    let own = point_at(px);
    let links = textureLoad(link_tex, px).x;
    let ahead = follow(px, links, 0u, stretch_length());
    let behind = follow(px, links, 1u, stretch_length());
    if is_meeting(ahead, behind) {
        keep(px);
    } else if may_be_short(own, ahead, behind) {
        keep_short(px);
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
    let links = textureLoad(link_tex, px).x;
    let ahead = followed(px, links, 0u);
    let behind = followed(px, links, 1u);
    let class_of = settled(px, own.class_of, links, ahead, behind);
    textureStore(settling_tex, px, vec4(class_of));
    if class_of != own.class_of || classes_in(links) != bit_of(own.class_of) {
        keep(px);
    }
    if may_be_short(own, ahead, behind) {
        keep_short(px);
    }
}

fn spine_of_line(edge: vec4<u32>) -> u32 {
    let class_of = class_of(edge);
    let rank = select(0.0, 1.0, is_of_profile(class_of));
    return spine_of(edge, halves_of(edge.y, class_of), rank, 1.0 - range_share(bitcast<f32>(edge.z)));
}

// Whether a line that was found stays of this class.
fn stays(found: Nearest, class_of: u32) -> bool {
    return found.distance < FAR && textureLoad(settled_tex, found.px).x == class_of;
}

// The line of a pixel with another class, between the pixels that have it; as it was if they change too.
fn replaced(px: vec2<i32>, own: Point, links: u32, class_of: u32) -> Change {
    let ahead = nearest_of(class_of, px, links, 0u);
    let behind = nearest_of(class_of, px, links, 1u);
    if !stays(ahead, class_of) && !stays(behind, class_of) {
        return Change(own.texel, spine_of_line(own.texel));
    }
    var share = ahead.distance / (ahead.distance + behind.distance);
    share = select(share, 1.0, ahead.distance >= FAR);
    share = select(share, 0.0, behind.distance >= FAR);
    let tangent = unpack_tangent(u32(own.tangent));
    let depth = mix(bitcast<f32>(ahead.texel.z), bitcast<f32>(behind.texel.z), share);
    let shift = mix(ahead.shift, behind.shift, share) * vec2(tangent.y, -tangent.x);
    let offset = pack_offset(offset_of(own.texel) + shift);
    let look = select(behind.texel, ahead.texel, vec4(share <= 0.5));
    let phase = 1023u << 16u;
    let edge = vec4(
        (class_of << 28u) | (own.texel.x & 0x0fff0000u) | offset,
        look.y,
        bitcast<u32>(depth),
        (look.w & ~phase) | (own.texel.w & phase),
    );
    return Change(edge, spine_of_line(edge));
}

// Where two lines become one: that which is of this class stays, and has ink up to the spine of the other one unless it is a
// hairline: several of them are an even gray. The other one makes way unless the first changes too.
fn beside_another(px: vec2<i32>, own: Point, class_of: u32) -> Change {
    let is_own = class_of == own.class_of;
    let others = ALL_CLASSES & ~bit_of(class_of);
    let beside = nearest_beside(px, own, select(bit_of(class_of), others, is_own), -1.0, select(FAR, MERGING, is_own));
    let agrees = textureLoad(settled_tex, beside).x == class_of;
    if !is_own && agrees {
        return Change(vec4(0u), 0u);
    }
    let other = point_at(beside);
    let half = half_width_of(own.texel);
    let towards = unpack_tangent(u32(own.tangent));
    let left = vec2(towards.y, -towards.x);
    let away = dot(other.at - own.at, left);
    let wide = smoothstep(HAIRLINE, 1.5 * HAIRLINE, half);
    let more = select(0.0, 0.5 * wide * max(abs(away) - half, 0.0), is_own && agrees);
    let offset = pack_offset(offset_of(own.texel) + sign(away) * more * left);
    let width = pack2x16float(vec2(half + more, 0.0)) | (own.texel.w & ~0x7fffu);
    let edge = vec4((own.texel.x & 0xffff0000u) | offset, own.texel.yz, width);
    return Change(edge, spine_of_line(edge));
}

@compute @workgroup_size(GROUP)
fn cs_replace(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= min(list.count, arrayLength(&changes)) {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    let own = point_at(px);
    let links = textureLoad(link_tex, px).x;
    let class_of = textureLoad(settled_tex, px).x;
    if (classes_in(links) & bit_of(class_of)) != 0u {
        changes[id.x] = beside_another(px, own, class_of);
    } else {
        changes[id.x] = replaced(px, own, links, class_of);
    }
}

@compute @workgroup_size(GROUP)
fn cs_change(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= min(list.count, arrayLength(&changes)) {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    let change = changes[id.x];
    textureStore(edge_tex, px, change.edge);
    textureStore(changed_spine_tex, px, vec4(change.spine, 0u, 0u, 0u));
}

@compute @workgroup_size(GROUP)
fn cs_find_short(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    let own = point_at(px);
    if own.class_of == NO_EDGE {
        // It made way.
        return;
    }
    let links = textureLoad(link_tex, px).x;
    let ahead = follow(px, links, 0u, stretch_length());
    let behind = follow(px, links, 1u, stretch_length());
    if (WITH_DOTS && is_dot(px, own.texel.y, ahead, behind))
        || (WITH_PIECES && is_piece(ahead, behind) && is_beside_longer(px, own, own_length(ahead, behind))) {
        keep(px);
    }
}

@compute @workgroup_size(GROUP)
fn cs_leave_out(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    textureStore(edge_tex, px, vec4(0u));
    textureStore(changed_spine_tex, px, vec4(0u));
}
