// The noise that says where lines and colors of a sketch go (sketchy drawings paper, section 4): it is that of a place on the
// object, so that it moves with it. Lines have that of their own place, each as a whole; colors that of their surface, and beyond
// it that of the nearest one. Software devices take their time for noise: lines ask for it where they run, colors for one pixel of
// each block.
#import common/frame.wgsl
#import common/gbuffer.wgsl
#import common/plane.wgsl
#import common/edge_map.wgsl
#import common/pixel_list.wgsl
#import common/next_on_line.wgsl
#import common/noise.wgsl
#import common/noise_tile.wgsl

// Twin: `FieldUniform` in src/render/passes/offset_field.rs.
struct Field {
    // Length of a wave of lines and colors, px.
    line_wave: f32,
    fill_wave: f32,
    // Share of the finer wave.
    detail: f32,
    // What controls the noise.
    control: u32,
    turbulent: u32,
    fill_seed: u32,
    passes: u32,
    pixels_per_reference: f32,
    // Of the passes of lines.
    seeds: array<vec4<u32>, 2>,
    // Periods of the tile per px, for lines that noise of the picture moves.
    tile_scale: f32,
}

// Twin: `GpuFieldObject` in src/render/passes/offset_field.rs.
struct FieldObject {
    // View space to the object's axes about its middle, scene units.
    from_view: mat4x4<f32>,
    seed: u32,
}

// As `Anchor` in src/style/sketch.rs.
const NORMAL: u32 = 2u;
const CURVATURE: u32 = 3u;
const DEPTH: u32 = 4u;

// Pixels per side of a block, as in src/render/passes/offset_field.rs.
const BLOCK: i32 = 4;

// How far a step of the search for the nearest surface goes, blocks: the sum of these.
override STEP_32: bool = false;
override STEP_16: bool = false;
override STEP_8: bool = false;
override STEP_4: bool = false;
override STEP_2: bool = false;
override STEP_1: bool = false;

var<uniform> field: Field;
var<storage, read> field_objects: array<FieldObject>;
// Not 0 where lines run.
var spine_tex: texture_2d<u32>;
// A tile of noise of the picture: (turbulence(s, t), turbulence(1 − s, 1 − t)).
var tiles: texture_2d_array<f32>;
// Noise of the lines at the pixels in which they run, two halves for each pass.
var line_field_tex: texture_storage_2d<rgba32uint, write>;
var more_line_field_tex: texture_storage_2d<rgba32uint, write>;
// Per block, a pixel with a surface (column in the lower 16 bits, row in the upper ones) plus 1; 0: none.
var near_tex: texture_2d<u32>;
var found_tex: texture_storage_2d<r32uint, write>;
// Per block, noise of the colors (two halves), the pixel plus 1 that it is of, the object, and how far away that is, px.
var fill_field_tex: texture_storage_2d<rgba32uint, write>;

// How much noise there is of what controls it: more where it is curved, or far.
fn control_factor(px: vec2<i32>, s: Surfel) -> f32 {
    if field.control == DEPTH {
        return mix(0.35, 1.75, range_share(s.depth));
    }
    if field.control != CURVATURE {
        return 1.0;
    }
    // By how much the normal turns on the way to surfaces around, and how long that is in space.
    let reach = max(i32(round(4.0 * field.pixels_per_reference)), 1);
    let here = pos_view_of(px, s.depth);
    let pixel = pixel_at(s.depth) * field.pixels_per_reference;
    var curvature = 0.0;
    for (var i = 0; i < 4; i++) {
        let step = select(vec2(reach, 0), vec2(0, reach), i % 2 == 1) * select(-1, 1, i < 2);
        let other = unpack_surfel(geometry_at(px + step));
        let away = distance(pos_view_of(px + step, other.depth), here) / pixel;
        let turn = acos(clamp(dot(other.normal, s.normal), -1.0, 1.0));
        let is_same = other.object == s.object && away < 24.0;
        curvature = max(curvature, select(0.0, turn / max(away, 1.0), is_same));
    }
    // A sphere with a radius of 80 reference pixels counts as 1.
    return 0.2 + 1.1 * min(80.0 * curvature, 1.3);
}

// Noise at a place on an object; `foreshortening`: how much longer than on paper it is along itself.
fn noise_at(at: vec3<f32>, normal: vec3<f32>, depth: f32, foreshortening: f32, wave: f32, object: u32, seed: u32) -> vec2<f32> {
    let turbulent = field.turbulent == 1u;
    let own = mixed_bits(seed ^ field_objects[object].seed);
    let from_view = field_objects[object].from_view;
    if field.control == NORMAL {
        let turned = normalize((from_view * vec4(normal, 0.0)).xyz);
        return octave(1.5 * turned + 7.5, own, turbulent);
    }
    let place = (from_view * vec4(at, 1.0)).xyz;
    let length = wave * pixel_at(depth) * foreshortening;
    var noise = waves(place, length, own, turbulent);
    if field.detail > 0.0 {
        noise += field.detail * fine_waves(place, 0.25 * length, own, turbulent);
    }
    return noise;
}

