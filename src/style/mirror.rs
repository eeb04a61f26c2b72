//! Mirrors: how a flat object with the role mirror shows the scene (edge-enhancement paper, section 5, Fig. 8).

use super::Color;
use super::param::Params;
use super::slot::choice;

/// Parameters of an object with the role mirror; without the role they do nothing.
///
/// The scene as seen in the mirror lies over the object's own shading with an opacity of
/// `r + (1 − r) · fresnel · (1 − cos θ)⁵`, r the reflectivity and θ the angle between the view and the mirror's normal
/// (Schlick 1994).
#[derive(Debug, Clone, PartialEq)]
pub struct Mirror {
    /// Which side of the face reflects.
    pub side: Side,
    /// Opacity of the reflection seen from the front; 0: none.
    pub reflectivity: f32,
    /// How far the opacity grows towards 1 where the mirror is seen at a slant; 0: not at all.
    pub fresnel: f32,
    /// What the reflection is multiplied by.
    pub tint: Color,
}

choice! {
    /// A side of a flat object.
    pub enum Side {
        /// The front by the file's winding.
        #[default]
        Front,
        /// The back.
        Back,
        /// Both.
        Both,
    }
}

impl Default for Mirror {
    fn default() -> Self {
        Self { side: Side::default(), reflectivity: 0.9, fresnel: 1.0, tint: Color::WHITE }
    }
}

impl Mirror {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.choice("side", "Side", "Which side of the face reflects.", &mut self.side);
        list.share(
            "reflectivity",
            "Reflectivity",
            "Opacity of the reflection over the object's own shading, seen from the front.",
            &mut self.reflectivity,
        );
        list.share(
            "fresnel",
            "Fresnel",
            "How far the reflection grows stronger where the mirror is seen at a slant.",
            &mut self.fresnel,
        );
        list.color("tint", "Tint", "Color that the reflection is multiplied by.", &mut self.tint);
    }
}
