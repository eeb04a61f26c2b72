// Hidden lines of one layer, whatever lies before them.
#import passes/lines.wgsl

// Where nearer layers have lines; see passes/repeated.wgsl.
var nearer_lines_tex: texture_2d<u32>;

// Ink of the papers' operators has no spine of which the repeated ones could have been left out before.
fn is_repeated(px: vec2<i32>) -> bool {
    if class_of(textureLoad(edge_map_tex, px)) != OPERATOR_INK {
        return false;
    }
    let last = vec2<i32>(frame.size) - 1;
    var seen = 0u;
    for (var i = 0; i < 25; i++) {
        seen |= textureLoad(nearer_lines_tex, clamp(px + vec2(i % 5, i / 5) - 2, vec2(0), last), 0).x;
    }
    return seen != 0u;
}

@fragment
fn fs_lines(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    if WITH_OPERATORS && is_repeated(px) {
        return vec4(0.0);
    }
    var nothing: Surfel;
    return lines_at(px, nothing).ink;
}
