//! What became of a blueprint: its layers, and what of the designated objects they uncover.

use eframe::egui;
use eframe::egui::{RichText, Ui};

use super::row::capitalized;
use super::status::grouped;
use crate::render::{LayerMethod, LayerReport};

/// The most that the list of layers is high, in points.
const LIST_HEIGHT: f32 = 150.0;

/// Height of a row of that list, in points.
const ROW_HEIGHT: f32 = 14.0;

/// How far the last picture came, as far as that is known.
pub(super) fn layers_ui(ui: &mut Ui, (report, by): &(LayerReport, LayerMethod)) {
    let title = format!("Layers drawn: {}", report.layers);
    let heading = egui::CollapsingHeader::new(RichText::new(title).strong()).id_salt("layers drawn");
    let shown = heading.default_open(true).show(ui, |ui| {
        bars_ui(ui, report);
        let made = match by {
            LayerMethod::Lists => "from lists of fragments",
            LayerMethod::Peeling(_) => "by peeling",
        };
        let text = format!("Made {made}; ended by: {}", report.ended);
        ui.add(egui::Label::new(RichText::new(text).weak().small()).wrap());
        if report.masked > 0 {
            let uncovered = format!(
                "{:.1} % uncovered, {} of {} pixels; {:.0} % asked for",
                report.share_uncovered() * 100.0,
                grouped(report.uncovered() as usize),
                grouped(report.masked as usize),
                report.fraction * 100.0,
            );
            ui.add(egui::Label::new(uncovered).wrap());
        }
    });
    shown.header_response.on_hover_text("Of the picture that is seen, without its mirrors");
    for shortfall in by.shortfall().into_iter().chain(report.shortfall()) {
        let color = ui.visuals().warn_fg_color;
        ui.add(egui::Label::new(RichText::new(capitalized(&shortfall)).color(color)).wrap());
    }
}

/// A bar for each layer, as long as it has pixels.
fn bars_ui(ui: &mut Ui, report: &LayerReport) {
    let drawn = report.pixels.iter().zip(&report.passed).take(report.layers as usize);
    let most = drawn.clone().map(|(pixels, _)| *pixels).max().unwrap_or(1).max(1);
    egui::ScrollArea::vertical().id_salt("layers").max_height(LIST_HEIGHT).show(ui, |ui| {
        for (i, (pixels, passed)) in drawn.enumerate() {
            let mut text = format!("{}: {} px", i + 1, grouped(*pixels as usize));
            if report.masked > 0 {
                let share = f64::from(*passed) / f64::from(report.masked);
                text.push_str(&format!(", {:.0} % uncovered", share * 100.0));
            }
            let bar = egui::ProgressBar::new(*pixels as f32 / most as f32)
                .desired_height(ROW_HEIGHT)
                .corner_radius(2.0)
                .text(RichText::new(text).small());
            ui.add(bar);
        }
    });
}
