//! Clicks and keys while a glyph is being placed.

use eframe::egui;
use eframe::egui::{Key, Modifiers};

use super::Viewer;
use crate::app::placing::{PlacedGlyph, Placing};
use crate::app::state::Page;
use crate::render::Pick;

impl Viewer {
    /// Lets the person place a glyph.
    pub(super) fn begin_placing(&mut self, kind: PlacedGlyph) {
        self.cancel_placing();
        self.placing = Some(Placing::new(kind));
    }

    /// Lets go of what was being placed.
    pub(super) fn cancel_placing(&mut self) {
        if let Some(placing) = self.placing.take() {
            placing.cancel(&mut self.document);
        }
    }

    /// A surface was clicked; `is_last`: twice.
    pub(super) fn place_point(&mut self, pick: &Pick, is_last: bool) {
        let Some(placing) = &mut self.placing else { return };
        match pick.point {
            Some(point) => placing.add(point, &mut self.document, self.model.diagonal),
            None => self.notices.warning("There is no surface; points are placed on what is drawn"),
        }
        if is_last || placing.is_complete() {
            self.finish_placing();
        }
    }

    /// Takes back the last point.
    pub(super) fn take_point_back(&mut self) {
        if let Some(placing) = &mut self.placing {
            placing.take_back(&mut self.document, self.model.diagonal);
        }
    }

    /// What is placed is a glyph like any other from now on; too few points make none.
    fn finish_placing(&mut self) {
        let Some(placing) = self.placing.take() else { return };
        if let Some(index) = placing.finish(&mut self.document) {
            self.select_glyph(index);
        }
    }

    /// Selects a glyph and opens its page.
    pub(super) fn select_glyph(&mut self, index: usize) {
        self.model.show_glyphs(&self.document);
        self.selection.set(self.model.files.nodes.len() + index);
        self.state.page = Page::Glyphs;
    }

    /// The keys that mean something else while a glyph is being placed.
    pub(super) fn take_placing_keys(&mut self, context: &egui::Context) {
        if self.placing.is_none() || context.text_edit_focused() {
            return;
        }
        let pressed = |key| context.input_mut(|i| i.consume_key(Modifiers::NONE, key));
        if pressed(Key::Escape) {
            self.cancel_placing();
        } else if pressed(Key::Enter) {
            self.finish_placing();
        } else if pressed(Key::Backspace) {
            self.take_point_back();
        }
    }
}
