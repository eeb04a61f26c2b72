// How far layers have come, while it is being counted. Twin: `Peeled` in src/render/passes/peel.rs.

// As in common/peeled.wgsl, but for what several invocations count.
struct Counted {
    least: u32,
    has_ended: u32,
    layers: u32,
    covered: atomic<u32>,
    uncovered: atomic<u32>,
    fraction: f32,
    has_uncovered: u32,
    masked: u32,
    hidden: u32,
    fragments: array<atomic<u32>, 64>,
    pixels: array<u32, 64>,
    passed: array<u32, 64>,
}
