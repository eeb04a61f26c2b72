//! Six tones from three: the dark ones are the light ones laid over each other in several directions, as in Bu et al. 2006
//! ("Image-Based Hatching"). Twins of the shader's functions.
//!
//! Layers of different directions hardly know of each other: together they ink 1 − (1 − a)(1 − b) of the paper. Tone 3 + i
//! is tone 3, and tone i in each of two more directions, which leaves (1 − s₃)(1 − sᵢ)² of it. [`LIGHT_INKS`] are those
//! for which all six tones are as evenly spaced as can be.

use std::f32::consts::PI;

/// Tones that are stored.
pub const LIGHTS: usize = 3;
/// Tones that are composed of them, with the stored ones.
pub const TONES: usize = 6;
/// Mean ink of the stored tones. A map that was drawn with [`super::generator::Recipe::inks`] set to them composes to
/// [`COMPOSED_INKS`].
pub const LIGHT_INKS: [f32; LIGHTS] = [0.118, 0.245, 0.384];
/// Mean ink of the six tones: i · 0.1277 within 0.0105.
pub const COMPOSED_INKS: [f32; TONES] = [0.118, 0.245, 0.384, 0.5208, 0.6489, 0.7663];

/// A direction that strokes are laid in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// From the direction of the light tones, radians.
    pub turn: f32,
    /// Moves the tile, as a share of its side: strokes of two directions shall not meet in its corner.
    pub offset: [f32; 2],
}

/// The directions of the layers: the first one has the light tones. Strokes that cross at 60° look drawn, at 90° woven.
pub const DIRECTIONS: [Direction; 3] = [
    Direction { turn: 0.0, offset: [0.0, 0.0] },
    Direction { turn: PI / 3.0, offset: [0.37, 0.61] },
    Direction { turn: -PI / 3.0, offset: [0.71, 0.23] },
];

impl Direction {
    /// Place in the tile, in tiles, of a point of the picture; `point` in tiles too, `angle` of the strokes there in radians.
    pub fn place(&self, [x, y]: [f32; 2], angle: f32) -> [f32; 2] {
        let (sin, cos) = (angle + self.turn).sin_cos();
        [x * cos + y * sin + self.offset[0], y * cos - x * sin + self.offset[1]]
    }
}

/// Tone of each layer for a whole tone 0 (paper) to 6; a layer's tone 0 is paper.
pub fn tones_of_layers(tone: usize) -> [usize; 3] {
    let tone = tone.min(TONES);
    if tone <= LIGHTS { [tone, 0, 0] } else { [LIGHTS, tone - LIGHTS, tone - LIGHTS] }
}

/// Ink of a pixel of a tone 0 (paper) to 6, between whole ones a blend; `samples`: for each of the [`DIRECTIONS`] the ink of the
/// stored tones.
pub fn compose(tone: f32, samples: &[[f32; LIGHTS]; 3]) -> f32 {
    let whole = |tone: usize| {
        let layers = tones_of_layers(tone);
        let paper = |(samples, tone): (&[f32; LIGHTS], usize)| {
            1.0 - tone.checked_sub(1).and_then(|i| samples.get(i)).copied().unwrap_or_default()
        };
        1.0 - samples.iter().zip(layers).map(paper).product::<f32>()
    };
    let tone = tone.clamp(0.0, TONES as f32);
    let first = whole(tone as usize);
    first + (whole(tone as usize + 1) - first) * tone.fract()
}

/// The tone, 0 to 6, that has a mean ink, 0 to 1; `inks`: of the six tones.
pub fn tone_of_ink(ink: f32, inks: &[f32; TONES]) -> f32 {
    let mut before = 0.0;
    for (i, at) in inks.iter().enumerate() {
        if ink < *at {
            return i as f32 + ((ink - before) / (at - before).max(1e-6)).clamp(0.0, 1.0);
        }
        before = *at;
    }
    TONES as f32
}

