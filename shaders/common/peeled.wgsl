// How far peeling has come. Twin: `Peeled` in src/render/passes/peel.rs.

struct Peeled {
    // A layer with fewer pixels ends it.
    least: u32,
    // 1: it has ended.
    has_ended: u32,
    // Layers so far.
    layers: u32,
    // Pixels of the layer that is counted.
    covered: u32,
    // Fragments of all lists, those for which there was no room included; 0 without lists.
    fragments: u32,
    // Pixels of each layer.
    pixels: array<u32, 64>,
}
