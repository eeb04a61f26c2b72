//! What the ogre wears and carries.

use glam::{DVec3, dvec3};

use crate::ogre_body::{CLUB_FOOT, CLUB_TOP, clothed, trunk};
use crate::sdf::{ellipsoid, join, limb, meet, sphere};

/// A band of cloth around the body between two heights that follow `at`, `off` above the skin, `half` thick.
fn wrapped(body: f64, off: f64, half: f64) -> f64 {
    (body - off).abs() - half
}

/// The loincloth: hide with folds and a ragged hem.
pub(crate) fn loincloth(p: DVec3) -> f64 {
    let angle = p.x.atan2(p.z);
    let low = ((0.66 - p.y) / 0.3).clamp(0.0, 1.0);
    let fold = 0.016 * low * (angle * 9.0 + 0.6 * (angle * 2.0).sin()).sin();
    // The legs part below; the cloth does not: it hangs from the hips.
    let hips = ellipsoid(p, dvec3(0.0, 0.45, 0.02), dvec3(0.5, 0.5, 0.42));
    let body = join(trunk(p), hips, 0.1) + fold;
    let hem = 0.36 + 0.03 * (angle * 7.0).sin() + 0.02 * (angle * 3.0 + 1.0).sin();
    let d = meet(wrapped(body, 0.014, 0.024), hem - p.y, 0.04);
    meet(d, p.y - 0.68, 0.04)
}

/// The belt under the belly.
pub(crate) fn belt(p: DVec3) -> f64 {
    let drop = 0.03 * p.z;
    let high = (p.y - 0.655 + drop).abs() - 0.048;
    meet(wrapped(clothed(p), 0.032, 0.03), high, 0.035)
}

/// The belt's buckle.
pub(crate) fn buckle(p: DVec3) -> f64 {
    let middle = dvec3(0.0, 0.63, 0.41);
    let disc = ellipsoid(p, middle, dvec3(0.1, 0.1, 0.045));
    join(disc, sphere(p, middle + dvec3(0.0, 0.0, 0.03), 0.042), 0.02)
}

/// The club: a gnarled branch with knobs.
pub(crate) fn club(p: DVec3) -> f64 {
    let at = |t: f64| CLUB_FOOT.lerp(CLUB_TOP, t);
    let mut d = limb(
        p,
        &[(at(0.0), 0.165), (at(0.35), 0.125), (at(0.7), 0.062), (at(1.0), 0.056), (at(1.03), 0.07)],
        0.06,
    );
    let up = (CLUB_TOP - CLUB_FOOT).normalize();
    let u = up.cross(DVec3::Z).normalize();
    let v = up.cross(u);
    for i in 0..9 {
        let i = f64::from(i);
        let (sin, cos) = (i * 2.4 + 0.7).sin_cos();
        let t = 0.02 + 0.05 * i;
        let r = 0.155 - 0.13 * t;
        d = join(d, sphere(p, at(t) + (u * cos + v * sin) * r, 0.045), 0.035);
    }
    d
}
