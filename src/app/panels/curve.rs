//! A curve on a small plot: its points are handles.

use eframe::egui;
use eframe::egui::{
    EventFilter, Key, Pos2, Rect, RichText, Sense, Stroke, Ui, Vec2, lerp, pos2, remap, vec2,
};

use crate::style::{Curve, Point};

/// Largest side of the plot.
const SIDE: f32 = 132.0;

/// Radius of a handle.
const HANDLE: f32 = 4.5;

/// How far outside of the plot a point is let go of.
const OUTSIDE: f32 = 24.0;

/// Values per unit to which what is moved is rounded.
const PER_UNIT: f32 = 100.0;

/// How far a point goes for one arrow key.
const STEP: f32 = 0.01;

/// How far it goes while Shift is held.
const LARGE_STEP: f32 = 0.1;

/// Values by which the curve is drawn: at every hundredth.
const SAMPLES: usize = 101;

const ADDING: &str = "Double-click an empty place to add a point there.";

const DRAGGING: &str = "Drag it, or click it and press arrow keys (with Shift ten times as far). Right-click it, press \
                        Delete or drag it out of the plot to remove it.";

const DRAGGING_END: &str =
    "Drag it up or down, or click it and press arrow keys (with Shift ten times as far).";

/// What belongs to a curve.
pub(super) struct Field<'a> {
    /// Its name.
    pub(super) label: &'a str,
    /// What the pointer is told.
    pub(super) help: &'a str,
    /// Its own.
    pub(super) id: egui::Id,
}

/// What a point is dragged from.
#[derive(Clone, Copy)]
struct Dragged {
    index: usize,
    from: Pos2,
    curve: Curve,
}

/// Which points are pointed at or dragged, and which has the focus.
#[derive(Default)]
struct Marks {
    hovered: Option<usize>,
    focused: Option<usize>,
}

/// Where the unit square is on the screen.
#[derive(Clone, Copy)]
struct Plot(Rect);

impl Plot {
    fn position(self, point: Point) -> Pos2 {
        pos2(lerp(self.0.x_range(), point.x), lerp(self.0.bottom()..=self.0.top(), point.y))
    }

    /// It lies outside of the unit square where `at` lies outside of the plot.
    fn point(self, at: Pos2) -> Point {
        let y = remap(at.y, self.0.bottom()..=self.0.top(), 0.0..=1.0);
        Point { x: remap(at.x, self.0.x_range(), 0.0..=1.0), y }
    }
}

