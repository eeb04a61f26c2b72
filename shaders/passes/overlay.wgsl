// One picture over another.
#import common/fullscreen.wgsl
#import common/placed.wgsl

// Linear color times opacity, and opacity.
var overlay_tex: texture_2d<f32>;
// Ink; see common/placed.wgsl.
var ink_tex: texture_storage_2d<rgba32uint, read>;

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(overlay_tex, vec2<i32>(position.xy), 0);
}

@fragment
fn fs_ink(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return placed_color(textureLoad(ink_tex, vec2<i32>(position.xy)));
}
