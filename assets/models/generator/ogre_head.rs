//! The ogre's head, in its own space: facing +Z, about 0.3 in radius. What is given for the left side is mirrored.

use glam::{DMat3, DVec3, dvec3};

use crate::sdf::{carve, cone, ellipsoid, join, limb, sphere, turned_ellipsoid};

/// Where the eyeballs are.
pub(crate) const EYE: DVec3 = dvec3(0.102, 0.0, 0.186);
/// Their radius.
pub(crate) const EYE_RADIUS: f64 = 0.057;

/// The head's skin.
pub(crate) fn skin(p: DVec3) -> f64 {
    // Both sides at once.
    let m = dvec3(p.x.abs(), p.y, p.z);
    let mut d = ellipsoid(p, dvec3(0.0, 0.05, -0.03), dvec3(0.225, 0.235, 0.245));
    d = join(d, ellipsoid(p, dvec3(0.0, -0.15, 0.05), dvec3(0.255, 0.15, 0.2)), 0.1);
    // Cheekbones.
    d = join(d, ellipsoid(m, dvec3(0.165, -0.06, 0.135), dvec3(0.075, 0.06, 0.07)), 0.06);
    // Sockets, then the brow over them: low in the middle.
    d = carve(d, sphere(m, EYE + dvec3(0.0, -0.004, 0.025), 0.066), 0.05);
    let brow = [
        (dvec3(0.0, 0.055, 0.232), 0.046),
        (dvec3(0.085, 0.075, 0.228), 0.052),
        (dvec3(0.205, 0.1, 0.12), 0.04),
    ];
    d = join(d, limb(m, &brow, 0.05), 0.045);
    // Lids.
    let upper = ellipsoid(m, EYE + dvec3(0.0, 0.034, 0.003), dvec3(0.07, 0.036, 0.063));
    d = join(d, upper, 0.03);
    let lower = [
        (EYE + dvec3(0.06, -0.04, -0.005), 0.02),
        (EYE + dvec3(0.0, -0.057, 0.03), 0.022),
        (EYE + dvec3(-0.052, -0.045, 0.02), 0.016),
    ];
    d = join(d, limb(m, &lower, 0.03), 0.03);
    d = join(d, muzzle(m), 0.045);
    d = carve(d, mouth(m), 0.04);
    d = join(d, lower_lip(m), 0.04);
    d = join(d, nose(m), 0.04);
    d = carve(d, cone(m, (dvec3(0.038, -0.142, 0.325), 0.027), (dvec3(0.033, -0.11, 0.305), 0.018)), 0.035);
    d = join(d, ear(m), 0.05);
    // A wart or two, where no mirror puts them.
    d = join(d, sphere(p, dvec3(0.19, -0.12, 0.163), 0.022), 0.035);
    join(d, sphere(p, dvec3(-0.06, 0.17, 0.184), 0.022), 0.035)
}

/// Bridge, tip and wings.
fn nose(m: DVec3) -> f64 {
    let bridge = cone(m, (dvec3(0.0, 0.03, 0.235), 0.036), (dvec3(0.0, -0.065, 0.31), 0.05));
    let tip = ellipsoid(m, dvec3(0.0, -0.085, 0.315), dvec3(0.068, 0.055, 0.055));
    let wing = ellipsoid(m, dvec3(0.075, -0.098, 0.27), dvec3(0.046, 0.04, 0.052));
    join(join(bridge, tip, 0.04), wing, 0.03)
}

/// The upper lip.
fn muzzle(m: DVec3) -> f64 {
    let lip = [
        (dvec3(0.0, -0.155, 0.235), 0.045),
        (dvec3(0.1, -0.155, 0.195), 0.045),
        (dvec3(0.175, -0.185, 0.12), 0.03),
    ];
    limb(m, &lip, 0.03)
}

/// The slit between the lips, its corners turned down.
fn mouth(m: DVec3) -> f64 {
    let slit = [
        (dvec3(0.0, -0.19, 0.30), 0.026),
        (dvec3(0.1, -0.188, 0.25), 0.026),
        (dvec3(0.195, -0.225, 0.155), 0.02),
    ];
    limb(m, &slit, 0.04)
}

/// The lower lip, in front of the upper one, and the chin.
fn lower_lip(m: DVec3) -> f64 {
    let lip = [
        (dvec3(0.0, -0.225, 0.268), 0.036),
        (dvec3(0.095, -0.222, 0.235), 0.036),
        (dvec3(0.185, -0.245, 0.12), 0.026),
    ];
    let chin = ellipsoid(m, dvec3(0.0, -0.275, 0.185), dvec3(0.125, 0.07, 0.095));
    join(limb(m, &lip, 0.04), chin, 0.035)
}

/// The root of the left ear.
const EAR: DVec3 = dvec3(0.215, -0.01, -0.02);

