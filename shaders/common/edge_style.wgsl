// How the edges of an object are found and drawn. Twin: `EdgeUniform` in src/render/passes/edge_map.rs.
struct EdgeStyle {
    profile_color: vec3<f32>,
    profile_strength: f32,
    inner_color: vec3<f32>,
    inner_strength: f32,
    // Ink per unit of 1 − I_Z, of C1, of 1 − I_N.
    gain_z: f32,
    gain_c1: f32,
    gain_n: f32,
    profile_threshold: f32,
    inner_threshold: f32,
    // 1: the C1 operator finds profile edges, otherwise the diagonal one.
    use_c1: u32,
}
