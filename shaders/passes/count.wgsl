// How many pixels a layer covers, how much of the depth mask it leaves uncovered, and whether layers go on (blueprints
// paper, sections 4.2 and 4.3): occlusion queries would count overdraw, and only the processor could act on them.
#import common/frame.wgsl
#import common/counted.wgsl
#import gpu/neighbors.wgsl
#import common/depth_mask.wgsl

// Whether there is a depth mask.
override WITH_MASK: bool = false;

// 0 where the layer has nothing.
var surface_id_tex: texture_2d<u32>;
// Depths of the layer and of the mask, reversed.
var layer_depth_tex: texture_depth_2d;
var mask_depth_tex: texture_depth_2d;
var<storage, read_write> layer_count: Counted;
// Arguments of the draws and dispatches that stop with it.
var<storage, read_write> predicate: array<u32>;
var<storage, read> mask: Masked;

var<workgroup> covered: atomic<u32>;
var<workgroup> uncovered: atomic<u32>;

// Whether a pixel of the mask, as a depth sprite, passes the depth test against the layer. Where a layer has nothing, its
// depth is 0, and all pass.
fn is_uncovered(px: vec2<u32>) -> bool {
    let depth = textureLoad(mask_depth_tex, px, 0);
    return depth > 0.0 && depth >= textureLoad(layer_depth_tex, px, 0);
}

// Each invocation counts four squares of four pixels, of a square of 64 by 64.
@compute @workgroup_size(16, 16)
fn cs_count(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_index) index: u32,
) {
    var own = vec2(0u);
    for (var i = 0u; i < 4u; i++) {
        let first = 64u * group.xy + 32u * vec2(i % 2u, i / 2u) + 2u * id.xy;
        var surface_ids = four_at(surface_id_tex, vec2<i32>(first));
        for (var j = 0u; j < 4u; j++) {
            let px = first + vec2(j % 2u, j / 2u);
            let is_in = all(px < vec2<u32>(frame.size));
            own.x += select(0u, 1u, is_in && surface_ids[j] != 0u);
            if WITH_MASK && is_in {
                own.y += select(0u, 1u, is_uncovered(px));
            }
        }
    }
    if own.x != 0u {
        atomicAdd(&covered, own.x);
    }
    if own.y != 0u {
        atomicAdd(&uncovered, own.y);
    }
    workgroupBarrier();
    if index == 0u {
        atomicAdd(&layer_count.covered, atomicLoad(&covered));
        if WITH_MASK {
            atomicAdd(&layer_count.uncovered, atomicLoad(&uncovered));
        }
    }
}

fn disable_predicate(index: u32) {
    for (var i = index; i < arrayLength(&predicate); i += 64u) {
        predicate[i] = 0u;
    }
}

// Before a layer is drawn: too few pixels end layers before it, and enough layers where there is nothing to uncover.
@compute @workgroup_size(64)
fn cs_decide(@builtin(local_invocation_index) index: u32) {
    let had_ended = layer_count.has_ended == 1u;
    let has_few = atomicLoad(&layer_count.covered) < layer_count.min_pixels;
    let has_all = WITH_MASK && mask.pixels == 0u && layer_count.layers >= layer_count.max_layers;
    let ends = had_ended || has_few || has_all;
    // All have read before one of them writes.
    storageBarrier();
    if ends {
        disable_predicate(index);
    }
    if index != 0u || had_ended {
        return;
    }
    layer_count.pixels[layer_count.layers] = atomicExchange(&layer_count.covered, 0u);
    layer_count.passed[layer_count.layers] = atomicExchange(&layer_count.uncovered, 0u);
    if ends {
        layer_count.has_ended = 1u;
        layer_count.ended_by = select(MAX_LAYERS_REACHED, TOO_FEW_PIXELS, has_few);
    } else {
        layer_count.layers += 1u;
    }
}

// After a layer has been drawn: the first one with R >= fraction · Q is the last (Fig. 6). A mask that is not in the picture
// ends nothing.
@compute @workgroup_size(64)
fn cs_uncovered(@builtin(local_invocation_index) index: u32) {
    let went_on = layer_count.has_ended == 0u && layer_count.layers != 0u;
    let passed = f32(layer_count.passed[max(layer_count.layers, 1u) - 1u]);
    let ends = went_on && mask.pixels != 0u && passed >= layer_count.fraction * f32(mask.pixels);
    storageBarrier();
    if ends {
        disable_predicate(index);
    }
    if index == 0u {
        layer_count.masked = mask.pixels;
        layer_count.hidden = mask.hidden;
        if ends {
            layer_count.has_ended = 1u;
            layer_count.ended_by = UNCOVERED;
        }
    }
}
