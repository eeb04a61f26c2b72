// Whether a surface goes on under a segment.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import passes/segments/beside.wgsl

// Cosine of the angle between normals of one smooth surface.
const SMOOTH: f32 = 0.96;
// The same of both sides of a fold that only the triangles of a smooth surface have, the most of it that may face the eye, and
// how far across the surface its sides may lie apart, in lengths of its edge.
const FOLDED: f32 = 0.8;
const GRAZING: f32 = 0.5;
const LIFTED: f32 = 0.08;

// Whether one smooth surface goes on under a spine, whatever topology thinks: at a seam that could not be mended, at needles
// that are turned over, and where triangles fold to and fro around the contour of the surface that they stand for. The sides of
// such a fold are seen aslant, agree in their normals and lie in one tangent plane, as far as triangles of that size can tell;
// those of a contour do so only at its very end.
fn goes_on_under(spine: Spine, own: u32, edge_length: f32) -> bool {
    var one_px = texel_beside(spine, PLACES[0]);
    var other_px = texel_beside(spine, PLACES[4]);
    if textureLoad(surface_id_tex, one_px).x != textureLoad(surface_id_tex, other_px).x {
        // Right beside an outline one of them lies beyond it.
        one_px = texel_beside(spine, PLACES[1]);
        other_px = texel_beside(spine, PLACES[3]);
    }
    let surface_id = textureLoad(surface_id_tex, one_px).x;
    let one = unpack_surfel(textureLoad(geometry_tex, one_px));
    let other = unpack_surfel(textureLoad(geometry_tex, other_px));
    // Where a layer has nothing, its surface id and its geometry are 0.
    let alike = dot(one.normal, other.normal);
    let is_same = surface_id != 0u && surface_id == textureLoad(surface_id_tex, other_px).x
        && one.object == own && other.object == own && alike > FOLDED;
    if !is_same {
        return false;
    }
    let one_at = pos_view_of(one_px, one.depth);
    let towards = towards_eye(one_at);
    let facing = max(dot(one.normal, towards), dot(other.normal, towards));
    let across = dot(one_at - pos_view_of(other_px, other.depth), normalize(one.normal + other.normal));
    if facing < GRAZING && abs(across) < LIFTED * edge_length {
        return true;
    }
    if alike < SMOOTH {
        return false;
    }
    // Both sides meet at the spine.
    let here = plane_of(one_px, one.depth, one.face_direction);
    let there = plane_of(other_px, other.depth, other.face_direction);
    let at_spine = spine.at - 0.5;
    let gap = nearness_at(here, at_spine - vec2<f32>(one_px)) - nearness_at(there, at_spine - vec2<f32>(other_px));
    var greatest = abs(step_px(gap, one.depth));
    // Nothing may open between them, such as a narrow window.
    for (var i = 1; i < 4; i++) {
        let px = texel_beside(spine, PLACES[i]);
        let between = unpack_surfel(textureLoad(geometry_tex, px));
        let miss = min(
            abs(nearness_at(here, vec2<f32>(px - one_px)) - nearness_of(between.depth)),
            abs(nearness_at(there, vec2<f32>(px - other_px)) - nearness_of(between.depth)),
        );
        let is_there = between.object == own && textureLoad(surface_id_tex, px).x != 0u;
        greatest = max(greatest, select(1e9, step_px(miss, one.depth), is_there));
    }
    return greatest < SLACK;
}
