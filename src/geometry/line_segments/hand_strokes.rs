//! Straight lines as strokes: segments that are drawn beside where their edge is, and longer.

use bytemuck::{Pod, Zeroable};
use glam::DVec2;

use super::segment::{LineSegment, LineSelection, LineView, PlacedEdges};
use super::{Finder, find_segments};
use crate::geometry::feature_edges::crease_angles::CreaseAngles;
use crate::geometry::feature_edges::straights::Straight;
use crate::geometry::hand::{Hand, HandStroke, mix};
use crate::geometry::{EdgeClass, Lens};

/// Length of the pieces of a stroke, reference pixels: short enough that it is bowed smoothly.
const PIECE: f64 = 6.0;
/// No segment has more pieces.
const MAX_PIECES: f64 = 4096.0;
/// So far from its end an overshot line is tested, px.
const INSIDE: [f64; 2] = [2.0, 1.0];
/// So far (px) may the end of a segment be from that of its line and still be the same.
const SAME_END: f64 = 0.05;
/// Share of the opacity that is left where the hand is lifted.
const LIFTED: f64 = 0.75;

/// Where a segment is tested against what may hide it, and how firmly it is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Tested {
    /// As [`LineSegment::ends`]; the depths there are the segment's. Points of both are as far along.
    pub ends: [[f32; 2]; 2],
    /// Opacity at both ends, 0 to 1.
    pub weights: [f32; 2],
    /// Of lines in the same pixel the one with the greatest counts, 0 to 1.
    pub precedence: f32,
    /// 1: it is a stroke, which may lie over what is nearer; otherwise 0.
    pub is_stroke: u32,
}

impl Tested {
    /// A segment that is drawn where it is.
    pub fn at(segment: &LineSegment) -> Self {
        Self { ends: segment.ends, weights: [1.0; 2], precedence: 1.0, is_stroke: 0 }
    }
}

/// Segments, and where each is tested.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SegmentSet {
    /// What is drawn.
    pub segments: Vec<LineSegment>,
    /// One for each segment, or none at all: each is tested where it is drawn.
    pub tested: Vec<Tested>,
}

impl SegmentSet {
    /// Adds those that are missing, for segments that are drawn where they are.
    pub fn complete(&mut self) {
        let missing = self.segments.get(self.tested.len()..).unwrap_or_default();
        self.tested.extend(missing.iter().map(Tested::at));
    }

    /// Adds all of another one.
    pub fn append(&mut self, other: &Self) {
        if !other.tested.is_empty() {
            self.complete();
            self.tested.extend_from_slice(&other.tested);
        }
        self.segments.extend_from_slice(&other.segments);
    }

    fn push(&mut self, segment: LineSegment, tested: Tested) {
        self.segments.push(segment);
        self.tested.push(tested);
    }
}

/// As [`super::line_segments()`], with straight creases, borders and material boundaries drawn by a hand. Each such segment
/// is followed by its strokes; it is itself [`LineSegment::ELSEWHERE`]. `straight_angle` (radians): from it on an edge is
/// straight or not, whether it is drawn as a crease or as an outline. The view's margin must be at least [`Hand::reach`].
pub fn draw_strokes(
    placed: &PlacedEdges<'_>,
    view: &LineView,
    wanted: &LineSelection,
    hand: &Hand,
    straight_angle: f32,
    out: &mut SegmentSet,
) {
    out.complete();
    let mut found = Vec::new();
    let Some((finder, trace)) = find_segments(placed, view, wanted, true, &mut found) else { return };
    let asked = |class: EdgeClass, angle: f32| {
        if wanted.classes.contains(class) { angle.min(straight_angle) } else { straight_angle }
    };
    let angles = CreaseAngles {
        ridge: asked(EdgeClass::Ridge, wanted.ridge_angle),
        valley: asked(EdgeClass::Valley, wanted.valley_angle),
    };
    let straights = placed.edges.straights(placed.mesh, angles);
    // Each line is looked at when its first segment is met.
    let mut drawn: Vec<Option<Option<DrawnLine>>> = vec![None; straights.lines.len()];
    let mut by_edge = straights.by_edge.iter().peekable();
    for (segment, &edge) in found.iter().zip(&trace.edges) {
        while by_edge.next_if(|(e, _)| *e < edge).is_some() {}
        let line = by_edge.peek().filter(|(e, _)| *e == edge && !segment.is_suppressed());
        let drawn = line.and_then(|&&(_, line)| {
            let found = drawn.get_mut(line as usize)?;
            let line = straights.lines.get(line as usize)?;
            found.get_or_insert_with(|| DrawnLine::new(&finder, line, hand)).as_ref()
        });
        match drawn {
            Some(line) => line.draw(segment, view.projector.lens, hand, out),
            None => out.push(*segment, Tested::at(segment)),
        }
    }
}

/// A straight line in the picture, with its strokes.
#[derive(Debug, Clone)]
struct DrawnLine {
    from: DVec2,
    direction: DVec2,
    length: f64,
    /// Whether the near plane leaves its ends.
    has_end: [bool; 2],
    strokes: Vec<HandStroke>,
}

impl DrawnLine {
    /// `None` if it is too short.
    fn new(finder: &Finder<'_>, line: &Straight, hand: &Hand) -> Option<Self> {
        let [(from, is_first), (to, is_last)] = finder.picture.before(line.ends)?;
        let length = from.distance(to);
        if !(length > hand.min_length() && length.is_finite()) {
            return None;
        }
        let number = mix(line.hash ^ mix(finder.placed.object));
        let has_end = [is_first && line.is_end[0], is_last && line.is_end[1]];
        let strokes =
            (0..hand.times()).map(|time| HandStroke::new(hand, number, time, length, has_end)).collect();
        Some(Self { from, direction: (to - from) / length, length, has_end, strokes })
    }

