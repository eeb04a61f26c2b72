//! A 2×2 matrix that makes offsets of noise: four numbers, and two handles on a picture of the offsets.

use eframe::egui;
use eframe::egui::{Color32, EventFilter, Key, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, vec2};

use crate::style::Matrix;

/// Largest side of the picture.
const SIDE: f32 = 132.0;

/// Radius of a handle.
const HANDLE: f32 = 5.0;

/// Between the sides of a number and the number: narrow, for two of them stand beside each other.
const NUMBER_PADDING: f32 = 3.0;

/// What numbers are rounded to where a handle is moved.
const ROUNDED: f32 = 0.05;

/// How far a handle goes for one arrow key.
const STEP: f32 = 0.1;

/// Columns shorter than that have no direction that both could be turned by.
const SHORTEST: f32 = 0.05;

/// How large the offsets of the grid are as a share of the handles' while these are not far out: what tears in pictures
/// does so here.
const OF_GRID: f32 = 0.25;

/// Cells of the grid along a side.
const CELLS: u16 = 12;

/// Vertices of the grid's lines for each cell.
const VERTICES: u16 = 3;

/// Names of the columns, one per noise.
const COLUMNS: [&str; 2] = ["first", "second"];

const DRAGGING: &str = "Drag it: where that noise takes lines. With Shift or Ctrl, both handles turn and grow \
                        together. Click it to move it by arrow keys.";

/// What belongs to a matrix.
pub(super) struct Field<'a> {
    /// Its name.
    pub(super) label: &'a str,
    /// The unit of its numbers.
    pub(super) unit: &'a str,
    /// What the pointer is told.
    pub(super) help: &'a str,
    /// What each number may be at most.
    pub(super) most: f32,
    /// Its own.
    pub(super) id: egui::Id,
}

/// What a handle is dragged from.
#[derive(Clone, Copy)]
struct Dragged {
    from: Pos2,
    matrix: Matrix,
    reach: f32,
}

