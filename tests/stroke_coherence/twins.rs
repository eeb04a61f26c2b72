//! What strokes are measured against.

use glam::DVec3;

use crate::frame::Frame;

/// Distance of lines where `first` is seen, px.
const SPACING: f64 = 9.0;
const WIDTH: f64 = 3.0;

/// Lines painted on the surface, planes apart in the world: as far from each other as strokes are in `first`.
pub(crate) fn locked(frame: &Frame, first: &Frame) -> Frame {
    let direction = DVec3::new(0.48, 0.64, 0.6);
    let distances = first.surfels.iter().filter(|surfel| surfel.object != 0).map(|s| f64::from(s.depth));
    let distance = distances.fold(f64::INFINITY, f64::min);
    let middle = 0.5 * first.side as f64;
    let (a, b) = (glam::DVec2::splat(middle), glam::DVec2::new(middle + SPACING, middle));
    let period = first.projector.unproject(a, distance).distance(first.projector.unproject(b, distance));
    let along = |x: usize, y: usize| frame.point(x, y).map(|at| at.dot(direction) / period);
    let last = frame.side - 2;
    let inks = (0..frame.inks.len()).map(|i| {
        let (x, y) = ((i % frame.side).min(last), (i / frame.side).min(last));
        let (Some(here), Some(right), Some(below)) = (along(x, y), along(x + 1, y), along(x, y + 1)) else {
            return 0.0;
        };
        let spacing = (right - here).hypot(below - here).recip();
        let away = (here - here.round()).abs() * spacing;
        // What is too close is gray.
        let share = WIDTH / SPACING;
        let gray = ((6.0 - spacing) / 3.0).clamp(0.0, 1.0);
        let ink = (0.5 * share * spacing - away + 0.5).clamp(0.0, 1.0);
        ink + (share - ink) * gray
    });
    Frame { inks: inks.collect(), ..frame.clone() }
}
