//! 2×2 matrices as people write them.

use std::fmt;
use std::str::FromStr;

/// A 2×2 matrix by rows, written `a,b,c,d`: what it multiplies is a column.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Matrix(pub [[f32; 2]; 2]);

impl Matrix {
    /// All zero.
    pub const ZERO: Self = Self([[0.0; 2]; 2]);

    /// Its numbers, row by row.
    pub fn numbers(self) -> [f32; 4] {
        let [[a, b], [c, d]] = self.0;
        [a, b, c, d]
    }

    /// Of numbers row by row.
    pub fn of_numbers([a, b, c, d]: [f32; 4]) -> Self {
        Self([[a, b], [c, d]])
    }

    /// The same with every number multiplied; what is no number becomes 0, what is greater than `most` that.
    #[must_use]
    pub fn scaled(self, factor: f32, most: f32) -> Self {
        let sane = |n: f32| if n.is_nan() { 0.0 } else { n.clamp(-most, most) };
        Self::of_numbers(self.numbers().map(|n| sane(sane(n) * sane(factor))))
    }

    /// Root of the mean square of what it makes of vectors whose coordinates are independent, of mean 0 and mean square 1:
    /// each coordinate, on average.
    pub fn rms(self) -> f32 {
        (self.numbers().into_iter().map(|n| n * n).sum::<f32>() / 2.0).sqrt()
    }
}

impl fmt::Display for Matrix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b, c, d] = self.numbers();
        write!(f, "{a},{b},{c},{d}")
    }
}

impl FromStr for Matrix {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is no matrix; write its rows as a,b,c,d");
        let numbers: Result<Vec<f32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
        let numbers = numbers.map_err(|_no_number| wrong())?;
        <[f32; 4]>::try_from(numbers).map(Self::of_numbers).map_err(|_other_count| wrong())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_are_read_and_written() {
        let matrix = Matrix([[1.5, 0.25], [-0.25, 1.0]]);
        assert_eq!(matrix.to_string(), "1.5,0.25,-0.25,1");
        assert_eq!(" 1.5, 0.25,-0.25, 1 ".parse(), Ok(matrix));
        for wrong in ["", "1", "1,2,3", "1,2,3,4,5", "1,2,3,x", "[1,2],[3,4]"] {
            assert!(wrong.parse::<Matrix>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn what_is_no_number_or_too_great_is_held_back() {
        let matrix = Matrix([[f32::NAN, f32::INFINITY], [-1e30, 2.0]]).scaled(0.5, 16.0);
        assert_eq!(matrix, Matrix([[0.0, 8.0], [-8.0, 1.0]]));
        assert_eq!(Matrix([[1.0, 0.0], [0.0, 1.0]]).rms(), 1.0);
    }
}
