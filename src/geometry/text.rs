//! Text as flat triangles: letters are shapes like any others, sharp at every size.

use std::fmt::Write as _;

use glam::{Vec2, Vec3};
use lyon_tessellation::geom::{Point, point};
use lyon_tessellation::path::Path;
use lyon_tessellation::path::path::Builder;
use lyon_tessellation::{BuffersBuilder, FillOptions, FillRule, FillTessellator, FillVertex, VertexBuffers};
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, MetadataProvider as _};

use super::Mesh;
use super::primitives::from_triangles;

/// The font: Hack, under the MIT and the Bitstream Vera license, which egui brings along.
const FONT: &[u8] = epaint_default_fonts::HACK_REGULAR;

/// Greatest distance between a letter's curve and its triangles, em: a pixel of letters 4000 pixels high.
const TOLERANCE: f32 = 0.000_25;

/// From line to line, em.
const LEADING: f32 = 1.25;

/// Letters after these are left out: nobody reads them.
pub const MAX_LETTERS: usize = 1000;

/// Laid out text. Lengths are in em, the size of the letters; x runs right, y up, the first line stands on y = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// The ink, in the plane z = 0, facing +z, with material 0. Empty where nothing is to be seen.
    pub mesh: Mesh,
    /// Left end and underside of the last line.
    pub min: Vec2,
    /// Right end of the longest line and top of the first one's capitals.
    pub max: Vec2,
    /// What the font has no letters for, each once; boxes stand in their place.
    pub missing: Vec<char>,
    /// Whether letters beyond [`MAX_LETTERS`] were left out.
    pub is_truncated: bool,
}

impl Text {
    /// Lays out lines of text, from left to right, each beginning at x = 0.
    pub fn new(text: &str) -> Self {
        let mut laid = Self {
            mesh: Mesh::default(),
            min: Vec2::ZERO,
            max: Vec2::ZERO,
            missing: Vec::new(),
            is_truncated: text.chars().nth(MAX_LETTERS).is_some(),
        };
        // The font is part of the program.
        let Ok(font) = FontRef::new(FONT) else { return laid };
        let (unscaled, location) = (Size::unscaled(), LocationRef::default());
        let metrics = font.metrics(unscaled, location);
        let em = 1.0 / f32::from(metrics.units_per_em.max(1));
        let (letters, advances) = (font.outline_glyphs(), font.glyph_metrics(unscaled, location));
        laid.max.y = metrics.cap_height.unwrap_or(metrics.ascent) * em;
        let mut pen = Pen { path: Path::builder(), at: Vec2::ZERO, em, is_open: false };
        for letter in text.chars().take(MAX_LETTERS) {
            if letter == '\n' {
                pen.at = Vec2::new(0.0, pen.at.y - LEADING);
                continue;
            }
            let letter = if letter.is_whitespace() { ' ' } else { letter };
            let known = font.charmap().map(letter).filter(|_| !letter.is_control());
            if known.is_none() && !laid.missing.contains(&letter) {
                laid.missing.push(letter);
            }
            let id = known.unwrap_or_default();
            if let Some(outline) = letters.get(id) {
                // A letter that cannot be drawn is a gap.
                let _ = outline.draw(DrawSettings::unhinted(unscaled, location), &mut pen);
            }
            pen.at.x += advances.advance_width(id).unwrap_or(0.0) * em;
            laid.max.x = laid.max.x.max(pen.at.x);
        }
        laid.min.y = pen.at.y + metrics.descent * em;
        laid.mesh = filled(&pen.path.build());
        laid
    }

    /// What a person should know about letters that are not there; `None` if all are.
    pub fn fault(&self) -> Option<String> {
        let mut fault = String::new();
        if !self.missing.is_empty() {
            let missing: String = self.missing.iter().take(8).flat_map(|c| c.escape_debug()).collect();
            let more = if self.missing.len() > 8 { "…" } else { "" };
            fault = format!("the font has no `{missing}`{more}; boxes are drawn instead");
        }
        if self.is_truncated {
            let and = if fault.is_empty() { "" } else { "; " };
            // Writing into a string cannot fail.
            let _ = write!(fault, "{and}only its first {MAX_LETTERS} letters are drawn");
        }
        (!fault.is_empty()).then_some(fault)
    }
}

/// The triangles within an outline.
fn filled(path: &Path) -> Mesh {
    let mut buffers: VertexBuffers<Vec3, u32> = VertexBuffers::new();
    let options = FillOptions::tolerance(TOLERANCE).with_fill_rule(FillRule::NonZero);
    let vertex = |vertex: FillVertex<'_>| Vec3::new(vertex.position().x, vertex.position().y, 0.0);
    let result = FillTessellator::new().tessellate_path(
        path,
        &options,
        &mut BuffersBuilder::new(&mut buffers, vertex),
    );
    if result.is_err() || buffers.indices.is_empty() {
        return Mesh::default();
    }
    let VertexBuffers { vertices, mut indices } = buffers;
    for triangle in indices.as_chunks_mut::<3>().0 {
        let [a, b, c] = triangle.map(|v| vertices.get(v as usize).copied().unwrap_or_default());
        if (b - a).cross(c - a).z < 0.0 {
            triangle.swap(1, 2);
        }
    }
    from_triangles(vertices, indices)
}

/// Collects the outlines of letters.
struct Pen {
    path: Builder,
    at: Vec2,
    em: f32,
    is_open: bool,
}

