// The surface techniques, shaded from the G-buffer.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import effects/gooch.wgsl
#import effects/halftone.wgsl
#import effects/hatching.wgsl
#import effects/matcap.wgsl
#import effects/toon.wgsl

// In the order of `Technique` in src/style/mod.rs, as those of the techniques with files of their own.
const BLANK: u32 = 0u;
const PLAIN: u32 = 1u;
const UNLIT: u32 = 2u;
// Only what is designated among blueprints is a surface.
const BLUEPRINT: u32 = 8u;

// A surface seen edge on has this share of its color as a designated object: it is lit from the eye.
const DESIGNATED_EDGE_ON: f32 = 0.55;

// Whether any object is drawn so.
override WITH_PLAIN: bool = true;
// Whether surfaces are as opaque as their materials.
override WITH_OPACITY: bool = false;

// Twin: `GpuSurfaceStyle` in src/render/effects/surface.rs.
struct SurfaceStyle {
    // Linear color of what stands out among blueprints.
    designated_color: vec3<f32>,
    ambient: f32,
    technique: u32,
}

var base_color_tex: texture_2d<f32>;
var<storage, read> surface_styles: array<SurfaceStyle>;

// Steps of depth by which techniques are told apart. Twin: that in src/render/effects/surface.rs.
const DEPTH_PER_TECHNIQUE: f32 = 1.0 / 64.0;

// Which technique a pixel is drawn in; nothing and paper have depth 0.
@fragment
fn fs_technique(@builtin(position) position: vec4<f32>) -> @builtin(frag_depth) f32 {
    let id = geometry_at(vec2<i32>(position.xy)).w & ~ENHANCED;
    return select(0.0, f32(surface_styles[id].technique) * DEPTH_PER_TECHNIQUE, id != 0u);
}

// Linear color times opacity, and opacity.
@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let texel = geometry_at(px);
    var color = vec4(0.0);
    if (texel.w & ~ENHANCED) != 0u {
        let s = unpack_surfel(texel);
        let technique = surface_styles[s.object].technique;
        if technique != BLANK {
            let base_color = textureLoad(base_color_tex, px, 0);
            let base = base_color.rgb;
            let pos_view = pos_view_of(px, s.depth);
            var shade = base;
            if WITH_GOOCH && technique == GOOCH {
                shade = gooch(px, s, base, pos_view);
            } else if WITH_PLAIN && technique == PLAIN {
                shade = base * (surface_styles[s.object].ambient + light_at(px, s.normal, pos_view));
            } else if WITH_TOON && technique == TOON {
                shade = toon(px, s, base);
            } else if WITH_HALFTONE && technique == HALFTONE {
                shade = halftone(px, s, base, pos_view);
            } else if WITH_MATCAP && technique == MATCAP {
                shade = matcap(px, s, base, pos_view);
            } else if WITH_HATCHING && technique == HATCHING {
                shade = hatching(px, s, base, pos_view);
            } else if technique == BLUEPRINT {
                shade = surface_styles[s.object].designated_color * mix(DESIGNATED_EDGE_ON, 1.0, max(dot(s.normal, towards_eye(pos_view)), 0.0));
            }
            color = vec4(shade, 1.0) * select(1.0, base_color.a, WITH_OPACITY);
        }
    }
    return color;
}
