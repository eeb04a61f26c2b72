// The lines that topology does not know, found where neighboring pixels show different surfaces: intersections,
// outlines of holes, objects before others.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl
#import common/line_width.wgsl
#import common/repeated.wgsl
#import common/segment_point.wgsl

var surface_id_tex: texture_storage_2d<r32uint, read>;
// What segments have; see common/segment_point.wgsl.
var mark_tex: texture_storage_2d<r32uint, read>;

// The surface ids of the two layers before this one, if it is a depth layer.
var before_tex: texture_2d<u32>;
var before_that_tex: texture_2d<u32>;
// Without repeated lines: the spines of all nearer layers.
var nearer_lines_tex: texture_storage_2d<r32uint, read>;

// Whether a surface that goes on in one of them ends in this layer only because something before it does.
override WITH_LAYERS_BEFORE: bool = false;
// Whether what lies behind a mirror's plane is left out. Where the section plane cuts, there are segments.
override WITH_CLIP_PLANE: bool = false;

// A step in depth, in pixels, from which two surfaces do not touch.
const STEP: f32 = 2.0;
// Cosine of the angle up to which a segment runs along what is found beside it.
const ALONG: f32 = 0.7;

// The surface ids of a pixel and of those beside it.
struct SurfaceIds {
    own: u32,
    left: u32,
    right: u32,
    above: u32,
    below: u32,
}

fn surface_ids_at(px: vec2<i32>) -> SurfaceIds {
    let before = max(px - 1, vec2(0));
    let after = min(px + 1, vec2<i32>(frame.size) - 1);
    return SurfaceIds(
        textureLoad(surface_id_tex, px).x,
        textureLoad(surface_id_tex, vec2(before.x, px.y)).x,
        textureLoad(surface_id_tex, vec2(after.x, px.y)).x,
        textureLoad(surface_id_tex, vec2(px.x, before.y)).x,
        textureLoad(surface_id_tex, vec2(px.x, after.y)).x,
    );
}

fn mark_at(px: vec2<i32>) -> u32 {
    return textureLoad(mark_tex, clamp(px, vec2(0), vec2<i32>(frame.size) - 1)).x;
}

// Whether (not 0) another surface begins towards a neighbor of this surface id, where no nearer layer has a line: an edge between
// two pixels runs through one of them.
fn begins_at(px: vec2<i32>, towards: vec2<i32>, surface_id: u32, own: u32) -> u32 {
    if !WITHOUT_REPEATED {
        return surface_id ^ own;
    }
    return select(surface_id ^ own, 0u, textureLoad(nearer_lines_tex, px + towards).x != 0u);
}

// Marks the pixels beside which another surface begins that no segment explains.
@fragment
fn fs_borders(@builtin(position) position: vec4<f32>) {
    let px = vec2<i32>(position.xy);
    let surface_ids = surface_ids_at(px);
    let own = surface_ids.own;
    let beside = begins_at(px, vec2(-1, 0), surface_ids.left, own) | begins_at(px, vec2(1, 0), surface_ids.right, own);
    let over = begins_at(px, vec2(0, -1), surface_ids.above, own) | begins_at(px, vec2(0, 1), surface_ids.below, own);
    // The corners are looked at later, of the few that are left.
    let marks = mark_at(px) | mark_at(px + vec2(1, 0)) | mark_at(px - vec2(1, 0)) | mark_at(px + vec2(0, 1))
        | mark_at(px - vec2(0, 1));
    let is_repeated = WITHOUT_REPEATED && textureLoad(nearer_lines_tex, px).x != 0u;
    let along = select(0u, UPRIGHT, beside != 0u) | select(0u, LEVEL, over != 0u);
    let is_drawn = (marks & DRAWN) != 0u && (marks & along) != 0u;
    if along == 0u || is_repeated || is_drawn {
        discard;
    }
}

// The spine between the center of a pixel and that of its neighbor.
struct Spine {
    class_of: u32,
    offset: vec2<f32>,
    tangent: vec2<f32>,
    // Whether the object ends here.
    ends_object: bool,
}

// Whether a surface would go on to a pixel but for the cut.
fn is_clipped_off(q: vec2<i32>, plane: Plane, towards: vec2<i32>) -> bool {
    let there = pos_view_of(q, depth_of(nearness_at(plane, vec2<f32>(towards))));
    return dot(frame.clip_plane, vec4(there, 1.0)) < 0.0;
}

