// Hatching: tones by strokes of a pen (Bu et al. 2006, "Image-based Real-time Hatching of Scene Traveling").
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/light.wgsl
#import common/surface_change.wgsl
#import effects/hatching/indication.wgsl
#import effects/hatching/strokes.wgsl
#import effects/hatching/tonal_art_map.wgsl

const HATCHING: u32 = 7u;

// Whether any object is drawn in this way, and how strokes lie on any.
override WITH_HATCHING: bool = true;
override WITH_STRIPES: bool = true;
override WITH_IMAGE_SPACE_STROKES: bool = true;
override WITH_BLENDED_TONES: bool = true;
override WITH_STROKES_ONE_BY_ONE: bool = true;
override WITH_STROKES_BY_UV: bool = true;
override WITH_INDICATION: bool = false;
override SHOWS_DETAIL: bool = false;
override WITH_SECOND: bool = true;
override WITH_THIRD: bool = true;

// As in src/render/effects/hatching.rs; 0: no hatching.
const STRIPES: u32 = 1u;
const IN_IMAGE_SPACE: u32 = 2u;
const BY_UV: u32 = 3u;

// Twin: `GpuHatchingStyle` in src/render/effects/hatching.rs.
struct HatchingStyle {
    // To local space of the object's mesh.
    local_from_view: mat4x4<f32>,
    // Linear colors, and shares of the object's own.
    ink: vec3<f32>,
    ink_tint: f32,
    paper: vec3<f32>,
    paper_tint: f32,
    stroke: Stroke,
    // Darkness from which on more directions cross, and the greatest share of ink of one of them.
    second: f32,
    third: f32,
    greatest: f32,
    directions: u32,
    shadows_cross: u32,
    ambient: f32,
    object_tone: f32,
    white: f32,
    darkest: f32,
    mapping: u32,
    // Of its stripes.
    frequency: f32,
    first_triangle: u32,
    // The grid on which its vertices lie, local space.
    grid_step: f32,
    grid_origin: vec3<f32>,
    // Strokes of tonal art maps: side of a tile, px; which set; steps in which strokes turn, radians; whether two steps are blended;
    // whether strokes run towards the light.
    tile: f32,
    strokes: u32,
    // In shadow: which set, how far it is turned (radians), and whether strokes differ there.
    strokes_in_shadow: u32,
    turn_in_shadow: f32,
    shadows_differ: u32,
    turn_step: f32,
    blends_steps: u32,
    // Whether tones of tiles are blended, or strokes come one by one.
    blends_tones: u32,
    towards_light: u32,
    // Strokes that are left out away from edges.
    indication: Indication,
    // 1: the detail that indication gives is drawn instead of strokes.
    shows_detail: u32,
    // Where the tiles of this object begin, in tiles, so that its strokes end at its borders; 0: those of other objects go on.
    tile_offset: vec2<f32>,
    // `CURVE` samples of the tone curve.
    curve: array<vec4<f32>, 9>,
}

var<storage, read> hatching_styles: array<HatchingStyle>;
// See passes/triangle_map.wgsl, and passes/coordinates.wgsl for objects with strokes by texture coordinates.
var triangle_map_tex: texture_storage_2d<rgba32uint, read>;

// As in src/render/effects/hatching.rs.
const CURVE: u32 = 33u;

fn tone_sample(object: u32, number: u32) -> f32 {
    return hatching_styles[object].curve[number / 4u][number % 4u];
}

fn luminance_of(linear: vec3<f32>) -> f32 {
    return dot(linear, vec3(0.2126, 0.7152, 0.0722));
}

// Share of ink that a light asks for.
fn darkness(object: u32, light: f32) -> f32 {
    // As bright as it looks, not as it measures.
    let place = pow(clamp(light, 0.0, 1.0), 1.0 / 2.2) * f32(CURVE - 1u);
    let first = min(u32(place), CURVE - 2u);
    let tone = mix(tone_sample(object, first), tone_sample(object, first + 1u), place - f32(first));
    let white = hatching_styles[object].white;
    return clamp((1.0 - tone - white) / max(1.0 - white, 1e-3), 0.0, 1.0) * hatching_styles[object].darkest;
}

// How dark a point is, and how dark it would be without shadows that are thrown on it.
struct Dark {
    all: f32,
    form: f32,
    // Whether the first light does not reach it.
    is_in_shadow: bool,
}

