// How many pixels a layer covers, and whether peeling goes on (blueprints paper, section 4.2): occlusion queries would count
// overdraw, and only the processor could act on them.
#import common/frame.wgsl
#import common/counted.wgsl

// 0 where the layer has nothing.
@group(1) @binding(0) var order_tex: texture_2d<u32>;
@group(1) @binding(1) var<storage, read_write> peeled: Counted;
// Arguments of the draws and dispatches that stop with it.
@group(1) @binding(2) var<storage, read_write> gate: array<u32>;

var<workgroup> covered: atomic<u32>;

@compute @workgroup_size(16, 16)
fn cs_count(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_index) index: u32,
) {
    if all(id.xy < vec2<u32>(frame.size)) && textureLoad(order_tex, id.xy, 0).x != 0u {
        atomicAdd(&covered, 1u);
    }
    workgroupBarrier();
    if index == 0u {
        atomicAdd(&peeled.covered, atomicLoad(&covered));
    }
}

@compute @workgroup_size(64)
fn cs_decide(@builtin(local_invocation_index) index: u32) {
    let ends = peeled.has_ended == 1u || atomicLoad(&peeled.covered) < peeled.least;
    // All have read before one of them writes.
    storageBarrier();
    if ends {
        for (var i = index; i < arrayLength(&gate); i += 64u) {
            gate[i] = 0u;
        }
    }
    if index != 0u || peeled.has_ended == 1u {
        return;
    }
    peeled.pixels[peeled.layers] = atomicExchange(&peeled.covered, 0u);
    if ends {
        peeled.has_ended = 1u;
    } else {
        peeled.layers += 1u;
    }
}
