// How an object is hatched, as the renderer says.

// Twin: `GpuStroke` in src/render/effects/hatching/strokes.rs. Lengths in px, widths as shares of the spacing.
struct Stroke {
    @align(16) spacing: f32,
    min_width: f32,
    max_width: f32,
    // A stroke ends where it would be narrower, px.
    end_width: f32,
    length: f32,
    taper: f32,
    gap: f32,
    tone_by_count: f32,
    randomness: f32,
    pointedness: f32,
    late_insertion: f32,
    insertion_spread: f32,
    variation: f32,
    // 1 where strokes are ink or paper, 0 where they have soft rims.
    crispness: f32,
    // Which of the tables says what tone to ask for.
    table: u32,
}

// Twin: `GpuIndication` in src/render/effects/hatching/indication.rs; parameters in src/style/indication.rs.
struct Indication {
    @align(16) amount: f32,
    // 1: by the fields of the paper; 0: by the nearest line.
    by_fields: u32,
    // px.
    distance: f32,
    falloff: f32,
    attraction: f32,
    patch_share: f32,
    patch_offset: f32,
    patch_slope: f32,
    patch_power: f32,
    silhouette_share: f32,
    // px.
    radius: f32,
    step: f32,
    alpha: f32,
    beta: f32,
    lambda: f32,
    silhouette_offset: f32,
    silhouette_slope: f32,
    silhouette_power: f32,
}

// As in src/render/effects/hatching.rs; 0: no hatching.
const STRIPES: u32 = 1u;
const IN_IMAGE_SPACE: u32 = 2u;
const BY_UV: u32 = 3u;

// Twin: `GpuHatchingStyle` in src/render/effects/hatching.rs.
struct HatchingStyle {
    // To local space of the object's mesh.
    local_from_view: mat4x4<f32>,
    // Linear colors, and shares of the object's own.
    ink: vec3<f32>,
    ink_tint: f32,
    paper: vec3<f32>,
    paper_tint: f32,
    stroke: Stroke,
    // Darkness from which on more directions cross, and the greatest share of ink of one of them.
    second: f32,
    third: f32,
    greatest: f32,
    directions: u32,
    shadows_cross: u32,
    ambient: f32,
    object_tone: f32,
    white: f32,
    darkest: f32,
    mapping: u32,
    // Of its stripes.
    frequency: f32,
    first_triangle: u32,
    // The grid on which its vertices lie, local space.
    grid_step: f32,
    grid_origin: vec3<f32>,
    // Strokes of tonal art maps: side of a tile, px; which set; steps in which strokes turn, radians; whether two steps are blended;
    // whether strokes run towards the light.
    tile: f32,
    strokes: u32,
    // In shadow: which set, how far it is turned (radians), and whether strokes differ there.
    strokes_in_shadow: u32,
    turn_in_shadow: f32,
    shadows_differ: u32,
    turn_step: f32,
    blends_steps: u32,
    // Whether tones of tiles are blended, or strokes come one by one.
    blends_tones: u32,
    towards_light: u32,
    // Strokes that are left out away from edges.
    indication: Indication,
    // 1: the detail that indication gives is drawn instead of strokes.
    shows_detail: u32,
    // Where the tiles of this object begin, in tiles, so that its strokes end at its borders; 0: those of other objects go on.
    tile_offset: vec2<f32>,
    // `CURVE` samples of the tone curve.
    curve: array<vec4<f32>, 9>,
}

var<storage, read> hatching_styles: array<HatchingStyle>;
// See passes/triangle_map.wgsl, and passes/coordinates.wgsl for objects with strokes by texture coordinates.
var triangle_map_tex: texture_storage_2d<rgba32uint, read>;

// Whether strokes lie on the surface at a pixel, in up to three directions; otherwise they lie on the paper, in one.
fn lie_on_surface(object: u32, texel: vec4<u32>) -> bool {
    let mapping = hatching_styles[object].mapping;
    return (mapping == STRIPES && texel.x != 0u) || (mapping == BY_UV && any(texel != vec4(0u)));
}
