//! The one place where commands are carried out.

use std::collections::BTreeSet;

use eframe::egui;

use super::{DialogFor, Open, Viewer};
use crate::app::command::Command;
use crate::app::loading::Intent;
use crate::app::navigation::STEP;
use crate::app::placing::PlacedGlyph;
use crate::app::screenshot::{self, Destination};
use crate::app::theme;
use crate::app::unsaved::Replacement;
use crate::document::Glyph;
use crate::document::glyph::Shape;
use crate::scene::{Extent, NodeId, Projection, Standard};

impl Viewer {
    /// Whether a command can be carried out now.
    pub fn is_enabled(&self, command: Command) -> bool {
        let (any, selected) = (!self.model.scene.nodes.is_empty(), !self.selection.is_empty());
        match command {
            Command::Reload => !self.document.models.is_empty(),
            Command::Save => any || self.saved.file.is_some(),
            Command::AddBox => self.selection.lead_object(&self.model.files).is_some(),
            Command::AddArrow | Command::AddPath | Command::AddLabel => any && self.document.camera.is_some(),
            Command::Delete => {
                self.placing.is_none() && self.selection.iter().any(|n| self.model.scene.is_added(n))
            }
            Command::Undo => self.history.can_undo() || self.placing.is_some(),
            Command::Redo => self.history.can_redo(),
            Command::SelectNone => selected || self.open.help || self.open.warnings,
            Command::Hide | Command::Isolate | Command::FrameSelected => selected,
            Command::FileCamera => !self.model.scene.cameras.is_empty(),
            Command::ReloadShaders => self.can_reload_shaders,
            Command::SaveAs
            | Command::Screenshot
            | Command::TransparentScreenshot
            | Command::ScreenshotAs
            | Command::SelectAll
            | Command::ShowAll => any,
            Command::Home
            | Command::FrameAll
            | Command::Front
            | Command::Back
            | Command::Right
            | Command::Left
            | Command::Top
            | Command::Bottom
            | Command::Isometric
            | Command::OrbitLeft
            | Command::OrbitRight
            | Command::OrbitUp
            | Command::OrbitDown
            | Command::Projection => self.document.camera.is_some(),
            Command::Open
            | Command::Add
            | Command::Quit
            | Command::Panels
            | Command::Outliner
            | Command::Inspector
            | Command::Statistics
            | Command::DarkPanels
            | Command::FullScreen
            | Command::Warnings
            | Command::Help => true,
        }
    }

    /// Whether a switch is on; `None` for what is no switch.
    pub fn is_checked(&self, command: Command) -> Option<bool> {
        match command {
            Command::Panels => Some(self.state.panels),
            Command::Outliner => Some(self.state.outliner),
            Command::Inspector => Some(self.state.inspector),
            Command::Statistics => Some(self.state.statistics),
            Command::DarkPanels => Some(self.is_dark),
            Command::Projection => Some(
                self.document.camera.is_some_and(|c| matches!(c.projection, Projection::Orthographic { .. })),
            ),
            _ => None,
        }
    }

    // Long, as it is a table: one arm per command.
    /// Carries a command out.
    pub(super) fn execute(&mut self, context: &egui::Context, command: Command) {
        match command {
            Command::Open => self.leave_for(context, Replacement::Choose),
            Command::Add => self.ask_for_file(context, DialogFor::Add),
            Command::Reload => {
                self.load(context, self.document.models.clone(), Intent::Reload);
                self.images.look_again();
            }
            Command::Save => match self.saved.file.clone() {
                Some(path) => self.save_document(context, path),
                None => self.ask_for_file(context, DialogFor::Save),
            },
            Command::SaveAs => self.ask_for_file(context, DialogFor::Save),
            Command::Screenshot => self.capture(context, false, self.numbered()),
            Command::TransparentScreenshot => self.capture(context, true, self.numbered()),
            Command::ScreenshotAs => self.ask_for_file(context, DialogFor::Screenshot),
            Command::Quit => self.leave_for(context, Replacement::Close),
            Command::AddBox => self.add_box(),
            Command::AddArrow => self.begin_placing(PlacedGlyph::Arrow),
            Command::AddPath => self.begin_placing(PlacedGlyph::Path),
            Command::AddLabel => self.begin_placing(PlacedGlyph::Label),
            Command::Delete => self.delete_glyphs(),
            Command::Undo if self.placing.is_some() => self.take_point_back(),
            Command::Undo => {
                self.history.undo(&mut self.document);
                self.follow_models(context);
            }
            Command::Redo => {
                self.history.redo(&mut self.document);
                self.follow_models(context);
            }
            Command::SelectAll => {
                let objects = self.model.scene.nodes.iter().enumerate().filter(|(_, n)| n.mesh.is_some());
                self.selection.extend(objects.map(|(id, _)| id));
            }
            // Esc closes what lies on top first.
            Command::SelectNone if self.open.help || self.open.warnings => self.open = Open::default(),
            Command::SelectNone => self.selection.clear(),
            Command::Hide => self.hide(),
            Command::Isolate => self.isolate(),
            Command::ShowAll => self.show_all(),
            Command::Home => self.look_from(Standard::Home),
            Command::FrameAll => self.frame(&self.model.visible_extent(&self.document)),
            Command::FrameSelected => {
                let nodes = self.selection.with_descendants(&self.model.scene);
                self.frame(&self.model.extent_of(nodes));
            }
            Command::Front => self.look_from(Standard::Front),
            Command::Back => self.look_from(Standard::Back),
            Command::Right => self.look_from(Standard::Right),
            Command::Left => self.look_from(Standard::Left),
            Command::Top => self.look_from(Standard::Top),
            Command::Bottom => self.look_from(Standard::Bottom),
            Command::Isometric => self.look_from(Standard::Isometric),
            Command::FileCamera => {
                if let Some((_, camera)) = self.model.scene.cameras.first() {
                    self.document.camera = Some(*camera);
                }
            }
            Command::OrbitLeft => self.step(-STEP, 0.0),
            Command::OrbitRight => self.step(STEP, 0.0),
            Command::OrbitUp => self.step(0.0, STEP),
            Command::OrbitDown => self.step(0.0, -STEP),
            Command::Projection => self.switch_projection(),
            Command::Panels => self.state.panels = !self.state.panels,
            Command::Outliner => self.state.outliner = !self.state.outliner,
            Command::Inspector => self.state.inspector = !self.state.inspector,
            Command::Statistics => self.state.statistics = !self.state.statistics,
            Command::DarkPanels => {
                self.state.dark = Some(!self.is_dark);
                theme::choose(context, self.state.dark);
            }
            Command::FullScreen => {
                let is_full = context.input(|i| i.viewport().fullscreen.unwrap_or(false));
                context.send_viewport_cmd(egui::ViewportCommand::Fullscreen(!is_full));
            }
            Command::Warnings => self.open.warnings = !self.open.warnings,
            Command::ReloadShaders => self.reload_shaders(),
            Command::Help => self.open.help = !self.open.help,
        }
    }

