//! What lights a drawing: a key, a fill and a rim light that a person sets, or the lights of the files; and shadows.

use crate::style::choice;
use glam::{DMat3, DVec3};

use crate::scene::{Light, LightKind, Up};
use crate::style::Color;
use crate::style::param::{Param, Params};

/// Light settings of a document.
#[derive(Debug, Clone, PartialEq)]
pub struct Lighting {
    /// Which lights there are.
    pub source: Source,
    /// Whether lights throw shadows at all.
    pub shadows: bool,
    /// How dark shadows are; 0: none, 1: nothing of the light is left.
    pub shadow_density: f32,
    /// Radius of the lights as seen from the objects, degrees; 0: hard borders.
    pub shadow_softness: f32,
    /// Texels of a shadow map for each pixel of the picture's longer side.
    pub shadow_detail: f32,
    /// The main light, on which one-light techniques rely.
    pub key: Lamp,
    /// Lightens what the key leaves dark.
    pub fill: Lamp,
    /// From behind, sets objects off against the paper.
    pub rim: Lamp,
}

/// One light of the rig: parallel light from a direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Lamp {
    /// Whether it shines.
    pub show: bool,
    /// Where it shines from: degrees to the right of the front.
    pub azimuth: f32,
    /// Where it shines from: degrees above the horizon.
    pub elevation: f32,
    /// Brightness; 1 lights a white surface facing it fully white.
    pub intensity: f32,
    /// Its color.
    pub color: Color,
    /// What its direction is fixed to.
    pub attached: Attached,
    /// Whether it throws shadows, where the drawing has shadows.
    pub shadow: bool,
}

choice! {
    /// Which lights there are.
    pub enum Source {
        /// Key, fill and rim.
        #[default]
        Rig,
        /// The lights of the model files.
        File,
    }
}

choice! {
    /// What a light's direction is fixed to.
    pub enum Attached {
        /// It moves with the eye: the front is where the eye is.
        #[default]
        Camera,
        /// It stands still: the front is that of the model.
        World,
    }
}

impl Attached {
    /// Right, up and front: in view space, or in world space with the model's `up`.
    pub fn axes(self, up: Up) -> DMat3 {
        match self {
            Self::Camera => DMat3::IDENTITY,
            Self::World => {
                let (up, front) = (up.vector(), up.front());
                DMat3::from_cols(up.cross(front), up, front)
            }
        }
    }
}

impl Default for Lamp {
    fn default() -> Self {
        Self {
            show: true,
            azimuth: 0.0,
            elevation: 0.0,
            intensity: 1.0,
            color: Color::WHITE,
            attached: Attached::default(),
            shadow: false,
        }
    }
}

impl Default for Lighting {
    /// A key light over the viewer's left shoulder and a weaker fill from the right; no shadows.
    fn default() -> Self {
        Self {
            source: Source::Rig,
            shadows: false,
            shadow_density: 1.0,
            shadow_softness: 0.0,
            shadow_detail: 2.0,
            key: Lamp { azimuth: -33.69, elevation: 37.83, intensity: 0.85, shadow: true, ..Lamp::default() },
            fill: Lamp { azimuth: 63.43, elevation: 6.38, intensity: 0.25, ..Lamp::default() },
            rim: Lamp { show: false, azimuth: 150.0, elevation: 30.0, intensity: 0.5, ..Lamp::default() },
        }
    }
}

impl Lamp {
    /// The unit vector towards it: right, up, front.
    pub fn direction(&self) -> DVec3 {
        let (sin_a, cos_a) = f64::from(self.azimuth).to_radians().sin_cos();
        let (sin_e, cos_e) = f64::from(self.elevation).to_radians().sin_cos();
        DVec3::new(sin_a * cos_e, sin_e, cos_a * cos_e)
    }

    /// Turns it to where it shines from `direction` (right, up, front; not 0), in whole tenths of a degree.
    pub fn turn_to(&mut self, direction: DVec3) {
        let direction = direction.normalize_or(DVec3::Z);
        let tenths = |radians: f64| ((radians.to_degrees() * 10.0).round() / 10.0) as f32;
        self.elevation = tenths(direction.y.clamp(-1.0, 1.0).asin());
        // Straight above or below, any azimuth is as good as the last one.
        if direction.x.hypot(direction.z) > 1e-3 {
            self.azimuth = tenths(direction.x.atan2(direction.z));
        }
    }

    fn light(&self, up: Up) -> Light {
        Light {
            kind: LightKind::Directional { direction: -(self.attached.axes(up) * self.direction()) },
            color: self.color.to_linear(),
            intensity: self.intensity,
            attached_to_camera: self.attached == Attached::Camera,
            casts_shadow: self.shadow,
        }
    }

