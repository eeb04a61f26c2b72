//! Caps: what the contours of solids enclose, as triangles.
//!
//! Bodies are closed one by one. Where an edge of one side lies on several of the other, or where they lie a little
//! apart, a contour ends at one side and goes on at the other: its ends are joined, the nearest first. Then everything is
//! filled around which contours run more often to the left than to the right, so that cavities stay hollow and bodies that
//! reach into each other are one.

use glam::{DMat4, DVec2};
use i_triangle::float::custom::CustomTriangulatable as _;
use i_triangle::i_overlay::core::fill_rule::FillRule;
use i_triangle::int::validation::Validation;

use super::Contour;
use crate::geometry::bodies::{Bodies, BodyKind};

/// Of very many ends at one place, not all are tried out.
const MAX_AT_A_PLACE: usize = 32;

/// The inside of contours as triangles, in the plane's coordinates.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cap {
    /// Corners.
    pub points: Vec<DVec2>,
    /// Counter-clockwise seen from above.
    pub triangles: Vec<[u32; 3]>,
}

impl Cap {
    /// The area that it covers.
    pub fn area(&self) -> f64 {
        let corner = |i: u32| self.points.get(i as usize).copied().unwrap_or(DVec2::ZERO);
        self.triangles
            .iter()
            .map(|&[a, b, c]| 0.5 * (corner(b) - corner(a)).perp_dot(corner(c) - corner(a)))
            .sum()
    }
}

/// What fills the cut through a mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Filling {
    /// The cap of all solid bodies; `None` if nothing is enclosed.
    pub cap: Option<Cap>,
    /// Number of bodies that the plane cuts and that the cap leaves open: they are not solid, or a gap in them is too wide.
    pub open_count: usize,
}

/// Fills the contours of a mesh with these bodies.
pub fn fill(contours: &[Contour], bodies: &Bodies, plane_from_local: &DMat4) -> Filling {
    let axes = [plane_from_local.x_axis, plane_from_local.y_axis, plane_from_local.z_axis];
    let scale = axes.iter().map(|axis| axis.truncate().length()).fold(0.0, f64::max);
    let reach = bodies.widest_gap() * scale;
    // Neighbors in a contour belong to one body.
    let body_of = |contour: &Contour| contour.triangles.first().map_or(0, |&t| bodies.of_triangle(t));
    let mut by_body: Vec<(usize, &Contour)> =
        contours.iter().map(|contour| (body_of(contour), contour)).collect();
    by_body.sort_by_key(|(body, _)| *body);
    let mut filling = Filling::default();
    let mut loops: Vec<Vec<DVec2>> = Vec::new();
    for own in by_body.chunk_by(|a, b| a.0 == b.0) {
        let is_open = bodies.kinds().get(own[0].0).is_none_or(|kind| *kind == BodyKind::Open);
        let closed = if is_open { None } else { closed(own.iter().map(|(_, contour)| *contour), reach) };
        match closed {
            Some(own) => loops.extend(own),
            None => filling.open_count += 1,
        }
    }
    filling.cap = inside(&loops);
    filling
}

/// The contours of a body as loops; `None` if the ends of some are farther than `reach` from all others.
fn closed<'a>(contours: impl Iterator<Item = &'a Contour>, reach: f64) -> Option<Vec<Vec<DVec2>>> {
    let (closed, open): (Vec<&Contour>, Vec<&Contour>) = contours.partition(|contour| contour.is_closed);
    let next = followers(&open, reach)?;
    let mut loops: Vec<Vec<DVec2>> = closed.iter().map(|contour| contour.points.clone()).collect();
    let mut is_taken = vec![false; open.len()];
    for first in 0..open.len() {
        let (mut points, mut at) = (Vec::new(), first);
        while !std::mem::replace(&mut is_taken[at], true) {
            points.extend(&open[at].points);
            at = next[at];
        }
        if !points.is_empty() {
            loops.push(points);
        }
    }
    Some(loops)
}

/// For each open contour the one that begins where it ends, each once; `None` unless all have one.
fn followers(open: &[&Contour], reach: f64) -> Option<Vec<usize>> {
    let mut starts: Vec<(DVec2, usize)> =
        open.iter().zip(0..).filter_map(|(contour, i)| Some((*contour.points.first()?, i))).collect();
    starts.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (contour, i) in open.iter().zip(0..) {
        let end = *contour.points.last()?;
        let first = starts.partition_point(|(start, _)| start.x < end.x - reach);
        let near = starts.iter().skip(first).take_while(|(start, _)| start.x <= end.x + reach);
        let near = near.map(|&(start, j)| (start.distance(end), i, j)).filter(|pair| pair.0 <= reach);
        pairs.extend(near.take(MAX_AT_A_PLACE));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut next = vec![None; open.len()];
    let mut is_reached = vec![false; open.len()];
    for (_, i, j) in pairs {
        if next[i].is_none() && !is_reached[j] {
            next[i] = Some(j);
            is_reached[j] = true;
        }
    }
    next.into_iter().collect()
}

/// Every place around which the loops run more often to the left than to the right; `None` if there is none.
fn inside(loops: &[Vec<DVec2>]) -> Option<Cap> {
    let points = || loops.iter().flatten();
    let low = points().fold(DVec2::INFINITY, |low, p| low.min(*p));
    let high = points().fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
    let (middle, size) = ((low + high) * 0.5, (high - low).max_element());
    if !(points().all(|p| p.is_finite()) && size.is_finite() && size > 0.0) {
        return None;
    }
    let outlines: Vec<Vec<[f64; 2]>> = loops
        .iter()
        .map(|points| points.iter().map(|p| ((*p - middle) / size).to_array()).collect())
        .collect();
    let validation = Validation::with_fill_rule(FillRule::Positive);
    let filled = outlines.custom_triangulate(validation).to_triangulation::<u32>();
    let points = filled.points.into_iter().map(|p| DVec2::from_array(p) * size + middle).collect();
    let cap = Cap { points, triangles: filled.indices.as_chunks().0.to_vec() };
    (!cap.triangles.is_empty()).then_some(cap)
}
