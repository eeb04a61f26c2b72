//! Glyphs: boxes, arrows and labels that point something out among the objects of a drawing (Nienhaus and Döllner,
//! *Blueprints*, 2004, section 5.2).

mod file;
mod label;
mod shapes;

use glam::DVec3;
use std::sync::LazyLock;

use super::Document;
use crate::geometry::Heads;
use crate::style::param::{Param, Params};
use crate::style::{Color, Style, Technique, choice};

pub use file::Unreadable;
pub(super) use file::{from_tables, to_tables};
pub use shapes::Shapes;

/// What the paths of glyphs begin with; those of files' nodes begin with `/`. Style and roles of a glyph are those of the
/// node of this path in [`Document::nodes`].
pub const FOLDER: &str = "glyphs/";

/// A glyph.
#[derive(Debug, Clone, PartialEq)]
pub struct Glyph {
    /// Unique among glyphs, without `/`.
    pub name: String,
    /// Color of all of it.
    pub color: Color,
    /// What it is.
    pub shape: Shape,
}

/// What a glyph is. Points are in the files' coordinates.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A box around a node and all that hangs below it.
    Box(BoxAround),
    /// A line with arrow heads; one of two points is an arrow.
    Path(ArrowPath),
    /// Text that faces the eye.
    Label(Label),
}

/// See [`Shape::Box`].
#[derive(Debug, Clone, PartialEq)]
pub struct BoxAround {
    /// Path of the node.
    pub node: String,
    /// Beams along the edges instead of faces.
    pub frame: bool,
    /// Width of the beams and twice the distance from the node, in percent of the model's diagonal.
    pub thickness: f32,
}

/// See [`Shape::Path`].
#[derive(Debug, Clone, PartialEq)]
pub struct ArrowPath {
    /// Its corners, two at least.
    pub points: Vec<DVec3>,
    /// Where arrow heads are.
    pub heads: HeadsAt,
    /// Diameter of the line, in percent of the model's diagonal.
    pub thickness: f32,
}

/// See [`Shape::Label`].
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// What is written; may have several lines.
    pub text: String,
    /// What it names.
    pub anchor: Anchor,
    /// Size of the letters, in the unit of [`Self::unit`].
    pub size: f32,
    /// What the size is measured in.
    pub unit: LetterUnit,
    /// From the anchor to the text, right and up, in sizes of its letters.
    pub offset: [f32; 2],
    /// Whether nothing hides it.
    pub in_front: bool,
    /// Whether paper lies behind the letters.
    pub plate: bool,
}

/// What a label names.
#[derive(Debug, Clone, PartialEq)]
pub enum Anchor {
    /// A point.
    Point(DVec3),
    /// The middle of a node and all that hangs below it.
    Node(String),
}

choice! {
    /// Which ends of a path have arrow heads.
    pub enum HeadsAt {
        /// None.
        None,
        /// The last point.
        #[default]
        End,
        /// The first and the last point.
        Both,
        /// The last point, and the middle of each long segment.
        Along,
    }
}

choice! {
    /// What sizes of letters are measured in.
    pub enum LetterUnit {
        /// Reference pixels, 1/1080 of the picture's height: equal for every camera.
        #[default]
        Pixel,
        /// Per mille of the model's diagonal: letters are part of the scene.
        Model,
    }
}

impl From<HeadsAt> for Heads {
    fn from(at: HeadsAt) -> Self {
        Self { at_start: at == HeadsAt::Both, at_end: at != HeadsAt::None, along: at == HeadsAt::Along }
    }
}

impl Shape {
    /// A box of the usual look.
    pub fn around(node: String) -> Self {
        Self::Box(BoxAround { node, frame: false, thickness: 0.4 })
    }

    /// A path of the usual look.
    pub fn path(points: Vec<DVec3>) -> Self {
        Self::Path(ArrowPath { points, heads: HeadsAt::default(), thickness: 0.6 })
    }

    /// A label of the usual look.
    pub fn label(text: String, anchor: Anchor) -> Self {
        let offset = [2.0, 2.0];
        Self::Label(Label {
            text,
            anchor,
            size: 28.0,
            unit: LetterUnit::default(),
            offset,
            in_front: true,
            plate: true,
        })
    }

    /// The same thing in its usual look; without text.
    #[must_use]
    pub fn usual(&self) -> Self {
        match self {
            Self::Box(shape) => Self::around(shape.node.clone()),
            Self::Path(shape) => Self::path(shape.points.clone()),
            Self::Label(shape) => Self::label(String::new(), shape.anchor.clone()),
        }
    }

