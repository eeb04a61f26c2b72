//! What the window remembers from one run to the next.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::document::Document;
use crate::render::MAX_SAMPLES;
use crate::scene::Up;

/// How many files are remembered.
const MAX_FILES: usize = 200;

/// How many of them the menu lists.
pub const MAX_RECENT: usize = 12;

/// Settings of the window, kept in the system's place for such things.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AppState {
    /// Opened files, the last one first.
    pub files: VecDeque<FileMemory>,
    /// The folder of the last dialog.
    pub last_folder: Option<PathBuf>,
    /// Whether panels are shown at all.
    pub panels: bool,
    /// Whether the outliner is open.
    pub outliner: bool,
    /// Whether the panel of styles and view is open.
    pub inspector: bool,
    /// The open page of that panel.
    pub page: Page,
    /// Whether the status bar shows how long a picture takes.
    pub statistics: bool,
    /// How smooth pictures are.
    pub samples: Samples,
    /// Whether panels are dark; `None`: as the system wants.
    pub dark: Option<bool>,
}

/// A page of the panel on the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Page {
    /// The look of the selection.
    #[default]
    Style,
    /// What lights it.
    Light,
    /// What points things out.
    Glyphs,
    /// How the picture is shown.
    View,
}

/// Samples per pixel: how smooth pictures are on this machine. One is no anti-aliasing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Samples {
    at_rest: u32,
    in_screenshots: u32,
}

impl Default for Samples {
    fn default() -> Self {
        Self { at_rest: 64, in_screenshots: 64 }
    }
}

impl Samples {
    /// Those of the picture in the window once nothing moves.
    pub fn at_rest(self) -> u32 {
        self.at_rest.clamp(1, MAX_SAMPLES)
    }

    /// Those of screenshots.
    pub fn in_screenshots(self) -> u32 {
        self.in_screenshots.clamp(1, MAX_SAMPLES)
    }

    /// The settings themselves, to be changed.
    pub fn settings(&mut self) -> [SamplesSetting<'_>; 2] {
        [
            SamplesSetting {
                label: "Smooth at rest",
                help: "Samples per pixel of the picture here, once nothing moves",
                value: &mut self.at_rest,
            },
            SamplesSetting {
                label: "Screenshots",
                help: "Samples per pixel of saved pictures",
                value: &mut self.in_screenshots,
            },
        ]
    }
}

/// A number of samples that a person sets.
pub struct SamplesSetting<'a> {
    /// Its label.
    pub label: &'static str,
    /// What it is for.
    pub help: &'static str,
    /// Samples per pixel.
    pub value: &'a mut u32,
}

/// What is remembered about one file.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct FileMemory {
    /// The file.
    pub path: PathBuf,
    /// The axis that was chosen as up.
    pub up: Option<Up>,
    /// The unit that was chosen.
    pub meters_per_unit: Option<f64>,
}

impl Default for AppState {
    fn default() -> Self {
        Self {
            files: VecDeque::new(),
            last_folder: None,
            panels: true,
            outliner: true,
            inspector: true,
            page: Page::default(),
            statistics: false,
            samples: Samples::default(),
            dark: None,
        }
    }
}

impl AppState {
    /// Puts a file on top of the list.
    pub fn note_opened(&mut self, path: &Path) {
        // One name that is no text would keep everything else from being remembered.
        if path.to_str().is_none() {
            return;
        }
        let known = self.files.iter().position(|f| f.path == path).and_then(|i| self.files.remove(i));
        let memory = known.unwrap_or_else(|| FileMemory { path: path.to_owned(), ..FileMemory::default() });
        self.files.push_front(memory);
        self.files.truncate(MAX_FILES);
        self.last_folder = path.parent().map(Path::to_owned);
    }

    /// What is known about a file.
    pub fn memory(&self, path: &Path) -> Option<&FileMemory> {
        self.files.iter().find(|f| f.path == path)
    }

    /// Keeps what was chosen for the first model.
    pub fn remember(&mut self, document: &Document) {
        let Some(first) = document.models.first() else { return };
        if let Some(memory) = self.files.iter_mut().find(|f| f.path == *first) {
            memory.up = document.up;
            memory.meters_per_unit = document.meters_per_unit;
        }
    }

    /// The files that the menu lists.
    pub fn recent(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().take(MAX_RECENT).map(|f| f.path.as_path())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_file_comes_first_and_keeps_its_axis() {
        let mut state = AppState::default();
        for i in 0..30 {
            state.note_opened(Path::new(&format!("/m/{i}.stl")));
        }
        let document =
            Document { models: vec!["/m/3.stl".into()], up: Some(Up::PosY), ..Document::default() };
        state.remember(&document);
        state.note_opened(Path::new("/m/3.stl"));
        assert_eq!(state.recent().count(), MAX_RECENT);
        assert_eq!(state.recent().next(), Some(Path::new("/m/3.stl")));
        assert_eq!(state.memory(Path::new("/m/3.stl")).and_then(|m| m.up), Some(Up::PosY));
        assert_eq!(state.files.iter().filter(|f| f.path == Path::new("/m/3.stl")).count(), 1);
    }
}
