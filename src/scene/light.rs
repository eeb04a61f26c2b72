//! Light sources.

use glam::{DMat4, DVec3, Vec3};

/// One light, in world space or in the space of the eye.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Light {
    /// Kind of source.
    pub kind: LightKind,
    /// Linear RGB color, 0 to 1.
    pub color: Vec3,
    /// Relative brightness; 1 lights a white surface facing it fully white.
    pub intensity: f32,
    /// Whether the light moves with the camera: its direction or position is then in view space.
    pub attached_to_camera: bool,
    /// Whether objects throw shadows in its light, where the drawing has shadows.
    #[serde(default)]
    pub casts_shadow: bool,
}

/// Kind of light source, without physical units: drawings do not need them.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LightKind {
    /// Parallel light that travels along `direction` (unit length, from the light to the scene).
    Directional {
        /// Direction in which the light travels.
        direction: DVec3,
    },
    /// A point that shines in all directions, without fall-off.
    Point {
        /// Where it stands.
        position: DVec3,
    },
}

impl Light {
    /// Whether all its numbers are finite.
    pub fn is_valid(&self) -> bool {
        let place = match self.kind {
            LightKind::Directional { direction } => direction,
            LightKind::Point { position } => position,
        };
        place.is_finite() && self.color.is_finite() && self.intensity.is_finite()
    }

    /// The same light where it stands at present, for other cameras to see; `world_from_view`: of the camera to which it
    /// may be attached.
    #[must_use]
    pub fn placed(&self, world_from_view: &DMat4) -> Self {
        if !self.attached_to_camera {
            return self.clone();
        }
        let kind = match self.kind {
            LightKind::Directional { direction } => {
                LightKind::Directional { direction: world_from_view.transform_vector3(direction) }
            }
            LightKind::Point { position } => {
                LightKind::Point { position: world_from_view.transform_point3(position) }
            }
        };
        Self { kind, attached_to_camera: false, ..self.clone() }
    }
}
