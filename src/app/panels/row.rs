//! One row per declared parameter: the only place where a slider is written.

use eframe::egui;
use std::path::PathBuf;

use eframe::egui::{Color32, RichText, Ui, WidgetText};

use super::{curve, icons, matrix};
use crate::style::Value;
use crate::style::param::{Param, Slot, StyleField};

/// Width of the column of names.
const LABEL_WIDTH: f32 = 122.0;

/// Least width of the column of numbers.
const NUMBER_WIDTH: f32 = 58.0;

/// Width of a button that resets.
pub const RESET_WIDTH: f32 = 14.0;

/// How clearly a value is seen that is inherited.
const INHERITED_OPACITY: f32 = 0.55;

/// What a row asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// The parameter of this key was changed to this value.
    Set(String, Value),
    /// A file is to be chosen for the parameter of this key.
    ChooseFile(String),
}

/// `face_normals` → `Face normals`.
pub fn label_of(name: &str) -> String {
    capitalized(&spaced(name))
}

/// `face_normals` → `face normals`.
pub fn spaced(name: &str) -> String {
    name.replace('_', " ")
}

/// With a capital first letter.
pub fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters
        .next()
        .map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}

/// A parameter and what a reset brings back.
pub struct Row<'p, 'a> {
    /// The parameter.
    pub param: &'p mut Param<'a>,
    /// That of the preset, or else the default: a value of its own, or that it inherits.
    pub default: Value,
}

impl Row<'_, '_> {
    /// Whether a reset would change it.
    pub fn differs(&self) -> bool {
        self.param.own() != self.default
    }

    /// Brings that back.
    pub fn reset(&mut self) -> Option<Change> {
        let default = self.default.clone();
        self.set(&default)
    }

    /// Sets it.
    pub fn set(&mut self, value: &Value) -> Option<Change> {
        // A default always fits its own parameter, and only what inherits is asked to.
        self.param.set(value).ok().map(|()| Change::Set(self.param.key.clone(), value.clone()))
    }

    /// What the pointer is told.
    pub fn help(&self) -> String {
        let param = &self.param;
        let mut help = format!("{}\n\n{}", param.help, param.key);
        if let (true, Some(other)) = (param.slot.is_inherited(), param.slot.inherits()) {
            help.push_str(&format!("\nas {other}, until it is changed here"));
        }
        if self.differs() {
            help.push_str(&format!("\nresets to {}", self.default));
        }
        help
    }

    /// Name, value and what it takes to change it. Returns the change.
    pub fn ui(&mut self, ui: &mut Ui) -> Option<Change> {
        let before = self.param.own();
        let mut help = self.help();
        if self.differs() {
            help.push_str("; double-click the name to go back");
        }
        let mut asked = None;
        ui.horizontal(|ui| {
            let inherited = self.param.slot.is_inherited();
            let color = match (self.differs(), inherited) {
                (_, true) => ui.visuals().weak_text_color(),
                (true, false) => ui.visuals().strong_text_color(),
                (false, false) => ui.visuals().text_color(),
            };
            let label = label_ui(ui, self.param.label, color).on_hover_text(&help);
            if label.double_clicked() {
                asked = self.reset();
            }
            label.context_menu(|ui| asked = self.menu_ui(ui));
            if self.differs() {
                let at =
                    egui::Rect::from_min_size(label.rect.min, egui::vec2(RESET_WIDTH, label.rect.height()));
                let name = format!("Reset {}", self.param.label);
                if icons::reset(ui, at, label.id.with("reset"), &name).on_hover_text(&name).clicked() {
                    asked = self.reset();
                }
            }
            if inherited {
                ui.multiply_opacity(INHERITED_OPACITY);
            }
            if slot_ui(ui, self.param, label.id, &help) {
                asked = Some(Change::ChooseFile(self.param.key.clone()));
            }
        });
        let after = self.param.own();
        asked.or_else(|| (after != before).then(|| Change::Set(self.param.key.clone(), after)))
    }

