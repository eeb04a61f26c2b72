//! Signed distances (negative inside) and smooth ways to join them.

use glam::{DMat3, DVec3};

/// Distance to a sphere.
pub(crate) fn sphere(p: DVec3, center: DVec3, radius: f64) -> f64 {
    p.distance(center) - radius
}

/// Roughly the distance to an ellipsoid along the axes; exact at its surface.
pub(crate) fn ellipsoid(p: DVec3, center: DVec3, radii: DVec3) -> f64 {
    let q = (p - center) / radii;
    let (near, steep) = (q.length(), (q / radii).length());
    if steep < 1e-9 {
        return -radii.min_element();
    }
    near * (near - 1.0) / steep
}

/// The same for an ellipsoid whose axes are the columns of `axes`.
pub(crate) fn turned_ellipsoid(p: DVec3, center: DVec3, axes: DMat3, radii: DVec3) -> f64 {
    ellipsoid(axes.transpose() * (p - center), DVec3::ZERO, radii)
}

/// Distance to the hull of two balls.
pub(crate) fn cone(p: DVec3, (a, ra): (DVec3, f64), (b, rb): (DVec3, f64)) -> f64 {
    let axis = b - a;
    let length2 = axis.length_squared();
    let slope = ra - rb;
    let a2 = length2 - slope * slope;
    if a2 <= 0.0 {
        return sphere(p, a, ra).min(sphere(p, b, rb));
    }
    let from = p - a;
    let y = from.dot(axis);
    let z = y - length2;
    let x2 = (from * length2 - axis * y).length_squared();
    let y2 = y * y * length2;
    let z2 = z * z * length2;
    let k = slope.signum() * slope * slope * x2;
    if z.signum() * a2 * z2 > k {
        return (x2 + z2).sqrt() / length2 - rb;
    }
    if y.signum() * a2 * y2 < k {
        return (x2 + y2).sqrt() / length2 - ra;
    }
    ((x2 * a2 / length2).sqrt() + y * slope) / length2 - ra
}

/// A limb through balls, its joints smoothed over `k`.
pub(crate) fn limb(p: DVec3, balls: &[(DVec3, f64)], k: f64) -> f64 {
    balls.windows(2).map(|pair| cone(p, pair[0], pair[1])).fold(f64::INFINITY, |a, b| join(a, b, k))
}

/// The union of two bodies, with a fillet where they are within `k` of each other.
pub(crate) fn join(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0);
    a.min(b) - if h > 0.0 { h * h / (4.0 * k) } else { 0.0 }
}

/// The union with a body that lies within a ball: not even asked where it cannot matter.
pub(crate) fn join_near(
    d: f64,
    k: f64,
    p: DVec3,
    (center, radius): (DVec3, f64),
    body: impl Fn(DVec3) -> f64,
) -> f64 {
    if p.distance(center) - radius > d + k { d } else { join(d, body(p), k) }
}

/// The intersection of two bodies, its edge rounded over `k`.
pub(crate) fn meet(a: f64, b: f64, k: f64) -> f64 {
    -join(-a, -b, k)
}

/// What is left of `a` without `b`, its edge rounded over `k`.
pub(crate) fn carve(a: f64, b: f64, k: f64) -> f64 {
    meet(a, -b, k)
}

/// The direction in which a distance grows, not normalized.
pub(crate) fn gradient(f: &impl Fn(DVec3) -> f64, p: DVec3) -> DVec3 {
    let e = 2e-4;
    let along = |d: DVec3| (f(p + d * e) - f(p - d * e)) / (2.0 * e);
    DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
}

/// The point of the surface nearest to `p`, for a `p` close to it.
pub(crate) fn project(f: &impl Fn(DVec3) -> f64, mut p: DVec3) -> DVec3 {
    for _ in 0..2 {
        let g = gradient(f, p);
        p -= g * (f(p) / g.length_squared().max(0.05)).clamp(-0.02, 0.02);
    }
    p
}
