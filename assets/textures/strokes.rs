//! Crossed strokes and stipple: strokes in an order of which each beginning is spread evenly.
//!
//! Where strokes lie is the same in every octave: the set of their places is closed under doubling, so that the places
//! of the next octave, (p + {0,1}²) / 2, contain those of this one, and strokes only ever come in between (a self-similar
//! seed set; Szécsi and Szirányi 2016, "Recursive Procedural Tonal Art Maps"). Such sets are made of orbits: the
//! multiples p, 2p, 4p, … of a fraction come back to p.

use hachure::render::effects::halftone::threshold_map::{PERIODS, SIDE};

/// Places are fractions of a tile with this denominator, 2⁷ − 1: then all orbits have seven places.
const DENOMINATOR: u32 = 127;
const ORBIT: usize = 7;

/// Strokes of one direction.
struct Family {
    /// Degrees from the x axis.
    direction: f32,
    /// From end to end, in periods; 0: dots.
    length: f32,
    /// Half the width, in periods.
    half_width: f32,
    /// How many strokes there are, in orbits.
    orbits: usize,
    /// Priorities of its first and last stroke.
    priority: [f32; 2],
}

/// Crossed strokes: a direction is filled before the next one begins.
const STROKES: [Family; 4] = [
    Family { direction: 4.0, length: 6.0, half_width: 0.17, orbits: 26, priority: [1.0, 0.6] },
    Family { direction: 68.0, length: 5.5, half_width: 0.17, orbits: 28, priority: [0.6, 0.3] },
    Family { direction: -52.0, length: 5.0, half_width: 0.17, orbits: 30, priority: [0.3, 0.12] },
    Family { direction: 34.0, length: 5.0, half_width: 0.17, orbits: 30, priority: [0.12, 0.0] },
];

const STIPPLE: [Family; 1] =
    [Family { direction: 0.0, length: 0.0, half_width: 0.36, orbits: 140, priority: [1.0, 0.0] }];

/// By how much later than its middle a stroke's rim is inked: strokes get wider while others come.
const SOFTNESS: f32 = 0.22;
/// Fall of the priority beyond the rim, per half width: steep, but over a few texels.
const RIM: f32 = 3.0;
/// Where no stroke is, the paper is inked last, and near strokes first.
const GAP: f32 = 0.05;
/// So far from its middle line a stroke still matters, in half widths.
const REACH: f32 = 5.0;

/// One stroke of the first step.
#[derive(Clone, Copy)]
struct Stroke {
    place: [f32; 2],
    /// The place before it in its orbit, of which it is the double.
    half: [f32; 2],
    /// Unit vector along it.
    along: [f32; 2],
    half_length: f32,
    half_width: f32,
    /// How far the ends are bent aside.
    bend: f32,
    priority: f32,
    /// Number of its orbit.
    orbit: usize,
}

/// A number 0 to 1 that looks random.
fn hash(a: usize, b: usize) -> f32 {
    let mut h = (a as u32).wrapping_mul(0x9e37_79b9) ^ (b as u32).wrapping_mul(0x85eb_ca6b);
    h ^= h >> 16;
    h = h.wrapping_mul(0x7feb_352d);
    h ^= h >> 15;
    h = h.wrapping_mul(0x846c_a68b);
    h ^= h >> 16;
    h as f32 / u32::MAX as f32
}

/// All orbits of places: each lattice point but the origin is in one of them.
fn orbits() -> Vec<[[u32; 2]; ORBIT]> {
    let mut seen = vec![false; (DENOMINATOR * DENOMINATOR) as usize];
    let mut orbits = Vec::new();
    for i in 1..DENOMINATOR * DENOMINATOR {
        if seen[i as usize] {
            continue;
        }
        let mut place = [i % DENOMINATOR, i / DENOMINATOR];
        orbits.push(std::array::from_fn(|_| {
            seen[(place[1] * DENOMINATOR + place[0]) as usize] = true;
            let doubled = place.map(|c| 2 * c % DENOMINATOR);
            std::mem::replace(&mut place, doubled)
        }));
    }
    orbits
}

