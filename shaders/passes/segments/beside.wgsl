// The surfaces beside a segment: what hides it, and what carries it.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import passes/segments/segment.wgsl

// Whether any object has holes by alpha: there a line needs one of its own surfaces beside it.
override WITH_HOLES: bool = true;
// Whether the G-buffer is a depth layer: only what its own surfaces carry is a line of it.
override IN_LAYER: bool = false;

var surface_id_tex: texture_storage_2d<r32uint, read>;

// So far, in pixels, may a surface lie before a line that is drawn on it.
const SLACK: f32 = 0.4;
// So far, in pixels, lies a surface of another object before a line whose ink it hides.
const COVERS: f32 = 2.0;
// So far before a line, in pixels, lies a surface of another object into which its own dips.
const DIPS: f32 = 0.2;
// So far before a border, in pixels, lies another surface of its object into which it sinks.
const SINKS: f32 = 0.2;
// How far beside the spine is looked, px: just far enough that the pixel lies wholly on that side.
const BESIDE: f32 = 0.8;

fn texel_of(at: vec2<f32>) -> vec2<i32> {
    return clamp(vec2<i32>(floor(at)), vec2(0), vec2<i32>(frame.size) - 1);
}

// How far along the normal of a spine pixels are asked for the surfaces that carry it, px.
const PLACES: array<f32, 5> = array(-2.0 * BESIDE, -BESIDE, 0.0, BESIDE, 2.0 * BESIDE);

fn texel_beside(spine: Spine, along: f32) -> vec2<i32> {
    return texel_of(spine.at + along * spine.normal);
}

// What a pixel near the spine shows.
struct Beside {
    px: vec2<i32>,
    surfel: Surfel,
    // Of its surface.
    plane: Plane,
    // How far its surface, continued to the spine, lies before it, px.
    lead: f32,
    // The same at least: by less the steeper it is, as it may bend on the way.
    sure_lead: f32,
    // Whether a layer's surface is one of the segment's and runs through the spine, as exactly as its slope allows: curved
    // surfaces bend away from their plane the more, the steeper it is.
    carries: bool,
}

// So far along the normal of the spine, px.
fn beside(spine: Spine, along: f32, surface_ids: vec2<u32>) -> Beside {
    let px = texel_beside(spine, along);
    var surface_id = 0u;
    var texel = textureLoad(geometry_tex, px);
    if IN_LAYER {
        surface_id = textureLoad(surface_id_tex, px).x;
        // Where a layer has nothing its geometry is 0.
        texel = select(texel, vec4(0u), surface_id == 0u);
    }
    let s = unpack_surfel(texel);
    let plane = plane_of(px, s.depth, s.face_direction);
    let lead = nearness_at(plane, spine.at - vec2<f32>(px) - 0.5) - spine.nearness;
    var carries = false;
    if IN_LAYER {
        let miss = abs(lead) - length(plane.slope);
        carries = any(surface_ids == vec2(surface_id)) && step_px(miss, spine.depth) <= 2.0;
    }
    let leads = vec2(step_px(lead, spine.depth), step_px(lead - bend_of(plane), spine.depth));
    let there = select(leads, vec2(-1e9), s.object == 0u);
    return Beside(px, s, plane, there.x, there.y, carries && s.object != 0u);
}

// Whether one of these surfaces is seen on either side of a spine, or on it.
fn is_carried_beside(spine: Spine, surface_ids: vec2<u32>) -> bool {
    var found = false;
    for (var i = 1; i <= 3; i++) {
        found = found || any(surface_ids == vec2(textureLoad(surface_id_tex, texel_beside(spine, PLACES[i])).x));
    }
    return found;
}

// Whether another object hides the ink of a line there.
fn is_covered(there: Beside, own: u32) -> bool {
    return there.surfel.object != own && there.sure_lead > COVERS;
}

// Whether a line's object ends there because it meets another one, which lies before the line but behind the object's own surface
// inside.
fn meets(inside: Beside, outside: Beside, own: u32) -> bool {
    return inside.surfel.object == own && outside.surfel.object != own && outside.sure_lead > DIPS
        && nearness_at(outside.plane, vec2<f32>(inside.px - outside.px)) < inside.plane.center;
}

// Whether a border sinks into another surface of its object, seen on one side while its own is seen on the other: their
// intersection is seen instead.
fn sinks(spine: Spine, left: Beside, right: Beside, own: u32, surface_ids: vec2<u32>) -> bool {
    let left_id = textureLoad(surface_id_tex, texel_beside(spine, PLACES[3])).x;
    let right_id = textureLoad(surface_id_tex, texel_beside(spine, PLACES[1])).x;
    let left_is_own = any(surface_ids == vec2(left_id));
    let right_is_own = any(surface_ids == vec2(right_id));
    if left_is_own {
        return !right_is_own && right.surfel.object == own && right.sure_lead > SINKS;
    }
    return right_is_own && left.surfel.object == own && left.sure_lead > SINKS;
}

// Whether one of the line's own surfaces is seen there.
fn is_carried(tested: Spine, spine: Spine, left: Beside, right: Beside, surface_ids: vec2<u32>) -> bool {
    if IN_LAYER {
        return left.carries || right.carries
            || beside(spine, PLACES[2], surface_ids).carries
            || beside(spine, PLACES[4], surface_ids).carries
            || beside(spine, PLACES[0], surface_ids).carries;
    }
    return !WITH_HOLES || is_carried_beside(tested, surface_ids);
}
