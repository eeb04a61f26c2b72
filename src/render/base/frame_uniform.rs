//! Bind group 0: camera, lights and paper.

use encase::ShaderType;
use glam::{DMat4, DVec3, Mat4, Vec2, Vec3, Vec4};

use super::lights::{Lights, MAX_LIGHTS, WorldLight};
use super::sample::Sample;
use super::view::View;
use crate::scene::LightKind;

/// Twin of `Light` in `shaders/common/frame.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct LightUniform {
    vector: Vec4,
    color: Vec3,
    shadow: u32,
}

/// Twin of `Frame` in `shaders/common/frame.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct FrameUniform {
    clip_from_view: Mat4,
    world_from_view: Mat4,
    size: Vec2,
    view_per_px: Vec2,
    view_at_corner: Vec2,
    px_per_view: f32,
    depth_range: Vec2,
    jitter: Vec2,
    coverage_ramp: f32,
    sample_weight: f32,
    orthographic: u32,
    light_count: u32,
    center_depth: f32,
    near_clip_depth: f32,
    clip_plane: Vec4,
    section: Vec4,
    shadow_density: f32,
    background: Vec4,
    lights: [LightUniform; MAX_LIGHTS],
}

impl FrameUniform {
    /// All that the shaders know of camera, lights and paper. `background`: linear color and opacity.
    pub fn new(view: &View, sample: Sample, depth_range: Vec2, lights: &Lights, background: Vec4) -> Self {
        let [clip_plane, section] = view.clip_planes();
        let view_per_px = Vec2::new(2.0, -2.0) * view.half_extent / view.size.as_vec2();
        let mut uniforms = [LightUniform::default(); MAX_LIGHTS];
        for (uniform, light) in uniforms.iter_mut().zip(&lights.lights) {
            *uniform = light_uniform(light, &view.view_from_world);
        }
        // Without any light the first one stands for the key that some techniques cannot do without.
        if lights.lights.is_empty() {
            uniforms[0].vector = Vec4::new(0.0, 0.0, 1.0, 0.0);
        }
        Self {
            clip_from_view: view.clip_from_view,
            // About the middle, so that digits are not lost far from the origin.
            world_from_view: (DMat4::from_translation(-view.center) * view.view_from_world.inverse())
                .as_mat4(),
            size: view.size.as_vec2(),
            view_per_px,
            view_at_corner: view.half_extent * Vec2::new(-1.0, 1.0) - view.jitter * view_per_px,
            px_per_view: view_per_px.x.recip(),
            depth_range,
            jitter: view.jitter,
            coverage_ramp: sample.coverage_ramp(),
            sample_weight: sample.weight(),
            orthographic: u32::from(view.orthographic),
            light_count: lights.lights.len().min(MAX_LIGHTS) as u32,
            center_depth: -view.view_from_world.transform_point3(view.center).z as f32,
            near_clip_depth: if view.near_plane_clips { view.clip_range[0] as f32 } else { 0.0 },
            clip_plane: clip_plane.as_vec4(),
            section: section.as_vec4(),
            shadow_density: lights.density,
            background,
            lights: uniforms,
        }
    }

    /// Linear depth of the nearest and farthest point of the enhanced objects.
    pub fn depth_range(&self) -> Vec2 {
        self.depth_range
    }

    /// The same with the paper left out: what shading depends on.
    #[must_use]
    pub fn without_background(&self) -> Self {
        Self { background: Vec4::ZERO, ..*self }
    }
}

fn light_uniform(light: &WorldLight, view_from_world: &DMat4) -> LightUniform {
    let vector = match light.kind {
        LightKind::Directional { direction } => {
            (-view_from_world.transform_vector3(direction)).normalize_or(DVec3::Z).extend(0.0)
        }
        LightKind::Point { position } => view_from_world.transform_point3(position).extend(1.0),
    };
    LightUniform {
        vector: vector.as_vec4(),
        color: light.color,
        shadow: light.shadow.map_or(0, |channel| channel as u32 + 1),
    }
}
