// What strokes draw at a pixel.
struct Inks {
    // Of each direction, shares of ink; where only one is drawn all of it is in x, and where details are shown these are.
    shares: vec3<f32>,
    // Whether the first light does not reach it.
    is_in_shadow: bool,
}

fn packed_inks(inks: Inks) -> u32 {
    let steps = vec3<u32>(round(clamp(inks.shares, vec3(0.0), vec3(1.0)) * 1023.0));
    return steps.x | (steps.y << 10u) | (steps.z << 20u) | select(0u, 1u << 30u, inks.is_in_shadow);
}

fn unpacked_inks(packed: u32) -> Inks {
    let shares = vec3<f32>(vec3(packed, packed >> 10u, packed >> 20u) & vec3(1023u)) / 1023.0;
    return Inks(shares, (packed >> 30u) == 1u);
}
