//! What the mouse does to the picture: it moves the camera, and asks what lies under a pixel.

use std::time::Duration;

use eframe::egui::emath::GuiRounding as _;
use eframe::egui::{self, PointerButton, Sense, Ui};
use glam::DVec2;

use super::Viewport;
use crate::app::gesture::{self, Gestures};
use crate::app::navigation;
use crate::render::Pick;
use crate::scene::{Camera, Up};

/// How long to wait between two looks for an answer of the device.
const POLL: Duration = Duration::from_millis(8);

/// At its border, the picture leaves the pointer to the handles of the panels; points.
const EDGE: f32 = 3.0;

/// Why a person asked what lies under a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PickFor {
    /// To select it.
    Select {
        /// In addition to what is selected.
        add: bool,
    },
    /// To turn about it.
    Center,
    /// To place a point of a glyph there.
    Place {
        /// No further one is wanted.
        is_last: bool,
    },
}

/// What the mouse did to the picture.
#[derive(Default)]
pub struct Moved {
    /// The camera after it.
    pub camera: Option<Camera>,
    /// The response, for a context menu.
    pub response: Option<egui::Response>,
}

impl Viewport {
    /// Lets the mouse work on the picture.
    pub fn input(&mut self, ui: &mut Ui, camera: Option<&Camera>, up: Up, diagonal: f64) -> Moved {
        let pixels_per_point = ui.ctx().pixels_per_point();
        let rect = ui.available_rect_before_wrap().round_to_pixels(pixels_per_point);
        self.rect = rect;
        self.size = [rect.width(), rect.height()].map(|s| (s * pixels_per_point).round().max(1.0) as u32);
        self.is_laid_out = true;
        let response = ui.interact(rect, ui.scope_id().with("picture"), Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Picture"));
        if self.is_covered {
            // A drag that was under way ends here.
            self.gestures = Gestures::default();
            return Moved::default();
        }
        let Some(&camera) = camera else { return Moved { camera: None, response: Some(response) } };
        let mut moved = camera;
        let height = f64::from(rect.height().max(1.0));
        let share = |v: egui::Vec2| DVec2::new(f64::from(v.x), f64::from(v.y)) / height;
        let cursor = |p: egui::Pos2| share(p - rect.center()) * DVec2::new(1.0, -1.0);

        let (layer, inside) = (ui.layer_id(), rect.shrink(EDGE));
        let is_picture = |pos| inside.contains(pos) && ui.ctx().layer_id_at(pos) == Some(layer);
        for drag in self.gestures.drags(ui, is_picture) {
            let by = share(drag.by);
            moved = match drag.button {
                PointerButton::Middle => navigation::pan(&moved, by),
                PointerButton::Primary if drag.modifiers.shift => navigation::pan(&moved, by),
                PointerButton::Primary if drag.modifiers.command => navigation::roll(&moved, by.x),
                PointerButton::Primary => navigation::orbit(&moved, up, by),
                _ => navigation::zoom(&moved, by.y * 20.0, DVec2::ZERO, diagonal),
            };
        }
        match self.gestures.dragging() {
            Some(PointerButton::Middle) => ui.ctx().set_cursor_icon(egui::CursorIcon::Move),
            Some(PointerButton::Primary) => ui.ctx().set_cursor_icon(egui::CursorIcon::Grabbing),
            Some(_) => ui.ctx().set_cursor_icon(egui::CursorIcon::ResizeVertical),
            None => {}
        }

        if let (true, Some(pointer)) = (response.contains_pointer(), ui.input(|i| i.pointer.hover_pos())) {
            let notches = gesture::notches(ui);
            if notches != 0.0 {
                moved = navigation::zoom(&moved, notches, cursor(pointer), diagonal);
            }
        }
        if !self.gestures.was_drag() {
            self.click(ui, &response);
        }
        Moved { camera: (moved != camera).then_some(moved), response: Some(response) }
    }

    fn click(&mut self, ui: &Ui, response: &egui::Response) {
        let purpose = if self.is_placing && response.double_clicked() {
            PickFor::Place { is_last: true }
        } else if self.is_placing && response.clicked() {
            PickFor::Place { is_last: false }
        } else if response.double_clicked() || response.middle_clicked() {
            PickFor::Center
        } else if response.clicked() {
            PickFor::Select { add: ui.input(|i| i.modifiers.shift || i.modifiers.command) }
        } else {
            return;
        };
        let Some(at) = response.interact_pointer_pos() else { return };
        let px = (at - self.rect.min) * ui.ctx().pixels_per_point();
        match self.renderer.start_pick([px.x.max(0.0) as u32, px.y.max(0.0) as u32]) {
            Ok(()) => self.pick = Some(purpose),
            Err(error) => log::warn!("{error}"),
        }
        ui.ctx().request_repaint_after(POLL);
    }

    /// What lies where the person clicked, once it is known.
    pub fn poll_pick(&mut self, context: &egui::Context) -> Option<(PickFor, Pick)> {
        let purpose = self.pick?;
        if let Some(pick) = self.renderer.poll_pick() {
            self.pick = None;
            return Some((purpose, pick));
        }
        if !self.renderer.is_picking() {
            self.pick = None;
        }
        context.request_repaint_after(POLL);
        None
    }
}
