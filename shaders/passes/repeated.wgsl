// The ink of the papers' operators has no spines: where it is counts as lines that have been seen.
#import common/fullscreen.wgsl
#import common/edge_map.wgsl

var edge_map_tex: texture_storage_2d<rgba32uint, read>;
var spine_tex: texture_2d<u32>;

// Stands for the ink of an operator: no radius, the middle of the pixel.
const INKED: u32 = 0x7f7fu;

@fragment
fn fs_ink(@builtin(position) position: vec4<f32>) -> @location(0) u32 {
    let px = vec2<i32>(position.xy);
    if class_of(textureLoad(edge_map_tex, px)) != OPERATOR_INK || textureLoad(spine_tex, px, 0).x != 0u {
        discard;
    }
    return INKED;
}
