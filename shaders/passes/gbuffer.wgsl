// Every visible object into the G-buffer, in one traversal (edge-enhancement paper, section 4.1.1).
#import common/frame.wgsl
#import common/octahedral.wgsl
#import common/surface_id.wgsl
#import common/material.wgsl
#import common/instance.wgsl
#import common/color.wgsl

// Whether what lies behind a plane is left out: that of a mirror, that of the section, or either.
override WITH_CLIP_PLANE: bool = false;
// Whether vertices are moved along their normals, so that there are values around objects too (sketchy drawings paper, section
// 4.2).
override ENLARGED: bool = false;

// What draws with images have beside their instance.
@group(2) @binding(0) var base_tex: texture_2d<f32>;
@group(2) @binding(1) var base_sampler: sampler;
@group(2) @binding(2) var normal_tex: texture_2d<f32>;
@group(2) @binding(3) var normal_sampler: sampler;
@group(3) @binding(0) var<uniform> material: Material;

// Each location takes software devices time for every triangle: values share one where that saves another.

struct Lean {
    @builtin(position) @invariant position: vec4<f32>,
    // View-oriented, but about the object's own origin, so that derivatives keep their digits far from the eye; and linear depth.
    @location(0) pos_oriented_depth: vec4<f32>,
    // Surface, object, order of its first surface, color (see `Instance`).
    @location(1) @interpolate(flat, first) ids: vec4<u32>,
    // How far it lies in front of the planes of `WITH_CLIP_PLANE`.
    @location(2) before_planes: vec2<f32>,
}

struct Smooth {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) pos_oriented_depth: vec4<f32>,
    @location(1) @interpolate(flat, first) ids: vec4<u32>,
    // 0 where faces are flat.
    @location(2) normal: vec3<f32>,
    @location(3) before_planes: vec2<f32>,
}

// From here on colors are interpolated; they are linear.

struct Colored {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) pos_oriented_depth: vec4<f32>,
    @location(1) @interpolate(flat, first) ids: vec4<u32>,
    @location(2) normal: vec3<f32>,
    @location(3) color: vec3<f32>,
    @location(4) before_planes: vec2<f32>,
}

struct Full {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) pos_oriented_depth: vec4<f32>,
    @location(1) @interpolate(flat, first) ids: vec4<u32>,
    @location(2) normal: vec3<f32>,
    @location(3) color: vec4<f32>,
    @location(4) tangent: vec4<f32>,
    @location(5) uv_before: vec4<f32>,
}

struct GBuffer {
    @location(0) geometry: vec4<u32>,
    // With the sRGB curve already: software devices apply it more slowly than shaders.
    @location(1) base_color: vec4<f32>,
    @location(2) surface_id: u32,
}

fn before_planes(pos_view: vec4<f32>) -> vec2<f32> {
    let before = vec2(dot(frame.clip_plane, pos_view), dot(frame.section, pos_view));
    return select(vec2(0.0), before, WITH_CLIP_PLANE);
}

fn pos_oriented_depth(pos_view: vec4<f32>, local: mat4x4<f32>) -> vec4<f32> {
    return vec4(pos_view.xyz - local[3].xyz, -pos_view.z);
}

fn ids(instance: Instance, surface: u32) -> vec4<u32> {
    return vec4(surface, instance.ids.xyz);
}

fn normal_view(instance: Instance, normal: vec2<f32>) -> vec3<f32> {
    return normal_from_local(instance) * octahedral_decode(normal);
}

// A vertex where it is drawn.
fn placed(instance: Instance, pos_view: vec4<f32>, normal: vec3<f32>) -> vec4<f32> {
    if !ENLARGED {
        return pos_view;
    }
    let far = length(normal);
    return pos_view + vec4(normal * select(0.0, instance.enlarged * pixel_at(-pos_view.z) / far, far > 0.0), 0.0);
}

@vertex
fn vs_lean(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(1) surface: u32,
) -> Lean {
    let local = view_from_local(instance);
    let pos_view = local * vec4(position, 1.0);
    return Lean(
        frame.clip_from_view * pos_view, pos_oriented_depth(pos_view, local), ids(instance, surface), before_planes(pos_view),
    );
}

@vertex
fn vs_smooth(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(1) surface: u32,
    @location(2) normal: vec2<f32>,
) -> Smooth {
    let local = view_from_local(instance);
    let normal_view = normal_view(instance, normal);
    let pos_view = placed(instance, local * vec4(position, 1.0), normal_view);
    return Smooth(
        frame.clip_from_view * pos_view, pos_oriented_depth(pos_view, local), ids(instance, surface),
        normal_view, before_planes(pos_view),
    );
}

@vertex
fn vs_colored(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(1) surface: u32,
    @location(2) normal: vec2<f32>,
    @location(5) color: vec4<f32>,
) -> Colored {
    let local = view_from_local(instance);
    let normal_view = normal_view(instance, normal);
    let pos_view = placed(instance, local * vec4(position, 1.0), normal_view);
    return Colored(
        frame.clip_from_view * pos_view, pos_oriented_depth(pos_view, local), ids(instance, surface),
        normal_view, instance.base_color.rgb * color.rgb, before_planes(pos_view),
    );
}

@vertex
fn vs_full(
    instance: Instance,
    @location(0) position: vec3<f32>,
    @location(1) surface: u32,
    @location(2) normal: vec2<f32>,
    @location(3) tangent: vec4<f32>,
    @location(4) uv: vec2<f32>,
    @location(5) color: vec4<f32>,
) -> Full {
    let local = view_from_local(instance);
    let normal_view = normal_view(instance, normal);
    let pos_view = placed(instance, local * vec4(position, 1.0), normal_view);
    let tangent_view = (local * vec4(octahedral_decode(tangent.xy), 0.0)).xyz;
    return Full(
        frame.clip_from_view * pos_view, pos_oriented_depth(pos_view, local), ids(instance, surface),
        normal_view, color,
        vec4(tangent_view, sign(tangent.z)), vec4(uv, before_planes(pos_view)),
    );
}

