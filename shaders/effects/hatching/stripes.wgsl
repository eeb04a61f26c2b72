// Stripes of hatching: lines that were found on the surface (Knoeppel et al. 2015, "Stripe Patterns on Surfaces"), of which each pixel
// takes the level that is about as dense as wanted, so that strokes keep their width on paper. Lines that the denser level has more
// than the coarser one begin as points and come last.
#import common/octahedral.wgsl
#import gpu/record_texture.wgsl

// As in src/geometry/stripes/levels.rs.
const FAMILIES: u32 = 3u;
const THIRD_DENSITY: f32 = 0.89;
const BASE_LEVEL: i32 = 5;
const LAST_LEVEL: i32 = 6;
// Levels below the own one by which lines are told apart, so that a line keeps its number while one comes closer.
const FINER_BY: i32 = 6;

// As in src/geometry/stripes/vertex.rs: the number that stands for 0 in coordinates of normals.
const MIDDLE: i32 = 16383;

// Numbers of vertices of each triangle, and the vertices: src/render/base/stripes.rs.
var stripe_triangles: texture_storage_2d<rgba32uint, read>;
var stripe_vertices: texture_storage_2d<rgba32uint, read>;

fn wrapped(cycles: f32) -> f32 {
    return cycles - round(cycles);
}

// The stripes of a triangle as a pixel sees them.
struct Stripes {
    // Of the corners, local space.
    direction: array<vec3<f32>, 3>,
    normal: array<vec3<f32>, 3>,
    away: array<vec3<f32>, 3>,
    // Of each family the two words of every corner.
    first: array<vec3<u32>, 3>,
    second: array<vec3<u32>, 3>,
    // 1 where a corner's direction agrees with that of the first one, or −1.
    signs: vec3<f32>,
    // Shares of the corners.
    shares: vec3<f32>,
    // Of the pixel, and its change from pixel to pixel, local space.
    place: vec3<f32>,
    dx: vec3<f32>,
    dy: vec3<f32>,
    // Cycles of the base level per unit.
    frequency: f32,
}

// How much each corner counts at a place in a triangle. By areas, as squares of lengths leave nothing of needles.
fn shares_at(place: vec3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    let u = b - a;
    let v = c - a;
    let w = place - a;
    let area = cross(u, v);
    let per_area = area / max(dot(area, area), 1e-36);
    let s = clamp(dot(cross(w, v), per_area), 0.0, 1.0);
    let t = clamp(dot(cross(u, w), per_area), 0.0, 1.0);
    return vec3(1.0 - s - t, s, t);
}

// Vertices lie on it: `Grid` in src/render/base/stripes.rs.
struct Grid {
    origin: vec3<f32>,
    step: f32,
}

fn on_grid(words: vec2<u32>) -> vec3<f32> {
    return vec3<f32>(vec3(words.x & 0x1fffffu, (words.x >> 21u) | ((words.y & 0x3ffu) << 11u), (words.y >> 10u) & 0x1fffffu));
}

// The number that a family has room for beside its phases.
fn extra(words: vec2<u32>) -> u32 {
    return (words.x >> 28u) | ((words.y >> 21u) << 4u);
}

// A direction across a normal, by its angle (0 to 1) in a basis that hangs on nothing else (Duff et al., "Building an Orthonormal
// Basis, Revisited", 2017).
fn direction_about(n: vec3<f32>, turn: f32) -> vec3<f32> {
    let side = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (side + n.z);
    let b = n.x * n.y * a;
    let x = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    let y = vec3(b, side + n.y * n.y * a, -n.y);
    // In quarters, so that what runs along an axis does so exactly: a step of strokes may begin there.
    let quarter = round(4.0 * turn);
    let angle = 1.5707963 * (4.0 * turn - quarter);
    let along = select(x, y, u32(quarter) % 2u == 1u);
    let across = select(y, -x, u32(quarter) % 2u == 1u);
    return select(1.0, -1.0, u32(quarter) % 4u >= 2u) * (along * cos(angle) + across * sin(angle));
}

// `triangle`: its number among all. Words of a vertex: `StripeVertex` in src/geometry/stripes/vertex.rs.
fn stripes_of(triangle: u32, grid: Grid, place: vec3<f32>, dx: vec3<f32>, dy: vec3<f32>, frequency: f32) -> Stripes {
    var s: Stripes;
    let vertices = texel_at(stripe_triangles, triangle).xyz;
    var position = array<vec3<f32>, 3>();
    for (var i = 0u; i < 3u; i++) {
        let one = texel_at(stripe_vertices, 2u * vertices[i]);
        let other = texel_at(stripe_vertices, 2u * vertices[i] + 1u);
        s.first[0][i] = one.z;
        s.second[0][i] = one.w;
        s.first[1][i] = other.x;
        s.second[1][i] = other.y;
        s.first[2][i] = other.z;
        s.second[2][i] = other.w;
        position[i] = on_grid(one.xy);
        let shares = vec2<f32>(vec2<i32>(vec2(extra(one.zw), extra(other.xy))) - MIDDLE);
        s.normal[i] = octahedral_decode(shares * (2.0 / 32767.0));
        s.direction[i] = direction_about(s.normal[i], f32(extra(other.zw)) / 32768.0);
        s.away[i] = (position[i] - position[0]) * grid.step;
        // Rolled from the plane of the first corner to that of this one.
        let n0 = s.normal[0];
        let d0 = s.direction[0];
        let rolled = d0 - (n0 + s.normal[i]) * (dot(d0, s.normal[i]) / max(1.0 + dot(n0, s.normal[i]), 1e-3));
        s.signs[i] = select(1.0, -1.0, dot(rolled, s.direction[i]) < 0.0);
    }
    s.signs[0] = 1.0;
    s.shares = shares_at((place - grid.origin) / grid.step, position[0], position[1], position[2]);
    s.place = place;
    s.dx = dx;
    s.dy = dy;
    s.frequency = frequency;
    return s;
}