/// Mean ink of the layers that make up any mean ink, 0 to 1, exactly: for priorities, which have all tones. The first layer
/// fills up to `most`, then both others together; what they cannot reach any more is added to all.
pub fn inks_of_layers(ink: f32, most: f32) -> [f32; 3] {
    let (ink, most) = (ink.clamp(0.0, 1.0), most.clamp(0.0, 0.99));
    let crossed = |first: f32| 1.0 - ((1.0 - ink) / (1.0 - first)).sqrt();
    if ink <= most {
        [ink, 0.0, 0.0]
    } else if crossed(most) <= most {
        [most, crossed(most), crossed(most)]
    } else {
        [1.0 - (1.0 - ink).cbrt(); 3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatching::tonal_art_map::TonalArtMap;
    use crate::hatching::tonal_art_map::generator::Recipe;

    fn drawn(inks: &[f32]) -> TonalArtMap {
        let recipe =
            Recipe { inks: inks.to_vec(), side: 128, levels: 1, candidates: 100, ..Recipe::default() };
        recipe.draw(&|_| true).unwrap().map
    }

    /// Means over a large picture with strokes at an angle.
    fn mean(angle: f32, pixel: impl Fn([[f32; 2]; 3]) -> f32) -> f32 {
        let side = 400;
        let pixels = (0..side * side).map(|i| {
            let point = [i % side, i / side].map(|c| c as f32 / 128.0);
            pixel(DIRECTIONS.map(|direction| direction.place(point, angle)))
        });
        pixels.sum::<f32>() / (side * side) as f32
    }

    #[test]
    fn six_composed_tones_are_evenly_spaced() {
        let map = drawn(&LIGHT_INKS);
        let spacing = COMPOSED_INKS[5] / 6.0;
        for tone in 1..=TONES {
            let found = mean(0.3, |places| {
                compose(tone as f32, &places.map(|place| [0, 1, 2].map(|light| map.ink(0, light, place))))
            });
            assert!((found - tone as f32 * spacing).abs() < 0.02, "tone {tone}: {found}");
            assert!((found - COMPOSED_INKS[tone - 1]).abs() < 0.012, "tone {tone}: {found}");
        }
    }

    #[test]
    fn composed_tones_nest_and_are_continuous() {
        let samples = [[0.1, 0.5, 0.9], [0.0, 0.2, 0.4], [0.3, 0.3, 0.8]];
        let mut before = compose(0.0, &samples);
        assert_eq!(before, 0.0);
        for i in 1..=600 {
            let ink = compose(i as f32 / 100.0, &samples);
            assert!(ink >= before && ink - before < 0.01, "{i}: {before} {ink}");
            before = ink;
        }
        assert!((compose(6.0, &samples) - (1.0 - 0.1 * 0.6 * 0.2)).abs() < 1e-6);
        assert_eq!(compose(9.0, &samples), before);
    }

    #[test]
    fn tones_and_inks_agree() {
        for (i, ink) in COMPOSED_INKS.iter().enumerate() {
            assert!((tone_of_ink(*ink, &COMPOSED_INKS) - (i + 1) as f32).abs() < 1e-5);
        }
        assert_eq!([0.0, 0.059, 1.0].map(|ink| tone_of_ink(ink, &COMPOSED_INKS)), [0.0, 0.5, 6.0]);
    }

    #[test]
    fn layers_of_priorities_have_the_ink_together() {
        for i in 0..=64 {
            let ink = i as f32 / 64.0;
            let together = 1.0 - inks_of_layers(ink, 0.5).iter().map(|ink| 1.0 - ink).product::<f32>();
            assert!((together - ink).abs() < 1e-5, "{ink}: {together}");
        }
        let map = drawn(&[0.55]);
        for i in 0..=14 {
            let ink = i as f32 / 16.0;
            let layers = inks_of_layers(ink, 0.5);
            let found = mean(1.0, |places| {
                let inks = [0, 1, 2].map(|i| map.ink_of_priorities(0, layers[i], places[i]));
                1.0 - inks.iter().map(|ink| 1.0 - ink).product::<f32>()
            });
            assert!((found - ink).abs() < 0.02, "{ink}: {found}");
        }
    }
}
