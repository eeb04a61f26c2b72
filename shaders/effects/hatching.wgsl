// Hatching: tones by strokes of a pen (Bu et al. 2006, "Image-based Real-time Hatching of Scene Traveling").
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/surface_change.wgsl
#import effects/hatching/packed_inks.wgsl
#import effects/hatching/strokes.wgsl
#import effects/hatching/style.wgsl
#import effects/hatching/tonal_art_map.wgsl

const HATCHING: u32 = 7u;

// Whether any object is drawn in this way, and how strokes lie on any.
override WITH_HATCHING: bool = true;
override WITH_STRIPES: bool = true;
override WITH_IMAGE_SPACE_STROKES: bool = true;
override WITH_BLENDED_TONES: bool = true;
override WITH_STROKES_ONE_BY_ONE: bool = true;
override WITH_STROKES_BY_UV: bool = true;
override SHOWS_DETAIL: bool = false;
override WITH_SECOND: bool = true;
override WITH_THIRD: bool = true;

// The stripes of the triangle that a pixel shows.
fn stripes_seen(object: u32, texel: vec4<u32>, s: Surfel, pos_view: vec3<f32>) -> Stripes {
    let m = hatching_styles[object].local_from_view;
    let linear = mat3x3(m[0].xyz, m[1].xyz, m[2].xyz);
    let dx = linear * pos_change(pos_view, s.face_normal, vec3(frame.view_per_px.x, 0.0, 0.0));
    let dy = linear * pos_change(pos_view, s.face_normal, vec3(0.0, frame.view_per_px.y, 0.0));
    let triangle = hatching_styles[object].first_triangle + texel.x - 1u;
    let grid = Grid(hatching_styles[object].grid_origin, hatching_styles[object].grid_step);
    return stripes_of(triangle, grid, bitcast<vec3<f32>>(texel.yzw), dx, dy, hatching_styles[object].frequency);
}

// Strokes on the surface.
fn stripes_ink(px: vec2<i32>, texel: vec4<u32>, s: Surfel, pos_view: vec3<f32>, inks: vec3<f32>) -> f32 {
    let stripes = stripes_seen(s.object, texel, s, pos_view);
    let stroke = hatching_styles[s.object].stroke;
    var left = 1.0 - stripe_ink(px, stripes, 0u, stroke, inks.x);
    if WITH_SECOND && inks.y > 0.0 {
        left *= 1.0 - stripe_ink(px, stripes, 1u, stroke, inks.y);
    }
    if WITH_THIRD && inks.z > 0.0 {
        left *= 1.0 - stripe_ink(px, stripes, 2u, stroke, inks.z);
    }
    return 1.0 - left;
}

// Direction of strokes in the picture, x to the right and y down: that of the stripes, or across what faces up.
fn direction_seen(texel: vec4<u32>, s: Surfel, pos_view: vec3<f32>) -> vec2<f32> {
    let object = s.object;
    var view = cross(vec3(0.0, 1.0, 0.0), s.normal) + vec3(1e-3, 0.0, 0.0);
    if hatching_styles[object].towards_light == 1u && frame.light_count > 0u {
        let l = towards_light(frame.lights[0], pos_view);
        view = l - s.normal * dot(l, s.normal);
    } else if texel.x != 0u && hatching_styles[object].frequency > 0.0 {
        let stripes = stripes_seen(object, texel, s, pos_view);
        var d = vec3(0.0);
        for (var i = 0u; i < 3u; i++) {
            d += stripes.shares[i] * stripes.signs[i] * stripes.direction[i];
        }
        // So many pixels to the right and down lead as far as the direction does.
        let xx = dot(stripes.dx, stripes.dx);
        let xy = dot(stripes.dx, stripes.dy);
        let yy = dot(stripes.dy, stripes.dy);
        let x = dot(d, stripes.dx);
        let y = dot(d, stripes.dy);
        let area = max(xx * yy - xy * xy, 1e-36);
        return vec2(yy * x - xy * y, xx * y - xy * x) / area;
    }
    return vec2(view.x, -view.y);
}

// Which set of strokes is drawn, and how far it is turned.
struct Laid {
    strokes: u32,
    turn: f32,
}

fn laid_at(object: u32, is_in_shadow: bool) -> Laid {
    if hatching_styles[object].shadows_differ == 1u && is_in_shadow {
        return Laid(hatching_styles[object].strokes_in_shadow, hatching_styles[object].turn_in_shadow);
    }
    return Laid(hatching_styles[object].strokes, 0.0);
}

