//! The lines of a picture as they are read from the edge map, and how they go on from pixel to pixel.

use glam::DVec2;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::visible_edges::VisibleEdges;
use hachure::geometry::{EdgeClass, Projector};

use crate::common::{captured, texels};

/// Cosine of the angle up to which two tangents belong to one line.
const PARALLEL: f64 = 0.85;
/// How far beside a tangent a line goes on, and how far along it at most, px.
const BESIDE: f64 = 1.0;
const AHEAD: f64 = 2.2;

/// The point of a line that a pixel has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    pub(crate) class: EdgeClass,
    /// px; (0, 0) is the upper left corner of the picture.
    pub(crate) at: DVec2,
    /// A unit vector.
    pub(crate) tangent: DVec2,
    /// Linear.
    pub(crate) depth: f64,
    /// Share of its ink, more than 0 and at most 1.
    pub(crate) weight: f64,
}

impl Point {
    /// Of a texel of the edge map, see `shaders/common/edge_map.wgsl`; `None` where no line is drawn.
    fn new([what, _, depth, look]: [u32; 4], px: DVec2) -> Option<Self> {
        let class = EdgeClass::ALL[(what >> 28).checked_sub(1)? as usize];
        let weight = f64::from(look >> 26) / 63.0;
        let angle = f64::from(what >> 16 & 511) / 512.0 * std::f64::consts::TAU;
        let offset = |bits: u32| f64::from(bits & 255) / 127.0 - 1.0;
        let at = px + 0.5 + DVec2::new(offset(what >> 8), offset(what));
        let depth = f64::from(f32::from_bits(depth));
        (weight > 0.0).then(|| Self { class, at, tangent: DVec2::from_angle(angle), depth, weight })
    }

    /// Whether both run in one direction.
    pub(crate) fn is_parallel(&self, other: &Self) -> bool {
        self.tangent.dot(other.tangent).abs() > PARALLEL
    }

    /// How much of a line stands for one pixel of it, px.
    fn length(&self) -> f64 {
        1.0 / self.tangent.x.abs().max(self.tangent.y.abs())
    }
}

/// All lines of a picture.
pub(crate) struct Lines {
    side: usize,
    points: Vec<Option<Point>>,
}

impl Lines {
    /// Of a square picture of the scene that was set.
    pub(crate) fn draw(session: &mut Session, opened: &Opened, side: u32) -> Self {
        session.draw(opened, [side; 2], false).unwrap();
        let edge_map = captured(session, "edge map").unwrap();
        let side = side as usize;
        let point = |(i, texel)| Point::new(texel, DVec2::new((i % side) as f64, (i / side) as f64));
        let points = texels::<[u32; 4]>(session, &edge_map).into_iter().enumerate().map(point).collect();
        Self { side, points }
    }

    /// As exact visible edges would be drawn: each pixel has the first class of its edges.
    pub(crate) fn of_edges(edges: &VisibleEdges, projector: &Projector) -> Self {
        let side = projector.size[0] as usize;
        let mut points: Vec<Option<Point>> = vec![None; side * side];
        for segment in &edges.segments {
            let [start, end] = segment.ends;
            let Some(tangent) = (end - start).try_normalize() else { continue };
            let views = segment.places.map(|place| projector.view_from_world.transform_point3(place));
            let steps = (2.0 * start.distance(end)).ceil() as usize;
            for step in 0..=steps {
                let along = step as f64 / steps as f64;
                let at = start.lerp(end, along);
                let is_inside = at.min_element() >= 0.0 && at.max_element() < side as f64;
                if !is_inside {
                    continue;
                }
                let view = views[0].lerp(views[1], projector.along_segment(views, along));
                let point = Point { class: segment.class, at, tangent, depth: -view.z, weight: 1.0 };
                let pixel = &mut points[at.y as usize * side + at.x as usize];
                if pixel.is_none_or(|other| point.class < other.class) {
                    *pixel = Some(point);
                }
            }
        }
        Self { side, points }
    }

    /// The number of each pixel that has a point, with the point.
    pub(crate) fn points(&self) -> impl Iterator<Item = (usize, &Point)> {
        self.points.iter().enumerate().filter_map(|(i, point)| Some((i, point.as_ref()?)))
    }

    /// What a pixel has.
    pub(crate) fn get(&self, pixel: usize) -> Option<&Point> {
        self.points[pixel].as_ref()
    }

    /// Of all lines together, px.
    pub(crate) fn length(&self) -> f64 {
        self.points().map(|(_, point)| point.length()).sum()
    }

    /// The points of the pixels that are at most so many columns and rows from a place.
    pub(crate) fn around(&self, at: DVec2, reach: i64) -> impl Iterator<Item = (usize, &Point)> {
        let [x, y] = at.floor().as_i64vec2().to_array();
        let within = move |c: i64| (c - reach).max(0)..(c + reach + 1).min(self.side as i64);
        within(y)
            .flat_map(move |y| within(x).map(move |x| (y * self.side as i64 + x) as usize))
            .filter_map(|i| Some((i, self.get(i)?)))
    }

    /// Where the line of a pixel goes on in a direction along its tangent: with the same class, if it does so.
    pub(crate) fn next(&self, pixel: usize, towards: DVec2) -> Option<usize> {
        let own = self.get(pixel)?;
        let follows = |&(i, other): &(usize, &Point)| {
            let away = other.at - own.at;
            let (along, across) = (away.dot(towards), away.perp_dot(towards).abs());
            i != pixel && along > 0.3 && along < AHEAD && across < BESIDE && own.is_parallel(other)
        };
        let cost = |other: &Point| {
            let away = other.at - own.at;
            away.dot(towards)
                + 2.0 * away.perp_dot(towards).abs()
                + if other.class == own.class { 0.0 } else { 100.0 }
        };
        let following = self.around(own.at, 3).filter(follows);
        following.min_by(|a, b| cost(a.1).total_cmp(&cost(b.1))).map(|(i, _)| i)
    }

    /// Whether a line in another direction comes this near to a point, px.
    pub(crate) fn is_junction(&self, point: &Point, reach: f64) -> bool {
        self.around(point.at, reach.ceil() as i64 + 1)
            .any(|(_, other)| other.at.distance(point.at) < reach && !other.is_parallel(point))
    }
}
