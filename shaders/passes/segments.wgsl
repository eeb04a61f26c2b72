// The lines that meshes know (silhouettes, borders, creases, material boundaries, intersections), where something of them is visible:
// the pixels of each segment, one per step along it. Software devices run both sides of a branch, so steps are culled first
// (passes/segments/cull.wgsl), and only those that are left are looked at closely, here. passes/segment_points.wgsl puts what is
// found into the edge map.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl
#import common/line_width.wgsl
#import common/pixel.wgsl
#import gpu/record_list.wgsl
#import common/segment_point.wgsl
#import passes/segments/segment.wgsl
#import passes/segments/steps.wgsl
#import passes/segments/beside.wgsl
#import passes/segments/goes_on.wgsl

// The steps that were kept.
var<storage, read> listed_steps: array<u32>;
// What is found of each.
var point_tex: texture_storage_2d<rgba32uint, write>;
// The greatest key of each pixel.
var<storage, read_write> keys: array<atomic<u32>>;

// Where segments share a pixel the greatest counts, 0 to 1: the widest, for it would hide the others; profile edges before inner
// ones; of inner ones the class that comes first, as where lines merge (`widest_of`), so that both agree where a fold is an
// intersection too; then the nearest, so roughly that lines at one place are told apart by the object's number: which one wins does
// not change along them. A line that goes on behind a nearer object leaves the pixel to its outline. x: where it is drawn; y: where
// it is suppressed.
fn precedence_of(own: u32, class_of: u32, depth: f32, full_width: f32, stroke_precedence: f32, ends_here: bool) -> vec2<f32> {
    let is_profile = is_of_profile(class_of);
    let rank = f32(u32(min(full_width * 4.0, 126.0))) + select(0.0, 0.5, is_profile);
    let roughly = bitcast<f32>(bitcast<u32>(depth) & ~0xfffu);
    let clip = frame.clip_from_view * vec4(0.0, 0.0, -roughly, 1.0);
    let nearest = clip.z / clip.w * (1.0 - f32(own & 63u) / f32(64 << 12u));
    let by_class = select((f32(SECTION - class_of) + nearest) / f32(SECTION), nearest, is_profile);
    // Of strokes the same time of drawing counts everywhere, so that none tears another one along it.
    let first = select(by_class, mix(nearest, stroke_precedence, 0.5), WITH_STROKES);
    let drawn = select(rank + 1.0 + 0.499 * first, 0.5 + 0.499 * first, ends_here);
    return vec2(drawn, 0.5 * nearest) / 128.0;
}