    fn params<'a>(&'a mut self, list: &mut Params<'a>, name: &'static str, help: &'static str) {
        list.head("show", name, help, &mut self.show);
        list.number(
            "azimuth",
            "Azimuth",
            "°",
            -180.0..=180.0,
            "Where it shines from: 0 is the front, 90 the right.",
            &mut self.azimuth,
        );
        list.number(
            "elevation",
            "Elevation",
            "°",
            -90.0..=90.0,
            "Where it shines from: 90 is straight above.",
            &mut self.elevation,
        );
        list.wide_number(
            "intensity",
            "Intensity",
            "",
            0.0..=1.5,
            0.0..=4.0,
            "Brightness; at 1 a white surface that faces it is white.",
            &mut self.intensity,
        );
        list.color("color", "Color", "Color of the light.", &mut self.color);
        list.choice(
            "attached",
            "Fixed to",
            "The camera: it moves with the eye. The world: it stands still when the camera turns.",
            &mut self.attached,
        );
        list.switch(
            "shadow",
            "Throws shadow",
            "Whether objects throw shadows in this light, where shadows are on.",
            &mut self.shadow,
        );
    }
}

impl Lighting {
    /// The names of the rig's lights, in the order of [`Self::lamps_mut`].
    pub const LAMPS: [&'static str; 3] = ["key", "fill", "rim"];

    /// The rig's lights.
    pub fn lamps_mut(&mut self) -> [&mut Lamp; 3] {
        [&mut self.key, &mut self.fill, &mut self.rim]
    }

    /// The lights of the rig that shine, the key first. `up`: the model's.
    pub fn rig(&self, up: Up) -> Vec<Light> {
        [&self.key, &self.fill, &self.rim].into_iter().filter(|l| l.show).map(|l| l.light(up)).collect()
    }

    /// Every parameter, like [`crate::style::Style::params`].
    pub fn params(&mut self) -> Vec<Param<'_>> {
        let mut list = Params::default();
        self.declare(&mut list);
        list.finish()
    }

    /// The same with every number in the range of its parameter, however it was set.
    #[must_use]
    pub fn clamped(&self) -> Self {
        let mut clamped = self.clone();
        clamped.declare(&mut Params::clamping());
        clamped
    }

    fn declare<'a>(&'a mut self, list: &mut Params<'a>) {
        list.section("light", |list| {
            list.choice(
                "source",
                "Light source",
                "The rig of key, fill and rim light, or the lights of the model files.",
                &mut self.source,
            );
            list.switch("shadows", "Shadows", "Whether lights throw shadows.", &mut self.shadows);
            list.share(
                "shadow_density",
                "Shadow density",
                "How dark shadows are: less leaves some of the light in them.",
                &mut self.shadow_density,
            );
            list.wide_number(
                "shadow_softness",
                "Softness",
                "°",
                0.0..=5.0,
                0.0..=10.0,
                "Radius of the light: shadows get softer with the distance from what throws them; 0 is hard.",
                &mut self.shadow_softness,
            );
            list.wide_number(
                "shadow_detail",
                "Shadow detail",
                "",
                0.5..=4.0,
                0.25..=8.0,
                "Texels of the shadow map per pixel of the picture: more is more exact and slower.",
                &mut self.shadow_detail,
            );
            list.when("light.source", Source::Rig, |list| {
                list.section("key", |list| {
                    self.key.params(list, "Key light", "The main light; shading by one light uses it.");
                });
                list.section("fill", |list| {
                    self.fill.params(list, "Fill light", "Lightens what the key light leaves dark.");
                });
                list.section("rim", |list| {
                    self.rim.params(list, "Rim light", "From behind: sets objects off against the paper.");
                });
            });
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lamp_shines_from_where_it_was_turned_to() {
        let mut lamp = Lamp::default();
        for (azimuth, elevation) in [(0.0, 0.0), (-33.7, 37.8), (120.0, -45.0), (180.0, 10.0)] {
            (lamp.azimuth, lamp.elevation) = (azimuth, elevation);
            let direction = lamp.direction();
            lamp.turn_to(direction);
            assert!((lamp.direction() - direction).length() < 1e-3, "{azimuth}, {elevation}");
        }
        lamp.turn_to(DVec3::Y);
        assert_eq!((lamp.azimuth, lamp.elevation), (180.0, 90.0));
    }

    #[test]
    fn a_light_fixed_to_the_world_knows_its_axes() {
        let lamp = Lamp { azimuth: 90.0, attached: Attached::World, ..Lamp::default() };
        for up in Up::ALL {
            let LightKind::Directional { direction } = lamp.light(up).kind else { panic!("no direction") };
            assert!((direction + up.vector().cross(up.front())).length() < 1e-12, "{}", up.name());
        }
    }
}
