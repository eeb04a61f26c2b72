//! Looks at what hatching goes by: the same document in other styles.

use std::sync::OnceLock;

use super::{Document, Show};
use crate::style::{Style, Technique, preset};

/// The preset that draws where strokes run.
fn stroke_directions() -> &'static Style {
    static STYLE: OnceLock<Style> = OnceLock::new();
    STYLE.get_or_init(|| preset::load("stroke-directions").map_or_else(|_| Style::default(), |p| p.style))
}

impl Document {
    /// The document that draws what [`Show::StrokeDirections`] or [`Show::Detail`] asks for; `None`: it asks for something else.
    pub fn shown(&self) -> Option<Self> {
        let look: fn(&Style) -> Style = match self.view.show {
            Show::StrokeDirections => directions_of,
            Show::Detail => detail_of,
            _ => return None,
        };
        let mut shown = self.clone();
        shown.view.show = Show::Picture;
        shown.style = look(&self.style);
        for style in shown.nodes.values_mut().filter_map(|node| node.style.as_mut()) {
            *style = look(style);
        }
        Some(shown)
    }
}

/// Lines along the strokes of a style, or where they would be.
fn directions_of(style: &Style) -> Style {
    let mut shown = stroke_directions().clone();
    shown.hatching.direction = style.hatching.direction;
    shown.hatching.stroke.spacing = style.hatching.stroke.spacing;
    shown
}

/// The field by which a style leaves out strokes, black: all of them; white where it leaves out none.
fn detail_of(style: &Style) -> Style {
    let mut shown = style.clone();
    shown.technique = Technique::Hatching;
    if style.technique != Technique::Hatching {
        shown.hatching.indication.amount = 0.0;
    }
    shown.hatching.shows_detail = true;
    shown
}
