// Texels around a pixel. Software devices read four at once in half the time that one takes by itself.

// Neither filters nor leaves the texture.
@group(0) @binding(1) var nearest: sampler;

// The texel at `px`, that to its right, that below it and that below to the right. Beyond the border of the texture its texels
// are repeated.
fn four_at(tex: texture_2d<u32>, px: vec2<i32>) -> vec4<u32> {
    return textureGather(0, tex, nearest, vec2<f32>(px + 1) / vec2<f32>(textureDimensions(tex))).wzxy;
}

// The texels around `px` and its own one, row by row.
fn nine_at(tex: texture_2d<u32>, px: vec2<i32>) -> array<u32, 9> {
    let a = four_at(tex, px - 1);
    let b = four_at(tex, px + vec2(0, -1));
    let c = four_at(tex, px + vec2(-1, 0));
    let d = four_at(tex, px);
    return array(a.x, a.y, b.y, a.z, a.w, b.w, c.z, c.w, d.w);
}

fn any_of(four: vec4<u32>) -> u32 {
    return four.x | four.y | four.z | four.w;
}
