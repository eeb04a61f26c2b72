//! A row for two parameters that are the ends of one range.

use std::ops::RangeInclusive;

use eframe::egui;
use eframe::egui::Ui;

use super::icons;
use super::row::{Change, RESET_WIDTH, Row, label_ui};
use crate::style::Value;
use crate::style::param::Slot;

/// Room for one of the two numbers.
const NUMBER_WIDTH: f32 = 30.0;

/// One slider with two handles, between two numbers. Returns the changes.
pub(super) fn span_ui<'p, 'a>(ui: &mut Ui, mut ends: [&mut Row<'p, 'a>; 2]) -> Vec<Change> {
    let [Some((mut from, range)), Some((mut to, _))] = ends.each_ref().map(|end| whole(end)) else {
        return ends.into_iter().filter_map(|end| end.ui(ui)).collect();
    };
    let before = [from, to];
    let name = ends[0].param.span.unwrap_or(ends[0].param.label);
    let help = ends.each_ref().map(|end| end.help()).join("\n\n");
    let mut changes = Vec::new();
    ui.horizontal(|ui| {
        let differs = ends.iter().any(|end| end.differs());
        let color = if differs { ui.visuals().strong_text_color() } else { ui.visuals().text_color() };
        let label = label_ui(ui, name, color).on_hover_text(&help);
        let mut resets = label.double_clicked();
        if differs {
            let at = egui::Rect::from_min_size(label.rect.min, egui::vec2(RESET_WIDTH, label.rect.height()));
            let name = format!("Reset {name}");
            resets |= icons::reset(ui, at, label.id.with("reset"), &name).on_hover_text(&name).clicked();
        }
        label.context_menu(|ui| {
            resets |= ui.add_enabled(differs, egui::Button::new("Reset")).clicked();
            if ui.button("Copy keys").clicked() {
                ui.ctx().copy_text(ends.each_ref().map(|end| end.param.key.clone()).join(" "));
            }
        });
        if resets {
            changes.extend(ends.iter_mut().filter_map(|end| end.reset()));
        }
        let gap = ui.spacing().item_spacing.x;
        ui.spacing_mut().interact_size.x = NUMBER_WIDTH;
        ui.spacing_mut().slider_width = (ui.available_width() - 2.0 * (NUMBER_WIDTH + gap)).max(40.0);
        let slider = egui::RangeSlider::new(&mut from, &mut to, range).clamping(egui::SliderClamping::Edits);
        ui.add(slider).labelled_by(label.id).on_hover_text(&help);
    });
    for ((end, before), now) in ends.iter_mut().zip(before).zip([from, to]) {
        if now != before {
            changes.extend(end.set(&Value::Number(f64::from(now))));
        }
    }
    changes
}

fn whole(row: &Row<'_, '_>) -> Option<(u32, RangeInclusive<u32>)> {
    match &row.param.slot {
        Slot::Integer { value, range } => Some((**value, range.clone())),
        _ => None,
    }
}
