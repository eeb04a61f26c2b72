// What is in front: of two geometries the nearer one at each pixel.
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl

var other_tex: texture_storage_2d<rgba32uint, read>;

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let px = vec2<i32>(position.xy);
    let own = geometry_at(px);
    let other = textureLoad(other_tex, px);
    let has_own = (own.w & ~ENHANCED) != 0u;
    let has_other = (other.w & ~ENHANCED) != 0u;
    let is_other = has_other && (!has_own || bitcast<f32>(other.z) < bitcast<f32>(own.z));
    return select(own, other, is_other);
}
