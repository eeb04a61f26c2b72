//! Before a drawing goes, because the window closes or something else is opened, the person is asked whether to save
//! what would be lost.

use std::path::PathBuf;

use eframe::egui;

use super::{DialogFor, Viewer};
use crate::app::command::Command;
use crate::app::loading::Intent;
use crate::app::panels::leave::{self, Answer};
use crate::app::unsaved::{Leaving, Replacement};

impl Viewer {
    /// Whether the person changed something that is in no file.
    pub fn is_unsaved(&self) -> bool {
        // Without objects and without a file there is nothing yet that could be saved.
        let is_drawing = self.saved.file.is_some() || !self.model.scene.nodes.is_empty();
        is_drawing && self.saved.differs_from(&self.document)
    }

    /// Whether the question is on the screen; then nothing behind it acts.
    pub(super) fn is_asking(&self) -> bool {
        matches!(self.leaving, Leaving::Asked(_))
    }

    /// Lets something take the drawing's place, or asks first if anything would be lost that the person has not given up.
    pub(super) fn leave_for(&mut self, context: &egui::Context, next: Replacement) {
        if self.is_unsaved() && self.given_up.as_ref() != Some(&self.document) {
            self.leaving = Leaving::Asked(next);
            context.request_repaint();
            return;
        }
        self.leaving = Leaving::No;
        match next {
            Replacement::Close => context.send_viewport_cmd(egui::ViewportCommand::Close),
            Replacement::Choose => self.ask_for_file(context, DialogFor::Open),
            Replacement::Open(files) => self.start_loading(context, files, Intent::Open),
            Replacement::Show(loaded) => self.show_loaded(*loaded),
        }
    }

    /// What the drawing was to be left for does not come.
    pub(super) fn stay(&mut self) {
        if !self.is_asking() {
            self.leaving = Leaving::No;
        }
        self.given_up = None;
    }

    /// Goes on with what waited until the drawing was saved.
    pub(super) fn go_on_after_saving(&mut self, context: &egui::Context) {
        match std::mem::take(&mut self.leaving) {
            // It may have been changed while it was being saved.
            Leaving::AfterSaving(next) => self.leave_for(context, next),
            other => self.leaving = other,
        }
    }

    /// Holds the window open as long as the person has not answered.
    pub(super) fn hold_open(&mut self, context: &egui::Context) {
        let is_closing = context.input(|i| i.viewport().close_requested());
        if is_closing && self.is_unsaved() && self.given_up.as_ref() != Some(&self.document) {
            context.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            self.leaving = Leaving::Asked(Replacement::Close);
        }
    }

    /// Shows the question and heeds the answer.
    pub(super) fn question_ui(&mut self, context: &egui::Context) {
        if !self.is_asking() {
            return;
        }
        let Some(answer) = leave::leave_ui(context, &self.file_name(), self.saved.file.is_some()) else {
            return;
        };
        let Leaving::Asked(next) = std::mem::take(&mut self.leaving) else { return };
        match answer {
            Answer::Save => {
                self.leaving = Leaving::AfterSaving(next);
                self.commands.push(Command::Save);
            }
            Answer::Discard => {
                self.given_up = Some(self.document.clone());
                self.leave_for(context, next);
            }
            Answer::Stay => self.stay(),
        }
    }

    /// The name of the drawing's file or of its first model.
    pub(super) fn file_name(&self) -> String {
        let path: Option<&PathBuf> = self.saved.file.as_ref().or(self.document.models.first());
        let name = path.and_then(|p| p.file_name());
        name.map_or_else(|| "The drawing".to_owned(), |n| n.to_string_lossy().into_owned())
    }
}
