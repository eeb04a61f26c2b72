// The final image: the drawing over the paper, and the sRGB curve, here and nowhere else.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/color.wgsl

@group(1) @binding(0) var color_tex: texture_2d<f32>;

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let drawn = textureLoad(color_tex, vec2<i32>(position.xy), 0);
    let paper = frame.background;
    let alpha = drawn.a + paper.a * (1.0 - drawn.a);
    let color = drawn.rgb + paper.rgb * paper.a * (1.0 - drawn.a);
    // Straight alpha, as PNG has it.
    return vec4(srgb_from_linear(color / max(alpha, 1e-6)), alpha);
}
