//! How a practiced hand draws a straight line: its ends are off and overshot, it is slightly bowed, it trembles, and it is
//! firm at its ends.
//!
//! All of it depends on the line and on the number of the time that it is drawn, and is continuous in its length: strokes
//! move with the camera, and never jump.

use glam::DVec2;

/// Most times that a line is drawn.
const MAX_TIMES: u32 = 4;

/// Opacity of a line each time that it is drawn.
const DENSITIES: [f64; MAX_TIMES as usize] = [1.0, 0.85, 0.5, 0.5];

/// No random number with mean square 1 is greater.
const MAX_SPREAD: f64 = 3.47;

/// Greatest bow, reference pixels.
const MAX_BOW: f64 = 3.5;

/// Length of a wave of the tremor, reference pixels.
const WAVE: f64 = 110.0;

/// Up to the first of these lengths (reference pixels) a line is drawn as it is, from the second on as a stroke.
const FADE: [f64; 2] = [10.0, 26.0];

/// A hand that draws strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hand {
    /// How often each line is drawn, 1 to 4.
    pub times: u32,
    /// How far lines go on beyond their ends at most, reference pixels.
    pub overshoot: f32,
    /// How far ends are off: square root of the mean square in each direction, reference pixels.
    pub shift: f32,
    /// How far the middle is off: square root of the mean square, as a share of the length; at most 3.5 reference pixels.
    pub bow: f32,
    /// How far the rest is off, as `shift`.
    pub tremor: f32,
    /// Pixels of the picture per reference pixel.
    pub scale: f32,
    /// Another number, another drawing.
    pub seed: u32,
}

impl Hand {
    /// Nothing that it draws is farther from where it should be, px.
    pub fn reach(&self) -> f64 {
        let of = |number: f32| f64::from(number.max(0.0));
        // The shift is greater the second time, and has two directions.
        let spread = MAX_SPREAD * (1.15 * std::f64::consts::SQRT_2 * of(self.shift) + of(self.tremor));
        let bow = if self.bow > 0.0 { MAX_BOW } else { 0.0 };
        // What is bowed and shifted is overshot aslant.
        of(self.scale) * (spread + bow + 1.5 * of(self.overshoot))
    }

    /// How often each line is drawn.
    pub fn times(&self) -> u32 {
        self.times.clamp(1, MAX_TIMES)
    }

    /// Length from which a line is a stroke, px.
    pub fn min_length(&self) -> f64 {
        FADE[0] * f64::from(self.scale)
    }
}

/// A line as it is drawn one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandStroke {
    /// px, as all others.
    length: f64,
    /// How far both ends are off: along the line and to its left.
    shifts: [DVec2; 2],
    bow: f64,
    tremor: f64,
    wave: f64,
    hash: u32,
    /// How far it goes on beyond its ends.
    pub overshoots: [f64; 2],
    density: f64,
    /// How far the hand is seen at all, 0 to 1.
    fade: f64,
}

impl HandStroke {
    /// The line with this number (the same from view to view) and length (px), drawn for the `time`th time, counted from 0.
    /// `is_end`: whether the hand is lifted at each of its ends, or goes on with something that is no stroke.
    pub fn new(hand: &Hand, line: u32, time: u32, length: f64, is_end: [bool; 2]) -> Self {
        let scale = f64::from(hand.scale).max(1e-6);
        let hash = mix(line ^ mix(hand.seed ^ mix(time.wrapping_add(0x51))));
        let l = length / scale;
        let of = |number: f32| f64::from(number.max(0.0)) * scale;
        let fade = smooth(((l - FADE[0]) / (FADE[1] - FADE[0])).clamp(0.0, 1.0));
        let firmness = if time == 0 { 0.5 } else { 1.15 };
        let shift = of(hand.shift) * (l / 60.0 + 0.2).min(1.0) * firmness * fade;
        let overshoot = of(hand.overshoot) * (l / 90.0).min(1.0) * fade;
        let at_end = |end: usize, value: f64| if is_end[end] { value } else { 0.0 };
        let shift_of = |end: u32| {
            let spread = DVec2::new(normal(hash, 2 * end), normal(hash, 2 * end + 1));
            spread * at_end(end as usize, shift)
        };
        let bow = (normal(hash, 4) * f64::from(hand.bow) * l).clamp(-MAX_BOW, MAX_BOW) * scale * fade;
        Self {
            length,
            shifts: [shift_of(0), shift_of(1)],
            bow,
            tremor: of(hand.tremor) * (l / 80.0).min(1.0) * fade,
            wave: WAVE * scale,
            hash,
            overshoots: [0, 1].map(|end| {
                let share = 0.25 + 0.75 * uniform(hash, 5 + end);
                at_end(end as usize, overshoot * share)
            }),
            density: DENSITIES[time.min(MAX_TIMES - 1) as usize],
            fade,
        }
    }

