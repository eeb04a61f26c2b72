//! What the cloister is built from besides blocks: frames around a square, arches, walls with round-arched openings.
//! In meters.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, dvec2, dvec3};

use crate::cloister::DEEP;
use crate::delaunay;
use crate::outline::{Outline, arc};
use crate::plate::{Hole, Plate, Rim};
use crate::solid::{Axis, Solid};
use crate::temple_masonry::Span;

/// Chords of an arch: enough that it is round, and none of its edges is drawn.
pub(crate) const CHORDS: usize = 24;
/// Chords of the arch over a door or window.
const FEWER: usize = 16;

/// Leads a section around a square with mitered corners; the section, counter-clockwise, is given by distance from the
/// square's middle and height.
pub(crate) fn frame(section: &[DVec2]) -> Solid {
    // Long sides are cut, so that their narrow bands are not needles.
    const PIECES: usize = 6;
    let side = |quarter: usize| {
        let (out, along) = [
            (DVec3::Z, DVec3::X),
            (DVec3::NEG_X, DVec3::Z),
            (DVec3::NEG_Z, DVec3::NEG_X),
            (DVec3::X, DVec3::NEG_Z),
        ][quarter];
        (0..PIECES).map(move |i| out + along * (1.0 - 2.0 * i as f64 / PIECES as f64))
    };
    let rings: Vec<Vec<DVec3>> = (0..4)
        .flat_map(side)
        .map(|way| section.iter().map(|p| way * p.x + DVec3::Y * p.y).collect())
        .collect();
    let mut solid = Solid::default();
    for (i, ring) in rings.iter().enumerate() {
        solid.band(ring, &rings[(i + 1) % rings.len()]);
    }
    solid
}

/// Points of a section from pairs.
pub(crate) fn points(pairs: &[(f64, f64)]) -> Outline {
    pairs.iter().map(|&pair| DVec2::from(pair)).collect()
}

/// A half ellipse about the origin, from its right end over the top, and its outward normals.
fn half_ellipse(span: f64, rise: f64, chords: usize) -> impl Iterator<Item = (DVec2, DVec2)> {
    (0..=chords).map(move |i| {
        let (sin, cos) = (PI * i as f64 / chords as f64).sin_cos();
        // Exactly level at both ends.
        let sin = if i % chords == 0 { 0.0 } else { sin };
        (dvec2(span * cos, rise * sin), dvec2(rise * cos, span * sin).normalize())
    })
}

/// A section led over a half ellipse in the plane of x and y, given by half its span and its rise; the section,
/// counter-clockwise, is given by distance outwards from the curve and by z.
pub(crate) fn arch(span: f64, rise: f64, chords: usize, section: &[DVec2]) -> Solid {
    let ring = |(at, out): (DVec2, DVec2)| -> Vec<DVec3> {
        section.iter().map(|p| (at + out * p.x).extend(p.y)).collect()
    };
    let rings: Vec<_> = half_ellipse(span, rise, chords).map(ring).collect();
    let mut solid = Solid::default();
    for pair in rings.windows(2) {
        solid.band(&pair[1], &pair[0]);
    }
    let corner = |ring: &[DVec3], p: DVec2| {
        section.iter().position(|q| *q == p).map(|i| ring[i]).expect("filling adds no points")
    };
    for triangle in delaunay::fill(&section.to_vec(), &[]) {
        let [a, b, c] = triangle.map(|p| corner(&rings[0], p));
        solid.triangle(a, b, c);
        let [a, b, c] = triangle.map(|p| corner(&rings[chords], p));
        solid.triangle(a, c, b);
    }
    solid
}

/// The half ellipse from left to right, as the underside of an outline.
pub(crate) fn soffit(middle: f64, foot: f64, span: f64, rise: f64) -> Outline {
    let chords = if span < 1.0 { FEWER } else { CHORDS };
    let mut out: Outline = half_ellipse(span, rise, chords).map(|(p, _)| p + dvec2(middle, foot)).collect();
    out.reverse();
    out
}

/// A round-arched opening.
#[derive(Clone, Copy)]
pub(crate) struct Opening {
    /// Where along the wall.
    pub(crate) middle: f64,
    /// Half the width.
    pub(crate) half: f64,
    /// Where it starts; a doorway reaches down to the wall's foot.
    pub(crate) foot: f64,
    /// Where its arch starts.
    pub(crate) spring: f64,
}

impl Opening {
    /// Its outline.
    pub(crate) fn outline(&self) -> Outline {
        let Self { middle, half, foot, spring } = *self;
        let mut out = vec![dvec2(middle - half, foot), dvec2(middle + half, foot)];
        out.extend(arc(dvec2(middle, spring), half, 0.0, PI, FEWER));
        out
    }

