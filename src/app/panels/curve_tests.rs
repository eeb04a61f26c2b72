//! Of the plot of a curve, in a row as every parameter has one.

use eframe::egui;
use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::params::params_ui;
use super::row::Change;
use crate::style::param::Params;
use crate::style::{Curve, Param, Point};

/// From the side of the plot to its unit square.
const MARGIN: f32 = 6.0;

/// A curve, what was asked for, and the states that were noted while no button was down, as for undo.
#[derive(Default)]
struct Edited {
    curve: Curve,
    changes: Vec<Change>,
    steps: Vec<Curve>,
}

struct Window(Harness<'static, Edited>);

fn params(curve: &mut Curve) -> Vec<Param<'_>> {
    let mut list = Params::default();
    list.section("hatching", |list| list.curve("curve", "Tone curve", "How dark each tone is drawn.", curve));
    list.finish()
}

impl Window {
    fn new() -> Self {
        let draw = |ui: &mut egui::Ui, edited: &mut Edited| {
            let changes =
                params_ui(ui, "hatching", &mut params(&mut edited.curve), &params(&mut Curve::default()));
            edited.changes.extend(changes);
            if !ui.input(|i| i.pointer.any_down()) && edited.steps.last() != Some(&edited.curve) {
                edited.steps.push(edited.curve);
            }
        };
        let size = vec2(280.0, 240.0);
        let window = Harness::builder().with_size(size).with_step_dt(1.0 / 60.0);
        Self(window.build_ui_state(draw, Edited::default()))
    }

    fn settle(&mut self) {
        self.0.run_steps(4);
    }

    fn points(&self) -> Vec<[f32; 2]> {
        self.0.state().curve.points().iter().map(|p| [p.x, p.y]).collect()
    }

    fn position(&self, [x, y]: [f32; 2]) -> Pos2 {
        let square = self.0.get_by_label("Tone curve, plot").rect().shrink(MARGIN);
        square.left_bottom() + vec2(x, -y) * square.size()
    }

    fn by(&self, x: f32, y: f32) -> Vec2 {
        self.position([x, y]) - self.position([0.0, 0.0])
    }

    fn button(&self, pos: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
        self.0.event(Event::PointerButton { pos, button, pressed, modifiers });
    }

    fn click(&mut self, at: [f32; 2], button: PointerButton, modifiers: Modifiers) {
        let pos = self.position(at);
        self.0.event(Event::PointerMoved(pos));
        self.0.step();
        for pressed in [true, false] {
            self.button(pos, button, pressed, modifiers);
            self.0.step();
        }
    }

    fn double_click(&mut self, at: [f32; 2]) {
        self.click(at, PointerButton::Primary, Modifiers::NONE);
        self.click(at, PointerButton::Primary, Modifiers::NONE);
        // What follows is no third click.
        self.0.run_steps(60);
    }

    /// Presses, and moves along the way, but does not let go.
    fn pull(&mut self, from: [f32; 2], way: &[Vec2]) -> Pos2 {
        let from = self.position(from);
        self.0.event(Event::PointerMoved(from));
        self.0.step();
        self.button(from, PointerButton::Primary, true, Modifiers::NONE);
        self.0.step();
        let mut at = from;
        for to in way {
            for i in 1..=5 {
                self.0.event(Event::PointerMoved(at + (from + *to - at) * (i as f32 / 5.0)));
                self.0.step();
            }
            at = from + *to;
        }
        at
    }

    fn drag(&mut self, from: [f32; 2], way: &[Vec2]) {
        let at = self.pull(from, way);
        self.button(at, PointerButton::Primary, false, Modifiers::NONE);
        self.settle();
    }

    fn says(&self, text: &str) -> bool {
        self.0.query_by_role_and_label(Role::Label, text).is_some()
    }
}

#[test]
fn points_are_added_and_removed() {
    let mut window = Window::new();
    window.settle();
    assert!(window.says("2 of 8 points"));
    window.click([0.4, 0.7], PointerButton::Primary, Modifiers::NONE);
    window.settle();
    assert_eq!(window.points().len(), 2, "one click is none");
    window.0.run_steps(60);
    window.double_click([0.4, 0.7]);
    assert_eq!(window.points(), [[0.0, 0.0], [0.4, 0.7], [1.0, 1.0]]);
    let added = window.0.state().changes.last().cloned();
    assert!(matches!(added, Some(Change::Set(key, value))
        if key == "hatching.curve" && value.to_string() == "0,0,0.4,0.7,1,1"));
    assert!(window.says("0.40 becomes 0.70"), "of the point below the pointer");

    window.double_click([0.4, 0.7]);
    assert_eq!(window.points().len(), 3, "there is one already");
    for x in [0.1, 0.25, 0.55, 0.7, 0.85] {
        window.double_click([x, 0.3]);
    }
    assert_eq!(window.points().len(), 8);
    window.double_click([0.95, 0.1]);
    assert_eq!(window.points().len(), 8, "there is no room");

    for x in [0.1, 0.25, 0.55, 0.7, 0.85] {
        window.click([x, 0.3], PointerButton::Secondary, Modifiers::NONE);
    }
    window.click([0.0, 0.0], PointerButton::Secondary, Modifiers::NONE);
    window.click([1.0, 1.0], PointerButton::Secondary, Modifiers::NONE);
    assert_eq!(window.points(), [[0.0, 0.0], [0.4, 0.7], [1.0, 1.0]], "ends stay");

    window.0.get_by_role_and_label(Role::Button, "Reset Tone curve").click_accesskit();
    window.settle();
    assert_eq!(window.0.state().curve, Curve::LINEAR);
    assert!(window.0.query_by_role_and_label(Role::Button, "Reset Tone curve").is_none());
}

