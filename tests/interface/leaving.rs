//! Before a drawing goes, the person is asked about what would be lost; and nothing behind the question acts.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use eframe::egui;
use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, PointerButton, Vec2};
use egui_kittest::kittest::Queryable as _;
use hachure::app::Launch;
use hachure::app::command::Command;
use hachure::app::dialogs::{Choice, Dialog};
use hachure::app::loading::Intent;
use hachure::document::Document;

use super::{CTRL, Window, ask, click, drag, engine, own, says, settle, until, window_of};

/// What was asked in dialogs, and what is to be answered.
#[derive(Default)]
struct Dialogs {
    asked: Vec<Dialog>,
    answers: Vec<Vec<PathBuf>>,
}

fn window() -> (Window, Arc<Mutex<Dialogs>>) {
    let dialogs = Arc::new(Mutex::new(Dialogs::default()));
    let answering = Arc::clone(&dialogs);
    let mut window = window_of(Launch {
        files: vec!["/models/engine.glb".into()],
        loader: Arc::new(|paths, _, _| Ok(engine(paths))),
        dialogs: Arc::new(move |dialog| {
            let mut dialogs = answering.lock().unwrap();
            dialogs.asked.push(dialog);
            let answer = dialogs.answers.pop().unwrap_or_default();
            Box::pin(std::future::ready(answer))
        }),
        ..Launch::default()
    });
    until(&mut window, "the model is there", |v| !v.is_loading() && !v.model().scene.nodes.is_empty());
    (window, dialogs)
}

/// What the window asks of the system in the next frame.
fn step(window: &mut Window) -> Vec<egui::ViewportCommand> {
    window.step();
    window.output().viewport_output[&egui::ViewportId::ROOT].commands.clone()
}

/// Clicks the close button; whether the window closes.
fn closes(window: &mut Window) -> bool {
    let info = window.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
    info.events.push(egui::ViewportEvent::Close);
    let commands = step(window);
    window.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default().events.clear();
    !commands.contains(&egui::ViewportCommand::CancelClose)
}

/// Presses the keys of quitting; whether the window then asks to be closed.
fn quits(window: &mut Window) -> bool {
    let key = |pressed| egui::Event::Key {
        key: Key::Q,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: CTRL,
    };
    // Only what a frame asks for is known afterwards, so this is to be one.
    window.input_mut().events.push(key(true));
    let asked = step(window);
    window.input_mut().events.push(key(false));
    settle(window);
    asked.contains(&egui::ViewportCommand::Close)
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("only its path matters".to_owned())
    }
}

fn drop_file(window: &mut Window, path: &str) {
    window.input_mut().dropped_files.push(Arc::new(Dropped(path.into())));
    settle(window);
}

fn is_asking(window: &Window) -> bool {
    window.query_by_label("Save the changes?").is_some()
}

fn change(window: &mut Window) {
    click(window, Role::CheckBox, "Show wheel");
}

fn press(window: &mut Window, key: Key) {
    window.key_press(key);
    settle(window);
}

fn models(window: &Window) -> &[PathBuf] {
    &window.state().document().models
}

#[test]
fn what_was_only_looked_at_goes_without_a_question() {
    let (mut window, dialogs) = window();
    let middle = window.get_by_label("Picture").rect().center();
    drag(&mut window, middle, Vec2::new(120.0, 30.0), PointerButton::Primary);
    assert!(closes(&mut window) && !is_asking(&window));
    drop_file(&mut window, "/models/other.glb");
    until(&mut window, "the other is there", |v| v.document().models[0].ends_with("other.glb"));
    ask(&mut window, Command::Open);
    assert_eq!(dialogs.lock().unwrap().asked[0].title, "Open");
    change(&mut window);
    change(&mut window);
    assert!(quits(&mut window), "changed and changed back");
}

#[test]
fn a_drawing_that_was_never_saved_is_asked_about_however_it_goes() {
    let (mut window, dialogs) = window();
    change(&mut window);
    assert!(!closes(&mut window));
    settle(&mut window);
    assert!(is_asking(&window));
    press(&mut window, Key::Escape);
    assert!(!quits(&mut window) && is_asking(&window));
    press(&mut window, Key::Escape);
    assert!(!is_asking(&window));

    drop_file(&mut window, "/models/other.glb");
    assert!(is_asking(&window));
    press(&mut window, Key::Escape);
    let context = window.ctx.clone();
    window.state_mut().load(&context, vec!["/models/other.glb".into()], Intent::Open);
    settle(&mut window);
    assert!(is_asking(&window));
    press(&mut window, Key::Escape);
    ask(&mut window, Command::Open);
    assert!(is_asking(&window) && dialogs.lock().unwrap().asked.is_empty());
    press(&mut window, Key::Escape);
    assert!(!window.state().is_loading());
    assert_eq!(models(&window), [PathBuf::from("/models/engine.glb")]);
    assert_eq!(own(&window, "/engine/wheel").unwrap().visible, Some(false), "nothing was lost");

    // What adds to the drawing takes nothing away.
    window.state_mut().load(&context, vec!["/models/other.glb".into()], Intent::Add);
    until(&mut window, "it was added", |v| !v.is_loading());
    assert_eq!(models(&window).len(), 2);
    assert!(!is_asking(&window));
}

