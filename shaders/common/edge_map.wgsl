// The edge map: one texel per pixel, before lines get their width. Each texel of an exact line holds the point of the
// line's spine that is nearest to the pixel's center. Written by
// passes/{operators,segment_points,discontinuities,details}.wgsl, changed by passes/line_classes.wgsl, moved by passes/moved_edges.wgsl.

const NO_EDGE: u32 = 0u;
// Classes as in src/geometry/edge_class.rs, plus 1.
const SILHOUETTE: u32 = 1u;
const BORDER: u32 = 2u;
const OBJECT: u32 = 3u;
const RIDGE: u32 = 4u;
const VALLEY: u32 = 5u;
const MATERIAL: u32 = 6u;
const INTERSECTION: u32 = 7u;
const TEXTURE: u32 = 8u;
const RELIEF: u32 = 9u;
const SHADOW: u32 = 10u;
const SECTION: u32 = 11u;
// Ink of the papers' operators at this very pixel.
const OPERATOR_INK: u32 = 15u;

// Whether a class is of the profile edges.
fn is_of_profile(class_of: u32) -> bool {
    return class_of <= OBJECT || class_of == SECTION;
}

struct Edge {
    class_of: u32,
    // The object whose style draws it.
    object: u32,
    // From the pixel's center to the spine, px, each within ±1.
    offset: vec2<f32>,
    // Direction of the line, see `pack_tangent`.
    tangent: u32,
    // 1: left of the tangent (x to the right, y down) is outside of the object, −1: right of it.
    outside: f32,
    // How far the line goes on in both directions of the tangent, px: 0, 0.25, 0.5 or 0.75.
    extent: f32,
    // Linear depth of the spine.
    depth: f32,
    // px.
    half_width: f32,
    // Position in the period of the dashes, 0 to 1.
    phase: f32,
    // 0 to 1. With weight 0 nothing is drawn, but what causes the edge is known.
    weight: f32,
}

const TAU: f32 = 6.283185307;

// A direction as one of 512 angles.
fn pack_tangent(tangent: vec2<f32>) -> u32 {
    return u32(round(fract(atan2(tangent.y, tangent.x) / TAU) * 512.0)) & 511u;
}

fn unpack_tangent(tangent: u32) -> vec2<f32> {
    let angle = f32(tangent) / 512.0 * TAU;
    return vec2(cos(angle), sin(angle));
}

fn pack_offset(offset: vec2<f32>) -> u32 {
    let both = vec2<u32>(round((clamp(offset, vec2(-1.0), vec2(1.0)) + 1.0) * 127.0));
    return (both.x << 8u) | both.y;
}

// x: class (4 bits), extent (2), outside (1), angle of the tangent (9), offset (2 × 8); y: object; z: depth; w: weight
// (6), phase (10), half width (f16, its sign as in `STROKE`).
fn pack_edge(e: Edge) -> vec4<u32> {
    let outside = select(0u, 1u, e.outside > 0.0);
    let extent = u32(clamp(e.extent, 0.0, 0.75) * 4.0);
    let phase = u32(fract(e.phase) * 1023.0 + 0.5);
    let weight = u32(clamp(e.weight, 0.0, 1.0) * 63.0 + 0.5);
    return vec4(
        (e.class_of << 28u) | (extent << 26u) | (outside << 25u) | (e.tangent << 16u) | pack_offset(e.offset),
        e.object,
        bitcast<u32>(e.depth),
        (weight << 26u) | (phase << 16u) | pack2x16float(vec2(e.half_width, 0.0)),
    );
}

fn class_of(texel: vec4<u32>) -> u32 {
    return texel.x >> 28u;
}

fn offset_of(texel: vec4<u32>) -> vec2<f32> {
    return vec2(f32((texel.x >> 8u) & 255u), f32(texel.x & 255u)) / 127.0 - 1.0;
}

// No width is negative: the bit of its sign tells of a stroke of a hand, which may lie over what is nearer.
const STROKE: u32 = 0x8000u;

fn half_width_of(texel: vec4<u32>) -> f32 {
    return unpack2x16float(texel.w & 0x7fffu).x;
}

fn is_stroke(texel: vec4<u32>) -> bool {
    return (texel.w & STROKE) != 0u;
}

// Whether it is of an exact line that is drawn.
fn has_line(texel: vec4<u32>) -> bool {
    return class_of(texel) != NO_EDGE && class_of(texel) != OPERATOR_INK && (texel.w >> 26u) != 0u;
}

// What finding the line of each pixel needs of a texel: the offset as above, and over it a radius as f16; 0 where no
// line with ink is. The radius is half the width or all of it (`halves` 1 or 2, see `halves_of`), and up to a pixel more
// for lines that are to win where others run close beside them, so that wide lines are not torn: profile edges before
// inner ones (`rank` 1 or 0), near ones before far ones (`nearness`, 0 to 1). Thin ones have less of it: they would
// swallow others two pixels beside them.
fn spine_of(texel: vec4<u32>, halves: f32, rank: f32, nearness: f32) -> u32 {
    let own = halves * half_width_of(texel);
    let radius = own + clamp(own - 0.75, 0.0, 1.0) * (0.5 * rank + 0.5 * clamp(nearness, 0.0, 1.0));
    return select(0u, (pack2x16float(vec2(radius, 0.0)) << 16u) | (texel.x & 0xffffu), has_line(texel));
}

fn unpack_edge(texel: vec4<u32>) -> Edge {
    return Edge(
        class_of(texel),
        texel.y,
        offset_of(texel),
        (texel.x >> 16u) & 511u,
        select(-1.0, 1.0, ((texel.x >> 25u) & 1u) == 1u),
        f32((texel.x >> 26u) & 3u) * 0.25,
        bitcast<f32>(texel.z),
        half_width_of(texel),
        f32((texel.w >> 16u) & 1023u) / 1023.0,
        f32(texel.w >> 26u) / 63.0,
    );
}

// Inner and profile ink of the papers' operators: x, y, z as above, w: two 16-bit numbers from 0 to 1.
fn pack_operator_ink(ink: vec2<f32>, object: u32, depth: f32) -> vec4<u32> {
    return vec4(OPERATOR_INK << 28u, object, bitcast<u32>(depth), pack2x16unorm(ink));
}

fn operator_ink(texel: vec4<u32>) -> vec2<f32> {
    return unpack2x16unorm(texel.w);
}
