//! The line below the picture.

use eframe::egui;
use eframe::egui::Ui;

use crate::app::command::Command;
use crate::app::loading::Model;
use crate::app::selection::Selection;
use crate::document::Document;

/// What the line tells.
pub struct Status<'a> {
    /// The loaded scene.
    pub model: &'a Model,
    /// What the person is to do next.
    pub hint: Option<&'static str>,
    /// How many warnings there are.
    pub warnings: usize,
    /// The document.
    pub document: &'a Document,
    /// The selected nodes.
    pub selection: &'a Selection,
    /// Milliseconds of the last picture, if they are to be shown.
    pub milliseconds: Option<f64>,
    /// Name of the graphics driver.
    pub adapter: &'a str,
    /// Samples of the picture at rest, and how many it is to have; `None` when it is complete.
    pub refining: Option<(u32, u32)>,
    /// Share of a screenshot that is done, while one is made.
    pub saving: Option<f32>,
    /// Share of the intersections that are found, while they are looked for.
    pub intersections: Option<f32>,
    /// Share of the strokes of hatching that are found, while they are looked for.
    pub hatching: Option<f32>,
    /// Share of the strokes that styles describe that are drawn, while they are drawn.
    pub strokes: Option<f32>,
}

/// Work that is not wanted any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Canceled {
    /// A screenshot.
    Saving,
    /// Intersections.
    Intersections,
    /// Strokes of hatching.
    Hatching,
    /// Strokes that styles describe.
    Strokes,
}

/// A number with its thousands set apart.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// The line. Returns what is not wanted any more.
pub fn status_ui(ui: &mut Ui, status: &Status<'_>, commands: &mut Vec<Command>) -> Option<Canceled> {
    let mut canceled = None;
    ui.horizontal_centered(|ui| {
        let scene = &status.model.scene;
        if let Some(hint) = status.hint {
            ui.strong(hint);
        } else if !scene.nodes.is_empty() {
            let objects = scene.nodes.iter().filter(|n| n.mesh.is_some()).count();
            let triangles = status.model.triangle_count(0..scene.nodes.len());
            let plural = if objects == 1 { "" } else { "s" };
            ui.label(format!("{objects} object{plural}, {} triangles", grouped(triangles)));
        }
        if status.hint.is_none()
            && let Some(lead) = status.selection.lead().and_then(|n| scene.nodes.get(n))
        {
            ui.separator();
            let more = status.selection.len() - 1;
            let text = if more > 0 { format!("{} and {more} more", lead.path) } else { lead.path.clone() };
            ui.add(egui::Label::new(text).truncate());
        }
        let count = status.warnings;
        if count > 0 {
            ui.separator();
            let text = format!("{count} warning{}", if count == 1 { "" } else { "s" });
            if ui.link(text).on_hover_text(Command::Warnings.tooltip()).clicked() {
                commands.push(Command::Warnings);
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if let Some(milliseconds) = status.milliseconds {
                ui.label(format!("{milliseconds:.1} ms"))
                    .on_hover_text(format!("Time for the last picture with {}", status.adapter));
            } else {
                let help = ui.link("Mouse and keys: F1").on_hover_text(Command::Help.tooltip());
                if help.clicked() {
                    commands.push(Command::Help);
                }
            }
            if let Some((samples, of)) = status.refining {
                ui.separator();
                ui.weak(format!("{samples}/{of}"))
                    .on_hover_text("The picture gets smoother while nothing moves: samples per pixel so far");
            }
            if let Some(share) = status.saving {
                ui.separator();
                if ui.link("Cancel").on_hover_text("Save no picture").clicked() {
                    canceled = Some(Canceled::Saving);
                }
                ui.label(format!("Saving a picture, {:.0} %", share * 100.0));
            }
            if let Some(share) = status.intersections {
                ui.separator();
                if ui.link("Cancel").on_hover_text("Leave intersections as pixels show them").clicked() {
                    canceled = Some(Canceled::Intersections);
                }
                ui.label(format!("Finding where surfaces run through each other, {:.0} %", share * 100.0));
            }
            if let Some(share) = status.hatching {
                ui.separator();
                if ui.link("Cancel").on_hover_text("Leave strokes on the paper").clicked() {
                    canceled = Some(Canceled::Hatching);
                }
                ui.label(format!("Strokes lie on the paper until they are found, {:.0} %", share * 100.0));
            }
            if let Some(share) = status.strokes {
                ui.separator();
                if ui.link("Cancel").on_hover_text("Draw with the strokes of a pen").clicked() {
                    canceled = Some(Canceled::Strokes);
                }
                ui.label(format!("A pen's strokes until these are drawn, {:.0} %", share * 100.0));
            }
        });
    });
    canceled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_set_apart() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(1_234), "1,234");
        assert_eq!(grouped(123_456_789), "123,456,789");
    }
}
