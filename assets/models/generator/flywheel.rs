//! What turns with the crankshaft at its ends: flywheel, timing gear, pulley and their bolts.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::outline::{circle, gear};
use crate::plate::{Hole, Plate, Step, chamfered};
use crate::rod::hex_bolt;
use crate::solid::{Axis, Solid};

/// The flywheel's middle along the crankshaft.
pub(crate) const AT: f64 = -173.0;
/// Half the width of its rim.
const HALF: f64 = 13.5;
/// Bolts that hold it.
pub(crate) const BOLTS: usize = 6;
/// Radius of the circle that they stand on.
pub(crate) const BOLT_CIRCLE: f64 = 25.0;
/// Where their heads touch, from the flywheel's middle.
pub(crate) const BOLT_X: f64 = -9.1;
/// The timing gear's middle.
pub(crate) const GEAR_AT: f64 = 157.5;
/// The pulley's middle.
pub(crate) const PULLEY_AT: f64 = 179.0;

/// The angle of a bolt around the axis.
pub(crate) fn bolt_angle(i: usize) -> f64 {
    TAU * i as f64 / BOLTS as f64
}

/// The disc: rim, sunk web with lightening holes, hub with bolt holes.
pub(crate) fn disc() -> Solid {
    let around = |radius: f64, hole: f64, shift: f64, n: usize, chamfer: f64| {
        (0..BOLTS).map(move |i| Hole {
            outline: circle(radius * DVec2::from_angle(bolt_angle(i) + shift), hole, n),
            chamfer,
        })
    };
    let mut holes = vec![Hole { outline: circle(DVec2::ZERO, 11.0, 18), chamfer: 0.0 }];
    holes.extend(around(BOLT_CIRCLE, 4.4, 0.0, 10, 0.0));
    holes.extend(around(63.0, 13.0, TAU / 12.0, 17, 0.0));
    let sunk = |hub: f64| {
        Step::new(circle(DVec2::ZERO, 90.0, 64), 4.0, -7.0).with(vec![Step::new(
            circle(DVec2::ZERO, 40.0, 28),
            3.0,
            hub,
        )])
    };
    Plate {
        outline: circle(DVec2::ZERO, 108.0, 72),
        rim: chamfered(HALF, 1.5),
        front: vec![sunk(7.0)],
        back: vec![sunk(3.0)],
        holes,
    }
    .solid()
    .along(Axis::X)
}

/// The ring gear shrunk onto the disc.
pub(crate) fn ring_gear() -> Solid {
    Plate {
        outline: gear(60, 109.6, 114.6),
        rim: vec![(0.0, -2.0), (0.0, 8.0)],
        holes: vec![Hole { outline: circle(DVec2::ZERO, 104.0, 48), chamfer: 0.0 }],
        ..Plate::default()
    }
    .solid()
    .along(Axis::X)
}

/// A bolt of the flywheel, head towards +X.
pub(crate) fn bolt() -> Solid {
    hex_bolt(12.0, 7.0, 4.0, 26.0, 12).along(Axis::X)
}

/// The gear that drives the valves.
pub(crate) fn timing_gear() -> Solid {
    Plate {
        outline: gear(20, 31.0, 36.0),
        rim: vec![(0.0, -6.0), (0.0, 6.0)],
        front: vec![Step::new(circle(DVec2::ZERO, 26.0, 24), 0.6, 2.0)],
        ..Plate::default()
    }
    .solid()
    .along(Axis::X)
}

/// The belt pulley: a V groove, a sunk face with round windows.
pub(crate) fn pulley() -> Solid {
    let mut wheel = Plate::turned(
        &[
            (54.5, -11.0),
            (56.0, -9.5),
            (56.0, -7.0),
            (47.0, -3.0),
            (47.0, 3.0),
            (56.0, 7.0),
            (56.0, 9.5),
            (54.5, 11.0),
        ],
        56,
    );
    let hub = Step::new(circle(DVec2::ZERO, 22.0, 24), 1.0, 6.0);
    wheel.front = vec![Step::new(circle(DVec2::ZERO, 43.0, 48), 2.0, -8.0).with(vec![hub])];
    wheel.holes = (0..5)
        .map(|i| Hole {
            outline: circle(31.5 * DVec2::from_angle(TAU * f64::from(i) / 5.0), 6.5, 16),
            chamfer: 0.0,
        })
        .collect();
    wheel.solid().along(Axis::X)
}

/// The washer between the pulley and its bolt.
pub(crate) fn washer() -> Solid {
    Plate { outline: circle(DVec2::ZERO, 18.5, 24), rim: vec![(0.0, -1.5), (0.0, 1.5)], ..Plate::default() }
        .solid()
        .along(Axis::X)
        .moved(10.3, 0.0, 0.0)
}

/// The bolt that holds the pulley.
pub(crate) fn nose_bolt() -> Solid {
    hex_bolt(21.0, 11.0, 7.0, 40.0, 16).along(Axis::X).moved(11.6, 0.0, 0.0)
}
