//! From local space to the picture, cut at its sides and at the near and the far plane.

use glam::{DMat4, DVec2, DVec3, DVec4, Vec3};

use super::segment::LineView;
use crate::geometry::{Bounds, Lens};

/// A point in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PicturePoint {
    /// Pixels; (0, 0) is the upper left corner, y runs down.
    pub px: DVec2,
    /// Distance from the eye along the view.
    pub depth: f64,
}

/// A point before it is divided by `w`; all of it is linear in the position.
#[derive(Clone, Copy)]
struct Homogeneous {
    /// Pixels times `w`.
    px: DVec2,
    w: f64,
    depth: f64,
    /// Distances before the clip planes.
    leads: DVec2,
}

/// How local space is seen.
#[derive(Debug, Clone, Copy)]
pub(super) struct PictureMap {
    x: DVec4,
    y: DVec4,
    w: DVec4,
    depth: DVec4,
    leads: [DVec4; 2],
    near: f64,
    far: f64,
    /// Corners of the picture with its margin, in pixels.
    low: DVec2,
    high: DVec2,
    /// Whether any of this may cut anything off.
    cuts: bool,
}

impl PictureMap {
    pub(super) fn new(view: &LineView, view_from_local: &DMat4) -> Self {
        let LineView { projector, jitter, margin, clip_planes } = view;
        let size = DVec2::from(projector.size.map(f64::from));
        let depth = -view_from_local.row(2);
        let (w, pixels_per_unit, nearest) = match projector.lens {
            Lens::Perspective { tan_half_angle } => (depth, 0.5 * size.y / tan_half_angle, f64::MIN_POSITIVE),
            Lens::Orthographic { half_height } => (DVec4::W, 0.5 * size.y / half_height, f64::NEG_INFINITY),
        };
        let center = 0.5 * size + *jitter;
        Self {
            x: view_from_local.row(0) * pixels_per_unit + w * center.x,
            y: -view_from_local.row(1) * pixels_per_unit + w * center.y,
            w,
            depth,
            leads: clip_planes.map(|plane| view_from_local.transpose() * plane),
            near: projector.near.max(nearest),
            far: projector.far,
            low: DVec2::splat(-margin),
            high: size + *margin,
            cuts: true,
        }
    }

    /// For what lies in this box, which is in local space; `None`: the picture shows nothing of it.
    pub(super) fn within(self, bounds: &Bounds) -> Option<Self> {
        if bounds.is_empty() {
            return None;
        }
        let (mut least, mut greatest) = ([f64::INFINITY; 8], [f64::NEG_INFINITY; 8]);
        for corner in bounds.corners() {
            let inside = self.inside(&self.map(corner));
            for side in 0..8 {
                least[side] = least[side].min(inside[side]);
                greatest[side] = greatest[side].max(inside[side]);
            }
        }
        let may_show = greatest.iter().all(|inside| *inside >= 0.0);
        may_show.then(|| Self { cuts: least.iter().any(|inside| *inside < 0.0), ..self })
    }

    /// The part of a segment in local space that the picture and its margin show, if any.
    #[inline]
    pub(super) fn segment(&self, ends: [Vec3; 2]) -> Option<[PicturePoint; 2]> {
        if !self.cuts {
            return Some([self.map(ends[0].as_dvec3()).point(), self.map(ends[1].as_dvec3()).point()]);
        }
        self.clip(ends, |p| self.inside(p))
    }

    /// Where the ends of a segment in local space are, in pixels, if the near plane leaves anything of it, and whether
    /// it leaves each end. The sides of the picture cut nothing off.
    pub(super) fn before(&self, ends: [Vec3; 2]) -> Option<[(DVec2, bool); 2]> {
        let [from, to] = self.clip(ends, |p| [p.depth - self.near])?;
        let is_before = |p: Vec3| self.map(p.as_dvec3()).depth >= self.near;
        Some([(from.px, is_before(ends[0])), (to.px, is_before(ends[1]))])
    }