// How much longer than on paper a line is along itself: of walls seen from the side waves would be too short. The side on which it is
// less says so, as on the other one the line may go on as one that is farther off.
fn foreshortening_at(px: vec2<i32>, edge: Edge, spine: vec2<f32>) -> f32 {
    let tangent = unpack_tangent(edge.tangent);
    let here = pos_view_at(spine, edge.depth);
    var least = 1e9;
    for (var side = -1; side <= 1; side += 2) {
        let line = next_on_line(px, edge, spine, tangent, side);
        let other = unpack_edge(textureLoad(edge_map_tex, line.px));
        let there = vec2<f32>(line.px) + 0.5 + other.offset;
        let on_paper = distance(there, spine) * pixel_at(edge.depth);
        let foreshortening = distance(pos_view_at(there, other.depth), here) / max(on_paper, 1e-20);
        least = select(least, min(foreshortening, least), line.is_there);
    }
    // What is farther off than this is another line.
    return select(clamp(least, 1.0, 4.0), 1.0, least > 12.0);
}

// Whether a line runs at one of the listed pixels; others had one that was left out.
fn is_line(px: vec2<i32>) -> bool {
    return textureLoad(spine_tex, px, 0).x != 0u;
}

// Keeps the noise of all passes at a pixel.
fn store(px: vec2<i32>, noise: array<vec2<f32>, 8>) {
    var halves = array<u32, 8>();
    for (var i = 0u; i < field.passes; i++) {
        halves[i] = pack2x16float(noise[i]);
    }
    textureStore(line_field_tex, px, vec4(halves[0], halves[1], halves[2], halves[3]));
    if field.passes > 4u {
        textureStore(more_line_field_tex, px, vec4(halves[4], halves[5], halves[6], halves[7]));
    }
}

// The surface of another object that a line runs along.
struct Neighbor {
    object: u32,
    normal: vec3<f32>,
    // How much of the line's noise is that of the other object, 0 to 1: as much as of its own where they touch.
    share: f32,
}

// Surfaces so far apart, reference pixels, do not touch.
const APART: f32 = 6.0;
// Share of the distance to where a surface was found that counts as apart from it, though in its plane.
const IN_PLANE: f32 = 0.1;

// Where two objects touch it hangs on little which of them draws the line between them: if each had its own noise there, lines were
// torn to pieces that jump. So it is that of both, and less and less of the other one where they part.
fn neighbor_of(px: vec2<i32>, edge: Edge, spine: vec2<f32>) -> Neighbor {
    let pixel = pixel_at(edge.depth) * field.pixels_per_reference;
    let at = pos_view_at(spine, edge.depth);
    // The depth of a line may be that of the pixel's center, which on steep surfaces is another one.
    let own = unpack_surfel(geometry_at(px));
    let depth = depth_of(nearness_at(plane_of(px, own.depth, own.face_direction), edge.offset));
    let on_surface = pos_view_at(spine, select(edge.depth, depth, own.object == edge.object));
    var least = APART;
    var found = Neighbor(0u, vec3(0.0), 0.0);
    for (var i = 0; i < 9; i++) {
        let q = px + vec2(i % 3, i / 3) - 1;
        let s = unpack_surfel(geometry_at(q));
        let there = pos_view_of(q, s.depth);
        let off_plane = min(abs(dot(at - there, s.face_normal)), abs(dot(on_surface - there, s.face_normal)));
        let gap = (off_plane + IN_PLANE * distance(at, there)) / pixel;
        if s.object != 0u && s.object != edge.object && gap < least {
            least = gap;
            found = Neighbor(s.object, s.normal, 0.0);
        }
    }
    // Where they run through each other they touch, however steep their planes are beside it.
    let meets = edge.class_of == INTERSECTION && found.object != 0u;
    found.share = select(1.0 - smoothstep(0.0, APART, least), 1.0, meets);
    return found;
}

@compute @workgroup_size(GROUP)
fn cs_lines(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    if !is_line(px) {
        return;
    }
    let edge = unpack_edge(textureLoad(edge_map_tex, px));
    let spine = vec2<f32>(px) + 0.5 + edge.offset;
    let tangent = unpack_tangent(edge.tangent);
    let inwards = vec2<i32>(floor(spine - 0.8 * vec2(tangent.y, -tangent.x) * edge.outside));
    let s = unpack_surfel(geometry_at(inwards));
    let factor = control_factor(inwards, s);
    let foreshortening = foreshortening_at(px, edge, spine);
    let at = pos_view_at(spine, edge.depth);
    var neighbor = Neighbor(0u, vec3(0.0), 0.0);
    // A valley at the foot of a bulge becomes an intersection where the bulge sinks into what it lies on.
    if is_of_profile(edge.class_of) || edge.class_of == INTERSECTION || edge.class_of == VALLEY {
        neighbor = neighbor_of(px, edge, spine);
    }
    var noise = array<vec2<f32>, 8>();
    for (var i = 0u; i < field.passes; i++) {
        let seed = field.seeds[i / 4u][i % 4u];
        var both = noise_at(at, s.normal, edge.depth, foreshortening, field.line_wave, edge.object, seed);
        if neighbor.share > 0.0 {
            let other = noise_at(at, neighbor.normal, edge.depth, foreshortening, field.line_wave, neighbor.object, seed);
            both = (both + neighbor.share * other) * inverseSqrt(1.0 + neighbor.share * neighbor.share);
        }
        noise[i] = factor * both;
    }
    store(px, noise);
}

