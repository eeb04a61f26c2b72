// Matcap: the color that a picture of a shaded sphere has for the normal (Sloan et al. 2001).
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl

const MATCAP: u32 = 6u;

// Whether any object is drawn in this way.
override WITH_MATCAP: bool = true;

// Twin: `GpuMatcapStyle` in src/render/effects/matcap.rs.
struct MatcapStyle {
    // Share of the object's own color.
    @align(16) object_color: f32,
    shadow: f32,
    // Layer of `spheres`.
    sphere: u32,
}

// By object id.
var<storage, read> matcap_styles: array<MatcapStyle>;
var spheres: texture_2d_array<f32>;
var sphere_sampler: sampler;

fn matcap(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    let style = matcap_styles[s.object];
    // Across the direction to the eye: so that a sphere looks the same wherever it is in the picture.
    let eye = towards_eye(pos_view);
    let right = normalize(vec3(eye.z, 0.0, -eye.x));
    var at = vec2(dot(s.normal, right), -dot(s.normal, cross(eye, right)));
    // Smooth normals may turn a little beyond the rim.
    if dot(s.normal, eye) < 0.0 {
        at = normalize(at);
    }
    let sphere = textureSampleLevel(spheres, sphere_sampler, 0.5 + 0.5 * at, style.sphere, 0.0).rgb;
    var lit = 1.0;
    if WITH_SHADOWS {
        lit -= style.shadow * shadow_at(px, 0u, dot(s.normal, towards_light(frame.lights[0], pos_view)));
    }
    return sphere * mix(vec3(1.0), base, style.object_color) * lit;
}
