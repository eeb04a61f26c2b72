// Records in a texture; twin: src/gpu/record_texture.rs.
fn texel_at(records: texture_2d<u32>, index: u32) -> vec4<u32> {
    return textureLoad(records, vec2(index % 2048u, index / 2048u), 0);
}
