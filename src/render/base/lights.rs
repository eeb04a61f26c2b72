//! The lights of a frame, in world space, and which of them throw shadows.

use glam::{DMat4, Vec3};

use crate::document::Document;
use crate::document::lighting::Source;
use crate::scene::{LightKind, Scene};

/// More lights are left out.
pub const MAX_LIGHTS: usize = 8;
/// So many lights throw shadows at most: one channel of the shadow mask each.
pub const MAX_SHADOWS: usize = 4;

/// A light in world space. Whatever camera looks at it, be it a mirror's, it stands where the eye's camera left it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorldLight {
    /// Kind and place.
    pub kind: LightKind,
    /// Linear color times intensity.
    pub color: Vec3,
    /// Its channel in the shadow mask, if it throws shadows.
    pub shadow: Option<usize>,
}

/// All lights of a frame; the first one is the key.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lights {
    /// At most [`MAX_LIGHTS`].
    pub lights: Vec<WorldLight>,
    /// How dark shadows are, 0 to 1.
    pub density: f32,
    /// Tangent of the radius at which lights are seen from the objects.
    pub spread: f32,
    /// Texels of a shadow map per pixel of the picture's longer side.
    pub detail: f32,
}

impl Lights {
    /// The lights of a document; some may be fixed to the eye.
    pub fn new(document: &Document, scene: &Scene, view_from_world: &DMat4) -> Self {
        let world_from_view = view_from_world.inverse();
        let settings = &document.lighting;
        let mut sources = document.light_sources(document.up(scene));
        sources.truncate(MAX_LIGHTS);
        // Files do not say which of their lights is to throw shadows.
        if !sources.iter().any(|l| l.casts_shadow) && settings.source == Source::File {
            sources.iter_mut().take(1).for_each(|key| key.casts_shadow = true);
        }
        let density = if settings.shadows { settings.shadow_density } else { 0.0 };
        let mut channels = 0..if density > 0.0 { MAX_SHADOWS } else { 0 };
        let lights = sources
            .iter()
            .map(|light| WorldLight {
                kind: light.placed(&world_from_view).kind,
                color: light.color.clamp(Vec3::ZERO, Vec3::ONE) * light.intensity.max(0.0),
                shadow: if light.casts_shadow && light.intensity > 0.0 { channels.next() } else { None },
            })
            .collect();
        Self {
            lights,
            density,
            spread: settings.shadow_softness.to_radians().tan(),
            detail: settings.shadow_detail,
        }
    }

    /// The lights that throw shadows, in the order of their channels.
    pub fn casting(&self) -> impl Iterator<Item = &WorldLight> {
        self.lights.iter().filter(|l| l.shadow.is_some())
    }
}
