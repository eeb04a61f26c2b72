// How far peeling has come. Twin: `Peeled` in src/render/passes/peel.rs.

struct Peeled {
    // A layer with fewer pixels ends it.
    least: u32,
    // So does a layer that leaves this share of the depth mask uncovered, 0 to 1.
    fraction: f32,
    // What ended it.
    end: u32,
    // Layers so far.
    layers: u32,
    // Pixels of the depth mask, and those of them behind opaque surfaces.
    masked: u32,
    hidden: u32,
    // Pixels of the layer that is counted, and of the mask that pass the depth test against it.
    covered: u32,
    uncovered: u32,
    // The same of each layer.
    pixels: array<u32, 64>,
    passed: array<u32, 64>,
}

// Values of `end`.
const GOES_ON: u32 = 0u;
const TOO_FEW_PIXELS: u32 = 1u;
const MASK_UNCOVERED: u32 = 2u;
