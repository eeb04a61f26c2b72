// Mirrors: the drawing from the eye's mirror image over the mirror's own surface (edge-enhancement paper, section 5).
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl

// Twin: `MirrorUniform` in src/render/effects/mirror.rs.
struct Mirror {
    // Linear.
    tint: vec3<f32>,
    reflectivity: f32,
    fresnel: f32,
    object: u32,
}

// Linear color times opacity, and opacity; flipped left to right.
var reflection_tex: texture_2d<f32>;
var<uniform> mirror: Mirror;

// Schlick 1994, weighed by a style.
fn opacity_of(cosine: f32) -> f32 {
    let slant = 1.0 - clamp(cosine, 0.0, 1.0);
    return mirror.reflectivity + (1.0 - mirror.reflectivity) * mirror.fresnel * pow(slant, 5.0);
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let s = unpack_surfel(geometry_at(px));
    if s.object != mirror.object {
        discard;
    }
    let across = vec2(i32(frame.size.x) - 1 - px.x, px.y);
    let seen = textureLoad(reflection_tex, across, 0);
    // Where nothing is seen in it, a mirror shows the paper.
    let reflection = (seen.rgb + (1.0 - seen.a) * frame.background.rgb) * mirror.tint;
    let opacity = opacity_of(dot(s.face_normal, towards_eye(pos_view_of(px, s.depth))));
    return vec4(reflection * opacity, opacity);
}
