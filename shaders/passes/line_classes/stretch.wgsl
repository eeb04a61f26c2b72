// What is met along a line, and the class that it has there.
#import common/frame.wgsl
#import common/edge_map.wgsl
#import passes/line_classes/links.wgsl

// Whether the wider class comes first: styles of lines have different widths. What varies in width does so for all classes at a
// place alike.
override WIDER_FIRST: bool = true;

// As `pack_link` packs links. Undefined where no line is.
var link_tex: texture_storage_2d<r32uint, read>;

// No stretch of a line between two of other classes is shorter, reference pixels.
const SHORTEST: f32 = 8.0;
// As in src/render/base/view.rs.
const REFERENCE_HEIGHT: f32 = 1080.0;
// Most steps of a stretch that are told apart: twice as many have to fit into the bits of a number.
const MAX_STEPS: f32 = 15.0;
// A class is found at one of so many steps at least; what is found less often is a line behind that peeps through.
const MAX_STEPS_APART: i32 = 3;
// Farther than anything that is looked at, px.
const FAR: f32 = 100.0;
// Longer than any.
const ENDLESS: i32 = 1000;

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

// A place on the way along a line.
struct Walk {
    px: vec2<i32>,
    // The links of the pixel.
    texel: u32,
    // Which of them goes on: 0 or 1.
    side: u32,
}

fn advanced(walk: Walk, link: PixelLink) -> Walk {
    let px = walk.px + away_of(link.place);
    return Walk(px, textureLoad(link_tex, px).x, walk.side ^ select(0u, 1u, link.is_turned));
}

// What following a line in one direction comes to.
struct Stretch {
    steps: Steps,
    // The classes that are met no farther away than a stretch: those farther on decide nothing here.
    classes: u32,
    // The step behind which nothing continues the line, or else `ENDLESS`.
    end: i32,
    // The last pixel.
    last: vec2<i32>,
    // How far it is to where the line ends or runs into another one, px, or else `ENDLESS`.
    own_length: f32,
}

// The shortest stretch, px of this picture.
fn shortest_stretch() -> f32 {
    return SHORTEST * frame.size.y / REFERENCE_HEIGHT;
}

fn steps_per_px() -> f32 {
    return min(1.0, MAX_STEPS / shortest_stretch());
}

fn step_at(distance: f32) -> u32 {
    return u32(distance * steps_per_px() + 0.5);
}

// Steps without a class that are no gap in it.
fn longest_gap() -> i32 {
    return i32(min(ceil(shortest_stretch()), MAX_STEPS));
}

// How far it is to the end of the last step of a stretch, px.
fn stretch_length() -> f32 {
    return (f32(longest_gap()) + 0.5) / steps_per_px();
}

// As far as a line decides anything here, px.
fn farthest() -> f32 {
    return 2.0 * min(shortest_stretch(), MAX_STEPS / steps_per_px());
}

fn followed(px: vec2<i32>, links: u32, first_side: u32) -> Stretch {
    return follow(px, links, first_side, farthest());
}

