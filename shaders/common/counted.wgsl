// How far layers have come, while it is being counted. Twin: `Peeled` in src/render/passes/peel.rs.

// As in common/peeled.wgsl, but for what several invocations count.
struct Counted {
    least: u32,
    has_ended: u32,
    layers: u32,
    covered: atomic<u32>,
    fragments: atomic<u32>,
    pixels: array<u32, 64>,
}
