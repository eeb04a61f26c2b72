// Strokes of hatching along the lines of stripes: how dark a tone has to be for each to be drawn, how wide it is then, where it ends,
// and how its end passes that of the next one.
#import common/frame.wgsl
#import effects/hatching/packed_inks.wgsl
#import effects/hatching/stripes.wgsl
#import effects/hatching/style.wgsl

// So many numbers of strokes there are before they begin again.
const STROKES: u32 = 16u;
// By so much of a rank the next stroke of a line comes later: strokes come evenly along it.
const STROKE_JITTER: f32 = 7.0 / 16.0;

// As in src/render/effects/hatching/calibration.rs.
const SOFT: f32 = 0.04;
// A stroke that is narrower is drawn so wide, px, and paler, if it is soft.
const FULL_WIDTH: f32 = 0.7;
// Width of the soft rim of crisp strokes, px: a sharper one shows more stairs than it takes away gray.
const CRISP_RIM: f32 = 0.2;
// The share of its greatest width from which on a stroke's ends close, and that at which it has none.
const ENDS_CLOSE: f32 = 0.3;
const ENDS_CLOSED: f32 = 0.8;
// So far apart are the middles of two strokes where their ends pass each other, in spacings.
const PASSING: f32 = 0.25;
// From so much more tone on than they need inserted lines count as neighbors.
const INSERTED: f32 = 0.2;
const OCTAVE_PLACES: u32 = 32u;
const OCTAVE_LENGTHS: u32 = 10u;
const INK_STEPS: u32 = 64u;
// The share of the length that is enough for a stroke below which it is none.
const SHORT: f32 = 0.55;
// A stroke ends where so small a share is left of its ink; but from the one share of ink to the other on strokes merge with those
// beside them, and are no dots, however narrow what is dark: furrows stay.
const FAINT: f32 = 0.6;
const MERGING: f32 = 0.3;
const MERGED: f32 = 0.5;
// Strokes are followed so far at most, px, and so far from their edges: those of which a surface shows less would be rows of dots.
const FOLLOWED: f32 = 8.0;
const INSET: f32 = 1.0;

// For each table, place in the octave of densities, in that of lengths, and share of ink the tone to ask for.
var<storage, read> stripe_tones: array<f32>;
// As effects/hatching/inks.wgsl draws it.
var inks_tex: texture_storage_2d<rg32uint, read>;

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
// in fifteenths of one. Found by a search for the most even tone in patches of 8 × 8 spacings, at every density. A
// hexadecimal digit for each of `IDS` lines that were born at a level beside each other; those of the next level have the other words.
// As in src/render/effects/hatching/ranks.rs.
const IDS: u32 = 8u;
const RANKS: vec2<u32> = vec2(0x4f6a2d19u, 0xb083c5e7u);
const OFFSETS: vec2<u32> = vec2(0x5783e40bu, 0x2a9635e8u);

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

