// Noise that follows the picture (sketchy drawings paper, section 3.2): a tile of (turbulence(s, t), turbulence(1 − s, 1 − t)).

// At a place (px), for a pass of lines; `scale`: periods per px. The nearest texel: they are as small as pixels, and between two
// of them noise hardly changes.
fn noise_of_tile(tiles: texture_2d_array<f32>, at: vec2<f32>, number: u32, scale: f32) -> vec2<f32> {
    let place = (at + f32(number) * vec2(91.7, 47.3)) * scale;
    let texel = vec2<i32>(fract(place) * vec2<f32>(textureDimensions(tiles)));
    return textureLoad(tiles, texel, 0, 0).xy;
}