impl Field<'_> {
    /// The numbers, row by row, the picture, and how far everything goes.
    pub(super) fn ui(&self, ui: &mut Ui, matrix: &mut Matrix) {
        let width = ui.available_width();
        ui.vertical(|ui| {
            ui.set_max_width(width);
            self.numbers_ui(ui, matrix, width);
            self.picture_ui(ui, matrix, width.min(SIDE));
            let mut text = format!("Typically {:.2} {}", matrix.rms(), self.unit);
            if tears(*matrix, self.most) {
                text.push_str("; so large offsets tear lines");
            }
            ui.add(egui::Label::new(egui::RichText::new(text).weak().small()).wrap());
        });
    }

    fn numbers_ui(&self, ui: &mut Ui, matrix: &mut Matrix, width: f32) {
        let colors = colors(ui);
        let gap = ui.spacing().item_spacing.x;
        let size = vec2(((width - gap) / 2.0).floor(), ui.spacing().interact_size.y);
        for (row, across) in matrix.0.iter_mut().zip(["across", "down"]) {
            ui.horizontal(|ui| {
                ui.spacing_mut().button_padding.x = NUMBER_PADDING;
                for ((number, color), noise) in row.iter_mut().zip(colors).zip(COLUMNS) {
                    ui.visuals_mut().override_text_color = Some(color);
                    let drag = egui::DragValue::new(number)
                        .range(-self.most..=self.most)
                        .speed(0.02)
                        .max_decimals(2)
                        .clip_text(true);
                    let hint = format!("{}\n\n{across}, of the {noise} noise", self.help);
                    ui.add_sized(size, drag)
                        .accessible_name(format!("{}, {across} of the {noise} noise", self.label))
                        .on_hover_text(hint);
                }
            });
        }
    }

    fn picture_ui(&self, ui: &mut Ui, matrix: &mut Matrix, side: f32) {
        let (rect, picture) = ui.allocate_exact_size(Vec2::splat(side), Sense::hover());
        let name = format!("{}, picture", self.label);
        picture.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
        let held = self.id.with("reach while dragged");
        let held_reach = ui.data(|d| d.get_temp::<f32>(held)).unwrap_or(0.0);
        let reach = reach(*matrix, self.most).max(held_reach);
        let mut is_held = false;
        let mut marks = [(false, false); 2];
        for ((column, mark), name) in marks.iter_mut().enumerate().zip(COLUMNS) {
            let at = rect.center() + column_of(*matrix, column) * points_per_pixel(side, reach);
            let place = Rect::from_center_size(at, Vec2::splat(3.0 * HANDLE));
            let handle = ui.interact(place, self.id.with(name), Sense::click_and_drag());
            if handle.clicked() {
                handle.request_focus();
            }
            self.drag(ui, &handle, column, matrix, side, reach);
            if handle.has_focus() {
                self.move_by_keys(ui, handle.id, column, matrix);
            }
            is_held |= handle.dragged();
            *mark = (handle.hovered() || handle.dragged(), handle.has_focus());
            let [x, y] = column_of(*matrix, column).into();
            handle.widget_info(|| egui::WidgetInfo {
                current_text_value: Some(format!("{x} across, {y} down")),
                ..egui::WidgetInfo::labeled(
                    egui::Role::Slider,
                    true,
                    format!("{}, {name} handle", self.label),
                )
            });
            handle.on_hover_text(format!("{}\n\n{DRAGGING}", self.help));
        }
        // What a handle is pulled back from stays in sight until it is let go.
        ui.data_mut(|d| {
            d.remove::<f32>(held);
            if is_held {
                d.insert_temp(held, reach);
            }
        });
        if ui.is_rect_visible(rect) {
            let reach = self::reach(*matrix, self.most).max(if is_held { reach } else { 0.0 });
            let grid = OF_GRID * points_per_pixel(side, self.most / 4.0);
            paint_grid(ui, rect, *matrix, grid);
            paint_handles(ui, rect, *matrix, points_per_pixel(side, reach), marks);
        }
    }

    fn drag(
        &self,
        ui: &Ui,
        handle: &egui::Response,
        column: usize,
        matrix: &mut Matrix,
        side: f32,
        reach: f32,
    ) {
        let id = handle.id.with("dragged");
        if handle.drag_started()
            && let Some(from) = ui.input(|i| i.pointer.press_origin())
        {
            ui.data_mut(|d| d.insert_temp(id, Dragged { from, matrix: *matrix, reach }));
        }
        if handle.dragged()
            && let Some(start) = ui.data(|d| d.get_temp::<Dragged>(id))
            && let Some(at) = handle.interact_pointer_pos()
        {
            let by = (at - start.from) / points_per_pixel(side, start.reach);
            *matrix = moved(start.matrix, column, by, ui.input(|i| are_both_moved(i.modifiers)), self.most);
        }
    }

    fn move_by_keys(&self, ui: &Ui, handle: egui::Id, column: usize, matrix: &mut Matrix) {
        let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|m| m.set_focus_lock_filter(handle, filter));
        let (steps, are_both) = ui.input_mut(|i| {
            let modifiers = i.modifiers;
            let mut count = |key| i.count_and_consume_key(modifiers, key) as f32;
            let across = count(Key::ArrowRight) - count(Key::ArrowLeft);
            let down = count(Key::ArrowDown) - count(Key::ArrowUp);
            (vec2(across, down), are_both_moved(modifiers))
        });
        if steps != Vec2::ZERO {
            *matrix = moved(*matrix, column, steps * STEP, are_both, self.most);
        }
    }
}

fn are_both_moved(modifiers: egui::Modifiers) -> bool {
    modifiers.shift || modifiers.ctrl || modifiers.command
}

/// What becomes of the unit vector of one noise.
fn column_of(matrix: Matrix, column: usize) -> Vec2 {
    let [[a, b], [c, d]] = matrix.0;
    if column == 0 { vec2(a, c) } else { vec2(b, d) }
}

fn of_columns([first, second]: [Vec2; 2]) -> Matrix {
    Matrix([[first.x, second.x], [first.y, second.y]])
}

/// Where the noises `noise` take a point.
fn offset(matrix: Matrix, noise: Vec2) -> Vec2 {
    column_of(matrix, 0) * noise.x + column_of(matrix, 1) * noise.y
}

fn largest(matrix: Matrix) -> f32 {
    matrix.numbers().into_iter().fold(0.0, |largest, n| n.abs().max(largest))
}

/// Whether some number is greater than sliders would offer.
fn tears(matrix: Matrix, most: f32) -> bool {
    largest(matrix) > most / 4.0
}