    /// How far the point at this distance from the first end is off: along the line and to its left. Goes on straight beyond
    /// both ends.
    pub fn offset(&self, at: f64) -> DVec2 {
        let t = at / self.length;
        if !(0.0..=1.0).contains(&t) {
            let (end, inwards) = if t > 1.0 { (self.length, -1.0) } else { (0.0, 1.0) };
            // As steep as it is shortly before.
            let before = (0.05 * self.length).min(0.1 * self.wave);
            let slope = (self.offset(end) - self.offset(end + inwards * before)) / (-inwards * before);
            let here = self.offset(end);
            return if slope.is_finite() { DVec2::new(here.x, here.y + (at - end) * slope.y) } else { here };
        }
        let bow = self.bow * 4.0 * t * (1.0 - t);
        let tremor = self.tremor * noise(self.hash, (at - 0.5 * self.length) / self.wave);
        self.shifts[0].lerp(self.shifts[1], t) + DVec2::new(0.0, bow + tremor)
    }

    /// Opacity of the point at this distance from the first end, 0 to 1.
    pub fn weight(&self, at: f64) -> f64 {
        let t = (at / self.length).clamp(0.0, 1.0);
        let lightness = 0.35 * (std::f64::consts::PI * t).sin().max(0.0).powf(0.8);
        self.density * (1.0 - self.fade * lightness)
    }
}

/// A number of which every bit depends on every bit (Wellons, "lowbias32").
pub(super) fn mix(number: u32) -> u32 {
    let mut x = number;
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ x >> 16
}

/// 0 to 1.
fn uniform(hash: u32, number: u32) -> f64 {
    f64::from(mix(hash ^ mix(number.wrapping_add(0x9e37)))) / f64::from(u32::MAX)
}

/// Nearly normally distributed, with mean 0 and mean square 1, and never beyond [`MAX_SPREAD`].
fn normal(hash: u32, number: u32) -> f64 {
    let sum: f64 = (0..4).map(|part| uniform(hash, 64 + 4 * number + part)).sum();
    (sum - 2.0) * 3_f64.sqrt()
}

fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

