//! The well in the middle of the court: an octagonal kerb on two steps, two columns that carry a beam, a pulley, a rope
//! and a bucket. In meters.

use std::f64::consts::{FRAC_PI_8, PI};

use glam::{DVec2, DVec3, dvec3};

use crate::cloister::{Builder, DEEP, Finish, IMPOST, PARAPET};
use crate::cloister_arcade::Arcade;
use crate::cloister_masonry::{plan, points, united, upright};
use crate::curve::{half_circle, turned_plain, wire};
use crate::glb::Node;
use crate::outline::{Outline, circle};
use crate::plate::{Hole, Plate, Rim};
use crate::solid::{Axis, Solid};
use crate::temple_masonry::SUNK;

/// The kerb's upper side.
const KERB: f64 = 1.18;
/// Half the distance of the columns.
const POSTS: f64 = 1.32;
/// The steps' upper side.
const STEPS: f64 = 0.36;

/// A regular octagon with a side towards each axis.
fn octagon(half: f64) -> Outline {
    let corner = half / FRAC_PI_8.cos();
    circle(DVec2::ZERO, corner, 8).iter().map(|p| DVec2::from_angle(FRAC_PI_8).rotate(*p)).collect()
}

/// An octagonal body.
fn octagonal(half: f64, rim: Rim, bore: Option<f64>) -> Solid {
    let hole = |radius| Hole { outline: circle(DVec2::ZERO, radius, 40), chamfer: 0.02 };
    let holes = bore.map(hole).into_iter().collect();
    Plate { outline: octagon(half), rim, holes, ..Plate::default() }.solid().along(Axis::Y)
}

/// The well.
pub(crate) fn well(builder: &mut Builder, arcades: &Arcade) -> Node {
    let steps = united([
        octagonal(2.15, vec![(0.0, -DEEP), (0.0, 0.15), (0.03, 0.18)], None),
        octagonal(1.75, vec![(0.0, -0.5 * DEEP), (0.0, STEPS - 0.03), (0.03, STEPS)], None),
    ]);
    let kerb = octagonal(
        0.98,
        vec![
            (0.0, STEPS - 0.4 * DEEP),
            (0.0, STEPS + 0.12),
            (0.03, STEPS + 0.15),
            (0.06, STEPS + 0.16),
            (0.08, STEPS + 0.2),
            (0.08, KERB - 0.24),
            (0.05, KERB - 0.2),
            (0.01, KERB - 0.14),
            (-0.02, KERB - 0.12),
            (-0.02, KERB - 0.02),
            (0.0, KERB),
        ],
        Some(0.7),
    );
    let water = turned_plain(
        &points(&[(0.0, STEPS - 0.01), (0.72, STEPS - 0.01), (0.72, STEPS + 0.3), (0.0, STEPS + 0.3)]),
        40,
    );
    let half = 0.21;
    let pedestal = upright(
        &plan([-half, half], [-half, half]),
        &[
            (0.0, STEPS - 0.5 * DEEP),
            (0.0, STEPS + 0.1),
            (0.03, STEPS + 0.13),
            (0.03, PARAPET - 0.08),
            (0.0, PARAPET - 0.06),
            (0.0, PARAPET),
        ],
    );
    let pedestal = builder.mesh("pedestal", Finish::Stone, pedestal);
    let mut parts = vec![
        builder.part("steps", Finish::Paving, steps),
        builder.part("kerb", Finish::Pale, kerb),
        builder.part("water", Finish::Water, water),
    ];
    for (i, x) in [-POSTS, POSTS].into_iter().enumerate() {
        let node = Node::new(format!("pedestal.{}", i + 1), Some(pedestal));
        parts.push(Builder::placed(node, x, 0.0, 0.0));
        parts.push(arcades.column(&format!("post.{}", i + 1), x, 0.0));
    }
    parts.push(builder.part("beam", Finish::Pale, beam()));
    parts.push(builder.part("gable", Finish::Iron, ironwork()));
    parts.push(builder.part("pulley", Finish::Wood, pulley()));
    parts.push(builder.part("rope", Finish::Wood, rope()));
    parts.push(builder.part("bucket", Finish::Wood, bucket()));
    Node::new("well", None).with(parts)
}

/// The columns' capitals end here.
const BEAM: f64 = IMPOST - 0.195;

