//! What stands where in the window: bars, panels, the picture.

use std::sync::Arc;

use eframe::egui;

use super::{DialogFor, Viewer};
use crate::app::command::Command;
use crate::app::loading::Intent;
use crate::app::panels::{Editing, empty, glyphs, light, menu, status, style, view};
use crate::app::state::{Page, Samples};

impl Viewer {
    /// The bars and the panels around the picture.
    pub(super) fn panels(&mut self, ui: &mut egui::Ui) {
        if !self.state.panels {
            return;
        }
        let answer = egui::Panel::top("menu")
            .show(ui, |ui| {
                let mut commands = std::mem::take(&mut self.commands);
                let state = menu::MenuState {
                    enabled: &|c| self.is_enabled(c),
                    checked: &|c| self.is_checked(c),
                    recent: self.recent.clone(),
                };
                let answer = menu::menu_ui(ui, &state, &mut commands);
                self.commands = commands;
                answer
            })
            .inner;
        if let Some(path) = answer.open {
            self.load(ui.ctx(), vec![path], Intent::Open);
        }
        if answer.forget {
            self.state.files.clear();
            self.recent.clear();
        }
        egui::Panel::bottom("status").exact_size(24.0).show(ui, |ui| {
            let adapter = self.viewport.adapter_name();
            let milliseconds = self.state.statistics.then(|| self.viewport.milliseconds());
            let status = status::Status {
                model: &self.model,
                hint: self.hint(),
                warnings: self.model.scene.warnings.len() + self.images.warnings.len(),
                document: &self.document,
                selection: &self.selection,
                milliseconds,
                adapter: &adapter,
                refining: self.viewport.refining().progress(),
                saving: self.jobs.picture.as_ref().map(|job| job.progress().share()),
                intersections: self.jobs.intersections.as_ref().map(|job| job.progress().share()),
                hatching: self.jobs.stripes.as_ref().map(|job| job.progress().share()),
                strokes: self.jobs.strokes.as_ref().map(|job| job.progress().share()),
            };
            match status::status_ui(ui, &status, &mut self.commands) {
                Some(status::Canceled::Saving) => {
                    self.jobs.picture = None;
                    self.jobs.waiting.clear();
                }
                Some(status::Canceled::Intersections) => {
                    self.jobs.intersections = None;
                    self.intersections_refused = true;
                }
                Some(status::Canceled::Hatching) => {
                    self.jobs.stripes = None;
                    self.stripes_refused = self.viewport.missing_stripes(&self.document);
                }
                Some(status::Canceled::Strokes) => {
                    self.jobs.strokes = None;
                    self.strokes_refused = self.viewport.missing_strokes(&self.document);
                }
                None => {}
            }
        });
        self.side_panels(ui);
    }

    fn side_panels(&mut self, ui: &mut egui::Ui) {
        let hint = self.hint();
        let mut choosing = None;
        let mut editing = Editing {
            model: &self.model,
            document: &mut self.document,
            selection: &mut self.selection,
            presets: &self.presets,
            viewport: &self.viewport,
            commands: &mut self.commands,
            choosing: &mut choosing,
        };
        let outliner = &mut self.outliner;
        egui::Panel::left("outliner").default_size(270.0).size_range(180.0..=480.0).show_collapsible(
            ui,
            &mut self.state.outliner,
            |ui| outliner.ui(ui, &mut editing),
        );
        let (page, samples) = (&mut self.state.page, &mut self.state.samples);
        let turned = egui::Panel::right("inspector")
            .default_size(290.0)
            .size_range(240.0..=460.0)
            .show_collapsible(ui, &mut self.state.inspector, |ui| {
                inspector_ui(ui, page, samples, &mut editing, hint)
            });
        if turned.is_some_and(|t| t.inner) {
            self.commands.push(Command::Home);
        }
        if let Some(choosing) = choosing {
            self.ask_for_file(ui.ctx(), DialogFor::Image(choosing));
        }
    }

