//! How far along its chain each segment lies, in pixels: what dashes are counted by.
//!
//! Creases and borders follow chains that are the same from everywhere and are held at a fixed point of the mesh, so
//! that dashes stay where they are when the camera moves. Smooth silhouettes are chained anew for every view; they are
//! held at a point of the picture that moves little: a loop where it is highest above its middle, others half-way.

use glam::DVec2;

use super::outlines::Outline;
use super::scale::Scale;
use super::segment::{Dashes, LineSegment};
use super::{Finder, Trace};
use crate::geometry::feature_edges::chains::FeatureChains;
use crate::geometry::feature_edges::crease_angles::CreaseAngles;
use crate::geometry::line_chains::{ChainEdge, ChainLink, Chains};
use crate::geometry::{ClassSet, EdgeClass};

impl Finder<'_> {
    /// Fills in the arcs of the segments that were found.
    pub(super) fn measure(&self, dashes: &Dashes, trace: &Trace, segments: &mut [LineSegment]) {
        let period = f64::from(dashes.period);
        if !(period > 0.0 && period.is_finite()) {
            return;
        }
        let wanted = self.wanted;
        let asked = |class, angle: f32| if wanted.classes.contains(class) { angle } else { f32::INFINITY };
        let angles = CreaseAngles {
            ridge: asked(EdgeClass::Ridge, wanted.ridge_angle),
            valley: asked(EdgeClass::Valley, wanted.valley_angle),
        };
        let features = self.placed.edges.chains(self.placed.mesh, angles);
        let mut lengths = ChainLengths::new(self, &features, period);
        let mut by_edge = features.by_edge.as_slice();
        let mut outlines = Vec::new();
        for (number, (segment, &edge)) in (0_u32..).zip(segments.iter_mut().zip(&trace.edges)) {
            if !dashes.wants(segment) {
                continue;
            }
            let passed = by_edge.iter().take_while(|chained| chained.edge < edge).count();
            by_edge = by_edge.get(passed..).unwrap_or_default();
            match by_edge.first() {
                Some(chained) if chained.edge == edge => {
                    if let Some(arcs) = lengths.arcs(chained.chain, chained.link, segment) {
                        segment.arcs = arcs;
                    }
                }
                _ => outlines.push((edge, Some(number))),
            }
        }
        let unseen = trace.unseen.iter().map(|&edge| (edge, None));
        let is_smooth =
            |edge: u32| features.by_edge.binary_search_by_key(&edge, |chained| chained.edge).is_err();
        if !outlines.is_empty() {
            outlines.extend(unseen.filter(|&(edge, _)| is_smooth(edge)));
            self.measure_outlines(&outlines, period, segments);
        }
    }

    /// Fills in the arcs along smooth silhouettes: (edge, number of its segment if the picture shows it).
    fn measure_outlines(&self, edges: &[(u32, Option<u32>)], period: f64, segments: &mut [LineSegment]) {
        let ends: Vec<Option<[(DVec2, bool); 2]>> =
            edges.iter().map(|&(edge, _)| self.before(edge)).collect();
        let links: Vec<ChainEdge> = edges
            .iter()
            .zip(&ends)
            .map(|(&(edge, _), ends)| {
                let vertices = self.placed.edges.ends.get(edge as usize).copied().unwrap_or_default();
                let at = |end: usize| ends.is_some_and(|ends| ends[end].1).then_some(vertices[end]);
                ChainEdge { ends: [at(0), at(1)], kind: 0 }
            })
            .collect();
        let chains = Chains::new(&links, |_, _| true);
        for (own, is_closed) in chains.iter() {
            let point = |l: &ChainLink, end: usize| {
                let ends = ends.get(l.link as usize).copied().flatten();
                ends.map_or(DVec2::ZERO, |ends| ends[end ^ usize::from(l.reversed)].0)
            };
            let mut points: Vec<DVec2> = own.iter().map(|l| point(l, 0)).collect();
            points.extend(own.last().map(|l| point(l, 1)));
            let outline = Outline::new(&points, is_closed, 0.5 * period);
            let along: f64 =
                own.iter().map(|l| self.direction(edges, *l) * point(l, 0).distance(point(l, 1))).sum();
            let scale = outline.scale(period, along < 0.0);
            for (i, l) in own.iter().enumerate() {
                let Some(&(_, Some(number))) = edges.get(l.link as usize) else { continue };
                let Some(segment) = segments.get_mut(number as usize) else { continue };
                let (a, b) = (point(l, 0), point(l, 1));
                let part = |end: [f32; 2]| {
                    let t = (DVec2::from(end.map(f64::from)) - a).dot(b - a) / a.distance_squared(b);
                    outline.length_at(i, if t.is_finite() { t } else { 0.0 }, along < 0.0)
                };
                segment.arcs = scale.arcs(segment.ends.map(part));
            }
        }
    }

    /// 1 if a silhouette's first triangle, in whose direction its edge runs, is the one that faces the eye, else −1:
    /// the surface is always on the same side.
    fn direction(&self, edges: &[(u32, Option<u32>)], l: ChainLink) -> f64 {
        let edge = edges.get(l.link as usize).map_or(0, |(edge, _)| *edge);
        let face = self.placed.edges.faces.get(edge as usize).map_or(0, |faces| faces[0]);
        let is_front = self.facings.of(face) == 1;
        if is_front ^ l.reversed { 1.0 } else { -1.0 }
    }

    /// Where the ends of an edge are, in pixels, and whether each is the edge's own: not cut off by the near plane.
    fn before(&self, edge: u32) -> Option<[(DVec2, bool); 2]> {
        let ends = self.placed.edges.ends.get(edge as usize)?;
        let [a, b] = ends.map(|v| self.placed.mesh.positions.get(v as usize).copied());
        self.picture.before([a?, b?])
    }
}

