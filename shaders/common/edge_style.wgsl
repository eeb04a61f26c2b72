// How the edges of an object are found and drawn. Twins in src/render/base/edge_style.rs.

struct LineStyle {
    color: vec3<f32>,
    // Opacity, 0 to 1; 0: not drawn.
    opacity: f32,
    // px of this picture.
    width: f32,
    // What an edge must reach to be drawn: step in depth in widths of a pixel there (silhouettes, borders, objects), difference
    // of colors (textures), or angle in radians (all others).
    threshold: f32,
    // 1: dashed.
    dashed: u32,
}

struct EdgeStyle {
    // By class.
    lines: array<LineStyle, 11>,
    // 0: none, 1: exact, 2: the papers' operators.
    mode: u32,
    // Where the width of profile edges goes: 0 both sides, 1 outwards, 2 inwards.
    alignment: u32,
    // px of this picture.
    dash_period: f32,
    // Share of the period that has ink.
    dash_share: f32,
    // Share of the surface's own color in the lines, and how far it is darkened.
    object_color: f32,
    darken: f32,
    // How far the strength of creases is weighed by their angle.
    by_angle: f32,
    // Thinner far away, on the lit side, by hand pressure: 0 to 1 each.
    by_distance: f32,
    by_light: f32,
    pressure: f32,
    // Scale of the pressure's noise, px of this picture.
    pressure_scale: f32,
    // The papers' operators: ink per unit of 1 − I_Z, of C1, of 1 − I_N.
    gain_z: f32,
    gain_c1: f32,
    gain_n: f32,
    profile_threshold: f32,
    inner_threshold: f32,
    profile_color: vec3<f32>,
    profile_opacity: f32,
    inner_color: vec3<f32>,
    inner_opacity: f32,
    // What finds edges in image-space mode.
    found_by: u32,
    // Of Sobel operators: 1 where the sign of normals makes silhouettes; gradients that make an edge (0: not looked at);
    // 1: the gradient is the sum of the changes across and down, 0: the length of both.
    by_sign: u32,
    normal_gradient: f32,
    depth_gradient: f32,
    color_gradient: f32,
    sums_changes: u32,
    // Shorter pieces of lines that nothing continues are left out, px of this picture.
    min_length: f32,
}

// Of four objects, the numbers of their styles. Twin: `GpuStyleNumbers` in src/render/base/edge_styles.rs.
struct StyleNumbers {
    numbers: vec4<u32>,
}

// Each once, at its number; number 0 draws nothing. Single fields are read, never whole structs, which software devices would copy.
var<storage, read> edge_styles: array<EdgeStyle>;
var<storage, read> style_numbers: array<StyleNumbers>;

// The number of an object's style.
fn style_of(object: u32) -> u32 {
    return style_numbers[object / 4u].numbers[object % 4u];
}

const EXACT_MODE: u32 = 1u;
const IMAGE_SPACE: u32 = 2u;

const C1_OPERATOR: u32 = 1u;
const SOBEL_OPERATOR: u32 = 2u;