/// The beam upon the capitals.
fn beam() -> Solid {
    let [x, z] = [POSTS + 0.28, 0.24];
    upright(
        &plan([-x, x], [-z, z]),
        &[
            (0.05, BEAM - SUNK),
            (0.05, BEAM + 0.14),
            (0.03, BEAM + 0.16),
            (0.0, BEAM + 0.2),
            (0.0, BEAM + 0.26),
            (0.06, BEAM + 0.3),
        ],
    )
}

/// An arch of iron upon the beam with scrolls and a cross.
fn ironwork() -> Solid {
    let foot = BEAM + 0.28;
    let bow = |i: usize| {
        let (sin, cos) = (PI * f64::from(i as u32) / 20.0).sin_cos();
        dvec3(1.15 * cos, foot + 0.62 * sin, 0.0)
    };
    let bow: Vec<DVec3> = (0..=20).map(bow).collect();
    let scroll = |side: f64| -> Vec<DVec3> {
        (0..=20)
            .map(|i| {
                let part = f64::from(i) / 20.0;
                let radius = 0.27 - 0.2 * part;
                let (sin, cos) = (-0.5 * PI + 2.6 * PI * part).sin_cos();
                dvec3(side * (0.38 + radius * cos), foot + 0.26 + radius * sin, 0.0)
            })
            .collect()
    };
    let straight = |a: DVec3, b: DVec3| vec![a, a.lerp(b, 0.5), b];
    let top = foot + 0.6;
    united([
        wire(&bow, |_| 0.028),
        wire(&scroll(1.0), |_| 0.02),
        wire(&scroll(-1.0), |_| 0.02),
        wire(&straight(dvec3(0.0, foot - 0.04, 0.0), dvec3(0.0, top + 0.55, 0.0)), |_| 0.024),
        wire(&straight(dvec3(-0.17, top + 0.36, 0.0), dvec3(0.17, top + 0.36, 0.0)), |_| 0.022),
    ])
}

/// The middle of the pulley.
const PULLEY: f64 = BEAM - 0.3;

/// The pulley in its straps.
fn pulley() -> Solid {
    let profile = points(&[
        (0.0, -0.05),
        (0.16, -0.05),
        (0.17, -0.04),
        (0.135, 0.0),
        (0.17, 0.04),
        (0.16, 0.05),
        (0.0, 0.05),
    ]);
    let wheel = turned_plain(&profile, 28).bent(|p| dvec3(p.x, PULLEY - p.z, p.y));
    let strap = |z: f64| {
        upright(&plan([-0.025, 0.025], [z - 0.012, z + 0.012]), &[(0.0, PULLEY - 0.05), (0.0, BEAM + 0.01)])
    };
    united([wheel, strap(-0.08), strap(0.08)])
}

/// The rope over the pulley: down to the bucket, and to a loop beside it.
fn rope() -> Solid {
    let mut path = vec![dvec3(-0.15, KERB + 0.62, 0.0), dvec3(-0.15, KERB + 0.85, 0.0)];
    path.extend((0..=10).map(|i| {
        let (sin, cos) = (PI * (1.0 - f64::from(i) / 10.0)).sin_cos();
        dvec3(0.15 * cos, PULLEY + 0.15 * sin, 0.0)
    }));
    path.extend([dvec3(0.15, KERB + 0.5, 0.0), dvec3(0.15, KERB - 0.4, 0.0)]);
    wire(&path, |_| 0.016)
}

/// A bucket of staves with a handle.
fn bucket() -> Solid {
    let low = KERB + 0.02;
    let body = turned_plain(
        &points(&[
            (0.0, low),
            (0.13, low),
            (0.137, low + 0.06),
            (0.147, low + 0.06),
            (0.15, low + 0.09),
            (0.14, low + 0.09),
            (0.158, low + 0.24),
            (0.168, low + 0.24),
            (0.171, low + 0.27),
            (0.161, low + 0.27),
            (0.165, low + 0.32),
            (0.145, low + 0.32),
            (0.12, low + 0.05),
            (0.0, low + 0.05),
        ]),
        28,
    );
    let handle: Vec<DVec3> = (0..=16)
        .map(|i| {
            let (sin, cos) = (PI * f64::from(i) / 16.0).sin_cos();
            dvec3(0.155 * cos, low + 0.3 + 0.3 * sin, 0.0)
        })
        .collect();
    let knot = turned_plain(&half_circle(0.04, 8), 16).moved(0.0, low + 0.61, 0.0);
    united([body, wire(&handle, |_| 0.013), knot]).moved(-0.15, 0.0, 0.0)
}
