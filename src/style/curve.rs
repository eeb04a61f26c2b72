//! Curves as people draw them: a few points, and a monotone cubic between them.

/// A point of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point {
    /// What goes in, from 0 to 1.
    pub x: f32,
    /// What comes out, from 0 to 1.
    pub y: f32,
}

impl From<[f32; 2]> for Point {
    fn from([x, y]: [f32; 2]) -> Self {
        Self { x, y }
    }
}

/// A function from 0..=1 to 0..=1 through a few points, the first at x = 0, the last at x = 1. Written `x,y,x,y,…`.
///
/// Between points it is a cubic that rises where they rise and falls where they fall, and never leaves the heights of the
/// two points beside it (Fritsch, Carlson: Monotone Piecewise Cubic Interpolation, SIAM J. Numer. Anal. 17(2), 1980).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    /// In order of x; those beyond `count` are zero, so that equal curves are equal.
    points: [Point; Self::MAX_POINTS],
    /// At least [`Self::MIN_POINTS`].
    count: usize,
}

/// Why some points are no curve. Points are counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// Too few or too many.
    #[error("a curve has {} to {} points, not {count}", Curve::MIN_POINTS, Curve::MAX_POINTS)]
    Count {
        /// How many there are.
        count: usize,
    },
    /// A coordinate is no number from 0 to 1.
    #[error("{axis} = {found} of point {point} is out of range: 0 to 1")]
    OutOfRange {
        /// Which point.
        point: usize,
        /// `x` or `y`.
        axis: char,
        /// The coordinate.
        found: f32,
    },
    /// The first or the last point stands elsewhere than at the end.
    #[error("point {point} has x = {found}; the first point has x = 0 and the last one x = 1")]
    End {
        /// Which point.
        point: usize,
        /// Its x.
        found: f32,
    },
    /// A point is not far enough to the right of the one before it.
    #[error(
        "point {point} has x = {found} after x = {before}; x grows from point to point, by {} at least",
        Curve::MIN_GAP
    )]
    Order {
        /// Which point.
        point: usize,
        /// Its x.
        found: f32,
        /// The x before it.
        before: f32,
    },
}

/// Gaps that are this much too small are taken for rounded ones.
const ROUNDING: f32 = 1e-5;

impl Default for Curve {
    fn default() -> Self {
        Self::LINEAR
    }
}

impl Curve {
    /// Fewest points.
    pub const MIN_POINTS: usize = 2;

    /// Most points.
    pub const MAX_POINTS: usize = 8;

    /// How far apart in x points are at least.
    pub const MIN_GAP: f32 = 0.01;

    /// What goes in comes out.
    pub const LINEAR: Self = {
        let mut points = [Point { x: 0.0, y: 0.0 }; Self::MAX_POINTS];
        points[1] = Point { x: 1.0, y: 1.0 };
        Self { points, count: 2 }
    };

    /// Through these points.
    ///
    /// # Errors
    /// The first thing that is wrong with them.
    pub fn of_points(points: &[Point]) -> Result<Self, CurveError> {
        let count = points.len();
        if !(Self::MIN_POINTS..=Self::MAX_POINTS).contains(&count) {
            return Err(CurveError::Count { count });
        }
        let mut curve = Self { points: [Point::default(); Self::MAX_POINTS], count };
        let mut before = None;
        for ((point, place), to) in (1..).zip(points).zip(&mut curve.points) {
            for (axis, found) in [('x', place.x), ('y', place.y)] {
                if !(0.0..=1.0).contains(&found) {
                    return Err(CurveError::OutOfRange { point, axis, found });
                }
            }
            let found = place.x;
            if point == 1 && found != 0.0 {
                return Err(CurveError::End { point, found });
            }
            if let Some(before) = before.filter(|before| found - before < Self::MIN_GAP - ROUNDING) {
                return Err(CurveError::Order { point, found, before });
            }
            if point == count && found != 1.0 {
                return Err(CurveError::End { point, found });
            }
            before = Some(found);
            // No zero is negative.
            *to = Point { x: place.x + 0.0, y: place.y + 0.0 };
        }
        Ok(curve)
    }

    /// Its points, in order of x.
    pub fn points(&self) -> &[Point] {
        self.points.get(..self.count).unwrap_or(&self.points)
    }

    /// The value at `x`, from 0 to 1. What is no number counts as 0, what lies outside of 0 to 1 as the nearer end.
    pub fn at(&self, x: f32) -> f32 {
        self.cubic(&self.tangents(), x)
    }

