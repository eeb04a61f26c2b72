// The frame: bind group 0 of every pass. Twin: `FrameUniform` in src/render/base/frame_uniform.rs.

struct Light {
    // Directional (w = 0): towards the light. Point (w = 1): where it stands. View space.
    vector: vec4<f32>,
    // Linear color times intensity.
    color: vec3<f32>,
    // Its channel in the shadow mask plus 1; 0: it throws no shadow.
    shadow: u32,
}

struct Frame {
    clip_from_view: mat4x4<f32>,
    // World axes about the middle of everything visible.
    world_from_view: mat4x4<f32>,
    // Picture in pixels.
    size: vec2<f32>,
    // View space at depth 1 (perspective) or at any depth (orthographic): the way from a pixel to the next one on the right (x) and
    // below (y), scene units; where the top left corner of the picture lies in this sample; and the inverse of the first.
    view_per_px: vec2<f32>,
    view_at_corner: vec2<f32>,
    px_per_view: f32,
    // Linear depth of the nearest and farthest point of the enhanced objects.
    depth_range: vec2<f32>,
    // How far this sample of the picture is moved, right and down, in pixels.
    jitter: vec2<f32>,
    // Width in pixels of the soft rim of what is covered by a computed share: 1 in a single picture, less the more
    // samples are averaged.
    coverage_ramp: f32,
    // Weight of this sample beside the mean of those before it.
    sample_weight: f32,
    // 1: orthographic.
    orthographic: u32,
    light_count: u32,
    // Depth of that middle.
    center_depth: f32,
    // Depth at which the near plane cuts something; 0: it cuts nothing.
    near_clip_depth: f32,
    // What lies behind this plane, a mirror's, is not drawn; its product with (pos_view, 1) is the distance before it.
    clip_plane: vec4<f32>,
    // The section plane, beyond which nothing is drawn; its product with (pos_view, 1) too is the distance before it. 0: none.
    section: vec4<f32>,
    // How dark shadows are, 0 to 1.
    shadow_density: f32,
    // Paper: linear color and opacity.
    background: vec4<f32>,
    lights: array<Light, 8>,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// The point that a pixel of this linear depth shows, in view space.
fn pos_view_of(px: vec2<i32>, depth: f32) -> vec3<f32> {
    return pos_view_at(vec2<f32>(px) + 0.5, depth);
}

// The same of a place in the picture, px.
fn pos_view_at(at: vec2<f32>, depth: f32) -> vec3<f32> {
    return vec3((at * frame.view_per_px + frame.view_at_corner) * perspective_scale(depth), -depth);
}

// How many times as large a pixel is at this depth as at depth 1.
fn perspective_scale(depth: f32) -> f32 {
    return select(depth, 1.0, frame.orthographic == 1u);
}

// Width of a pixel at a depth, scene units.
fn pixel_at(depth: f32) -> f32 {
    return frame.view_per_px.x * perspective_scale(depth);
}

// Where a depth lies in the range of the enhanced objects: 0 near, 1 far.
fn range_share(depth: f32) -> f32 {
    let range = frame.depth_range;
    return clamp((depth - range.x) / max(range.y - range.x, 1e-20), 0.0, 1.0);
}

// Unit vector from a point in view space towards the eye.
fn towards_eye(pos_view: vec3<f32>) -> vec3<f32> {
    if frame.orthographic == 1u {
        return vec3(0.0, 0.0, 1.0);
    }
    return normalize(-pos_view);
}

// Unit vector from a point in view space towards a light.
fn towards_light(light: Light, pos_view: vec3<f32>) -> vec3<f32> {
    return normalize(light.vector.xyz - pos_view * light.vector.w);
}