    /// What can be done with the parameter beside changing it. Returns the change.
    pub fn menu_ui(&mut self, ui: &mut Ui) -> Option<Change> {
        let mut change = None;
        if self.default != Value::Inherit
            && ui.add_enabled(self.differs(), egui::Button::new("Reset")).clicked()
        {
            change = self.reset();
        }
        if let Some(other) = self.param.slot.inherits() {
            let text = format!("Inherit {}", spaced(other));
            let is_own = !self.param.slot.is_inherited();
            if ui.add_enabled(is_own, egui::Button::new(text)).clicked() {
                change = self.set(&Value::Inherit);
            }
        }
        if ui.button("Copy key").clicked() {
            ui.ctx().copy_text(self.param.key.clone());
        }
        change
    }

    /// The switch of a section, for its heading. Returns the change.
    pub fn head_ui(&mut self, ui: &mut Ui) -> Option<Change> {
        let help = self.help();
        let inherited = self.param.slot.is_inherited();
        let Slot::Bool(place) = &mut self.param.slot else {
            return None;
        };
        let response = ui.scope(|ui| {
            if inherited {
                ui.multiply_opacity(INHERITED_OPACITY);
            }
            switch_ui(ui, place)
        });
        let response = response.inner.accessible_name(self.param.label).on_hover_text(help);
        response.changed().then(|| Change::Set(self.param.key.clone(), self.param.own()))
    }
}

/// A row with a name like those of parameters.
pub fn named_row<R>(ui: &mut Ui, name: &str, help: &str, add: impl FnOnce(&mut Ui, egui::Id) -> R) -> R {
    ui.horizontal(|ui| {
        let label = label_ui(ui, name, ui.visuals().text_color()).on_hover_text(help);
        add(ui, label.id)
    })
    .inner
}

/// The name of a parameter, behind room for a button that resets.
pub fn label_ui(ui: &mut Ui, text: &str, color: Color32) -> egui::Response {
    let height = ui.spacing().interact_size.y;
    let (rect, response) = ui.allocate_exact_size(egui::vec2(LABEL_WIDTH, height), egui::Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, text));
    if ui.is_rect_visible(rect) {
        let font = egui::TextStyle::Body.resolve(ui.style());
        let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
        job.wrap = egui::text::TextWrapping::truncate_at_width(LABEL_WIDTH - RESET_WIDTH);
        let galley = ui.painter().layout_job(job);
        let at = egui::pos2(rect.left() + RESET_WIDTH, rect.center().y - galley.size().y * 0.5);
        ui.painter().galley(at, galley, color);
    }
    response
}

fn switch_ui(ui: &mut Ui, place: &mut StyleField<'_, bool>) -> egui::Response {
    let mut value = place.get();
    let response = ui.checkbox(&mut value, "");
    if response.changed() {
        place.set(value);
    }
    response
}

/// A slider with its number beside it.
struct NumberSlider<'a> {
    soft: std::ops::RangeInclusive<f64>,
    hard: std::ops::RangeInclusive<f64>,
    is_whole: bool,
    unit: &'a str,
}

impl NumberSlider<'_> {
    fn ui(self, ui: &mut Ui, value: &mut f64, label: egui::Id, help: &str) {
        let gap = ui.spacing().item_spacing.x;
        let span = self.soft.end() - self.soft.start();
        let (speed, decimals) = (span / 200.0, decimals_of(span));
        let suffix = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let width = number_width(ui, label, format!("{}{suffix}", short(*value, decimals)));
        ui.spacing_mut().slider_width = (ui.available_width() - width - gap).max(40.0);
        let mut slider = egui::Slider::new(value, self.soft.clone())
            .show_value(false)
            .trailing_fill(true)
            .clamping(egui::SliderClamping::Edits);
        if self.is_whole {
            slider = slider.integer();
        }
        ui.add(slider).labelled_by(label).on_hover_text(help);
        let mut number = egui::DragValue::new(value)
            .range(self.hard)
            .speed(speed)
            .custom_formatter(move |n, _| short(n, decimals))
            .suffix(suffix);
        if self.is_whole {
            number = number.fixed_decimals(0);
        }
        ui.add_sized([width, ui.spacing().interact_size.y], number).labelled_by(label).on_hover_text(help);
    }
}