/// Squared distances on the torus, shortened along strokes: those of one direction shall lie beside each other.
struct Metric {
    squared: Vec<f32>,
}

impl Metric {
    fn new(family: &Family) -> Self {
        let (sin, cos) = family.direction.to_radians().sin_cos();
        // Strokes that follow one another in a row keep more distance than strokes side by side.
        let stretch = 1.0 / (0.8 * family.length).max(1.0);
        let n = DENOMINATOR as i32;
        let squared = (0..n * n)
            .map(|i| {
                let wrapped = |c: i32| if c > n / 2 { c - n } else { c };
                // A slanted metric is not the torus's own: the nearest of all copies counts.
                (0..9)
                    .map(|copy| {
                        let x = (wrapped(i % n) + (copy % 3 - 1) * n) as f32;
                        let y = (wrapped(i / n) + (copy / 3 - 1) * n) as f32;
                        let (along, across) = (x * cos + y * sin, y * cos - x * sin);
                        (along * stretch).powi(2) + across * across
                    })
                    .fold(f32::INFINITY, f32::min)
            })
            .collect();
        Self { squared }
    }

    fn between(&self, a: [u32; 2], b: [u32; 2]) -> f32 {
        let [x, y] = [0, 1].map(|i| (a[i] + DENOMINATOR - b[i]) % DENOMINATOR);
        self.squared[(y * DENOMINATOR + x) as usize]
    }
}

/// The best orbits of a family in order: each is the one that keeps the greatest distance from those before it.
fn spread(family: &Family, orbits: &[[[u32; 2]; ORBIT]]) -> Vec<usize> {
    let metric = Metric::new(family);
    // Distance of each orbit from itself and from all that were taken.
    let mut distance: Vec<f32> = orbits
        .iter()
        .map(|orbit| {
            let pairs = (0..ORBIT).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs.map(|(i, j)| metric.between(orbit[i], orbit[j])).fold(f32::INFINITY, f32::min)
        })
        .collect();
    let mut taken = Vec::with_capacity(family.orbits);
    for _ in 0..family.orbits {
        let best = distance.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(i, _)| i);
        taken.push(best);
        for (orbit, least) in orbits.iter().zip(&mut distance) {
            // Doubling maps both orbits to themselves, so one place of the one and all of the other meet every pair
            // up to doubling; but distances double too, so all pairs are compared.
            for a in orbit {
                for b in &orbits[best] {
                    *least = least.min(metric.between(*a, *b));
                }
            }
        }
    }
    taken
}

fn strokes(families: &[Family]) -> Vec<Stroke> {
    let orbits = orbits();
    let mut strokes = Vec::new();
    let period = 1.0 / PERIODS as f32;
    for (number, family) in families.iter().enumerate() {
        for (n, orbit) in spread(family, &orbits).into_iter().enumerate() {
            let share = n as f32 / family.orbits as f32;
            let random = |what: usize| hash(number * 1000 + n, what) - 0.5;
            let angle = (family.direction + 7.0 * random(0)).to_radians();
            let place = |p: [u32; 2]| p.map(|c| c as f32 / DENOMINATOR as f32);
            let half_length = 0.5 * family.length * period * (1.0 + 0.5 * random(1));
            let orbit = &orbits[orbit];
            strokes.extend((0..ORBIT).map(|i| Stroke {
                place: place(orbit[i]),
                half: place(orbit[(i + ORBIT - 1) % ORBIT]),
                along: [angle.cos(), angle.sin()],
                half_length,
                half_width: family.half_width * period * (1.0 + 0.4 * random(2)),
                bend: half_length * 0.12 * random(3),
                priority: family.priority[0] + (family.priority[1] - family.priority[0]) * share,
                orbit: number * 1000 + n,
            }));
        }
    }
    strokes
}

