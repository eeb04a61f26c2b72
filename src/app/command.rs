//! Everything a person can ask the window to do, with its text, help and keys.
//!
//! Menus, keys, buttons and the list of keys all read this one enumeration; `viewer/execute.rs` carries commands out.

use eframe::egui;
use eframe::egui::{Key, KeyboardShortcut, Modifiers};
use strum::{EnumIter, IntoEnumIterator as _};

/// One thing to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, EnumIter)]
pub enum Command {
    /// Open models or a document in place of what is there.
    Open,
    /// Add models to what is there.
    Add,
    /// Read the files again.
    Reload,
    /// Save the document.
    Save,
    /// Save the document under a new name.
    SaveAs,
    /// Save the picture among the person's pictures.
    Screenshot,
    /// The same without paper.
    TransparentScreenshot,
    /// Save the picture under a chosen name.
    ScreenshotAs,
    /// Leave.
    Quit,
    /// Take the last change back.
    Undo,
    /// Do it again.
    Redo,
    /// Select every object.
    SelectAll,
    /// Select nothing.
    SelectNone,
    /// Do not draw the selection.
    Hide,
    /// Draw nothing but the selection.
    Isolate,
    /// Draw everything again.
    ShowAll,
    /// Draw a box around the selected object.
    AddBox,
    /// Place an arrow.
    AddArrow,
    /// Place a path with arrow heads.
    AddPath,
    /// Place a label.
    AddLabel,
    /// Remove the selected glyphs.
    Delete,
    /// Frame everything from the standard direction.
    Home,
    /// Frame everything from the present direction.
    FrameAll,
    /// Frame the selection.
    FrameSelected,
    /// From the front.
    Front,
    /// From the back.
    Back,
    /// From the right.
    Right,
    /// From the left.
    Left,
    /// From above.
    Top,
    /// From below.
    Bottom,
    /// From front, right and above.
    Isometric,
    /// The camera in the file.
    FileCamera,
    /// One step to the left.
    OrbitLeft,
    /// One step to the right.
    OrbitRight,
    /// One step up.
    OrbitUp,
    /// One step down.
    OrbitDown,
    /// Perspective or parallel projection.
    Projection,
    /// Show or hide all panels.
    Panels,
    /// Show or hide the outliner.
    Outliner,
    /// Show or hide the panel of styles.
    Inspector,
    /// Show or hide how long a picture takes.
    Statistics,
    /// Dark or light panels.
    DarkPanels,
    /// Fill the screen.
    FullScreen,
    /// What could not be loaded.
    Warnings,
    /// Read changed shaders again.
    ReloadShaders,
    /// The list of keys.
    Help,
}

/// A heading of the list of keys and a menu.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter)]
pub enum CommandGroup {
    /// Files and pictures.
    File,
    /// Undo and selection.
    Edit,
    /// Glyphs.
    Glyphs,
    /// The camera.
    View,
    /// The window.
    Window,
    /// Help.
    Help,
}

impl CommandGroup {
    /// Its heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::Glyphs => "Glyphs",
            Self::View => "View",
            Self::Window => "Window",
            Self::Help => "Help",
        }
    }
}

const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

