// What is known of the depth mask. Twin: `Masked` in src/render/passes/depth_mask.rs.

struct Masked {
    // Its pixels, the paper's Q; 0: nothing designated is in the picture.
    pixels: u32,
    // Those of them that opaque surfaces hide, which no layer uncovers.
    hidden: u32,
    // Its greatest linear depth; see common/ordered.wgsl.
    farthest: u32,
}
