// For each pixel the line that it belongs to, exactly, in time that does not depend on the lines' width.
//
// A line is the union of discs around its spine points, so a pixel is covered where the least d² − r² over all spine
// points is negative (the power distance). Like d² itself that separates into columns and rows; along each, the spine
// points are parabolas whose lower envelope is found in one sweep (Felzenszwalb and Huttenlocher, "Distance Transforms
// of Sampled Functions", 2012, section 2).
#import common/frame.wgsl
#import common/pixel.wgsl

// All lines count as equally wide, with `greatest_radius`: finds the nearest spine instead of the one that reaches
// farthest.
override NEAREST: bool = false;

var spine_tex: texture_2d<u32>;
// Greatest radius of any line, px.
var<storage, read> greatest_radius: array<f32>;
// Per pixel the row of the best spine point of its column, plus 1; 0: none.
var column_tex: texture_storage_2d<r32uint, read_write>;
// Per pixel the pixel of its line, plus 1 (column in the lower 16 bits, row in the upper ones); 0: none.
var found_tex: texture_storage_2d<r32uint, write>;
// The envelope of each row as a stack: the first pixel where a column wins in the lower 16 bits, the column in the
// upper ones.
var stack_tex: texture_storage_2d<r32uint, read_write>;

// A parabola: (p − apex)² + height.
struct Parabola {
    apex: f32,
    height: f32,
}

fn power(p: Parabola, at: f32) -> f32 {
    return (at - p.apex) * (at - p.apex) + p.height;
}

// First whole number p, counted from 0, whose center p + 0.5 lies where the right parabola is lower.
fn begins(left: Parabola, right: Parabola) -> i32 {
    let gap = right.apex - left.apex;
    if gap < 1e-4 {
        // One apex: the lower one everywhere.
        return select(1000000, -1000000, right.height < left.height);
    }
    let at = 0.5 * (left.apex + right.apex) + 0.5 * (right.height - left.height) / gap;
    return i32(clamp(ceil(at - 0.5), -1e6, 1e6));
}

fn radius_of(spine: u32) -> f32 {
    // Further for the edge of the coverage, and because spine points are up to a pixel apart.
    return select(unpack2x16float(spine >> 16u).x, greatest_radius[0], NEAREST) + 1.25;
}

fn offset_of_spine(spine: u32) -> vec2<f32> {
    return vec2(f32((spine >> 8u) & 255u), f32(spine & 255u)) / 127.0 - 1.0;
}

// Down each column and up again the best spine point so far is carried along. (Where widths differ a thin line may be
// dropped here that would reach beyond a wide one; it is then the nearest.)
@compute @workgroup_size(64)
fn cs_columns(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec2<i32>(frame.size);
    let x = i32(id.x);
    if x >= size.x {
        return;
    }
    var best = Parabola(-1e6, 0.0);
    var row = 0u;
    for (var y = 0; y < size.y; y++) {
        let spine = textureLoad(spine_tex, vec2(x, y), 0).x;
        let r = radius_of(spine);
        let own = Parabola(f32(y) + 0.5 + offset_of_spine(spine).y, -r * r);
        let is_better = spine != 0u && power(own, f32(y) + 0.5) <= power(best, f32(y) + 0.5);
        best.apex = select(best.apex, own.apex, is_better);
        best.height = select(best.height, own.height, is_better);
        row = select(row, u32(y) + 1u, is_better);
        textureStore(column_tex, vec2(x, y), vec4(select(0u, row, power(best, f32(y) + 0.5) < 0.0), 0u, 0u, 0u));
    }
    best = Parabola(-1e6, 0.0);
    row = 0u;
    for (var y = size.y - 1; y >= 0; y--) {
        let center = f32(y) + 0.5;
        let above = textureLoad(column_tex, vec2(x, y)).x;
        let spine = textureLoad(spine_tex, vec2(x, i32(max(above, 1u)) - 1), 0).x;
        let r = radius_of(spine);
        // That of the way down may be the pixel's own.
        let own = Parabola(f32(above) - 0.5 + offset_of_spine(spine).y, -r * r);
        let is_own = above == u32(y) + 1u;
        let is_better = above != 0u && power(own, center) <= power(best, center);
        best.apex = select(best.apex, own.apex, is_better && is_own);
        best.height = select(best.height, own.height, is_better && is_own);
        row = select(row, above, is_better && is_own);
        if !is_better && power(best, center) < 0.0 {
            textureStore(column_tex, vec2(x, y), vec4(row, 0u, 0u, 0u));
        }
    }
}

// The parabola of the best spine point of column x along row y.
fn in_row(x: i32, y: i32) -> Parabola {
    let row = textureLoad(column_tex, vec2(x, y)).x;
    if row == 0u {
        return Parabola(0.0, 1.0);
    }
    let spine = textureLoad(spine_tex, vec2(x, i32(row) - 1), 0).x;
    let offset = offset_of_spine(spine);
    let r = radius_of(spine);
    let d = f32(y) + 0.5 - (f32(row) - 0.5 + offset.y);
    return Parabola(f32(x) + 0.5 + offset.x, d * d - r * r);
}

@compute @workgroup_size(64)
fn cs_rows(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = vec2<i32>(frame.size);
    let y = i32(id.x);
    if y >= size.y {
        return;
    }
    var depth = 0;
    var top = Parabola(0.0, 1.0);
    var top_begins = 0;
    for (var x = 0; x < size.x; x++) {
        let next = in_row(x, y);
        if next.height >= 0.0 {
            continue;
        }
        var begin = 0;
        loop {
            if depth == 0 {
                begin = 0;
                break;
            }
            begin = begins(top, next);
            if begin > top_begins {
                break;
            }
            depth--;
            if depth > 0 {
                let entry = textureLoad(stack_tex, vec2(depth - 1, y)).x;
                top = in_row(i32(entry >> 16u), y);
                top_begins = i32(entry & 0xffffu);
            }
        }
        if begin < size.x {
            textureStore(stack_tex, vec2(depth, y), vec4((u32(x) << 16u) | u32(begin), 0u, 0u, 0u));
            depth++;
            top = next;
            top_begins = begin;
        }
    }
    var at = 0;
    var column = 0u;
    var current = Parabola(0.0, 1.0);
    var until = 0;
    for (var x = 0; x < size.x; x++) {
        while at < depth && x >= until {
            let entry = textureLoad(stack_tex, vec2(at, y)).x;
            column = entry >> 16u;
            current = in_row(i32(column), y);
            at++;
            until = size.x;
            if at < depth {
                until = i32(textureLoad(stack_tex, vec2(at, y)).x & 0xffffu);
            }
        }
        let d = f32(x) + 0.5 - current.apex;
        var found = 0u;
        if d * d + current.height < 0.0 {
            let row = textureLoad(column_tex, vec2(i32(column), y)).x - 1u;
            found = found_at(vec2<i32>(vec2(column, row)));
        }
        textureStore(found_tex, vec2(x, y), vec4(found, 0u, 0u, 0u));
    }
}
