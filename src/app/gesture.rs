//! What the pointer does to the picture, event by event: on a slow machine a whole drag may lie between two frames.

use eframe::egui;
use eframe::egui::{Event, Modifiers, PointerButton, Pos2, Ui, Vec2};

/// A press that moves less than this, in points, is a click.
const CLICK_RADIUS: f32 = 3.0;

/// A button that is held down on the picture.
#[derive(Debug, Clone, Copy)]
struct Press {
    button: PointerButton,
    origin: Pos2,
    last: Pos2,
    is_drag: bool,
}

/// Follows the pointer from frame to frame.
#[derive(Debug, Default)]
pub struct Gestures {
    press: Option<Press>,
    was_drag: bool,
}

/// A drag, as far as it went in this frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drag {
    /// The button that is held.
    pub button: PointerButton,
    /// The keys that are held, too.
    pub modifiers: Modifiers,
    /// How far it went, in points.
    pub by: Vec2,
}

impl Gestures {
    /// The drags of this frame that began where `is_picture` says so.
    pub fn drags(&mut self, ui: &Ui, is_picture: impl Fn(Pos2) -> bool) -> Vec<Drag> {
        let (events, modifiers, any_down) =
            ui.input(|i| (i.events.clone(), i.modifiers, i.pointer.any_down()));
        let mut drags = Vec::new();
        for event in events {
            match event {
                Event::PointerButton { pos, button, pressed: true, .. } if self.press.is_none() => {
                    self.was_drag = false;
                    if is_picture(pos) {
                        self.press = Some(Press { button, origin: pos, last: pos, is_drag: false });
                    }
                }
                Event::PointerButton { pos, button, pressed: false, .. } => {
                    self.follow(pos, modifiers, &mut drags);
                    if self.press.is_some_and(|p| p.button == button) {
                        self.press = None;
                    }
                }
                Event::PointerMoved(pos) => self.follow(pos, modifiers, &mut drags),
                _ => {}
            }
        }
        if !any_down {
            // The release may have been lost outside of the window.
            self.press = None;
        }
        drags
    }

    /// Whether the last press became a drag, so that its release is no click.
    pub fn was_drag(&self) -> bool {
        self.was_drag
    }

    /// The button with which the picture is being dragged.
    pub fn dragging(&self) -> Option<PointerButton> {
        self.press.filter(|p| p.is_drag).map(|p| p.button)
    }

    fn follow(&mut self, pos: Pos2, modifiers: Modifiers, drags: &mut Vec<Drag>) {
        let Some(press) = &mut self.press else { return };
        press.is_drag |= pos.distance(press.origin) > CLICK_RADIUS;
        if !press.is_drag {
            return;
        }
        self.was_drag = true;
        let by = pos - press.last;
        press.last = pos;
        if by != Vec2::ZERO {
            drags.push(Drag { button: press.button, modifiers, by });
        }
    }
}

/// Notches of the wheel in this frame, as they come: egui's own smoothing would draw many pictures per notch.
pub fn notches(ui: &Ui) -> f64 {
    ui.input(|i| {
        i.events
            .iter()
            .map(|event| match event {
                Event::MouseWheel { unit, delta, .. } => {
                    let per_notch = match unit {
                        egui::MouseWheelUnit::Point => 50.0,
                        egui::MouseWheelUnit::Line => 1.0,
                        egui::MouseWheelUnit::Page => 0.2,
                    };
                    f64::from(delta.y) / per_notch
                }
                Event::Zoom(factor) => f64::from(factor.max(0.01)).ln() * 8.0,
                _ => 0.0,
            })
            .sum()
    })
}
