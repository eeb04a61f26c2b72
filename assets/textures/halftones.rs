//! The built-in textures of halftones, and their calibration.

use hachure::render::effects::halftone::calibration::{PLACES, SIZES, TONES};
use hachure::render::effects::halftone::threshold_map::{SIDE, STEPS, ThresholdMap, ranked};
use image::ExtendedColorType;

use crate::{patterns, strokes, write};

/// Priorities of all texels of a tile at a place in the octave, 0 to 1.
type Priority = Box<dyn Fn(f32) -> Vec<f32>>;

/// Writes each texture and its calibration.
pub(crate) fn write_all() {
    let textures: [(&str, Priority); 4] = [
        ("strokes", Box::new(strokes::crossed_strokes())),
        ("stipple", Box::new(strokes::stipple())),
        ("lines", Box::new(patterns::lines)),
        ("dots", Box::new(patterns::dots)),
    ];
    for (name, priority) in textures {
        let steps: Vec<_> = (0..STEPS).map(|step| ranked(&priority(step as f32 / STEPS as f32))).collect();
        write(&format!("strokes/{name}"), &steps.concat(), [SIDE, SIDE * STEPS], ExtendedColorType::L8);
        let thresholds = ThresholdMap::new(&steps).calibration;
        let words: Vec<u8> =
            thresholds.iter().flat_map(|t| ((t * 65535.0).round() as u16).to_ne_bytes()).collect();
        write(
            &format!("strokes/{name}_calibration"),
            &words,
            [TONES, PLACES * SIZES],
            ExtendedColorType::L16,
        );
    }
}
