//! The ogre's body and its pose: standing, the left hand raised, the right one on a club. Facing +Z, feet at `y = 0`.

use std::sync::LazyLock;

use glam::{DMat3, DVec3, dvec3};

use crate::ogre_head;
use crate::sdf::{carve, cone, ellipsoid, join, join_near, limb, meet, sphere, turned_ellipsoid};

/// The middle of the head.
const HEAD: DVec3 = dvec3(0.01, 1.585, 0.16);
/// How much larger the head is than in its own space.
const HEAD_SCALE: f64 = 1.12;

/// A point in the head's own space.
pub(crate) fn head_from_world(p: DVec3) -> DVec3 {
    HEAD_TURN.transpose() * (p - HEAD) / HEAD_SCALE
}

/// The other way round.
pub(crate) fn world_from_head(p: DVec3) -> DVec3 {
    *HEAD_TURN * p * HEAD_SCALE + HEAD
}

/// The head's axes: turned to its left, leaning a little.
static HEAD_TURN: LazyLock<DMat3> =
    LazyLock::new(|| DMat3::from_rotation_y(0.34) * DMat3::from_rotation_z(-0.07));

/// A distance measured in the head's space, in the world's.
pub(crate) fn in_head(p: DVec3, f: impl Fn(DVec3) -> f64) -> f64 {
    f(head_from_world(p)) * HEAD_SCALE
}

/// The raised hand's wrist, the direction of its fingers and of its palm.
pub(crate) const LEFT_WRIST: DVec3 = dvec3(0.99, 1.5, 0.16);
/// Where the club leaves the fist upwards.
pub(crate) const CLUB_TOP: DVec3 = dvec3(-0.72, 0.93, 0.28);
/// Where it stands on the ground.
pub(crate) const CLUB_FOOT: DVec3 = dvec3(-0.98, 0.17, 0.46);
/// The middle of the fist on the club's axis.
pub(crate) const GRIP: DVec3 = dvec3(-0.777, 0.763, 0.3195);

/// A row of digits: balls from knuckle to tip, and the direction of the nail.
pub(crate) type Digit = ([(DVec3, f64); 3], DVec3);

/// The fingers and the thumb of the raised hand.
pub(crate) static OPEN: LazyLock<[Digit; 4]> = LazyLock::new(|| {
    let (up, palm, side) = open_axes();
    let finger = |off: f64, length: f64| {
        let root = LEFT_WRIST + up * 0.19 + side * off * 0.85;
        let way = (up + side * off * 3.4 + palm * 0.1).normalize();
        let bent = (way * 0.8 + palm * 0.6).normalize();
        let middle = root + way * length;
        let tip = middle + bent * length * 0.85;
        ([(root, 0.052), (middle, 0.048), (tip, 0.042)], (bent * 0.75 - palm).normalize())
    };
    let root = LEFT_WRIST + up * 0.06 - side * 0.08 + palm * 0.02;
    let middle = root - side * 0.1 + up * 0.06 + palm * 0.03;
    let tip = middle - side * 0.03 + up * 0.085 + palm * 0.02;
    let thumb = ([(root, 0.056), (middle, 0.05), (tip, 0.043)], (up - palm).normalize());
    [finger(-0.1, 0.122), finger(0.0, 0.135), finger(0.1, 0.117), thumb]
});

/// The raised hand's axes: along the fingers, out of the palm, away from the thumb.
pub(crate) fn open_axes() -> (DVec3, DVec3, DVec3) {
    let up = dvec3(0.2, 1.0, 0.12).normalize();
    let palm = dvec3(0.1, 0.0, 1.0);
    let palm = (palm - up * up.dot(palm)).normalize();
    (up, palm, up.cross(palm))
}

/// The fist's axes: up the club, from the club to the wrist, across.
pub(crate) fn fist_axes() -> (DVec3, DVec3, DVec3) {
    let up = (CLUB_TOP - CLUB_FOOT).normalize();
    let out = RIGHT_ARM[2].0 - GRIP;
    let out = (out - up * up.dot(out)).normalize();
    (up, out, up.cross(out))
}

/// The fingers and the thumb around the club.
pub(crate) static FIST: LazyLock<[Digit; 4]> = LazyLock::new(|| {
    let (up, out, across) = fist_axes();
    let on = |angle: f64, height: f64, radius: f64| {
        let angle = angle.to_radians();
        GRIP + up * height + (out * angle.cos() + across * angle.sin()) * radius
    };
    let finger = |height: f64| {
        let balls = [
            (on(50.0, height, 0.115), 0.05),
            (on(125.0, height, 0.108), 0.048),
            (on(205.0, height, 0.1), 0.043),
        ];
        (balls, (on(160.0, 0.0, 1.0) - GRIP).normalize())
    };
    let thumb =
        [(on(-40.0, 0.04, 0.11), 0.054), (on(-85.0, 0.12, 0.112), 0.049), (on(-140.0, 0.165, 0.105), 0.042)];
    [finger(-0.098), finger(0.0), finger(0.095), (thumb, (on(-115.0, 0.02, 1.0) - GRIP).normalize())]
});

