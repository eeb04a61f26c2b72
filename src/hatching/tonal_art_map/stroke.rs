//! One stroke: what it looks like, and which texels it covers.

use std::sync::Arc;

use super::stroke_image::{Scaled, StrokeImage};

/// What strokes of a map look like. They run along +x.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokeShape {
    /// Length as a share of the tile's side, 0 (dots) to 1.
    pub length: f32,
    /// Strokes are longer or shorter by up to this share, 0 to 1.
    pub length_spread: f32,
    /// Width in texels of each level, 0.25 to 32.
    pub width: f32,
    /// Strokes are wider or narrower by up to this share, 0 to 1.
    pub width_spread: f32,
    /// Share of the length over which the stroke gets wider at its beginning and thinner at its end, each 0 to 1.
    /// Without effect on images.
    pub taper: [f32; 2],
    /// How far strokes swing to either side, as a share of their length, 0 to 0.25.
    pub waviness: f32,
    /// Strokes are turned by up to this to either side, radians, 0 to 0.5.
    pub angle_spread: f32,
    /// Ink of a single stroke, above 0 to 1.
    pub pressure: f32,
    /// How much ink the paper's valleys take away, 0 to 0.9; of the size of texels.
    pub grain: f32,
    /// A picture of a stroke from left to right, instead of a drawn line.
    pub image: Option<Arc<StrokeImage>>,
}

impl Default for StrokeShape {
    fn default() -> Self {
        Self {
            length: 0.3,
            length_spread: 0.4,
            width: 1.6,
            width_spread: 0.2,
            taper: [0.1, 0.3],
            waviness: 0.008,
            angle_spread: 0.03,
            pressure: 1.0,
            grain: 0.0,
            image: None,
        }
    }
}

/// A stroke in its place. Lengths are shares of the tile's side, except its width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its middle, 0 to 1.
    pub middle: [f32; 2],
    /// From end to end.
    pub length: f32,
    /// In texels.
    pub width: f32,
    /// Radians from the x axis towards +y.
    pub angle: f32,
    /// How far it swings to the side, in a long and a short wave.
    pub swing: [f32; 2],
    /// Where the waves begin, 0 to 1.
    pub phase: [f32; 2],
    /// Whether its image is turned upside down.
    pub is_flipped: bool,
}

/// Twelve numbers that look random, 0 to 1, always the same for the same seed and number.
pub fn random(seed: u64, number: u64) -> [f32; 12] {
    // SplitMix64 (Steele et al. 2014).
    let mut state = seed.wrapping_mul(0xd129_0d3b_35a6_7f4d) ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    std::array::from_fn(|_| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    })
}

impl StrokeShape {
    /// A stroke of this shape somewhere in the tile.
    pub fn stroke(&self, [x, y, l, w, a, s, t, p, q, f, ..]: [f32; 12]) -> Stroke {
        let about = |r: f32| 2.0 * r - 1.0;
        let length = (self.length * (1.0 + self.length_spread * about(l))).clamp(0.0, 1.0);
        Stroke {
            middle: [x, y],
            length,
            width: self.width * (1.0 + self.width_spread * about(w)),
            // Two numbers: small angles are more frequent than large ones.
            angle: self.angle_spread * 0.5 * (about(a) + about(q)),
            swing: [length * self.waviness * about(s), 0.4 * length * self.waviness * about(t)],
            phase: [p, q],
            is_flipped: self.image.is_some() && f > 0.5,
        }
    }

    /// Half the width in texels at a place along the stroke, 0 to 1.
    fn half_width(&self, stroke: &Stroke, u: f32) -> f32 {
        let share = |c: f32, taper: f32| if c < taper { (c / taper).sqrt() } else { 1.0 };
        let [begin, end] = self.taper;
        0.5 * stroke.width * if stroke.length > 0.0 { share(u, begin) * share(1.0 - u, end) } else { 1.0 }
    }
}

/// Draws strokes of a shape at one resolution.
#[derive(Debug)]
pub struct Brush {
    shape: StrokeShape,
    side: usize,
    scaled: Option<Scaled>,
    /// Share of ink that the paper takes at each texel; empty: all of it.
    grain: Vec<f32>,
}

impl Brush {
    /// For tiles of `side` texels, a power of two.
    pub fn new(shape: &StrokeShape, side: usize) -> Self {
        let length = (shape.length * side as f32).ceil() as usize;
        let scaled = shape.image.as_ref().map(|image| image.scaled(length, shape.width.ceil() as usize));
        let kept = |texel: usize| {
            let [first, second, ..] = random(GRAIN, texel as u64);
            1.0 - shape.grain * first.max(second)
        };
        let grain = if shape.grain > 0.0 { (0..side * side).map(kept).collect() } else { Vec::new() };
        Self { shape: shape.clone(), side, scaled, grain }
    }

