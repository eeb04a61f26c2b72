//! Sketches whose waves are longer or shorter for a moment than their styles say: the document as it is then.

use std::borrow::Cow;

use super::Document;
use crate::style::Style;
use crate::style::sketch::Anchor;

impl Document {
    /// Whether anything is sketched with waves that lie on its surface, which other ones replace as the camera comes nearer.
    pub fn has_waves_on_surfaces(&self) -> bool {
        self.styles().any(has_waves_on_surfaces)
    }

    /// The document with such waves longer by a factor, above 0.
    pub fn with_wave_scale(&self, factor: f32) -> Cow<'_, Self> {
        if factor == 1.0 || !self.has_waves_on_surfaces() {
            return Cow::Borrowed(self);
        }
        let mut scaled = self.clone();
        for style in scaled.styles_mut().filter(|style| has_waves_on_surfaces(style)) {
            style.sketch.wander.wave_scale = factor;
        }
        Cow::Owned(scaled)
    }
}

fn has_waves_on_surfaces(style: &Style) -> bool {
    let is_on_surface = !matches!(style.sketch.wander.anchor, Anchor::Screen | Anchor::Normal);
    style.sketch.enabled && is_on_surface
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_waves_on_surfaces_are_scaled() {
        let mut document = Document::default();
        assert_eq!(document.with_wave_scale(2.0).as_ref(), &document);
        document.style.sketch.enabled = true;
        assert_eq!(document.with_wave_scale(2.0).style.sketch.wander.wave_scale, 2.0);
        assert_eq!(document.with_wave_scale(1.0).as_ref(), &document);
        document.style.sketch.wander.anchor = Anchor::Screen;
        assert_eq!(document.with_wave_scale(2.0).as_ref(), &document);
    }
}
