//! What the ogre wears and carries.

use std::sync::LazyLock;

use glam::{DVec3, dvec3};

use crate::ogre_body::{CLUB_FOOT, CLUB_TOP, forearms, trunk};
use crate::sdf::{ellipsoid, join, limb, meet, sphere};

/// What cloth lies on: the trunk, widened where the hips begin; between the legs it hangs straight.
fn hips(p: DVec3) -> f64 {
    let skirt = ellipsoid(p, dvec3(0.0, 0.42, 0.02), dvec3(0.475, 0.55, 0.41));
    join(trunk(p), skirt, 0.1)
}

/// The loincloth: hide with folds, long in front and behind, with a ragged hem.
pub(crate) fn loincloth(p: DVec3) -> f64 {
    let angle = p.x.atan2(p.z);
    let low = ((0.66 - p.y) / 0.3).clamp(0.0, 1.0);
    // Below it is a dome, so that the legs come out of a skirt and not of a block.
    let deep = (-hips(p) / 0.25).clamp(0.0, 1.0);
    let deep = deep * deep * (3.0 - 2.0 * deep);
    let fold = 0.021 * (1.0 - deep) * low * (angle * 10.0 + 1.2 * (angle * 3.0).sin()).sin();
    let rags = 0.024 * (angle * 13.0).sin() + 0.02 * (angle * 7.0 + 1.0).sin();
    let ragged = rags - 0.075 * (angle * 2.0).cos();
    let hem = 0.37 + ragged * (1.0 - deep) + 0.14 * deep;
    let body = hips(p) + fold;
    meet(meet(body - 0.038, hem - p.y, 0.08), p.y - 0.66, 0.13)
}

/// The belt under the belly.
pub(crate) fn belt(p: DVec3) -> f64 {
    let high = (p.y - 0.64 + 0.04 * p.z).abs() - 0.05;
    meet(hips(p) - 0.058, high, 0.09)
}

/// The middle of the buckle, on the belt's front.
pub(crate) static BUCKLE: LazyLock<DVec3> = LazyLock::new(|| {
    let at = |z: f64| dvec3(0.0, 0.625, z);
    let mut z = 0.8;
    while hips(at(z)) > 0.05 {
        z -= 0.002;
    }
    at(z)
});

/// The belt's buckle: a boss on a disc.
pub(crate) fn buckle(p: DVec3) -> f64 {
    let disc = ellipsoid(p, *BUCKLE, dvec3(0.1, 0.1, 0.055));
    let boss = sphere(p, *BUCKLE + dvec3(0.0, 0.0, 0.045), 0.04);
    join(disc, boss, 0.025)
}

/// Leather around both forearms.
pub(crate) fn bracers(p: DVec3) -> f64 {
    forearms(p)
        .map(|(arm, along, length)| {
            let ends = ((along - 0.62).abs() - 0.25) * length;
            let rims = 0.008 * (-((along - 0.45) / 0.05).powi(2)).exp()
                + 0.008 * (-((along - 0.8) / 0.05).powi(2)).exp();
            meet(arm - 0.026 - rims, ends, 0.085)
        })
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// The club: a gnarled branch with knobs.
pub(crate) fn club(p: DVec3) -> f64 {
    let at = |t: f64| CLUB_FOOT.lerp(CLUB_TOP, t);
    let mut d = limb(
        p,
        &[(at(0.0), 0.17), (at(0.3), 0.14), (at(0.66), 0.066), (at(1.0), 0.056), (at(1.04), 0.07)],
        0.06,
    );
    let up = (CLUB_TOP - CLUB_FOOT).normalize();
    let u = up.cross(DVec3::Z).normalize();
    let v = up.cross(u);
    for i in 0..12 {
        let i = f64::from(i);
        let (sin, cos) = (i * 2.4 + 0.7).sin_cos();
        let t = -0.06 + 0.045 * i;
        let r = 0.172 - 0.16 * t.max(0.0);
        d = join(d, sphere(p, at(t) + (u * cos + v * sin) * r, 0.043), 0.03);
    }
    d
}
