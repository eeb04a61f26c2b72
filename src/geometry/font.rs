//! Outlines of text, in the font of the interface (Ubuntu Light, under the Ubuntu Font Licence).

use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider as _};

/// Draws a line of text from the origin to the right, y upwards, and returns its width. `size`: the height of an em. What
/// the font does not have is drawn as its empty box.
pub fn draw_text(text: &str, size: f32, pen: &mut impl OutlinePen) -> f32 {
    let Ok(font) = FontRef::new(epaint_default_fonts::UBUNTU_LIGHT) else { return 0.0 };
    let (letters, outlines) = (font.charmap(), font.outline_glyphs());
    let metrics = font.glyph_metrics(Size::new(size), LocationRef::default());
    let mut x = 0.0;
    for letter in text.chars() {
        let glyph = letters.map(letter).unwrap_or(GlyphId::NOTDEF);
        if let Some(outline) = outlines.get(glyph) {
            let settings = DrawSettings::unhinted(Size::new(size), LocationRef::default());
            // A letter that cannot be drawn leaves a gap.
            let _ = outline.draw(settings, &mut Moved { pen, x });
        }
        x += metrics.advance_width(glyph).unwrap_or(0.0);
    }
    x
}

/// Whether the font has every letter of a text.
pub fn has_letters(text: &str) -> bool {
    FontRef::new(epaint_default_fonts::UBUNTU_LIGHT)
        .is_ok_and(|font| text.chars().all(|letter| font.charmap().map(letter).is_some()))
}

/// A pen that is moved to the right.
struct Moved<'a, P> {
    pen: &'a mut P,
    x: f32,
}

impl<P: OutlinePen> OutlinePen for Moved<'_, P> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.pen.move_to(self.x + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.pen.line_to(self.x + x, y);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.pen.quad_to(self.x + cx, cy, self.x + x, y);
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.pen.curve_to(self.x + cx0, cy0, self.x + cx1, cy1, self.x + x, y);
    }

    fn close(&mut self) {
        self.pen.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The box around all points.
    #[derive(Default)]
    struct Extent(Vec<[f32; 2]>);

    impl OutlinePen for Extent {
        fn move_to(&mut self, x: f32, y: f32) {
            self.0.push([x, y]);
        }
        fn line_to(&mut self, x: f32, y: f32) {
            self.0.push([x, y]);
        }
        fn quad_to(&mut self, _: f32, _: f32, x: f32, y: f32) {
            self.0.push([x, y]);
        }
        fn curve_to(&mut self, _: f32, _: f32, _: f32, _: f32, x: f32, y: f32) {
            self.0.push([x, y]);
        }
        fn close(&mut self) {}
    }

    #[test]
    fn letters_stand_beside_each_other_on_the_base_line() {
        let mut pen = Extent::default();
        let width = draw_text("Hm", 10.0, &mut pen);
        let one = draw_text("H", 10.0, &mut Extent::default());
        assert!(width > 1.5 * one && width < 20.0);
        assert!(pen.0.iter().all(|[x, y]| (0.0..=width).contains(x) && (-0.5..=8.0).contains(y)));
        assert!(pen.0.iter().any(|[x, _]| *x > one), "the second letter lies beyond the first");
        let mut tall = Extent::default();
        assert!((draw_text("Hm", 20.0, &mut tall) - 2.0 * width).abs() < 1e-3);
    }

    #[test]
    fn letters_that_the_font_lacks_are_known() {
        assert!(has_letters("10 m²") && !has_letters("漢"));
        let mut boxes = Extent::default();
        assert!(draw_text("漢", 10.0, &mut boxes) > 0.0);
    }
}
