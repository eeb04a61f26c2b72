// The mean of a picture's samples, with one more.
#import common/frame.wgsl
#import common/fullscreen.wgsl

var mean_tex: texture_2d<f32>;
var color_tex: texture_2d<f32>;

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let mean = textureLoad(mean_tex, px, 0);
    // Where all samples are equal, exactly that comes out.
    return mean + (textureLoad(color_tex, px, 0) - mean) * frame.sample_weight;
}