// In which order widths come: every second stroke of a line has another rank, so that a line is as dark as the others.
fn rank_of_width(rank: u32, number: u32) -> u32 {
    return (5u * (rank + 8u * (number & 1u)) + 3u) & 15u;
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

// Length that the surface and its tone leave of a stroke, px; beyond `enough` it does not matter. `core`: from the pixel to what of
// the stroke is followed; `along`: its direction.
fn length_left(px: vec2<i32>, core: vec2<f32>, along: vec2<f32>, enough: f32, number: u32) -> f32 {
    let own = textureLoad(inks_tex, px);
    let ink = unpacked_inks(own.y).shares[number];
    let least = FAINT * ink * (1.0 - smoothstep(MERGING, MERGED, ink));
    let most = vec2<i32>(frame.size) - 1;
    // From column to column or from row to row, so that all pixels of a stroke meet the same ones.
    let step = along / max(abs(along.x), abs(along.y));
    let step_length = length(step);
    var left = step_length;
    for (var way = -1.0; way <= 1.0; way += 2.0) {
        for (var i = 1.0; left < enough; i += 1.0) {
            let q = px + vec2<i32>(round(core + i * way * step));
            let other = textureLoad(inks_tex, clamp(q, vec2(0), most));
            if other.x != own.x || unpacked_inks(other.y).shares[number] < least {
                break;
            }
            left += step_length;
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

// A stroke near a pixel: how wide it is there, and how far to one side of its middle the pixel lies, px.
struct Mark {
    width: f32,
    away: f32,
}

// How much later a line comes that is inserted between two others: never where an octave begins, as those that were inserted
// before it are old lines there.
fn lateness(stroke: Stroke, place: f32, rank: u32) -> f32 {
    let rest = pow(1.0 - place, exp2(stroke.insertion_spread * (f32(rank) / 7.5 - 1.0)));
    return mix(pow(rest, 8.0), rest, stroke.late_insertion);
}

// What all strokes of a line have in common at a pixel.
struct Row {
    // From its middle to the pixel, px; towards the side that is the same everywhere.
    away: f32,
    rank: u32,
    seed: u32,
    // The tone from which on a line is drawn that is inserted between others.
    late: f32,
    // To the next line, px.
    next: f32,
    // How far strokes have come apart in the middle.
    apart: f32,
}

// A stroke of a line at a pixel.
struct Piece {
    // Its number, and that of its half among those half as long.
    numbers: vec2<u32>,
    // 0 where it ends.
    tapered: f32,
    // How far its end widens where it is dark: 1; along what passes another stroke less and less, down to 0.
    closes: f32,
    // The side to which it gives way: 1, −1, or 0 where no other passes.
    side: f32,
}

// No hair lines: a stroke ends, it does not fade.
fn ended(width: f32, stroke: Stroke) -> f32 {
    return select(width, 0.0, width < stroke.end_width);
}

// What a stroke of a line leaves at a pixel; `tone`: what is asked for.
fn mark_of(row: Row, piece: Piece, stroke: Stroke, tone: f32) -> Mark {
    var jitter = unit_of(row.seed);
    var variation = 0.0;
    if stroke.taper > 0.0 {
        let jitters = fract(jitter + STROKE_JITTER * vec2<f32>(piece.numbers));
        jitter = mix(jitters.x, jitters.y, row.apart);
        let ranks = vec2(f32(rank_of_width(row.rank, piece.numbers.x)), f32(rank_of_width(row.rank, piece.numbers.y)));
        let widths = ranks + jitters;
        variation = mix(widths.x, widths.y, row.apart) / 16.0 - 0.5;
    }
    let chance = (f32(row.rank) + jitter) / 16.0;
    let onset = stroke.tone_by_count * stroke.randomness * chance + row.late;
    // Strokes that are wide run into the next ones: no specks of paper in the dark.
    let closed = smoothstep(ENDS_CLOSE, ENDS_CLOSED, (tone - onset) / max(1.0 - onset, 1e-3));
    let tapered = mix(piece.tapered, 1.0, closed * piece.closes);
    let threshold = onset + stroke.tone_by_count * (1.0 - tapered) * stroke.pointedness;
    let beyond = clamp((tone - threshold) / max(1.0 - threshold, 1e-3), 0.0, 1.0);
    let share = mix(stroke.min_width, stroke.max_width, beyond);
    let pressed = tapered * (1.0 - stroke.variation * variation) * smoothstep(0.0, SOFT, tone - threshold);
    var width = ended(stroke.spacing * share * pressed, stroke);
    // Nor hair lines of paper: strokes that nearly touch do.
    width += smoothstep(row.next - FULL_WIDTH, row.next, width);
    let aside = piece.side * PASSING * stroke.spacing * (1.0 - piece.tapered) * (1.0 - closed);
    return Mark(width, row.away - aside);
}

// The strokes of a line near a pixel: its own, and the one whose end passes that one's.
struct Marks {
    own: Mark,
    passing: Mark,
}

// The line of a number: those that the level itself has are even.
fn marks_at(number: f32, family: Family, rows: Rows, level: Level, along: Along, stroke: Stroke, tone: f32) -> Marks {
    let even = (i32(number) & 1) == 0;
    let coarse = 2.0 * wrapped(rows.own);
    let fine = rows.finer - number;
    let blended = select(fine, mix(coarse, fine, smoothstep(0.0, 1.0, level.place)), even && abs(coarse - fine) < 0.5);
    let id = line_id(number, rows, level.k, family.sense);
    let rank = digit_of(RANKS, id);
    let late = lateness(stroke, level.place, rank);
    let next = level.spacing * mix(1.0, 0.5, smoothstep(0.0, INSERTED, tone - late));
    // Where strokes are nearly twice as long as wanted they come apart in the middle.
    let apart = smoothstep(0.35, 1.0, along.place);
    let seed = hash_of(id.index, u32(id.level) ^ (family.number * 7919u));
    let row = Row(family.sense * blended * level.spacing * 0.5, rank, seed, select(late, 0.0, even), next, apart);
    let none = Mark(0.0, 0.0);
    if stroke.taper <= 0.0 {
        return Marks(mark_of(row, Piece(vec2(0u), 1.0, 1.0, 0.0), stroke, tone), none);
    }
    // Twice as much where there are twice as many, so that what is an end stays one.
    let u = along.at + f32((digit_of(OFFSETS, id) << (u32(along.k + BASE_LEVEL) & 3u)) % 15u) / 15.0;
    let share = fract(u);
    let own = u32(i32(floor(u))) % STROKES;
    let second = select(0u, 1u, share > 0.5);
    let end = min(share, 1.0 - share) * along.length;
    let middle = abs(share - 0.5) * along.length;
    let tapers = clamp((vec2(end, middle) - stroke.gap) / stroke.taper, vec2(0.0), vec2(1.0));
    var piece = Piece(vec2(own, (2u * own + second) % STROKES), min(tapers.x, mix(1.0, tapers.y, apart)), 1.0, 0.0);
    if stroke.gap >= 0.0 {
        return Marks(mark_of(row, piece, stroke, tone), none);
    }
    // The stroke beyond the nearer end: the next one, or the other half.
    let in_middle = middle < end;
    let nearer = select(end, middle, in_middle);
    let beyond = clamp((-nearer - stroke.gap) / stroke.taper, 0.0, 1.0) * select(1.0, apart, in_middle);
    // Which of the two comes first along the line.
    piece.side = select(1.0, -1.0, (second == 0u) != in_middle);
    let first = mark_of(row, piece, stroke, tone);
    if beyond <= 0.0 {
        return Marks(first, none);
    }
    let other = select((own + STROKES + 2u * second - 1u) % STROKES, own, in_middle);
    let numbers = vec2(other, (2u * other + 1u - second) % STROKES);
    let closes = smoothstep(0.0, clamp(-stroke.gap / stroke.taper, 1e-3, 1.0), beyond);
    return Marks(first, mark_of(row, Piece(numbers, beyond, closes, -piece.side), stroke, tone));
}

// How fine strokes are drawn.
struct Nib {
    // Width of a stroke's soft rim, px.
    rim: f32,
    // A stroke that is narrower is drawn so wide, px, and paler.
    least: f32,
}

// Crisp strokes would have gaps if they did not cover a pixel of each row or column that they cross. `away`: across strokes in the
// picture.
fn nib_of(stroke: Stroke, away: vec2<f32>) -> Nib {
    let connected = max(abs(away.x), abs(away.y)) / max(length(away), 1e-12);
    return Nib(
        mix(frame.coverage_ramp, CRISP_RIM, stroke.crispness),
        mix(FULL_WIDTH, connected, stroke.crispness),
    );
}

fn half_width(mark: Mark, nib: Nib) -> f32 {
    return select(0.0, 0.5 * max(mark.width, nib.least), mark.width > 0.0);
}

fn reaches(mark: Mark, nib: Nib) -> bool {
    return mark.width > 0.0 && abs(mark.away) < half_width(mark, nib) + 0.5 * nib.rim;
}

fn any_reach(marks: Marks, nib: Nib) -> bool {
    return reaches(marks.own, nib) || reaches(marks.passing, nib);
}

// Ink of a stroke; `inside`: from its edge to a pixel within it, px, less than 0 beyond it; `width`: px.
fn mark_ink(inside: f32, width: f32, nib: Nib) -> f32 {
    return clamp(inside / nib.rim + 0.5, 0.0, 1.0) * min(width / nib.least, 1.0);
}

// Ink of both strokes; `left`: share of their widths that is left.
fn marks_ink(marks: Marks, left: f32, stroke: Stroke, nib: Nib) -> f32 {
    let own = Mark(ended(marks.own.width * left, stroke), marks.own.away);
    let passing = Mark(ended(marks.passing.width * left, stroke), marks.passing.away);
    let half_widths = vec2(half_width(own, nib), half_width(passing, nib));
    let aways = vec2(own.away, passing.away);
    if abs(own.away - passing.away) < half_widths.x + half_widths.y && own.width > 0.0 && passing.width > 0.0 {
        // They are one where they overlap.
        let edges = max(half_widths.xx + vec2(-1.0, 1.0) * aways.x, half_widths.yy + vec2(-1.0, 1.0) * aways.y);
        return mark_ink(min(edges.x, edges.y), max(own.width, passing.width), nib);
    }
    let insides = half_widths - abs(aways);
    return mark_ink(insides.x, own.width, nib) + mark_ink(insides.y, passing.width, nib);
}

// In which a pixel lies deeper.
fn deeper(a: Mark, b: Mark) -> Mark {
    if 0.5 * a.width - abs(a.away) < 0.5 * b.width - abs(b.away) {
        return b;
    }
    return a;
}

// From a pixel to the core of a stroke, in the pixel's own column or row, px.
fn to_core(mark: Mark, family: Family) -> vec2<f32> {
    let most = max(0.5 * mark.width - INSET, 0.0);
    let across = (clamp(mark.away, -most, most) - mark.away) * family.sense * family.per_px;
    if abs(family.screen.y) > abs(family.screen.x) {
        return vec2(0.0, across / family.screen.y);
    }
    return vec2(across / family.screen.x, 0.0);
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
    let near = marks_at(nearest, family, rows, level, along, stroke, tone);
    // An old line may be so wide that it reaches beyond an inserted one.
    var wide = Marks(Mark(0.0, 0.0), Mark(0.0, 0.0));
    let aside = select(0.0, 2.0 * PASSING, stroke.gap < 0.0);
    let widest = stroke.spacing * (stroke.max_width * (1.0 + 0.5 * stroke.variation) + aside) + 2.0;
    if (i32(nearest) & 1) == 1 && widest > 0.5 * level.spacing {
        let even = nearest + select(-1.0, 1.0, rows.finer > nearest);
        wide = marks_at(even, family, rows, level, along, stroke, tone);
    }
    let nib = nib_of(stroke, family.screen);
    if !any_reach(near, nib) && !any_reach(wide, nib) {
        return 0.0;
    }
    // What crosses a narrow facet, or a dark edge, would be a tooth of a comb.
    let run = vec2(-family.screen.y, family.screen.x) / family.per_px;
    let enough = min(2.0 * stroke.spacing, FOLLOWED);
    let core = to_core(deeper(deeper(near.own, near.passing), deeper(wide.own, wide.passing)), family);
    let left = smoothstep(SHORT, 1.0, length_left(px, core, run, enough, number) / enough);
    return max(marks_ink(near, left, stroke, nib), marks_ink(wide, left, stroke, nib));
}