// Whether a surface is found at a pixel in a nearer layer: where a solid ends, what lies behind it comes two layers nearer,
// where a sheet ends, one.
fn goes_on_nearer(px: vec2<i32>, surface_id: u32) -> bool {
    let q = clamp(px, vec2(0), vec2<i32>(frame.size) - 1);
    return textureLoad(before_tex, q, 0).x == surface_id || textureLoad(before_that_tex, q, 0).x == surface_id;
}

fn angle_between(one: vec3<f32>, other: vec3<f32>) -> f32 {
    return acos(clamp(abs(dot(one, other)), 0.0, 1.0));
}

// How much more the shading normals of two neighbors differ than those of the pixels before or behind them. Round surfaces that
// lie on each other, like a pin and its hole, alternate as their triangles do, but bend no more than each of them.
fn bend_between(px: vec2<i32>, towards: vec2<i32>, x: Surfel, n: Surfel) -> f32 {
    let before = unpack_surfel(geometry_at(px - towards));
    let after = unpack_surfel(geometry_at(px + 2 * towards));
    let bend_before = select(angle_between(before.normal, x.normal), 0.0, before.object == 0u);
    let bend_after = select(angle_between(after.normal, n.normal), 0.0, after.object == 0u);
    return angle_between(x.normal, n.normal) - min(bend_before, bend_after);
}

// What lies between pixel `px` (surface `x`) and its neighbor of a `surface_id`; class 0: nothing that `x` has to draw.
fn between(px: vec2<i32>, x: Surfel, own: u32, plane: Plane, towards: vec2<i32>, surface_id: u32) -> Spine {
    let q = px + towards;
    let none = Spine(NO_EDGE, vec2(0.0), vec2(1.0, 0.0), false);
    if surface_id == own {
        return none;
    }
    if WITH_CLIP_PLANE && is_clipped_off(q, plane, towards) {
        return none;
    }
    let half = 0.5 * vec2<f32>(towards);
    let across = vec2(half.y, -half.x) * 2.0;
    let n = unpack_surfel(geometry_at(q));
    // There a layer has nothing.
    if surface_id == 0u {
        if WITH_LAYERS_BEFORE && goes_on_nearer(q, own) {
            return none;
        }
        return Spine(SILHOUETTE, half, across, true);
    }
    let other = plane_of(q, n.depth, n.face_direction);
    let depth = min(x.depth, n.depth);
    let gap = step_px(nearness_at(plane, half) - nearness_at(other, -half), depth);
    // Steep surfaces may seem to touch only where they are continued, and may run through each other between the two.
    let jump = step_px(nearness_at(plane, vec2<f32>(towards)) - other.center, depth);
    let back = step_px(plane.center - nearness_at(other, -vec2<f32>(towards)), depth);
    if jump * back > 0.0 && min(abs(jump), abs(back)) > STEP {
        if WITH_LAYERS_BEFORE && goes_on_nearer(q, own) {
            return none;
        }
        // The nearer surface draws.
        let class_of = select(OBJECT, SILHOUETTE, n.object == x.object);
        if gap > 0.0 && gap >= edge_styles[style_of(x.object)].lines[class_of - 1u].threshold {
            return Spine(class_of, half, across, class_of == OBJECT);
        }
        return none;
    }
    let angle = angle_between(x.face_normal, n.face_normal);
    let least = edge_styles[style_of(x.object)].lines[INTERSECTION - 1u].threshold;
    let other_draws = n.enhanced && edge_styles[style_of(n.object)].lines[INTERSECTION - 1u].opacity > 0.0;
    // One of the two draws it.
    if angle < least || (other_draws && surface_id < own) {
        return none;
    }
    if bend_between(px, towards, x, n) < least {
        return none;
    }
    // Where the two planes meet.
    let slope = plane.slope - other.slope;
    let start = plane.center - nearness_at(other, -vec2<f32>(towards));
    let steep = dot(slope, slope);
    let offset = -start * slope / max(steep, 1e-38);
    if steep < 1e-38 || dot(offset, offset) > 1.0 {
        return Spine(INTERSECTION, half, across, false);
    }
    return Spine(INTERSECTION, offset, normalize(vec2(slope.y, -slope.x)), false);
}

