//! Where in their pixels a picture is sampled.

use glam::Vec2;

/// One of the samples whose mean is a smooth picture.
///
/// Places follow the R2 sequence, which fills the pixel evenly however many of its first members are taken. The first
/// is the middle, so that one sample is the picture without anti-aliasing; every other one is followed by its mirror
/// image, so that the mean of all is not moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sample {
    /// Its number, from 0.
    pub index: u32,
    /// How many there are to be.
    pub of: u32,
}

/// More samples than this change nothing that could be seen.
pub const MAX_SAMPLES: u32 = 1024;

/// The reciprocals of the plastic number and of its square.
const STEP: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

impl Sample {
    /// The only sample of a picture.
    pub const ONLY: Self = Self { index: 0, of: 1 };

    /// How far the picture is moved for it: pixels to the right and down, −0.5 to 0.5.
    pub fn jitter(self) -> Vec2 {
        let member = f64::from(self.index.div_ceil(2));
        let [x, y] = STEP.map(|step| ((0.5 + member * step).fract() - 0.5) as f32);
        if self.index % 2 == 1 { Vec2::new(x, y) } else { -Vec2::new(x, y) }
    }

    /// Width of the soft rim of what is covered by a computed share, such as a line; pixels. A single picture needs a
    /// whole pixel; the more there are to average, the less each of them has to blur, so that the mean is neither
    /// jagged on the way nor soft in the end.
    pub fn coverage_ramp(self) -> f32 {
        1.0 / (self.index as f32 + 1.0).sqrt()
    }

    /// Its weight beside the mean of all before it.
    pub fn weight(self) -> f32 {
        1.0 / (self.index as f32 + 1.0)
    }

    /// Whether the picture is complete with it.
    pub fn is_last(self) -> bool {
        self.index + 1 >= self.of
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn jitters(of: u32) -> impl Iterator<Item = Vec2> {
        (0..of).map(move |index| Sample { index, of }.jitter())
    }

    #[test]
    fn the_first_sample_is_the_plain_picture() {
        let first = Sample { index: 0, of: 64 };
        assert_eq!((first.jitter(), first.coverage_ramp(), first.weight()), (Vec2::ZERO, 1.0, 1.0));
        assert!(Sample::ONLY.is_last() && !first.is_last() && Sample { index: 63, of: 64 }.is_last());
    }

    #[test]
    fn samples_fill_the_pixel_evenly_about_its_middle() {
        for of in [16, 64, 256, 1024] {
            let mean = jitters(of).sum::<Vec2>() / of as f32;
            assert!(mean.abs().max_element() < 0.5 / of as f32 * 4.0, "{of}: {mean}");
            assert!(jitters(of).all(|j| j.abs().max_element() <= 0.5));
            // However an edge runs through the pixel, it has as many samples on a side as it has area there.
            for angle in 0..36 {
                let normal = Vec2::from_angle(angle as f32 * 0.0873);
                let before = jitters(of).filter(|j| j.dot(normal) < 0.0).count() as f32;
                assert!(
                    (before / of as f32 - 0.5).abs() < 1.6 / (of as f32).sqrt(),
                    "{of}, {angle}: {before}"
                );
            }
        }
    }
}
