//! What an object looks like: one file per effect, named as its style and its shader.

pub mod halftone;
pub mod surface;
pub mod toon;
