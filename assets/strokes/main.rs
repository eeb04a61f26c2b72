//! Makes the built-in stroke sets: `cargo run --release --example strokes` writes them to `assets/strokes/sets/`.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a tool for the people who change the sets: it may stop with a message and report on its standard output"
)]

use hachure::hatching::tonal_art_map::{TonalArtMap, sets};

fn main() {
    std::fs::create_dir_all("assets/strokes/sets").expect("run this in the repository's root");
    for set in sets::all() {
        let mut drawn = set.recipe.draw(&|_| true).expect("the recipes of built-in sets are good");
        coarsen(&mut drawn.map);
        let png = drawn.map.to_png().expect("a map is a valid image");
        let path = format!("assets/strokes/sets/{}.png", set.name);
        std::fs::write(&path, &png).expect("run this in the repository's root");
        println!("{path}: {} strokes, {} KiB", drawn.strokes.len(), png.len().div_ceil(1024));
    }
}

/// Leaves 16 shades of ink: nobody sees the difference, and files are smaller. Thresholds stay, for they are the tones.
fn coarsen(map: &mut TonalArtMap) {
    let shade = |ink: &mut u8| *ink = ((u16::from(*ink) + 8) / 17 * 17) as u8;
    for level in &mut map.levels {
        level.tones.iter_mut().flatten().for_each(shade);
        for priority in &mut level.priorities {
            priority.inks.iter_mut().for_each(shade);
        }
    }
}
