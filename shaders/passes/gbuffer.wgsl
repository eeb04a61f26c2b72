// Every visible object into the G-buffer, in one traversal (edge-enhancement paper, section 4.1.1).
#import common/frame.wgsl
#import common/octahedral.wgsl
#import common/region.wgsl
#import common/material.wgsl

// One part of one object. Uniform, not an element of a storage array: what is the same for a whole draw is read once
// per draw and not once per vertex. Twin: `DrawUniform` in src/render/passes/gbuffer.rs.
struct Draw {
    view_from_local: mat4x4<f32>,
    // Inverse transpose of its linear part.
    normal_from_local: mat3x3<f32>,
    material: Material,
    // Object id with the enhanced flag as the highest bit.
    object: u32,
    // 1: the mesh has no normals, faces are flat.
    is_flat: u32,
    // Order of its first surface among those of all draws.
    first_surface: u32,
}

// Whether what lies behind a plane is left out: that of a mirror, that of the section, or either.
override WITH_CUT: bool = false;

@group(2) @binding(0) var base_tex: texture_2d<f32>;
@group(2) @binding(1) var base_sampler: sampler;
@group(2) @binding(2) var normal_tex: texture_2d<f32>;
@group(2) @binding(3) var normal_sampler: sampler;

@group(3) @binding(0) var<uniform> draw: Draw;

struct Lean {
    @builtin(position) @invariant position: vec4<f32>,
    // View-oriented, but about the object's own origin, so that derivatives keep their digits far from the eye.
    @location(0) pos_oriented: vec3<f32>,
    @location(1) depth: f32,
    @location(2) @interpolate(flat, first) surface: u32,
}

struct Smooth {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) pos_oriented: vec3<f32>,
    @location(1) depth: f32,
    @location(2) @interpolate(flat, first) surface: u32,
    @location(3) normal: vec3<f32>,
    @location(4) color: vec3<f32>,
}

struct Full {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) pos_oriented: vec3<f32>,
    @location(1) depth: f32,
    @location(2) @interpolate(flat, first) surface: u32,
    @location(3) normal: vec3<f32>,
    @location(4) tangent: vec4<f32>,
    @location(5) uv: vec2<f32>,
    @location(6) color: vec4<f32>,
}

struct GBuffer {
    @location(0) geometry: vec4<u32>,
    @location(1) base_color: vec4<f32>,
    @location(2) region: u32,
}

fn pos_view_of_vertex(position: vec3<f32>) -> vec4<f32> {
    return draw.view_from_local * vec4(position, 1.0);
}

@vertex
fn vs_lean(
    @location(0) position: vec3<f32>,
    @location(1) surface: u32,
) -> Lean {
    let pos_view = pos_view_of_vertex(position);
    let pos_oriented = pos_view.xyz - draw.view_from_local[3].xyz;
    return Lean(frame.clip_from_view * pos_view, pos_oriented, -pos_view.z, surface);
}

@vertex
fn vs_smooth(
    @location(0) position: vec3<f32>,
    @location(1) surface: u32,
    @location(2) normal: vec2<f32>,
    @location(5) color: vec4<f32>,
) -> Smooth {
    let pos_view = pos_view_of_vertex(position);
    let pos_oriented = pos_view.xyz - draw.view_from_local[3].xyz;
    let normal_view = draw.normal_from_local * octahedral_decode(normal);
    return Smooth(
        frame.clip_from_view * pos_view, pos_oriented, -pos_view.z, surface, normal_view, color.rgb,
    );
}

@vertex
fn vs_full(
    @location(0) position: vec3<f32>,
    @location(1) surface: u32,
    @location(2) normal: vec2<f32>,
    @location(3) tangent: vec4<f32>,
    @location(4) uv: vec2<f32>,
    @location(5) color: vec4<f32>,
) -> Full {
    let pos_view = pos_view_of_vertex(position);
    let local = draw.view_from_local;
    let normal_view = draw.normal_from_local * octahedral_decode(normal);
    let tangent_view = (local * vec4(octahedral_decode(tangent.xy), 0.0)).xyz;
    return Full(
        frame.clip_from_view * pos_view, pos_view.xyz - local[3].xyz, -pos_view.z, surface,
        normal_view, vec4(tangent_view, sign(tangent.z)), uv, color,
    );
}