    /// `count` values at even steps from x = 0 to x = 1, for a device that interpolates between them.
    pub fn table(&self, count: usize) -> Vec<f32> {
        let tangents = self.tangents();
        let last = count.saturating_sub(1).max(1) as f32;
        (0..count).map(|i| self.cubic(&tangents, i as f32 / last)).collect()
    }

    fn segments(&self) -> impl Iterator<Item = (Point, Point)> {
        self.points().iter().copied().zip(self.points().iter().copied().skip(1))
    }

    /// The slope at each point: the mean of those of the lines beside it, 0 at a crest or a dip, at an end that of the one
    /// line; less steep where the cubic would leave the heights of its ends.
    fn tangents(&self) -> [f32; Self::MAX_POINTS] {
        let secants: Vec<f32> = self.segments().map(|(a, b)| (b.y - a.y) / (b.x - a.x)).collect();
        let mut tangents = [0.0; Self::MAX_POINTS];
        let before = secants.first().into_iter().chain(&secants);
        let after = secants.iter().chain(secants.last());
        for (tangent, (before, after)) in tangents.iter_mut().zip(before.zip(after)) {
            *tangent = if before * after > 0.0 { (before + after) / 2.0 } else { 0.0 };
        }
        for (i, secant) in secants.iter().enumerate().filter(|(_, secant)| **secant != 0.0) {
            if let Some([from, to]) = tangents.get_mut(i..i + 2) {
                let steepness = (*from / secant).hypot(*to / secant);
                let factor = if steepness > 3.0 { 3.0 / steepness } else { 1.0 };
                *from *= factor;
                *to *= factor;
            }
        }
        tangents
    }

