// What continues a line: links from pixel to pixel.
#import common/frame.wgsl
#import common/edge_map.wgsl
#import common/line_block.wgsl

var edge_map_tex: texture_storage_2d<rgba32uint, read>;
var block_tex: texture_storage_2d<r32uint, read>;

// A line goes on beside its tangent up to this distance, px.
const BESIDE: f32 = 1.0;
// Two lines that are closer than this, px, are one: their ink overlaps.
const MERGING: f32 = 1.5;
// Points are side by side up to this distance along their line, px.
const ABREAST: f32 = 0.75;
// Angle up to which two tangents belong to one line, of 512 for a full turn: 32 degrees.
const PARALLEL: i32 = 45;

// The point of a line in a pixel that is listed.
struct Point {
    texel: vec4<u32>,
    // `NO_EDGE`: it made way.
    class_of: u32,
    // px.
    at: vec2<f32>,
    // As in the edge map.
    tangent: i32,
}

fn point_at(px: vec2<i32>) -> Point {
    let texel = textureLoad(edge_map_tex, px);
    return Point(texel, class_of(texel), vec2<f32>(px) + 0.5 + offset_of(texel), i32((texel.x >> 16u) & 511u));
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
const OWN: u32 = 12u;

fn away_of(place: u32) -> vec2<i32> {
    return vec2<i32>(vec2(place % 5u, place / 5u)) - 2;
}

fn opposite_of(place: u32) -> u32 {
    return 2u * OWN - place;
}

// The places around a pixel in which lines run, or ran before they made way, as the bits of a number.
fn lines_around(px: vec2<i32>) -> u32 {
    // They lie in two by two blocks.
    let first = px - 2;
    let block = first >> vec2(2u);
    let top_left = textureLoad(block_tex, block).x;
    let top_right = textureLoad(block_tex, block + vec2(1, 0)).x;
    let bottom_left = textureLoad(block_tex, block + vec2(0, 1)).x;
    let bottom_right = textureLoad(block_tex, block + 1).x;
    let place = vec2<u32>(first - LINE_BLOCK * block);
    var lines = 0u;
    for (var y = 0u; y < 5u; y++) {
        let row = place.y + y;
        let is_top = row < 4u;
        let left = (select(bottom_left, top_left, is_top) >> (4u * (row & 3u))) & FIRST_ROW;
        let right = (select(bottom_right, top_right, is_top) >> (4u * (row & 3u))) & FIRST_ROW;
        lines |= (((left | (right << 4u)) >> place.x) & 31u) << (5u * y);
    }
    return lines;
}

// The greater side of the box around these places, px.
fn extent_around(places: u32) -> f32 {
    let columns = (places | (places >> 5u) | (places >> 10u) | (places >> 15u) | (places >> 20u)) & 31u;
    let rows = (places | (places >> 1u) | (places >> 2u) | (places >> 3u) | (places >> 4u)) & 0x108421u;
    let both = vec2(columns, rows);
    let extent = (firstLeadingBit(both) - firstTrailingBit(both)) / vec2(1u, 5u);
    return f32(max(extent.x, extent.y));
}

// The next pixel of a line.
struct PixelLink {
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

fn pack_link(link: PixelLink) -> u32 {
    return link.place | (select(0u, 1u, link.is_turned) << 5u) | (u32(round(6.0 * link.distance)) << 6u);
}

fn unpack_link(texel: u32, side: u32) -> PixelLink {
    let bits = texel >> (CLASS_BITS + side * LINK_BITS);
    return PixelLink(bits & 31u, ((bits >> 5u) & 1u) != 0u, f32((bits >> 6u) & 15u) / 6.0);
}

fn classes_in(texel: u32) -> u32 {
    return texel & ((1u << CLASS_BITS) - 1u);
}

fn bit_of(class_of: u32) -> u32 {
    return 1u << (class_of - 1u);
}
