//! One row per declared parameter: the only place where a slider is written.

use eframe::egui;
use eframe::egui::{RichText, Ui};

use crate::style::Value;
use crate::style::param::{Param, Slot};

/// Width of the column of names.
const LABEL_WIDTH: f32 = 104.0;

/// Width of the column of numbers.
const NUMBER_WIDTH: f32 = 58.0;

/// The part of a key before its last dot.
pub fn section_of(key: &str) -> &str {
    key.rsplit_once('.').map_or("", |(section, _)| section)
}

/// A section's heading: `edges.profile` → `Edges · profile`.
pub fn heading(section: &str) -> String {
    let mut words = section.split('.').map(spaced);
    let first = words.next().map(|w| capitalised(&w)).unwrap_or_default();
    std::iter::once(first).chain(words).collect::<Vec<_>>().join(" · ")
}

/// `face_normals` → `Face normals`.
pub fn label_of(name: &str) -> String {
    capitalised(&spaced(name))
}

fn spaced(name: &str) -> String {
    name.replace('_', " ")
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters
        .next()
        .map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}

/// Rows for all of `params`; sections of more than one part can be folded. `defaults` is the same list with the
/// values that a reset brings back. Returns the keys that changed, with their new values.
pub fn params_ui(
    ui: &mut Ui,
    salt: &str,
    params: &mut [Param<'_>],
    defaults: &[Param<'_>],
) -> Vec<(String, Value)> {
    let mut changes = Vec::new();
    let mut rest = params;
    while let Some(first) = rest.first() {
        let section = section_of(&first.key).to_owned();
        let count = rest.iter().take_while(|p| section_of(&p.key) == section).count();
        let (rows, others) = rest.split_at_mut(count);
        rest = others;
        let mut show = |ui: &mut Ui| {
            for param in rows.iter_mut() {
                let default = defaults.iter().find(|d| d.key == param.key).map(Param::value);
                if row_ui(ui, param, default.as_ref()) {
                    changes.push((param.key.clone(), param.value()));
                }
            }
        };
        if section.is_empty() || salt == section {
            show(ui);
        } else {
            section_ui(ui, salt, &section, &mut show);
        }
    }
    changes
}

fn section_ui(ui: &mut Ui, salt: &str, section: &str, show: &mut dyn FnMut(&mut Ui)) {
    ui.add_space(4.0);
    egui::CollapsingHeader::new(RichText::new(heading(section)).strong())
        .id_salt((salt, section))
        .default_open(true)
        .show_unindented(ui, |ui| show(ui));
}

/// One parameter. Returns whether it changed.
fn row_ui(ui: &mut Ui, param: &mut Param<'_>, default: Option<&Value>) -> bool {
    let changed_from_default = default.is_some_and(|d| *d != param.value());
    let mut help = format!("{}\n\n{}", param.help, param.key);
    if let (true, Some(default)) = (changed_from_default, default) {
        help.push_str(&format!("\ndefault {default}; double-click the name to go back"));
    }
    let before = param.value();
    let mut reset = false;
    ui.horizontal(|ui| {
        let label = label_ui(ui, param.label, changed_from_default).on_hover_text(&help);
        reset |= label.double_clicked();
        label.context_menu(|ui| {
            if ui.add_enabled(changed_from_default, egui::Button::new("Reset to default")).clicked() {
                reset = true;
            }
            if ui.button("Copy key").clicked() {
                ui.ctx().copy_text(param.key.clone());
            }
        });
        slot_ui(ui, param, label.id, &help);
    });
    if let (true, Some(default)) = (reset, default) {
        // A default always fits its own parameter.
        let _ = param.set(default);
    }
    param.value() != before
}

/// The name of a parameter, marked when it differs from the default.
fn label_ui(ui: &mut Ui, text: &str, marked: bool) -> egui::Response {
    let height = ui.spacing().interact_size.y;
    let (rect, response) = ui.allocate_exact_size(egui::vec2(LABEL_WIDTH, height), egui::Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, text));
    if ui.is_rect_visible(rect) {
        let visuals = ui.visuals();
        let color = if marked { visuals.strong_text_color() } else { visuals.text_color() };
        let font = egui::TextStyle::Body.resolve(ui.style());
        let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
        job.wrap = egui::text::TextWrapping::truncate_at_width(LABEL_WIDTH - 10.0);
        let galley = ui.painter().layout_job(job);
        let at = egui::pos2(rect.left() + 10.0, rect.center().y - galley.size().y * 0.5);
        if marked {
            let center = egui::pos2(rect.left() + 3.5, rect.center().y);
            ui.painter().circle_filled(center, 2.5, visuals.hyperlink_color);
        }
        ui.painter().galley(at, galley, color);
    }
    response
}

fn slot_ui(ui: &mut Ui, param: &mut Param<'_>, label: egui::Id, help: &str) {
    match &mut param.slot {
        Slot::Bool(value) => {
            ui.checkbox(value, "").labelled_by(label).on_hover_text(help);
        }
        Slot::Number { value, soft, hard } => {
            let gap = ui.spacing().item_spacing.x;
            ui.spacing_mut().slider_width = (ui.available_width() - NUMBER_WIDTH - gap).max(40.0);
            let slider = egui::Slider::new(&mut **value, soft.clone())
                .show_value(false)
                .trailing_fill(true)
                .clamping(egui::SliderClamping::Edits);
            ui.add(slider).labelled_by(label).on_hover_text(help);
            let speed = f64::from(soft.end() - soft.start()) / 200.0;
            let number = egui::DragValue::new(&mut **value)
                .range(hard.clone())
                .speed(speed)
                .custom_formatter(|n, _| short(n))
                .suffix(if param.unit.is_empty() { String::new() } else { format!(" {}", param.unit) });
            ui.add_sized([NUMBER_WIDTH, ui.spacing().interact_size.y], number)
                .labelled_by(label)
                .on_hover_text(help);
        }
        Slot::Color(color) => {
            let button = ui.color_edit_button_srgb(&mut color.0);
            button.labelled_by(label).on_hover_text(help);
            ui.label(RichText::new(color.to_string()).weak());
        }
        Slot::Choice(choice) => {
            let (names, mut current) = (choice.names(), choice.name());
            let combo = egui::ComboBox::from_id_salt(&param.key)
                .width(ui.available_width())
                .selected_text(label_of(current))
                .show_ui(ui, |ui| {
                    for name in names {
                        ui.selectable_value(&mut current, *name, label_of(name));
                    }
                });
            combo.response.labelled_by(label).on_hover_text(help);
            if current != choice.name() {
                choice.choose(current);
            }
        }
    }
}

/// At most three decimals and no trailing zeros.
fn short(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A row with a name like those of parameters.
pub fn named_row<R>(ui: &mut Ui, name: &str, help: &str, add: impl FnOnce(&mut Ui, egui::Id) -> R) -> R {
    ui.horizontal(|ui| {
        let label = label_ui(ui, name, false).on_hover_text(help);
        add(ui, label.id)
    })
    .inner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_become_headings() {
        assert_eq!(section_of("edges.profile.gain"), "edges.profile");
        assert_eq!(section_of("technique"), "");
        assert_eq!(heading("edges.profile"), "Edges · profile");
        assert_eq!(label_of("face_normals"), "Face normals");
    }
}
