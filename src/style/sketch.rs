//! Sketchy drawings: lines and colors that wander, are drawn over again and rubbed onto rough paper (Nienhaus and Döllner,
//! "Sketchy Drawings", 2004). Any surface technique can be drawn so; it is the paper's shade map.

use std::path::PathBuf;

use super::param::{Params, StyleField};
use super::slot::choice;
use super::{Color, Matrix};

/// Most times that lines are drawn over each other.
pub const MOST_PASSES: usize = 8;

/// Greatest number of a matrix, reference pixels.
pub const MOST_OFFSET: f32 = 32.0;

/// How surfaces and lines are moved and rubbed on as by hand.
///
/// Offsets come from noise whose mean square is 1, multiplied by a matrix: its numbers are reference pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Sketch {
    /// Whether they are.
    pub enabled: bool,
    /// Where everything goes.
    pub wander: Wander,
    /// How often lines are drawn.
    pub passes: u32,
    /// How lines are drawn each time.
    pub pass: [Pass; MOST_PASSES],
    /// How surfaces are filled.
    pub fill: Fill,
    /// What rough paper makes of it.
    pub grain: Grain,
    /// Straight edges as an architect draws them.
    pub strokes: Strokes,
}

/// Where lines and colors go: what all passes and the fill have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wander {
    /// Factor of all offsets.
    pub amount: f32,
    /// What the noise follows.
    pub anchor: Anchor,
    /// Where values beyond the outline come from, unless the noise follows the picture.
    pub exterior: Exterior,
    /// How far surfaces are enlarged for [`Exterior::Enlarged`], reference pixels; at least the largest offset.
    pub enlarge: f32,
    /// What the noise is like.
    pub noise: Noise,
    /// Length of a wave of the lines, reference pixels.
    pub wave: f32,
    /// Share of a finer wave, a quarter as long.
    pub detail: f32,
    /// How many waves, each half as long as the one before, are added where the noise follows the picture.
    pub octaves: u32,
    /// Number of the noise.
    pub seed: u32,
    /// Whether each object has noise of its own, so that equal objects differ.
    pub by_object: bool,
    /// How the depth of what is drawn is found.
    pub depth: SketchDepth,
    /// How much paler lines and colors are in places.
    pub pressure: f32,
    /// How often the picture is drawn anew, times per second; 0: never.
    pub boil: f32,
}

/// How lines are drawn one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pass {
    /// From noise to offsets, reference pixels.
    pub matrix: Matrix,
    /// Color; `None`: that of the lines.
    pub color: Option<Color>,
    /// Width as a share of the lines'.
    pub width: f32,
    /// Opacity as a share of the lines'.
    pub density: f32,
    /// Number of its noise.
    pub seed: u32,
}

/// How surfaces are filled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fill {
    /// Whether they are; otherwise they are paper.
    pub show: bool,
    /// From noise to offsets, reference pixels.
    pub matrix: Matrix,
    /// Length of a wave, reference pixels.
    pub wave: f32,
    /// Opacity of the pigment.
    pub density: f32,
    /// What is rubbed on more densely.
    pub tone: Tone,
    /// Color of the pigment.
    pub color: Color,
    /// Share of the surface's own color in it.
    pub surface_color: f32,
    /// How visible the strokes of the hand are.
    pub strokes: f32,
    /// Width of a stroke, reference pixels.
    pub stroke_width: f32,
    /// Direction of the strokes, degrees.
    pub angle: f32,
}

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

/// Straight edges as strokes of a hand that has practiced them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strokes {
    /// Whether straight edges are drawn so.
    pub enabled: bool,
    /// How often each is drawn.
    pub times: u32,
    /// How far they go on beyond their ends, reference pixels.
    pub overshoot: f32,
    /// How far their ends are off, reference pixels.
    pub shift: f32,
    /// How bowed they are, percent of their length.
    pub bow: f32,
    /// How the hand trembles, reference pixels.
    pub tremor: f32,
}

choice! {
    /// What the noise follows.
    pub enum Anchor {
        /// The picture: lines swim when the model turns.
        Screen,
        /// Places on the surface.
        #[default]
        Surface,
        /// Directions of the surface: what faces alike is off alike.
        Normal,
        /// Places on the surface, more where it is curved.
        Curvature,
        /// Places on the surface, more where it is far.
        Depth,
    }
}

choice! {
    /// Where values beyond the outline come from.
    pub enum Exterior {
        /// From the nearest line or surface.
        #[default]
        Nearest,
        /// From surfaces that are enlarged along their normals.
        Enlarged,
    }
}

choice! {
    /// What the noise is like.
    pub enum Noise {
        /// Smooth waves.
        #[default]
        Smooth,
        /// Sums of absolute values, with kinks.
        Turbulence,
    }
}

choice! {
    /// How the depth of what is drawn is found.
    pub enum SketchDepth {
        /// Ink and color have one each.
        #[default]
        Separate,
        /// They have the nearer of both.
        Nearer,
    }
}