    /// The picture, and what lies on it.
    pub(super) fn picture(&mut self, ui: &mut egui::Ui) {
        let up = self.document.up(&self.model.scene);
        let diagonal = self.model.diagonal;
        self.viewport.set_placing(self.placing.is_some());
        self.viewport.set_covered(self.is_asking());
        let moved = self.viewport.input(ui, self.document.camera.as_ref(), up, diagonal);
        if let Some(camera) = moved.camera {
            self.document.camera = Some(camera);
        }
        if let Some(response) = moved.response {
            self.context_menu(&response);
        }
        self.viewport.set_measures(self.state.statistics);
        self.follow_glyphs();
        self.viewport.pause(self.jobs.picture.is_some());
        let selected = self.selection.with_descendants(&self.model.scene);
        if let Err(error) = self.viewport.draw(ui, &self.document, selected, self.state.samples.at_rest()) {
            self.notices.error(format!("The picture could not be drawn: {error}"));
        }
        let area = self.viewport.rect();
        if let (Some(placing), Some(camera)) = (&self.placing, &self.document.camera) {
            placing.draw(ui, area, camera);
        }
        if self.model.scene.nodes.is_empty() && self.jobs.load.is_none() {
            let chosen = empty::empty_ui(ui, area, self.state.recent(), &mut self.commands);
            if let Some(path) = chosen {
                self.load(ui.ctx(), vec![path], Intent::Open);
            }
        }
        if let Some(load) = &self.jobs.load
            && empty::loading_ui(ui, area, load.progress().share())
        {
            self.jobs.load = None;
            self.stay();
        }
        if ui.input(|i| !i.raw.hovered_files.is_empty()) {
            empty::hovering_ui(ui, area, ui.input(|i| i.modifiers.command));
        }
    }

    /// Glyphs may have come, gone or changed.
    fn follow_glyphs(&mut self) {
        let before = Arc::clone(&self.model.scene);
        let is_selected = self.selection.iter().any(|node| before.is_added(node));
        // A renamed glyph keeps its number.
        if self.model.show_glyphs(&self.document) && is_selected && self.model.scene.added != before.added {
            self.selection = self.selection.carried_over(&before, &self.model.scene);
        }
    }

    fn context_menu(&mut self, response: &egui::Response) {
        let mut asked = Vec::new();
        response.context_menu(|ui| {
            for command in [
                Command::FrameSelected,
                Command::FrameAll,
                Command::Hide,
                Command::Isolate,
                Command::ShowAll,
                Command::Screenshot,
            ] {
                let mut button = egui::Button::new(command.text());
                if let Some(shortcut) = command.shortcuts().first() {
                    button = button.shortcut_text(ui.ctx().format_shortcut(shortcut));
                }
                if ui.add_enabled(self.is_enabled(command), button).on_hover_text(command.tooltip()).clicked()
                {
                    asked.push(command);
                    ui.close();
                }
            }
        });
        self.commands.extend(asked);
    }
}

/// The pages of the panel on the right. Returns whether the model is to be seen upright again.
fn inspector_ui(
    ui: &mut egui::Ui,
    page: &mut Page,
    samples: &mut Samples,
    editing: &mut Editing<'_>,
    hint: Option<&str>,
) -> bool {
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let pages =
            [(Page::Style, "Style"), (Page::Light, "Light"), (Page::Glyphs, "Glyphs"), (Page::View, "View")];
        for (this, name) in pages {
            let is_open = *page == this;
            let tab = ui.selectable_value(page, this, name);
            tab.widget_info(|| egui::WidgetInfo::selected(egui::Role::Tab, true, is_open, name));
        }
    });
    ui.separator();
    let mut turned = false;
    egui::ScrollArea::vertical().id_salt(format!("{page:?}")).auto_shrink([false, false]).show(ui, |ui| {
        match page {
            Page::Style => style::style_ui(ui, editing),
            Page::Light => light::light_ui(ui, editing),
            Page::Glyphs => glyphs::glyphs_ui(ui, editing, hint),
            Page::View => turned = view::view_ui(ui, editing, samples),
        }
        ui.add_space(8.0);
    });
    turned
}
