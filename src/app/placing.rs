//! Glyphs that are being placed: the person clicks surfaces, one point after the other.

use eframe::egui;
use eframe::egui::{Key, Modifiers, Pos2, Rect};
use glam::DVec3;

use super::viewer::Viewer;
use crate::document::glyph::{Anchor, Shape};
use crate::document::{Document, Glyph};
use crate::render::Pick;
use crate::scene::{Camera, Projection};

/// What is being placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Placed {
    /// Tail and tip.
    Arrow,
    /// As many points as the person likes.
    Path,
    /// One point.
    Label,
}

/// A glyph that is being placed.
#[derive(Debug, Clone)]
pub struct Placing {
    kind: Placed,
    /// The points on surfaces.
    points: Vec<DVec3>,
    /// Its number in the document, once it has points enough to be drawn.
    glyph: Option<usize>,
}

impl Placing {
    fn new(kind: Placed) -> Self {
        Self { kind, points: Vec::new(), glyph: None }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match (self.kind, self.points.len()) {
            (Placed::Label, _) => "Click what the label names; Esc cancels",
            (Placed::Arrow, 0) => "Click where the arrow begins; Esc cancels",
            (Placed::Arrow, _) => {
                "Click where the arrow points to; Backspace takes a point back, Esc cancels"
            }
            (Placed::Path, 0) => "Click where the path begins; Esc cancels",
            (Placed::Path, 1) => "Click the next point; Backspace takes one back, Esc cancels",
            (Placed::Path, _) => {
                "Click the next point; Enter or a double click ends the path, Backspace takes a point back, Esc cancels"
            }
        }
    }

    /// Whether it has all points that it can have.
    fn is_complete(&self) -> bool {
        match self.kind {
            Placed::Arrow => self.points.len() == 2,
            Placed::Path => false,
            Placed::Label => self.points.len() == 1,
        }
    }

    /// Shows in the document what there is so far.
    fn show(&mut self, document: &mut Document, diagonal: f64) {
        if self.points.len() < 2 {
            if let Some(index) = self.glyph.take() {
                document.remove_glyph(index);
            }
            return;
        }
        let mut shape = Shape::path(self.points.clone());
        let kind = shape.kind().to_owned();
        if let (Shape::Path(path), Some(camera)) = (&mut shape, &document.camera) {
            // Half of a line on a surface would be within it; only its tip touches.
            let lift = diagonal * f64::from(path.thickness) * 0.01;
            let on_surface = path.points.len() - 1;
            for point in path.points.iter_mut().take(on_surface) {
                *point += towards_eye(camera, *point) * lift;
            }
        }
        match self.glyph.and_then(|index| document.glyphs.get_mut(index)) {
            Some(glyph) => glyph.shape = shape,
            None => self.glyph = Some(document.add_glyph(Glyph::new(kind, shape))),
        }
    }

    /// Draws the points, and a line from the last one to the pointer.
    pub fn draw(&self, ui: &egui::Ui, rect: Rect, camera: &Camera) {
        let seen: Vec<Pos2> = self.points.iter().filter_map(|p| on_screen(camera, rect, *p)).collect();
        let painter = ui.painter().with_clip_rect(rect);
        let color = ui.visuals().selection.bg_fill;
        let pointer = ui.input(|i| i.pointer.hover_pos()).filter(|p| rect.contains(*p));
        if let (Some(last), Some(pointer)) = (seen.last(), pointer) {
            painter.line_segment([*last, pointer], egui::Stroke::new(1.5, color));
        }
        for point in seen {
            painter.circle(point, 4.0, color, egui::Stroke::new(1.0, egui::Color32::WHITE));
        }
    }
}

fn towards_eye(camera: &Camera, point: DVec3) -> DVec3 {
    match camera.projection {
        Projection::Perspective { .. } => (camera.position - point).normalize_or_zero(),
        Projection::Orthographic { .. } => -camera.forward(),
    }
}

/// Where a point is seen; `None` behind the eye.
fn on_screen(camera: &Camera, rect: Rect, point: DVec3) -> Option<Pos2> {
    let local = camera.view_from_world().transform_point3(point);
    let half = match camera.projection {
        Projection::Perspective { view_angle } => -local.z * (view_angle * 0.5).to_radians().tan(),
        Projection::Orthographic { view_height } => view_height * 0.5,
    };
    let scale = f64::from(rect.height()) * 0.5 / half;
    (half > 0.0).then(|| rect.center() + egui::vec2((local.x * scale) as f32, (-local.y * scale) as f32))
}

impl Viewer {
    /// Lets the person place a glyph.
    pub(super) fn begin_placing(&mut self, kind: Placed) {
        self.cancel_placing();
        self.placing = Some(Placing::new(kind));
    }

    /// Lets go of what was being placed.
    pub(super) fn cancel_placing(&mut self) {
        if let Some(index) = self.placing.take().and_then(|p| p.glyph) {
            self.document.remove_glyph(index);
        }
    }

    /// A surface was clicked; `is_last`: twice.
    pub(super) fn place_point(&mut self, pick: &Pick, is_last: bool) {
        let Some(placing) = &mut self.placing else { return };
        let diagonal = self.model.diagonal;
        match pick.point {
            // The second click of two is at the same place.
            Some(point) if placing.points.last().is_none_or(|p| p.distance(point) > 1e-4 * diagonal) => {
                placing.points.push(point);
                placing.show(&mut self.document, diagonal);
            }
            Some(_) => {}
            None => self.notices.warning("There is no surface; points are placed on what is drawn"),
        }
        if is_last || self.placing.as_ref().is_some_and(Placing::is_complete) {
            self.finish_placing();
        }
    }

    /// Takes back the last point.
    pub(super) fn take_point_back(&mut self) {
        if let Some(placing) = &mut self.placing
            && placing.points.pop().is_some()
        {
            placing.show(&mut self.document, self.model.diagonal);
        }
    }

    /// What is placed is a glyph like any other from now on; too few points make none.
    pub(super) fn finish_placing(&mut self) {
        let Some(mut placing) = self.placing.take() else { return };
        if let (Placed::Label, Some(point)) = (placing.kind, placing.points.first()) {
            let shape = Shape::label("Label".to_owned(), Anchor::Point(*point));
            placing.glyph = Some(self.document.add_glyph(Glyph::new("label".to_owned(), shape)));
        }
        if let Some(index) = placing.glyph {
            self.select_glyph(index);
        }
    }

    /// Selects a glyph and opens its page.
    pub(super) fn select_glyph(&mut self, index: usize) {
        self.model.show_glyphs(&self.document);
        self.selection.set(self.model.files.nodes.len() + index);
        self.state.page = super::state::Page::Glyphs;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_focal_point_is_seen_in_the_middle_and_what_is_behind_is_not_seen() {
        let rect = Rect::from_min_size(egui::pos2(10.0, 20.0), egui::vec2(400.0, 300.0));
        let camera = Camera::default();
        for camera in [camera, camera.with_orthographic(true)] {
            assert_eq!(on_screen(&camera, rect, camera.focal_point), Some(rect.center()));
            let higher = on_screen(&camera, rect, DVec3::Y * 0.1).unwrap();
            assert!(higher.y < rect.center().y && higher.x == rect.center().x);
        }
        assert_eq!(on_screen(&camera, rect, DVec3::Z * 2.0), None);
    }
}
