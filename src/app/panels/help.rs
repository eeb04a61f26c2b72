//! The list of mouse and key actions, and the list of warnings.

use eframe::egui;
use eframe::egui::{RichText, Ui};
use strum::IntoEnumIterator as _;

use crate::app::command::{Command, CommandGroup};
use crate::scene::Warning;

/// What the mouse does in the picture.
const MOUSE: [(&str, &str); 9] = [
    ("Drag", "Turn"),
    ("Shift + drag, middle drag", "Move"),
    ("Ctrl + drag", "Roll"),
    ("Wheel, pinch", "Zoom to the pointer"),
    ("Right drag", "Zoom"),
    ("Click", "Select"),
    ("Shift or Ctrl + click", "Add to the selection"),
    ("Double click, middle click", "Turn about this point"),
    ("Drop a file (with Ctrl)", "Open (add) it"),
];

/// The window with the list of keys.
pub fn help_ui(context: &egui::Context, open: &mut bool) {
    let width = 640.0_f32.min(context.content_rect().width() - 40.0);
    egui::Window::new("Mouse and keys")
        .open(open)
        .resizable(false)
        .collapsible(false)
        .fixed_size([width, (context.content_rect().height() - 100.0).min(660.0)])
        .pivot(egui::Align2::CENTER_CENTER)
        .default_pos(context.content_rect().center())
        .show(context, |ui| {
            egui::ScrollArea::vertical().auto_shrink([false, true]).show(ui, |ui| {
                ui.columns(2, |columns| {
                    let [left, right] = columns else { return };
                    list(
                        left,
                        "Mouse in the picture",
                        MOUSE.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())),
                    );
                    for group in CommandGroup::iter() {
                        let column = if matches!(group, CommandGroup::File | CommandGroup::Edit) {
                            &mut *left
                        } else {
                            &mut *right
                        };
                        let rows: Vec<_> = Command::of(group).filter_map(|c| keys_of(column, c)).collect();
                        list(column, group.title(), rows.into_iter());
                    }
                });
            });
        });
}

fn keys_of(ui: &Ui, command: Command) -> Option<(String, String)> {
    let keys: Vec<_> = command.shortcuts().iter().map(|s| ui.ctx().format_shortcut(s)).collect();
    (!keys.is_empty()).then(|| (keys.join(", "), command.text().trim_end_matches('…').to_owned()))
}

fn list(ui: &mut Ui, title: &str, rows: impl Iterator<Item = (String, String)>) {
    ui.add_space(4.0);
    ui.label(RichText::new(title).strong());
    egui::Grid::new(title).num_columns(2).spacing([12.0, 2.0]).min_col_width(104.0).show(ui, |ui| {
        for (keys, what) in rows {
            ui.label(RichText::new(keys).weak());
            ui.label(what);
            ui.end_row();
        }
    });
    ui.add_space(4.0);
}

/// The window with what could not be loaded.
pub fn warnings_ui(context: &egui::Context, open: &mut bool, warnings: &[Warning]) {
    egui::Window::new("Warnings")
        .open(open)
        .collapsible(false)
        .default_size([520.0, 240.0])
        .pivot(egui::Align2::CENTER_CENTER)
        .default_pos(context.content_rect().center())
        .show(context, |ui| {
            if warnings.is_empty() {
                ui.label("Everything in the files could be loaded.");
                return;
            }
            ui.weak("What could be loaded is shown; this could not, or was repaired:");
            ui.add_space(4.0);
            egui::ScrollArea::vertical().auto_shrink([false, true]).show(ui, |ui| {
                for warning in warnings {
                    ui.add(egui::Label::new(RichText::new(&warning.place).weak().small()).wrap());
                    ui.add(egui::Label::new(&warning.message).wrap());
                    ui.add_space(6.0);
                }
            });
            ui.separator();
            if ui.button("Copy all").clicked() {
                let all: Vec<_> = warnings.iter().map(ToString::to_string).collect();
                ui.ctx().copy_text(all.join("\n"));
            }
        });
}
