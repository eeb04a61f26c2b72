// A depth layer of a blueprint as a depth sprite: lines over a fill, tested against the surfaces that are opaque (blueprints
// paper, section 4.2).
#import passes/lines.wgsl
#import common/composition.wgsl
#import common/depth_mask.wgsl
#import common/ordered.wgsl
#import common/layer_count.wgsl
#import common/cap.wgsl

// Twin: `BlueprintUniform` in src/render/effects/blueprint.rs.
struct Blueprint {
    // Linear colors.
    far: vec3<f32>,
    by_layer: f32,
    fill: vec3<f32>,
    opacity: f32,
    by_distance: f32,
    // Ink below it is left out, and all other is full, `WITH_THRESHOLD`.
    threshold: f32,
}

var<uniform> blueprint: Blueprint;
var<uniform> layer_count: LayerCount;
// Where nearer layers have lines; see passes/repeated.wgsl.
var nearer_lines_tex: texture_2d<u32>;
var<storage, read> mask: Masked;

// The surface ids of the layer, and caps of a section, which lie here by object id.
var surface_id_tex: texture_storage_2d<r32uint, read>;
var<storage, read> caps: array<Cap>;

// Whether any object has a cap.
override WITH_CAPS: bool = false;
// Whether what lies farther than the depth mask is left out.
override WITHOUT_BEYOND: bool = false;
// Whether ink below a threshold is left out.
override WITH_THRESHOLD: bool = true;
// Whether ink of the papers' operators is left out where nearer layers have some.
override WITHOUT_REPEATED: bool = false;

// The share of the far color.
fn faded(depth: f32) -> f32 {
    let range = frame.depth_range;
    let distance = clamp((depth - range.x) / max(range.y - range.x, 1e-20), 0.0, 1.0);
    let before = f32(layer_count.layers) - 1.0;
    // A power of 0 is undefined.
    let left = pow(max(1.0 - blueprint.by_layer, 1e-6), before) * (1.0 - blueprint.by_distance * distance);
    return 1.0 - left;
}

// Whether a depth is left out: the mask hides what lies behind it at its own pixels, and farther than all of it nothing is
// drawn anywhere.
fn is_beyond(depth: f32) -> bool {
    return WITHOUT_BEYOND && mask.pixels != 0u && depth > unordered(mask.farthest);
}

// Lines reach over the interior of their layer and beyond it: their depth is that of their spine.
fn ink_of(px: vec2<i32>, line: Line) -> vec4<f32> {
    if WITH_OPERATORS && WITHOUT_REPEATED && textureLoad(nearer_lines_tex, px, 0).x != 0u {
        return vec4(0.0);
    }
    if is_beyond(line.depth) {
        return vec4(0.0);
    }
    var ink = line.ink;
    if WITH_THRESHOLD {
        if line.strength < blueprint.threshold {
            return vec4(0.0);
        }
        ink *= min(1.0 / line.strength, 1.0 / max(ink.a, 1e-6));
    }
    let color = vec4(mix(ink.rgb, blueprint.far * ink.a, faded(line.depth)), ink.a);
    return beneath_opaque_ink(px, line.depth, color);
}

@fragment
fn fs_lines(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    return ink_of(px, lines_at(px, surface_at(px)));
}

@fragment
fn fs_lines_placed(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let px = vec2<i32>(position.xy);
    let line = lines_at(px, surface_at(px));
    return pack_placed(ink_of(px, line), line.depth);
}

fn fill_of(px: vec2<i32>, layer: Surfel) -> vec4<f32> {
    let surface = surface_at(px);
    let is_occluded = surface.object != 0u && surface.depth < layer.depth;
    if is_occluded || is_beyond(layer.depth) {
        discard;
    }
    let fill = vec4(blueprint.fill, 1.0) * blueprint.opacity;
    if !WITH_CAPS {
        return beneath_opaque_ink(px, layer.depth, fill);
    }
    let surface_id = textureLoad(surface_id_tex, px).x;
    if caps[layer.object].surface_id == 0u || surface_id != caps[layer.object].surface_id {
        return beneath_opaque_ink(px, layer.depth, fill);
    }
    let cap = caps[layer.object];
    let ink = select(hatched_share(cap, px), 1.0, cap.width <= 0.0);
    let near = edge_styles[style_of(layer.object)].lines[SECTION - 1u].color;
    let hatched = over(vec4(mix(near, blueprint.far, faded(layer.depth)), 1.0) * ink, fill);
    return beneath_opaque_ink(px, layer.depth, hatched);
}

@fragment
fn fs_fill(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    return fill_of(px, unpack_surfel(geometry_at(px)));
}

@fragment
fn fs_fill_placed(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let px = vec2<i32>(position.xy);
    let layer = unpack_surfel(geometry_at(px));
    return pack_placed(fill_of(px, layer), layer.depth);
}
