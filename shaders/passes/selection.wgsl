// The outline around selected objects, for the window only: transparent elsewhere. Alpha is premultiplied, as the
// window blends it.
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl

// One bit per object id.
var<storage, read> selected: array<u32>;

const ORANGE = vec3(1.0, 0.55, 0.1);

fn is_selected(px: vec2<i32>) -> bool {
    let object = geometry_at(px).w & ~ENHANCED;
    return (selected[object / 32u] >> (object % 32u) & 1u) == 1u;
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let here = is_selected(px);
    var border = false;
    for (var y = -2; y <= 2; y++) {
        for (var x = -2; x <= 2; x++) {
            if x * x + y * y <= 5 && is_selected(px + vec2(x, y)) != here {
                border = true;
            }
        }
    }
    if border && !here {
        return vec4(ORANGE, 1.0);
    }
    if here {
        return vec4(ORANGE, 1.0) * select(0.08, 0.5, border);
    }
    return vec4(0.0);
}
