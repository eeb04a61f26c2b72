//! What the picture shows before anything is open, while something loads and while files hang over it.

use eframe::egui;
use std::path::{Path, PathBuf};

use eframe::egui::{Align2, Color32, Rect, RichText, Ui};

use super::command_button;
use crate::app::command::Command;
use crate::import::Format;

/// Ink on the paper, whatever the theme of the panels is.
fn ink(strength: f32) -> Color32 {
    Color32::from_rgb(60, 58, 54).gamma_multiply(strength)
}

/// The invitation. Returns a recent file that was chosen.
pub fn empty_ui<'a>(
    ui: &mut Ui,
    area: Rect,
    recent: impl Iterator<Item = &'a Path>,
    commands: &mut Vec<Command>,
) -> Option<PathBuf> {
    let mut chosen = None;
    let size = egui::vec2(340.0_f32.min(area.width() - 20.0), 260.0);
    let place = Rect::from_center_size(area.center(), size);
    let mut child = ui.new_child(
        egui::UiBuilder::new().max_rect(place).layout(egui::Layout::top_down(egui::Align::Center)),
    );
    let ui = &mut child;
    ui.add_space(30.0);
    ui.label(RichText::new("Hachure").size(26.0).color(ink(0.9)));
    ui.add_space(8.0);
    command_button(ui, Command::Open, commands);
    ui.add_space(6.0);
    ui.label(RichText::new(format!("or drop a file here: {}", Format::names())).color(ink(0.7)));
    let recent: Vec<_> = recent.take(5).collect();
    if !recent.is_empty() {
        ui.add_space(14.0);
        ui.label(RichText::new("Recent").small().color(ink(0.6)));
        for path in recent {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
            let link = egui::Link::new(RichText::new(name).color(ink(0.85)));
            if ui.add(link).on_hover_text(path.display().to_string()).clicked() {
                chosen = Some(path.to_owned());
            }
        }
    }
    chosen
}

/// How far a load is. Returns whether it is to be canceled.
pub fn loading_ui(ui: &Ui, area: Rect, share: f32) -> bool {
    let mut canceled = false;
    egui::Area::new(egui::Id::unique("loading"))
        .order(egui::Order::Middle)
        .pivot(Align2::CENTER_TOP)
        .fixed_pos(area.center_top() + egui::vec2(0.0, 12.0))
        .show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.horizontal(|ui| {
                    ui.label("Loading");
                    ui.add(egui::ProgressBar::new(share).desired_width(160.0).desired_height(8.0));
                    canceled = ui.button("Cancel").clicked();
                });
            });
        });
    canceled
}

/// What would happen if the files were let go now.
pub fn hovering_ui(ui: &Ui, area: Rect, adding: bool) {
    let painter =
        ui.ctx().layer_painter(egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("drop")));
    painter.rect_filled(area, 0.0, Color32::from_black_alpha(120));
    let text = if adding { "Drop to add" } else { "Drop to open — hold Ctrl to add" };
    painter.text(
        area.center(),
        Align2::CENTER_CENTER,
        text,
        egui::FontId::proportional(22.0),
        Color32::WHITE,
    );
}
