// Stripes of hatching: lines that were found on the surface (Knoeppel et al. 2015, "Stripe Patterns on Surfaces"), of which each pixel
// takes the level that is about as dense as wanted, so that strokes keep their width on paper. Lines that the denser level has more
// than the coarser one begin as points and come last.
#import common/frame.wgsl
#import common/octahedral.wgsl
#import common/same_surface.wgsl
#import gpu/record_texture.wgsl

// Twin: `GpuStroke` in src/render/effects/hatching/strokes.rs. Lengths in px, widths as shares of the spacing.
struct Stroke {
    spacing: f32,
    min_width: f32,
    max_width: f32,
    length: f32,
    taper: f32,
    gap: f32,
    tone_by_count: f32,
    randomness: f32,
    pointedness: f32,
    late_insertion: f32,
    variation: f32,
    // Which of the tables says what tone to ask for.
    table: u32,
}

// As in src/geometry/stripes/levels.rs.
const FAMILIES: u32 = 3u;
const THIRD_DENSITY: f32 = 0.89;
const BASE_LEVEL: i32 = 5;
const LAST_LEVEL: i32 = 6;
// Levels below the own one by which lines are told apart, so that a line keeps its number while one comes closer.
const FINER_BY: i32 = 6;
// So many numbers of strokes there are before they begin again.
const STROKES: u32 = 16u;

// As in src/geometry/stripes/vertex.rs: the number that stands for 0 in coordinates of normals.
const MIDDLE: i32 = 16383;

// As in src/render/effects/hatching/calibration.rs.
const SOFT: f32 = 0.04;
// A stroke ends where it would be narrower, px; one that is narrower than the other is drawn so wide, and paler.
const MIN_WIDTH: f32 = 0.45;
const FULL_WIDTH: f32 = 0.7;
// The share of its greatest width from which on a stroke's ends close, and that at which it has none.
const ENDS_CLOSE: f32 = 0.3;
const ENDS_CLOSED: f32 = 0.8;
// From so much more tone on than they need inserted lines count as neighbors.
const INSERTED: f32 = 0.2;
const OCTAVE_PLACES: u32 = 32u;
const OCTAVE_LENGTHS: u32 = 10u;
const INK_STEPS: u32 = 64u;

// Numbers of vertices of each triangle, and the vertices: src/render/base/stripes.rs.
var stripe_triangles: texture_storage_2d<rgba32uint, read>;
var stripe_vertices: texture_storage_2d<rgba32uint, read>;
// For each table, place in the octave of densities, in that of lengths, and share of ink the tone to ask for.
var<storage, read> stripe_tones: array<f32>;