// `farthest`: px.
fn follow(px: vec2<i32>, links: u32, first_side: u32, farthest: f32) -> Stretch {
    var stretch = Stretch(Steps(vec4(0u), vec4(0u), vec4(0u)), 0u, ENDLESS, px, f32(ENDLESS));
    var walk = Walk(px, links, first_side);
    var distance = 0.0;
    while stretch.end == ENDLESS && distance < farthest {
        let classes = classes_in(walk.texel);
        let step = step_at(distance);
        stretch.classes |= select(0u, classes, i32(step) <= longest_gap());
        stretch.steps = with_step(stretch.steps, classes, step);
        let link = unpack_link(walk.texel, walk.side);
        if link.place == OWN {
            stretch.end = i32(step);
        }
        walk = advanced(walk, link);
        let is_answered = unpack_link(walk.texel, 1u - walk.side).place == opposite_of(link.place);
        if link.place == OWN || !is_answered {
            stretch.own_length = min(stretch.own_length, distance);
        }
        distance += link.distance;
    }
    stretch.last = walk.px;
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

// The last of these steps that is reached from the first of them without a gap as long as a stretch, in both directions.
fn last_of(steps: vec2<u32>, first: vec2<i32>, longest: i32) -> vec2<i32> {
    var filled = steps;
    for (var length = 1; length < longest; length *= 2) {
        filled |= filled << vec2(u32(min(length, longest - length)));
    }
    let run = countTrailingZeros(~(filled >> vec2<u32>(first)));
    let reached = (vec2(2u) << (vec2<u32>(first) + run - 1u)) - 1u;
    return vec2<i32>(firstLeadingBit(steps & reached));
}

// How many of the steps up to these, in both directions, a class has.
fn count_up_to(steps: vec2<u32>, last: vec2<i32>) -> i32 {
    let up_to = steps & ((vec2(2u) << vec2<u32>(last)) - 1u);
    let counts = countOneBits(up_to);
    // The first step is that of the pixel itself.
    return i32(counts.x + counts.y - (up_to.x & up_to.y & 1u));
}

// The first step of a class in both directions.
fn first_of(steps: vec2<u32>) -> vec2<i32> {
    return vec2<i32>(select(countTrailingZeros(steps), vec2<u32>(u32(ENDLESS)), steps == vec2(0u)));
}

// Where a class runs nearest along a line, in one direction.
struct Nearest {
    px: vec2<i32>,
    // Of the edge map.
    texel: vec4<u32>,
    // From the line to the left of it there, px.
    shift: f32,
    // How far it is along the line, px; `FAR`: it is not found.
    distance: f32,
}

fn nearest_of(class_of: u32, px: vec2<i32>, links: u32, first_side: u32) -> Nearest {
    var walk = Walk(px, links, first_side);
    var distance = 0.0;
    while distance < farthest() && (classes_in(walk.texel) & bit_of(class_of)) == 0u {
        let link = unpack_link(walk.texel, walk.side);
        walk = advanced(walk, link);
        distance = select(distance + link.distance, FAR, link.place == OWN);
    }
    distance = select(FAR, distance, (classes_in(walk.texel) & bit_of(class_of)) != 0u);
    let line = point_at(walk.px);
    let towards = unpack_tangent(u32(line.tangent));
    let left = vec2(towards.y, -towards.x) * select(-1.0, 1.0, walk.side == first_side);
    var nearest = Nearest(walk.px, line.texel, 0.0, distance);
    var min_distance = 1e9;
    for (var places = lines_around(walk.px); places != 0u; places &= places - 1u) {
        let other = walk.px + away_of(countTrailingZeros(places));
        let point = point_at(other);
        let seen = seen_from(line, towards, point);
        let from_line = abs(seen.x) + seen.y;
        if point.class_of == class_of && seen.y < MERGING && abs(seen.x) <= ABREAST && from_line < min_distance {
            min_distance = from_line;
            nearest = Nearest(other, point.texel, dot(point.at - line.at, left), distance);
        }
    }
    return nearest;
}

// Half the width of a class where it runs nearest, px.
fn half_width_nearby(class_of: u32, px: vec2<i32>, links: u32, first: vec2<i32>) -> f32 {
    return half_width_of(nearest_of(class_of, px, links, select(0u, 1u, first.y < first.x)).texel);
}

// The widest of these classes, which are bits of a number; of equal ones the first.
fn widest_of(classes: u32, px: vec2<i32>, links: u32, ahead: Stretch, behind: Stretch) -> u32 {
    var widest = countTrailingZeros(classes) + 1u;
    if !WIDER_FIRST || (classes & (classes - 1u)) == 0u {
        return widest;
    }
    var greatest = -1.0;
    for (var left = classes; left != 0u; left &= left - 1u) {
        let class_of = countTrailingZeros(left) + 1u;
        let width = half_width_nearby(class_of, px, links, first_of(steps_of(ahead, behind, class_of)));
        if width > greatest + 0.01 {
            greatest = width;
            widest = class_of;
        }
    }
    return widest;
}

// The class of a line here.
fn settled(px: vec2<i32>, own: u32, links: u32, ahead: Stretch, behind: Stretch) -> u32 {
    let longest = longest_gap();
    let ends = vec2(ahead.end, behind.end);
    // Those that have a stretch here.
    var running = 0u;
    // That which most of the line has here.
    var most = 0;
    var usual = own;
    for (var left = ahead.classes | behind.classes; left != 0u && (WIDER_FIRST || running == 0u); left &= left - 1u) {
        let class_of = countTrailingZeros(left) + 1u;
        let steps = steps_of(ahead, behind, class_of);
        let first = first_of(steps);
        if first.x + first.y <= longest {
            let last = last_of(steps, first, longest);
            let is_dense = MAX_STEPS_APART * count_up_to(steps, last) >= last.x + last.y + 1;
            if is_dense && (last.x + last.y + 1 >= longest || any(last + 1 >= ends)) {
                running |= bit_of(class_of);
            }
        }
        let count = count_up_to(steps, min(vec2(longest), ends));
        usual = select(usual, class_of, count > most);
        most = max(most, count);
    }
    if running == 0u {
        return usual;
    }
    return widest_of(running, px, links, ahead, behind);
}
