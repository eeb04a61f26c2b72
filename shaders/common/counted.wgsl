// How far layers have come, while it is being counted. Twin: `GpuCounted` in src/render/passes/count.rs.

// What ends it. As in src/render/passes/count.rs.
const TOO_FEW_PIXELS: u32 = 0u;
const UNCOVERED: u32 = 1u;
const MAX_LAYERS_REACHED: u32 = 2u;

struct Counted {
    // A layer with fewer pixels ends it.
    min_pixels: u32,
    // 1: it has ended.
    has_ended: u32,
    // Layers so far.
    layers: u32,
    // Pixels of the layer that is counted, and of the depth mask that pass the depth test against it.
    covered: atomic<u32>,
    uncovered: atomic<u32>,
    // A layer that leaves this share of the depth mask uncovered, 0 to 1, ends it too.
    fraction: f32,
    // So many layers end it where no depth mask is in the picture.
    max_layers: u32,
    // What has ended it.
    ended_by: u32,
    // Pixels of the depth mask, and those of them behind opaque surfaces.
    masked: u32,
    hidden: u32,
    // Of the lists of each part of the picture, see passes/fragment_lists.wgsl; 0 without lists.
    fragments: array<atomic<u32>, 64>,
    // Of each layer: its pixels, and those of the mask that pass.
    pixels: array<u32, 64>,
    passed: array<u32, 64>,
}