/// Room for a number, as wide as its row ever needed: where it did not fit, the panel would grow with it.
fn number_width(ui: &Ui, row: egui::Id, text: String) -> f32 {
    let galley = WidgetText::from(text).into_galley(ui, None, f32::INFINITY, egui::TextStyle::Button);
    let needed = (galley.size().x + 2.0 * ui.spacing().button_padding.x).ceil();
    let id = row.with("width of the number");
    let widest = ui.data(|d| d.get_temp::<f32>(id)).unwrap_or(NUMBER_WIDTH).max(needed);
    ui.data_mut(|d| d.insert_temp(id, widest));
    widest
}

/// The name of a file, behind which a dialog opens, and a button that lets go of it. Returns whether another file is
/// asked for.
fn file_ui(ui: &mut Ui, file: &mut Option<PathBuf>, label: egui::Id, help: &str) -> bool {
    let height = ui.spacing().interact_size.y;
    let gap = ui.spacing().item_spacing.x;
    let name = file.as_deref().map(|path| path.file_name().unwrap_or(path.as_os_str()).to_string_lossy());
    let width = ui.available_width() - if name.is_some() { height + gap } else { 0.0 };
    let text = name.map_or_else(|| RichText::new("Choose…").weak(), RichText::new);
    let button = egui::Button::new(text).truncate();
    let hint =
        file.as_deref().map_or_else(|| help.to_owned(), |path| format!("{}\n\n{help}", path.display()));
    let asked = ui.add_sized([width, height], button).labelled_by(label).on_hover_text(hint).clicked();
    if file.is_some() {
        let clear = egui::Button::new("×").min_size(egui::vec2(height, height));
        if ui.add(clear).accessible_name("No image").on_hover_text("No image").clicked() {
            *file = None;
        }
    }
    asked
}

/// Returns whether a file is asked for.
fn slot_ui(ui: &mut Ui, param: &mut Param<'_>, label: egui::Id, help: &str) -> bool {
    match &mut param.slot {
        Slot::Bool(place) => {
            switch_ui(ui, place).labelled_by(label).on_hover_text(help);
        }
        Slot::Number { value: place, soft, hard } => {
            let wide = |r: &std::ops::RangeInclusive<f32>| f64::from(*r.start())..=f64::from(*r.end());
            let before = f64::from(place.get());
            let mut value = before;
            let number =
                NumberSlider { soft: wide(soft), hard: wide(hard), is_whole: false, unit: param.unit };
            number.ui(ui, &mut value, label, help);
            if value != before {
                place.set(value as f32);
            }
        }
        Slot::Integer { value: place, range } => {
            let range = f64::from(*range.start())..=f64::from(*range.end());
            let mut value = f64::from(**place);
            let number = NumberSlider { soft: range.clone(), hard: range, is_whole: true, unit: param.unit };
            number.ui(ui, &mut value, label, help);
            **place = value.round() as u32;
        }
        Slot::File(file) => return file_ui(ui, file, label, help),
        Slot::Matrix { value, most } => {
            let field = matrix::Field { label: param.label, unit: param.unit, help, most: *most, id: label };
            field.ui(ui, value);
        }
        Slot::Curve(curve) => {
            curve::Field { label: param.label, help, id: label }.ui(ui, curve);
        }
        Slot::Color(place) => {
            let mut color = place.get();
            let button = ui.color_edit_button_srgb(&mut color.0);
            button.labelled_by(label).on_hover_text(help);
            ui.label(RichText::new(color.to_string()).weak());
            if color != place.get() {
                place.set(color);
            }
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
    false
}

/// How many decimals a number has whose slider spans so much.
fn decimals_of(span: f64) -> usize {
    let digits = span.log10().floor();
    let decimals = if digits < 0.0 { (2.0 - digits).clamp(3.0, 9.0) } else { (4.0 - digits).clamp(0.0, 3.0) };
    decimals as usize
}

/// At most so many decimals and no trailing zeros.
fn short(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_numbers_are_written_for_people() {
        assert_eq!(label_of("face_normals"), "Face normals");
        assert_eq!(["2.5", "30", "0.1"], [2.5, 30.0, 0.1_f32.into()].map(|n| short(n, decimals_of(1.0))));
        assert_eq!([5e4, 360.0, 20.0, 0.5, 0.02].map(decimals_of), [0, 2, 3, 3, 4]);
        assert_eq!((short(0.00015, decimals_of(0.002)), decimals_of(0.0)), ("0.00015".to_owned(), 9));
    }
}