fn dark_at(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> Dark {
    let object = s.object;
    var lit = vec3(hatching_styles[object].ambient);
    var form = lit;
    var first = 0.0;
    for (var i = 0u; i < frame.light_count; i++) {
        let l = towards_light(frame.lights[i], pos_view);
        let light = frame.lights[i].color * max(dot(s.normal, l), 0.0);
        form += light;
        let reaches = visibility(px, i);
        lit += light * reaches;
        if i == 0u {
            first = reaches * dot(s.normal, l);
        }
    }
    let own = mix(1.0, luminance_of(base), hatching_styles[object].object_tone);
    let all = darkness(object, luminance_of(lit) * own);
    return Dark(all, min(darkness(object, luminance_of(form) * own), all), first < 0.02);
}

// What each direction draws, so that all of them over each other leave as much paper as is wanted.
fn split(object: u32, dark: Dark) -> vec3<f32> {
    let second = hatching_styles[object].second;
    let third = hatching_styles[object].third;
    let greatest = hatching_styles[object].greatest;
    let directions = hatching_styles[object].directions;
    if directions <= 1u {
        return vec3(min(dark.all, greatest), 0.0, 0.0);
    }
    let crosses = hatching_styles[object].shadows_cross == 1u && dark.form < dark.all;
    let own = select(dark.all, dark.form, crosses);
    let first = min(select(own, second + 0.35 * (own - second), own > second), greatest);
    // What is left to the others.
    let rest = 1.0 - (1.0 - dark.all) / max(1.0 - first, 1e-3);
    let first_there = min(second + 0.35 * max(third - second, 0.0), greatest);
    let limit = select(max(1.0 - (1.0 - third) / max(1.0 - first_there, 1e-3), 0.0), 0.5, crosses);
    var next = rest;
    if directions >= 3u && rest > limit {
        next = limit + 0.35 * (rest - limit);
    }
    next = clamp(next, 0.0, greatest);
    let last = 1.0 - (1.0 - rest) / max(1.0 - next, 1e-3);
    return vec3(first, next, select(0.0, clamp(last, 0.0, greatest), directions >= 3u));
}

// The stripes of the triangle that a pixel shows.
fn stripes_seen(object: u32, texel: vec4<u32>, s: Surfel, pos_view: vec3<f32>) -> Stripes {
    let m = hatching_styles[object].local_from_view;
    let linear = mat3x3(m[0].xyz, m[1].xyz, m[2].xyz);
    let per_px = 2.0 * frame.half_extent / frame.size;
    let dx = linear * pos_change(pos_view, s.face_normal, vec3(per_px.x, 0.0, 0.0));
    let dy = linear * pos_change(pos_view, s.face_normal, vec3(0.0, -per_px.y, 0.0));
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

fn laid_at(object: u32, dark: Dark) -> Laid {
    if hatching_styles[object].shadows_differ == 1u && dark.is_in_shadow {
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

// How much detail a pixel gets, 0 to 1.
fn detail_at(px: vec2<i32>, texel: vec4<u32>, s: Surfel) -> f32 {
    let object = s.object;
    let indication = hatching_styles[object].indication;
    if indication.by_fields == 1u {
        var part = 0u;
        if hatching_styles[object].frequency > 0.0 && texel.x != 0u && hatching_styles[object].mapping != BY_UV {
            part = texel_at(stripe_triangles, hatching_styles[object].first_triangle + texel.x - 1u).w;
        }
        let w1 = patch_field(part, bitcast<vec3<f32>>(texel.yzw), indication);
        let w2 = silhouette_field(px, s, indication);
        return clamp(indication.patch_share * w1 + indication.silhouette_share * w2, 0.0, 1.0);
    }
    // A layer without lines has nothing that strokes could be near to.
    if textureDimensions(nearest_edge_tex).x <= 1u {
        return 1.0;
    }
    let found = textureLoad(nearest_edge_tex, px).x;
    let edge = vec2<i32>(vec2((found - 1u) & 0xffffu, (found - 1u) >> 16u));
    // No farther has been looked.
    let most = 8.0 * indication.distance;
    let away = select(distance(vec2<f32>(edge), vec2<f32>(px)), most, found == 0u);
    // The line may be that of an object which attracts details, and is not hatched itself.
    let owner = unpack_surfel(geometry_at(edge)).object;
    let attraction = select(indication.attraction, hatching_styles[owner].indication.attraction, found != 0u && hatching_styles[owner].mapping != 0u);
    return line_field(indication, attraction, min(away, most));
}

// Darkness with fewer strokes where there is little detail; darks keep theirs.
fn indicated(object: u32, detail: f32, dark: f32) -> f32 {
    return dark * (1.0 - hatching_styles[object].indication.amount * (1.0 - detail) * (1.0 - smoothstep(0.45, 0.8, dark)));
}

fn hatching(px: vec2<i32>, s: Surfel, base: vec3<f32>, pos_view: vec3<f32>) -> vec3<f32> {
    let object = s.object;
    var dark = dark_at(px, s, base, pos_view);
    let texel = textureLoad(triangle_map_tex, px);
    var detail = 1.0;
    if WITH_INDICATION && hatching_styles[object].indication.amount > 0.0 {
        detail = detail_at(px, texel, s);
        dark.all = indicated(object, detail, dark.all);
        dark.form = indicated(object, detail, dark.form);
    }
    if SHOWS_DETAIL && hatching_styles[object].shows_detail == 1u {
        return vec3(detail);
    }
    let inks = split(object, dark);
    let mapping = hatching_styles[object].mapping;
    var ink = 0.0;
    if WITH_STRIPES && mapping == STRIPES && texel.x != 0u {
        ink = stripes_ink(px, texel, s, pos_view, inks);
    } else if WITH_STROKES_BY_UV && mapping == BY_UV && any(texel != vec4(0u)) {
        ink = strokes_by_uv(texel, object, inks, laid_at(object, dark));
    } else if WITH_IMAGE_SPACE_STROKES {
        ink = strokes_in_image_space(px, texel, s, pos_view, dark.all, laid_at(object, dark));
    }
    let paper = hatching_styles[object].paper * mix(vec3(1.0), base, hatching_styles[object].paper_tint);
    let stroke = mix(hatching_styles[object].ink, base, hatching_styles[object].ink_tint);
    return mix(paper, stroke, ink);
}
