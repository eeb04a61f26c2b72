// A color that is placed by depth. x, y: linear color times opacity, and opacity, as halves; z: linear depth (bits of a float); w:
// 1 where the sketch that was placed last is in front; all 0: nothing.

fn pack_placed(color: vec4<f32>, depth: f32) -> vec4<u32> {
    let packed = vec4(pack2x16float(color.rg), pack2x16float(color.ba), bitcast<u32>(depth), 0u);
    return select(packed, vec4(0u), color.a <= 0.0);
}

fn placed_color(texel: vec4<u32>) -> vec4<f32> {
    return vec4(unpack2x16float(texel.x), unpack2x16float(texel.y));
}