#[test]
fn what_the_person_gives_up_goes_and_what_they_change_again_does_not() {
    let (mut window, dialogs) = window();
    change(&mut window);
    assert!(!quits(&mut window));
    click(&mut window, Role::Button, "Don't save");
    assert!(closes(&mut window));
    change(&mut window);
    click(&mut window, Role::CheckBox, "Show rod");
    assert!(!closes(&mut window), "another drawing than the one that was given up");
    settle(&mut window);
    press(&mut window, Key::Escape);

    // A dialog that is left without a choice takes nothing away: the drawing is asked about again.
    ask(&mut window, Command::Open);
    click(&mut window, Role::Button, "Don't save");
    until(&mut window, "the dialog was answered", |_| true);
    assert_eq!(dialogs.lock().unwrap().asked.len(), 1);
    settle(&mut window);
    assert!(!closes(&mut window));
    settle(&mut window);
    press(&mut window, Key::Escape);

    dialogs.lock().unwrap().answers.push(vec!["/models/other.glb".into()]);
    ask(&mut window, Command::Open);
    click(&mut window, Role::Button, "Don't save");
    until(&mut window, "the other is there", |v| {
        !v.is_loading() && v.document().models[0].ends_with("other.glb")
    });
    assert!(!is_asking(&window), "one question is enough");
    assert!(window.state().document().nodes.is_empty());
    assert!(closes(&mut window));
}

#[test]
fn enter_saves_and_goes_on_only_when_that_succeeded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("drawing.hachure");
    let (mut window, dialogs) = window();
    change(&mut window);
    let document = window.state().document().clone();

    assert!(!quits(&mut window));
    press(&mut window, Key::Enter);
    let chose = |dialogs: &Mutex<Dialogs>| dialogs.lock().unwrap().asked.len();
    until(&mut window, "the dialog was answered", |_| chose(&dialogs) == 1);
    assert_eq!(dialogs.lock().unwrap().asked[0].choice, Choice::Name("engine.hachure".to_owned()));
    assert!(!is_asking(&window) && !closes(&mut window), "no file was chosen");
    settle(&mut window);
    press(&mut window, Key::Escape);

    dialogs.lock().unwrap().answers.push(vec![folder.path().join("missing/drawing.hachure")]);
    drop_file(&mut window, "/models/other.glb");
    press(&mut window, Key::Enter);
    until(&mut window, "saving fails", |v| !v.notices().list().is_empty());
    assert!(!window.state().is_loading());
    assert_eq!(window.state().document(), &document);

    // The ending is added to the chosen name.
    dialogs.lock().unwrap().answers.push(vec![folder.path().join("drawing")]);
    drop_file(&mut window, "/models/other.glb");
    press(&mut window, Key::Enter);
    until(&mut window, "the other is there", |v| {
        !v.is_loading() && v.document().models[0].ends_with("other.glb")
    });
    assert!(says(&window, "Saved"));
    assert_eq!(Document::open(&path).unwrap().document, document);

    change(&mut window);
    dialogs.lock().unwrap().answers.push(vec![path.clone()]);
    assert!(!quits(&mut window));
    press(&mut window, Key::Enter);
    until(&mut window, "it is saved", |v| !v.is_unsaved());
    assert!(closes(&mut window));
    assert_eq!(&Document::open(&path).unwrap().document, window.state().document());
}

#[test]
fn nothing_behind_the_question_acts() {
    let (mut window, _dialogs) = window();
    click(&mut window, Role::TreeItem, "rod");
    change(&mut window);
    let before = window.state().document().clone();
    assert!(!quits(&mut window));

    for key in [Key::Num1, Key::Num7, Key::F, Key::Slash, Key::Home, Key::Delete, Key::F1, Key::F12] {
        press(&mut window, key);
    }
    for key in [Key::Z, Key::H, Key::A, Key::Q, Key::O, Key::S] {
        window.key_press_modifiers(CTRL, key);
        settle(&mut window);
    }
    let corner = window.get_by_label("Picture").rect().min + Vec2::splat(20.0);
    for button in [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary] {
        window.hover_at(corner);
        let wheel = egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Line,
            delta: Vec2::new(0.0, 3.0),
            modifiers: Modifiers::NONE,
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
        };
        window.event(wheel);
        settle(&mut window);
        if button == PointerButton::Primary {
            // A click beside the question would be an answer to it.
            continue;
        }
        drag(&mut window, corner, Vec2::new(60.0, 20.0), button);
    }
    drop_file(&mut window, "/models/other.glb");
    assert!(is_asking(&window));
    assert_eq!(window.state().document(), &before);
    assert!(!window.state().is_loading());
    assert!(window.query_by_label("Mouse in the picture").is_none(), "no list of keys");

    // The focus stays among the answers, and Enter gives the one that has it.
    for _ in 0..2 {
        press(&mut window, Key::Tab);
    }
    assert!(window.get_by_role_and_label(Role::Button, "Cancel").is_focused());
    press(&mut window, Key::Enter);
    assert!(!is_asking(&window));
    assert_eq!(window.state().document(), &before, "Enter framed nothing");
    assert!(window.state().selection().iter().next().is_some(), "and Esc would have cleared nothing");
    press(&mut window, Key::Num1);
    assert_ne!(window.state().document(), &before, "now keys act again");
}

#[test]
fn a_drag_ends_where_the_question_begins() {
    let (mut window, _dialogs) = window();
    change(&mut window);
    let middle = window.get_by_label("Picture").rect().center() + Vec2::new(0.0, 250.0);
    let press = |pressed, pos| egui::Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.event(egui::Event::PointerMoved(middle));
    window.event(press(true, middle));
    window.event(egui::Event::PointerMoved(middle + Vec2::new(30.0, 0.0)));
    window.step();
    assert!(!closes(&mut window));
    let before = window.state().document().clone();
    window.event(egui::Event::PointerMoved(middle + Vec2::new(90.0, 0.0)));
    settle(&mut window);
    assert_eq!(window.state().document(), &before);
}
