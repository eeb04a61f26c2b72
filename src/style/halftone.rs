//! Halftone: tones by the density of ink (Freudenberg et al. 2002; edge-enhancement paper, section 5, "Edge-Enhanced
//! Real-Time Hatching").

use super::slot::choice;
use std::path::{Path, PathBuf};

use super::Color;
use super::param::Params;

/// Parameters of the technique `halftone`.
///
/// The tone of a point is the light there, 0 (black) to 1 (paper). Its texture says for every place at which tone ink
/// appears; the darker, the more of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Halftone {
    /// What the ink looks like.
    pub texture: Texture,
    /// The image of [`Texture::Image`]: a square tile, inked first where it is dark. Without one there are strokes.
    pub image: Option<PathBuf>,
    /// To what the texture is fixed.
    pub space: Space,
    /// How it lies on a surface.
    pub mapping: Mapping,
    /// Distance between lines or dots, reference pixels; on a surface it is held within an octave.
    pub scale: f32,
    /// By how much the texture is turned, degrees.
    pub angle: f32,
    /// Width of the soft rim of ink, pixels; 1 is as sharp as pixels allow.
    pub smoothness: f32,
    /// Color of the ink.
    pub ink: Color,
    /// Share of the object's own color in the ink.
    pub ink_tint: f32,
    /// Color between the ink.
    pub paper: Color,
    /// Share of the object's own color on the paper.
    pub paper_tint: f32,
    /// Light that reaches every point from everywhere.
    pub ambient: f32,
    /// How far an object's own color makes its tone darker; 0: not at all, 1: as much as it is dark.
    pub object_tone: f32,
    /// Light that becomes black.
    pub black: f32,
    /// Light that becomes paper.
    pub white: f32,
    /// Exponent of the tone between them: more is darker.
    pub gamma: f32,
}

choice! {
    /// What the ink looks like: a built-in prioritized texture, or an image.
    pub enum Texture {
        /// Strokes of a pen, crossed where it gets darker.
        #[default]
        Strokes,
        /// Dots of a printing screen.
        Dots,
        /// Ruled lines that get wider.
        Lines,
        /// Dots of a pen, strewn evenly.
        Stipple,
        /// An image, whose dark parts are inked first.
        Image,
    }
}

choice! {
    /// To what the texture is fixed.
    pub enum Space {
        /// It lies on the objects and turns with them.
        #[default]
        Surface,
        /// It lies on the picture.
        Screen,
    }
}

choice! {
    /// How the texture lies on a surface.
    pub enum Mapping {
        /// Projected along the object's own axes.
        #[default]
        Triplanar,
        /// By texture coordinates; without any, triplanar.
        Uv,
    }
}

impl Default for Halftone {
    fn default() -> Self {
        Self {
            texture: Texture::default(),
            image: None,
            space: Space::default(),
            mapping: Mapping::default(),
            scale: 8.0,
            angle: 0.0,
            smoothness: 1.0,
            ink: Color([24, 22, 28]),
            ink_tint: 0.0,
            paper: Color([250, 248, 242]),
            paper_tint: 0.0,
            ambient: 0.1,
            object_tone: 0.3,
            black: 0.0,
            white: 1.0,
            gamma: 1.0,
        }
    }
}

impl Halftone {
    /// The image of the texture, if it is one.
    pub fn texture_image(&self) -> Option<&Path> {
        self.image.as_deref().filter(|_| self.texture == Texture::Image)
    }

    // Long, as it is a list: one entry per parameter.
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.choice("texture", "Texture", "What the ink looks like.", &mut self.texture);
        list.when("halftone.texture", Texture::Image, |list| {
            list.file(
                "image",
                "Image",
                "A tile that repeats: ink comes first where it is dark. It is fitted into a square.",
                &mut self.image,
            );
        });
        list.choice(
            "space",
            "Fixed to",
            "Whether the ink lies on the objects or on the picture.",
            &mut self.space,
        );
        list.when("halftone.space", Space::Surface, |list| {
            list.choice(
                "mapping",
                "Mapping",
                "How the ink lies on a surface; meshes without texture coordinates are always triplanar.",
                &mut self.mapping,
            );
        });
        list.wide_number(
            "scale",
            "Scale",
            "px",
            4.0..=40.0,
            1.0..=200.0,
            "Distance between dots or lines; on a surface between this and the double, whatever the distance.",
            &mut self.scale,
        );
        list.wide_number(
            "angle",
            "Angle",
            "°",
            -90.0..=90.0,
            -180.0..=180.0,
            "By how much the texture is turned.",
            &mut self.angle,
        );
        list.wide_number(
            "smoothness",
            "Smoothness",
            "px",
            0.5..=4.0,
            0.25..=8.0,
            "Width of the soft rim of ink in pixels of the picture; 1 is as sharp as pixels allow.",
            &mut self.smoothness,
        );
        list.color("ink", "Ink", "Color of the ink.", &mut self.ink);
        list.share("ink_tint", "Ink tint", "Share of the object's own color in the ink.", &mut self.ink_tint);
        list.color("paper", "Paper", "Color between the ink.", &mut self.paper);
        list.share(
            "paper_tint",
            "Paper tint",
            "How far the paper is multiplied by the object's own color.",
            &mut self.paper_tint,
        );
        list.share("ambient", "Ambient", "Light that reaches every point, lit or not.", &mut self.ambient);
        list.share(
            "object_tone",
            "Object tone",
            "How far the object's own color darkens: 0 draws all as if white.",
            &mut self.object_tone,
        );
        list.formerly("own_tone");
        list.share("black", "Black point", "Light at and below which all is ink.", &mut self.black);
        list.wide_number(
            "white",
            "White point",
            "",
            0.2..=1.5,
            0.0..=2.0,
            "Light at and above which there is no ink.",
            &mut self.white,
        );
        list.wide_number(
            "gamma",
            "Gamma",
            "",
            0.4..=2.5,
            0.2..=5.0,
            "Exponent of the tones between black and white point: less is lighter.",
            &mut self.gamma,
        );
    }
}
