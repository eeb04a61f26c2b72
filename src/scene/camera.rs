//! The camera: where the eye is, what it looks at, how it projects.

use glam::{DMat4, DVec3};

use super::extent::Framed;
use super::graph::Up;
use crate::geometry::Bounds;

/// A camera in the file's coordinates.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Camera {
    /// Where the eye is.
    pub position: DVec3,
    /// What it looks at; the point that an orbit turns about.
    pub focal_point: DVec3,
    /// The direction that is up in the picture; need not be perpendicular to the view.
    pub view_up: DVec3,
    /// How points become pixels.
    pub projection: Projection,
}

/// Perspective or parallel projection.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// Central projection.
    Perspective {
        /// Vertical view angle in degrees, 1 to 170.
        view_angle: f64,
    },
    /// Parallel projection.
    Orthographic {
        /// Height of the picture in units of the scene.
        view_height: f64,
    },
}

/// How much larger a picture is than what it frames.
const MARGIN: f64 = 1.06;

/// The same at least, where it was framed by some of its points.
const MIN_MARGIN: f64 = 1.02;

/// The vertical view angle of a new camera, in degrees (as in F3D).
pub const DEFAULT_VIEW_ANGLE: f64 = 30.0;

impl Default for Camera {
    fn default() -> Self {
        Self {
            position: DVec3::new(0.0, 0.0, 1.0),
            focal_point: DVec3::ZERO,
            view_up: DVec3::Y,
            projection: Projection::Perspective { view_angle: DEFAULT_VIEW_ANGLE },
        }
    }
}

impl Up {
    /// The unit vector that points up.
    pub fn vector(self) -> DVec3 {
        match self {
            Self::PosX => DVec3::X,
            Self::NegX => DVec3::NEG_X,
            Self::PosY => DVec3::Y,
            Self::NegY => DVec3::NEG_Y,
            Self::PosZ => DVec3::Z,
            Self::NegZ => DVec3::NEG_Z,
        }
    }

    /// The direction from a model to a viewer who sees its front: +Z for ±Y up, −Y for ±Z up, +Z for ±X up.
    pub fn front(self) -> DVec3 {
        match self {
            Self::PosZ | Self::NegZ => DVec3::NEG_Y,
            _ => DVec3::Z,
        }
    }

    /// All six, in the order of a menu.
    pub const ALL: [Self; 6] = [Self::PosY, Self::PosZ, Self::PosX, Self::NegY, Self::NegZ, Self::NegX];

    /// `+Y` and the like.
    pub fn name(self) -> &'static str {
        match self {
            Self::PosX => "+X",
            Self::NegX => "-X",
            Self::PosY => "+Y",
            Self::NegY => "-Y",
            Self::PosZ => "+Z",
            Self::NegZ => "-Z",
        }
    }
}

impl std::str::FromStr for Up {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let wanted = if s.starts_with(['+', '-']) {
            s.to_ascii_uppercase()
        } else {
            format!("+{}", s.to_ascii_uppercase())
        };
        Self::ALL
            .into_iter()
            .find(|up| up.name() == wanted)
            .ok_or_else(|| format!("`{s}` is no axis; use one of +X, -X, +Y, -Y, +Z, -Z"))
    }
}

impl Camera {
    /// Whether it can be used: all numbers finite, angle and height in their ranges.
    pub fn is_valid(&self) -> bool {
        [self.position, self.focal_point, self.view_up].iter().all(|v| v.is_finite())
            && match self.projection {
                Projection::Perspective { view_angle } => (1.0..=170.0).contains(&view_angle),
                Projection::Orthographic { view_height } => view_height.is_finite() && view_height > 0.0,
            }
    }

    /// Distance from the eye to the focal point, never 0.
    pub fn distance(&self) -> f64 {
        (self.focal_point - self.position).length().max(f64::MIN_POSITIVE)
    }

    /// Unit vector from the eye to the focal point.
    pub fn forward(&self) -> DVec3 {
        (self.focal_point - self.position).normalize_or(DVec3::NEG_Z)
    }

    /// Unit vector to the right of the picture.
    pub fn right(&self) -> DVec3 {
        let forward = self.forward();
        let right = forward.cross(self.view_up);
        if right.length_squared() > 1e-18 * self.view_up.length_squared() {
            right.normalize_or(DVec3::X)
        } else {
            forward.any_orthonormal_vector()
        }
    }

    /// Unit vector that is up in the picture.
    pub fn up(&self) -> DVec3 {
        self.right().cross(self.forward())
    }

    /// World space to view space: the eye at the origin, looking along −Z.
    pub fn view_from_world(&self) -> DMat4 {
        let (r, u, f) = (self.right(), self.up(), self.forward());
        let rotation = DMat4::from_cols(
            DVec3::new(r.x, u.x, -f.x).extend(0.0),
            DVec3::new(r.y, u.y, -f.y).extend(0.0),
            DVec3::new(r.z, u.z, -f.z).extend(0.0),
            glam::DVec4::W,
        );
        rotation * DMat4::from_translation(-self.position)
    }

