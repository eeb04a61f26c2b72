//! The command line. What the window can draw, this can draw too.

mod args;
mod bench;
mod info;
mod layers;
mod render;
mod styles;

use std::path::PathBuf;

use clap::Parser as _;

use crate::app::{self, AppError};
use crate::document::{DocumentError, PatternError};
use crate::export::session::OpenError;
use crate::export::{ExportError, Session};
use crate::gpu::{Gpu, GpuError};
use crate::hatching::cache::Cache;
use crate::render::RenderError;
use crate::style::{StyleError, preset};

use args::{Cli, Command};

/// Why a command could not do what it was asked to.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The window.
    #[error(transparent)]
    App(#[from] AppError),
    /// A file could not be opened.
    #[error(transparent)]
    Open(#[from] OpenError),
    /// A style or a parameter.
    #[error(transparent)]
    Style(#[from] StyleError),
    /// A pattern.
    #[error(transparent)]
    Pattern(#[from] PatternError),
    /// The document.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// The device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// Drawing.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Saving.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// A scale was asked for.
    #[error(
        "a scale needs to know how long a unit of the model is, and the file does not say; add --unit mm, or whatever it is"
    )]
    NoUnit,
    /// Nothing was named to be measured.
    #[error("no model was named, and the sample, {}, is not here; name a model", SAMPLE)]
    NoSample,
    /// Rows of measurements were asked for that there are none of.
    #[error("no row has `{0}` in its name; without --only all of them are printed")]
    NoRow(String),
    /// The output could not be written.
    #[error("cannot write to standard output: {0}")]
    Output(#[from] std::io::Error),
}

/// Runs what the arguments of the process say and returns its exit code: 0 done, 2 wrong usage.
///
/// # Errors
/// [`CliError`], for exit code 1.
pub fn run() -> Result<i32, CliError> {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            error.print()?;
            return Ok(error.exit_code());
        }
    };
    let done = match cli.command {
        Some(Command::Render(args)) => render::run(&args),
        Some(Command::Info(args)) => info::run(&args),
        Some(Command::Styles(args)) => styles::run(&args),
        Some(Command::Bench(args)) => bench::run(&args),
        None => window(cli.files, cli.style.as_deref()),
    };
    match done {
        // Whoever reads the output has seen enough.
        Err(CliError::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(0),
        other => other.map(|()| 0),
    }
}

fn window(mut files: Vec<PathBuf>, style: Option<&str>) -> Result<(), CliError> {
    let style = style.map(preset::load).transpose()?;
    for renamed in style.iter().flat_map(|preset| &preset.renamed) {
        warn(renamed);
    }
    if files.is_empty() {
        files.extend(sample());
    }
    Ok(app::run(files, style.map(|p| p.style))?)
}

const SAMPLE: &str = "assets/models/crank.glb";

/// The model that comes with the program, where it is started from its own folder.
fn sample() -> Option<PathBuf> {
    Some(PathBuf::from(SAMPLE)).filter(|path| path.exists())
}

/// What pictures are drawn with, by the user's own shaders if `HACHURE_SHADERS` names any and they are right.
fn session(gpu: Gpu) -> Result<Session, CliError> {
    let mut session = Session::new(gpu);
    session.set_cache(Cache::of_user());
    match session.renderer().take_shader_error() {
        Some(mistake) => Err(RenderError::from(mistake).into()),
        None => Ok(session),
    }
}

/// Prints a value as JSON with a newline.
fn print_json(value: &serde_json::Value) -> Result<(), CliError> {
    use std::io::Write as _;
    let mut out = std::io::stdout().lock();
    serde_json::to_writer_pretty(&mut out, value).map_err(std::io::Error::from)?;
    writeln!(out)?;
    Ok(())
}

/// Prints a warning where errors go too.
fn warn(warning: &impl std::fmt::Display) {
    eprintln!("hachure: warning: {warning}");
}

/// Prints a line of text.
fn print_line(line: &str) -> Result<(), CliError> {
    print_text(&format!("{line}\n"))
}

/// Prints a text as it is.
fn print_text(text: &str) -> Result<(), CliError> {
    use std::io::Write as _;
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}