impl Field<'_> {
    /// The plot, and below it the numbers of what is pointed at.
    pub(super) fn ui(&self, ui: &mut Ui, curve: &mut Curve) {
        let width = ui.available_width();
        ui.vertical(|ui| {
            ui.set_max_width(width);
            let (rect, picture) = ui.allocate_exact_size(Vec2::splat(width.min(SIDE)), Sense::click());
            let name = format!("{}, plot", self.label);
            picture.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
            let plot = Plot(rect.shrink(HANDLE + 1.5));
            let marks = self.handles_ui(ui, plot, curve);
            if picture.double_clicked()
                && ui.input(|i| i.modifiers.is_none())
                && let Some(at) = picture.interact_pointer_pos()
            {
                *curve = with(*curve, plot.point(at));
            }
            let place = picture.hover_pos().map(|at| plot.point(at).x.clamp(0.0, 1.0));
            let place = place.map(|x| Point { x, y: curve.at(x) });
            let marked = marks.hovered.or(if place.is_none() { marks.focused } else { None });
            let shown = marked.and_then(|index| curve.points().get(index).copied()).or(place);
            if ui.is_rect_visible(rect) {
                paint(ui, rect, plot, curve, place);
                paint_handles(ui, plot, curve, &marks);
            }
            let text = match shown {
                Some(point) => numbers(point),
                None => format!("{} of {} points", curve.points().len(), Curve::MAX_POINTS),
            };
            ui.add(egui::Label::new(RichText::new(text).weak().small()).truncate());
            picture.on_hover_text(format!("{}\n\n{ADDING}", self.help));
        });
    }

    fn handles_ui(&self, ui: &Ui, plot: Plot, curve: &mut Curve) -> Marks {
        let held = self.id.with("dragged");
        let dragged = ui.data(|d| d.get_temp::<Dragged>(held));
        // While one is dragged out, the others keep their numbers.
        let shown = dragged.map_or(*curve, |dragged| dragged.curve);
        let mut marks = Marks::default();
        let mut is_held = false;
        for (index, point) in shown.points().iter().enumerate() {
            let place = Rect::from_center_size(plot.position(*point), Vec2::splat(3.0 * HANDLE));
            let handle = ui.interact(place, self.id.with(index), Sense::click_and_drag());
            let is_end = index == 0 || index + 1 == shown.points().len();
            if handle.clicked() {
                handle.request_focus();
            }
            if handle.drag_started()
                && let Some(from) = ui.input(|i| i.pointer.press_origin())
            {
                ui.data_mut(|d| d.insert_temp(held, Dragged { index, from, curve: *curve }));
            }
            if handle.dragged() {
                is_held = true;
                drag(ui, &handle, plot, held, curve);
            } else if handle.secondary_clicked() {
                *curve = without(*curve, index);
            } else if handle.has_focus() {
                change_by_keys(ui, handle.id, index, curve);
            }
            if handle.dragged() || handle.hovered() && dragged.is_none() {
                marks.hovered = Some(index);
            }
            if handle.has_focus() {
                marks.focused = Some(index);
            }
            let name = format!("{}, point {}", self.label, index + 1);
            let value = numbers(*point);
            handle.widget_info(|| egui::WidgetInfo {
                current_text_value: Some(value.clone()),
                ..egui::WidgetInfo::labeled(egui::Role::Slider, true, &name)
            });
            let how = if is_end { DRAGGING_END } else { DRAGGING };
            handle.on_hover_text(format!("{value}\n\n{}\n\n{how}", self.help));
        }
        if !is_held {
            ui.data_mut(|d| d.remove::<Dragged>(held));
        }
        if curve.points().len() != shown.points().len() {
            marks = Marks::default();
        }
        marks
    }
}

/// Moves what is dragged, or takes it away while it is outside of the plot.
fn drag(ui: &Ui, handle: &egui::Response, plot: Plot, held: egui::Id, curve: &mut Curve) {
    let Some(Dragged { index, from, curve: before }) = ui.data(|d| d.get_temp::<Dragged>(held)) else {
        return;
    };
    let (Some(at), Some(start)) = (handle.interact_pointer_pos(), before.points().get(index)) else {
        return;
    };
    let to = plot.point(plot.position(*start) + (at - from));
    let moved = moved(before, index, to);
    let is_outside = !plot.0.expand(OUTSIDE).contains(at);
    // What cannot be removed is moved.
    *curve = Some(without(before, index)).filter(|after| is_outside && *after != before).unwrap_or(moved);
}

fn change_by_keys(ui: &Ui, handle: egui::Id, index: usize, curve: &mut Curve) {
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|m| m.set_focus_lock_filter(handle, filter));
    let (steps, is_removed) = ui.input_mut(|i| {
        let modifiers = i.modifiers;
        let step = if modifiers.shift { LARGE_STEP } else { STEP };
        let mut count = |key| i.count_and_consume_key(modifiers, key) as f32;
        let right = count(Key::ArrowRight) - count(Key::ArrowLeft);
        let up = count(Key::ArrowUp) - count(Key::ArrowDown);
        (step * vec2(right, up), count(Key::Delete) + count(Key::Backspace) > 0.0)
    });
    if is_removed {
        *curve = without(*curve, index);
    } else if steps != Vec2::ZERO
        && let Some(Point { x, y }) = curve.points().get(index)
    {
        *curve = moved(*curve, index, Point { x: x + steps.x, y: y + steps.y });
    }
}

/// `0.40 becomes 0.25`
fn numbers(point: Point) -> String {
    format!("{:.2} becomes {:.2}", point.x, point.y)
}

fn rounded(number: f32) -> f32 {
    // No zero is negative.
    (number * PER_UNIT).round() / PER_UNIT + 0.0
}

