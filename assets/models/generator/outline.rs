//! Closed outlines in the plane: what plates are cut from. Counter-clockwise, in millimeters.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, dvec2};

/// A closed polygon, counter-clockwise, without collinear points.
pub(crate) type Outline = Vec<DVec2>;

/// A circle of `n` points.
pub(crate) fn circle(center: DVec2, radius: f64, n: usize) -> Outline {
    (0..n).map(|i| center + radius * DVec2::from_angle(TAU * i as f64 / n as f64)).collect()
}

/// An arc from angle `from` to angle `to` (either way round) in `n` chords, both ends included.
pub(crate) fn arc(center: DVec2, radius: f64, from: f64, to: f64, n: usize) -> Vec<DVec2> {
    (0..=n).map(|i| center + radius * DVec2::from_angle(from + (to - from) * i as f64 / n as f64)).collect()
}

/// A polygon whose corners `(x, y, radius)` are rounded by arcs of at most `step` radians per chord.
pub(crate) fn rounded(corners: &[(f64, f64, f64)], step: f64) -> Outline {
    let point = |i: usize| {
        let (x, y, _) = corners[i % corners.len()];
        dvec2(x, y)
    };
    let mut out = Vec::new();
    for i in 0..corners.len() {
        let (p, radius) = (point(i), corners[i].2);
        let before = (p - point(i + corners.len() - 1)).normalize();
        let after = (point(i + 1) - p).normalize();
        let turn = before.perp_dot(after).atan2(before.dot(after));
        if radius == 0.0 || turn.abs() < 1e-6 {
            out.push(p);
            continue;
        }
        let touch = p - before * radius * (turn.abs() / 2.0).tan();
        let center = touch + before.perp() * radius * turn.signum();
        let from = (touch - center).to_angle();
        let n = (turn.abs() / step).ceil().max(1.0) as usize;
        out.extend(arc(center, radius, from, from + turn, n));
    }
    out.dedup_by(|a, b| a.distance(*b) < 1e-6);
    out
}

/// A half outline (x ≥ 0, walked upwards) completed by its mirror image at the left.
pub(crate) fn mirrored(right: &[DVec2]) -> Outline {
    let left = right.iter().rev().filter(|p| p.x.abs() > 1e-9).map(|p| dvec2(-p.x, p.y));
    right.iter().copied().chain(left).collect()
}

/// The outline mirrored top to bottom, still counter-clockwise.
pub(crate) fn upside_down(outline: &[DVec2]) -> Outline {
    outline.iter().rev().map(|p| dvec2(p.x, -p.y)).collect()
}

/// The outline moved inwards by `distance` (outwards when negative) with mitered corners, point for point.
pub(crate) fn inset(outline: &[DVec2], distance: f64) -> Outline {
    let n = outline.len();
    (0..n)
        .map(|i| {
            let p = outline[i];
            let a = (p - outline[(i + n - 1) % n]).normalize().perp();
            let b = (outline[(i + 1) % n] - p).normalize().perp();
            p + (a + b) * (distance / (1.0 + a.dot(b)).max(0.2))
        })
        .collect()
}

/// A toothed wheel: `teeth` trapezoids with rounded flanks between the root and tip radii.
pub(crate) fn gear(teeth: usize, root: f64, tip: f64) -> Outline {
    let pitch = TAU / teeth as f64;
    (0..teeth)
        .flat_map(|i| {
            let middle = pitch * i as f64;
            [(-0.31, root), (-0.13, tip), (0.13, tip), (0.31, root)]
                .map(|(part, radius)| radius * DVec2::from_angle(middle + part * pitch))
        })
        .collect()
}

/// A regular hexagon with the given distance across its flats.
pub(crate) fn hexagon(across_flats: f64) -> Outline {
    circle(DVec2::ZERO, across_flats / 2.0 / (PI / 6.0).cos(), 6)
}

/// Is the point inside the polygon?
pub(crate) fn contains(outline: &[DVec2], p: DVec2) -> bool {
    let n = outline.len();
    (0..n)
        .filter(|&i| {
            let (a, b) = (outline[i], outline[(i + 1) % n]);
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)
        })
        .count()
        % 2
        == 1
}
