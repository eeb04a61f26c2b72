//! Tonal art maps as images.
