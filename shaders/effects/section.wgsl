// The caps of a section over the shaded surfaces: their own color, and hatching.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/cap.wgsl

var surface_id_tex: texture_2d<u32>;
// By object id.
var<storage, read> caps: array<Cap>;

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let cap = caps[unpack_surfel(geometry_at(px)).object];
    if cap.surface_id == 0u || textureLoad(surface_id_tex, px, 0).x != cap.surface_id {
        discard;
    }
    let ink = hatched_share(cap, px);
    let fill = select(1.0 - ink, 0.0, cap.lit == 1u);
    return vec4(cap.ink * ink + cap.fill * fill, ink + fill);
}
