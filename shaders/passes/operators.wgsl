// The operators of the edge-enhancement paper, section 4.1.2, and those of the hatching paper (Bu et al. 2006), section 3, "Outline".
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/gbuffer.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl

// Whether any object uses the C1 operator.
override WITH_C1: bool = true;
// Whether any uses Sobel operators, and whether on base colors.
override WITH_SOBEL: bool = false;
override WITH_COLOR: bool = false;

// Linear.
var base_color_tex: texture_2d<f32>;

// One texel as the operators see it.
struct Sample {
    normal: vec3<f32>,
    // 0 to 1 over the range of the enhanced objects; background: 1.
    depth: f32,
    object: u32,
}

fn background_sample() -> Sample {
    return Sample(vec3(0.0, 0.0, 1.0), 1.0, 0u);
}

fn sample_of(s: Surfel) -> Sample {
    let range = frame.depth_range;
    return Sample(s.normal, clamp((s.depth - range.x) / (range.y - range.x), 0.0, 1.0), s.object);
}

// A neighbor of the enhanced texel `x`. What is not enhanced is background to the operators, unless it hides `x`'s
// own surroundings: then nothing is known there and no edge may come of it.
fn neighbor(px: vec2<i32>, x: Surfel) -> Sample {
    let s = unpack_surfel(geometry_at(px));
    if s.enhanced {
        return sample_of(s);
    }
    if s.object != 0u && s.depth < x.depth {
        return sample_of(x);
    }
    return background_sample();
}

struct Operators {
    i_n: f32,
    i_z: f32,
    c1: f32,
    // The nearest object among the texels that were compared: a line between two objects is the nearer one's.
    owner: u32,
}

fn nearer(a: Sample, b: Sample) -> Sample {
    if b.depth < a.depth {
        return b;
    }
    return a;
}

// Neighbors A to H of the paper's Fig. 2, row by row, without X.
fn operators(px: vec2<i32>, x: Surfel, use_c1: bool) -> Operators {
    let center = sample_of(x);
    let a = neighbor(px + vec2(-1, -1), x);
    let c = neighbor(px + vec2(1, -1), x);
    let f = neighbor(px + vec2(-1, 1), x);
    let h = neighbor(px + vec2(1, 1), x);
    let i_n = 0.5 * (dot(a.normal, h.normal) + dot(c.normal, f.normal));
    let ah = 1.0 - 0.5 * abs(a.depth - h.depth);
    let cf = 1.0 - 0.5 * abs(c.depth - f.depth);
    var nearest = nearer(nearer(center, nearer(a, h)), nearer(c, f));
    var c1 = 0.0;
    if WITH_C1 && use_c1 {
        let b = neighbor(px + vec2(0, -1), x);
        let d = neighbor(px + vec2(-1, 0), x);
        let e = neighbor(px + vec2(1, 0), x);
        let g = neighbor(px + vec2(0, 1), x);
        let z = center.depth;
        c1 = (abs(a.depth - z) + 2.0 * abs(b.depth - z) + abs(c.depth - z)
            + 2.0 * abs(d.depth - z) + 2.0 * abs(e.depth - z)
            + abs(f.depth - z) + 2.0 * abs(g.depth - z) + abs(h.depth - z)) / 8.0;
        nearest = nearer(nearest, nearer(nearer(b, d), nearer(e, g)));
    }
    return Operators(i_n, ah * ah * cf * cf, c1, nearest.object);
}

// Ink above the threshold, stretched to 0..1.
fn past(ink: f32, threshold: f32) -> f32 {
    return clamp((ink - threshold) / (1.0 - threshold), 0.0, 1.0);
}

// Gradients of what is around a texel, by the Sobel operators S_x and S_y.
struct Gradients {
    normal: f32,
    depth: f32,
    color: f32,
    // Whether the z of the normals differs in sign.
    turns: bool,
    owner: u32,
}

// Paper is white.
fn luminance_at(px: vec2<i32>, at: Sample) -> f32 {
    if at.object == 0u {
        return 1.0;
    }
    let last = vec2<i32>(textureDimensions(base_color_tex)) - 1;
    return dot(textureLoad(base_color_tex, clamp(px, vec2(0), last), 0).rgb, vec3(0.2126, 0.7152, 0.0722));
}

