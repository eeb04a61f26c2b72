// One picture over another.
#import common/fullscreen.wgsl

// Linear colour times opacity, and opacity.
var overlay_tex: texture_2d<f32>;

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(overlay_tex, vec2<i32>(position.xy), 0);
}
