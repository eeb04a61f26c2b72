//! The few small drawings that buttons of the outliner bear.

use eframe::egui;
use eframe::egui::{Color32, Painter, Pos2, Rect, Response, Sense, Stroke, Ui, vec2};

/// What a button shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Icon {
    /// Visible.
    Eye,
    /// Its edges are drawn.
    Edges,
    /// It is a mirror.
    Mirror,
    /// It belongs to the depth mask.
    Mask,
}

/// Side of a button.
pub const SIZE: f32 = 18.0;

/// A switch that is a drawing. `dimmed`: on by itself, but without effect.
pub fn toggle(
    ui: &mut Ui,
    rect: Rect,
    id: egui::Id,
    icon: Icon,
    on: bool,
    dimmed: bool,
    name: &str,
) -> Response {
    let response = ui.interact(rect, id, Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, true, on, name));
    let visuals = ui.visuals();
    let strength = match (on, dimmed) {
        (true, false) => 0.9,
        (true, true) => 0.4,
        // It is there only where somebody looks.
        (false, _) if matches!(icon, Icon::Mirror | Icon::Mask) => 0.5,
        (false, _) => 0.22,
    };
    let strength = if response.hovered() { 1.0 } else { strength };
    let color = visuals.text_color().gamma_multiply(strength);
    let painter = ui.painter();
    match icon {
        Icon::Eye => eye(painter, rect.center(), on, color),
        Icon::Edges => cube(painter, rect.center(), on, color),
        Icon::Mirror => looking_glass(painter, rect.center(), on, color),
        Icon::Mask => behind_sheets(painter, rect.center(), on, color),
    }
    response
}

/// A small button that brings defaults back.
pub fn reset(ui: &Ui, rect: Rect, id: egui::Id, name: &str) -> Response {
    let response = ui.interact(rect, id, Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    let visuals = ui.visuals();
    let color = if response.hovered() { visuals.strong_text_color() } else { visuals.hyperlink_color };
    turned_back(ui.painter(), rect.center(), color);
    response
}

/// An arrow that goes round against the clock.
fn turned_back(painter: &Painter, center: Pos2, color: Color32) {
    let at = |angle: f32, radius: f32| center + radius * vec2(angle.cos(), angle.sin());
    let start = -2.6_f32;
    let arc: Vec<Pos2> = (0..=12).map(|i| at(start + 5.0 * i as f32 / 12.0, 3.6)).collect();
    painter.line(arc, Stroke::new(1.2, color));
    let tip = at(start, 3.6);
    let head = vec![tip + vec2(-2.2, -2.0), tip + vec2(2.2, -0.6), tip + vec2(-1.4, 2.4)];
    painter.add(egui::Shape::convex_polygon(head, color, Stroke::NONE));
}

fn eye(painter: &Painter, center: Pos2, open: bool, color: Color32) {
    let stroke = Stroke::new(1.2, color);
    let arc = |sign: f32| -> Vec<Pos2> {
        (0..=10)
            .map(|i| {
                let x = -6.0 + 1.2 * i as f32;
                let y = sign * 3.8 * (1.0 - (x / 6.0).powi(2));
                center + vec2(x, y)
            })
            .collect()
    };
    painter.line(arc(1.0), stroke);
    if open {
        painter.line(arc(-1.0), stroke);
        painter.circle_filled(center, 1.9, color);
    } else {
        for x in [-4.5, 0.0, 4.5] {
            painter.line_segment([center + vec2(x * 0.8, 3.0), center + vec2(x, 6.0)], stroke);
        }
    }
}

/// A cube: with heavy outline and inner edges when they are drawn, faint and empty when not.
fn cube(painter: &Painter, center: Pos2, on: bool, color: Color32) {
    let corner = |degrees: f32| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        center + vec2(cos * 5.6, sin * 5.6)
    };
    let outline: Vec<_> = [30.0, 90.0, 150.0, 210.0, 270.0, 330.0].map(corner).to_vec();
    painter.add(egui::Shape::closed_line(outline, Stroke::new(if on { 1.6 } else { 1.0 }, color)));
    if on {
        for degrees in [210.0, 330.0, 90.0] {
            painter.line_segment([center, corner(degrees)], Stroke::new(1.0, color));
        }
    }
}

/// A pane with a glint.
fn looking_glass(painter: &Painter, center: Pos2, on: bool, color: Color32) {
    let stroke = Stroke::new(if on { 1.6 } else { 1.0 }, color);
    let pane = [vec2(-4.0, -3.5), vec2(4.0, -5.5), vec2(4.0, 5.5), vec2(-4.0, 3.5)].map(|p| center + p);
    painter.add(egui::Shape::closed_line(pane.to_vec(), stroke));
    if on {
        for shift in [0.0, 2.4] {
            let ends = [vec2(-2.2 + shift, 1.2), vec2(0.2 + shift, -2.0)].map(|p| center + p);
            painter.line_segment(ends, Stroke::new(1.0, color));
        }
    }
}

/// A disc behind the corners of sheets.
fn behind_sheets(painter: &Painter, center: Pos2, on: bool, color: Color32) {
    let stroke = Stroke::new(if on { 1.6 } else { 1.0 }, color);
    for [x, y] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
        let corner = center + 5.4 * vec2(x, y);
        painter.line(vec![corner - vec2(3.2 * x, 0.0), corner, corner - vec2(0.0, 3.2 * y)], stroke);
    }
    if on {
        painter.circle_filled(center, 2.6, color);
    } else {
        painter.circle_stroke(center, 2.2, stroke);
    }
}

/// The triangle before a row that has children.
pub fn fold(painter: &Painter, center: Pos2, open: bool, color: Color32) {
    let points = if open {
        vec![vec2(-3.5, -2.0), vec2(3.5, -2.0), vec2(0.0, 3.0)]
    } else {
        vec![vec2(-2.0, -3.5), vec2(3.0, 0.0), vec2(-2.0, 3.5)]
    };
    let points = points.into_iter().map(|p| center + p).collect();
    painter.add(egui::Shape::convex_polygon(points, color, Stroke::NONE));
}

/// The mark of a switch that is on.
pub fn check(painter: &Painter, center: Pos2, visuals: &egui::Visuals) {
    let points = [vec2(-4.0, 0.0), vec2(-1.0, 3.0), vec2(4.0, -3.5)].map(|p| center + p);
    painter.line(points.to_vec(), Stroke::new(1.5, visuals.text_color()));
}
