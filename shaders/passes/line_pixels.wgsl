// Lists the pixels in which lines run, which are few.
#import common/frame.wgsl
#import common/pixel_list.wgsl
#import gpu/neighbors.wgsl

// Not 0 where lines run.
var spine_tex: texture_2d<u32>;

// Four pixels at a time. Workgroups as in src/render/passes/line_pixels.rs.
@compute @workgroup_size(16, 16)
fn cs_main(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = 2 * vec2<i32>(id.xy);
    let spines = four_at(spine_tex, first);
    if any_of(spines) == 0u {
        return;
    }
    for (var i = 0; i < 4; i++) {
        let px = first + vec2(i & 1, i >> 1u);
        if spines[i] != 0u && all(px < vec2<i32>(frame.size)) {
            keep(px);
        }
    }
}
