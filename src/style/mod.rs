//! The complete look of one object: technique, its parameters, edges. Plain data.
//!
//! Every parameter is declared once, in the `params` function of its effect; panels, style files, `--set` and the
//! reference of `hachure styles` all read that list (see [`param`]). Ranges stand there alone, not at the fields.

pub mod blueprint;
pub mod color;
mod curve;
#[cfg(test)]
mod curve_tests;
mod declare;
pub mod edge_group;
pub mod edge_line;
pub mod edge_mode;
pub mod edges;
pub mod gooch;
pub mod halftone;
pub mod hatching;
pub mod hidden;
pub mod indication;
pub mod matcap;
mod matrix;
pub mod mirror;
pub mod own_strokes;
mod paper;
pub mod param;
#[cfg(test)]
mod param_tests;
pub mod plain;
pub mod preset;
mod ramp;
pub mod sketch;
mod slot;
mod toml_file;
pub mod toon;
mod value;

use std::path::PathBuf;

pub use blueprint::Blueprint;
pub use color::Color;
pub use curve::{Curve, CurveError, Point};
pub use edge_line::LineStyle;
pub use edge_mode::{Alignment, EdgeMode, EdgeOperator};
pub use edges::Edges;
pub use gooch::Gooch;
pub use halftone::Halftone;
pub use hatching::Hatching;
pub use hidden::{Hidden, HiddenMode};
pub use matrix::Matrix;
pub use mirror::Mirror;
pub use paper::Paper;
pub use param::{Param, Slot, Value};
pub use plain::Plain;
pub use preset::MadeFrom;
pub use sketch::Sketch;
pub use toml_file::{diff_to_toml, set_from_toml};
pub use toon::Toon;

use param::{Params, Scope};
pub(crate) use slot::choice;
pub(crate) use value::widened;

/// Makes the list of techniques, and a field of [`Style`] for the parameters of each that has any.
macro_rules! techniques {
    ($($(#[$about:meta])+ $technique:ident $(($field:ident: $parameters:ty))?,)+) => {
        choice! {
            /// How a surface is shaded. The literal ids stand in files and on the command line.
            pub enum Technique {
                $($(#[$about])+ $technique,)+
            }
        }

        /// The complete look of one object.
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct Style {
            /// How surfaces are shaded.
            pub technique: Technique,
            /// What it is drawn on, where it is the style of a whole document that does not say so itself.
            pub paper: Paper,
            $($(
                #[doc = concat!("Parameters of [`Technique::", stringify!($technique), "`].")]
                pub $field: $parameters,
            )?)+
            /// Lines.
            pub edges: Edges,
            /// What a mirror shows.
            pub mirror: Mirror,
            /// How surfaces and lines are moved and rubbed on as by hand.
            pub sketch: Sketch,
            /// What it was made from.
            pub made_from: MadeFrom,
        }

        impl Style {
            /// Declares the parameters of each technique, which matter only while it is chosen.
            fn technique_params<'a>($($($field: &'a mut $parameters,)?)+ list: &mut Params<'a>) {
                $($(
                    list.when("technique", Technique::$technique, |list| {
                        list.section(stringify!($field), |list| $field.params(list));
                    });
                )?)+
            }

            /// Every parameter, in the order of the panel, with a slot through which it is read and written.
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
                let ink = self.edges.profile.line().color;
                list.choice("technique", "Technique", "How surfaces are shaded.", &mut self.technique);
                list.only(Scope::Drawing, |list| self.paper.params(list));
                Self::technique_params($($(&mut self.$field,)?)+ list);
                // Blueprints have layers, sketches a single one.
                let blueprint: &str = Technique::Blueprint.into();
                let surfaces = <Technique as strum::VariantNames>::VARIANTS.iter().copied();
                list.when_any("technique", surfaces.filter(|name| *name != blueprint), |list| {
                    list.section("sketch", |list| self.sketch.params(ink, list));
                });
                list.only(Scope::Mirrors, |list| list.section("mirror", |list| self.mirror.params(list)));
                list.section("edges", |list| self.edges.params(list));
            }
        }
    };
}

techniques! {
    /// Paper only, for pure line drawings.
    Blank,
    /// Lit by the scene's lights.
    Plain(plain: Plain),
    /// The base color, unlit.
    Unlit,
    /// Cool-to-warm technical illustration.
    #[default]
    Gooch(gooch: Gooch),
    /// Flat shades from a ramp, as in a comic.
    Toon(toon: Toon),
    /// Tones by the density of ink.
    Halftone(halftone: Halftone),
    /// The look of a lit sphere, of which there is a picture.
    Matcap(matcap: matcap::Matcap),
    /// Tones by strokes that follow the form.
    Hatching(hatching: Hatching),
    /// The lines of hidden layers too.
    Blueprint(blueprint: Blueprint),
}

impl Style {
    /// The images that are needed with the choices as they are: keys of parameters, and the paths that they have.
    pub fn images(&self) -> Vec<(String, Option<PathBuf>)> {
        let mut style = self.clone();
        let mut params = style.params();
        param::retain_relevant(&mut params);
        let image = |p: Param<'_>| match p.slot {
            Slot::File(path) => Some((p.key, path.clone())),
            _ => None,
        };
        params.into_iter().filter_map(image).collect()
    }
}

/// Why a style or one of its parameters was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StyleError {
    /// No parameter has this key.
    #[error("unknown parameter `{key}`{}", suggestion(nearest))]
    UnknownKey {
        /// As written.
        key: String,
        /// The most similar key that exists.
        nearest: Option<String>,
    },
    /// The value has another type than the parameter.
    #[error("`{key}` takes {expected}, not {found}")]
    WrongType {
        /// The parameter.
        key: String,
        /// What it takes, in words.
        expected: String,
        /// What was given.
        found: String,
    },
    /// The number lies outside of the parameter's hard range.
    #[error("`{key}` = {found} is out of range: {min} to {max}")]
    OutOfRange {
        /// The parameter.
        key: String,
        /// What was given.
        found: f64,
        /// Least allowed value.
        min: f32,
        /// Greatest allowed value.
        max: f32,
    },
    /// The points are no curve.
    #[error("`{key}`: {source}")]
    Curve {
        /// The parameter.
        key: String,
        /// What is wrong with them.
        source: CurveError,
    },
    /// No preset and no file has this name.
    #[error(
        "unknown style `{id}`{} `hachure styles` lists the presets; the path of a .toml file works too",
        sentence(nearest)
    )]
    UnknownPreset {
        /// As written.
        id: String,
        /// The most similar preset.
        nearest: Option<String>,
    },
    /// A style file could not be read.
    #[error("cannot read style {path}: {reason}")]
    Read {
        /// The file.
        path: String,
        /// What the system said.
        reason: String,
    },
    /// Something is wrong in a file.
    #[error("{path}, line {line}: {source}")]
    InFile {
        /// The file.
        path: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong there.
        source: Box<Self>,
    },
    /// The text is no TOML.
    #[error("{message}")]
    Syntax {
        /// What the parser said.
        message: String,
    },
}

fn sentence(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or(".".to_owned(), |n| format!("; did you mean `{n}`?"))
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|n| format!("; did you mean `{n}`?")).unwrap_or_default()
}

/// The candidate most similar to `wanted`, if any is similar at all.
pub(crate) fn nearest<'a>(wanted: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    candidates
        .into_iter()
        .map(|c| (strsim::jaro_winkler(wanted, c), c))
        .filter(|(similarity, _)| *similarity > 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, c)| c.to_owned())
}
