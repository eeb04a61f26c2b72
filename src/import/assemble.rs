//! What the formats without a tree of placed nodes share: finished meshes and their names become the nodes of a scene.

use std::path::Path;
use std::sync::Arc;

use glam::DMat4;

use super::names::{SiblingNames, file_stem};
use super::{ImportError, ImportOptions, Progress};
use crate::geometry::mend::mended;
use crate::geometry::{CleanReport, Mesh, clean, normals};
use crate::scene::{Node, Scene, Warning};

/// A node to be, with what hangs below it.
#[derive(Debug, Default)]
pub(super) struct Branch {
    /// Name in the file.
    pub(super) name: String,
    /// Its triangles; a mesh without any counts as none.
    pub(super) mesh: Option<Mesh>,
    /// Branches below.
    pub(super) children: Vec<Self>,
}

/// A scene under construction.
pub(super) struct Assembly<'a> {
    path: &'a Path,
    options: &'a ImportOptions,
    progress: &'a Progress,
    /// Materials, textures, warnings and the up axis are the importer's to fill.
    pub(super) scene: Scene,
    /// Number of meshes, and how many of them are finished.
    meshes: usize,
    finished: usize,
    /// Triangles left out so far.
    dropped: usize,
}

impl<'a> Assembly<'a> {
    /// An empty scene for the file at `path`.
    pub(super) fn new(path: &'a Path, options: &'a ImportOptions, progress: &'a Progress) -> Self {
        Self { path, options, progress, scene: Scene::default(), meshes: 0, finished: 0, dropped: 0 }
    }

    /// Name of the file, without its folder.
    pub(super) fn file_name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }

    /// Adds a warning about a place in the file; an empty place means the file as a whole.
    pub(super) fn warn(&mut self, place: &str, message: impl Into<String>) {
        let file = self.file_name();
        self.scene.warnings.push(Warning {
            place: if place.is_empty() { file } else { format!("{file}, {place}") },
            message: message.into(),
        });
    }

    /// Warns that triangles are lost because their corners are at vertices that do not exist.
    pub(super) fn lost(&mut self, place: &str, out_of_range: usize) {
        let report = CleanReport { out_of_range, ..CleanReport::default() };
        for message in report.messages() {
            self.warn(place, message);
        }
        self.dropped += out_of_range;
    }

    /// The error for content that the format does not allow.
    pub(super) fn malformed(&self, message: impl Into<String>) -> ImportError {
        ImportError::Malformed { path: self.path.into(), message: message.into() }
    }

    /// Cleans the meshes, gives them normals where they have none, and hangs everything below one node that is named
    /// after the file.
    ///
    /// # Errors
    /// `Empty` when no triangle is left (`reason` says why the file might hold none), `Canceled`.
    pub(super) fn finish(mut self, branches: Vec<Branch>, reason: &str) -> Result<Scene, ImportError> {
        self.meshes = branches.iter().map(Branch::count).sum();
        let root = Branch { name: file_stem(self.path), mesh: None, children: branches };
        self.add(root, None, &mut SiblingNames::default())?;
        if self.scene.meshes.is_empty() {
            let reason = if self.dropped > 0 {
                format!("none of its {} triangles can be drawn: {}", self.dropped, self.last_words())
            } else {
                reason.to_owned()
            };
            return Err(ImportError::Empty { path: self.path.into(), reason });
        }
        self.progress.report(1.0);
        Ok(self.scene)
    }

    /// All warnings in one line.
    fn last_words(&self) -> String {
        const MOST: usize = 5;
        let messages = self.scene.warnings.iter().rev().take(MOST);
        messages.map(|w| w.message.as_str()).collect::<Vec<_>>().join("; ")
    }

    fn add(
        &mut self,
        branch: Branch,
        parent: Option<usize>,
        siblings: &mut SiblingNames,
    ) -> Result<(), ImportError> {
        self.progress.check()?;
        let name = siblings.unique(&branch.name);
        let above = parent.and_then(|p| self.scene.nodes.get(p));
        let path = format!("{}/{name}", above.map_or("", |node| &node.path));
        let id = self.scene.nodes.len();
        let mesh = branch.mesh.and_then(|mesh| self.finish_mesh(mesh, &path));
        if mesh.is_none() && branch.children.is_empty() && parent.is_some() {
            return Ok(());
        }
        self.scene.nodes.push(Node {
            name,
            path,
            parent,
            descendants: 0,
            world_from_local: DMat4::IDENTITY,
            mesh,
        });
        let mut names = SiblingNames::default();
        for child in branch.children {
            self.add(child, Some(id), &mut names)?;
        }
        let descendants = self.scene.nodes.len() - id - 1;
        if let Some(node) = self.scene.nodes.get_mut(id) {
            node.descendants = descendants;
        }
        Ok(())
    }

    /// Index of the finished mesh, if anything of it is left.
    fn finish_mesh(&mut self, mesh: Mesh, place: &str) -> Option<usize> {
        let (mesh, report) = clean(mesh);
        for message in report.messages() {
            self.warn(place, message);
        }
        self.dropped += report.dropped();
        self.finished += 1;
        // Reading was the first half of the work.
        let share = self.finished as f32 / self.meshes.max(1) as f32;
        self.progress.report(0.5 + 0.5 * share);
        if mesh.indices.is_empty() {
            return None;
        }
        // Vertices that nothing shows must not count for the size of the model.
        let mesh = mended(mesh.without_unused_vertices(), self.options.seams);
        let mesh = if mesh.normals.is_empty() {
            normals::by_crease_angle(mesh, self.options.crease_angle)
        } else {
            mesh
        };
        self.scene.meshes.push(Arc::new(mesh));
        Some(self.scene.meshes.len() - 1)
    }
}

impl Branch {
    /// Number of meshes in it.
    fn count(&self) -> usize {
        usize::from(self.mesh.is_some()) + self.children.iter().map(Self::count).sum::<usize>()
    }
}
