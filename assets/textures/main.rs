//! Makes the built-in textures of techniques: `cargo run --release --example textures` writes them below `assets/`, always the
//! same bytes.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a tool for the people who change the textures: it may stop with a message and report on its standard output"
)]

mod halftones;
mod matcaps;
mod patterns;
mod strokes;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

fn main() {
    halftones::write_all();
    matcaps::write(std::path::Path::new("assets/matcaps")).expect("run this in the repository's root");
}

/// Writes an image; `name`: its path below `assets/`, without ending.
fn write(name: &str, bytes: &[u8], [width, height]: [usize; 2], color: ExtendedColorType) {
    let path = format!("assets/{name}.png");
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(bytes, width as u32, height as u32, color)
        .expect("a texture is a valid image");
    std::fs::write(&path, &png).expect("run this in the repository's root");
    println!("{path}: {} KiB", png.len().div_ceil(1024));
}
