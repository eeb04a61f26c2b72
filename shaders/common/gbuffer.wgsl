// Reading the G-buffer.
#import common/octahedral.wgsl

// x: shading normal, y: face normal (octahedral, 2 × 16-bit snorm, view space), z: linear depth (bits of a float),
// w: object id (0: background) with the enhanced flag as the highest bit.
var geometry_tex: texture_storage_2d<rgba32uint, read>;

const ENHANCED: u32 = 0x80000000u;

struct Surfel {
    normal: vec3<f32>,
    face_normal: vec3<f32>,
    // The same of any length: planes need no more.
    face_direction: vec3<f32>,
    // Distance from the eye along the viewing direction.
    depth: f32,
    // 0: background.
    object: u32,
    enhanced: bool,
}

fn geometry_at(px: vec2<i32>) -> vec4<u32> {
    let last = vec2<i32>(textureDimensions(geometry_tex)) - 1;
    return textureLoad(geometry_tex, clamp(px, vec2(0), last));
}

fn unpack_surfel(texel: vec4<u32>) -> Surfel {
    return Surfel(
        octahedral_decode(unpack2x16snorm(texel.x)),
        octahedral_decode(unpack2x16snorm(texel.y)),
        octahedral_direction(unpack2x16snorm(texel.y)),
        bitcast<f32>(texel.z),
        texel.w & ~ENHANCED,
        (texel.w & ENHANCED) != 0u,
    );
}
