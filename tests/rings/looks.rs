//! What rings look like: each technique, glass, and blueprints of two styles.

use std::str::FromStr as _;

use hachure::style::halftone::Space;
use hachure::style::hatching::Mapping;
use hachure::style::toon::Smoothing;
use hachure::style::{Color, Matrix, Style, Technique};
use strum::VariantNames as _;

/// Reference pixels per pixel of the pictures.
pub const REFERENCE: f32 = 1080.0 / super::SIDE as f32;

/// Which share of what lies behind them layers of glass hide: a whole number of 255ths, so that no picture rounds it.
pub const GLASS: f32 = 102.0 / 255.0;

/// How a ring is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    pub name: String,
    pub kind: Kind,
    pub style: Style,
}

/// What a look does to what lies behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Hides it.
    Surface,
    /// Its material blends.
    Glass,
    /// Each of its layers is drawn.
    Blueprint,
}

impl Look {
    fn new(name: &str, kind: Kind, technique: &str) -> Self {
        let mut style = Style { technique: Technique::from_str(technique).unwrap(), ..Style::default() };
        style.edges.profile.width = 2.0 * REFERENCE;
        // What is fixed to surfaces may depend on what else there is to fix it to.
        // Stripes of a part of a mesh are not those of all of it.
        (style.hatching.mapping, style.hatching.turn_step) = (Mapping::ImageSpace, 90.0);
        style.halftone.space = Space::Screen;
        style.halftone.scale = 4.0 * REFERENCE;
        Self { name: name.to_owned(), kind, style }
    }

    /// A technique, in a material that hides what lies behind it.
    pub fn surface(technique: &str) -> Self {
        Self::new(technique, Kind::Surface, technique)
    }

    /// The same technique as a sketch that puts everything where it is: what is seen of it is known from cast rays.
    pub fn sketch(technique: &str) -> Self {
        let mut look = Self { name: format!("sketch {technique}"), ..Self::surface(technique) };
        let sketch = &mut look.style.sketch;
        sketch.enabled = true;
        sketch.pass[0].matrix = Matrix::ZERO;
        sketch.fill.matrix = Matrix::ZERO;
        // So little that nobody sees it; with nothing at all it would be no sketch.
        sketch.wander.pressure = 1e-6;
        look
    }

    /// The same technique in a material that blends.
    pub fn glass(technique: &str) -> Self {
        let mut look = Self::new(&format!("glass {technique}"), Kind::Glass, technique);
        // Smoothed borders are means of what lies around in the picture, which is another surface in each.
        look.style.toon.smoothing = Smoothing::Nearest;
        look
    }

    /// A blueprint of its own fill and lines.
    fn blueprint(name: &str, fill: [u8; 3], near: [u8; 3], opacity: f32) -> Self {
        let mut look = Self::new(name, Kind::Blueprint, "blueprint");
        let blueprint = &mut look.style.blueprint;
        (blueprint.fill, blueprint.near, blueprint.fill_opacity) = (Color(fill), Color(near), opacity);
        (blueprint.max_layers, blueprint.to, blueprint.min_coverage) = (64, 64, 0.0);
        look
    }

    /// Blue, with dark lines.
    pub fn blueprint_a() -> Self {
        Self::blueprint("blueprint A", [70, 120, 200], [12, 52, 140], 102.0 / 255.0)
    }

    /// Pink, more opaque, with thinner lines of red.
    pub fn blueprint_b() -> Self {
        let mut look = Self::blueprint("blueprint B", [235, 150, 160], [190, 20, 30], 153.0 / 255.0);
        look.style.edges.profile.width = 1.5 * REFERENCE;
        look
    }

    /// The same without lines.
    pub fn without_lines(mut self) -> Self {
        self.style.edges.profile.show = false;
        self.style.edges.inner.show = false;
        self
    }

    /// The same with lines so wide, px.
    pub fn with_width(mut self, width: f32) -> Self {
        self.style.edges.profile.width = width * REFERENCE;
        self
    }

    /// The same with no layer but this one, 1 the nearest.
    pub fn only_layer(mut self, layer: u32) -> Self {
        (self.style.blueprint.from, self.style.blueprint.to) = (layer, layer);
        self
    }
}

/// The techniques of surfaces; one that is added later is in the tests without a word here.
pub fn surface_techniques() -> impl Iterator<Item = &'static str> {
    Technique::VARIANTS.iter().copied().filter(|name| *name != "blueprint")
}

/// Every technique on what hides what lies behind it, and sketches.
pub fn surfaces() -> Vec<Look> {
    surface_techniques().map(Look::surface).chain(["unlit", "gooch"].map(Look::sketch)).collect()
}

/// What is seen through.
pub fn layered() -> Vec<Look> {
    vec![Look::glass("unlit"), Look::blueprint_a(), Look::blueprint_b()]
}