/// The frame of the left ear: towards its tip, across it, out of its hollow side.
fn ear_axes() -> DMat3 {
    let along = dvec3(1.0, 0.34, -0.32).normalize();
    let front = dvec3(0.3, 0.1, 1.0);
    let front = (front - along * along.dot(front)).normalize();
    DMat3::from_cols(along, front.cross(along), front)
}

/// A point on the axis of the left (1) or right (−1) ear, `reach` from its root.
pub(crate) fn ear_point(side: f64, reach: f64) -> DVec3 {
    let p = EAR + ear_axes().x_axis * reach;
    dvec3(side * p.x, p.y, p.z)
}

/// A long, pointed, hollow ear.
fn ear(m: DVec3) -> f64 {
    let flat = 0.5;
    let q = ear_axes().transpose() * (m - EAR);
    let q = dvec3(q.x, q.y, q.z / flat);
    let shell = [
        (dvec3(0.0, 0.0, 0.0), 0.08),
        (dvec3(0.1, 0.012, 0.0), 0.098),
        (dvec3(0.21, 0.01, 0.0), 0.058),
        (dvec3(0.325, 0.035, -0.02), 0.03),
    ];
    let hollow = [
        (dvec3(0.075, 0.01, 0.085), 0.05),
        (dvec3(0.125, 0.012, 0.085), 0.054),
        (dvec3(0.225, 0.012, 0.06), 0.018),
    ];
    flat * carve(limb(q, &shell, 0.06), limb(q, &hollow, 0.05), 0.075)
}

/// The two tusks that stand out of the lower lip.
pub(crate) fn tusks(p: DVec3) -> f64 {
    let m = dvec3(p.x.abs(), p.y, p.z);
    let tusk = [
        (dvec3(0.1, -0.222, 0.215), 0.03),
        (dvec3(0.118, -0.165, 0.262), 0.033),
        (dvec3(0.132, -0.1, 0.268), 0.02),
        (dvec3(0.136, -0.062, 0.258), 0.017),
    ];
    let small = [(dvec3(0.04, -0.23, 0.262), 0.02), (dvec3(0.042, -0.172, 0.285), 0.016)];
    limb(m, &tusk, 0.04).min(limb(m, &small, 0.02))
}

/// The eyeballs.
pub(crate) fn eyes(p: DVec3) -> f64 {
    sphere(dvec3(p.x.abs(), p.y, p.z), EYE, EYE_RADIUS)
}

/// The pupils, thin caps on the eyeballs, that look a little to the left.
pub(crate) fn pupils(p: DVec3) -> f64 {
    [-1.0, 1.0]
        .map(|side| {
            let eye = dvec3(side * EYE.x, EYE.y, EYE.z);
            let look = dvec3(0.12, -0.1, 1.0).normalize();
            let right = look.cross(DVec3::Y).normalize();
            let axes = DMat3::from_cols(right, right.cross(look), look);
            turned_ellipsoid(p, eye + look * 0.043, axes, dvec3(0.027, 0.027, 0.019))
        })
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// The tips of the strands of hair, from their root.
pub(crate) const STRANDS: [DVec3; 6] = [
    dvec3(0.015, 0.27, -0.16),
    dvec3(0.125, 0.2, -0.2),
    dvec3(-0.125, 0.2, -0.17),
    dvec3(-0.02, 0.11, -0.29),
    dvec3(0.1, 0.06, -0.22),
    dvec3(-0.11, 0.07, -0.21),
];

/// A tuft of hair, tied on top of the head.
pub(crate) fn topknot(p: DVec3) -> f64 {
    let root = dvec3(0.0, 0.25, -0.07);
    STRANDS.iter().fold(cone(p, (root, 0.055), (root + dvec3(0.0, 0.08, -0.01), 0.036)), |d, &tip| {
        let bend = dvec3(tip.x * 0.6, 0.11 + tip.y * 0.22, tip.z * 0.45);
        let strand = [(root + dvec3(0.0, 0.07, -0.01), 0.03), (root + bend, 0.038), (root + tip, 0.021)];
        join(d, limb(p, &strand, 0.05), 0.035)
    })
}

/// The tie around the tuft.
pub(crate) fn tie(p: DVec3) -> f64 {
    let q = p - dvec3(0.0, 0.315, -0.079);
    let around = dvec3(q.x, 0.0, q.z).length() - 0.046;
    (around * around + q.y * q.y).sqrt() - 0.023
}

/// The middle of the ring in the left ear.
pub(crate) const EARRING: DVec3 = dvec3(0.305, -0.118, -0.05);

/// A ring through the left ear.
pub(crate) fn earring(p: DVec3) -> f64 {
    let q = p - EARRING;
    let around = (q.x * q.x * 0.5 + q.y * q.y + q.z * q.z * 0.5 + q.x * q.z).abs().sqrt() - 0.042;
    let across = (q.x - q.z) * std::f64::consts::FRAC_1_SQRT_2;
    (around * around + across * across).sqrt() - 0.02
}