/// The arm that leans on the club: shoulder, elbow, wrist.
pub(crate) const RIGHT_ARM: [(DVec3, f64); 3] = [
    (dvec3(-0.46, 1.27, -0.02), 0.19),
    (dvec3(-0.76, 1.03, -0.06), 0.125),
    (dvec3(-0.80, 0.83, 0.17), 0.098),
];

/// The raised arm.
pub(crate) const LEFT_ARM: [(DVec3, f64); 3] =
    [(dvec3(0.46, 1.29, -0.02), 0.19), (dvec3(0.85, 1.13, 0.03), 0.125), (LEFT_WRIST, 0.098)];

/// An arm without its hand: muscles on two bones.
fn arm(p: DVec3, joints: &[(DVec3, f64); 3]) -> f64 {
    let [(shoulder, r), (elbow, _), (wrist, _)] = *joints;
    let mut d = limb(p, joints, 0.06);
    d = join(d, sphere(p, shoulder, r * 1.1), 0.08);
    let biceps = shoulder.lerp(elbow, 0.55);
    d = join(d, sphere(p, biceps + dvec3(0.0, 0.02, 0.03), 0.135), 0.08);
    let forearm = elbow.lerp(wrist, 0.35);
    join(d, sphere(p, forearm + dvec3(0.0, 0.0, -0.01), 0.138), 0.1)
}

/// The left arm with its open hand.
fn left_arm(p: DVec3) -> f64 {
    let mut d = arm(p, &LEFT_ARM);
    let (up, palm, side) = open_axes();
    if p.distance(LEFT_WRIST + up * 0.2) - 0.4 > d + 0.05 {
        return d;
    }
    let axes = DMat3::from_cols(side, up, palm);
    let flat = dvec3(0.125, 0.135, 0.078);
    d = join(d, turned_ellipsoid(p, LEFT_WRIST + up * 0.11, axes, flat), 0.05);
    OPEN.iter().fold(d, |d, (balls, _)| join(d, limb(p, balls, 0.04), 0.04))
}

/// The right arm with its fist.
fn right_arm(p: DVec3) -> f64 {
    let mut d = arm(p, &RIGHT_ARM);
    if p.distance(GRIP) - 0.35 > d + 0.05 {
        return d;
    }
    let (up, out, _) = fist_axes();
    let heel = (GRIP + out * 0.1 - up * 0.05, 0.085);
    d = join(d, cone(p, heel, (GRIP + out * 0.1 + up * 0.06, 0.085)), 0.05);
    FIST.iter().fold(d, |d, (balls, _)| join(d, limb(p, balls, 0.04), 0.035))
}

/// Chest, belly, pelvis and neck, without limbs.
pub(crate) fn trunk(p: DVec3) -> f64 {
    let m = dvec3(p.x.abs(), p.y, p.z);
    let mut d = ellipsoid(p, dvec3(0.0, 1.15, -0.02), dvec3(0.43, 0.33, 0.31));
    d = join(d, ellipsoid(p, dvec3(0.0, 0.855, 0.12), dvec3(0.44, 0.335, 0.41)), 0.12);
    d = join(d, ellipsoid(p, dvec3(0.0, 0.62, -0.01), dvec3(0.37, 0.2, 0.29)), 0.12);
    d = join(d, cone(m, (dvec3(0.0, 1.38, -0.04), 0.2), (dvec3(0.36, 1.31, -0.04), 0.16)), 0.1);
    join(d, cone(p, (dvec3(0.0, 1.33, 0.0), 0.2), (dvec3(0.0, 1.5, 0.06), 0.19)), 0.08)
}

/// A leg, its foot turned out; `side` is −1 or 1, `step` moves the foot forwards.
fn leg(p: DVec3, side: f64, step: f64) -> f64 {
    let hip = dvec3(side * 0.23, 0.56, 0.0);
    let knee = dvec3(side * 0.3, 0.35, 0.08 + step);
    let ankle = dvec3(side * 0.3, 0.13, step);
    let mut d = limb(p, &[(hip, 0.23), (knee, 0.165), (ankle, 0.125)], 0.07);
    d = join(d, sphere(p, dvec3(side * 0.31, 0.26, step - 0.02), 0.145), 0.08);
    d = join(d, sphere(p, knee + dvec3(0.0, 0.0, 0.085), 0.085), 0.07);
    let (way, across) = foot_axes(side);
    let sole = ankle + way * 0.1 - DVec3::Y * 0.055;
    let axes = DMat3::from_cols(across, DVec3::Y, way);
    d = join(d, turned_ellipsoid(p, sole, axes, dvec3(0.145, 0.085, 0.2)), 0.08);
    for (balls, _) in &TOES[if side > 0.0 { 0..3 } else { 3..6 }] {
        d = join_near(d, 0.04, p, (balls[1].0, 0.17), |p| limb(p, balls, 0.04));
    }
    meet(d, -p.y, 0.08)
}