    /// Height of the picture in scene units at the focal point.
    pub fn view_height(&self) -> f64 {
        match self.projection {
            Projection::Perspective { view_angle } => {
                2.0 * self.distance() * (view_angle.to_radians() * 0.5).tan()
            }
            Projection::Orthographic { view_height } => view_height,
        }
    }

    /// Vertical view angle in degrees that the camera has or would have after switching to perspective.
    pub fn view_angle(&self) -> f64 {
        match self.projection {
            Projection::Perspective { view_angle } => view_angle,
            Projection::Orthographic { .. } => DEFAULT_VIEW_ANGLE,
        }
    }

    /// The same view in the other projection; what lies at the focal point keeps its size.
    #[must_use]
    pub fn with_orthographic(&self, orthographic: bool) -> Self {
        let height = self.view_height();
        match (self.projection, orthographic) {
            (Projection::Perspective { .. }, true) => {
                Self { projection: Projection::Orthographic { view_height: height }, ..*self }
            }
            (Projection::Orthographic { .. }, false) => {
                let distance = height / (2.0 * (DEFAULT_VIEW_ANGLE.to_radians() * 0.5).tan());
                Self {
                    position: self.focal_point - self.forward() * distance,
                    projection: Projection::Perspective { view_angle: DEFAULT_VIEW_ANGLE },
                    ..*self
                }
            }
            _ => *self,
        }
    }

    /// The same direction and projection, moved so that what it sees fills a picture of this aspect (width / height) and
    /// all of it is inside. Points that are not finite are left out; without any the camera stays.
    #[must_use]
    pub fn framing(&self, seen: &(impl Framed + ?Sized), aspect: f64) -> Self {
        let framed = self.framing_points(seen.points(), aspect);
        let farthest = seen.farthest(&self.limits(aspect));
        // Where next to nothing is missed, the margin has room for it.
        if farthest.iter().all(|p| framed.has_inside(*p, aspect)) {
            return framed;
        }
        self.framing_points(&[seen.points(), &farthest].concat(), aspect)
    }

    /// The directions in which a picture that is seen in this direction ends: what reaches farthest along each of them
    /// is all that matters to [`Self::framing`].
    fn limits(&self, aspect: f64) -> Vec<DVec3> {
        let (r, u, f) = (self.right(), self.up(), self.forward());
        let slope = match self.projection {
            Projection::Perspective { view_angle } => (view_angle.to_radians() * 0.5).tan() / MARGIN,
            Projection::Orthographic { .. } => 0.0,
        };
        let (x, y) = (f * (slope * aspect.max(1e-3)), f * slope);
        vec![r - x, -r - x, u - y, -u - y, -f, f]
    }

    /// Whether a point is in the picture, not too near its rim.
    fn has_inside(&self, point: DVec3, aspect: f64) -> bool {
        let p = self.view_from_world().transform_point3(point);
        let half_height = match self.projection {
            Projection::Perspective { view_angle } => -p.z * (view_angle.to_radians() * 0.5).tan(),
            Projection::Orthographic { view_height } => 0.5 * view_height,
        };
        let half = half_height / MIN_MARGIN;
        p.z < 0.0 && p.x.abs() <= half * aspect.max(1e-3) && p.y.abs() <= half
    }

    fn framing_points(&self, points: &[DVec3], aspect: f64) -> Self {
        let bounds = points
            .iter()
            .filter(|p| p.is_finite())
            .fold(Bounds::EMPTY, |b, p| Bounds { min: b.min.min(*p), max: b.max.max(*p) });
        if bounds.is_empty() {
            return *self;
        }
        let center = bounds.center();
        let (r, u, f) = (self.right(), self.up(), self.forward());
        let local: Vec<DVec3> = points
            .iter()
            .filter(|p| p.is_finite())
            .map(|p| *p - center)
            .map(|d| DVec3::new(d.dot(r), d.dot(u), d.dot(f)))
            .collect();
        let extent = |value: &dyn Fn(&DVec3) -> f64| {
            local
                .iter()
                .map(value)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
        };
        let aspect = aspect.max(1e-3);
        let smallest = bounds.diagonal().max(1e-12) * 1e-3;
        match self.projection {
            Projection::Perspective { view_angle } => {
                let tan = (view_angle.to_radians() * 0.5).tan() / MARGIN;
                // Along one axis, a point at (x, z) is in the picture when |x − shift| ≤ slope · (distance + z). The
                // greatest of x ∓ slope · z on either side give the nearest distance and the shift.
                let side = |value: &dyn Fn(&DVec3) -> f64, slope: f64| {
                    let (_, hi) = extent(&|p| value(p) - slope * p.z);
                    let (lo, _) = extent(&|p| value(p) + slope * p.z);
                    ((hi - lo) / (2.0 * slope), (hi + lo) * 0.5)
                };
                let (distance_x, shift_x) = side(&|p| p.x, tan * aspect);
                let (distance_y, shift_y) = side(&|p| p.y, tan);
                // Never so near that something lies behind the eye.
                let (front, _) = extent(&|p| p.z);
                let distance = distance_x.max(distance_y).max(smallest - front);
                let focal_point = center + r * shift_x + u * shift_y;
                Self { position: focal_point - f * distance, focal_point, ..*self }
            }
            Projection::Orthographic { .. } => {
                let ((left, right), (bottom, top)) = (extent(&|p| p.x), extent(&|p| p.y));
                let height = MARGIN * (top - bottom).max((right - left) / aspect).max(smallest);
                let focal_point = center + r * ((left + right) * 0.5) + u * ((bottom + top) * 0.5);
                Self {
                    position: focal_point - f * bounds.diagonal().max(smallest),
                    focal_point,
                    projection: Projection::Orthographic { view_height: height },
                    ..*self
                }
            }
        }
    }