// What segments have around a pixel, as far as they run along what is found there: one that crosses it explains nothing.
fn marks_along(px: vec2<i32>, tangent: vec2<f32>) -> u32 {
    var marks = 0u;
    for (var i = 0; i < 9; i++) {
        let mark = mark_at(px + vec2(i % 3, i / 3) - 1);
        marks |= select(0u, mark, abs(dot(tangent_of(mark), tangent)) > ALONG);
    }
    return marks;
}

// Whether the first is an edge, and the second none or farther from the pixel's center.
fn is_nearer(first: Spine, second: Spine) -> bool {
    return first.class_of != NO_EDGE
        && (second.class_of == NO_EDGE || dot(first.offset, first.offset) < dot(second.offset, second.offset));
}

struct Out {
    @location(0) edge: vec4<u32>,
    @location(1) spine: u32,
    // Of this layer and all nearer ones.
    @location(2) seen: u32,
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> Out {
    let px = vec2<i32>(position.xy);
    let x = unpack_surfel(geometry_at(px));
    let surface_ids = surface_ids_at(px);
    let own = surface_ids.own;
    // Where the near plane cuts, there is no edge.
    if !x.enhanced || x.depth < 1.5 * frame.near_clip_depth {
        discard;
    }
    if edge_styles[style_of(x.object)].mode != EXACT_MODE {
        discard;
    }
    let plane = plane_of(px, x.depth, x.face_direction);
    let right = between(px, x, own, plane, vec2(1, 0), surface_ids.right);
    let left = between(px, x, own, plane, vec2(-1, 0), surface_ids.left);
    let below = between(px, x, own, plane, vec2(0, 1), surface_ids.below);
    let above = between(px, x, own, plane, vec2(0, -1), surface_ids.above);
    // The line nearest to the center; between two neighbors it runs aslant.
    var spine = right;
    if is_nearer(left, spine) {
        spine = left;
    }
    var other = below;
    if is_nearer(above, other) {
        other = above;
    }
    if spine.class_of == NO_EDGE {
        spine = other;
    } else if other.class_of == spine.class_of && spine.class_of != INTERSECTION {
        let corner = spine.offset + other.offset;
        spine = Spine(spine.class_of, 0.5 * corner, normalize(vec2(corner.y, -corner.x)), spine.ends_object);
    } else if is_nearer(other, spine) {
        spine = other;
    }
    // An edge near a segment is the segment's. A crease that is not drawn explains what is inside its object, but not where another
    // one ends.
    let marks = marks_along(px, spine.tangent);
    let is_explained = (marks & EXPLAINED) != 0u && !spine.ends_object;
    if spine.class_of == NO_EDGE || (marks & DRAWN) != 0u || is_explained {
        discard;
    }
    // Where two surfaces meet, both have this depth; elsewhere a line is only as near as its surface is found. A plane that is seen
    // edge on may be anywhere beside its pixel.
    let meeting = depth_of(nearness_at(plane, spine.offset));
    let meets = spine.class_of == INTERSECTION && abs(meeting - x.depth) < 0.5 * x.depth;
    let depth = select(x.depth, meeting, meets);
    let pos_view = pos_view_of(px, x.depth);
    let normal = vec2(spine.tangent.y, -spine.tangent.x);
    // Without a neighbor along the line nobody knows how long it is: dashes count along its direction.
    let arc = dot(vec2<f32>(px) + 0.5 + spine.offset, spine.tangent);
    let texel = pack_edge(Edge(
        spine.class_of,
        x.object,
        spine.offset,
        pack_tangent(spine.tangent),
        select(-1.0, 1.0, dot(normal, spine.offset) >= 0.0),
        0.5,
        depth,
        half_width(x.object, spine.class_of, pos_view, x.normal),
        arc / edge_styles[style_of(x.object)].dash_period,
        select(0.0, 1.0, edge_styles[style_of(x.object)].lines[spine.class_of - 1u].opacity > 0.0),
    ));
    let rank = select(0.0, 1.0, spine.class_of <= OBJECT);
    let lines = nearer_lines_at(nearer_lines_tex, px, spine_of(texel, halves_of(x.object, spine.class_of), rank, 1.0 - range_share(x.depth)));
    return Out(texel, lines.own, lines.now);
}
