//! The parts of the crankshaft, each around its own origin, and the shells of its bearings.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, dvec2};

use crate::crank::{PITCH, THROW};
use crate::outline::{Outline, arc, circle, rounded, upside_down};
use crate::plate::{Hole, Plate, Step, chamfered};
use crate::solid::{Axis, Solid};

/// From a throw's middle to the middle of its webs.
pub(crate) const WEB_AT: f64 = 21.5;
/// Half the thickness of a web.
const WEB_HALF: f64 = 8.5;
/// How far the thrust faces around journals and pins stand out of a web.
const COLLAR: f64 = 1.5;
/// Radius of the main journals.
const JOURNAL: f64 = 26.0;
/// Radius of the crank pins.
const PIN: f64 = 22.5;
/// Radius of the fillets where journals and pins meet the webs.
const FILLET: f64 = 3.0;

/// A web: rounded around the pin, with a fan-shaped counterweight; the main journal's side faces −X.
pub(crate) fn web() -> Solid {
    let mut right: Vec<(f64, f64, f64)> =
        arc(DVec2::ZERO, 74.0, -FRAC_PI_2, -0.6, 6).iter().map(|p| (p.x, p.y, 0.0)).collect();
    right.extend([(66.5, -27.0, 9.0), (37.0, -6.0, 16.0)]);
    right.extend(arc(dvec2(0.0, THROW), 31.5, 0.0, FRAC_PI_2, 7).iter().map(|p| (p.x, p.y, 0.0)));
    let left = right.iter().rev().skip(1).map(|&(x, y, r)| (-x, y, r));
    let mut corners: Vec<_> = right.iter().copied().chain(left).collect();
    corners.pop();
    let collar = |y, radius, n| Step::new(circle(dvec2(0.0, y), radius, n), 0.4, COLLAR);
    Plate {
        outline: rounded(&corners, 0.45),
        rim: chamfered(WEB_HALF, 2.0),
        back: vec![collar(0.0, 32.0, 32)],
        front: vec![collar(THROW, 28.0, 28)],
        ..Plate::default()
    }
    .solid()
    .along(Axis::X)
}

/// A turned cylinder between two collars, `half` from its middle, with fillets that run into them.
fn filleted(radius: f64, half: f64, segments: usize) -> Solid {
    let mut side: Vec<DVec2> = (0..=2)
        .map(|i| {
            let angle = 1.3 * f64::from(i) / 2.0;
            dvec2(radius + FILLET * (1.0 - angle.cos()), half - FILLET + FILLET * angle.sin())
        })
        .collect();
    // The last chord goes on into the collar.
    side[2] = side[2].lerp(side[1], -0.4);
    let back = side.iter().rev().map(|p| (p.x, -p.y));
    let profile: Vec<_> = back.chain(side.iter().map(|p| (p.x, p.y))).collect();
    Plate::turned(&profile, segments).solid().along(Axis::X)
}

/// A main journal.
pub(crate) fn journal() -> Solid {
    filleted(JOURNAL, PITCH / 2.0 - WEB_AT - WEB_HALF - COLLAR, 32)
}

/// A crank pin.
pub(crate) fn pin() -> Solid {
    filleted(PIN, WEB_AT - WEB_HALF - COLLAR, 24)
}

/// The stepped shaft in front of the first journal.
pub(crate) fn nose() -> Solid {
    let profile = [(27.0, 140.0), (27.0, 149.0), (18.0, 149.0), (18.0, 171.0), (15.0, 171.0), (15.0, 189.0)];
    Plate::turned(&profile, 24).solid().along(Axis::X)
}

/// The flange that carries the flywheel.
pub(crate) fn flange() -> Solid {
    let profile =
        [(37.0, -160.0), (37.0, -150.0), (36.0, -149.0), (31.0, -149.0), (28.0, -146.5), (28.0, -140.0)];
    Plate::turned(&profile, 28).solid().along(Axis::X)
}

/// Half a ring in the (u, v) plane, above `v = gap`.
pub(crate) fn half_ring(inner: f64, outer: f64, gap: f64, n: usize) -> Outline {
    let (a, b) = ((gap / outer).asin(), (gap / inner).asin());
    let mut out = arc(DVec2::ZERO, outer, a, PI - a, n);
    out.extend(arc(DVec2::ZERO, inner, PI - b, b, n));
    out
}

/// The lower shell of a main bearing; the upper one is left out so that the journal shows.
pub(crate) fn main_shell() -> Solid {
    Plate {
        outline: upside_down(&half_ring(JOURNAL + 0.35, JOURNAL + 3.2, 0.2, 22)),
        rim: vec![(0.0, -9.0), (0.0, 9.0)],
        ..Plate::default()
    }
    .solid()
    .along(Axis::X)
}

/// A ring of rectangular section, chamfered outside.
pub(crate) fn tube(inner: f64, outer: f64, half: f64, chamfer: f64, segments: usize) -> Plate {
    Plate {
        outline: circle(DVec2::ZERO, outer, segments),
        rim: if chamfer > 0.0 { chamfered(half, chamfer) } else { vec![(0.0, -half), (0.0, half)] },
        holes: vec![Hole { outline: circle(DVec2::ZERO, inner, segments), chamfer: 0.0 }],
        ..Plate::default()
    }
}

/// Radius of the pins, for the rods that turn on them.
pub(crate) const fn pin_radius() -> f64 {
    PIN
}
