// Records in a texture; twin: src/gpu/record_texture.rs.
fn texel_of_record(index: u32) -> vec2<u32> {
    return vec2(index % 2048u, index / 2048u);
}

fn texel_at(records: texture_storage_2d<rgba32uint, read>, index: u32) -> vec4<u32> {
    return textureLoad(records, texel_of_record(index));
}

// One of the records of two words, of which a texel holds two.
fn pair_at(records: texture_storage_2d<rgba32uint, read>, index: u32) -> vec2<u32> {
    let both = texel_at(records, index / 2u);
    return select(both.xy, both.zw, index % 2u == 1u);
}
