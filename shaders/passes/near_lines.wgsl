// Whether any thin line can reach a block of 4 by 4 pixels: software devices shade whole ones.
#import common/frame.wgsl
#import gpu/neighbors.wgsl

var spine_tex: texture_2d<u32>;
var near_tex: texture_storage_2d<r32uint, write>;

// Whether lines reach two pixels far.
override NARROW_BY_TWO: bool = false;

@compute @workgroup_size(16, 16)
fn cs_main(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = vec2<i32>(id.xy);
    let last = vec2<i32>(frame.size) - 1;
    if any(4 * block > last) {
        return;
    }
    var any_spine = 0u;
    let first = select(-1, -2, NARROW_BY_TWO);
    for (var y = first; y <= 4; y += 2) {
        for (var x = first; x <= 4; x += 2) {
            any_spine |= any_of(four_at(spine_tex, 4 * block + vec2(x, y)));
        }
    }
    textureStore(near_tex, block, vec4(any_spine, 0u, 0u, 0u));
}
