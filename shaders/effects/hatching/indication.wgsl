// Indication: strokes that are left out away from details (Bu et al. 2006, section 3, "Indication"). Details are where lines run, or
// where the fields of the paper say.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import effects/hatching/style.wgsl
#import gpu/record_texture.wgsl

// The nearest line that is drawn, as `found_tex` in passes/line_distance.wgsl.
var nearest_edge_tex: texture_storage_2d<r32uint, read>;
// Two planes of each flat part: src/geometry/patches.rs.
var flat_parts: texture_storage_2d<rgba32uint, read>;

// Pixels of a quarter of the circle around that are compared.
const PIXELS_OF_QUARTER: u32 = 4u;
// Nothing is divided by less.
const MIN_DIVISOR: f32 = 1e-3;

// (a + b · x)^−c.
fn weight_at(x: f32, offset: f32, slope: f32, power: f32) -> f32 {
    return pow(max(offset + slope * x, MIN_DIVISOR), -power);
}

// w1 at a place in local space: by the distance to the border of the square that a flat part is mapped to. `part`: counted from 1.
fn patch_field(part: u32, place: vec3<f32>, i: Indication) -> f32 {
    if part == 0u {
        return 0.0;
    }
    let first = bitcast<vec4<f32>>(texel_at(flat_parts, 2u * (part - 1u)));
    let second = bitcast<vec4<f32>>(texel_at(flat_parts, 2u * (part - 1u) + 1u));
    let at = vec2(dot(first, vec4(place, 1.0)), dot(second, vec4(place, 1.0)));
    let inside = min(at, 1.0 - at);
    return weight_at(clamp(min(inside.x, inside.y), 0.0, 0.5), i.patch_offset, i.patch_slope, i.patch_power);
}

// field(n) = α / (n^β + λ), also where nothing is apart and λ is 0.
fn silhouette_term(count: u32, i: Indication) -> f32 {
    return i.alpha / max(pow(f32(count), i.beta) + i.lambda, MIN_DIVISOR);
}

// Whether a silhouette separates two pixels: the other one lies off the plane of the first by a step, or is turned away from it.
fn is_apart(s: Surfel, plane: Plane, other: Surfel, offset: vec2<i32>, step: f32) -> bool {
    if other.object == 0u || dot(other.normal, s.normal) < 0.5 {
        return true;
    }
    let off = nearness_of(other.depth) - nearness_at(plane, vec2<f32>(offset));
    return abs(step_px(off, s.depth)) > step;
}

// w2.
fn silhouette_field(px: vec2<i32>, s: Surfel, i: Indication) -> f32 {
    let plane = plane_of(px, s.depth, s.face_direction);
    var count = 0u;
    for (var k = 0u; k < PIXELS_OF_QUARTER; k++) {
        let angle = f32(k) * 1.570796327 / f32(PIXELS_OF_QUARTER);
        var offset = vec2<i32>(round(i.radius * vec2(cos(angle), sin(angle))));
        for (var quarter = 0u; quarter < 4u; quarter++) {
            let other = unpack_surfel(geometry_at(px + offset));
            count += select(0u, 1u, is_apart(s, plane, other, offset, i.step));
            offset = vec2(-offset.y, offset.x);
        }
    }
    return weight_at(silhouette_term(count, i), i.silhouette_offset, i.silhouette_slope, i.silhouette_power);
}

// (1 + distance / d)^−c, by the distance to the nearest line; more where that is of something that attracts.
fn line_field(i: Indication, attraction: f32, away: f32) -> f32 {
    let distance = i.distance * attraction;
    return select(0.0, pow(1.0 + away / max(distance, MIN_DIVISOR), -i.falloff), distance > 0.0);
}