    /// How far along it a point of the picture is.
    fn along(&self, px: DVec2) -> f64 {
        (px - self.from).dot(self.direction)
    }

    /// In the picture, from a part of the line and how far off it is.
    fn off(&self, offset: DVec2) -> DVec2 {
        self.direction * offset.x + DVec2::new(self.direction.y, -self.direction.x) * offset.y
    }

    fn draw(&self, segment: &LineSegment, lens: Lens, hand: &Hand, out: &mut SegmentSet) {
        let there = LineSegment {
            class: segment.class | LineSegment::SUPPRESSED | LineSegment::ELSEWHERE,
            ..*segment
        };
        out.push(there, Tested::at(segment));
        let spot = Spots::new(segment, lens);
        let length = spot.ends[0].distance(spot.ends[1]);
        let piece = PIECE * f64::from(hand.scale.max(1e-3));
        let pieces = (length / piece).ceil().clamp(1.0, MAX_PIECES);
        for (time, stroke) in (0_u8..).zip(&self.strokes) {
            let precedence = 1.0 - f32::from(time) / 4.0;
            let mut before = self.drawn(stroke, &spot, 0.0);
            for number in 1..=pieces as u32 {
                let after = self.drawn(stroke, &spot, f64::from(number) / pieces);
                push(segment, [&before, &after], precedence, out);
                before = after;
            }
            for end in [0, 1] {
                if let Some([inner, outer]) = self.overshot(stroke, &spot, end) {
                    push(segment, [&inner, &outer], precedence, out);
                }
            }
        }
    }

    /// The point of a stroke at a part of a segment.
    fn drawn(&self, stroke: &HandStroke, spots: &Spots<'_>, part: f64) -> StrokePoint {
        let spot = spots.at(part);
        let along = self.along(spot.px);
        let px = spot.px + self.off(stroke.offset(along));
        StrokePoint { px, spot, weight: stroke.weight(along) }
    }

    /// What goes on beyond one end of a segment, from there to its tip; `None` if the line does not end there.
    fn overshot(&self, stroke: &HandStroke, spots: &Spots<'_>, end: usize) -> Option<[StrokePoint; 2]> {
        let here = spots.at(end as f64);
        let last = usize::from(self.along(here.px) > 0.5 * self.length);
        let over = stroke.overshoots[last];
        let tip = [0.0, self.length][last];
        if !self.has_end[last] || over <= 0.0 || (self.along(here.px) - tip).abs() > SAME_END {
            return None;
        }
        let sign = [-1.0, 1.0][last];
        // Of what is not there, its end is tested.
        let length = spots.ends[0].distance(spots.ends[1]).max(1e-6);
        let inside = |px: f64| {
            let part = (px / length).min(0.5 * px / INSIDE[0]);
            Spot { arc: here.arc, ..spots.at(if end == 0 { part } else { 1.0 - part }) }
        };
        let point = |over: f64, inner: f64, firmness: f64| {
            let along = tip + sign * over;
            let px = here.px + self.direction * (sign * over) + self.off(stroke.offset(along));
            StrokePoint { px, spot: inside(inner), weight: firmness * stroke.weight(tip) }
        };
        Some([point(0.0, INSIDE[0], 1.0), point(over, INSIDE[1], LIFTED)])
    }
}

/// A point of a segment.
#[derive(Clone, Copy)]
struct Spot {
    px: DVec2,
    depth: f64,
    arc: f64,
}

/// The points of a segment.
struct Spots<'a> {
    segment: &'a LineSegment,
    ends: [DVec2; 2],
    lens: Lens,
}

impl<'a> Spots<'a> {
    fn new(segment: &'a LineSegment, lens: Lens) -> Self {
        let ends = segment.ends.map(|[x, y]| DVec2::new(x.into(), y.into()));
        Self { segment, ends, lens }
    }

    /// At a part of its picture, 0 to 1.
    fn at(&self, part: f64) -> Spot {
        let between = |[a, b]: [f64; 2]| a + (b - a) * part;
        let depths = self.segment.depths.map(f64::from);
        Spot {
            px: self.ends[0].lerp(self.ends[1], part),
            depth: match self.lens {
                Lens::Perspective { .. } => 1.0 / between(depths.map(f64::recip)),
                Lens::Orthographic { .. } => between(depths),
            },
            arc: between(self.segment.arcs.map(f64::from)),
        }
    }
}

/// A point of a stroke: where it is drawn, and the point of its edge that it stands for.
struct StrokePoint {
    px: DVec2,
    spot: Spot,
    weight: f64,
}

/// Adds a piece of a stroke.
fn push(segment: &LineSegment, ends: [&StrokePoint; 2], precedence: f32, out: &mut SegmentSet) {
    out.push(
        LineSegment {
            ends: ends.map(|end| end.px.as_vec2().to_array()),
            depths: ends.map(|end| end.spot.depth as f32),
            arcs: ends.map(|end| end.spot.arc as f32),
            ..*segment
        },
        Tested {
            ends: ends.map(|end| end.spot.px.as_vec2().to_array()),
            weights: ends.map(|end| end.weight as f32),
            precedence,
            is_stroke: 1,
        },
    );
}
