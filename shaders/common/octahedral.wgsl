// Unit vectors in two numbers (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors").

// Of vectors of any length.
fn octahedral_encode(v: vec3<f32>) -> vec2<f32> {
    let p = v.xy * (1.0 / (abs(v.x) + abs(v.y) + abs(v.z)));
    let folded = (1.0 - abs(p.yx)) * select(vec2(-1.0), vec2(1.0), p >= vec2(0.0));
    return select(folded, p, v.z >= 0.0);
}

fn octahedral_decode(p: vec2<f32>) -> vec3<f32> {
    return normalize(octahedral_direction(p));
}

// The same of any length, which saves a square root and a division.
fn octahedral_direction(p: vec2<f32>) -> vec3<f32> {
    let z = 1.0 - abs(p.x) - abs(p.y);
    let fold = max(-z, 0.0);
    return vec3(p + select(vec2(fold), vec2(-fold), p >= vec2(0.0)), z);
}
