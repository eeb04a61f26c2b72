//! How far along a polyline each of its segments lies, in pixels: what dashes are counted by.

use glam::{DVec2, Vec3};

use super::clip::PictureMap;
use super::scale::Scale;
use super::segment::Dashes;

/// How long a polyline is in the picture up to each of its corners.
pub(super) struct PolylineArcs {
    /// Where each segment begins in the picture, and the length up to there.
    starts: Vec<(DVec2, f64)>,
    scale: Scale,
}

impl PolylineArcs {
    /// Of segments that follow each other.
    pub(super) fn new(
        segments: impl Iterator<Item = [Vec3; 2]>,
        is_closed: bool,
        picture: &PictureMap,
        dashes: &Dashes,
    ) -> Self {
        let mut starts = Vec::new();
        let mut length = 0.0;
        for ends in segments {
            let [from, to] = picture.before(ends).map_or([DVec2::ZERO; 2], |ends| ends.map(|e| e.0));
            starts.push((from, length));
            length += from.distance(to);
        }
        let around = is_closed.then_some(length).filter(|length| *length > 0.0);
        Self { starts, scale: Scale { anchor: 0.0, around, period: f64::from(dashes.period) } }
    }

    /// The arcs of a part of a segment, of which both ends are given in pixels.
    pub(super) fn arcs(&self, segment: usize, ends: [DVec2; 2]) -> [f32; 2] {
        let (start, length) = self.starts.get(segment).copied().unwrap_or_default();
        let [from, to] = ends.map(|end| length + start.distance(end));
        // A loop's first length is not its last one.
        self.scale.arcs([from.max(f64::MIN_POSITIVE), to.max(f64::MIN_POSITIVE)])
    }
}
