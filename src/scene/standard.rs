//! Standard directions to look from, as in CAD.

use glam::DVec3;

use super::{Camera, Framed, Projection, Up};

/// A standard direction to look from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::EnumString, strum::VariantNames)]
#[strum(serialize_all = "lowercase")]
pub enum Standard {
    /// The side that faces the viewer in the file's format.
    Front,
    /// Opposite of the front.
    Back,
    /// The viewer's right when looking at the front.
    Right,
    /// Opposite of the right.
    Left,
    /// From above.
    Top,
    /// From below.
    Bottom,
    /// From front, right and above at equal angles.
    Isometric,
    /// Nearly from the front, a little from the right and above; the first view of a model.
    Home,
}

impl Standard {
    /// The direction from the model to the viewer.
    pub fn direction(self, up: Up) -> DVec3 {
        let (up, front) = (up.vector(), up.front());
        let right = up.cross(front);
        match self {
            Self::Front => front,
            Self::Back => -front,
            Self::Right => right,
            Self::Left => -right,
            Self::Top => up,
            Self::Bottom => -up,
            Self::Isometric => front + right + up,
            // 30° to the right and 20° up, like the first picture of the command line.
            Self::Home => {
                let ((sin_a, cos_a), (sin_e, cos_e)) =
                    (30_f64.to_radians().sin_cos(), 20_f64.to_radians().sin_cos());
                (front * cos_a + right * sin_a) * cos_e + up * sin_e
            }
        }
    }

    /// A camera that sees all of `extent` from there, in the projection of `like`.
    pub fn camera(
        self,
        up: Up,
        extent: &(impl Framed + ?Sized),
        aspect: f64,
        like: Option<&Camera>,
    ) -> Camera {
        let parallel = like.is_some_and(|c| matches!(c.projection, Projection::Orthographic { .. }));
        let mut camera = Camera::looking_from(self.direction(up), up.vector(), extent, aspect);
        if let Some(Camera { projection: Projection::Perspective { view_angle }, .. }) = like {
            camera.projection = Projection::Perspective { view_angle: *view_angle };
            camera = camera.framing(extent, aspect);
        }
        if parallel { camera.with_orthographic(true).framing(extent, aspect) } else { camera }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Bounds;

    #[test]
    fn standard_views_look_where_they_say_for_every_up() {
        let cube = Bounds { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) }.corners();
        for up in Up::ALL {
            for (standard, opposite) in [
                (Standard::Front, Standard::Back),
                (Standard::Right, Standard::Left),
                (Standard::Top, Standard::Bottom),
            ] {
                let (a, b) = (standard.direction(up), opposite.direction(up));
                assert_eq!(a, -b);
            }
            let front = Standard::Front.camera(up, &cube, 1.0, None);
            assert!(front.right().dot(Standard::Right.direction(up)) > 0.99);
            assert!(front.up().dot(up.vector()) > 0.99);
            let top = Standard::Top.camera(up, &cube, 1.0, None);
            assert!(top.forward().dot(up.vector()) < -0.99);
        }
    }
}