/// The strokes of a step, in places of the tile: those of the octave, and of each four of the next one that belong to
/// one of them, the three that are not among them.
fn at_step(strokes: &[Stroke], step: f32) -> Vec<Stroke> {
    let scale = 0.5f32.powf(step);
    // Strokes of constant size on the screen: so many more of them fit.
    let grown = (4.0f32.powf(step) - 1.0) / 3.0;
    let sized = |s: &Stroke, place, strength: f32| Stroke {
        place,
        half_length: s.half_length * scale,
        half_width: s.half_width * scale,
        bend: s.bend * scale,
        priority: s.priority * strength - (1.0 - strength) * 0.5,
        ..*s
    };
    let mut all: Vec<_> = strokes.iter().map(|s| sized(s, s.place, 1.0)).collect();
    if step == 0.0 {
        return all;
    }
    for parent in strokes {
        // The one opposite to it comes first, as in an ordered dither.
        for (n, [x, y]) in [[0.5, 0.5], [0.5, 0.0], [0.0, 0.5]].into_iter().enumerate() {
            let begin = (n as f32 + hash(parent.orbit, n)) / 3.0 * 0.8;
            let strength = ((grown - begin) / 0.2).clamp(0.0, 1.0);
            if strength > 0.0 {
                all.push(sized(parent, [(parent.half[0] + x) % 1.0, (parent.half[1] + y) % 1.0], strength));
            }
        }
    }
    all
}

impl Stroke {
    /// The priority of a point at an offset from the stroke's place, in tiles.
    fn priority_at(&self, x: f32, y: f32) -> f32 {
        let along = x * self.along[0] + y * self.along[1];
        let mut across = y * self.along[0] - x * self.along[1];
        let s = if self.half_length > 0.0 { (along / self.half_length).clamp(-1.0, 1.0) } else { 0.0 };
        across -= self.bend * s * s;
        let beyond = along - s * self.half_length;
        let distance = (across * across + beyond * beyond).sqrt();
        // Pressed in the middle, lifted at the ends.
        let half_width =
            if self.half_length > 0.0 { 1.0 - 0.7 * s * s * s.abs() } else { 1.0 } * self.half_width;
        if distance <= half_width {
            let x = distance / half_width;
            return self.priority - SOFTNESS * x * x;
        }
        let x = (distance - half_width) / self.half_width;
        (self.priority - SOFTNESS - RIM * x).max(-0.5 - SOFTNESS - GAP * x)
    }

    /// Raises the priorities of all texels that it reaches.
    fn draw(&self, texels: &mut [f32]) {
        let side = SIDE as f32;
        let margin = REACH * self.half_width;
        let [reach_x, reach_y] = self.along.map(|c| c.abs() * self.half_length + margin);
        let range = |center: f32, reach: f32| {
            ((center - reach) * side).floor() as i32..=((center + reach) * side).ceil() as i32
        };
        for row in range(self.place[1], reach_y) {
            let y = (row as f32 + 0.5) / side - self.place[1];
            let line = row.rem_euclid(SIDE as i32) as usize * SIDE;
            for column in range(self.place[0], reach_x) {
                let x = (column as f32 + 0.5) / side - self.place[0];
                if (y * self.along[0] - x * self.along[1]).abs() > margin {
                    continue;
                }
                if let Some(texel) = texels.get_mut(line + column.rem_euclid(SIDE as i32) as usize) {
                    *texel = texel.max(self.priority_at(x, y));
                }
            }
        }
    }
}

/// Priorities of crossed strokes at a place in the octave.
pub(crate) fn crossed_strokes() -> impl Fn(f32) -> Vec<f32> + Sync {
    drawn(strokes(&STROKES))
}

/// Priorities of dots that are strewn evenly.
pub(crate) fn stipple() -> impl Fn(f32) -> Vec<f32> + Sync {
    drawn(strokes(&STIPPLE))
}

fn drawn(strokes: Vec<Stroke>) -> impl Fn(f32) -> Vec<f32> + Sync {
    move |step| {
        let mut texels = vec![-1.0; SIDE * SIDE];
        for stroke in at_step(&strokes, step) {
            stroke.draw(&mut texels);
        }
        texels
    }
}
