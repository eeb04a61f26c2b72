//! What stands around the picture. Panels change the document in place and ask for everything else by command.

mod curve;
#[cfg(test)]
mod curve_tests;
pub mod empty;
pub mod glyphs;
pub mod help;
pub mod icons;
mod layers;
pub mod leave;
pub mod light;
mod matrix;
pub mod menu;
pub mod outliner;
pub mod params;
pub mod row;
pub mod section;
mod span;
pub mod status;
pub mod style;
pub mod view;

use super::command::Command;
use super::loading::Model;
use super::selection::Selection;
use super::viewport::Viewport;
use crate::document::Document;
use crate::style::preset::Preset;
use eframe::egui;

/// What panels work on.
pub struct Editing<'a> {
    /// The loaded scene.
    pub model: &'a Model,
    /// The document; changed in place.
    pub document: &'a mut Document,
    /// The selected nodes.
    pub selection: &'a mut Selection,
    /// The built-in styles.
    pub presets: &'a [Preset],
    /// What was drawn last.
    pub viewport: &'a Viewport,
    /// What the window is asked to do.
    pub commands: &'a mut Vec<Command>,
    /// The image that the window is asked to let the person choose.
    pub choosing: &'a mut Option<Choosing>,
}

/// An image that is to be chosen in a dialog.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choosing {
    /// The parameter that names it.
    pub key: String,
    /// Paths of the nodes whose parameter it is; none: of everything that has no style of its own.
    pub nodes: Vec<String>,
}

/// A button that asks for a command.
pub fn command_button(ui: &mut egui::Ui, command: Command, commands: &mut Vec<Command>) {
    let hint = match command.shortcuts().first() {
        Some(shortcut) => format!("{}  ({})", command.tooltip(), ui.ctx().format_shortcut(shortcut)),
        None => command.tooltip().to_owned(),
    };
    if ui.button(command.text()).on_hover_text(hint).clicked() {
        commands.push(command);
    }
}