/// A foot's axes: forwards, and across towards the outside.
pub(crate) fn foot_axes(side: f64) -> (DVec3, DVec3) {
    let way = dvec3(side * 0.38, 0.0, 1.0).normalize();
    (way, DVec3::Y.cross(way) * side)
}

/// The toes of a foot, the big one first.
fn toes(side: f64, step: f64) -> [Digit; 3] {
    let (way, across) = foot_axes(side);
    let ankle = dvec3(side * 0.3, 0.13, step);
    [(-0.09, 0.275, 0.066), (0.012, 0.28, 0.056), (0.098, 0.25, 0.05)].map(|(off, reach, r)| {
        let root = ankle + way * (reach - 0.1) + across * off * 0.9 + DVec3::Y * (r + 0.012 - 0.13);
        let knuckle = root + way * 0.05 + across * off * 0.1 + DVec3::Y * 0.012;
        let tip = root + way * 0.085 + across * off * 0.16 - DVec3::Y * 0.008;
        ([(root, r), (knuckle, r), (tip, r * 0.92)], (way + DVec3::Y * 0.75).normalize())
    })
}

/// How far the left and the right foot stand forwards.
pub(crate) const STEPS: [f64; 2] = [0.07, -0.05];

/// The toes of the left, then of the right foot.
pub(crate) static TOES: LazyLock<Vec<Digit>> =
    LazyLock::new(|| [toes(1.0, STEPS[0]), toes(-1.0, STEPS[1])].concat());

/// The legs.
fn legs(p: DVec3) -> f64 {
    join(leg(p, 1.0, STEPS[0]), leg(p, -1.0, STEPS[1]), 0.05)
}

/// All of the ogre's skin.
pub(crate) fn skin(p: DVec3) -> f64 {
    let m = dvec3(p.x.abs(), p.y, p.z);
    let mut d = trunk(p);
    // Breast, shoulder blades, spine, navel.
    d = join(d, ellipsoid(m, dvec3(0.185, 1.185, 0.185), dvec3(0.19, 0.125, 0.145)), 0.06);
    d = join(d, ellipsoid(m, dvec3(0.2, 1.2, -0.25), dvec3(0.13, 0.16, 0.085)), 0.08);
    d = carve(d, cone(p, (dvec3(0.0, 1.38, -0.3), 0.03), (dvec3(0.0, 0.75, -0.335), 0.03)), 0.09);
    d = carve(d, ellipsoid(p, dvec3(0.0, 0.86, 0.545), dvec3(0.032, 0.042, 0.06)), 0.04);
    d = join(d, legs(p), 0.07);
    d = join_near(d, 0.08, p, (dvec3(0.8, 1.4, 0.1), 0.78), left_arm);
    d = join_near(d, 0.08, p, (dvec3(-0.7, 1.03, 0.08), 0.65), right_arm);
    join_near(d, 0.06, p, (HEAD, 0.65), |p| in_head(p, ogre_head::skin))
}

/// Finger and toe nails.
pub(crate) fn nails(p: DVec3) -> f64 {
    let digits = OPEN.iter().chain(&*FIST).chain(&*TOES);
    digits
        .map(|&([_, (middle, _), (tip, r)], out)| {
            if p.distance(tip) > 5.0 * r {
                return p.distance(tip) - 2.0 * r;
            }
            let along = (tip - middle).normalize();
            let out = (out - along * along.dot(out) * 0.6).normalize();
            cone(
                p,
                (tip + (along * 0.15 + out * 0.55) * r, 0.62 * r),
                (tip + (along * 1.7 + out * 0.4) * r, 0.33 * r),
            )
        })
        .fold(f64::INFINITY, f64::min)
}

/// Both forearms without elbow and hand: distance, place along it (0 = elbow, 1 = wrist), length.
pub(crate) fn forearms(p: DVec3) -> [(f64, f64, f64); 2] {
    [&LEFT_ARM, &RIGHT_ARM].map(|joints| {
        let [_, elbow, wrist] = *joints;
        let axis = wrist.0 - elbow.0;
        let muscle = sphere(p, elbow.0.lerp(wrist.0, 0.35) - DVec3::Z * 0.01, 0.138);
        let distance = join(cone(p, elbow, wrist), muscle, 0.1);
        let along = (p - elbow.0).dot(axis) / axis.length_squared();
        (distance, along, axis.length())
    })
}