/// What the side of the picture is from its middle: no handle is beyond.
fn reach(matrix: Matrix, most: f32) -> f32 {
    largest(matrix).max(most / 4.0)
}

/// The scale of the picture: handles at the side are seen as a whole.
fn points_per_pixel(side: f32, reach: f32) -> f32 {
    (side / 2.0 - HANDLE - 1.0).max(1.0) / reach
}

/// The matrix with one column moved, or turned and scaled so that this column is moved. What changes is rounded.
fn moved(matrix: Matrix, column: usize, by: Vec2, are_both: bool, most: f32) -> Matrix {
    let before = [0, 1].map(|column| column_of(matrix, column));
    let from = column_of(matrix, column);
    let to = from + by;
    let mut after = before;
    if are_both && from.length() >= SHORTEST {
        // As of complex numbers: to / from.
        let turn = vec2(to.dot(from), to.y * from.x - to.x * from.y) / from.length_sq();
        after = before.map(|c| vec2(turn.x * c.x - turn.y * c.y, turn.y * c.x + turn.x * c.y));
        let largest = largest(of_columns(after));
        if largest > most {
            after = after.map(|c| c * (most / largest));
        }
    } else if let Some(after) = after.get_mut(column) {
        *after = to;
    }
    let mut numbers = of_columns(after).numbers();
    for (number, before) in numbers.iter_mut().zip(matrix.numbers()) {
        if *number != before {
            // No zero is negative.
            *number = (*number / ROUNDED).round() / ROUNDED.recip() + 0.0;
        }
        *number = number.clamp(-most, most);
    }
    Matrix::of_numbers(numbers)
}

/// Two independent smooth noises of mean 0 and mean square 1 at a place whose unit is about a wave.
fn noise(at: Vec2) -> Vec2 {
    // Sums of plane waves: direction, waves per unit, phase.
    const WAVES: [[[f32; 3]; 4]; 2] = [
        [[0.3, 0.9, 0.4], [1.7, 1.2, 2.1], [2.6, 0.7, 4.4], [0.9, 1.5, 5.3]],
        [[0.6, 1.1, 1.3], [1.3, 0.8, 3.0], [2.2, 1.4, 0.2], [2.9, 0.9, 5.9]],
    ];
    let [first, second] = WAVES.map(|waves| {
        let sum = waves.into_iter().map(|[direction, per_unit, phase]| {
            let along = at.dot(Vec2::angled(direction));
            (along * per_unit * std::f32::consts::TAU + phase).sin()
        });
        sum.sum::<f32>() / 2.0_f32.sqrt()
    });
    vec2(first, second)
}

/// One for each noise.
fn colors(ui: &Ui) -> [Color32; 2] {
    let visuals = ui.visuals();
    let second =
        if visuals.dark_mode { Color32::from_rgb(232, 160, 100) } else { Color32::from_rgb(158, 72, 22) };
    [visuals.hyperlink_color, second]
}

/// The grid as the offsets distort it.
fn paint_grid(ui: &Ui, rect: Rect, matrix: Matrix, scale: f32) {
    let visuals = ui.visuals();
    let frame = Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color);
    ui.painter().rect(rect, 3.0, visuals.extreme_bg_color, frame, egui::StrokeKind::Inside);
    let painter = ui.painter().with_clip_rect(rect.shrink(1.0).intersect(ui.clip_rect()));
    let grid = Stroke::new(1.0, visuals.weak_text_color().gamma_multiply(0.5));
    let vertex = |across: f32, down: f32| {
        let share = vec2(across, down) / f32::from(CELLS);
        // More than one wave over the picture, so that they are seen as such.
        rect.min + share * rect.size() + scale * offset(matrix, noise(1.3 * share))
    };
    for line in 0..=CELLS {
        let line = f32::from(line);
        let along = || (0..=CELLS * VERTICES).map(|i| f32::from(i) / f32::from(VERTICES));
        painter.line(along().map(|at| vertex(line, at)).collect(), grid);
        painter.line(along().map(|at| vertex(at, line)).collect(), grid);
    }
}