    /// Calls `visit` with the number and the ink, above 0 to 1, of each texel that a stroke covers. A texel may come twice
    /// where a stroke meets its own beginning.
    pub fn visit(&self, stroke: &Stroke, mut visit: impl FnMut(usize, f32)) {
        let (side, mask) = (self.side as f32, self.side.saturating_sub(1));
        let (sin, cos) = stroke.angle.sin_cos();
        let half = 0.5 * stroke.length * cos * side;
        let [x, y] = stroke.middle.map(|c| c * side);
        let reach = 0.5 * stroke.width + 0.5;
        for column in below(x - half - reach + 0.5)..=below(x + half + reach - 0.5) {
            let offset = column as f32 + 0.5 - x;
            let on_line = offset.clamp(-half, half);
            let beyond = offset - on_line;
            let u = if half > 0.0 { (0.5 * (on_line / half + 1.0)).clamp(0.0, 1.0) } else { 0.5 };
            let aside: f32 = [0.8, 2.3]
                .iter()
                .zip(stroke.swing.iter().zip(&stroke.phase))
                .map(|(turns, (swing, phase))| swing * wave(u * turns + phase))
                .sum();
            let center = y + (on_line * sin / cos) + aside * side;
            let half_width = self.shape.half_width(stroke, u);
            let reach = if self.scaled.is_some() { reach } else { half_width + 0.5 };
            let image = self.scaled.as_ref().map(|image| (image, image.along(u)));
            let sign = if stroke.is_flipped { -1.0 } else { 1.0 };
            for row in below(center - reach + 0.5)..=below(center + reach - 0.5) {
                let across = row as f32 + 0.5 - center;
                let cover = match &image {
                    None if beyond == 0.0 => covered(half_width, across.abs()),
                    None => covered(half_width, (across * across + beyond * beyond).sqrt()),
                    Some((image, along)) if beyond.abs() <= 1.0 => {
                        let v = sign * across / stroke.width;
                        image.ink(*along, v + 0.5)
                    }
                    Some(_) => 0.0,
                };
                // Sides are powers of two.
                let texel = (row as usize & mask) * self.side + (column as usize & mask);
                let ink = cover * self.shape.pressure * self.grain.get(texel).copied().unwrap_or(1.0);
                if ink > MIN_INK {
                    visit(texel, ink);
                }
            }
        }
    }

    /// Sums over the texels that a stroke covers: of their ink times a weight of each, and of their ink.
    pub fn weighed(&self, stroke: &Stroke, weights: &[f32]) -> [f32; 2] {
        let mut sums = [0.0; 2];
        self.visit(stroke, |texel, ink| {
            sums[0] += ink * weights.get(texel).copied().unwrap_or_default();
            sums[1] += ink;
        });
        sums
    }
}

/// Less ink than this is none.
const MIN_INK: f32 = 1.0 / 512.0;
/// Seed of the paper's grain.
const GRAIN: u64 = 17;

/// The next whole number below one that is greater than −65 536.
fn below(number: f32) -> i32 {
    // `floor` is a function call on many processors.
    (number + 65536.0) as i32 - 65536
}

/// A wave of period 1 between −1 and 1, of parabolas: the same on all systems. `t` is not negative.
fn wave(t: f32) -> f32 {
    let t = t - (t as i32) as f32 - 0.5;
    16.0 * t * (0.5 - t.abs())
}

/// Share of a texel that is covered by a line of half a width in texels, at a distance from the line's middle.
fn covered(half_width: f32, distance: f32) -> f32 {
    // A thinner line than a texel is a fainter one.
    (half_width + 0.5 - distance).clamp(0.0, (2.0 * half_width).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stroke(middle: [f32; 2], width: f32) -> Stroke {
        let (swing, phase) = ([0.0; 2], [0.0; 2]);
        Stroke { middle, length: 0.5, width, angle: 0.0, swing, phase, is_flipped: false }
    }

    fn drawn(shape: &StrokeShape, stroke: &Stroke) -> Vec<f32> {
        let mut tile = vec![0.0; 64 * 64];
        Brush::new(shape, 64).visit(stroke, |texel, ink| tile[texel] += ink);
        tile
    }

    #[test]
    fn a_stroke_has_the_ink_of_its_area() {
        let shape = StrokeShape { taper: [0.0; 2], ..StrokeShape::default() };
        for width in [0.4f32, 1.0, 1.7, 5.0] {
            for y in [0.5, 0.503, 0.508] {
                let ink: f32 = drawn(&shape, &stroke([0.5, y], width)).iter().sum();
                // Its ends are round.
                let area = 32.0 * width + std::f32::consts::PI * 0.25 * width * width;
                assert!((ink / area - 1.0).abs() < 0.05, "{width} at {y}: {ink} {area}");
            }
        }
    }

    #[test]
    fn strokes_go_on_at_the_opposite_side() {
        let shape = StrokeShape::default();
        let whole = drawn(&shape, &stroke([0.5, 0.5], 3.0));
        let across = drawn(&shape, &stroke([0.0, 0.0], 3.0));
        for (i, ink) in whole.iter().enumerate() {
            let (x, y) = ((i % 64 + 32) % 64, (i / 64 + 32) % 64);
            assert!((across[y * 64 + x] - ink).abs() < 1e-4);
        }
    }

    #[test]
    fn strokes_taper_towards_their_ends() {
        let shape = StrokeShape { taper: [0.1, 0.8], ..StrokeShape::default() };
        let tile = drawn(&shape, &stroke([0.5, 0.5], 6.0));
        let width = |x: usize| (0..64).map(|y| tile[y * 64 + x]).sum::<f32>();
        assert!(
            width(20) > 5.5
                && width(34) < 5.0
                && width(34) > width(42)
                && width(46) < 1.6
                && width(52) == 0.0
        );
    }
}
