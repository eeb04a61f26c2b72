//! Closing the window: a drawing that has a file is not lost without a question.

use eframe::egui;

use super::command::Command;
use super::panels::leave;
use super::viewer::Viewer;
use crate::document::Document;

/// How far closing the window has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Leaving {
    /// Nobody wants to.
    #[default]
    No,
    /// The question is on the screen.
    Asked,
    /// As soon as the drawing is saved.
    AfterSaving,
    /// Now, whatever is lost.
    Now,
}

/// Whether a drawing differs from what its file holds. A file without a camera says nothing about the view.
pub(super) fn is_changed(saved: &Document, document: &Document) -> bool {
    let camera = saved.camera.or(document.camera);
    Document { camera, ..saved.clone() } != *document
}

impl Viewer {
    /// Asks before a drawing that has a file is closed with changes.
    pub(super) fn leave(&mut self, context: &egui::Context) {
        let Some((path, saved)) = &self.saved else { return };
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_changed = is_changed(saved, &self.document);
        if context.input(|i| i.viewport().close_requested()) && is_changed && self.leaving != Leaving::Now {
            context.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            self.leaving = Leaving::Asked;
        }
        if self.leaving == Leaving::Asked {
            match leave::leave_ui(context, &name) {
                Some(leave::Answer::Save) => {
                    self.leaving = Leaving::AfterSaving;
                    self.commands.push(Command::Save);
                }
                Some(leave::Answer::Discard) => {
                    self.leaving = Leaving::Now;
                    context.send_viewport_cmd(egui::ViewportCommand::Close);
                }
                Some(leave::Answer::Stay) => self.leaving = Leaving::No,
                None => {}
            }
        }
    }
}
