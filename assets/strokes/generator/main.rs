//! Makes the built-in halftone textures: `cargo run --release --example strokes` writes `assets/strokes/*.png`, always
//! the same bytes.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a tool for the people who change the textures: it may stop with a message and report on its standard output"
)]

mod patterns;
mod strokes;

use hachure::render::effects::halftone::calibration::{PLACES, SIZES, TONES};
use hachure::render::effects::halftone::threshold_map::{SIDE, STEPS, ThresholdMap, ranked};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

/// Priorities of all texels of a tile at a place in the octave, 0 to 1.
type Priority = Box<dyn Fn(f32) -> Vec<f32>>;

/// Writes each texture and its calibration.
fn main() {
    let textures: [(&str, Priority); 4] = [
        ("strokes", Box::new(strokes::crossed_strokes())),
        ("stipple", Box::new(strokes::stipple())),
        ("lines", Box::new(patterns::lines)),
        ("dots", Box::new(patterns::dots)),
    ];
    for (name, priority) in textures {
        let steps: Vec<_> = (0..STEPS).map(|step| ranked(&priority(step as f32 / STEPS as f32))).collect();
        write(name, &steps.concat(), [SIDE, SIDE * STEPS], ExtendedColorType::L8);
        let thresholds = ThresholdMap::new(&steps).calibration;
        let words: Vec<u8> =
            thresholds.iter().flat_map(|t| ((t * 65535.0).round() as u16).to_ne_bytes()).collect();
        write(&format!("{name}_calibration"), &words, [TONES, PLACES * SIZES], ExtendedColorType::L16);
    }
}

fn write(name: &str, bytes: &[u8], [width, height]: [usize; 2], color: ExtendedColorType) {
    let path = format!("assets/strokes/{name}.png");
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(bytes, width as u32, height as u32, color)
        .expect("a texture is a valid image");
    std::fs::write(&path, &png).expect("run this in the repository's root");
    println!("{path}: {} KiB", png.len().div_ceil(1024));
}
