//! What hatching is drawn with, made once on the processor: tonal art maps and stripes, and a cache
//! of results that take long.
//!
//! Plain data from plain numbers and images; knows no scene, no style and no device.

pub mod cache;
pub mod stripes;
pub mod tonal_art_map;
