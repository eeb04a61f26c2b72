//! What can be written behind `hachure`.

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, Parser, Subcommand};
use glam::DVec3;
use strum::VariantNames as _;

use crate::document::section::Axis;
use crate::import::Format;
use crate::render::MAX_SAMPLES;
use crate::scene::{Standard, Unit, Up};
use crate::style::{Color, Value};

/// Opens a 3D model and draws it while you turn it.
#[derive(Debug, Parser)]
#[command(name = "hachure", version, about, args_conflicts_with_subcommands = true)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[arg(help = files_help())]
    pub files: Vec<PathBuf>,
    /// Style of all objects: a preset's name or a .toml file
    #[arg(long, value_name = "NAME|FILE")]
    pub style: Option<String>,
}

fn files_help() -> String {
    let formats = Format::names();
    format!(
        "Models ({formats}) or one .hachure document to open in the window [default: the sample, in its own folder]"
    )
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Draws a picture without a window
    Render(Box<RenderArgs>),
    /// Says what was loaded: nodes, triangles, bounds, unit, up axis, materials, warnings
    Info(InfoArgs),
    /// Lists the presets and every parameter
    Styles(StylesArgs),
    /// Measures milliseconds per stage and frame
    Bench(BenchArgs),
}

#[derive(Debug, Args)]
pub(super) struct RenderArgs {
    /// Models, or one .hachure document
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// The picture to write (.png)
    #[arg(short, long)]
    pub output: PathBuf,
    /// Size of the picture in pixels
    #[arg(long, value_name = "W,H", default_value = "1000,800")]
    pub resolution: Resolution,
    /// Samples per pixel, 1 to 1024: more are smoother and take as many times as long; 64 is as smooth as eyes can tell
    #[arg(long, value_name = "N", default_value = "16", value_parser = samples)]
    pub samples: u32,
    #[command(flatten)]
    pub look: LookArgs,
    #[command(flatten)]
    pub camera: CameraArgs,
    /// Color of the paper
    #[arg(long, value_name = "#RRGGBB")]
    pub background: Option<Color>,
    /// Pixels per inch of paper, written into the file [default with --scale: 300]
    #[arg(long, value_name = "N", value_parser = positive)]
    pub dpi: Option<f64>,
    /// Leave the paper out: the background becomes transparent
    #[arg(long)]
    pub no_background: bool,
    /// Print what was drawn, and the warnings, as JSON
    #[arg(long)]
    pub json: bool,
}

/// Styles and roles; later ones in this list win: --style, --object-style, --set.
#[derive(Debug, Args)]
pub(super) struct LookArgs {
    /// Style of all objects: a preset's name or a .toml file
    #[arg(long, value_name = "NAME|FILE")]
    pub style: Option<String>,
    /// Style of the objects that match a pattern (`/crank/rod.3/*`, or `rod*` for names)
    #[arg(long, value_name = "GLOB=NAME|FILE")]
    pub object_style: Vec<Assignment>,
    /// Set a parameter of all objects (`edges.profile.width=2`) or of some (`rod*:gooch.alpha=0.3`)
    #[arg(long, value_name = "[GLOB:]KEY=VALUE")]
    pub set: Vec<Setting>,
    /// Do not draw the objects that match
    #[arg(long, value_name = "GLOB")]
    pub hide: Vec<String>,
    /// Draw no edges of the objects that match
    #[arg(long, value_name = "GLOB")]
    pub no_enhance: Vec<String>,
    /// Make the flat objects that match mirrors
    #[arg(long, value_name = "GLOB")]
    pub mirror: Vec<String>,
    /// Cut away what lies beyond a plane: its axis (x, y or z) and its position in units of the model [default: the middle];
    /// `--set section.flip=true` cuts away what lies before it, `section.axis=free` allows any direction
    #[arg(long, value_name = "AXIS[=POSITION]")]
    pub section: Option<SectionAt>,
    /// Draw layers of blueprints until the objects that match are uncovered (`blueprint.fraction`); they are drawn as surfaces
    #[arg(long, value_name = "GLOB")]
    pub mask: Vec<String>,
    /// The axis that is up: +X, -X, +Y, -Y, +Z or -Z
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    pub up: Option<Up>,
    /// The unit of the model's coordinates: mm, cm, m, km, in or ft [default: the file's]
    #[arg(long, value_name = "UNIT")]
    pub unit: Option<Unit>,
}