#[test]
fn nothing_is_added_while_a_modifier_is_held() {
    let mut window = Window::new();
    window.settle();
    window.0.event(Event::ModifiersChanged(Modifiers::SHIFT));
    for _ in 0..2 {
        window.click([0.4, 0.7], PointerButton::Primary, Modifiers::SHIFT);
    }
    window.settle();
    assert_eq!(window.points().len(), 2);
}

#[test]
fn a_point_is_dragged_in_one_step_and_stays_between_its_neighbors() {
    let mut window = Window::new();
    window.settle();
    window.double_click([0.5, 0.5]);
    let steps = window.0.state().steps.len();
    let to = window.by(0.2, -0.25);
    window.drag([0.5, 0.5], &[to]);
    assert_eq!(window.points(), [[0.0, 0.0], [0.7, 0.25], [1.0, 1.0]]);
    assert_eq!(window.0.state().steps.len(), steps + 1, "one drag is one step");
    assert!(window.says("0.70 becomes 0.25"));

    // Beyond the neighbor and the top, but not out of the plot.
    let to = window.by(0.4, 0.85);
    window.drag([0.7, 0.25], &[to]);
    assert_eq!(window.points(), [[0.0, 0.0], [0.99, 1.0], [1.0, 1.0]]);
}

#[test]
fn ends_are_dragged_up_and_down_only() {
    let mut window = Window::new();
    window.settle();
    let to = window.by(0.3, 0.2);
    window.drag([0.0, 0.0], &[to]);
    let to = window.by(0.9, -0.4);
    window.drag([1.0, 1.0], &[to]);
    assert_eq!(window.points(), [[0.0, 0.2], [1.0, 0.6]], "far outside of the plot too");
}

#[test]
fn a_point_that_is_dragged_out_is_gone_once_it_is_let_go() {
    let mut window = Window::new();
    window.settle();
    window.double_click([0.3, 0.3]);
    window.double_click([0.6, 0.6]);
    let [out, back] = [window.by(0.0, -1.5), window.by(0.1, 0.1)];
    let steps = window.0.state().steps.len();
    let at = window.pull([0.3, 0.3], &[out]);
    assert_eq!(window.points(), [[0.0, 0.0], [0.6, 0.6], [1.0, 1.0]]);
    let to = window.position([0.4, 0.4]);
    window.0.event(Event::PointerMoved(to));
    window.settle();
    assert_eq!(window.points(), [[0.0, 0.0], [0.4, 0.4], [0.6, 0.6], [1.0, 1.0]], "it comes back");
    window.0.event(Event::PointerMoved(at));
    window.0.step();
    window.button(at, PointerButton::Primary, false, Modifiers::NONE);
    window.settle();
    assert_eq!(window.points(), [[0.0, 0.0], [0.6, 0.6], [1.0, 1.0]]);
    assert_eq!(window.0.state().steps.len(), steps + 1);
    window.drag([0.6, 0.6], &[out, back]);
    assert_eq!(window.points(), [[0.0, 0.0], [0.7, 0.7], [1.0, 1.0]], "the other can be dragged now");
}

#[test]
fn a_point_is_moved_and_removed_by_keys() {
    let mut window = Window::new();
    window.settle();
    window.double_click([0.5, 0.5]);
    window.0.get_by_role_and_label(Role::Slider, "Tone curve, point 2").focus();
    window.settle();
    for (key, modifiers, point) in [
        (Key::ArrowRight, Modifiers::NONE, [0.51, 0.5]),
        (Key::ArrowUp, Modifiers::SHIFT, [0.51, 0.6]),
        (Key::ArrowDown, Modifiers::NONE, [0.51, 0.59]),
        (Key::ArrowLeft, Modifiers::SHIFT, [0.41, 0.59]),
    ] {
        window.0.key_press_modifiers(modifiers, key);
        window.settle();
        assert_eq!(window.points()[1], point, "{key:?}");
    }
    window.0.key_press(Key::Delete);
    window.settle();
    assert_eq!(window.0.state().curve, Curve::LINEAR);
    window.0.get_by_role_and_label(Role::Slider, "Tone curve, point 1").focus();
    window.settle();
    window.0.key_press(Key::Backspace);
    window.0.key_press(Key::ArrowRight);
    window.0.key_press(Key::ArrowDown);
    window.settle();
    assert_eq!(window.0.state().curve, Curve::LINEAR, "an end stays");
}

#[test]
fn the_plot_says_what_the_curve_gives_below_the_pointer() {
    let mut window = Window::new();
    let points = [[0.0, 1.0], [1.0, 0.0]].map(Point::from);
    window.0.state_mut().curve = Curve::of_points(&points).unwrap();
    window.settle();
    let at = window.position([0.25, 0.1]);
    window.0.hover_at(at);
    window.settle();
    assert!(window.says("0.25 becomes 0.75"));
    assert!(window.0.state().changes.is_empty(), "looking changes nothing");
}
