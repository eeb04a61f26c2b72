//! The question whether a changed drawing is to be saved before it goes.

use eframe::egui;

/// What a person answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Save, then go on.
    Save,
    /// Go on; the changes are lost.
    Discard,
    /// Stay.
    Stay,
}

/// Asks; `name` is that of the drawing's file, or of its model where it has no file. Enter answers with the
/// highlighted button, Esc stays.
pub fn leave_ui(context: &egui::Context, name: &str, has_file: bool) -> Option<Answer> {
    let mut answer = None;
    let modal = egui::Modal::new(egui::Id::unique("leave")).show(context, |ui| {
        ui.set_max_width(320.0);
        ui.heading("Save the changes?");
        ui.add_space(4.0);
        ui.label(if has_file {
            format!("{name} has changed since it was saved.")
        } else {
            format!("What you changed in the drawing of {name} is in no file yet.")
        });
        ui.add_space(10.0);
        ui.horizontal(|ui| {
            let choices = [("Save", Answer::Save), ("Don't save", Answer::Discard), ("Cancel", Answer::Stay)];
            let buttons = choices.map(|(text, choice)| {
                let button = ui.button(text);
                if button.clicked() {
                    answer = Some(choice);
                }
                button
            });
            // The focus is what highlights a button and lets Enter press it; a click beside the buttons takes it away.
            if !buttons.iter().any(egui::Response::has_focus) {
                buttons[0].request_focus();
            }
        });
    });
    if modal.should_close() { Some(Answer::Stay) } else { answer }
}
