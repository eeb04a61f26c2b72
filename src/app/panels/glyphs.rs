//! Glyphs: which there are, new ones, and what can be set for one.

use eframe::egui;
use eframe::egui::{RichText, Ui};

use super::params::params_ui;
use super::row::named_row;
use super::{Editing, command_button};
use crate::app::command::Command;
use crate::document::Glyph;
use crate::document::glyph::{Anchor, Shape};

/// The page. `hint`: what to do next while a glyph is being placed.
pub fn glyphs_ui(ui: &mut Ui, editing: &mut Editing<'_>, hint: Option<&str>) {
    ui.horizontal_wrapped(|ui| {
        for command in [Command::AddBox, Command::AddArrow, Command::AddPath, Command::AddLabel] {
            let is_enabled =
                command != Command::AddBox || editing.selection.lead_object(&editing.model.files).is_some();
            ui.add_enabled_ui(is_enabled, |ui| command_button(ui, command, editing.commands))
                .response
                .on_disabled_hover_text("Select an object first");
        }
    });
    if let Some(hint) = hint {
        ui.add(egui::Label::new(RichText::new(hint).strong()).wrap());
    }
    ui.add_space(4.0);
    if editing.document.glyphs.is_empty() {
        let text = "Boxes, arrows and labels point out what matters. They are drawn with the model and saved with the drawing.";
        ui.add(egui::Label::new(RichText::new(text).weak()).wrap());
    }
    let first = editing.model.files.nodes.len();
    for (index, glyph) in editing.document.glyphs.iter().enumerate() {
        let is_selected = editing.selection.contains(first + index);
        let row = ui.selectable_label(is_selected, format!("{}  ({})", glyph.name, glyph.shape.kind()));
        if row.clicked() {
            editing.selection.set(first + index);
        }
    }
    for warning in &editing.model.glyph_warnings {
        ui.add(egui::Label::new(RichText::new(warning.to_string()).color(ui.visuals().warn_fg_color)).wrap());
    }
    let selected = editing.selection.lead().and_then(|lead| lead.checked_sub(first));
    if let Some(index) = selected.filter(|i| *i < editing.document.glyphs.len()) {
        ui.separator();
        glyph_ui(ui, editing, index);
    }
}

fn glyph_ui(ui: &mut Ui, editing: &mut Editing<'_>, index: usize) {
    name_ui(ui, editing, index);
    let Some(glyph) = editing.document.glyphs.get_mut(index) else { return };
    match &mut glyph.shape {
        Shape::Box(shape) => {
            named_row(ui, "Around", "The object in the box", |ui, _| ui.label(&shape.node));
        }
        Shape::Path(shape) => {
            named_row(ui, "Points", "Corners of the path", |ui, _| ui.label(shape.points.len().to_string()));
        }
        Shape::Label(shape) => {
            named_row(ui, "Text", "What is written; Enter begins a new line", |ui, label| {
                let text = egui::TextEdit::multiline(&mut shape.text).desired_rows(1);
                ui.add(text.desired_width(f32::INFINITY)).labelled_by(label);
            });
            if let Anchor::Node(node) = &shape.anchor {
                named_row(ui, "Names", "The object at its middle", |ui, _| ui.label(node));
            }
        }
    }
    let mut usual = Glyph::new(String::new(), glyph.shape.usual());
    params_ui(ui, "glyph", &mut glyph.params(), &usual.params());
    let path = glyph.path();
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let node = editing.document.node_mut(&path);
        let mut visible = node.visible.unwrap_or(true);
        if ui.checkbox(&mut visible, "Visible").on_hover_text("Draw this glyph").changed() {
            node.visible = (!visible).then_some(false);
        }
        editing.document.tidy();
        command_button(ui, Command::Delete, editing.commands);
    });
    let more = "Its technique and lines are on the page Style.";
    ui.add(egui::Label::new(RichText::new(more).weak().small()).wrap());
}

/// The name, which is taken over once the person is done with it.
fn name_ui(ui: &mut Ui, editing: &mut Editing<'_>, index: usize) {
    let Some(name) = editing.document.glyphs.get(index).map(|g| g.name.clone()) else { return };
    named_row(ui, "Name", "Unique among glyphs", |ui, label| {
        let id = ui.make_persistent_id(("glyph name", &name));
        let mut typed = ui.data(|d| d.get_temp::<String>(id)).unwrap_or_else(|| name.clone());
        let response =
            ui.add(egui::TextEdit::singleline(&mut typed).desired_width(f32::INFINITY)).labelled_by(label);
        if response.lost_focus() {
            ui.data_mut(|d| d.remove_temp::<String>(id));
            editing.document.rename_glyph(index, &typed);
        } else if response.has_focus() {
            ui.data_mut(|d| d.insert_temp(id, typed));
        }
    });
}