/// The lengths along chains, each found when it is asked for.
struct ChainLengths<'a> {
    finder: &'a Finder<'a>,
    features: &'a FeatureChains,
    period: f64,
    scales: Vec<Option<Scale>>,
    /// For each link the length where its chain enters it.
    lengths: Vec<f64>,
}

impl<'a> ChainLengths<'a> {
    fn new(finder: &'a Finder<'a>, features: &'a FeatureChains, period: f64) -> Self {
        let scales = features.chains.starts.iter().map(|_| None).collect();
        Self { finder, features, period, scales, lengths: vec![0.0; features.edges.len()] }
    }

    fn arcs(&mut self, chain: u32, link: u32, segment: &LineSegment) -> Option<[f32; 2]> {
        if self.scales.get(chain as usize)?.is_none() {
            let scale = self.walk(chain as usize)?;
            *self.scales.get_mut(chain as usize)? = Some(scale);
        }
        let scale = self.scales.get(chain as usize)?.as_ref()?;
        let start = *self.lengths.get(link as usize)?;
        let [from, _] = self.ends(self.features.chains.links.get(link as usize)?)?;
        Some(scale.arcs(segment.ends.map(|end| start + from.distance(DVec2::from(end.map(f64::from))))))
    }

    /// Where a link is entered and left, in pixels; `None` if it lies before the near plane.
    fn ends(&self, link: &ChainLink) -> Option<[DVec2; 2]> {
        let edge = self.features.edges.get(link.link as usize)?;
        let [a, b] = self.finder.before(*edge)?.map(|(px, _)| px);
        Some(if link.reversed { [b, a] } else { [a, b] })
    }

    fn walk(&mut self, chain: usize) -> Option<Scale> {
        let &(start, _) = self.features.chains.starts.get(chain)?;
        let (links, is_closed) = self.features.chains.get(chain)?;
        let &(place, part) = self.features.anchors.get(chain)?;
        let (mut at, mut anchor) = (0.0, 0.0);
        for (i, link) in links.iter().enumerate() {
            *self.lengths.get_mut(start as usize + i)? = at;
            let length = self.ends(link).map_or(0.0, |[a, b]| a.distance(b));
            if i == place as usize {
                let edge = *self.features.edges.get(link.link as usize)?;
                anchor = at + self.finder.part_along(edge, link.reversed, f64::from(part)) * length;
            }
            at += length;
        }
        Some(Scale { anchor, around: is_closed.then_some(at), period: self.period })
    }
}

impl Finder<'_> {
    /// Which part of the picture of an edge (0 to 1, from where a chain enters it) a part of the edge itself covers.
    fn part_along(&self, edge: u32, reversed: bool, part: f64) -> f64 {
        let positions = self.placed.edges.ends.get(edge as usize).map(|ends| {
            ends.map(|v| self.placed.mesh.positions.get(v as usize).copied().unwrap_or_default().as_dvec3())
        });
        let Some([a, b]) = positions else { return part };
        let (a, b) = if reversed { (b, a) } else { (a, b) };
        self.picture.part_along([a, b], part)
    }
}

impl Dashes {
    /// Whether a segment is to have arcs.
    fn wants(&self, segment: &LineSegment) -> bool {
        let outlines = ClassSet::of(&[EdgeClass::Silhouette, EdgeClass::Border]);
        segment.edge_class().is_some_and(|class| {
            !segment.is_suppressed()
                && (self.classes.contains(class)
                    || self.classes.contains(EdgeClass::Object) && outlines.contains(class))
        })
    }
}
