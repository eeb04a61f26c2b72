//! Axis-aligned bounding boxes.

use glam::{DMat4, DVec3, Vec3};

/// An axis-aligned box in some space; empty when `min > max`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Least corner, in the units of the space.
    pub min: DVec3,
    /// Greatest corner, in the units of the space.
    pub max: DVec3,
}

impl Default for Bounds {
    /// [`Bounds::EMPTY`].
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Bounds {
    /// The box that contains nothing; the identity of [`Bounds::union`].
    pub const EMPTY: Self = Self { min: DVec3::splat(f64::INFINITY), max: DVec3::splat(f64::NEG_INFINITY) };

    /// The smallest box around `points`; points that are not finite are left out.
    pub fn of_points(points: &[Vec3]) -> Self {
        let mut min = Vec3::INFINITY;
        let mut max = Vec3::NEG_INFINITY;
        for &p in points.iter().filter(|p| p.is_finite()) {
            min = min.min(p);
            max = max.max(p);
        }
        Self { min: min.as_dvec3(), max: max.as_dvec3() }
    }

    /// Whether the box contains no point at all.
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// What both have in common, which may be empty.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        let common = Self { min: self.min.max(other.min), max: self.max.min(other.max) };
        if common.is_empty() { Self::EMPTY } else { common }
    }

    /// The middle of the box; the origin when it is empty.
    pub fn center(&self) -> DVec3 {
        if self.is_empty() { DVec3::ZERO } else { (self.min + self.max) * 0.5 }
    }

    /// Length of the diagonal, 0 when empty.
    pub fn diagonal(&self) -> f64 {
        if self.is_empty() { 0.0 } else { (self.max - self.min).length() }
    }

    /// The eight corners, in no particular order. Of no use when empty.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.min.x } else { self.max.x },
                if i & 2 == 0 { self.min.y } else { self.max.y },
                if i & 4 == 0 { self.min.z } else { self.max.z },
            )
        })
    }

    /// The box around the transformed corners, in the target space of `b_from_a`.
    #[must_use]
    pub fn transformed(&self, b_from_a: &DMat4) -> Self {
        if self.is_empty() {
            return Self::EMPTY;
        }
        let mut out = Self::EMPTY;
        for corner in self.corners() {
            let p = b_from_a.transform_point3(corner);
            out.min = out.min.min(p);
            out.max = out.max.max(p);
        }
        out
    }
}

/// A cube with its lowest corner at a place.
#[cfg(test)]
pub(crate) fn cube(at: [f64; 3], size: f64) -> Bounds {
    let at = DVec3::from_array(at);
    Bounds { min: at, max: at + size }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_around_points_ignores_what_is_not_finite() {
        let b = Bounds::of_points(&[Vec3::ZERO, Vec3::new(2.0, 4.0, 6.0), Vec3::splat(f32::NAN)]);
        assert_eq!(b.center(), DVec3::new(1.0, 2.0, 3.0));
        assert!(Bounds::of_points(&[]).is_empty());
        assert!(Bounds::EMPTY.transformed(&DMat4::IDENTITY).is_empty());
    }
}
