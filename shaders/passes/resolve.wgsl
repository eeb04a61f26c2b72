// The final image: the drawing over the paper, and the sRGB curve, here and nowhere else.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/color.wgsl

// Twin: `ScaleBarUniform` in src/render/base/scale_bar.rs.
struct ScaleBar {
    // Linear color.
    ink: vec4<f32>,
    // Width and height of the mask; from the lower left corner of the picture.
    size: vec2<u32>,
    // Coverage in 255ths, four pixels a word, each row a whole number of words.
    mask: array<u32>,
}

var color_tex: texture_2d<f32>;
var<storage, read> scale_bar: ScaleBar;

override WITH_SCALE_BAR: bool = false;

fn scale_bar_at(px: vec2<u32>) -> vec4<f32> {
    let row = px.y + scale_bar.size.y - u32(frame.size.y);
    if px.x >= scale_bar.size.x || row >= scale_bar.size.y {
        return vec4(0.0);
    }
    let word = scale_bar.mask[row * ((scale_bar.size.x + 3u) / 4u) + px.x / 4u];
    return scale_bar.ink * (f32((word >> (8u * (px.x % 4u))) & 255u) / 255.0);
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    var drawn = textureLoad(color_tex, vec2<i32>(position.xy), 0);
    if WITH_SCALE_BAR {
        let bar = scale_bar_at(vec2<u32>(position.xy));
        drawn = bar + drawn * (1.0 - bar.a);
    }
    let paper = frame.background;
    let alpha = drawn.a + paper.a * (1.0 - drawn.a);
    let color = drawn.rgb + paper.rgb * paper.a * (1.0 - drawn.a);
    // Straight alpha, as PNG has it.
    return vec4(srgb_from_linear(color / max(alpha, 1e-6)), alpha);
}
