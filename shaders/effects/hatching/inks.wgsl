// What is hatched at each pixel, before it is: which surface, and what each direction of strokes draws there. Strokes look along
// themselves where they end.
#import common/fullscreen.wgsl
#import effects/hatching/packed_inks.wgsl
#import effects/hatching/tone.wgsl

override SHOWS_DETAIL: bool = false;

var base_color_tex: texture_2d<f32>;
var surface_id_tex: texture_2d<u32>;

fn inks_of(px: vec2<i32>, s: Surfel) -> Inks {
    let object = s.object;
    let texel = textureLoad(triangle_map_tex, px);
    if SHOWS_DETAIL && hatching_styles[object].shows_detail == 1u {
        return Inks(vec3(detail_at(px, texel, s), 0.0, 0.0), false);
    }
    let base = textureLoad(base_color_tex, px, 0).rgb;
    let dark = indicated_dark_at(px, texel, s, base, pos_view_of(px, s.depth));
    return Inks(select(vec3(dark.all, 0.0, 0.0), split(object, dark), lie_on_surface(object, texel)), dark.is_in_shadow);
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec2<u32> {
    let px = vec2<i32>(position.xy);
    let s = unpack_surfel(geometry_at(px));
    if s.object == 0u || hatching_styles[s.object].mapping == 0u {
        return vec2(0u);
    }
    return vec2(textureLoad(surface_id_tex, px, 0).x, packed_inks(inks_of(px, s)));
}
