// Leaves out the lines of a layer that a nearer layer has at the same place (blueprints paper, section 4.1, Fig. 5).
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/edge_map.wgsl

// Whether any edges have spines, and whether any are the papers' operators', which have none.
override WITH_EXACT: bool = true;
override WITH_PAPER: bool = false;

@group(1) @binding(0) var edge_map_tex: texture_2d<u32>;
@group(1) @binding(1) var spine_tex: texture_2d<u32>;
// The spines of all nearer layers.
@group(1) @binding(2) var seen_tex: texture_2d<u32>;

// Closer than this, px, two spines are one.
const SAME: f32 = 1.0;
// Stands for the ink of an operator: no radius, the middle of the pixel.
const INKED: u32 = 0x7f7fu;

fn offset_in(spine: u32) -> vec2<f32> {
    return vec2(f32((spine >> 8u) & 255u), f32(spine & 255u)) / 127.0 - 1.0;
}

fn own_at(px: vec2<i32>) -> u32 {
    var own = 0u;
    if WITH_EXACT {
        own = textureLoad(spine_tex, px, 0).x;
    }
    if WITH_PAPER && own == 0u {
        own = select(0u, INKED, class_of(textureLoad(edge_map_tex, px, 0)) == PAPER);
    }
    return own;
}

// Adds the lines of this layer to those that have been seen, and marks where they are.
@fragment
fn fs_seen(@builtin(position) position: vec4<f32>) -> @location(0) u32 {
    let own = own_at(vec2<i32>(position.xy));
    if own == 0u {
        discard;
    }
    return own;
}

// The spines of this layer that no nearer one has.
@fragment
fn fs_own(@builtin(position) position: vec4<f32>) -> @location(0) u32 {
    let px = vec2<i32>(position.xy);
    let own = textureLoad(spine_tex, px, 0).x;
    let last = vec2<i32>(frame.size) - 1;
    var nearest = 1e9;
    for (var i = 0; i < 9; i++) {
        let q = clamp(px + vec2(i % 3, i / 3) - 1, vec2(0), last);
        let other = textureLoad(seen_tex, q, 0).x;
        let apart = vec2<f32>(q - px) + offset_in(other) - offset_in(own);
        nearest = select(nearest, min(nearest, dot(apart, apart)), other != 0u);
    }
    return select(own, 0u, nearest < SAME * SAME);
}
