// How far layers have come, for those that draw one: the beginning of `Counted` in common/counted.wgsl.

struct LayerCount {
    min_pixels: u32,
    has_ended: u32,
    // That which is drawn included.
    layers: u32,
}
