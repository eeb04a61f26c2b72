//! The built-in stroke sets: what their strokes look like.

use super::composition::COMPOSED_INKS;
use super::generator::Recipe;
use super::stroke::StrokeShape;

/// A built-in set by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Set {
    /// Lower case, also of its file.
    pub name: &'static str,
    /// What it was drawn from.
    pub recipe: Recipe,
    /// Its file, which `assets/strokes` made.
    pub png: &'static [u8],
}

/// All built-in sets. They have as much ink in each tone as their three light tones have when they are composed.
pub fn all() -> [Set; 4] {
    let set = |name, png, seed, candidates, shape| Set {
        name,
        recipe: Recipe { shape, seed, candidates, inks: COMPOSED_INKS.to_vec(), ..Recipe::default() },
        png,
    };
    macro_rules! png {
        ($name:literal) => {
            include_bytes!(concat!("../../../assets/strokes/sets/", $name, ".png"))
        };
    }
    [
        set("pen", png!("pen"), 1, 1500, pen()),
        set("pencil", png!("pencil"), 2, 200, pencil()),
        set("woodcut", png!("woodcut"), 3, 400, woodcut()),
        set("stipple", png!("stipple"), 4, 400, stipple()),
    ]
}

/// Long thin lines that are pressed at their beginning and lifted at their end.
pub fn pen() -> StrokeShape {
    StrokeShape {
        length: 0.42,
        length_spread: 0.5,
        width: 1.5,
        width_spread: 0.25,
        taper: [0.06, 0.35],
        waviness: 0.010,
        angle_spread: 0.035,
        ..StrokeShape::default()
    }
}

/// Wide soft lines that the paper's grain shows through.
pub fn pencil() -> StrokeShape {
    StrokeShape {
        length: 0.34,
        length_spread: 0.5,
        width: 3.2,
        width_spread: 0.25,
        taper: [0.25, 0.5],
        waviness: 0.022,
        angle_spread: 0.07,
        pressure: 0.75,
        grain: 0.6,
        ..StrokeShape::default()
    }
}

/// Wedges, as a graver leaves them.
pub fn woodcut() -> StrokeShape {
    StrokeShape {
        length: 0.45,
        length_spread: 0.4,
        width: 4.5,
        width_spread: 0.2,
        taper: [0.15, 0.85],
        waviness: 0.008,
        angle_spread: 0.03,
        ..StrokeShape::default()
    }
}

/// Dots.
pub fn stipple() -> StrokeShape {
    StrokeShape { length: 0.0, width: 4.0, width_spread: 0.2, ..StrokeShape::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatching::tonal_art_map::{INK_TOLERANCE, TonalArtMap};

    #[test]
    fn built_in_sets_are_small_maps_with_the_ink_of_their_recipes() {
        for set in all() {
            let map = TonalArtMap::from_png(set.png).unwrap();
            assert!(set.png.len() < 310_000, "{}: {} bytes", set.name, set.png.len());
            let sides: Vec<_> = map.levels.iter().map(|level| level.side).collect();
            assert_eq!(sides, [256, 128, 64, 32]);
            assert_eq!(map.inks.len(), COMPOSED_INKS.len());
            for level in &map.levels {
                let texels = (level.side * level.side) as f32;
                for (tone, ink) in level.tones.iter().zip(COMPOSED_INKS) {
                    let mean = tone.iter().map(|ink| f32::from(*ink)).sum::<f32>() / 255.0 / texels;
                    assert!((mean - ink).abs() < INK_TOLERANCE, "{} {}: {mean} {ink}", set.name, level.side);
                    let found = level.priorities.iter().map(|p| p.ink_at(ink)).sum::<f32>() / texels;
                    assert!((found - ink).abs() < 1.0 / 255.0, "{} {}: {found} {ink}", set.name, level.side);
                }
            }
        }
    }
}
