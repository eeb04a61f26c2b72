//! Toon shading: a few flat shades from a ramp (Lake et al. 2000; edge-enhancement paper, section 5, "Edge-Enhanced
//! Cartoon-Style Rendering").

use super::slot::choice;
use std::path::{Path, PathBuf};

use super::Color;
use super::param::Params;
pub use super::ramp::Ramp;

/// The most bands whose number is set by hand.
const MAX_BANDS: u32 = 8;

/// The most bands that any ramp has; an image of more texels is averaged.
pub const MAX_RAMP: u32 = 256;

/// Parameters of the technique `toon`.
///
/// The cosine N·L of the angle between the surface's normal and the direction to the first light selects a shade from
/// a ramp of flat bands. Over them lie a highlight and a rim, both with a hard border too.
#[derive(Debug, Clone, PartialEq)]
pub struct Toon {
    /// Where the shades come from.
    pub ramp: Ramp,
    /// The image of [`Ramp::Image`]: one band per texel along its longer side, from the left or the top. Without one
    /// the bands are drawn.
    pub image: Option<PathBuf>,
    /// Number of bands.
    pub bands: u32,
    /// How borders between bands are drawn.
    pub smoothing: Smoothing,
    /// Color of the darkest band.
    pub shadow: Color,
    /// Color halfway; with two bands it has no place.
    pub mid: Color,
    /// Color of the lightest band.
    pub light: Color,
    /// Share of the object's own color; 0: the ramp's colors as they are, 1: they multiply the object's color.
    pub object_color: f32,
    /// N·L at which the ramp begins; the paper's ramp begins at 0.
    pub start: f32,
    /// N·L at which the ramp ends; the paper's ramp ends at 1.
    pub end: f32,
    /// Opacity of the white highlight; 0: none.
    pub highlight: f32,
    /// Angle between the normal and the middle of light and eye up to which the highlight reaches, degrees.
    pub highlight_size: f32,
    /// Opacity of the rim; 0: none.
    pub rim: f32,
    /// Cosine of the angle between the normal and the direction to the eye below which a point is of the rim.
    pub rim_width: f32,
    /// Color of the rim.
    pub rim_color: Color,
}

choice! {
    /// How borders between bands are drawn (paper, Fig. 9).
    pub enum Smoothing {
        /// Each pixel has the shade of one band: edged, and jagged.
        Nearest,
        /// The bands are kept as a texture, the cartoon map, and a pixel's shade is a mean of its neighbors' there.
        #[default]
        CartoonMap,
        /// The share of each band in a pixel, from the slope of N·L.
        Analytic,
    }
}

impl Default for Toon {
    fn default() -> Self {
        Self {
            ramp: Ramp::default(),
            image: None,
            bands: 3,
            smoothing: Smoothing::default(),
            shadow: Color([110, 106, 140]),
            mid: Color([196, 194, 208]),
            light: Color::WHITE,
            object_color: 1.0,
            start: 0.0,
            end: 1.0,
            highlight: 0.0,
            highlight_size: 14.0,
            rim: 0.0,
            rim_width: 0.3,
            rim_color: Color::WHITE,
        }
    }
}

impl Toon {
    /// The image whose texels are the ramp, if it is one.
    pub fn ramp_image(&self) -> Option<&Path> {
        self.image.as_deref().filter(|_| self.ramp == Ramp::Image)
    }

    /// Whether another toon has the same ramp.
    pub fn has_ramp_of(&self, other: &Self) -> bool {
        let ramp = |toon: &Self| (toon.ramp, toon.bands, toon.shadow, toon.mid, toon.light);
        ramp(self) == ramp(other) && self.image == other.image
    }

    /// The colors of the ramp where they do not come from an image, from shadow to light: those of a built-in one, or
    /// even steps from `shadow` over `mid` to `light`, as displayed.
    pub fn colors(&self) -> Vec<Color> {
        let count = self.bands.clamp(2, MAX_BANDS);
        let color = |band: u32| {
            let place = 2.0 * band as f32 / (count - 1) as f32;
            if place <= 1.0 {
                self.shadow.mixed(self.mid, place)
            } else {
                self.mid.mixed(self.light, place - 1.0)
            }
        };
        self.ramp.colors().unwrap_or_else(|| (0..count).map(color).collect())
    }

    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.choice("ramp", "Ramp", "Where the shades come from, from shadow to light.", &mut self.ramp);
        list.when("toon.ramp", Ramp::Bands, |list| {
            list.integer("bands", "Bands", "", 2..=MAX_BANDS, "Number of flat shades.", &mut self.bands);
            list.color("shadow", "Shadow", "Color of the darkest band.", &mut self.shadow);
            list.color("mid", "Middle", "Color halfway; two bands do without.", &mut self.mid);
            list.color("light", "Light", "Color of the lightest band.", &mut self.light);
        });
        list.when("toon.ramp", Ramp::Image, |list| {
            list.file(
                "image",
                "Image",
                "Each texel along its longer side is a band, from shadow (left or top) to light; at most 256.",
                &mut self.image,
            );
        });
        list.choice("smoothing", "Smoothing", "How borders between bands are smoothed.", &mut self.smoothing);
        list.formerly("border");
        list.share(
            "object_color",
            "Object color",
            "How far the bands are multiplied by the object's own color; 0 leaves them as they are.",
            &mut self.object_color,
        );
        list.formerly("tint");
        list.number(
            "start",
            "Ramp start",
            "",
            -1.0..=1.0,
            "Where the bands begin: -1 faces away from the light, 0 is lit from the side, 1 faces it.",
            &mut self.start,
        );
        list.number(
            "end",
            "Ramp end",
            "",
            -1.0..=1.0,
            "Where the bands end: less makes the lightest one larger.",
            &mut self.end,
        );
        list.share(
            "highlight",
            "Highlight",
            "Opacity of the white highlight; 0 switches it off.",
            &mut self.highlight,
        );
        list.wide_number(
            "highlight_size",
            "Highlight size",
            "°",
            2.0..=40.0,
            1.0..=60.0,
            "How far the highlight reaches around the point that mirrors the light.",
            &mut self.highlight_size,
        );
        list.share(
            "rim",
            "Rim",
            "Opacity of a band where the surface turns away from the eye; 0 switches it off.",
            &mut self.rim,
        );
        list.wide_number(
            "rim_width",
            "Rim width",
            "",
            0.0..=0.8,
            0.0..=1.0,
            "How far the rim reaches inwards: 0 nowhere, 1 to where the surface faces the eye.",
            &mut self.rim_width,
        );
        list.color("rim_color", "Rim color", "Color of the rim.", &mut self.rim_color);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_runs_from_shadow_over_middle_to_light() {
        let toon = |bands| Toon {
            bands,
            shadow: Color([0, 0, 0]),
            mid: Color([100, 40, 0]),
            light: Color([200, 240, 100]),
            ..Toon::default()
        };
        assert_eq!(toon(2).colors(), [Color([0, 0, 0]), Color([200, 240, 100])]);
        assert_eq!(toon(3).colors(), [Color([0, 0, 0]), Color([100, 40, 0]), Color([200, 240, 100])]);
        assert_eq!(toon(5).colors()[1], Color([50, 20, 0]));
        assert_eq!(toon(5).colors()[3], Color([150, 140, 50]));
        assert_eq!([toon(0).colors().len(), toon(8).colors().len(), toon(99).colors().len()], [2, 8, 8]);
        let image = Toon { ramp: Ramp::Image, ..toon(4) };
        assert_eq!(image.colors(), toon(4).colors(), "without its image it has bands");
    }
}