    /// The same, wider by `margin` on both sides and above.
    pub(crate) fn grown(self, margin: f64) -> Self {
        Self { half: self.half + margin, ..self }
    }
}

/// A wall along x with doorways, given from left to right, and windows.
pub(crate) fn pierced(x: Span, y: Span, z: Span, doors: &[Opening], windows: &[Opening]) -> Solid {
    let mut outline = vec![dvec2(x[0], y[0])];
    for door in doors {
        if door.spring > y[0] {
            outline.push(dvec2(door.middle - door.half, y[0]));
        }
        outline.extend(soffit(door.middle, door.spring, door.half, door.half));
        if door.spring > y[0] {
            outline.push(dvec2(door.middle + door.half, y[0]));
        }
    }
    outline.extend([dvec2(x[1], y[0]), dvec2(x[1], y[1]), dvec2(x[0], y[1])]);
    let holes = windows.iter().map(|w| Hole { outline: w.outline(), chamfer: 0.0 }).collect();
    Plate { outline, rim: vec![(0.0, z[0]), (0.0, z[1])], holes, ..Plate::default() }.solid()
}

/// The frame of a round-arched opening that reaches down to `foot`: `width` wide around it, from one z to another.
pub(crate) fn surround(opening: Opening, foot: f64, width: f64, z: Span) -> Solid {
    let arch = |half: f64| soffit(opening.middle, opening.spring, half, half);
    let (inner, outer) = (opening.half, opening.half + width);
    let at = |half: f64| dvec2(opening.middle + half, foot);
    let mut outline = vec![at(-outer), at(-inner)];
    outline.extend(arch(inner));
    outline.extend([at(inner), at(outer)]);
    outline.extend(arch(outer).into_iter().rev());
    Plate { outline, rim: vec![(0.0, z[0]), (0.0, z[1])], ..Plate::default() }.solid()
}

/// A body that stands upright on an outline of x and z.
pub(crate) fn upright(plan: &[(f64, f64)], rim: &[(f64, f64)]) -> Solid {
    // The part's own axes u and v become z and x.
    let outline = plan.iter().map(|&(x, z)| dvec2(z, x)).collect();
    Plate { outline, rim: rim.to_vec(), ..Plate::default() }.solid().along(Axis::Y)
}

/// The rectangle between two corners as a plan for [`upright`].
pub(crate) fn plan(x: Span, z: Span) -> [(f64, f64); 4] {
    [(x[0], z[0]), (x[0], z[1]), (x[1], z[1]), (x[1], z[0])]
}

/// An angle as a plan for [`upright`]: its arms end at `end`, its sides are at `near` and at `far`.
pub(crate) fn angle(end: f64, near: f64, far: f64) -> [(f64, f64); 6] {
    [(end, near), (end, far), (far, far), (far, end), (near, end), (near, near)]
}

/// A pilaster's edge: a foot from `low`, an impost that ends at `high`.
pub(crate) fn pilaster(low: f64, high: f64) -> Rim {
    vec![
        (-0.05, low - DEEP / 2.0),
        (-0.05, low + 0.2),
        (0.0, low + 0.26),
        (0.0, high - 0.24),
        (-0.03, high - 0.24),
        (-0.03, high - 0.2),
        (-0.08, high - 0.09),
        (-0.08, high),
    ]
}

/// Bodies as one.
pub(crate) fn united(bodies: impl IntoIterator<Item = Solid>) -> Solid {
    let triangles = bodies.into_iter().flat_map(|body| body.triangles).collect();
    Solid { triangles, ..Solid::default() }
}

/// A ridge of round tiles up a slope at `x`, from (z, y) to (z, y). More than half of its circle is in the roof, so that
/// both its edges are seen from most sides; `depth` is how deep it stands there at either end.
pub(crate) fn cover(x: f64, low: DVec2, high: DVec2, radius: f64, depth: [f64; 2]) -> Solid {
    const SIDES: usize = 6;
    let ring = |p: DVec2, depth: f64| -> Vec<DVec3> {
        let mut ring: Vec<DVec3> = (0..=SIDES)
            .map(|i| {
                let (sin, cos) = (PI * i as f64 / SIDES as f64).sin_cos();
                dvec3(x + radius * cos, p.y + radius * (sin - 0.45), p.x)
            })
            .collect();
        ring.extend([-1.0, 1.0].map(|side| dvec3(x + side * radius, p.y - depth, p.x)));
        ring
    };
    let (low, high) = ((low.x, ring(low, depth[0])), (high.x, ring(high, depth[1])));
    let (near, far) = if low.0 < high.0 { (low.1, high.1) } else { (high.1, low.1) };
    let mut solid = Solid::default();
    solid.band(&near, &far);
    for i in 1..near.len() - 1 {
        solid.triangle(near[0], near[i + 1], near[i]);
        solid.triangle(far[0], far[i], far[i + 1]);
    }
    solid
}