/// The two handles, which are (pointed at, focused).
fn paint_handles(ui: &Ui, rect: Rect, matrix: Matrix, scale: f32, marks: [(bool, bool); 2]) {
    let visuals = ui.visuals();
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let center = rect.center();
    painter.circle_filled(center, 1.5, visuals.text_color());
    for (column, ((is_hovered, is_focused), color)) in marks.into_iter().zip(colors(ui)).enumerate() {
        let at = center + scale * column_of(matrix, column);
        painter.line_segment([center, at], Stroke::new(1.5, color));
        let radius = if is_hovered { HANDLE + 1.0 } else { HANDLE };
        painter.add(Shape::circle_filled(at, radius, color));
        painter.circle_stroke(at, radius, Stroke::new(1.0, visuals.extreme_bg_color));
        if is_focused {
            painter.circle_stroke(at, radius + 2.0, Stroke::new(1.5, visuals.strong_text_color()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOST: f32 = 32.0;

    #[test]
    fn a_handle_moves_its_own_column_and_is_rounded() {
        let matrix = Matrix([[1.5, 0.33], [-0.3, 1.5]]);
        let by = vec2(0.512, 0.27);
        assert_eq!(moved(matrix, 0, by, false, MOST), Matrix([[2.0, 0.33], [-0.05, 1.5]]));
        assert_eq!(moved(matrix, 1, vec2(0.0, -1.5), false, MOST), Matrix([[1.5, 0.33], [-0.3, 0.0]]));
        assert_eq!(moved(matrix, 1, Vec2::ZERO, true, MOST), matrix);
        assert_eq!(moved(matrix, 0, vec2(90.0, -90.0), false, MOST).numbers(), [32.0, 0.33, -32.0, 1.5]);
        assert!(moved(matrix, 0, vec2(-1.5, 0.3), false, MOST).numbers()[0].is_sign_positive());
    }

    #[test]
    fn both_handles_turn_and_grow_together() {
        let matrix = Matrix([[2.0, 0.0], [0.0, 1.0]]);
        // A quarter turn to twice the size.
        assert_eq!(moved(matrix, 0, vec2(-2.0, 4.0), true, MOST), Matrix([[0.0, -2.0], [4.0, 0.0]]));
        assert_eq!(moved(matrix, 1, vec2(0.0, 1.0), true, MOST), Matrix([[4.0, 0.0], [0.0, 2.0]]));
        // The shape is kept at the limit.
        assert_eq!(moved(matrix, 1, vec2(0.0, 99.0), true, MOST), Matrix([[32.0, 0.0], [0.0, 16.0]]));
        // What has no direction is moved by itself.
        let flat = Matrix([[0.0, 1.0], [0.0, 0.0]]);
        assert_eq!(moved(flat, 0, vec2(1.0, 1.0), true, MOST), Matrix([[1.0, 1.0], [1.0, 0.0]]));
    }

    #[test]
    fn no_handle_lies_outside_of_the_picture() {
        let small = Matrix([[1.0, 0.0], [0.0, -1.0]]);
        assert_eq!((reach(small, MOST), tears(small, MOST)), (8.0, false));
        let large = Matrix([[1.0, 0.0], [-20.0, 3.0]]);
        assert_eq!((reach(large, MOST), tears(large, MOST)), (20.0, true));
        for matrix in [small, large, Matrix::ZERO] {
            let scale = points_per_pixel(SIDE, reach(matrix, MOST));
            for column in [0, 1] {
                let at = scale * column_of(matrix, column);
                assert!(at.abs().max_elem() + HANDLE < SIDE / 2.0, "{matrix}");
            }
        }
    }

    #[test]
    fn offsets_of_the_picture_are_as_large_as_the_matrix_says() {
        let matrix = Matrix([[1.5, 0.3], [-0.3, 1.5]]);
        let (mut noises, mut offsets, mut product) = (Vec2::ZERO, 0.0, 0.0);
        let count = 200_u16;
        for i in 0..count {
            for j in 0..count {
                let noise = noise(vec2(f32::from(i), f32::from(j)) * 0.0973);
                noises += noise * noise;
                product += noise.x * noise.y;
                offsets += offset(matrix, noise).length_sq() / 2.0;
            }
        }
        let count = f32::from(count).powi(2);
        assert!((noises / count - Vec2::splat(1.0)).abs().max_elem() < 0.05, "{:?}", noises / count);
        assert!((product / count).abs() < 0.05);
        assert!(((offsets / count).sqrt() / matrix.rms() - 1.0).abs() < 0.05);
    }
}
