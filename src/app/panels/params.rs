//! The declared parameters in foldable sections.

use eframe::egui;
use eframe::egui::collapsing_header::CollapsingState;
use eframe::egui::{RichText, Ui};

use super::icons;
use super::row::{Change, RESET_WIDTH, Row, capitalized, spaced};
use super::span::span_ui;
use crate::style::param::Param;

/// How far a section within a section is moved to the right.
const INDENT: i8 = 12;

/// The part of a key before its last dot.
pub fn section_of(key: &str) -> &str {
    key.rsplit_once('.').map_or("", |(section, _)| section)
}

/// A section's heading: `edges.profile` → `Edges · profile`, `sketch.pass1` → `Sketch · pass 1`.
pub fn heading(section: &str) -> String {
    let mut words = section.split('.').map(numbered);
    let first = words.next().map(|w| capitalized(&w)).unwrap_or_default();
    std::iter::once(first).chain(words).collect::<Vec<_>>().join(" · ")
}

/// `pass1` → `pass 1`, `face_normals` → `face normals`.
fn numbered(name: &str) -> String {
    let word = name.trim_end_matches(|c: char| c.is_ascii_digit());
    match name.strip_prefix(word) {
        Some(number) if !word.is_empty() && !number.is_empty() => format!("{} {number}", spaced(word)),
        _ => spaced(name),
    }
}

/// Rows for all of `params` in sections that can be folded; what a section with a switch has below it lies in it, and a
/// section that inherits from another one of its own kind in that.
/// `defaults` is the same list with the values that a reset brings back. Returns the keys that changed, with their
/// new values.
pub fn params_ui(ui: &mut Ui, salt: &str, params: &mut [Param<'_>], defaults: &[Param<'_>]) -> Vec<Change> {
    let mut sections: Vec<ParamSection<'_, '_>> = Vec::new();
    for param in params {
        let default = defaults.iter().find(|d| d.key == param.key).map_or_else(|| param.own(), Param::own);
        let key = section_of(&param.key).to_owned();
        let row = Row { param, default };
        match sections.last_mut().filter(|s| s.key == key) {
            Some(section) => section.rows.push(row),
            None => sections.push(ParamSection { key, rows: vec![row] }),
        }
    }

    let mut changes = Vec::new();
    let mut rest = sections.as_mut_slice();
    while let Some((section, others)) = rest.split_first_mut() {
        let is_inner = |s: &&ParamSection<'_, '_>| s.is_within(section);
        let is_plain = section.key.is_empty() || section.key == salt;
        let inner_count = if is_plain { 0 } else { others.iter().take_while(is_inner).count() };
        let (inner, others) = others.split_at_mut(inner_count);
        rest = others;
        if is_plain {
            section.rows_ui(ui, &mut changes);
        } else {
            section.ui(ui, salt, None, inner, &mut changes);
        }
    }
    changes
}

/// The parameters of one effect, group or class.
struct ParamSection<'p, 'a> {
    key: String,
    rows: Vec<Row<'p, 'a>>,
}

impl ParamSection<'_, '_> {
    /// Whether it lies in another one.
    fn is_within(&self, other: &ParamSection<'_, '_>) -> bool {
        let inherits = || self.rows.iter().find_map(|row| row.param.slot.inherits()).map(section_of);
        match self.key.strip_prefix(other.key.as_str()) {
            Some(rest) if rest.starts_with('.') => other.rows.iter().any(|row| row.param.head),
            _ => inherits().is_some_and(|source| source == other.key),
        }
    }

    /// `outer`: the key of the section in which it lies.
    fn ui(
        &mut self,
        ui: &mut Ui,
        salt: &str,
        outer: Option<&str>,
        inner: &mut [Self],
        changes: &mut Vec<Change>,
    ) {
        let id = ui.make_persistent_id((salt, &self.key));
        let open = !self.rows.iter().any(|row| row.param.detail);
        let state = CollapsingState::load_with_default_open(ui.ctx(), id, open);
        ui.add_space(if outer.is_some() { 0.0 } else { 4.0 });
        let mut clicked = false;
        let mut header = state.show_header(ui, |ui| clicked = self.heading_ui(ui, outer, changes));
        if clicked {
            header.toggle();
        }
        header.body_unindented(|ui| {
            self.rows_ui(ui, changes);
            egui::Frame::new().inner_margin(egui::Margin { left: INDENT, ..egui::Margin::ZERO }).show(
                ui,
                |ui| {
                    for section in inner {
                        section.ui(ui, salt, Some(&self.key), &mut [], changes);
                    }
                },
            );
        });
    }

    /// The switch of the section, if it has one, its name, and a button that resets all of it. Returns whether the
    /// name was clicked.
    fn heading_ui(&mut self, ui: &mut Ui, outer: Option<&str>, changes: &mut Vec<Change>) -> bool {
        // What it lies in need not be said again.
        let own = outer.and_then(|outer| self.key.strip_prefix(outer)).map(|own| own.trim_start_matches('.'));
        let mut title = heading(own.unwrap_or(&self.key));
        let head = self.rows.iter_mut().find(|row| row.param.head);
        if let Some(head) = &head {
            title = head.param.label.to_owned();
        }
        let button = egui::Button::new(RichText::new(&title).strong()).frame(false);
        let response = match head {
            Some(head) => {
                changes.extend(head.head_ui(ui));
                let response = ui.add(button).on_hover_text(head.help());
                response.context_menu(|ui| changes.extend(head.menu_ui(ui)));
                response
            }
            None => ui.add(button),
        };
        if self.rows.iter().any(Row::differs) {
            let (rect, _) =
                ui.allocate_exact_size(egui::vec2(RESET_WIDTH, response.rect.height()), egui::Sense::hover());
            let name = format!("Reset {title}");
            if icons::reset(ui, rect, response.id.with("reset"), &name).on_hover_text(&name).clicked() {
                changes.extend(self.rows.iter_mut().filter(|row| row.differs()).filter_map(Row::reset));
            }
        }
        response.clicked()
    }

    fn rows_ui(&mut self, ui: &mut Ui, changes: &mut Vec<Change>) {
        let mut next = 0;
        while let Some(rows) = self.rows.get_mut(next..) {
            next += match rows {
                [] => break,
                [row, ..] if row.param.head => 1,
                [row, end, ..] if row.param.span.is_some() => {
                    changes.extend(span_ui(ui, [row, end]));
                    2
                }
                [row, ..] => {
                    changes.extend(row.ui(ui));
                    1
                }
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_become_headings() {
        assert_eq!(section_of("edges.profile.gain"), "edges.profile");
        assert_eq!(section_of("technique"), "");
        assert_eq!(heading("edges.dash"), "Edges · dash");
        assert_eq!(heading("sketch.pass1"), "Sketch · pass 1");
        assert_eq!((heading("pass12"), heading("12")), ("Pass 12".to_owned(), "12".to_owned()));
    }
}
