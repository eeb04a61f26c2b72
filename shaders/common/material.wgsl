// Materials. Twin: `MaterialUniform` in src/gpu/material.rs.

struct Material {
    base_color: vec4<f32>,
    base_uv: mat3x3<f32>,
    normal_uv: mat3x3<f32>,
    normal_scale: f32,
    // Pixels with less alpha are holes; negative: none are.
    alpha_cutoff: f32,
    has_normal_texture: u32,
    // 1: alpha is opacity.
    blends: u32,
}