// The geometric normal of the triangle, turned towards the eye whatever its winding.
fn face_normal(pos_oriented: vec3<f32>) -> vec3<f32> {
    // Screen y runs down, so this order makes the normal of a surface that faces the eye positive in z.
    let n = cross(dpdy(pos_oriented), dpdx(pos_oriented));
    let l = length(n);
    return select(vec3(0.0, 0.0, 1.0), n / l, l > 0.0);
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

fn pack(normal: vec3<f32>, face: vec3<f32>, depth: f32, object: u32) -> vec4<u32> {
    return vec4(
        pack2x16snorm(octahedral_encode(normal)),
        pack2x16snorm(octahedral_encode(face)),
        bitcast<u32>(depth),
        object,
    );
}

fn is_cut_off(pos_oriented: vec3<f32>) -> bool {
    let pos_view = vec4(pos_oriented + draw.view_from_local[3].xyz, 1.0);
    return WITH_CUT && min(dot(frame.cut, pos_view), dot(frame.section, pos_view)) < 0.0;
}

fn region(surface: u32) -> u32 {
    return region_of(draw.object, surface);
}

// The opacity of a surface: 1 unless its material blends.
fn opacity(alpha: f32) -> f32 {
    return select(1.0, alpha, draw.material.blends == 1u);
}

fn lean(v: Lean) -> GBuffer {
    let face = face_normal(v.pos_oriented);
    if is_cut_off(v.pos_oriented) {
        discard;
    }
    let color = vec4(draw.material.base_color.rgb, opacity(draw.material.base_color.a));
    return GBuffer(pack(face, face, v.depth, draw.object), color, region(v.surface));
}

// Seen from behind, a surface is shaded as if it were two-sided.
fn turned_to(face: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return select(normal, -normal, dot(normal, face) < 0.0);
}

@fragment
fn fs_lean(v: Lean) -> GBuffer {
    return lean(v);
}

fn smooth_surface(v: Smooth) -> GBuffer {
    let face = face_normal(v.pos_oriented);
    if is_cut_off(v.pos_oriented) {
        discard;
    }
    let color = draw.material.base_color.rgb * v.color;
    let normal = select(turned_to(face, normalize(v.normal)), face, draw.is_flat == 1u);
    return GBuffer(pack(normal, face, v.depth, draw.object), vec4(color, 1.0), region(v.surface));
}

@fragment
fn fs_smooth(v: Smooth) -> GBuffer {
    return smooth_surface(v);
}

fn full(v: Full) -> GBuffer {
    let face = face_normal(v.pos_oriented);
    // Derivatives of the varying itself: loads from buffers are undefined in the helper lanes of a pixel quad.
    let uv = Footprint(v.uv, dpdx(v.uv), dpdy(v.uv));
    let base = transformed(uv, draw.material.base_uv);
    let color = textureSampleGrad(base_tex, base_sampler, base.uv, base.dx, base.dy) * draw.material.base_color * v.color;
    let fine = transformed(uv, draw.material.normal_uv);
    let bump = textureSampleGrad(normal_tex, normal_sampler, fine.uv, fine.dx, fine.dy).xyz * 2.0 - 1.0;
    if color.a < draw.material.alpha_cutoff || is_cut_off(v.pos_oriented) {
        discard;
    }
    var normal = face;
    if draw.is_flat == 0u {
        normal = normalize(v.normal);
        if draw.material.has_normal_texture == 1u && v.tangent.w != 0.0 {
            let tangent = normalize(v.tangent.xyz - normal * dot(normal, v.tangent.xyz));
            let bitangent = cross(normal, tangent) * sign(v.tangent.w);
            let scale = draw.material.normal_scale;
            normal = normalize(mat3x3(tangent, bitangent, normal) * (bump * vec3(scale, scale, 1.0)));
        }
        normal = turned_to(face, normal);
    }
    let base_color = vec4(color.rgb, opacity(color.a));
    return GBuffer(pack(normal, face, v.depth, draw.object), base_color, region(v.surface));
}

@fragment
fn fs_full(v: Full) -> GBuffer {
    return full(v);
}
