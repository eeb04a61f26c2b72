// The lines within a surface that have nothing to do with its shape: where its color, its relief (the shading normal)
// or the shadow on it changes suddenly.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl
#import common/line_width.wgsl
#import common/repeated.wgsl

// Which classes any object draws.
override WITH_TEXTURE: bool = true;
override WITH_RELIEF: bool = true;
override WITH_SHADOW: bool = true;

var surface_id_tex: texture_2d<u32>;
// What segments have; see common/segment_point.wgsl.
var mark_tex: texture_2d<u32>;
var base_color_tex: texture_2d<f32>;
// Of passes/shadow_mask.wgsl.
var shadow_mask_tex: texture_2d<f32>;
// Without repeated lines: the spines of all nearer layers.
var nearer_lines_tex: texture_storage_2d<r32uint, read>;

fn surface_id_at(px: vec2<i32>) -> u32 {
    return textureLoad(surface_id_tex, clamp(px, vec2(0), vec2<i32>(frame.size) - 1), 0).x;
}

// What changes: the color, in steps that look even; the normal, of length 1; or which lights reach the pixel.
fn detail_at(class_of: u32, px: vec2<i32>) -> vec4<f32> {
    let q = clamp(px, vec2(0), vec2<i32>(frame.size) - 1);
    if WITH_RELIEF && class_of == RELIEF {
        return vec4(unpack_surfel(geometry_at(q)).normal, 0.0);
    }
    if WITH_SHADOW && class_of == SHADOW {
        return textureLoad(shadow_mask_tex, q, 0);
    }
    return vec4(sqrt(max(textureLoad(base_color_tex, q, 0).rgb, vec3(0.0))), 0.0);
}

// A light that grazes a surface at less than this cosine throws no shadow that has a border: there the surface itself
// turns away.
const GRAZING: f32 = 0.1;

// Which parts of a detail count at a pixel.
fn counted(class_of: u32, x: Surfel, pos_view: vec3<f32>) -> vec4<f32> {
    if !WITH_SHADOW || class_of != SHADOW {
        return vec4(1.0);
    }
    var counts = vec4(0.0);
    for (var i = 0u; i < frame.light_count; i++) {
        let channel = frame.lights[i].shadow;
        if channel > 0u && dot(x.normal, towards_light(frame.lights[i], pos_view)) > GRAZING {
            counts[channel - 1u] = 1.0;
        }
    }
    return counts;
}

// From a pixel to itself and its eight neighbors, row by row.
fn neighbor_offset(n: i32) -> vec2<i32> {
    return vec2(n % 3, n / 3) - 1;
}

struct Step {
    // From the pixel's center to where the middle between both sides is, px.
    offset: vec2<f32>,
    // Difference of the two sides; negative: of a slope, how steep it is, per px.
    contrast: f32,
    // Towards the greater side.
    normal: vec2<f32>,
}

// The farthest value towards a side that is reached without turning back, and whether it levels off there. A step that
// goes on for longer than this many strides is a slope.
const REACH: i32 = 4;

struct Side {
    value: f32,
    is_level: bool,
}

fn side_of(class_of: u32, px: vec2<i32>, own: u32, start: vec4<f32>, along: vec4<f32>, step: vec2<f32>) -> Side {
    var value = 0.0;
    var rise = 0.0;
    for (var k = 1; k <= REACH; k++) {
        let q = px + vec2<i32>(round(step * f32(k)));
        if surface_id_at(q) != own {
            return Side(value, true);
        }
        let next = dot(detail_at(class_of, q) - start, along);
        rise = next - value;
        if rise <= 0.0 {
            return Side(value, true);
        }
        value = next;
    }
    return Side(value, rise < 0.1 * value);
}

// The step of a value near the center of a pixel, if there is one: across the direction of greatest change (Di Zenzo
// 1986), the place half way between the two sides; seen in strides of so many pixels.
fn step_in(class_of: u32, counts: vec4<f32>, px: vec2<i32>, own: u32, stride: i32) -> Step {
    let none = Step(vec2(0.0), 0.0, vec2(0.0));
    let center = detail_at(class_of, px);
    var dx = vec4(0.0);
    var dy = vec4(0.0);
    for (var n = 0; n < 9; n++) {
        let o = neighbor_offset(n);
        var value = center;
        if surface_id_at(px + o * stride) == own {
            value = detail_at(class_of, px + o * stride);
        }
        // Sobel.
        dx += f32(o.x * (2 - abs(o.y))) / 8.0 * value * counts;
        dy += f32(o.y * (2 - abs(o.x))) / 8.0 * value * counts;
    }
    let a = dot(dx, dx);
    let b = dot(dx, dy);
    let c = dot(dy, dy);
    let angle = 0.5 * atan2(2.0 * b, a - c);
    let normal = vec2(cos(angle), sin(angle));
    let change = dx * normal.x + dy * normal.y;
    let slope = length(change);
    if slope < 1e-3 {
        return none;
    }
    let along = change / slope;
    let high = side_of(class_of, px, own, center, along, normal * f32(stride));
    let low = side_of(class_of, px, own, center, -along, -normal * f32(stride));
    if !high.is_level || !low.is_level {
        return Step(vec2(0.0), -slope / f32(stride), normal);
    }
    // The center's own value, as smooth as the slope is.
    var smoothed = 0.0;
    for (var n = 0; n < 9; n++) {
        let o = neighbor_offset(n);
        if surface_id_at(px + o * stride) == own {
            let weight = f32((2 - abs(o.x)) * (2 - abs(o.y))) / 16.0;
            smoothed += weight * dot(detail_at(class_of, px + o * stride) - center, along);
        }
    }
    let middle = 0.5 * (high.value - low.value);
    return Step(normal * (middle - smoothed) / slope * f32(stride), high.value + low.value, normal);
}

