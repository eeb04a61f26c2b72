//! Hatching: tones by strokes of a pen that follow the form (Bu et al., "Image-based Real-time Hatching of Scene Traveling", 2006;
//! Praun et al., "Real-Time Hatching", 2001).

use super::indication::Indication;
use super::own_strokes::OwnStrokes;
use super::param::Params;
use super::slot::choice;
use super::{Color, Curve};

/// Parameters of the technique `hatching`.
#[derive(Debug, Clone, PartialEq)]
pub struct Hatching {
    /// How strokes lie on the picture or on the model.
    pub mapping: Mapping,
    /// The strokes of mappings with textures.
    pub set: Set,
    /// What strokes of one's own look like.
    pub own: OwnStrokes,
    /// Strokes in shadows.
    pub shadows: Shadows,
    /// Where strokes run.
    pub direction: Direction,
    /// Strokes turn in steps of so many degrees; 0: smoothly.
    pub turn_step: f32,
    /// Whether the strokes of the two nearest steps are blended.
    pub blend_steps: bool,
    /// Whether tones between those of a set are blends of both; strokes come one by one otherwise.
    pub blend_tones: bool,
    /// Whether strokes on the picture run on across the borders between objects.
    pub cross_objects: bool,
    /// What single strokes are like.
    pub stroke: Stroke,
    /// How strokes make tones.
    pub cross_hatching: CrossHatching,
    /// From light to darkness.
    pub tone: Tone,
    /// Strokes that are left out away from edges.
    pub indication: Indication,
    /// Color of the ink.
    pub ink: Color,
    /// Share of the object's own color in the ink.
    pub ink_tint: f32,
    /// Color between the ink.
    pub paper: Color,
    /// Share of the object's own color on the paper.
    pub paper_tint: f32,
    /// Whether the detail that indication gives is drawn instead of strokes; no parameter, but a view of the document.
    pub shows_detail: bool,
}

/// What single strokes are like.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Least distance between strokes, reference pixels; on a surface up to twice as much.
    pub spacing: f32,
    /// Width of a stroke that just begins, as a share of the spacing.
    pub min_width: f32,
    /// Greatest width, as a share of the spacing.
    pub max_width: f32,
    /// Least length, reference pixels; up to twice as much.
    pub length: f32,
    /// Length of pointed ends, reference pixels; 0: strokes go on and on.
    pub taper: f32,
    /// Half of the gap between the ends of strokes, reference pixels; less than 0: half of how far they pass each other.
    pub gap: f32,
    /// How far strokes come one after the other as it gets darker, instead of all at once getting wider.
    pub tone_by_count: f32,
    /// How much chance decides which come first.
    pub randomness: f32,
    /// How much later the ends of a stroke come than its middle.
    pub pointedness: f32,
    /// How much later a line comes that is inserted between two others.
    pub late_insertion: f32,
    /// How differently lines are delayed that are inserted; 0: all in one place come at once.
    pub insertion_spread: f32,
    /// How much widths vary from stroke to stroke.
    pub variation: f32,
}

/// How strokes make tones.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossHatching {
    /// How many directions cross at most.
    pub directions: u32,
    /// Darkness from which on strokes of a second direction cross those of the first.
    pub second: f32,
    /// The same for a third direction.
    pub third: f32,
    /// Whether strokes of the form run on through shadows that are thrown on it, and others make these.
    pub shadows_cross: bool,
}

/// Strokes where the first light does not reach, for mappings with textures.
#[derive(Debug, Clone, PartialEq)]
pub struct Shadows {
    /// Whether they are others than in the light.
    pub differ: bool,
    /// What they look like.
    pub set: Set,
    /// How far they are turned against those in the light, degrees.
    pub turn: f32,
}

/// From light to darkness.
#[derive(Debug, Clone, PartialEq)]
pub struct Tone {
    /// From light, 0 to 1, to tone, 0 (ink) to 1 (paper).
    pub curve: Curve,
    /// Light that reaches every point from everywhere.
    pub ambient: f32,
    /// How far an object's own color makes its tone darker; 0: not at all, 1: as much as it is dark.
    pub object_tone: f32,
    /// Darkness up to which there is only paper.
    pub lightest: f32,
    /// The greatest darkness.
    pub darkest: f32,
}

choice! {
    /// How strokes lie on the picture or on the model.
    pub enum Mapping {
        /// On the surface: lines that follow the form, always about equally dense.
        #[default]
        Stripes,
        /// On the picture, turned as the surface says.
        ImageSpace,
        /// On the surface, by texture coordinates.
        Uv,
    }
}

choice! {
    /// The strokes of mappings with textures.
    pub enum Set {
        /// Long thin ones.
        #[default]
        Pen,
        /// Soft and a little wavy ones.
        Pencil,
        /// Wedges.
        Woodcut,
        /// Dots.
        Stipple,
        /// Lines that are described by numbers.
        Own,
        /// Copies of a painted one.
        Painted,
    }
}