choice! {
    /// What is rubbed on more densely.
    pub enum Tone {
        /// Nothing: all of the surface alike.
        #[default]
        Flat,
        /// What is dark.
        Darkness,
    }
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

impl Default for Sketch {
    fn default() -> Self {
        Self {
            enabled: false,
            wander: Wander::default(),
            passes: 1,
            pass: std::array::from_fn(|number| Pass {
                // Neither of them moves like another one.
                matrix: match number {
                    0 => Matrix([[1.5, 0.3], [-0.3, 1.5]]),
                    n if n % 2 == 1 => Matrix([[-0.5, 2.5], [-2.5, -0.5]]),
                    _ => Matrix([[2.0, -1.5], [1.5, 2.0]]),
                },
                color: None,
                width: 1.0,
                density: if number == 0 { 1.0 } else { 0.55 },
                seed: number as u32 + 1,
            }),
            fill: Fill::default(),
            grain: Grain::default(),
            strokes: Strokes::default(),
        }
    }
}

impl Default for Wander {
    fn default() -> Self {
        Self {
            amount: 1.0,
            anchor: Anchor::default(),
            exterior: Exterior::default(),
            enlarge: 16.0,
            noise: Noise::default(),
            wave: 140.0,
            detail: 0.2,
            octaves: 4,
            seed: 1,
            by_object: true,
            depth: SketchDepth::default(),
            pressure: 0.0,
            boil: 0.0,
        }
    }
}

impl Default for Fill {
    fn default() -> Self {
        Self {
            show: true,
            matrix: Matrix([[1.5, -5.0], [5.0, 1.5]]),
            wave: 240.0,
            density: 1.0,
            tone: Tone::default(),
            color: Color([40, 40, 44]),
            surface_color: 1.0,
            strokes: 0.0,
            stroke_width: 7.0,
            angle: -40.0,
        }
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

impl Default for Strokes {
    fn default() -> Self {
        Self { enabled: false, times: 2, overshoot: 14.0, shift: 1.6, bow: 0.6, tremor: 0.55 }
    }
}

/// Keys of what others depend on.
const ENABLED: &str = "sketch.enabled";
const ANCHOR: &str = "sketch.anchor";

/// Whole numbers as they are written, from 1 on.
const COUNTS: [&str; MOST_PASSES] = ["1", "2", "3", "4", "5", "6", "7", "8"];

impl Sketch {
    /// The image of the paper, if it is one.
    pub fn tooth_image(&self) -> Option<&std::path::Path> {
        let is_asked = self.enabled && self.grain.amount > 0.0 && self.grain.texture == Tooth::Image;
        self.grain.image.as_deref().filter(|_| is_asked)
    }

    /// `ink`: the color that lines have without one of their pass.
    pub(super) fn params<'a>(&'a mut self, ink: Color, list: &mut Params<'a>) {
        let Self { enabled, wander, passes, pass, fill, grain, strokes } = self;
        list.head("enabled", "Sketch", "Drawn as by hand: lines and colors wander.", enabled);
        list.when(ENABLED, "true", |list| {
            wander.params(list);
            list.integer(
                "passes",
                "Passes",
                "",
                1..=MOST_PASSES as u32,
                "How often lines are drawn over each other.",
                passes,
            );
            for (number, pass) in pass.iter_mut().enumerate() {
                let name = format!("pass{}", number + 1);
                if number == 0 {
                    list.section(&name, |list| pass.params(ink, list));
                } else {
                    list.when_any("sketch.passes", COUNTS.into_iter().skip(number), |list| {
                        list.detail(&name, |list| pass.params(ink, list));
                    });
                }
            }
            list.section("fill", |list| fill.params(list));
            list.section("grain", |list| grain.params(list));
            list.section("strokes", |list| strokes.params(list));
        });
    }
}

impl Wander {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.wide_number(
            "amount",
            "Amount",
            "",
            0.0..=2.0,
            0.0..=4.0,
            "Factor of all offsets; 0 draws everything in its place.",
            &mut self.amount,
        );
        list.choice(
            "anchor",
            "Anchored to",
            "What offsets belong to: the picture (lines swim when the model turns), the places or directions of surfaces, or \
             places with more where they are curved or far.",
            &mut self.anchor,
        );
        list.choice("noise", "Noise", "Smooth waves, or turbulence, which has kinks.", &mut self.noise);
        wave_param(list, &mut self.wave);
        list.when(ANCHOR, Anchor::Screen, |list| {
            list.integer(
                "octaves",
                "Octaves",
                "",
                1..=8,
                "How many waves are added, each half as long as the one before.",
                &mut self.octaves,
            );
        });
        list.when_any(ANCHOR, [Anchor::Surface, Anchor::Normal, Anchor::Curvature, Anchor::Depth], |list| {
            list.share("detail", "Detail", "Share of a wave a quarter as long.", &mut self.detail);
            list.switch(
                "by_object",
                "Vary by object",
                "Each object wanders by itself, so that equal ones differ.",
                &mut self.by_object,
            );
            list.choice(
                "exterior",
                "Beyond outlines",
                "Whose offsets hold beyond an outline: those of the nearest line or surface, or of surfaces that are enlarged.",
                &mut self.exterior,
            );
            list.when("sketch.exterior", Exterior::Enlarged, |list| {
                list.wide_number(
                    "enlarge",
                    "Enlargement",
                    "px",
                    0.0..=32.0,
                    0.0..=64.0,
                    "How far surfaces are enlarged along their normals; never less than the largest offset.",
                    &mut self.enlarge,
                );
            });
        });
        list.integer("seed", "Seed", "", 0..=9999, "Another number, another drawing.", &mut self.seed);
        list.choice(
            "depth",
            "Depth",
            "Whether ink and color are hidden each by its own depth, or both by the nearer of the two.",
            &mut self.depth,
        );
        list.share(
            "pressure",
            "Pressure",
            "How much lines and colors lose of their opacity in places, as where a hand presses less.",
            &mut self.pressure,
        );
        list.wide_number(
            "boil",
            "Boil",
            "/s",
            0.0..=12.0,
            0.0..=24.0,
            "Drawn anew so often per second, as animators do; 0 stands still.",
            &mut self.boil,
        );
    }
}

fn wave_param<'a>(list: &mut Params<'a>, wave: &'a mut f32) {
    list.wide_number(
        "wave",
        "Wavelength",
        "px",
        40.0..=400.0,
        8.0..=1000.0,
        "Length of a wave; offsets greater than a fiftieth of it look like jelly.",
        wave,
    );
}