/// The flags of F3D with the same names; coordinates are the file's.
#[derive(Debug, Args)]
pub(super) struct CameraArgs {
    /// Look at everything from a standard direction: front, back, right, left, top, bottom, isometric or home
    #[arg(long, value_name = "SIDE", conflicts_with = "camera_position", value_parser = standard)]
    pub look_from: Option<Standard>,
    /// Where the eye is
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub camera_position: Option<Vector>,
    /// What the eye looks at [default: the middle of the scene]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub camera_focal_point: Option<Vector>,
    /// What is up in the picture [default: the up axis]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub camera_view_up: Option<Vector>,
    /// Vertical view angle in degrees, 1 to 170
    #[arg(long, value_name = "DEG", value_parser = view_angle)]
    pub camera_view_angle: Option<f64>,
    /// Parallel projection
    #[arg(long)]
    pub camera_orthographic: bool,
    /// Height of the picture in units of the model [default: everything is seen]
    #[arg(long, value_name = "H", requires = "camera_orthographic", value_parser = positive)]
    pub camera_view_height: Option<f64>,
    /// True scale on paper, such as 1:50, at --dpi
    #[arg(long, value_name = "A:B", requires = "camera_orthographic", conflicts_with = "camera_view_height")]
    pub scale: Option<Scale>,
    /// Turn the eye about the up axis, to its right, in degrees; from the front if no position is given
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = finite)]
    pub camera_azimuth_angle: Option<f64>,
    /// Raise the eye, in degrees; from the front if no position is given
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = finite)]
    pub camera_elevation_angle: Option<f64>,
}

#[derive(Debug, Args)]
pub(super) struct InfoArgs {
    /// Models, or one .hachure document
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Print as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub(super) struct StylesArgs {
    /// Print as JSON
    #[arg(long)]
    pub json: bool,
    /// Print as a page of Markdown, `docs/parameters.md`
    #[arg(long, conflicts_with = "json")]
    pub markdown: bool,
}

#[derive(Debug, Args)]
pub(super) struct BenchArgs {
    /// Models, or one .hachure document [default: the sample crank]
    pub files: Vec<PathBuf>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "W,H", default_value = "800,800")]
    pub resolution: Resolution,
    /// Frames per measurement; the median counts
    #[arg(long, value_name = "N", default_value = "20", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub frames: u32,
    /// Only rows whose name has this in it, beside the plain one
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,
    /// Print as JSON
    #[arg(long)]
    pub json: bool,
}

fn number(s: &str, is_allowed: impl Fn(f64) -> bool, what: &str) -> Result<f64, String> {
    let value = s.trim().parse().ok().filter(|n: &f64| n.is_finite() && is_allowed(*n));
    value.ok_or_else(|| format!("`{s}` is no {what}"))
}

fn finite(s: &str) -> Result<f64, String> {
    number(s, |_| true, "number")
}

fn positive(s: &str) -> Result<f64, String> {
    number(s, |n| n > 0.0, "number above 0")
}

fn view_angle(s: &str) -> Result<f64, String> {
    number(s, |n| (1.0..=170.0).contains(&n), "angle from 1 to 170 degrees")
}

fn standard(s: &str) -> Result<Standard, String> {
    s.parse().map_err(|_unknown| format!("`{s}` is no side; use one of {}", Standard::VARIANTS.join(", ")))
}

fn samples(s: &str) -> Result<u32, String> {
    let samples = s.trim().parse().ok().filter(|n| (1..=MAX_SAMPLES).contains(n));
    samples.ok_or_else(|| format!("`{s}` is no number of samples from 1 to {MAX_SAMPLES}"))
}

/// Width and height of a picture in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Resolution(pub [u32; 2]);

impl FromStr for Resolution {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let wrong = || format!("`{s}` is no size; write width,height in pixels, such as 800,600");
        let (w, h) = s.split_once([',', 'x']).ok_or_else(wrong)?;
        let side =
            |side: &str| side.trim().parse().ok().filter(|n| (1..=65_536).contains(n)).ok_or_else(wrong);
        Ok(Self([side(w)?, side(h)?]))
    }
}

/// How much longer things are than on paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale(pub f64);

impl FromStr for Scale {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let wrong = || format!("`{s}` is no scale; write two numbers above 0, such as 1:50");
        let (paper, world) = s.split_once(':').ok_or_else(wrong)?;
        let number = |s: &str| positive(s).map_err(|_no_number| wrong());
        Ok(Self(number(world)? / number(paper)?))
    }
}