/// The curve with one point moved as near to `to` as its neighbors allow; an end moves up and down only. What changes is
/// rounded.
fn moved(curve: Curve, index: usize, to: Point) -> Curve {
    let mut points = curve.points().to_vec();
    let x_of = |index: Option<usize>| index.and_then(|i| curve.points().get(i)).map(|point| point.x);
    let neighbors = x_of(index.checked_sub(1)).zip(x_of(index.checked_add(1)));
    let Some(point) = points.get_mut(index) else {
        return curve;
    };
    if let Some((before, after)) = neighbors
        && to.x != point.x
    {
        // Rounded inwards, but for errors of rounding.
        let least = ((before + Curve::MIN_GAP) * PER_UNIT - 1e-3).ceil() / PER_UNIT;
        let most = ((after - Curve::MIN_GAP) * PER_UNIT + 1e-3).floor() / PER_UNIT;
        if least <= most {
            point.x = rounded(to.x).max(least).min(most);
        }
    }
    if to.y != point.y {
        point.y = rounded(to.y.clamp(0.0, 1.0));
    }
    Curve::of_points(&points).unwrap_or(curve)
}

/// The curve with one point more, if there is room for it.
fn with(curve: Curve, point: Point) -> Curve {
    let point = Point { x: rounded(point.x), y: rounded(point.y.clamp(0.0, 1.0)) };
    let mut points = curve.points().to_vec();
    points.insert(points.partition_point(|p| p.x < point.x), point);
    Curve::of_points(&points).unwrap_or(curve)
}

/// The curve with one point less, if that is not an end.
fn without(curve: Curve, index: usize) -> Curve {
    let others = curve.points().iter().enumerate().filter(|(i, _)| *i != index).map(|(_, point)| *point);
    Curve::of_points(&others.collect::<Vec<_>>()).unwrap_or(curve)
}

/// The square with its quarters, the line of what is left as it is, the curve, and what it gives at a place.
fn paint(ui: &Ui, rect: Rect, plot: Plot, curve: &Curve, place: Option<Point>) {
    let visuals = ui.visuals();
    let frame = Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color);
    ui.painter().rect(rect, 3.0, visuals.extreme_bg_color, frame, egui::StrokeKind::Inside);
    let painter = ui.painter().with_clip_rect(rect.shrink(1.0).intersect(ui.clip_rect()));
    let line = |from: [f32; 2], to: [f32; 2], stroke: Stroke| {
        painter.line_segment([from, to].map(|at| plot.position(at.into())), stroke);
    };
    for quarter in [0.0, 0.25, 0.5, 0.75, 1.0] {
        line([quarter, 0.0], [quarter, 1.0], frame);
        line([0.0, quarter], [1.0, quarter], frame);
    }
    let faint = Stroke::new(1.0, visuals.weak_text_color().gamma_multiply(0.5));
    line([0.0, 0.0], [1.0, 1.0], faint);
    if let Some(Point { x, y }) = place {
        line([x, 0.0], [x, y], faint);
        line([0.0, y], [x, y], faint);
    }
    let along = curve.table(SAMPLES).into_iter().enumerate();
    let along = along.map(|(i, y)| plot.position(Point { x: i as f32 / (SAMPLES - 1) as f32, y }));
    painter.line(along.collect(), Stroke::new(1.5, visuals.text_color()));
}

fn paint_handles(ui: &Ui, plot: Plot, curve: &Curve, marks: &Marks) {
    let visuals = ui.visuals();
    for (index, point) in curve.points().iter().enumerate() {
        let at = plot.position(*point);
        let radius = if marks.hovered == Some(index) { HANDLE + 1.0 } else { HANDLE };
        let rim = Stroke::new(1.0, visuals.extreme_bg_color);
        ui.painter().circle(at, radius, visuals.hyperlink_color, rim);
        if marks.focused == Some(index) {
            let ring = Stroke::new(1.5, visuals.strong_text_color());
            ui.painter().circle_stroke(at, radius + 2.0, ring);
        }
    }
}