    /// Turns about the focal point: `azimuth` about `up` (positive moves the eye to its right), then `elevation`
    /// towards `up`, both in degrees. The eye stops short of the poles, so `up` stays up.
    #[must_use]
    pub fn orbited(&self, up: DVec3, azimuth: f64, elevation: f64) -> Self {
        let up = up.normalize_or(DVec3::Y);
        let back = -self.forward();
        let turn = glam::DQuat::from_axis_angle(up, azimuth.to_radians());
        let right = turn * self.right();
        let back = turn * back;
        let now = back.dot(up).clamp(-1.0, 1.0).asin().to_degrees();
        let then = (now + elevation).clamp(now.min(-89.9), now.max(89.9));
        let tilt = glam::DQuat::from_axis_angle(right, -(then - now).to_radians());
        Self {
            position: self.focal_point + (tilt * back) * self.distance(),
            view_up: (tilt * (turn * self.up())).normalize_or(up),
            ..*self
        }
    }

    /// A camera that looks at all of `seen` from `direction` (towards the viewer), upright.
    pub fn looking_from(direction: DVec3, up: DVec3, seen: &(impl Framed + ?Sized), aspect: f64) -> Self {
        let direction = direction.normalize_or(DVec3::Z);
        let view_up = if direction.dot(up).abs() > 0.999 {
            // Seen from above, the front of the model is at the bottom of the picture.
            let back = if up.y.abs() > 0.5 { DVec3::NEG_Z } else { DVec3::Y };
            back * direction.dot(up).signum()
        } else {
            up
        };
        Self { position: direction, focal_point: DVec3::ZERO, view_up, ..Self::default() }
            .framing(seen, aspect)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_box() -> [DVec3; 8] {
        Bounds { min: DVec3::splat(-1.0), max: DVec3::ONE }.corners()
    }

    #[test]
    fn framing_keeps_every_corner_in_the_picture() {
        for direction in [DVec3::Z, DVec3::new(1.0, 2.0, 3.0), DVec3::Y] {
            for aspect in [0.3, 1.0, 2.5] {
                let camera = Camera::looking_from(direction, DVec3::Y, &unit_box(), aspect);
                let tan = (DEFAULT_VIEW_ANGLE.to_radians() * 0.5).tan();
                for corner in unit_box() {
                    let p = camera.view_from_world().transform_point3(corner);
                    assert!(p.z < 0.0, "{p} lies behind the eye");
                    assert!((p.y / -p.z).abs() <= tan && (p.x / -p.z).abs() <= tan * aspect);
                }
            }
        }
    }

    #[test]
    fn orbiting_a_full_turn_comes_back_and_never_rolls() {
        let start = Camera::looking_from(DVec3::new(1.0, 1.0, 2.0), DVec3::Y, &unit_box(), 1.0);
        let mut camera = start;
        for _ in 0..72 {
            camera = camera.orbited(DVec3::Y, 5.0, 0.0);
            assert!(camera.right().y.abs() < 1e-9);
        }
        assert!((camera.position - start.position).length() < 1e-9);
        let over_the_top = start.orbited(DVec3::Y, 0.0, 500.0);
        assert!(over_the_top.forward().y < -0.99 && over_the_top.right().y.abs() < 1e-9);
    }

    #[test]
    fn switching_the_projection_there_and_back_keeps_the_height_at_the_focal_point() {
        let camera = Camera::looking_from(DVec3::Z, DVec3::Y, &unit_box(), 1.0);
        let parallel = camera.with_orthographic(true);
        assert!((parallel.view_height() - camera.view_height()).abs() < 1e-9);
        let back = parallel.with_orthographic(false);
        assert!((back.position - camera.position).length() < 1e-9);
    }
}
