// What layers and their lines must know of the depth mask (blueprints paper, section 4.3).
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/ordered.wgsl

// As in common/depth_mask.wgsl, but for counting.
struct Counted {
    pixels: atomic<u32>,
    hidden: atomic<u32>,
    farthest: atomic<u32>,
}

// The designated objects are `geometry_tex`; these are all that is opaque.
var surface_tex: texture_storage_2d<rgba32uint, read>;
var<storage, read_write> mask: Counted;

var<workgroup> pixels: atomic<u32>;
var<workgroup> hidden: atomic<u32>;
var<workgroup> farthest: atomic<u32>;

@compute @workgroup_size(16, 16)
fn cs_main(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_index) index: u32,
) {
    if all(id.xy < vec2<u32>(frame.size)) {
        let px = vec2<i32>(id.xy);
        let designated = unpack_surfel(geometry_at(px));
        if designated.object != 0u {
            atomicAdd(&pixels, 1u);
            let front = unpack_surfel(textureLoad(surface_tex, px));
            atomicAdd(&hidden, select(0u, 1u, front.object != 0u && front.depth < designated.depth));
            atomicMax(&farthest, ordered(designated.depth));
        }
    }
    workgroupBarrier();
    if index == 0u && atomicLoad(&pixels) != 0u {
        atomicAdd(&mask.pixels, atomicLoad(&pixels));
        atomicAdd(&mask.hidden, atomicLoad(&hidden));
        atomicMax(&mask.farthest, atomicLoad(&farthest));
    }
}