    /// What stands in files and names of new glyphs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Box(_) => "box",
            Self::Path(path) if path.points.len() == 2 => "arrow",
            Self::Path(_) => "path",
            Self::Label(_) => "label",
        }
    }
}

impl Glyph {
    /// A glyph in the usual color.
    pub fn new(name: String, shape: Shape) -> Self {
        Self { name, color: Color([200, 32, 30]), shape }
    }

    /// The path under which its style and roles stand.
    pub fn path(&self) -> String {
        format!("{FOLDER}{}", self.name)
    }

    /// Its parameters, like [`Style::params`].
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
        let Self { color, shape, .. } = self;
        list.section("glyph", |list| {
            list.color("color", "Color", "Color of the whole glyph.", color);
            match shape {
                Shape::Box(shape) => {
                    thickness(list, &mut shape.thickness);
                    list.switch(
                        "frame",
                        "Frame",
                        "Beams along the edges instead of faces.",
                        &mut shape.frame,
                    );
                }
                Shape::Path(shape) => {
                    thickness(list, &mut shape.thickness);
                    list.choice("heads", "Arrow heads", "Where the path has arrow heads.", &mut shape.heads);
                }
                Shape::Label(shape) => label(list, shape),
            }
        });
    }
}

fn thickness<'a>(list: &mut Params<'a>, value: &'a mut f32) {
    let help = "How thick it is, in percent of the model's diagonal.";
    list.wide_number("thickness", "Thickness", "%", 0.1..=3.0, 0.01..=50.0, help, value);
}

fn label<'a>(list: &mut Params<'a>, label: &'a mut Label) {
    let help = "Size of the letters, in the unit below.";
    list.wide_number("size", "Size", "", 8.0..=120.0, 0.1..=2000.0, help, &mut label.size);
    let help = "Pixels of a picture 1080 pixels high, or per mille of the model's diagonal.";
    list.choice("unit", "Unit of size", help, &mut label.unit);
    let [right, up] = &mut label.offset;
    let help =
        "From the point to the text, in sizes of the letters; 0 for both is on the point, without a line.";
    list.wide_number("right", "To the right", "", -8.0..=8.0, -1000.0..=1000.0, help, right);
    list.wide_number("up", "Up", "", -8.0..=8.0, -1000.0..=1000.0, help, up);
    list.switch("in_front", "In front", "Nothing hides the label.", &mut label.in_front);
    list.switch("plate", "Plate", "Paper behind the letters.", &mut label.plate);
}

/// The style of glyphs that have none of their own: their color alone, with lines of a darker one.
pub(super) fn base_style() -> &'static Style {
    static STYLE: LazyLock<Style> = LazyLock::new(|| {
        let mut style = Style { technique: Technique::Unlit, ..Style::default() };
        style.edges.object_color = 1.0;
        style.edges.darken = 0.5;
        style
    });
    &STYLE
}

impl Document {
    /// Adds a glyph; its name becomes one that no other has. Returns its number.
    pub fn add_glyph(&mut self, mut glyph: Glyph) -> usize {
        glyph.name = self.free_glyph_name(&glyph.name);
        self.glyphs.push(glyph);
        self.glyphs.len() - 1
    }

    /// Gives a glyph another name, or one like it that no other has; style and roles go along.
    pub fn rename_glyph(&mut self, index: usize, name: &str) {
        let Some(before) = self.glyphs.get(index).map(|g| (g.name.clone(), g.path())) else { return };
        if before.0 == name {
            return;
        }
        let name = self.free_glyph_name(name);
        let settings = self.nodes.remove(&before.1);
        if let Some(glyph) = self.glyphs.get_mut(index) {
            glyph.name = name;
            self.nodes.extend(settings.map(|settings| (glyph.path(), settings)));
        }
    }

    /// Removes a glyph with its style and roles.
    pub fn remove_glyph(&mut self, index: usize) {
        if index < self.glyphs.len() {
            let glyph = self.glyphs.remove(index);
            self.nodes.remove(&glyph.path());
        }
    }

    fn free_glyph_name(&self, wanted: &str) -> String {
        let wanted = wanted.trim().replace('/', "-");
        let wanted = if wanted.is_empty() { "glyph".to_owned() } else { wanted };
        let is_free = |name: &String| self.glyphs.iter().all(|g| g.name != *name);
        let numbered = (2..).map(|number| format!("{wanted}.{number}"));
        std::iter::once(wanted.clone()).chain(numbered).find(is_free).unwrap_or(wanted)
    }
}
