// The surface techniques, shaded from the G-buffer.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import effects/toon.wgsl

const BLANK: u32 = 0u;
const PLAIN: u32 = 1u;
const UNLIT: u32 = 2u;
const GOOCH: u32 = 3u;
const TOON: u32 = 4u;

// How far Gooch's shadows go to the cool end, and up to which N·L the form's own shadow reaches.
const SHADE: f32 = 0.7;
const TERMINATOR: f32 = 0.25;

// Which techniques any object uses.
override WITH_PLAIN: bool = true;
override WITH_GOOCH: bool = true;

// Twin: `SurfaceUniform` in src/render/effects/surface.rs.
struct SurfaceStyle {
    cool: vec3<f32>,
    alpha: f32,
    warm: vec3<f32>,
    beta: f32,
    highlight: f32,
    shininess: f32,
    ambient: f32,
    technique: u32,
}

@group(1) @binding(5) var base_color_tex: texture_2d<f32>;
@group(1) @binding(6) var<storage, read> surface_styles: array<SurfaceStyle>;

fn plain(px: vec2<i32>, style: SurfaceStyle, base: vec3<f32>, normal: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    var light = vec3(style.ambient);
    for (var i = 0u; i < frame.light_count; i++) {
        let l = towards_light(frame.lights[i], pos_view);
        light += frame.lights[i].color * max(dot(normal, l), 0.0) * visibility(px, i);
    }
    return base * light;
}

// Gooch et al. 1998: cool + alpha · base to warm + beta · base by (1 + n·l) / 2, and a Phong highlight, with the
// first light as the key.
fn gooch(px: vec2<i32>, style: SurfaceStyle, base: vec3<f32>, normal: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    let l = towards_light(frame.lights[0], pos_view);
    let cool = min(style.cool + style.alpha * base, vec3(1.0));
    let warm = min(style.warm + style.beta * base, vec3(1.0));
    let n_l = dot(normal, l);
    let lit = visibility(px, 0u);
    var warmth = 0.5 + 0.5 * n_l;
    if WITH_SHADOWS {
        // Towards the terminator the form's own shadow begins, softly where the surface is smooth: so that shadows
        // neither end there nor show the facets of the mesh.
        let own = frame.shadow_density * (1.0 - smoothstep(0.0, TERMINATOR, n_l));
        warmth *= 1.0 - SHADE * max(1.0 - lit, own * f32(frame.lights[0].shadow != 0u));
    }
    let shade = mix(cool, warm, warmth);
    let reflected = reflect(-l, normal);
    let gloss = pow(max(dot(reflected, towards_eye(pos_view)), 0.0), style.shininess);
    return mix(shade, vec3(1.0), style.highlight * gloss * lit);
}

// Linear colour times opacity, and opacity.
@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let texel = geometry_at(px);
    var color = vec4(0.0);
    if (texel.w & ~ENHANCED) != 0u {
        let s = unpack_surfel(texel);
        let style = surface_styles[s.object];
        if style.technique != BLANK {
            let base = textureLoad(base_color_tex, px, 0).rgb;
            let pos_view = pos_view_of(px, s.depth);
            var shade = base;
            if WITH_GOOCH && style.technique == GOOCH {
                shade = gooch(px, style, base, s.normal, pos_view);
            } else if WITH_PLAIN && style.technique == PLAIN {
                shade = plain(px, style, base, s.normal, pos_view);
            } else if WITH_TOON && style.technique == TOON {
                shade = toon(px, s, base);
            }
            color = vec4(shade, 1.0);
        }
    }
    return color;
}
