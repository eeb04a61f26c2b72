//! The menu bar.

use eframe::egui;
use std::path::PathBuf;

use eframe::egui::Ui;
use strum::IntoEnumIterator as _;

use crate::app::command::{Command, CommandGroup};

/// What menus need to know.
pub struct MenuState<'a> {
    /// Whether a command can be carried out now.
    pub enabled: &'a dyn Fn(Command) -> bool,
    /// Whether a switch is on; `None`: the command is no switch.
    pub checked: &'a dyn Fn(Command) -> Option<bool>,
    /// Recent files, and whether each is still there.
    pub recent: Vec<(PathBuf, bool)>,
}

/// What was asked for beyond commands.
#[derive(Debug, Default)]
pub struct MenuAnswer {
    /// A recent file.
    pub open: Option<PathBuf>,
    /// Forget all recent files.
    pub forget: bool,
}

/// The bar.
pub fn menu_ui(ui: &mut Ui, state: &MenuState<'_>, commands: &mut Vec<Command>) -> MenuAnswer {
    let mut answer = MenuAnswer::default();
    egui::MenuBar::new().ui(ui, |ui| {
        for group in CommandGroup::iter() {
            ui.menu_button(group.title(), |ui| {
                ui.set_min_width(220.0);
                let has_switches = Command::of(group).any(|c| (state.checked)(c).is_some());
                for command in Command::of(group) {
                    if command.starts_section() {
                        ui.separator();
                    }
                    item(ui, command, has_switches, state, commands);
                    if command == Command::Add {
                        recent(ui, state, &mut answer);
                    }
                }
            });
        }
    });
    answer
}

fn item(ui: &mut Ui, command: Command, indented: bool, state: &MenuState<'_>, commands: &mut Vec<Command>) {
    let checked = (state.checked)(command);
    // Where some are switches, all leave room for the mark.
    let indent = if indented { "      " } else { "" };
    let mut button = egui::Button::new(format!("{indent}{}", command.text()));
    if let Some(shortcut) = command.shortcuts().first() {
        button = button.shortcut_text(ui.ctx().format_shortcut(shortcut));
    }
    let response = ui.add_enabled((state.enabled)(command), button).on_hover_text(command.tooltip());
    if let Some(on) = checked {
        response.widget_info(|| {
            egui::WidgetInfo::selected(egui::Role::MenuItemCheckBox, true, on, command.text())
        });
        if on {
            super::icons::check(
                ui.painter(),
                response.rect.left_center() + egui::vec2(12.0, 0.0),
                ui.visuals(),
            );
        }
    }
    if response.clicked() {
        commands.push(command);
        ui.close();
    }
}

fn recent(ui: &mut Ui, state: &MenuState<'_>, answer: &mut MenuAnswer) {
    ui.add_enabled_ui(!state.recent.is_empty(), |ui| {
        ui.menu_button("Open recent", |ui| {
            for (path, exists) in &state.recent {
                let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
                let hint = path.display().to_string();
                let item = ui.add_enabled(*exists, egui::Button::new(name));
                if item.on_hover_text(&hint).on_disabled_hover_text(format!("{hint} is gone")).clicked() {
                    answer.open = Some(path.clone());
                    ui.close();
                }
            }
            ui.separator();
            if ui.button("Forget all").clicked() {
                answer.forget = true;
                ui.close();
            }
        });
    });
}