fn mixed(v: u32) -> u32 {
    let state = v * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn hash_of(a: u32, b: u32) -> u32 {
    return mixed(a + mixed(b));
}

fn unit_of(hash: u32) -> f32 {
    return f32(hash >> 8u) / 16777216.0;
}

// Ranks of lines near each other, of 16: the lower, the lighter a tone may be in which a line is drawn; and where its strokes begin,
// in fifteenths of one. Found by a search for the most even tone in patches of 8 × 8 spacings, at every density and length. A
// hexadecimal digit for each of `IDS` lines that were born at a level beside each other; those of the next level have the other words.
// As in src/render/effects/hatching/ranks.rs.
const IDS: u32 = 8u;
const RANKS: vec2<u32> = vec2(0x6c0b71dau, 0x8d462b97u);
const OFFSETS: vec2<u32> = vec2(0x7e32c894u, 0xb5d3c8e2u);

// Which line it is: the same one while one comes closer, and however a triangle counts.
struct LineId {
    // Among those that were born with it.
    index: u32,
    // At which it was born.
    level: i32,
}

// `number`: among the lines of the level after `k`.
fn line_id(number: f32, rows: Rows, k: i32, sense: f32) -> LineId {
    let bits = u32(i32(number * sense)) & (rows.period - 1u);
    let born = countTrailingZeros(select(bits, rows.period, bits == 0u));
    return LineId((bits >> (born + 1u)) % IDS, k + 1 - i32(born));
}

fn digit_of(words: vec2<u32>, id: LineId) -> u32 {
    return (words[u32(id.level) & 1u] >> (4u * id.index)) & 15u;
}

// Every second stroke of a line comes later, so that both kinds do so evenly.
fn rank_of_stroke(rank: u32, number: u32) -> u32 {
    return (rank + 8u * (number & 1u)) & 15u;
}

// Value noise, 0 to 1.
fn value_noise(p: vec3<f32>) -> f32 {
    let f = floor(p);
    let t = p - f;
    let w = t * t * (3.0 - 2.0 * t);
    let cell = vec3<u32>(vec3<i32>(f));
    var sum = 0.0;
    for (var i = 0u; i < 8u; i++) {
        let corner = vec3(i & 1u, (i >> 1u) & 1u, i >> 2u);
        let at = cell + corner;
        let weights = select(1.0 - w, w, corner == vec3(1u));
        sum += weights.x * weights.y * weights.z * unit_of(mixed(at.x + mixed(at.y + mixed(at.z))));
    }
    return sum;
}

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

// How much each corner counts at a place in a triangle.
fn shares_at(place: vec3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    let u = b - a;
    let v = c - a;
    let w = place - a;
    let uu = dot(u, u);
    let uv = dot(u, v);
    let vv = dot(v, v);
    let area = max(uu * vv - uv * uv, 1e-36);
    let s = clamp((vv * dot(w, u) - uv * dot(w, v)) / area, 0.0, 1.0);
    let t = clamp((uu * dot(w, v) - uv * dot(w, u)) / area, 0.0, 1.0);
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

// The tone to ask for, so that so much is inked; `place` and `length`: in their octaves, after each of which comes another.
fn tone_for(table: u32, place: f32, length: f32, ink: f32) -> f32 {
    let row = place * f32(OCTAVE_PLACES) - 0.5 + f32(OCTAVE_PLACES);
    let column = length * f32(OCTAVE_LENGTHS) - 0.5 + f32(OCTAVE_LENGTHS);
    let at = clamp(ink, 0.0, 1.0) * f32(INK_STEPS - 1u);
    let first = min(u32(at), INK_STEPS - 2u);
    var tones = vec4(0.0);
    for (var i = 0u; i < 4u; i++) {
        let r = (u32(row) + (i & 1u)) % OCTAVE_PLACES;
        let c = (u32(column) + (i >> 1u)) % OCTAVE_LENGTHS;
        let k = ((table * OCTAVE_PLACES + r) * OCTAVE_LENGTHS + c) * INK_STEPS + first;
        tones[i] = mix(stripe_tones[k], stripe_tones[k + 1u], at - f32(first));
    }
    let by_row = mix(tones.xz, tones.yw, fract(row));
    return mix(by_row.x, by_row.y, fract(column));
}

// Strokes are followed so far at most, px.
const FOLLOWED: f32 = 8.0;

// Length that the surface leaves of a stroke through a pixel, px; beyond `length` it does not matter.
fn length_left(px: vec2<i32>, along: vec2<f32>, length: f32) -> f32 {
    let own = textureLoad(surface_id_tex, px, 0).x;
    let most = vec2<i32>(frame.size) - 1;
    var left = 1.0;
    for (var way = -1.0; way <= 1.0; way += 2.0) {
        for (var i = 1.0; left < length; i += 1.0) {
            let q = px + vec2<i32>(round(i * way * along));
            if textureLoad(surface_id_tex, clamp(q, vec2(0), most), 0).x != own {
                break;
            }
            left += 1.0;
        }
    }
    return left;
}

// Where a pixel lies along the strokes of a family.
struct Along {
    // In strokes, each line's own counted from an offset of its own.
    at: f32,
    // Level of lengths, the place in its octave, and the length of a stroke, px.
    k: i32,
    place: f32,
    length: f32,
}

fn along_at(s: Stripes, family: Family, stroke: Stroke) -> Along {
    let across = family_of(s, (family.number + 1u) % FAMILIES);
    // Along the stroke itself: where a surface is seen at a slant the steepest way is another.
    let slope = abs(family.screen.x * across.screen.y - family.screen.y * across.screen.x) / family.per_px;
    let level = level_of(max(slope, 1e-12), stroke.length);
    let rows = rows_at(s, across, level.k);
    let finer = 0.5 * wrapped(rows.finer - 2.0 * rows.own);
    let at = (rows.own + finer * smoothstep(0.0, 1.0, level.place)) * family.sense;
    // So that the ends of neighbors do not line up.
    let frequency = s.frequency * exp2(f32(level.k)) * 1.7;
    let noise = mix(value_noise(s.place * frequency), value_noise(s.place * frequency * 2.0), level.place);
    return Along(at + mix(0.25, 0.125, level.place) * (noise - 0.5), level.k, level.place, level.spacing);
}

// A line near a pixel: how wide it is there, and how far from its middle the pixel lies, px.
struct Line {
    width: f32,
    away: f32,
}

// How much later a line comes that is inserted between two others: never where an octave begins, as those that were inserted
// before it are old lines there.
fn lateness(stroke: Stroke, place: f32) -> f32 {
    let rest = 1.0 - place;
    return mix(pow(rest, 8.0), rest, stroke.late_insertion);
}

// The line of a number: those that the level itself has are even.
fn line_at(number: f32, family: Family, rows: Rows, level: Level, along: Along, stroke: Stroke, tone: f32) -> Line {
    let even = (i32(number) & 1) == 0;
    let coarse = 2.0 * wrapped(rows.own);
    let fine = rows.finer - number;
    let blended = select(fine, mix(coarse, fine, smoothstep(0.0, 1.0, level.place)), even && abs(coarse - fine) < 0.5);
    let id = line_id(number, rows, level.k, family.sense);
    let rank = digit_of(RANKS, id);
    let seed = hash_of(id.index, u32(id.level) ^ (family.number * 7919u));
    var tapered = 1.0;
    // Of a line that goes on and on: it has no second strokes.
    var chance = (f32(rank & 7u) + unit_of(seed)) / 8.0;
    var variation = 0.0;
    if stroke.taper > 0.0 {
        // Twice as much where there are twice as many, so that what is an end stays one.
        let u = along.at + f32((digit_of(OFFSETS, id) << (u32(along.k + BASE_LEVEL) & 3u)) % 15u) / 15.0;
        let stroke_number = u32(i32(floor(u))) % STROKES;
        let share = fract(u);
        let end = min(share, 1.0 - share) * along.length - stroke.gap;
        // Where strokes are nearly twice as long as wanted they come apart in the middle.
        let apart = smoothstep(0.35, 1.0, along.place);
        let middle = abs(share - 0.5) * along.length - stroke.gap;
        tapered = clamp(end / stroke.taper, 0.0, 1.0);
        tapered = min(tapered, mix(1.0, clamp(middle / stroke.taper, 0.0, 1.0), apart));
        let half_number = (2u * stroke_number + select(0u, 1u, share > 0.5)) % STROKES;
        let whole = hash_of(seed, stroke_number);
        let half = hash_of(seed, half_number);
        let ranks = vec2(f32(rank_of_stroke(rank, stroke_number)), f32(rank_of_stroke(rank, half_number)));
        chance = mix(ranks.x + unit_of(whole), ranks.y + unit_of(half), apart) / 16.0;
        let others = (5.0 * ranks + 3.0) % 16.0 + vec2(unit_of(mixed(whole)), unit_of(mixed(half)));
        variation = mix(others.x, others.y, apart) / 16.0 - 0.5;
    }
    let late = lateness(stroke, level.place);
    let onset = stroke.tone_by_count * stroke.randomness * chance + select(late, 0.0, even);
    // Strokes that are wide run into the next ones: no specks of paper in the dark.
    let closed = smoothstep(ENDS_CLOSE, ENDS_CLOSED, (tone - onset) / max(1.0 - onset, 1e-3));
    let threshold = onset + stroke.tone_by_count * (1.0 - mix(tapered, 1.0, closed)) * stroke.pointedness;
    let beyond = clamp((tone - threshold) / max(1.0 - threshold, 1e-3), 0.0, 1.0);
    let share = mix(stroke.min_width, stroke.max_width, beyond);
    let pressed = mix(sqrt(tapered), 1.0, closed) * (1.0 - stroke.variation * variation) * smoothstep(0.0, SOFT, tone - threshold);
    var width = stroke.spacing * share * pressed;
    // No hair lines: a stroke ends, it does not fade.
    width = select(width, 0.0, width < MIN_WIDTH);
    // Nor hair lines of paper: strokes that nearly touch do.
    let next = level.spacing * mix(1.0, 0.5, smoothstep(0.0, INSERTED, tone - late));
    width += smoothstep(next - FULL_WIDTH, next, width);
    return Line(width, abs(blended) * level.spacing * 0.5);
}

fn reaches(line: Line) -> bool {
    return line.width > 0.0 && line.away < 0.5 * (max(line.width, FULL_WIDTH) + frame.coverage_ramp);
}

fn line_ink(line: Line) -> f32 {
    let covered = clamp((0.5 * max(line.width, FULL_WIDTH) - line.away) / frame.coverage_ramp + 0.5, 0.0, 1.0);
    return covered * min(line.width / (FULL_WIDTH), 1.0);
}

// Ink of a family where `ink` of all is to be inked.
fn stripe_ink(px: vec2<i32>, s: Stripes, number: u32, stroke: Stroke, ink: f32) -> f32 {
    let family = family_of(s, number);
    let level = level_of(family.per_px, stroke.spacing);
    let rows = rows_at(s, family, level.k);
    var along: Along;
    if stroke.taper > 0.0 {
        along = along_at(s, family, stroke);
    }
    let tone = tone_for(stroke.table, level.place, along.place, ink);
    let nearest = round(rows.finer);
    var line = line_at(nearest, family, rows, level, along, stroke, tone);
    // An old line may be so wide that it reaches beyond an inserted one.
    var wide = Line(0.0, 0.0);
    let widest = stroke.spacing * stroke.max_width * (1.0 + 0.5 * stroke.variation) + 2.0;
    if (i32(nearest) & 1) == 1 && widest > 0.5 * level.spacing {
        let even = nearest + select(-1.0, 1.0, rows.finer > nearest);
        wide = line_at(even, family, rows, level, along, stroke, tone);
    }
    if !reaches(line) && !reaches(wide) {
        return 0.0;
    }
    // What crosses a narrow facet would be a tooth of a comb.
    let run = vec2(-family.screen.y, family.screen.x) / family.per_px;
    let enough = min(2.0 * stroke.spacing, FOLLOWED);
    let left = smoothstep(0.4, 1.0, length_left(px, run, enough) / enough);
    line.width *= left;
    wide.width *= left;
    return max(line_ink(line), line_ink(wide));
}
