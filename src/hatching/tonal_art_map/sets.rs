//! The built-in stroke sets: what their strokes look like.

use super::composition::COMPOSED_INKS;
use super::generator::Recipe;
use super::stroke::StrokeShape;

/// A built-in set by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Set {
    /// Lower case, also of its file.
    pub name: &'static str,
    /// What it is drawn from.
    pub recipe: Recipe,
}

/// All built-in sets. They have as much ink in each tone as their three light tones have when they are composed.
pub fn all() -> [Set; 4] {
    let set = |name, seed, candidates, shape| {
        let recipe = Recipe { shape, seed, candidates, inks: COMPOSED_INKS.to_vec(), ..Recipe::default() };
        Set { name, recipe }
    };
    // Of many small strokes a few candidates each are enough.
    [
        set("pen", 1, 400, pen()),
        set("pencil", 2, 200, pencil()),
        set("woodcut", 3, 400, woodcut()),
        set("stipple", 4, 100, stipple()),
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
    StrokeShape { length: 0.0, width: 3.6, width_spread: 0.2, ..StrokeShape::default() }
}