impl Pen {
    fn point(&self, x: f32, y: f32) -> Point<f32> {
        point(self.at.x + x * self.em, self.at.y + y * self.em)
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.close();
        self.path.begin(self.point(x, y));
        self.is_open = true;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.point(x, y));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.path.quadratic_bezier_to(self.point(cx, cy), self.point(x, y));
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        self.path.cubic_bezier_to(self.point(ax, ay), self.point(bx, by), self.point(x, y));
    }

    fn close(&mut self) {
        if std::mem::take(&mut self.is_open) {
            self.path.end(true);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Area of the ink, square em.
    fn area(text: &Text) -> f32 {
        let mesh = &text.mesh;
        mesh.triangles().iter().map(|t| mesh.corners(*t)).map(|[a, b, c]| (b - a).cross(c - a).z * 0.5).sum()
    }

    /// How many contours of a text's letters wind about a point: what the ink must cover, by the outlines alone.
    fn winding(text: &str, at: Vec2) -> i32 {
        struct Crossings(Vec2, Vec2, Vec2, i32, f32);
        impl Crossings {
            fn segment(&mut self, to: Vec2) {
                let (from, at) = (self.1, self.0);
                if (from.y <= at.y) != (to.y <= at.y) {
                    let x = from.x + (at.y - from.y) / (to.y - from.y) * (to.x - from.x);
                    if x > at.x {
                        self.3 += if to.y > from.y { 1 } else { -1 };
                    }
                }
                self.1 = to;
            }
        }
        impl OutlinePen for Crossings {
            fn move_to(&mut self, x: f32, y: f32) {
                (self.1, self.2) = (Vec2::new(x, y), Vec2::new(x, y));
            }
            fn line_to(&mut self, x: f32, y: f32) {
                self.segment(Vec2::new(x, y));
            }
            fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
                let (from, control, to) = (self.1, Vec2::new(cx, cy), Vec2::new(x, y));
                for step in 1..=64 {
                    let t = step as f32 / 64.0;
                    self.segment(from.lerp(control, t).lerp(control.lerp(to, t), t));
                }
            }
            fn curve_to(&mut self, _: f32, _: f32, _: f32, _: f32, _: f32, _: f32) {
                panic!("the font has quadratic curves");
            }
            fn close(&mut self) {
                self.segment(self.2);
            }
        }
        let font = FontRef::new(FONT).unwrap();
        let (unscaled, location) = (Size::unscaled(), LocationRef::default());
        let em = f32::from(font.metrics(unscaled, location).units_per_em);
        let mut seen = Crossings(at * em, Vec2::ZERO, Vec2::ZERO, 0, 0.0);
        for letter in text.chars() {
            let id = font.charmap().map(letter).unwrap();
            let settings = DrawSettings::unhinted(unscaled, location);
            font.outline_glyphs().get(id).unwrap().draw(settings, &mut seen).unwrap();
            let advance = font.glyph_metrics(unscaled, location).advance_width(id).unwrap();
            seen.4 += advance;
            seen.0.x -= advance;
        }
        seen.3
    }

    #[test]
    fn ink_is_where_the_outlines_of_the_letters_say() {
        let text = "Ag8%ß";
        let laid = Text::new(text);
        let mesh = &laid.mesh;
        let covers = |p: Vec2| {
            mesh.triangles().iter().map(|t| mesh.corners(*t).map(|c| c.truncate())).any(|[a, b, c]| {
                let side = |from: Vec2, to: Vec2| (to - from).perp_dot(p - from) >= 0.0;
                side(a, b) && side(b, c) && side(c, a)
            })
        };
        let (mut wrong, mut inked) = (0, 0);
        for step in 0..4000 {
            let share = Vec2::new(step as f32 * 0.618_034, step as f32 * 0.754_877_7).fract();
            let at = laid.min + share * (laid.max - laid.min);
            let expected = winding(text, at) != 0;
            inked += u32::from(expected);
            wrong += u32::from(covers(at) != expected);
        }
        assert!(inked > 600 && wrong <= 4, "{wrong} of 4000 wrong, {inked} with ink");
    }

    #[test]
    fn lines_stand_below_each_other_and_sizes_are_in_em() {
        let (one, two) = (Text::new("Hm"), Text::new("Hm\nHmmm"));
        assert!((one.max.y - 0.73).abs() < 0.03 && one.min.y < 0.0, "{:?}", one.max);
        assert!((two.max.x / one.max.x - 2.0).abs() < 1e-4);
        assert!((two.min.y - one.min.y + LEADING).abs() < 1e-5);
        assert!((area(&two) / area(&one) - 3.0).abs() < 0.5 && area(&one) > 0.1);
    }

    #[test]
    fn what_has_no_letters_is_told_and_boxed() {
        let text = Text::new("a漢漢字");
        assert_eq!(text.missing, ['漢', '字']);
        assert!(area(&text) > area(&Text::new("a")) * 1.5, "boxes have ink");
        assert!(text.fault().unwrap().contains("`漢字`"));
        assert_eq!(Text::new("Größe Ωж°").fault(), None);
        for nothing in ["", " \n\t "] {
            assert_eq!((Text::new(nothing).mesh, Text::new(nothing).fault()), (Mesh::default(), None));
        }
        let long = Text::new(&"x".repeat(10_000));
        assert!(long.is_truncated && long.fault().unwrap().contains("first 1000"));
    }
}
