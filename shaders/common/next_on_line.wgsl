// Where a line goes on, some pixels away.
#import common/frame.wgsl
#import common/edge_map.wgsl

var edge_map_tex: texture_storage_2d<rgba32uint, read>;

// How far a line has to be followed from its spine in a pixel to the middle of the pixel so many columns on in the direction of its
// tangent, or rows where it is steep, px: segments have one pixel per column, or per row.
fn along_columns(px: vec2<i32>, spine: vec2<f32>, tangent: vec2<f32>, columns: i32) -> f32 {
    let is_steep = abs(tangent.y) > abs(tangent.x);
    let to_center = vec2<f32>(px) + 0.5 - spine;
    let step = select(tangent.x, tangent.y, is_steep);
    return (select(to_center.x, to_center.y, is_steep) + f32(columns) * sign(step)) / step;
}

struct OnLine {
    px: vec2<i32>,
    // From the spine that was asked about to its own, px.
    away: vec2<f32>,
    is_there: bool,
}

// `side`: 1 in the direction of the tangent, −1 against it. Where nothing is found it is the pixel itself.
fn next_on_line(px: vec2<i32>, edge: Edge, spine: vec2<f32>, tangent: vec2<f32>, side: i32) -> OnLine {
    let last = vec2<i32>(frame.size) - 1;
    let is_steep = abs(tangent.y) > abs(tangent.x);
    // Not every column has one, and it may be the one beside: first two columns on, which says more than the next, and is near.
    for (var i = 0; i < 6; i++) {
        let at = spine + along_columns(px, spine, tangent, side * select(i / 2 + 2, 1, i > 3)) * tangent;
        let within = fract(at) - 0.5;
        let beside = select(vec2(0, select(-1, 1, within.y > 0.0)), vec2(select(-1, 1, within.x > 0.0), 0), is_steep);
        let q = clamp(vec2<i32>(floor(at)) + (i & 1) * beside, vec2(0), last);
        let texel = textureLoad(edge_map_tex, q);
        let away = vec2<f32>(q) + 0.5 + offset_of(texel) - spine;
        // What lies more to the side is another line.
        let is_along = dot(away, tangent) * f32(side) > 0.5 && abs(dot(away, vec2(tangent.y, -tangent.x))) < 1.5;
        if has_line(texel) && texel.y == edge.object && is_along {
            return OnLine(q, away, true);
        }
    }
    return OnLine(px, vec2(0.0), false);
}