// Noise of whatever enlarged surface the pixel of a line shows (sketchy drawings paper, section 4).
@compute @workgroup_size(GROUP)
fn cs_enlarged(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    if !is_line(px) {
        return;
    }
    let s = unpack_surfel(geometry_at(px));
    var noise = array<vec2<f32>, 8>();
    if s.object != 0u {
        let factor = control_factor(px, s);
        let at = pos_view_of(px, s.depth);
        for (var i = 0u; i < field.passes; i++) {
            let seed = field.seeds[i / 4u][i % 4u];
            noise[i] = factor * noise_at(at, s.normal, s.depth, 1.0, field.line_wave, s.object, seed);
        }
    }
    store(px, noise);
}

// Noise of the picture where lines run (sketchy drawings paper, section 3.2).
@compute @workgroup_size(GROUP)
fn cs_screen(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= list.count {
        return;
    }
    let px = unpack_pixel(listed_pixels[id.x]);
    if !is_line(px) {
        return;
    }
    let at = vec2<f32>(px) + 0.5 + offset_of(textureLoad(edge_map_tex, px));
    var noise = array<vec2<f32>, 8>();
    for (var i = 0u; i < field.passes; i++) {
        noise[i] = noise_of_tile(tiles, at, i, field.tile_scale);
    }
    store(px, noise);
}

fn is_surface(px: vec2<i32>) -> bool {
    return all(px < vec2<i32>(frame.size)) && (geometry_at(px).w & ~ENHANCED) != 0u;
}

@compute @workgroup_size(8, 8)
fn cs_blocks(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = vec2<i32>(id.xy);
    let first = BLOCK * block;
    if any(first >= vec2<i32>(frame.size)) {
        return;
    }
    var found = 0u;
    for (var i = 0; i < 5; i++) {
        // The middle, then the corners.
        let offset = select(3 * vec2(i & 1, (i >> 1u) & 1), vec2(2), i == 4);
        let px = first + offset;
        found = select(found, found_at(px), is_surface(px));
    }
    textureStore(found_tex, block, vec4(found, 0u, 0u, 0u));
}

// Jump flooding: of the surfaces that blocks around have found, the nearest.
@compute @workgroup_size(8, 8)
fn cs_flood(@builtin(global_invocation_id) id: vec3<u32>) {
    let blocks = vec2<i32>(textureDimensions(near_tex));
    let block = vec2<i32>(id.xy);
    if any(block >= blocks) {
        return;
    }
    let step = select(0, 32, STEP_32) + select(0, 16, STEP_16) + select(0, 8, STEP_8) + select(0, 4, STEP_4) + select(0, 2, STEP_2) + select(0, 1, STEP_1);
    let middle = vec2<f32>(BLOCK * block) + 0.5 * f32(BLOCK);
    var best = textureLoad(near_tex, block, 0).x;
    // What a block has itself stays.
    var least = 1e9;
    if best != 0u {
        least = distance(vec2<f32>(pixel_of(best)) + 0.5, middle);
    }
    if least > 0.75 * f32(BLOCK) {
        for (var i = 0; i < 9; i++) {
            let q = block + step * (vec2(i % 3, i / 3) - 1);
            let found = textureLoad(near_tex, clamp(q, vec2(0), blocks - 1), 0).x;
            if found != 0u {
                let away = distance(vec2<f32>(pixel_of(found)) + 0.5, middle);
                if away < least {
                    least = away;
                    best = found;
                }
            }
        }
    }
    textureStore(found_tex, block, vec4(best, 0u, 0u, 0u));
}

@compute @workgroup_size(8, 8)
fn cs_fill(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = vec2<i32>(id.xy);
    if any(block >= vec2<i32>(textureDimensions(near_tex))) {
        return;
    }
    let found = textureLoad(near_tex, block, 0).x;
    if found == 0u {
        textureStore(fill_field_tex, block, vec4(0u));
        return;
    }
    let px = pixel_of(found);
    let s = unpack_surfel(geometry_at(px));
    let noise = noise_at(pos_view_of(px, s.depth), s.normal, s.depth, 1.0, field.fill_wave, s.object, field.fill_seed);
    let middle = vec2<f32>(BLOCK * block) + 0.5 * f32(BLOCK);
    let away = distance(vec2<f32>(px) + 0.5, middle);
    let packed = pack2x16float(control_factor(px, s) * noise);
    textureStore(fill_field_tex, block, vec4(packed, found, s.object, bitcast<u32>(away)));
}