// One family of the stripes.
struct Family {
    // From the first corner to the others, cycles of the base level.
    cycles: vec3<f32>,
    // Cycles of the base level per px.
    per_px: f32,
    // Its change from pixel to pixel.
    screen: vec2<f32>,
    // 1 where its gradient agrees with a direction that is the same everywhere, or −1: lines and strokes are counted in one sense,
    // whichever that of the triangle is.
    sense: f32,
    number: u32,
}

fn family_of(s: Stripes, number: u32) -> Family {
    let angle = 1.5707963 + 1.0471976 * f32(number);
    let turn = vec2(cos(angle), sin(angle));
    let frequency = s.frequency * select(1.0, THIRD_DENSITY, number == 2u);
    var gradient = vec3(0.0);
    var cycles = vec3(0.0);
    let first = s.direction[0] * turn.x + cross(s.normal[0], s.direction[0]) * turn.y;
    for (var i = 0u; i < 3u; i++) {
        let own = (s.direction[i] * turn.x + cross(s.normal[i], s.direction[i]) * turn.y) * s.signs[i];
        gradient += s.shares[i] * own;
        cycles[i] = 0.5 * frequency * dot(first + own, s.away[i]);
    }
    gradient = normalize(gradient + vec3(1e-20)) * frequency;
    let screen = vec2(dot(gradient, s.dx), dot(gradient, s.dy));
    return Family(cycles, max(length(screen), 1e-12), screen, select(1.0, -1.0, dot(gradient, vec3(0.31, 0.89, 0.33)) < 0.0), number);
}

// Phases of the corners at a level, 1/65536 of a cycle, from those of the level before (0 before the first one).
fn phases_after(before: vec3<u32>, s: Stripes, number: u32, level: u32) -> vec3<u32> {
    let words = select(s.second[number], s.first[number], level < 4u);
    let differences = (words >> vec3(7u * (level & 3u))) & vec3(127u);
    return (2u * before + (differences << vec3(9u))) & vec3(0xffffu);
}

// The phase at a level, −5 and more: linear in the triangle, where each corner has what comes nearest to what the gradient foretells.
// `phases`: of the corners at that level, or at the last one.
fn phase_at(s: Stripes, family: Family, phases: vec3<u32>, k: i32) -> f32 {
    let level = clamp(k + BASE_LEVEL, 0, LAST_LEVEL);
    let own = s.signs * vec3<f32>(phases) / 65536.0;
    let foretold = family.cycles * exp2(f32(level - BASE_LEVEL));
    let off = own - own.x - foretold;
    let phase = own.x + dot(s.shares, foretold + off - round(off));
    // Beyond the last level twice as many lines each time.
    return phase * exp2(f32(k + BASE_LEVEL - level));
}

// Which level has lines of a spacing (px), and the place in the octave up to the next denser one, 0 to 1.
struct Level {
    k: i32,
    place: f32,
    spacing: f32,
}

fn level_of(per_px: f32, wanted: f32) -> Level {
    let x = clamp(-log2(per_px * wanted), -5.0, 12.0);
    let k = floor(x);
    return Level(i32(k), x - k, exp2(-k) / per_px);
}

// Where a pixel lies among the lines of a family: in lines of the next level, whole numbers on them, which tell them apart by their
// last bits; and in lines of the level itself.
struct Rows {
    finer: f32,
    own: f32,
    // After so many lines of the next level their numbers begin again.
    period: u32,
}

fn rows_at(s: Stripes, family: Family, k: i32) -> Rows {
    let first = min(max(k - FINER_BY, -BASE_LEVEL), k);
    var phases = vec3(0u);
    for (var level = 0; level <= min(first + BASE_LEVEL, LAST_LEVEL); level++) {
        phases = phases_after(phases, s, family.number, u32(level));
    }
    var y = wrapped(phase_at(s, family, phases, first));
    var own = y;
    for (var level = first + 1; level <= k + 1; level++) {
        if level + BASE_LEVEL <= LAST_LEVEL {
            phases = phases_after(phases, s, family.number, u32(level + BASE_LEVEL));
        }
        let phase = phase_at(s, family, phases, level);
        y = 2.0 * y + wrapped(phase - 2.0 * y);
        own = select(own, y, level == k);
    }
    return Rows(y, own, 2u << u32(k - first));
}