choice! {
    /// Where strokes run.
    pub enum Direction {
        /// Around what is round, along what is long.
        #[default]
        Curvature,
        /// Along the first texture coordinate.
        TextureU,
        /// Along the second texture coordinate.
        TextureV,
        /// Along the x axis of the model.
        X,
        /// Along its y axis.
        Y,
        /// Along its z axis.
        Z,
        /// Towards the first light; on the paper as long as that moves with the eye.
        Light,
    }
}

/// Paper where light falls, and ink that gathers fast where it does not.
fn paper_in_the_light() -> Curve {
    let points = [[0.0, 0.0], [0.28, 0.02], [0.58, 0.38], [0.76, 0.82], [0.87, 1.0], [1.0, 1.0]];
    Curve::of_points(&points.map(Into::into)).unwrap_or_default()
}

impl Default for Hatching {
    fn default() -> Self {
        Self {
            mapping: Mapping::default(),
            set: Set::default(),
            own: OwnStrokes::default(),
            shadows: Shadows { differ: false, set: Set::Pen, turn: 30.0 },
            direction: Direction::default(),
            turn_step: 15.0,
            blend_steps: false,
            blend_tones: true,
            cross_objects: true,
            stroke: Stroke {
                spacing: 6.0,
                min_width: 0.15,
                max_width: 0.54,
                length: 120.0,
                taper: 22.0,
                gap: -11.0,
                tone_by_count: 0.45,
                randomness: 1.0,
                pointedness: 0.5,
                late_insertion: 0.45,
                insertion_spread: 0.0,
                variation: 0.2,
            },
            cross_hatching: CrossHatching { directions: 3, second: 0.42, third: 0.7, shadows_cross: true },
            tone: Tone {
                curve: paper_in_the_light(),
                ambient: 0.06,
                object_tone: 0.2,
                lightest: 0.1,
                darkest: 0.86,
            },
            indication: Indication::default(),
            ink: Color([24, 22, 28]),
            ink_tint: 0.0,
            paper: Color([252, 250, 244]),
            paper_tint: 0.0,
            shows_detail: false,
        }
    }
}

impl Hatching {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.choice(
            "mapping",
            "Mapping",
            "How strokes lie on the model or on the picture. Where a model has no texture coordinates there are stripes.",
            &mut self.mapping,
        );
        list.former_value("paper", Mapping::ImageSpace);
        list.choice(
            "direction",
            "Direction",
            "Where strokes run; without texture coordinates they follow the curvature instead.",
            &mut self.direction,
        );
        list.when_any("hatching.mapping", ["image_space", "uv"], |list| {
            list.choice("set", "Strokes", "What the strokes look like.", &mut self.set);
        });
        list.when("hatching.mapping", Mapping::ImageSpace, |list| {
            list.wide_number(
                "turn_step",
                "Turning step",
                "°",
                0.0..=45.0,
                0.0..=90.0,
                "Strokes turn in steps of so much, so that neighbors stay parallel; 0: smoothly.",
                &mut self.turn_step,
            );
            list.switch(
                "blend_steps",
                "Blend steps",
                "Strokes of the two nearest steps are blended, so that none is cut off.",
                &mut self.blend_steps,
            );
            list.switch(
                "blend_tones",
                "Blend tones",
                "Tones between two of the strokes' own are blends of both; otherwise, and always in pictures of one sample, strokes come \
                 one by one.",
                &mut self.blend_tones,
            );
            list.switch(
                "cross_objects",
                "Cross objects",
                "Strokes run on from one object to the next where both have the same direction; otherwise they end at the border.",
                &mut self.cross_objects,
            );
        });
        list.color("ink", "Ink", "Color of the ink.", &mut self.ink);
        list.share("ink_tint", "Ink tint", "Share of the object's own color in the ink.", &mut self.ink_tint);
        list.color("paper", "Paper", "Color between the ink.", &mut self.paper);
        list.share(
            "paper_tint",
            "Paper tint",
            "How far the paper is multiplied by the object's own color.",
            &mut self.paper_tint,
        );
        list.section("stroke", |list| self.stroke.params(list));
        list.when_any("hatching.mapping", ["image_space", "uv"], |list| {
            list.when_any("hatching.set", ["own", "painted"], |list| {
                list.section("own", |list| self.own.params(list));
            });
            list.section("shadows", |list| self.shadows.params(list));
        });
        list.section("cross_hatching", |list| self.cross_hatching.params(list));
        list.section("tone", |list| self.tone.params(list));
        list.section("indication", |list| self.indication.params(list));
    }
}

