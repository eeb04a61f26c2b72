//! A file becomes a scene: glTF/GLB, OBJ+MTL, STL and PLY.
//!
//! Importers never trust the file: indices are checked, allocations are bounded by the file's size, side files are
//! read only from the model's own folder and below, and nothing touches a network.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use crate::scene::Scene;

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
    #[error("{}: unknown kind of file; Hachure opens .gltf, .glb, .obj, .stl and .ply", path.display())]
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
    #[error("loading was cancelled")]
    Cancelled,
}

/// Choices that change what an importer makes of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImportOptions {
    /// Where a format gives no normals and leaves the choice (OBJ, STL, PLY): edges with a larger dihedral angle
    /// stay hard. Degrees, 0 to 180, default 30.
    pub crease_angle: f32,
}

impl Default for ImportOptions {
    fn default() -> Self {
        Self { crease_angle: 30.0 }
    }
}

/// Progress of a job that runs beside the window, and the way to stop it. Clones share their state.
#[derive(Debug, Clone, Default)]
pub struct Progress(Arc<ProgressState>);

#[derive(Debug, Default)]
struct ProgressState {
    permille: AtomicU32,
    cancelled: AtomicBool,
}

impl Progress {
    /// Reports the share of the work that is done, 0 to 1.
    pub fn report(&self, share: f32) {
        self.0.permille.store((share.clamp(0.0, 1.0) * 1000.0) as u32, Ordering::Relaxed);
    }

    /// The share of the work that is done, 0 to 1.
    pub fn share(&self) -> f32 {
        self.0.permille.load(Ordering::Relaxed) as f32 / 1000.0
    }

    /// Asks the job to stop at the next opportunity.
    pub fn cancel(&self) {
        self.0.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the job was asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.0.cancelled.load(Ordering::Relaxed)
    }

    /// `Err(ImportError::Cancelled)` once the job was asked to stop.
    pub fn check(&self) -> Result<(), ImportError> {
        if self.is_cancelled() { Err(ImportError::Cancelled) } else { Ok(()) }
    }
}

/// Loads one file. Its contents hang below one node that is named after the file (`crank.glb` → `/crank`).
///
/// # Errors
/// When the file cannot be read, is malformed, needs something unsupported, or holds nothing to draw. Whatever can
/// be shown is shown; the rest is in [`Scene::warnings`].
pub fn load(path: &Path, options: &ImportOptions, progress: &Progress) -> Result<Scene, ImportError> {
    let _ = (options, progress);
    Err(ImportError::UnknownFormat { path: path.into() })
}

/// Loads several files into one scene, in order; nodes of equal name get `.2`, `.3`, … appended.
///
/// # Errors
/// The first file that fails (see [`load`]).
pub fn load_all(
    paths: &[PathBuf],
    options: &ImportOptions,
    progress: &Progress,
) -> Result<Scene, ImportError> {
    let _ = (paths, options, progress);
    Ok(Scene::default())
}