impl Pass {
    fn params<'a>(&'a mut self, ink: Color, list: &mut Params<'a>) {
        list.matrix(
            "matrix",
            "Offsets",
            "px",
            MOST_OFFSET,
            "How far lines go: each row times two noises, whose mean square is 1, is an offset, to the right and down.",
            &mut self.matrix,
        );
        list.color(
            "color",
            "Color",
            "Color of the lines in this pass.",
            StyleField::Inheriting {
                own: &mut self.color,
                inherited: ink,
                from: "edges.profile.color".to_owned(),
            },
        );
        list.wide_number(
            "width",
            "Width",
            "",
            0.25..=2.0,
            0.1..=4.0,
            "Width as a share of the lines' own.",
            &mut self.width,
        );
        list.share("density", "Opacity", "Opacity as a share of the lines' own.", &mut self.density);
        list.integer("seed", "Seed", "", 0..=9999, "Number of its noise.", &mut self.seed);
    }
}

impl Fill {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.head("show", "Fill", "Surfaces are filled; otherwise they are paper.", &mut self.show);
        list.when("sketch.fill.show", "true", |list| {
            list.matrix(
                "matrix",
                "Offsets",
                "px",
                MOST_OFFSET,
                "How far color goes: each row times two noises, whose mean square is 1, is an offset, to the right and down.",
                &mut self.matrix,
            );
            wave_param(list, &mut self.wave);
            list.share("density", "Opacity", "Opacity of the pigment.", &mut self.density);
            list.choice(
                "tone",
                "Tone",
                "Whether all of a surface is filled alike, or the more the darker it is.",
                &mut self.tone,
            );
            list.color("color", "Pigment", "Color of the pigment.", &mut self.color);
            list.share(
                "surface_color",
                "Surface color",
                "Share of the surface's own color in the pigment.",
                &mut self.surface_color,
            );
            list.share("strokes", "Strokes", "How visible the strokes of the hand are.", &mut self.strokes);
            list.wide_number(
                "stroke_width",
                "Stroke width",
                "px",
                2.0..=24.0,
                1.0..=64.0,
                "Width of a stroke of the hand.",
                &mut self.stroke_width,
            );
            list.wide_number(
                "angle",
                "Angle",
                "°",
                -90.0..=90.0,
                -180.0..=180.0,
                "Direction of the strokes.",
                &mut self.angle,
            );
        });
    }
}

impl Grain {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
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

impl Strokes {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.head(
            "enabled",
            "Straight strokes",
            "Straight edges as an architect draws them.",
            &mut self.enabled,
        );
        list.when("sketch.strokes.enabled", "true", |list| {
            list.integer("times", "Repetitions", "", 1..=4, "How often each edge is drawn.", &mut self.times);
            list.wide_number(
                "overshoot",
                "Overshoot",
                "px",
                0.0..=40.0,
                0.0..=64.0,
                "How far strokes go on beyond corners at most.",
                &mut self.overshoot,
            );
            list.wide_number(
                "shift",
                "End offset",
                "px",
                0.0..=6.0,
                0.0..=16.0,
                "How far the ends of strokes are from those of edges.",
                &mut self.shift,
            );
            list.wide_number(
                "bow",
                "Bow",
                "%",
                0.0..=3.0,
                0.0..=10.0,
                "How far strokes are bowed, of their length.",
                &mut self.bow,
            );
            list.wide_number(
                "tremor",
                "Tremor",
                "px",
                0.0..=2.0,
                0.0..=8.0,
                "How the hand trembles.",
                &mut self.tremor,
            );
        });
    }
}
