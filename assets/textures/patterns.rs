//! Ruled lines and the dots of print.

use std::f32::consts::{SQRT_2, TAU};

use hachure::render::effects::halftone::threshold_map::{PERIODS, SIDE};

/// Priorities of all texels from a function of their place, in periods.
fn texels(priority: impl Fn(f32, f32) -> f32) -> Vec<f32> {
    let place = |i: usize| (i as f32 + 0.5) * PERIODS as f32 / SIDE as f32;
    (0..SIDE * SIDE).map(|i| priority(place(i % SIDE), place(i / SIDE))).collect()
}

/// Distance from the nearest whole number, 0 to 0.5.
fn off(x: f32) -> f32 {
    (x - x.round()).abs()
}

/// Lines along x that grow in width. During an octave (`step` 0 to 1) a new one grows between each two, first in the
/// darkest tones.
pub(crate) fn lines(step: f32) -> Vec<f32> {
    texels(|_, y| (-2.0 * off(y)).max(step - 1.0 - 2.0 * off(y + 0.5)))
}

/// Dots that grow until they touch and leave round holes. During an octave one grows in the middle of each four, and
/// then one between each two, first in the darkest tones.
pub(crate) fn dots(step: f32) -> Vec<f32> {
    texels(|x, y| {
        let (u, v) = ((TAU * x).cos(), (TAU * y).cos());
        // Like distances from the dots, but round about the holes too.
        let [corner, middle, between] =
            [(2.0 - u - v) / 2.0, (2.0 + u + v) / 2.0, (1.0 + u * v) / 2.0].map(|d: f32| d.max(0.0).sqrt());
        let late = (1.0 - 2.0 * step).max(0.0) * SQRT_2;
        let later = (2.0 - 2.0 * step).min(1.0);
        (-corner).max(-middle - late).max(-between - later)
    })
}