    fn add_box(&mut self) {
        if let Some(node) = self.selection.lead_object(&self.model.files) {
            let glyph = Glyph::new("box".to_owned(), Shape::around(node.path.clone()));
            let index = self.document.add_glyph(glyph);
            self.select_glyph(index);
        }
    }

    fn delete_glyphs(&mut self) {
        let own = self.model.files.nodes.len();
        let indices: Vec<_> = self.selection.iter().filter_map(|n| n.checked_sub(own)).collect();
        for index in indices.into_iter().rev() {
            self.document.remove_glyph(index);
        }
        self.selection.clear();
    }

    fn hide(&mut self) {
        for node in self.selection.iter().filter_map(|n| self.model.scene.nodes.get(n)) {
            self.document.node_mut(&node.path).visible = Some(false);
        }
        self.selection.clear();
    }

    fn switch_projection(&mut self) {
        if let Some(camera) = &mut self.document.camera {
            let parallel = matches!(camera.projection, Projection::Orthographic { .. });
            *camera = camera.with_orthographic(!parallel);
        }
    }

    fn numbered(&self) -> Destination {
        let folders = screenshot::folders(self.document.models.first().map(|p| p.as_path()));
        Destination::Numbered { model: self.name(), folders }
    }

    /// After an undo, the list of models may be another one than the scene was made of.
    fn follow_models(&mut self, context: &egui::Context) {
        if self.document.models != self.loaded {
            self.load(context, self.document.models.clone(), Intent::Restore);
        }
    }

    /// Sees everything from a standard direction.
    pub(super) fn look_from(&mut self, standard: Standard) {
        let extent = self.model.visible_extent(&self.document);
        let up = self.document.up(&self.model.scene);
        let aspect = self.viewport.aspect();
        self.document.camera = Some(standard.camera(up, &extent, aspect, self.document.camera.as_ref()));
    }

    fn frame(&mut self, extent: &Extent) {
        if let Some(camera) = &mut self.document.camera {
            *camera = camera.framing(extent, self.viewport.aspect());
        }
    }

    fn step(&mut self, azimuth: f64, elevation: f64) {
        let up = self.document.up(&self.model.scene).vector();
        if let Some(camera) = &mut self.document.camera {
            *camera = camera.orbited(up, azimuth, elevation);
        }
    }

    /// Hides everything else; shows everything when everything else is hidden already.
    fn isolate(&mut self) {
        let scene = &self.model.scene;
        let below: BTreeSet<NodeId> = self.selection.with_descendants(scene).into_iter().collect();
        let mut above = BTreeSet::new();
        for node in self.selection.iter() {
            let mut parent = scene.nodes.get(node).and_then(|n| n.parent);
            while let Some(id) = parent {
                above.insert(id);
                parent = scene.nodes.get(id).and_then(|n| n.parent);
            }
        }
        let before = self.document.nodes.clone();
        for (id, node) in scene.nodes.iter().enumerate() {
            let is_kept = below.contains(&id) || above.contains(&id);
            let is_beside = node.parent.is_none_or(|p| above.contains(&p));
            if is_kept {
                self.document.node_mut(&node.path).visible = None;
            } else if is_beside {
                self.document.node_mut(&node.path).visible = Some(false);
            }
        }
        self.document.tidy();
        if self.document.nodes == before {
            self.show_all();
        }
    }

    fn show_all(&mut self) {
        for settings in self.document.nodes.values_mut() {
            settings.visible = None;
        }
        self.document.tidy();
    }

    fn reload_shaders(&mut self) {
        match self.viewport.renderer().reload_shaders() {
            Ok(()) => {
                self.viewport.draw_again();
                self.notices.done("Shaders were read again");
            }
            Err(error) => self.notices.error(error.to_string()),
        }
    }
}
