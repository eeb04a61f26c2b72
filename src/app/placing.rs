//! Glyphs that are being placed: the person clicks surfaces, one point after the other (`viewer/placing.rs`).

use eframe::egui;
use eframe::egui::{Pos2, Rect};
use glam::DVec3;

use crate::document::glyph::{Anchor, Shape};
use crate::document::{Document, Glyph};
use crate::scene::{Camera, Projection};

/// What is being placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlacedGlyph {
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
    kind: PlacedGlyph,
    /// The points on surfaces.
    points: Vec<DVec3>,
    /// Its number in the document, once it has points enough to be drawn.
    glyph: Option<usize>,
}

impl Placing {
    /// Nothing has been placed yet.
    pub(super) fn new(kind: PlacedGlyph) -> Self {
        Self { kind, points: Vec::new(), glyph: None }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match (self.kind, self.points.len()) {
            (PlacedGlyph::Label, _) => "Click what the label names; Esc cancels",
            (PlacedGlyph::Arrow, 0) => "Click where the arrow begins; Esc cancels",
            (PlacedGlyph::Arrow, _) => {
                "Click where the arrow points to; Backspace takes a point back, Esc cancels"
            }
            (PlacedGlyph::Path, 0) => "Click where the path begins; Esc cancels",
            (PlacedGlyph::Path, 1) => "Click the next point; Backspace takes one back, Esc cancels",
            (PlacedGlyph::Path, _) => {
                "Click the next point; Enter or a double click ends the path, Backspace takes a point back, Esc cancels"
            }
        }
    }

    /// Whether it has all points that it can have.
    pub(super) fn is_complete(&self) -> bool {
        match self.kind {
            PlacedGlyph::Arrow => self.points.len() == 2,
            PlacedGlyph::Path => false,
            PlacedGlyph::Label => self.points.len() == 1,
        }
    }

    /// One point more; `diagonal` is the size of the model.
    pub(super) fn add(&mut self, point: DVec3, document: &mut Document, diagonal: f64) {
        // The second click of two is at the same place.
        if self.points.last().is_none_or(|p| p.distance(point) > 1e-4 * diagonal) {
            self.points.push(point);
            self.show(document, diagonal);
        }
    }

    /// Takes the last point back.
    pub(super) fn take_back(&mut self, document: &mut Document, diagonal: f64) {
        if self.points.pop().is_some() {
            self.show(document, diagonal);
        }
    }

    /// Leaves nothing of it.
    pub(super) fn cancel(self, document: &mut Document) {
        if let Some(index) = self.glyph {
            document.remove_glyph(index);
        }
    }

    /// Makes it a glyph like any other and returns its number; too few points make none.
    pub(super) fn finish(self, document: &mut Document) -> Option<usize> {
        if let (PlacedGlyph::Label, Some(point)) = (self.kind, self.points.first()) {
            let shape = Shape::label("Label".to_owned(), Anchor::Point(*point));
            return Some(document.add_glyph(Glyph::new("label".to_owned(), shape)));
        }
        self.glyph
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
