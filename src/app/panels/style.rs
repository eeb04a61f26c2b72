//! The look of the selection, or of everything that has no style of its own.

use eframe::egui;
use eframe::egui::{RichText, Ui};

use super::layers::layers_ui;
use super::outliner::{inherit, style_name};
use super::params::params_ui;
use super::row::{Change, named_row};
use super::{Choosing, Editing};
use crate::document::Document;
use crate::scene::{Node, NodeId, Scene};
use crate::style::param::Scope;
use crate::style::{Style, StyleError, Value, param};

/// The most that the list of presets is high, in points: all of them are seen at once.
const PRESETS_HEIGHT: f32 = 720.0;

/// The page.
pub fn style_ui(ui: &mut Ui, editing: &mut Editing<'_>) {
    let targets = editing.selection.topmost(&editing.model.scene);
    let lead = editing.selection.lead();
    let scene = editing.model.scene.clone();
    let resolved = editing.document.resolve(&scene);
    let roles = lead.and_then(|lead| resolved.get(lead));
    let mut style = roles.map_or(&editing.document.style, |r| r.style).clone();
    let is_mirror = roles.is_some_and(|r| r.mirror);

    let has_own = targets.iter().any(|&n| {
        let node = scene.nodes.get(n).and_then(|n| editing.document.nodes.get(&n.path));
        node.is_some_and(|n| n.style.is_some())
    });
    title_ui(ui, editing, has_own);
    if ui_inherit(ui, &targets, has_own) {
        inherit(editing.document, &scene, &targets);
        return;
    }
    if let Some(preset) = preset_ui(ui, editing, &style) {
        if targets.is_empty() {
            editing.document.style = preset;
        } else {
            editing.document.set_style(&scene, &targets, &preset);
        }
        return;
    }

    if let Some(report) = editing.viewport.last_layer_report(&style) {
        layers_ui(ui, report);
    }

    let made_from = editing.presets.iter().find(|preset| Some(&preset.id) == style.made_from.0.as_ref());
    let mut default = made_from.map_or_else(Style::default, |preset| preset.style.clone());
    let defaults = default.params();
    let mut params = style.params();
    param::retain_relevant(&mut params);
    let has_mask = editing.document.has_mask(&scene);
    params.retain(|param| match param.scope {
        Scope::Objects => true,
        Scope::Drawing => targets.is_empty(),
        Scope::Mirrors => is_mirror,
        Scope::Masks => has_mask,
    });
    let changes = params_ui(ui, "style", &mut params, &defaults);
    apply(editing, &targets, changes);
}

fn title_ui(ui: &mut Ui, editing: &Editing<'_>, has_own: bool) {
    let title = match (editing.selection.len(), editing.selection.lead()) {
        (0, _) | (_, None) => "Everything without a style of its own".to_owned(),
        (1, Some(lead)) => editing.model.scene.nodes.get(lead).map(|n| n.name.clone()).unwrap_or_default(),
        (count, _) => format!("{count} objects"),
    };
    ui.add(egui::Label::new(RichText::new(title).strong()).truncate());
    let state = match (editing.selection.is_empty(), has_own) {
        (true, _) => "Select an object to give it a style of its own.",
        (false, true) => "Has a style of its own.",
        (false, false) => "Inherits; a change gives it a style of its own.",
    };
    ui.add(egui::Label::new(RichText::new(state).weak().small()).wrap());
    ui.add_space(4.0);
}

fn ui_inherit(ui: &mut Ui, targets: &[usize], has_own: bool) -> bool {
    if targets.is_empty() || !has_own {
        return false;
    }
    let hint = "Drop the own style; the objects look like what they hang below";
    let clicked = ui.button("Inherit").on_hover_text(hint).clicked();
    ui.add_space(2.0);
    clicked
}

/// Returns the style that was chosen.
fn preset_ui(ui: &mut Ui, editing: &Editing<'_>, style: &Style) -> Option<Style> {
    let mut chosen = None;
    let help = "A named style; choosing one replaces all parameters below";
    named_row(ui, "Preset", help, |ui, label| {
        let current = style_name(style, editing.presets);
        let combo = egui::ComboBox::from_id_salt("preset")
            .width(ui.available_width())
            .height(PRESETS_HEIGHT)
            .truncate()
            .selected_text(current)
            .show_ui(ui, |ui| {
                for preset in editing.presets {
                    if ui
                        .selectable_label(preset.name == current, &preset.name)
                        .on_hover_text(&preset.description)
                        .clicked()
                    {
                        chosen = Some(preset.style.clone());
                    }
                }
            });
        combo.response.labelled_by(label).on_hover_text(help);
    });
    chosen
}

fn apply(editing: &mut Editing<'_>, targets: &[NodeId], changes: Vec<Change>) {
    let scene = &editing.model.scene;
    for change in changes {
        match change {
            Change::Set(key, value) => {
                // The value comes out of the parameter itself, so that it fits.
                if let Err(error) = set(editing.document, scene, targets, &key, &value) {
                    log::warn!("{error}");
                }
            }
            Change::ChooseFile(key) => {
                let path = |&node| scene.nodes.get(node).map(|n: &Node| n.path.clone());
                let nodes = targets.iter().filter_map(path).collect();
                *editing.choosing = Some(Choosing { key, nodes });
            }
        }
    }
}

/// Sets one parameter of some nodes, or of everything that has no style of its own if there are none.
///
/// # Errors
/// See [`param::set`].
pub fn set(
    document: &mut Document,
    scene: &Scene,
    nodes: &[NodeId],
    key: &str,
    value: &Value,
) -> Result<(), StyleError> {
    if nodes.is_empty() {
        param::set(&mut document.style.params(), key, value)?;
    } else {
        document.set_for(scene, nodes, key, value)?;
    }
    Ok(())
}