// What is found at a pixel of a segment.
fn point_at(v: Segment, number: u32, px: vec2<f32>) -> SegmentPoint {
    let spine = spine_at(v, direction_of(v), px);
    let depth = spine.depth;
    let surface_ids = v.ids.zw;
    let tested = tested_spine(v, number, spine);
    let hand = stroke_weights_at(number);
    let left = beside(tested, PLACES[3], surface_ids);
    let right = beside(tested, PLACES[1], surface_ids);
    let own = v.ids.y;
    let style = style_of(own);
    if min(left.lead, right.lead) > SLACK || !is_carried(tested, spine, left, right, surface_ids) {
        return NO_POINT;
    }
    // The outside is where the line's own object ends, or else where the surface lies farther back.
    let left_is_own = left.surfel.object == own;
    let left_is_outside = select(left.lead < right.lead, !left_is_own, left_is_own != (right.surfel.object == own));
    let behind = select(right.surfel.object, left.surfel.object, left_is_outside);
    let is_outside_covered = select(is_covered(right, own), is_covered(left, own), left_is_outside);
    let meets_outside = select(meets(left, right, own), meets(right, left, own), left_is_outside);
    let step_behind = -select(right.lead, left.lead, left_is_outside);

    var class_of = (v.ids.x & 15u) + 1u;
    if class_of <= BORDER && behind != 0u && behind != own {
        class_of = OBJECT;
    }
    let index = class_of - 1u;
    var weight = crease_weight(own, v.angle);
    if class_of <= OBJECT {
        // Without a threshold, what stands on a surface (or slightly in it) has a line at its foot.
        let threshold = edge_styles[style].lines[index].threshold;
        if threshold > 0.0 && step_behind < threshold || goes_on_under(tested, own, length_of(v)) {
            return NO_POINT;
        }
        // An outline beyond which another object is nearer lies inside that object: their intersection is seen there instead.
        if is_outside_covered {
            return NO_POINT;
        }
        // What dips into another object, however little, ends where the two meet.
        if meets_outside && edge_styles[style].lines[INTERSECTION - 1u].opacity > 0.0 {
            return NO_POINT;
        }
        if class_of == BORDER && sinks(tested, left, right, own, surface_ids) {
            return NO_POINT;
        }
        weight = 1.0;
    } else if class_of == MATERIAL || class_of == SECTION || class_of == INTERSECTION {
        weight = 1.0;
    }
    let is_drawn = edge_styles[style].lines[index].opacity > 0.0 && weight > 0.0;
    let is_suppressed = (v.ids.x & SUPPRESSED) != 0u || !is_drawn;
    let pos_view = pos_view_of(vec2<i32>(px), depth);
    let front = select(left.surfel.normal, right.surfel.normal, left_is_outside);
    let full_width = half_width(own, class_of, pos_view, front);
    var width = full_width;
    if WITH_STROKES {
        // A hand that presses less draws lines paler and thinner.
        let pressed = mix(hand.weights.x, hand.weights.y, spine.t);
        weight *= mix(1.0, pressed, 0.7);
        width *= mix(1.0, pressed, 0.6);
    }
    let arc = mix(v.depths_arcs.z, v.depths_arcs.w, spine.t);
    let edge = Edge(
        class_of,
        own,
        spine.at - px - 0.5,
        pack_tangent(spine.tangent),
        select(-1.0, 1.0, left_is_outside),
        // Of short segments only some have a pixel: each goes on to the next one that has.
        clamp(0.5 / max(spine.inverse_length, 1e-6), 0.5, 0.75) * select(0.0, 1.0, spine.inverse_length > 0.0),
        depth,
        width,
        arc / edge_styles[style].dash_period,
        select(weight, 0.0, is_suppressed),
    );
    let ends_here = is_covered(left, own) || is_covered(right, own);
    let is_profile = is_of_profile(class_of);
    let precedence = precedence_of(own, class_of, depth, full_width, hand.precedence, ends_here);
    let order = select(precedence.x, precedence.y, is_suppressed);
    var texel = pack_edge(edge);
    texel.w |= select(0u, STROKE, hand.is_stroke);
    let is_outline = class_of <= OBJECT;
    // Strokes cross each other: there is no room around any line.
    let nearness = select(1.0 - range_share(depth), 0.0, WITH_STROKES);
    let packed = spine_of(texel, halves_of(own, class_of), select(0.0, 1.0, is_profile && !WITH_STROKES), nearness);
    let mark = select(0u, 1u, is_outline || !is_suppressed || (is_drawn && (v.ids.x & ELSEWHERE) != 0u));
    // Positive numbers have the order of their bits, and those below 1 leave two of them.
    return SegmentPoint(texel, packed, (bitcast<u32>(order) << 1u) | mark, pack_pixel(vec2<i32>(px)), number);
}

@compute @workgroup_size(GROUP)
fn cs_points(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let step = step_at(listed_steps[id.x]);
    let segment = segment_at(step.x);
    let point = point_at(segment, step.x, step_pixel(stepping_of(segment.ends), step.y).px);
    textureStore(point_tex, texel_of_record(2u * id.x), point.edge);
    textureStore(point_tex, texel_of_record(2u * id.x + 1u), second_texel_of(point));
    if point.key != 0u {
        atomicMax(&keys[index_of_pixel(unpack_pixel(point.px))], point.key);
    }
}