/// Smooth noise along a line with a mean square of about 1, never beyond [`MAX_SPREAD`].
fn noise(hash: u32, at: f64) -> f64 {
    let cell = at.floor();
    let value = |cell: f64| 12_f64.sqrt() * (uniform(hash, 1024_u32.wrapping_add_signed(cell as i32)) - 0.5);
    let t = smooth(at - cell);
    // Between two values the mean square would be less.
    let least = (t * t + (1.0 - t) * (1.0 - t)).sqrt();
    let mean = value(cell) * (1.0 - t) + value(cell + 1.0) * t;
    (mean / least).clamp(-MAX_SPREAD, MAX_SPREAD)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HAND: Hand =
        Hand { times: 2, overshoot: 14.0, shift: 1.6, bow: 0.006, tremor: 0.55, scale: 1.5, seed: 3 };

    fn lines() -> impl Iterator<Item = (u32, u32)> {
        (0..400).flat_map(|line| (0..4).map(move |time| (mix(line), time)))
    }

    #[test]
    fn nothing_is_farther_off_than_the_hand_reaches() {
        for (line, time) in lines() {
            for length in [1.0, 20.0, 90.0, 700.0, 9000.0] {
                let stroke = HandStroke::new(&HAND, line, time, length, [true; 2]);
                let [before, after] = stroke.overshoots;
                assert!(before <= 14.0 * 1.5 && after <= 14.0 * 1.5 && before >= 0.0 && after >= 0.0);
                for i in 0..=50 {
                    let t = f64::from(i) / 50.0;
                    assert!(stroke.offset(t * length).length() < HAND.reach());
                    assert!((0.0..=1.0).contains(&stroke.weight(t * length)));
                }
                for (at, over) in [(-before, before), (length + after, after)] {
                    assert!(stroke.offset(at).length() + over < HAND.reach());
                }
            }
        }
    }

    #[test]
    fn a_hand_without_faults_draws_the_line_itself() {
        let hand = Hand { times: 1, overshoot: 0.0, shift: 0.0, bow: 0.0, tremor: 0.0, ..HAND };
        assert!(hand.reach() == 0.0);
        for (line, time) in lines() {
            let stroke = HandStroke::new(&hand, line, time, 300.0, [true; 2]);
            assert!(stroke.overshoots == [0.0; 2]);
            assert!((0..=20).all(|i| stroke.offset(15.0 * f64::from(i)) == DVec2::ZERO));
        }
    }

    #[test]
    fn strokes_are_continuous_in_the_length_and_along_it() {
        for (line, time) in lines() {
            for length in [9.99, 10.0, 26.0, 48.0, 60.0, 80.0, 90.0, 583.3, 2000.0_f64] {
                let length = 1.5 * length;
                let [one, two] =
                    [length, length + 0.01].map(|l| HandStroke::new(&HAND, line, time, l, [true; 2]));
                for i in 0..=40 {
                    let at = length * f64::from(i) / 40.0;
                    assert!(one.offset(at).distance(two.offset(at)) < 0.01);
                    assert!((one.weight(at) - two.weight(at)).abs() < 0.02);
                    assert!(one.offset(at).distance(one.offset(at + 0.01)) < 0.01);
                }
                let overshoots = [0, 1].map(|end| (one.overshoots[end] - two.overshoots[end]).abs());
                assert!(overshoots.iter().all(|d| *d < 0.01), "{overshoots:?}");
            }
        }
    }

    #[test]
    fn each_line_time_and_seed_has_numbers_of_its_own() {
        let strokes: Vec<HandStroke> =
            lines().map(|(line, time)| HandStroke::new(&HAND, line, time, 500.0, [true; 2])).collect();
        let mean = |f: &dyn Fn(&HandStroke) -> f64| strokes.iter().map(f).sum::<f64>() / strokes.len() as f64;
        assert!(mean(&|s| s.shifts[0].x).abs() < 0.2 && mean(&|s| s.bow).abs() < 0.3);
        let square = mean(&|s| (s.shifts[1].y / 2.4).powi(2));
        // A quarter of them are half as far off, the others 1.15 times.
        assert!((square - (0.25 * 0.25 + 0.75 * 1.3225)).abs() < 0.1, "{square}");
        let other = Hand { seed: 4, ..HAND };
        let again = HandStroke::new(&other, mix(0), 0, 500.0, [true; 2]);
        assert!(strokes[0] != strokes[1] && strokes[0] != strokes[4] && strokes[0] != again);
    }

    #[test]
    fn where_the_hand_goes_on_nothing_is_overshot_nor_shifted() {
        let stroke = HandStroke::new(&Hand { tremor: 0.0, ..HAND }, 5, 1, 500.0, [false, true]);
        assert!(stroke.offset(0.0) == DVec2::ZERO && stroke.overshoots[0] == 0.0);
        assert!(stroke.offset(500.0).length() > 0.01 && stroke.overshoots[1] > 1.0);
    }
}
