//! The section plane: its parameters, with a slider that reaches over the model.

use eframe::egui::{self, RichText, Ui};

use super::Editing;
use super::params::params_ui;
use crate::document::SectionSettings;
use crate::document::section::without_caps;
use crate::scene::Unit;
use crate::style::param;

/// The section of the page.
pub fn section_ui(ui: &mut Ui, editing: &mut Editing<'_>) {
    let (scene, bounds) = (&editing.model.scene, &editing.model.bounds);
    let up = editing.document.up(scene);
    let unit = editing.document.meters_per_unit(scene).and_then(Unit::of).map_or("", |unit| unit.symbol);
    let fault = editing.document.section_fault(up, bounds);
    let section = &mut editing.document.section;
    let [low, high] = section.range(up, bounds).map(|at| at as f32);
    let mut default = SectionSettings { axis: section.axis, cap: section.cap, ..SectionSettings::default() };
    let defaults = default.params_within(low..=high, unit);
    let mut params = section.params_within(low..=high, unit);
    param::retain_relevant(&mut params);
    params_ui(ui, "view", &mut params, &defaults);
    for fault in fault.into_iter().chain(without_caps(editing.viewport.open_bodies())) {
        ui.add(egui::Label::new(RichText::new(fault.message).weak().small()).wrap());
    }
}
