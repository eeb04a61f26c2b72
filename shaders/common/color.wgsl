// The sRGB curve (IEC 61966-2-1).

// Its power is fitted by roots, which take software devices less time: off by at most 0.01 of a step of 8 bits.
fn srgb_from_linear(linear: vec3<f32>) -> vec3<f32> {
    let c = clamp(linear, vec3(0.0), vec3(1.0));
    let root = sqrt(c);
    let fourth = sqrt(root);
    let power = root * (1.12268737 - 0.33550744 * fourth) + 0.19613353 * fourth + 0.08133212 * c - 0.06461121;
    return select(power, c * 12.92, c <= vec3(0.0031308));
}