    /// Which part of the picture of a segment, as far as it is before the near plane, a part of the segment covers; 0
    /// to 1.
    pub(super) fn part_along(&self, ends: [DVec3; 2], part: f64) -> f64 {
        let Some([(from, _), (to, _)]) = self.before(ends.map(|p| p.as_vec3())) else { return 0.0 };
        let there = self.map(ends[0].lerp(ends[1], part));
        if there.depth < self.near {
            return if self.map(ends[0]).depth < self.near { 0.0 } else { 1.0 };
        }
        let along = (there.point().px - from).dot(to - from) / from.distance_squared(to);
        if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 }
    }

    fn clip<const N: usize>(
        &self,
        ends: [Vec3; 2],
        inside: impl Fn(&Homogeneous) -> [f64; N],
    ) -> Option<[PicturePoint; 2]> {
        let (a, b) = (self.map(ends[0].as_dvec3()), self.map(ends[1].as_dvec3()));
        let (inside_a, inside_b) = (inside(&a), inside(&b));
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for side in 0..N {
            let (at_a, at_b) = (inside_a[side], inside_b[side]);
            match (at_a < 0.0, at_b < 0.0) {
                (true, true) => return None,
                (true, false) => from = from.max(at_a / (at_a - at_b)),
                (false, true) => to = to.min(at_a / (at_a - at_b)),
                (false, false) => {}
            }
        }
        if from > to {
            return None;
        }
        let start = if from > 0.0 { a.lerp(&b, from) } else { a };
        let end = if to < 1.0 { a.lerp(&b, to) } else { b };
        Some([start.point(), end.point()])
    }

    #[inline]
    fn map(&self, p: DVec3) -> Homogeneous {
        let p = p.extend(1.0);
        Homogeneous {
            px: DVec2::new(self.x.dot(p), self.y.dot(p)),
            w: self.w.dot(p),
            depth: self.depth.dot(p),
            leads: DVec2::new(self.leads[0].dot(p), self.leads[1].dot(p)),
        }
    }

    /// Not negative where a point is inside of each of the planes.
    fn inside(&self, p: &Homogeneous) -> [f64; 8] {
        let (low, high) = (p.px - self.low * p.w, self.high * p.w - p.px);
        [p.depth - self.near, self.far - p.depth, low.x, low.y, high.x, high.y, p.leads.x, p.leads.y]
    }
}

impl Homogeneous {
    fn lerp(&self, other: &Self, t: f64) -> Self {
        Self {
            px: self.px.lerp(other.px, t),
            w: self.w + (other.w - self.w) * t,
            depth: self.depth + (other.depth - self.depth) * t,
            leads: self.leads.lerp(other.leads, t),
        }
    }

    fn point(&self) -> PicturePoint {
        PicturePoint { px: self.px / self.w, depth: self.depth }
    }
}

/// Whether a box in local space lies wholly before the eye.
pub(super) fn is_before_the_eye(bounds: &Bounds, view_from_local: &DMat4, lens: Lens) -> bool {
    match lens {
        Lens::Perspective { .. } => bounds.transformed(view_from_local).max.z < 0.0,
        Lens::Orthographic { .. } => true,
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{EYE, LENSES, look_from};
    use super::*;
    use crate::geometry::bounds::cube;

    #[test]
    fn only_what_may_be_cut_off_is_cut() {
        for lens in LENSES {
            let view = look_from(EYE, lens);
            let picture = PictureMap::new(&view, &view.projector.view_from_world);
            let part = |bounds: &Bounds| picture.within(bounds);
            let (inside, across) = (cube([-0.1; 3], 0.2), cube([-50.0; 3], 100.0));
            assert!(!part(&inside).unwrap().cuts && part(&across).unwrap().cuts);
            assert!(part(&cube([1e4; 3], 1.0)).is_none() && part(&Bounds::EMPTY).is_none());
            let diagonal = |bounds: &Bounds| [bounds.min.as_vec3(), bounds.max.as_vec3()];
            for bounds in [inside, across] {
                let found = part(&bounds).unwrap().segment(diagonal(&bounds));
                assert_eq!(found, picture.segment(diagonal(&bounds)));
                assert!(found.is_some());
            }
        }
    }
}