// The geometric normal of the triangle, of any length, turned towards the eye whatever its winding.
fn face_normal(pos_oriented: vec3<f32>) -> vec3<f32> {
    // Screen y runs down, so this order makes the normal of a surface that faces the eye positive in z.
    let n = cross(dpdy(pos_oriented), dpdx(pos_oriented));
    return select(vec3(0.0, 0.0, 1.0), n, any(abs(n) > vec3(1e-36)));
}

// A pixel in texture space.
struct Footprint {
    uv: vec2<f32>,
    dx: vec2<f32>,
    dy: vec2<f32>,
}

fn transformed(f: Footprint, m: mat3x3<f32>) -> Footprint {
    return Footprint((m * vec3(f.uv, 1.0)).xy, (m * vec3(f.dx, 0.0)).xy, (m * vec3(f.dy, 0.0)).xy);
}

// Normals of any length.
fn pack(normal: vec3<f32>, face: vec3<f32>, depth: f32, object: u32) -> vec4<u32> {
    return vec4(
        pack2x16snorm(octahedral_encode(normal)),
        pack2x16snorm(octahedral_encode(face)),
        bitcast<u32>(depth),
        object,
    );
}

fn is_clipped_off(before_planes: vec2<f32>) -> bool {
    return WITH_CLIP_PLANE && min(before_planes.x, before_planes.y) < 0.0;
}

fn surface_id(ids: vec4<u32>) -> u32 {
    return surface_id_of(ids.y, ids.x);
}

// What lies equally deep is ordered as it is drawn: by its draw, then by its surface, of which the triangles are drawn in
// order (`by_surface` in src/gpu/geometry.rs). So coplanar objects are neither lost nor repeated.
fn order_of(ids: vec4<u32>) -> u32 {
    return ids.z + ids.x;
}

fn lean(v: Lean) -> GBuffer {
    let face = face_normal(v.pos_oriented_depth.xyz);
    if is_clipped_off(v.before_planes) {
        discard;
    }
    let geometry = pack(face, face, v.pos_oriented_depth.w, v.ids.y);
    return GBuffer(geometry, unpack4x8unorm(v.ids.w), surface_id(v.ids));
}

// Seen from behind, a surface is shaded as if it were two-sided.
fn turned_to(face: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return select(normal, -normal, dot(normal, face) < 0.0);
}

@fragment
fn fs_lean(v: Lean) -> GBuffer {
    return lean(v);
}

// The shading normal of a surface without images, of any length.
fn shading_normal(face: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return select(turned_to(face, normal), face, all(normal == vec3(0.0)));
}

fn smooth_surface(v: Smooth) -> GBuffer {
    let face = face_normal(v.pos_oriented_depth.xyz);
    if is_clipped_off(v.before_planes) {
        discard;
    }
    let geometry = pack(shading_normal(face, v.normal), face, v.pos_oriented_depth.w, v.ids.y);
    return GBuffer(geometry, unpack4x8unorm(v.ids.w), surface_id(v.ids));
}

@fragment
fn fs_smooth(v: Smooth) -> GBuffer {
    return smooth_surface(v);
}

fn colored(v: Colored) -> GBuffer {
    let face = face_normal(v.pos_oriented_depth.xyz);
    if is_clipped_off(v.before_planes) {
        discard;
    }
    let geometry = pack(shading_normal(face, v.normal), face, v.pos_oriented_depth.w, v.ids.y);
    return GBuffer(geometry, vec4(srgb_from_linear(v.color), 1.0), surface_id(v.ids));
}

@fragment
fn fs_colored(v: Colored) -> GBuffer {
    return colored(v);
}

fn full(v: Full) -> GBuffer {
    let face = face_normal(v.pos_oriented_depth.xyz);
    // Derivatives of the varying itself: loads from buffers are undefined in the helper lanes of a pixel quad.
    let uv = Footprint(v.uv_before.xy, dpdx(v.uv_before.xy), dpdy(v.uv_before.xy));
    let base = transformed(uv, material.base_uv);
    let color = textureSampleGrad(base_tex, base_sampler, base.uv, base.dx, base.dy) * material.base_color * v.color;
    let fine = transformed(uv, material.normal_uv);
    let bump = textureSampleGrad(normal_tex, normal_sampler, fine.uv, fine.dx, fine.dy).xyz * 2.0 - 1.0;
    if color.a < material.alpha_cutoff || is_clipped_off(v.uv_before.zw) {
        discard;
    }
    var normal = face;
    if any(v.normal != vec3(0.0)) {
        normal = normalize(v.normal);
        if material.has_normal_texture == 1u && v.tangent.w != 0.0 {
            let tangent = normalize(v.tangent.xyz - normal * dot(normal, v.tangent.xyz));
            let bitangent = cross(normal, tangent) * sign(v.tangent.w);
            let scale = material.normal_scale;
            normal = mat3x3(tangent, bitangent, normal) * (bump * vec3(scale, scale, 1.0));
        }
        normal = turned_to(face, normal);
    }
    let base_color = vec4(srgb_from_linear(color.rgb), select(1.0, color.a, material.blends == 1u));
    return GBuffer(pack(normal, face, v.pos_oriented_depth.w, v.ids.y), base_color, surface_id(v.ids));
}

@fragment
fn fs_full(v: Full) -> GBuffer {
    return full(v);
}