    fn cubic(&self, tangents: &[f32; Self::MAX_POINTS], x: f32) -> f32 {
        let x = if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) };
        let slopes = tangents.iter().zip(tangents.iter().skip(1));
        let segment = self.segments().zip(slopes).find(|((_, b), _)| x <= b.x);
        let Some(((a, b), (from, to))) = segment else {
            return self.points().last().map_or(x, |last| last.y);
        };
        let width = b.x - a.x;
        let t = (x - a.x) / width;
        let left = 1.0 - t;
        let heights = left * left * (1.0 + 2.0 * t) * a.y + t * t * (1.0 + 2.0 * left) * b.y;
        let slopes = left * left * t * from - t * t * left * to;
        // Against rounding.
        (heights + width * slopes).clamp(a.y.min(b.y), a.y.max(b.y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(numbers: &[[f32; 2]]) -> Vec<Point> {
        numbers.iter().copied().map(Point::from).collect()
    }

    fn curve(numbers: &[[f32; 2]]) -> Curve {
        Curve::of_points(&points(numbers)).unwrap()
    }

    fn error(numbers: &[[f32; 2]]) -> String {
        Curve::of_points(&points(numbers)).unwrap_err().to_string()
    }

    const STEEP: [[f32; 2]; 5] = [[0.0, 0.0], [0.3, 0.02], [0.31, 0.9], [0.8, 0.9], [1.0, 1.0]];
    const HILLS: [[f32; 2]; 6] = [[0.0, 0.7], [0.1, 0.1], [0.4, 0.8], [0.5, 0.8], [0.9, 0.0], [1.0, 1.0]];

    #[test]
    fn a_curve_goes_through_its_points_and_never_beyond_them() {
        for numbers in [&STEEP[..], &HILLS] {
            let curve = curve(numbers);
            assert_eq!(curve.points(), points(numbers));
            for pair in numbers.windows(2) {
                let [[from, low], [to, high]] = [pair[0], pair[1]];
                assert_eq!((curve.at(from), curve.at(to)), (low, high));
                let values = (0..=50).map(|i| curve.at(from + (to - from) * i as f32 / 50.0));
                let values: Vec<f32> = values.collect();
                let rises = values.is_sorted_by(|a, b| *b >= a - 1e-6);
                let falls = values.is_sorted_by(|a, b| *b <= a + 1e-6);
                assert!(if high >= low { rises } else { falls }, "{pair:?}: {values:?}");
            }
        }
    }

    #[test]
    fn slopes_are_those_of_the_paper() {
        // Secants 0.5 and 1.5; nothing is too steep.
        let gentle = curve(&[[0.0, 0.0], [0.5, 0.25], [1.0, 1.0]]);
        assert_eq!(gentle.tangents()[..3], [0.5, 1.0, 1.5]);
        // The middle of a cubic of Hermite: (y0 + y1) / 2 + h (m0 - m1) / 8.
        assert!((gentle.at(0.25) - (0.125 - 0.5 * 0.5 / 8.0)).abs() < 1e-6);
        assert!((gentle.at(0.75) - (0.625 - 0.5 * 0.5 / 8.0)).abs() < 1e-6);
        let steep = curve(&[[0.0, 0.0], [0.5, 0.0625], [1.0, 1.0]]);
        // Secants 1/8 and 15/8, their mean 1 is 8 times the first; (1, 8) is brought to length 3.
        let factor = 3.0 / 65.0_f32.sqrt();
        let [first, middle, last] = [0.125 * factor, factor, 1.875];
        for (found, expected) in steep.tangents().into_iter().zip([first, middle, last]) {
            assert!((found - expected).abs() < 1e-6, "{found} {expected}");
        }
        assert_eq!(curve(&HILLS).tangents()[1..5], [0.0; 4], "flat on crests and in dips");
    }

    #[test]
    fn slopes_do_not_jump() {
        const KINKS: [f32; 3] = [0.25, 0.5, 0.75];
        let curve = curve(&[[0.0, 0.0], [KINKS[0], 0.1], [KINKS[1], 0.5], [KINKS[2], 0.6], [1.0, 1.0]]);
        let step = 1e-3;
        for x in KINKS {
            let [left, right] = [curve.at(x) - curve.at(x - step), curve.at(x + step) - curve.at(x)];
            assert!((left - right).abs() < 0.1 * step, "{x}: {left} {right}");
        }
    }

    #[test]
    fn two_points_are_a_line_and_whatever_goes_in_is_held_back() {
        for i in 0..=16 {
            let x = i as f32 / 16.0;
            assert!((Curve::LINEAR.at(x) - x).abs() < 1e-6);
        }
        let falling = curve(&[[0.0, 0.9], [1.0, 0.1]]);
        assert!((falling.at(0.25) - 0.7).abs() < 1e-6);
        for (x, y) in
            [(f32::NAN, 0.9), (-1.0, 0.9), (f32::NEG_INFINITY, 0.9), (7.0, 0.1), (f32::INFINITY, 0.1)]
        {
            assert_eq!(falling.at(x), y, "{x}");
        }
        assert_eq!(Curve::default(), curve(&[[0.0, 0.0], [1.0, 1.0]]));
    }

    #[test]
    fn tables_are_even_samples_from_end_to_end() {
        let curve = curve(&STEEP);
        let table = curve.table(33);
        assert_eq!((table.len(), table[0], table[32]), (33, 0.0, 1.0));
        assert!(table.iter().enumerate().all(|(i, y)| *y == curve.at(i as f32 / 32.0)));
        assert_eq!((curve.table(0), curve.table(1)), (vec![], vec![0.0]));
    }

    #[test]
    fn what_is_no_curve_is_told_with_place_and_remedy() {
        assert_eq!(error(&[]), "a curve has 2 to 8 points, not 0");
        assert_eq!(error(&[[0.0; 2]; 9]), "a curve has 2 to 8 points, not 9");
        assert_eq!(
            error(&[[0.0, 0.0], [0.5, 1.5], [1.0, 1.0]]),
            "y = 1.5 of point 2 is out of range: 0 to 1"
        );
        assert_eq!(error(&[[f32::NAN, 0.0], [1.0, 1.0]]), "x = NaN of point 1 is out of range: 0 to 1");
        assert_eq!(
            error(&[[0.1, 0.0], [1.0, 1.0]]),
            "point 1 has x = 0.1; the first point has x = 0 and the last one x = 1"
        );
        assert_eq!(
            error(&[[0.0, 0.0], [0.9, 1.0]]),
            "point 2 has x = 0.9; the first point has x = 0 and the last one x = 1"
        );
        let order = "after x = 0.4; x grows from point to point, by 0.01 at least";
        for x in [0.4, 0.2, 0.405] {
            let message = error(&[[0.0, 0.0], [0.4, 0.2], [x, 0.5], [1.0, 1.0]]);
            assert_eq!(message, format!("point 3 has x = {x} {order}"));
        }
        // Hundredths, as they are rounded.
        for i in 1..98 {
            let [x, next] = [i, i + 1].map(|i| i as f32 / 100.0);
            curve(&[[0.0, 0.0], [x, 0.2], [next, 0.2], [1.0, 1.0]]);
        }
        let negative = curve(&[[-0.0, -0.0], [1.0, 1.0]]);
        assert!(negative.points()[0].y.is_sign_positive());
    }
}