fn magnitude(x: f32, y: f32, sums: bool) -> f32 {
    return select(sqrt(x * x + y * y), abs(x) + abs(y), sums);
}

fn gradients(px: vec2<i32>, x: Surfel, sums: bool) -> Gradients {
    let center = sample_of(x);
    var nearest = center;
    // Of normals, depth and color, in both directions.
    var nx = vec3(0.0);
    var ny = vec3(0.0);
    var z = vec2(0.0);
    var c = vec2(0.0);
    var front = 0;
    for (var j = -1; j <= 1; j++) {
        for (var i = -1; i <= 1; i++) {
            let at = px + vec2(i, j);
            var s = center;
            if i != 0 || j != 0 {
                s = neighbor(at, x);
            }
            nearest = nearer(nearest, s);
            // The background has the other sign.
            front += select(0, 1, s.normal.z >= 0.0 && s.object != 0u);
            let weight = vec2<f32>(vec2(i * (2 - j * j), j * (2 - i * i)));
            nx += weight.x * s.normal;
            ny += weight.y * s.normal;
            z += weight * s.depth;
            if WITH_COLOR {
                c += weight * luminance_at(at, s);
            }
        }
    }
    let normal = select(sqrt(dot(nx, nx) + dot(ny, ny)), length(nx) + length(ny), sums);
    return Gradients(normal, magnitude(z.x, z.y, sums), magnitude(c.x, c.y, sums), front != 0 && front != 9, nearest.object);
}

// Whether a gradient makes an edge; with threshold 0 none does.
fn is_edge(gradient: f32, threshold: f32) -> bool {
    return threshold > 0.0 && gradient >= threshold;
}

// Inner and profile ink: 1 where there is an edge.
fn sobel_ink(g: Gradients) -> vec2<f32> {
    let style = style_of(g.owner);
    let turns = g.turns && edge_styles[style].by_sign == 1u;
    let profile = turns || is_edge(g.depth, edge_styles[style].depth_gradient);
    let inner = is_edge(g.normal, edge_styles[style].normal_gradient) || is_edge(g.color, edge_styles[style].color_gradient);
    // One line is enough.
    return vec2(select(0.0, 1.0, inner && !profile), select(0.0, 1.0, profile));
}

@fragment
fn fs_main(@builtin(position) position: vec4<f32>) -> @location(0) vec4<u32> {
    let px = vec2<i32>(position.xy);
    let x = unpack_surfel(geometry_at(px));
    let own_style = style_of(x.object);
    if !x.enhanced || edge_styles[own_style].mode != IMAGE_SPACE {
        discard;
    }
    let found_by = edge_styles[own_style].found_by;
    if WITH_SOBEL && found_by == SOBEL_OPERATOR {
        let g = gradients(px, x, edge_styles[own_style].sums_changes == 1u);
        let ink = sobel_ink(g);
        if all(ink <= vec2(0.0)) {
            discard;
        }
        return pack_operator_ink(ink, g.owner, x.depth);
    }
    let use_c1 = found_by == C1_OPERATOR;
    let o = operators(px, x, use_c1);
    let style = style_of(o.owner);
    let profile = select(edge_styles[style].gain_z * (1.0 - o.i_z), edge_styles[style].gain_c1 * o.c1, use_c1);
    let inner = edge_styles[style].gain_n * (1.0 - o.i_n);
    let ink = vec2(
        past(inner, edge_styles[style].inner_threshold),
        past(profile, edge_styles[style].profile_threshold),
    );
    if all(ink <= vec2(0.0)) {
        discard;
    }
    return pack_operator_ink(ink, o.owner, x.depth);
}

// I_N, I_Z and C1 themselves (no edge: 1, 1, 0), for a look at them and for tests.
@fragment
fn fs_operators(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let px = vec2<i32>(position.xy);
    let x = unpack_surfel(geometry_at(px));
    if !x.enhanced {
        return vec4(1.0, 1.0, 0.0, 0.0);
    }
    let o = operators(px, x, true);
    return vec4(o.i_n, o.i_z, o.c1, 1.0);
}