// Ink at a point of the paper (in tiles), where strokes run at an angle.
fn image_space_ink_at(object: u32, at: vec2<f32>, angle: f32, strokes: u32, ink: f32) -> f32 {
    let lod = max(log2(TILE / hatching_styles[object].tile), 0.0);
    if WITH_BLENDED_TONES && hatching_styles[object].blends_tones == 1u {
        return blended_ink_at(at, angle, strokes, ink, lod);
    }
    if WITH_STROKES_ONE_BY_ONE {
        return ink_by_strokes_at(at, angle, strokes, ink, lod, hatching_styles[object].stroke.crispness);
    }
    return 0.0;
}

// Strokes on the paper, turned as the surface says, in steps: sign(a) · ⌊|a| / T⌋ · T.
fn strokes_in_image_space(px: vec2<i32>, texel: vec4<u32>, s: Surfel, pos_view: vec3<f32>, ink: f32, laid: Laid) -> f32 {
    let object = s.object;
    let direction = direction_seen(texel, s, pos_view);
    // No direction has a front: angles from −90° to 90°.
    let facing = direction * select(1.0, -1.0, direction.x < 0.0);
    let angle = atan2(facing.y, max(facing.x, 1e-12));
    let at = (vec2<f32>(px) + 0.5 - frame.jitter) / hatching_styles[object].tile + hatching_styles[object].tile_offset;
    let strokes = laid.strokes;
    let step = hatching_styles[object].turn_step;
    if step <= 0.0 {
        return image_space_ink_at(object, at, angle + laid.turn, strokes, ink);
    }
    let steps = floor(abs(angle) / step);
    let drawn = image_space_ink_at(object, at, sign(angle) * steps * step + laid.turn, strokes, ink);
    if hatching_styles[object].blends_steps == 0u {
        return drawn;
    }
    let next = image_space_ink_at(object, at, sign(angle) * (steps + 1.0) * step + laid.turn, strokes, ink);
    return mix(drawn, next, abs(angle) / step - steps);
}

// Strokes by texture coordinates.
fn strokes_by_uv(texel: vec4<u32>, object: u32, inks: vec3<f32>, laid: Laid) -> f32 {
    let across = unpack2x16float(texel.z) / 4096.0;
    let down = unpack2x16float(texel.w) / 4096.0;
    // Coordinates that are stretched in one direction are stretched back, in steps of an octave.
    let size_u = length(vec2(across.x, down.x));
    let size_v = length(vec2(across.y, down.y));
    let squeeze = vec2(1.0, exp2(round(log2(max(size_u, 1e-9) / max(size_v, 1e-9)))));
    let uv = bitcast<vec2<f32>>(texel.xy) * squeeze;
    let dx = across * squeeze;
    let dy = down * squeeze;
    // As large as its area, but no strokes are pressed together more than threefold.
    let area = abs(dx.x * dy.y - dx.y * dy.x);
    let pixel = max(sqrt(area), max(length(dx), length(dy)) / 3.0);
    let strokes = laid.strokes;
    let turn = laid.turn;
    let tile = 0.5 * hatching_styles[object].tile;
    let crispness = hatching_styles[object].stroke.crispness;
    var left = 1.0 - uv_ink_of(uv, pixel, tile, strokes, turn, 0u, inks.x, crispness);
    if WITH_SECOND && inks.y > 0.0 {
        left *= 1.0 - uv_ink_of(uv, pixel, tile, strokes, turn, 1u, inks.y, crispness);
    }
    if WITH_THIRD && inks.z > 0.0 {
        left *= 1.0 - uv_ink_of(uv, pixel, tile, strokes, turn, 2u, inks.z, crispness);
    }
    return 1.0 - left;
}

fn hatching(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    let object = s.object;
    let inks = unpacked_inks(textureLoad(inks_tex, px).y);
    if SHOWS_DETAIL && hatching_styles[object].shows_detail == 1u {
        return vec3(inks.shares.x);
    }
    let texel = textureLoad(triangle_map_tex, px);
    let mapping = hatching_styles[object].mapping;
    var ink = 0.0;
    if WITH_STRIPES && mapping == STRIPES && lie_on_surface(object, texel) {
        ink = stripes_ink(px, texel, s, pos_view, inks.shares);
    } else if WITH_STROKES_BY_UV && mapping == BY_UV && lie_on_surface(object, texel) {
        ink = strokes_by_uv(texel, object, inks.shares, laid_at(object, inks.is_in_shadow));
    } else if WITH_IMAGE_SPACE_STROKES {
        ink = strokes_in_image_space(px, texel, s, pos_view, inks.shares.x, laid_at(object, inks.is_in_shadow));
    }
    let paper = hatching_styles[object].paper * mix(vec3(1.0), base, hatching_styles[object].paper_tint);
    let stroke = mix(hatching_styles[object].ink, base, hatching_styles[object].ink_tint);
    return mix(paper, stroke, ink);
}