// A wider look at what is no step: between the texels of an enlarged image colors change over many pixels.
const WIDE_STRIDE: i32 = 4;

fn step_near(class_of: u32, x: Surfel, px: vec2<i32>, own: u32) -> Step {
    let counts = counted(class_of, x, pos_view_of(px, x.depth));
    let near = step_in(class_of, counts, px, own, 1);
    if near.contrast >= 0.0 {
        return near;
    }
    let wide = step_in(class_of, counts, px, own, WIDE_STRIDE);
    // What is steep was near enough to be a step.
    if wide.contrast < -f32(REACH - 1) * near.contrast {
        return Step(vec2(0.0), 0.0, vec2(0.0));
    }
    return wide;
}

struct Out {
    @location(0) edge: vec4<u32>,
    @location(1) spine: u32,
    // Of this layer and all nearer ones.
    @location(2) seen: u32,
}

fn is_drawn(object: u32, class_of: u32) -> bool {
    return edge_styles[style_of(object)].lines[class_of - 1u].opacity > 0.0;
}

// Whether a step is so near to the center that the pixel holds it.
fn is_at(step: Step) -> bool {
    return all(abs(step.offset) <= vec2(0.75));
}

// Less is not the border of a shadow, but its inside.
const SHADOW_CONTRAST: f32 = 0.6;

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> Out {
    let px = vec2<i32>(position.xy);
    let geometry = geometry_at(px);
    let x = unpack_surfel(geometry);
    let own = surface_id_at(px);
    let has_texture = WITH_TEXTURE && is_drawn(x.object, TEXTURE);
    // A face that is shaded flat has no relief.
    let has_relief = WITH_RELIEF && is_drawn(x.object, RELIEF) && geometry.x != geometry.y;
    let has_shadow = WITH_SHADOW && is_drawn(x.object, SHADOW);
    let has_details = has_texture || has_relief || has_shadow;
    if !x.enhanced || edge_styles[style_of(x.object)].mode != EXACT_MODE || !has_details {
        discard;
    }
    // Where a surface ends or folds, there is a line already.
    for (var n = 0; n < 9; n++) {
        let q = clamp(px + neighbor_offset(n), vec2(0), vec2<i32>(frame.size) - 1);
        if surface_id_at(q) != own || textureLoad(mark_tex, q, 0).x != 0u {
            discard;
        }
    }
    var class_of = NO_EDGE;
    var found = Step(vec2(0.0), 0.0, vec2(0.0));
    if has_shadow {
        let step = step_near(SHADOW, x, px, own);
        if step.contrast >= SHADOW_CONTRAST && is_at(step) {
            class_of = SHADOW;
            found = step;
        }
    }
    if has_texture && class_of == NO_EDGE {
        let step = step_near(TEXTURE, x, px, own);
        if step.contrast >= edge_styles[style_of(x.object)].lines[TEXTURE - 1u].threshold && is_at(step) {
            class_of = TEXTURE;
            found = step;
        }
    }
    if has_relief && class_of == NO_EDGE {
        let step = step_near(RELIEF, x, px, own);
        // The chord between two normals.
        let angle = 2.0 * asin(min(0.5 * step.contrast, 1.0));
        if angle >= edge_styles[style_of(x.object)].lines[RELIEF - 1u].threshold && is_at(step) {
            class_of = RELIEF;
            found = step;
        }
    }
    if class_of == NO_EDGE || found.contrast <= 0.0 {
        discard;
    }
    let pos_view = pos_view_of(px, x.depth);
    let tangent = vec2(found.normal.y, -found.normal.x);
    let arc = dot(vec2<f32>(px) + 0.5 + found.offset, tangent);
    let texel = pack_edge(Edge(
        class_of,
        x.object,
        found.offset,
        pack_tangent(tangent),
        1.0,
        0.5,
        x.depth,
        half_width(x.object, class_of, pos_view, x.normal),
        arc / edge_styles[style_of(x.object)].dash_period,
        1.0,
    ));
    let lines = nearer_lines_at(nearer_lines_tex, px, spine_of(texel, halves_of(x.object, class_of), 0.0, 1.0 - range_share(x.depth)));
    return Out(texel, lines.own, lines.now);
}
