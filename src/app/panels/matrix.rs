//! A 2×2 matrix: four numbers.

use eframe::egui::{self, Ui};

use crate::style::Matrix;

/// Four numbers, row by row.
pub(super) fn matrix_ui(ui: &mut Ui, matrix: &mut Matrix, most: f32, label: egui::Id, help: &str) {
    let [first, second] = &mut matrix.0;
    ui.vertical(|ui| {
        for row in [first, second] {
            ui.horizontal(|ui| {
                for number in row {
                    let drag = egui::DragValue::new(number).range(-most..=most).speed(0.02).max_decimals(2);
                    ui.add(drag).labelled_by(label).on_hover_text(help);
                }
            });
        }
    });
}