/// Three numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vector(pub DVec3);

impl FromStr for Vector {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> =
            s.split(',').map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite())).collect();
        match numbers.as_deref() {
            Some(&[x, y, z]) => Ok(Self(DVec3::new(x, y, z))),
            _ => Err(format!("`{s}` is no vector; write three numbers with commas, such as 1,0.5,-2")),
        }
    }
}

/// `AXIS[=POSITION]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SectionAt {
    pub axis: Axis,
    pub position: Option<f32>,
}

impl FromStr for SectionAt {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let wrong = || format!("`{s}` is no plane; write x, y or z and a position, such as y=1.5");
        let (axis, position) = s.split_once('=').map_or((s, None), |(axis, position)| (axis, Some(position)));
        let axis = axis.trim().to_ascii_lowercase().parse().ok().filter(|axis| *axis != Axis::Free);
        let position =
            position.map(|p| p.trim().parse().ok().filter(|p: &f32| p.is_finite()).ok_or_else(wrong));
        Ok(Self { axis: axis.ok_or_else(wrong)?, position: position.transpose()? })
    }
}

/// `GLOB=NAME`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Assignment {
    pub pattern: String,
    pub style: String,
}

impl FromStr for Assignment {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let (pattern, style) =
            s.split_once('=').ok_or_else(|| format!("`{s}`: write a pattern, `=` and a style"))?;
        Ok(Self { pattern: pattern.to_owned(), style: style.to_owned() })
    }
}

/// `[GLOB:]KEY=VALUE`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Setting {
    pub pattern: Option<String>,
    pub key: String,
    pub value: Value,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, String> {
        let split = |(at, _)| {
            let (left, value) = (&s[..at], &s[at + 1..]);
            let (pattern, key) = left.rsplit_once(':').map_or((None, left), |(p, k)| (Some(p.to_owned()), k));
            // Patterns and the names of files may contain `=` too, keys do not.
            (!key.contains('=')).then_some((pattern, key, value))
        };
        let (pattern, key, value) = s
            .rmatch_indices('=')
            .find_map(split)
            .ok_or_else(|| format!("`{s}`: write a parameter, `=` and its value"))?;
        Ok(Self { pattern, key: key.to_owned(), value: Value::parse(value) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_command_line_is_well_formed() {
        Cli::command().debug_assert();
    }

    #[test]
    fn values_are_parsed() {
        assert_eq!("800,600".parse(), Ok(Resolution([800, 600])));
        assert!("800".parse::<Resolution>().is_err() && "0,5".parse::<Resolution>().is_err());
        assert_eq!("1,-2,0.5".parse(), Ok(Vector(DVec3::new(1.0, -2.0, 0.5))));
        assert!("1,2".parse::<Vector>().is_err() && "1,2,nan".parse::<Vector>().is_err());
        assert_eq!("y=-1.5".parse(), Ok(SectionAt { axis: Axis::Y, position: Some(-1.5) }));
        assert_eq!("Z".parse(), Ok(SectionAt { axis: Axis::Z, position: None }));
        assert!(["w=1", "free", "y=", "y=nan", ""].iter().all(|s| s.parse::<SectionAt>().is_err()));
        assert_eq!(("1:50".parse(), "2:1".parse()), (Ok(Scale(50.0)), Ok(Scale(0.5))));
        assert!(["1", "1:0", "0:1", "1:x", "1:-2", "1:inf"].iter().all(|s| s.parse::<Scale>().is_err()));
        let setting: Setting = "/a/b*:gooch.alpha=0.3".parse().unwrap();
        assert_eq!(setting.pattern.as_deref(), Some("/a/b*"));
        assert_eq!((setting.key.as_str(), setting.value), ("gooch.alpha", Value::Number(0.3)));
        let setting: Setting = "a=b:toon.image=x=1.png".parse().unwrap();
        assert_eq!((setting.pattern.as_deref(), setting.key.as_str()), (Some("a=b"), "toon.image"));
        assert_eq!(setting.value, Value::from("x=1.png"));
        let setting: Setting = "sketch.pass1.matrix=1,0.2,-0.2,1".parse().unwrap();
        assert_eq!(setting.value, Value::Matrix(crate::style::Matrix([[1.0, 0.2], [-0.2, 1.0]])));
    }
}