impl Command {
    /// Its name in menus.
    pub fn text(self) -> &'static str {
        self.about().0
    }

    /// One line that says what it does.
    pub fn tooltip(self) -> &'static str {
        self.about().1
    }

    fn about(self) -> (&'static str, &'static str) {
        match self {
            Self::Open => ("Open…", "Open models or a drawing in place of what is shown"),
            Self::Add => ("Add…", "Add models to what is shown"),
            Self::Reload => ("Reload", "Read the model files again; the camera stays"),
            Self::Save => ("Save", "Save styles, camera, lights and view as a drawing (.hachure)"),
            Self::SaveAs => ("Save as…", "Save the drawing under another name"),
            Self::Screenshot => ("Save screenshot", "Save exactly this picture among your pictures"),
            Self::TransparentScreenshot => {
                ("Save transparent screenshot", "Save this picture without paper among your pictures")
            }
            Self::ScreenshotAs => {
                ("Save screenshot as…", "Save exactly this picture under a name of your choice")
            }
            Self::Quit => ("Quit", "Close the window"),
            Self::Undo => ("Undo", "Take the last change back"),
            Self::Redo => ("Redo", "Do again what was taken back"),
            Self::SelectAll => ("Select all", "Select every object"),
            Self::SelectNone => ("Select nothing", "Clear the selection"),
            Self::Hide => ("Hide selected", "Do not draw the selected objects"),
            Self::Isolate => ("Isolate selected", "Draw only the selected objects; again to show all"),
            Self::ShowAll => ("Show all", "Draw every object again"),
            Self::AddBox => ("Box", "Draw a box around the selected object"),
            Self::AddArrow => ("Arrow", "Place an arrow by two clicks on surfaces"),
            Self::AddPath => ("Path", "Place a path with an arrow head, by clicks on surfaces"),
            Self::AddLabel => ("Label", "Write something beside a point of a surface"),
            Self::Delete => ("Delete glyph", "Remove the selected glyphs; objects of the model stay"),
            Self::Home => ("Home view", "See everything from front, right and above"),
            Self::FrameAll => ("Frame all", "See everything from the present direction"),
            Self::FrameSelected => ("Frame selected", "Fill the picture with the selected objects"),
            Self::Front => ("Front", "Look from the front"),
            Self::Back => ("Back", "Look from the back"),
            Self::Right => ("Right", "Look from the right"),
            Self::Left => ("Left", "Look from the left"),
            Self::Top => ("Top", "Look from above"),
            Self::Bottom => ("Bottom", "Look from below"),
            Self::Isometric => ("Isometric", "Look from front, right and above at equal angles"),
            Self::FileCamera => ("Camera of the file", "Look through the first camera in the file"),
            Self::OrbitLeft => ("Step left", "Move the eye 15° to the left"),
            Self::OrbitRight => ("Step right", "Move the eye 15° to the right"),
            Self::OrbitUp => ("Step up", "Move the eye 15° up"),
            Self::OrbitDown => ("Step down", "Move the eye 15° down"),
            Self::Projection => ("Parallel projection", "Switch between perspective and parallel projection"),
            Self::Panels => ("All panels", "Show or hide everything around the picture"),
            Self::Outliner => ("Outliner", "Show or hide the list of objects"),
            Self::Inspector => ("Style, light and view", "Show or hide the panel of styles, lights and view"),
            Self::Statistics => ("Statistics", "Show how long a picture takes"),
            Self::DarkPanels => {
                ("Dark panels", "Make the panels dark or light; at first they are as the system wants")
            }
            Self::FullScreen => ("Full screen", "Fill the screen"),
            Self::Warnings => ("Warnings…", "List what could not be loaded or was repaired"),
            Self::ReloadShaders => {
                ("Reload shaders", "Read changed shaders again (HACHURE_SHADERS names their folder)")
            }
            Self::Help => ("Mouse and keys", "Show the list of mouse and key actions"),
        }
    }

    /// The heading under which it stands.
    pub fn group(self) -> CommandGroup {
        match self {
            Self::Open
            | Self::Add
            | Self::Reload
            | Self::Save
            | Self::SaveAs
            | Self::Screenshot
            | Self::TransparentScreenshot
            | Self::ScreenshotAs
            | Self::Quit => CommandGroup::File,
            Self::Undo
            | Self::Redo
            | Self::SelectAll
            | Self::SelectNone
            | Self::Hide
            | Self::Isolate
            | Self::ShowAll => CommandGroup::Edit,
            Self::AddBox | Self::AddArrow | Self::AddPath | Self::AddLabel | Self::Delete => {
                CommandGroup::Glyphs
            }
            Self::Home
            | Self::FrameAll
            | Self::FrameSelected
            | Self::Front
            | Self::Back
            | Self::Right
            | Self::Left
            | Self::Top
            | Self::Bottom
            | Self::Isometric
            | Self::FileCamera
            | Self::OrbitLeft
            | Self::OrbitRight
            | Self::OrbitUp
            | Self::OrbitDown
            | Self::Projection => CommandGroup::View,
            Self::Panels
            | Self::Outliner
            | Self::Inspector
            | Self::Statistics
            | Self::DarkPanels
            | Self::FullScreen => CommandGroup::Window,
            Self::Warnings | Self::ReloadShaders | Self::Help => CommandGroup::Help,
        }
    }

    /// Whether a line is drawn above it in a menu.
    pub fn starts_section(self) -> bool {
        matches!(
            self,
            Self::Save
                | Self::Screenshot
                | Self::Quit
                | Self::SelectAll
                | Self::Hide
                | Self::Delete
                | Self::Front
                | Self::FileCamera
                | Self::OrbitLeft
                | Self::Projection
                | Self::Statistics
                | Self::ReloadShaders
        )
    }

    /// The keys that call it; the first one stands in menus.
    pub fn shortcuts(self) -> &'static [KeyboardShortcut] {
        const fn key(logical_key: Key) -> KeyboardShortcut {
            KeyboardShortcut::new(Modifiers::NONE, logical_key)
        }
        const fn ctrl(logical_key: Key) -> KeyboardShortcut {
            KeyboardShortcut::new(CTRL, logical_key)
        }
        const fn ctrl_shift(logical_key: Key) -> KeyboardShortcut {
            KeyboardShortcut::new(CTRL_SHIFT, logical_key)
        }
        match self {
            Self::Open => const { &[ctrl(Key::O)] },
            Self::Add => const { &[ctrl_shift(Key::O)] },
            Self::Reload => const { &[key(Key::ArrowUp), key(Key::F5)] },
            Self::Save => const { &[ctrl(Key::S)] },
            Self::SaveAs => const { &[ctrl_shift(Key::S)] },
            Self::Screenshot => const { &[key(Key::F12)] },
            Self::TransparentScreenshot => const { &[ctrl(Key::F12)] },
            Self::ScreenshotAs => const { &[ctrl_shift(Key::F12)] },
            Self::Quit => const { &[ctrl(Key::Q)] },
            Self::Undo => const { &[ctrl(Key::Z)] },
            Self::Redo => const { &[ctrl_shift(Key::Z), ctrl(Key::Y)] },
            Self::SelectAll => const { &[ctrl(Key::A)] },
            Self::SelectNone => const { &[key(Key::Escape)] },
            Self::Hide => const { &[ctrl(Key::H)] },
            Self::Isolate => const { &[key(Key::Slash)] },
            Self::ShowAll => const { &[KeyboardShortcut::new(Modifiers::ALT, Key::H)] },
            Self::Delete => const { &[key(Key::Delete)] },
            Self::Home => const { &[key(Key::Home)] },
            Self::FrameAll => const { &[key(Key::Enter)] },
            Self::FrameSelected => const { &[key(Key::F), key(Key::Period)] },
            Self::Front => const { &[key(Key::Num1)] },
            Self::Back => const { &[ctrl(Key::Num1)] },
            Self::Right => const { &[key(Key::Num3)] },
            Self::Left => const { &[ctrl(Key::Num3)] },
            Self::Top => const { &[key(Key::Num7)] },
            Self::Bottom => const { &[ctrl(Key::Num7)] },
            Self::Isometric => const { &[key(Key::Num9)] },
            Self::FileCamera => const { &[key(Key::Num0)] },
            Self::OrbitLeft => const { &[key(Key::Num4)] },
            Self::OrbitRight => const { &[key(Key::Num6)] },
            Self::OrbitUp => const { &[key(Key::Num8)] },
            Self::OrbitDown => const { &[key(Key::Num2)] },
            Self::Projection => const { &[key(Key::Num5)] },
            Self::Panels => const { &[key(Key::Tab)] },
            Self::Statistics => const { &[key(Key::Z)] },
            Self::FullScreen => const { &[key(Key::F11)] },
            Self::ReloadShaders => const { &[ctrl(Key::R)] },
            Self::Help => const { &[key(Key::F1), key(Key::H)] },
            Self::AddBox
            | Self::AddArrow
            | Self::AddPath
            | Self::AddLabel
            | Self::Outliner
            | Self::Inspector
            | Self::DarkPanels
            | Self::Warnings => &[],
        }
    }

    /// All commands of a group, in the order of its menu.
    pub fn of(group: CommandGroup) -> impl Iterator<Item = Self> {
        Self::iter().filter(move |c| c.group() == group)
    }

    /// Takes the pressed shortcuts out of the input. Keys without a modifier are left to a widget that has the focus.
    pub fn take_pressed(context: &egui::Context) -> Vec<Self> {
        let has_focus = context.memory(|m| m.focused().is_some());
        // An open menu or list is closed by Esc and walked through by arrows.
        let has_focus = has_focus || egui::Popup::is_any_open(context);
        let is_typing = context.text_edit_focused();
        let mut pressed = Vec::new();
        context.input_mut(|input| {
            input.events.retain(|event| {
                let egui::Event::Key { key, pressed: true, modifiers, repeat, .. } = event else {
                    return true;
                };
                let Some(command) = Self::for_key(*key, *modifiers) else { return true };
                let is_bare = !modifiers.command && !modifiers.ctrl && !modifiers.alt;
                let is_function_key = matches!(key, Key::F1 | Key::F5 | Key::F11 | Key::F12);
                let belongs_to_widget = (is_bare && !is_function_key && has_focus)
                    || (is_typing && matches!(command, Self::Undo | Self::Redo | Self::SelectAll));
                if belongs_to_widget {
                    return true;
                }
                if !*repeat || command.repeats() {
                    pressed.push(command);
                }
                false
            });
        });
        // egui moves the focus on these keys before anybody sees them.
        if pressed.iter().any(|c| matches!(c, Self::Panels | Self::Reload)) {
            context.memory_mut(|m| m.move_focus(egui::FocusDirection::None));
        }
        pressed
    }

    fn for_key(key: Key, modifiers: Modifiers) -> Option<Self> {
        Self::iter().find(|c| {
            c.shortcuts().iter().any(|s| s.logical_key == key && modifiers.matches_exact(s.modifiers))
        })
    }

    fn repeats(self) -> bool {
        matches!(
            self,
            Self::Undo | Self::Redo | Self::OrbitLeft | Self::OrbitRight | Self::OrbitUp | Self::OrbitDown
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_commands_share_a_key_or_a_name() {
        let all: Vec<_> = Command::iter().collect();
        for (i, a) in all.iter().enumerate() {
            assert!(!a.text().is_empty() && !a.tooltip().is_empty());
            for b in &all[i + 1..] {
                assert_ne!(a.text(), b.text());
                for key in a.shortcuts() {
                    assert!(!b.shortcuts().contains(key), "{a:?} and {b:?} share {key:?}");
                }
            }
        }
    }

    #[test]
    fn extra_modifiers_call_nothing_else() {
        assert_eq!(Command::for_key(Key::Num1, Modifiers::NONE), Some(Command::Front));
        let ctrl = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };
        assert_eq!(Command::for_key(Key::Num1, ctrl), Some(Command::Back));
        assert_eq!(Command::for_key(Key::Num1, Modifiers::ALT), None);
        let ctrl_shift = Modifiers { shift: true, ..ctrl };
        assert_eq!(Command::for_key(Key::S, ctrl_shift), Some(Command::SaveAs));
    }
}
