//! A file becomes a scene. [`Format`] lists the formats.
//!
//! Importers never trust the file: indices are checked, allocations are bounded by the file's size, side files are
//! read only from the model's own folder and below, and nothing touches a network.

mod assemble;
mod format;
mod gltf;
mod image;
mod image_cache;
mod link_nodes;
mod memory_budget;
mod names;
mod obj;
mod ply;
mod source;
mod stl;
mod text;

use std::panic::AssertUnwindSafe;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

pub use self::format::{Format, IMAGE_ENDINGS};
pub use self::image::load_image;
pub use self::image_cache::ImageCache;
pub use self::link_nodes::link_nodes;

use self::names::SiblingNames;
use crate::geometry::mend::SeamTolerance;
use crate::scene::{Scene, Warning};

/// Why a file could not become a scene. Each message says what, where and what to do.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The file could not be read at all.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The name's ending and the content name no known format.
    #[error(
        "{}: unknown kind of file; Hachure opens {}",
        path.display(),
        Format::all_endings().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ")
    )]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The content is not what the format allows.
    #[error("{}: {message}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong, where (line, node, accessor) and what to do.
        message: String,
    },
    /// The file needs something that Hachure does not have.
    #[error("{}: needs {feature}, which Hachure does not support; export the model without it", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// For instance the name of a required glTF extension.
        feature: String,
    },
    /// The file is sound but holds no triangle.
    #[error("{}: nothing to draw: {reason}", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
        /// Why: no meshes, only points, all triangles degenerate.
        reason: String,
    },
    /// The person stopped it.
    #[error("loading was canceled")]
    Canceled,
}

/// Choices that change what an importer makes of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImportOptions {
    /// Where a format gives no normals and leaves the choice (OBJ, STL, PLY): edges with a larger dihedral angle
    /// stay hard. Degrees, 0 to 180, default 30.
    pub crease_angle: f32,
    /// How far the seams of separately tessellated faces may be apart to be mended.
    pub seams: SeamTolerance,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self { crease_angle: 30.0, seams: SeamTolerance::default() }
    }
}

/// Progress of a job that runs in the background, and the way to stop it. Clones share their state.
#[derive(Debug, Clone)]
pub struct Progress {
    state: Arc<ProgressState>,
    /// The range of shares that this clone reports into.
    range: (f32, f32),
}

impl Default for Progress {
    fn default() -> Self {
        Self { state: Arc::default(), range: (0.0, 1.0) }
    }
}

#[derive(Debug, Default)]
struct ProgressState {
    permille: AtomicU32,
    canceled: AtomicBool,
}

impl Progress {
    /// Reports the share of the work that is done, 0 to 1.
    pub fn report(&self, share: f32) {
        let (from, to) = self.range;
        let share = from + (to - from) * share.clamp(0.0, 1.0);
        self.state.permille.store((share * 1000.0) as u32, Ordering::Relaxed);
    }

    /// The share of the work that is done, 0 to 1.
    pub fn share(&self) -> f32 {
        self.state.permille.load(Ordering::Relaxed) as f32 / 1000.0
    }

    /// The same job, whose reports from 0 to 1 count as part `index` of `count` equal parts of the whole.
    #[must_use]
    pub fn part(&self, index: usize, count: usize) -> Self {
        let (from, to) = self.range;
        let width = (to - from) / count.max(1) as f32;
        let start = from + width * index as f32;
        Self { state: self.state.clone(), range: (start, start + width) }
    }

    /// Asks the job to stop at the next opportunity.
    pub fn cancel(&self) {
        self.state.canceled.store(true, Ordering::Relaxed);
    }

    /// Whether the job was asked to stop.
    pub fn is_canceled(&self) -> bool {
        self.state.canceled.load(Ordering::Relaxed)
    }

    /// Reports the share of the work that is done, 0 to 1; returns whether to go on.
    pub fn goes_on(&self, share: f32) -> bool {
        self.report(share);
        !self.is_canceled()
    }

    /// `Err(ImportError::Canceled)` once the job was asked to stop.
    pub fn check(&self) -> Result<(), ImportError> {
        if self.is_canceled() { Err(ImportError::Canceled) } else { Ok(()) }
    }
}

