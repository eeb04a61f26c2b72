//! Curves in space and what is made by leading a circle along them: wires, stems, turned bodies.

use std::f64::consts::{FRAC_PI_8, PI, TAU};

use glam::{DVec2, DVec3, dvec2, dvec3};

use crate::solid::{Corner, Solid};

/// A smooth curve through points, `per_span` pieces from each to the next.
pub(crate) fn through(points: &[DVec3], per_span: usize) -> Vec<DVec3> {
    let n = points.len();
    let mut out = vec![points[0]];
    for i in 0..n - 1 {
        // At the ends, the next point mirrored continues the curve.
        let before = if i == 0 { points[0] * 2.0 - points[1] } else { points[i - 1] };
        let (a, b) = (points[i], points[i + 1]);
        let after = if i + 2 == n { b * 2.0 - a } else { points[i + 2] };
        let (leave, arrive) = ((b - before) * 0.5, (after - a) * 0.5);
        for k in 1..=per_span {
            let t = k as f64 / per_span as f64;
            let (t2, t3) = (t * t, t * t * t);
            out.push(
                a * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + leave * (t3 - 2.0 * t2 + t)
                    + b * (3.0 * t2 - 2.0 * t3)
                    + arrive * (t3 - t2),
            );
        }
    }
    out
}

/// A smooth profile through radii and heights.
pub(crate) fn profile(points: &[(f64, f64)], per_span: usize) -> Vec<DVec2> {
    let points: Vec<DVec3> = points.iter().map(|&(r, y)| dvec3(r, y, 0.0)).collect();
    through(&points, per_span).iter().map(|p| p.truncate()).collect()
}

/// A body turned about Y: `profile` has radii and heights, from the lower end of the axis outside and up to the upper
/// end. Its image runs once around `repeats` times as `u`; `v` is given for each point of the profile.
pub(crate) fn turned(profile: &[DVec2], segments: usize, repeats: f64, v: impl Fn(usize) -> f64) -> Solid {
    let row = |(i, p): (usize, &DVec2)| -> Vec<Corner> {
        let corner = |j: usize| {
            let angle = TAU * (j % segments) as f64 / segments as f64;
            let at = dvec3(p.x * angle.cos(), p.y, -p.x * angle.sin());
            (at, dvec2(repeats * j as f64 / segments as f64, v(i)))
        };
        (0..=segments).map(corner).collect()
    };
    let mut out = Solid::default();
    out.sheet(&profile.iter().enumerate().map(row).collect::<Vec<_>>());
    out
}

/// The same without an image.
pub(crate) fn turned_plain(profile: &[DVec2], segments: usize) -> Solid {
    Solid { uvs: Vec::new(), ..turned(profile, segments, 1.0, |_| 0.0) }
}

/// Sides of a wire: enough that none of its edges is sharp enough to be drawn.
const SIDES: usize = 14;

/// A round wire with round ends along a curve; `radius` is asked for parts of its length, 0 to 1.
pub(crate) fn wire(path: &[DVec3], radius: impl Fn(f64) -> f64) -> Solid {
    let last = path.len() - 1;
    let direction = |i: usize| (path[(i + 1).min(last)] - path[i.max(1) - 1]).normalize();
    let mut across = direction(0).any_orthonormal_vector();
    let mut rings: Vec<Vec<DVec3>> = Vec::new();
    let mut ring = |center: DVec3, across: DVec3, along: DVec3, radius: f64| {
        let other = along.cross(across);
        let point = |j: usize| {
            let (sin, cos) = (TAU * j as f64 / SIDES as f64).sin_cos();
            center + (across * cos + other * sin) * radius
        };
        rings.push((0..SIDES).map(point).collect());
    };
    for (i, &at) in path.iter().enumerate() {
        let along = direction(i);
        // As little twist as the curve allows.
        across = across.reject_from(along).normalize();
        let r = radius(i as f64 / last as f64);
        let cap = |k: f64| (r * (k * FRAC_PI_8).cos(), r * (k * FRAC_PI_8).sin());
        if i == 0 {
            for k in [3.0, 2.0, 1.0] {
                ring(at - along * cap(k).1, across, along, cap(k).0);
            }
        }
        ring(at, across, along, r);
        if i == last {
            for k in [1.0, 2.0, 3.0] {
                ring(at + along * cap(k).1, across, along, cap(k).0);
            }
        }
    }
    let mut out = Solid::default();
    for pair in rings.windows(2) {
        out.band(&pair[0], &pair[1]);
    }
    let (foot, tip) = (path[0] - direction(0) * radius(0.0), path[last] + direction(last) * radius(1.0));
    for j in 0..SIDES {
        let next = (j + 1) % SIDES;
        out.triangle(rings[0][next], rings[0][j], foot);
        let end = &rings[rings.len() - 1];
        out.triangle(end[j], end[next], tip);
    }
    out
}

/// A ball about the origin as a profile from its lower to its upper pole, in `n` pieces.
pub(crate) fn half_circle(radius: f64, n: usize) -> Vec<DVec2> {
    (0..=n)
        .map(|i| {
            let (sin, cos) = (PI * i as f64 / n as f64).sin_cos();
            // Exactly on the axis at the poles.
            dvec2(if i % n == 0 { 0.0 } else { radius * sin }, -radius * cos)
        })
        .collect()
}
