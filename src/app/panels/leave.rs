//! The question whether a changed drawing is to be saved before the window closes.

use eframe::egui;

/// What a person answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Save, then close.
    Save,
    /// Close; the changes are lost.
    Discard,
    /// Stay.
    Stay,
}

/// Asks; `name` is the drawing's file.
pub fn leave_ui(context: &egui::Context, name: &str) -> Option<Answer> {
    let mut answer = None;
    let modal = egui::Modal::new(egui::Id::unique("leave")).show(context, |ui| {
        ui.set_max_width(320.0);
        ui.heading("Save the changes?");
        ui.add_space(4.0);
        ui.label(format!("{name} has changed since it was saved."));
        ui.add_space(10.0);
        ui.horizontal(|ui| {
            let choices = [("Save", Answer::Save), ("Discard", Answer::Discard), ("Cancel", Answer::Stay)];
            for (text, choice) in choices {
                if ui.button(text).clicked() {
                    answer = Some(choice);
                }
            }
        });
    });
    if modal.should_close() { Some(Answer::Stay) } else { answer }
}
