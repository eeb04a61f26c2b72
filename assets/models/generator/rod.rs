//! A connecting rod around its crank pin: shank and cap, bolts, bushing and shells. `+Y` points to the piston.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, dvec2};

use crate::crank::ROD;
use crate::crankshaft::{half_ring, pin_radius, tube};
use crate::outline::{Outline, arc, circle, hexagon, mirrored, rounded, upside_down};
use crate::plate::{Hole, Plate, Step, chamfered};
use crate::solid::{Axis, Solid};

/// Radius of the big end's bore.
const BORE: f64 = 25.25;
/// Radius of the small end.
const EYE: f64 = 17.0;
/// Half the gap between shank and cap.
const GAP: f64 = 0.2;
/// Half the thickness without the pads around the big end.
const HALF: f64 = 9.0;
/// The height of those pads.
const PAD: f64 = 2.0;
/// Where the bolts' heads touch the cap.
pub(crate) const BOLT_Y: f64 = -13.6;
/// How far the bolts stand beside the pin's axis.
pub(crate) const BOLT_Z: f64 = 32.0;

/// The right half of the shank's silhouette, from the parting face upwards.
fn shank_side() -> Vec<DVec2> {
    let eye = dvec2(0.0, ROD);
    let (foot, neck) = (dvec2(14.5, 42.0), dvec2(10.5, 122.0));
    let mut side: Vec<DVec2> = rounded(
        &[
            ((BORE * BORE - GAP * GAP).sqrt(), GAP, 0.0),
            (38.5, GAP, 0.0),
            (38.5, 13.0, 5.0),
            (foot.x, foot.y, 22.0),
            (neck.x, neck.y, 0.0),
        ],
        0.35,
    );
    side.pop();
    // The fillet of radius `f` that touches the beam's flank and the eye.
    let f = 14.0;
    let up = (neck - foot).normalize();
    let out = -up.perp();
    let start = neck + out * f - eye;
    let along = start.dot(up);
    let reach = (EYE + f).powi(2) - start.length_squared() + along * along;
    let center = eye + start - up * (along + reach.sqrt());
    let to_eye = (eye - center).to_angle();
    let from = (-out).to_angle().rem_euclid(2.0 * PI);
    side.extend(arc(center, f, from, to_eye, 4));
    side.extend(arc(eye, EYE, to_eye - PI, FRAC_PI_2, 9).iter().skip(1));
    side
}

/// The pad around half the big end's bore.
fn pad() -> Step {
    Step::new(half_ring(BORE + 2.2, 33.5, 2.5, 9), 0.4, PAD)
}

/// The shank: eye, I-beam and the upper half of the big end.
pub(crate) fn shank() -> Solid {
    let mut outline = mirrored(&shank_side());
    let bore = arc(DVec2::ZERO, BORE, PI - (GAP / BORE).asin(), (GAP / BORE).asin(), 16);
    outline.extend(&bore[1..bore.len() - 1]);
    let pocket = rounded(&[(-9.5, 46.0, 4.0), (9.5, 46.0, 4.0), (6.4, 118.0, 4.0), (-6.4, 118.0, 4.0)], 0.8);
    let eye = dvec2(0.0, ROD);
    let steps = vec![pad(), Step::new(pocket, 1.2, -5.5)];
    Plate {
        outline,
        rim: chamfered(HALF, 1.0),
        front: steps.clone(),
        back: steps,
        holes: vec![Hole { outline: circle(eye, 12.25, 20), chamfer: 0.0 }],
    }
    .solid()
    .along(Axis::X)
}

/// The cap below the parting face, with shoulders for the bolts' heads.
pub(crate) fn cap() -> Solid {
    let outer: f64 = 33.4;
    let shoulder = -BOLT_Y - 0.4;
    let corner: f64 = 25.4;
    let mut upper: Vec<(f64, f64, f64)> = vec![
        ((BORE * BORE - GAP * GAP).sqrt(), GAP, 0.0),
        (38.5, GAP, 0.0),
        (38.5, shoulder, 1.5),
        (corner, shoulder, 0.8),
    ];
    let from = (corner / outer).acos();
    upper.extend(arc(DVec2::ZERO, outer, from, FRAC_PI_2, 5).iter().map(|p| (p.x, p.y, 0.0)));
    let left = upper.iter().rev().skip(1).map(|&(x, y, r)| (-x, y, r));
    let corners: Vec<_> = upper.iter().copied().chain(left).collect();
    let mut outline: Outline = rounded(&corners, 0.6);
    let bore = arc(DVec2::ZERO, BORE, PI - (GAP / BORE).asin(), (GAP / BORE).asin(), 16);
    outline.extend(&bore[1..bore.len() - 1]);
    // Between the bolts' shoulders.
    let mut crescent = arc(DVec2::ZERO, 31.4, 0.9, PI - 0.9, 6);
    crescent.extend(arc(DVec2::ZERO, BORE + 2.2, PI - 0.9, 0.9, 6));
    let narrow = Step::new(crescent, 0.4, PAD);
    let turned = Step { outline: upside_down(&narrow.outline), ..narrow };
    Plate {
        outline: upside_down(&outline),
        rim: chamfered(HALF, 1.0),
        front: vec![turned.clone()],
        back: vec![turned],
        ..Plate::default()
    }
    .solid()
    .along(Axis::X)
}

/// A bolt with its head's bearing face at the origin, head down, thread up.
pub(crate) fn bolt() -> Solid {
    hex_bolt(11.0, 7.0, 3.8, 23.0, 12).along(Axis::Down)
}

/// A hexagon bolt: head towards +w from the origin, shank towards −w.
pub(crate) fn hex_bolt(flats: f64, head: f64, radius: f64, length: f64, segments: usize) -> Solid {
    let mut shank = Step::new(circle(DVec2::ZERO, radius, segments), 0.0, length - 0.8);
    shank.rim.push((0.8, length));
    Plate {
        outline: hexagon(flats),
        rim: vec![(0.0, 0.0), (0.0, head - 0.8), (1.0, head)],
        back: vec![shank],
        ..Plate::default()
    }
    .solid()
}

/// The bushing in the eye.
pub(crate) fn bushing() -> Solid {
    tube(10.25, 12.0, HALF + 0.4, 0.0, 20).solid().along(Axis::X)
}

/// The upper shell of the big end's bearing.
pub(crate) fn shell() -> Solid {
    Plate {
        outline: half_ring(pin_radius() + 0.3, BORE - 0.25, 0.15, 10),
        rim: vec![(0.0, -10.0), (0.0, 10.0)],
        ..Plate::default()
    }
    .solid()
    .along(Axis::X)
}
