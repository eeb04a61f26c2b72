//! What rough paper makes of a sketch.

use std::path::PathBuf;

use crate::style::param::Params;
use crate::style::slot::choice;

/// What rough paper makes of ink and pigment.
#[derive(Debug, Clone, PartialEq)]
pub struct Grain {
    /// How much of it is seen.
    pub amount: f32,
    /// How soft the grains are.
    pub soft: f32,
    /// Their size, reference pixels.
    pub size: f32,
    /// What the paper is.
    pub texture: Tooth,
    /// The image of [`Tooth::Image`], bright where it takes pigment first.
    pub image: Option<PathBuf>,
    /// How far single grains are off, reference pixels.
    pub roughness: f32,
    /// How much lines are smudged inwards.
    pub smudge: f32,
}

choice! {
    /// What the paper is.
    pub enum Tooth {
        /// Made of noise.
        #[default]
        Generated,
        /// An image.
        Image,
    }
}

impl Default for Grain {
    fn default() -> Self {
        Self {
            amount: 0.0,
            soft: 0.35,
            size: 2.5,
            texture: Tooth::default(),
            image: None,
            roughness: 0.0,
            smudge: 0.0,
        }
    }
}

impl Grain {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.share("amount", "Grain", "How much of the paper's tooth is seen.", &mut self.amount);
        list.wide_number("size", "Size", "px", 1.0..=8.0, 0.5..=32.0, "Size of the grains.", &mut self.size);
        list.wide_number(
            "soft",
            "Softness",
            "",
            0.1..=0.49,
            0.02..=0.49,
            "How soft grains are; hard ones look like salt and pepper.",
            &mut self.soft,
        );
        list.choice("texture", "Paper", "What the tooth of the paper is.", &mut self.texture);
        list.when("sketch.grain.texture", Tooth::Image, |list| {
            list.file(
                "image",
                "Image",
                "A tile that repeats: bright places take pigment first.",
                &mut self.image,
            );
        });
        list.wide_number(
            "roughness",
            "Roughness",
            "px",
            0.0..=2.0,
            0.0..=8.0,
            "How far single grains are off, as of chalk.",
            &mut self.roughness,
        );
        list.share("smudge", "Smudge", "How much lines are smudged inwards.", &mut self.smudge);
    }
}