/// Loads one file. Its contents hang below one node that is named after the file (`crank.glb` → `/crank`).
///
/// The format is told by the content where it has a signature, else by the name's ending.
///
/// # Errors
/// When the file cannot be read, is malformed, needs something unsupported, or holds nothing to draw. Whatever can
/// be shown is shown; the rest is in [`Scene::warnings`].
pub fn load(path: &Path, options: &ImportOptions, progress: &Progress) -> Result<Scene, ImportError> {
    progress.check()?;
    let data =
        source::read_regular_file(path).map_err(|source| ImportError::Read { path: path.into(), source })?;
    progress.report(0.05);
    // The importers check what they read; should one of them or a library panic all the same, only this file is lost.
    let guarded = AssertUnwindSafe(|| {
        let mut scene = load_bytes(path, &data, options, progress)?;
        link_nodes::link_nodes(&mut scene, options.seams);
        Ok(scene)
    });
    let mut scene = std::panic::catch_unwind(guarded).unwrap_or_else(|payload| {
        let said = payload
            .downcast_ref::<&str>()
            .map(|s| (*s).to_owned())
            .or_else(|| payload.downcast_ref::<String>().cloned())
            .unwrap_or_default();
        Err(ImportError::Malformed {
            path: path.into(),
            message: format!("the importer failed on it ({said}); please report this file"),
        })
    })?;
    shorten_warnings(&mut scene.warnings);
    Ok(scene)
}

/// What [`load`] does once the content is in memory.
fn load_bytes(
    path: &Path,
    data: &[u8],
    options: &ImportOptions,
    progress: &Progress,
) -> Result<Scene, ImportError> {
    if data.is_empty() {
        return Err(ImportError::Malformed {
            path: path.into(),
            message: "the file is empty (0 bytes)".into(),
        });
    }
    match format::detect(path, data) {
        Some(Format::Gltf) => gltf::load(path, data, options, progress),
        Some(Format::Obj) => obj::load(path, data, options, progress),
        Some(Format::Stl) => stl::load(path, data, options, progress),
        Some(Format::Ply) => ply::load(path, data, options, progress),
        None => Err(ImportError::UnknownFormat { path: path.into() }),
    }
}

/// Keeps the first warnings of a file that would give thousands.
fn shorten_warnings(warnings: &mut Vec<Warning>) {
    const MOST: usize = 200;
    let more = warnings.len().saturating_sub(MOST);
    if more > 0 {
        warnings.truncate(MOST);
        let place = warnings.first().and_then(|w| w.place.split(',').next()).unwrap_or_default().to_owned();
        warnings.push(Warning { place, message: format!("{more} more warnings are not listed") });
    }
}

/// Loads several files into one scene, in order; root nodes of equal name get `.2`, `.3`, … appended.
///
/// # Errors
/// The first file that fails (see [`load`]).
pub fn load_all(
    paths: &[PathBuf],
    options: &ImportOptions,
    progress: &Progress,
) -> Result<Scene, ImportError> {
    let mut all: Option<Scene> = None;
    let mut names = SiblingNames::default();
    for (index, path) in paths.iter().enumerate() {
        let part = progress.part(index, paths.len());
        let mut scene = load(path, options, &part)?;
        rename_roots(&mut scene, &mut names);
        match &mut all {
            None => all = Some(scene),
            Some(all) => all.append(scene),
        }
    }
    Ok(all.unwrap_or_default())
}

/// Gives the roots of a scene names that no other file's root has.
fn rename_roots(scene: &mut Scene, names: &mut SiblingNames) {
    let mut old_prefix = String::new();
    let mut new_prefix = String::new();
    for node in &mut scene.nodes {
        if node.parent.is_none() {
            let name = names.unique(&node.name);
            old_prefix = format!("/{}", node.name);
            new_prefix = format!("/{name}");
            node.name = name;
        }
        if old_prefix != new_prefix
            && let Some(rest) = node.path.strip_prefix(&old_prefix)
        {
            node.path = format!("{new_prefix}{rest}");
        }
    }
}
