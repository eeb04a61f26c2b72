// Whether neighboring pixels show one surface.
#import common/gbuffer.wgsl
#import common/plane.wgsl

var surface_id_tex: texture_2d<u32>;

// A step in depth of so many pixels' widths parts a surface from itself.
const DEPTH_STEP: f32 = 2.0;

// Whether a surface goes on from one pixel to a near one: the same surface of the same object, and one of the two
// predicts the other's depth.
fn goes_on(px: vec2<i32>, s: Surfel, other_px: vec2<i32>, other: Surfel) -> bool {
    if other.object != s.object
        || textureLoad(surface_id_tex, px, 0).x != textureLoad(surface_id_tex, other_px, 0).x {
        return false;
    }
    let offset = vec2<f32>(other_px - px);
    let here = plane_of(px, s.depth, s.face_direction);
    let there = plane_of(other_px, other.depth, other.face_direction);
    let miss = min(
        abs(there.center - nearness_at(here, offset)),
        abs(here.center - nearness_at(there, -offset)),
    );
    return step_px(miss, min(s.depth, other.depth)) < DEPTH_STEP;
}
