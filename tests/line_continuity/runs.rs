//! Runs: stretches of lines of one class.

use std::collections::HashSet;

use glam::DVec2;
use hachure::geometry::EdgeClass;
use hachure::render::base::view::REFERENCE_HEIGHT;

use crate::lines::Lines;

/// A run that is shorter than this, reference pixels, is no stretch of a line.
const LEAST: f64 = 8.0;
/// A line in another direction so near to the end of a run makes a junction of it, px.
const JUNCTION: f64 = 3.0;

/// A part of a line that has one class.
#[derive(Debug)]
#[allow(dead_code, reason = "a test that fails prints it")]
pub(crate) struct Run {
    pub(crate) class: EdgeClass,
    /// How the line goes on, on both sides.
    pub(crate) between: [EdgeClass; 2],
    pub(crate) pixels: Vec<usize>,
}

/// The runs in a picture of this height that are too short, lie between two stretches of other classes, and end at no junction.
pub(crate) fn alternations(lines: &Lines, height: u32) -> Vec<Run> {
    let least = LEAST * f64::from(height) / REFERENCE_HEIGHT;
    let mut is_known = HashSet::new();
    let mut found = Vec::new();
    for (pixel, point) in lines.points() {
        if is_known.contains(&pixel) {
            continue;
        }
        let ends = [point.tangent, -point.tangent].map(|towards| walk(lines, pixel, towards, least));
        let pixels: Vec<usize> =
            ends.iter().flat_map(|end| end.pixels.iter().copied()).chain([pixel]).collect();
        is_known.extend(pixels.iter().copied());
        let length = 1.0 + ends[0].length + ends[1].length;
        if let [Some(one), Some(other)] = ends.map(|end| end.change)
            && length < least
        {
            found.push(Run { class: point.class, between: [one, other], pixels });
        }
    }
    found
}

/// One half of a run.
struct Half {
    pixels: Vec<usize>,
    length: f64,
    /// The other class with which the line goes on, if not because another line meets it there.
    change: Option<EdgeClass>,
}

fn walk(lines: &Lines, first: usize, mut towards: DVec2, least: f64) -> Half {
    let mut half = Half { pixels: Vec::new(), length: 0.0, change: None };
    let (mut pixel, class) = (first, lines.get(first).unwrap().class);
    while half.length < least {
        let here = lines.get(pixel).unwrap();
        let Some(next) = lines.next(pixel, towards) else { return half };
        let there = lines.get(next).unwrap();
        if there.class != class {
            half.change = (!lines.is_junction(here, JUNCTION)).then_some(there.class);
            return half;
        }
        half.length += here.at.distance(there.at);
        towards = there.tangent * there.tangent.dot(towards).signum();
        half.pixels.push(next);
        pixel = next;
    }
    half
}