impl Stroke {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.wide_number(
            "spacing",
            "Spacing",
            "px",
            3.0..=20.0,
            2.0..=60.0,
            "Least distance between strokes; on a surface between this and the double, whatever the distance.",
            &mut self.spacing,
        );
        list.when("hatching.mapping", Mapping::Stripes, |list| {
            let number = |list: &mut Params<'a>,
                          key,
                          label,
                          (unit, soft, hard),
                          help,
                          value: &'a mut f32| list.wide_number(key, label, unit, soft, hard, help, value);
            let share = ("", 0.02..=1.0, 0.02..=1.2);
            number(list, "min_width", "Min. width", share.clone(), "Width of a stroke that just begins, as a share of the spacing.", &mut self.min_width);
            list.formerly("thin");
            number(list, "max_width", "Max. width", share, "Width where all is dark, as a share of the spacing.", &mut self.max_width);
            list.formerly("thick");
            let length = ("px", 10.0..=300.0, 5.0..=1000.0);
            number(list, "length", "Length", length, "Least length of strokes; up to twice as much.", &mut self.length);
            let taper = ("px", 0.0..=40.0, 0.0..=100.0);
            number(list, "taper", "Taper length", taper, "Length of the ends that run out; 0: strokes go on and on.", &mut self.taper);
            let gap = ("px", -25.0..=8.0, -50.0..=20.0);
            number(list, "gap", "Gap", gap, "Half of the gap between the ends of two strokes; less than 0: half of how far they pass each other. At minus half of the taper length tones are the most even.", &mut self.gap);
            let unit = ("", 0.0..=1.0, 0.0..=1.0);
            number(list, "tone_by_count", "Tone by count", unit.clone(), "0: all strokes get wider where it is dark, as an engraver's; 1: more and more come, as of a pen.", &mut self.tone_by_count);
            list.formerly("spread");
            number(list, "randomness", "Randomness", unit.clone(), "How much chance decides which strokes come first.", &mut self.randomness);
            list.formerly("chance");
            number(list, "pointedness", "Pointed ends", ("", 0.0..=2.0, 0.0..=2.0), "How far strokes thin out towards their ends; at 0 they are blunt. Ends need so much more darkness than the middle.", &mut self.pointedness);
            list.formerly("pointed");
            number(list, "late_insertion", "Insert delay", unit.clone(), "How much darker it must be before lines are inserted between others.", &mut self.late_insertion);
            list.formerly("inserted");
            number(list, "insertion_spread", "Insert spread", ("", 0.0..=2.0, 0.0..=2.0), "How differently inserted lines are delayed; 0: all in one place come at once.", &mut self.insertion_spread);
            number(list, "variation", "Variation", unit, "How much widths vary from stroke to stroke.", &mut self.variation);
        });
    }
}

impl CrossHatching {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.integer(
            "directions",
            "Directions",
            "",
            1..=3,
            "How many directions cross at most.",
            &mut self.directions,
        );
        list.moved_from("hatching.layers.count");
        list.when_any("hatching.cross_hatching.directions", ["2", "3"], |list| {
            list.share(
                "second",
                "Second above",
                "Darkness from which on a second direction crosses the first.",
                &mut self.second,
            );
            list.moved_from("hatching.layers.second");
            list.switch(
                "shadows_cross",
                "Across shadows",
                "Strokes of the form run on through cast shadows, which others make.",
                &mut self.shadows_cross,
            );
            list.moved_from("hatching.layers.shadows_cross");
        });
        list.when_any("hatching.cross_hatching.directions", ["3"], |list| {
            list.share(
                "third",
                "Third above",
                "Darkness from which on a third direction crosses both.",
                &mut self.third,
            );
            list.moved_from("hatching.layers.third");
        });
    }
}

impl Shadows {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.switch(
            "differ",
            "Shadows differ",
            "Other strokes where the first light does not reach: in shadows that are thrown, and on the side away from it.",
            &mut self.differ,
        );
        list.when_any("hatching.shadows.differ", ["true"], |list| {
            list.choice("set", "Strokes", "What strokes in shadows look like.", &mut self.set);
            list.number(
                "turn",
                "Turned by",
                "°",
                -90.0..=90.0,
                "How far strokes in shadows are turned against those in the light.",
                &mut self.turn,
            );
        });
    }
}

impl Tone {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.curve(
            "curve",
            "Tone curve",
            "From the light on a surface (left: none) to the tone that is drawn (below: ink).",
            &mut self.curve,
        );
        list.share("ambient", "Ambient", "Light that reaches every point, lit or not.", &mut self.ambient);
        list.share(
            "object_tone",
            "Object tone",
            "How far the object's own color darkens: 0 draws all as if white.",
            &mut self.object_tone,
        );
        list.formerly("own_color");
        let help =
            "Darkness up to which no stroke is drawn: 0.1 leaves the lightest tenth of the tones bare.";
        list.share("lightest", "Lightest tone", help, &mut self.lightest);
        list.formerly("white");
        list.share("darkest", "Darkest tone", "Greatest share of ink.", &mut self.darkest);
    }
}
