//! Short messages in a corner of the window: what was saved where, what went wrong.

use eframe::egui;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use eframe::egui::{Align2, Color32, RichText};

/// How serious a message is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Severity {
    /// Something was done.
    Done,
    /// Something is worth knowing.
    Warning,
    /// Something failed; stays until it is closed.
    Error,
}

/// One message.
#[derive(Debug, Clone)]
pub struct Notice {
    /// How serious it is.
    pub level: Severity,
    /// The message.
    pub text: String,
    /// A file whose folder can be opened.
    pub file: Option<PathBuf>,
    until: Option<Instant>,
}

/// The messages that are shown.
#[derive(Debug, Default)]
pub struct Notices {
    list: Vec<Notice>,
}

/// More than this would cover the picture.
const MAX_SHOWN: usize = 5;

impl Notices {
    /// Something was done; disappears by itself.
    pub fn done(&mut self, text: impl Into<String>) {
        self.add(Severity::Done, text.into(), None);
    }

    /// A file was written.
    pub fn saved(&mut self, path: PathBuf) {
        self.add(Severity::Done, format!("Saved {}", path.display()), Some(path));
    }

    /// Something is worth knowing; disappears by itself.
    pub fn warning(&mut self, text: impl Into<String>) {
        self.add(Severity::Warning, text.into(), None);
    }

    /// Something failed; stays until it is closed.
    pub fn error(&mut self, text: impl Into<String>) {
        let text = text.into();
        log::error!("{text}");
        self.add(Severity::Error, text, None);
    }

    /// The messages that are shown, the newest last.
    pub fn list(&self) -> &[Notice] {
        &self.list
    }

    fn add(&mut self, level: Severity, text: String, file: Option<PathBuf>) {
        let seconds = match level {
            Severity::Done => Some(6),
            Severity::Warning => Some(12),
            Severity::Error => None,
        };
        self.list.retain(|n| n.text != text);
        self.list.push(Notice {
            level,
            text,
            file,
            until: seconds.map(|s| Instant::now() + Duration::from_secs(s)),
        });
        let too_many = self.list.len().saturating_sub(MAX_SHOWN);
        self.list.drain(..too_many);
    }

    /// Shows them in the lower right corner of `area`.
    pub fn show(&mut self, context: &egui::Context, area: egui::Rect) {
        let now = Instant::now();
        self.list.retain(|n| n.until.is_none_or(|until| until > now));
        if let Some(next) = self.list.iter().filter_map(|n| n.until).min() {
            context.request_repaint_after(next.saturating_duration_since(now) + Duration::from_millis(10));
        }
        if self.list.is_empty() {
            return;
        }
        let mut closed = None;
        egui::Area::new(egui::Id::unique("notices"))
            .order(egui::Order::Foreground)
            .pivot(Align2::RIGHT_BOTTOM)
            .fixed_pos(area.right_bottom() - egui::vec2(12.0, 12.0))
            .show(context, |ui| {
                for (i, notice) in self.list.iter().enumerate() {
                    if notice_ui(ui, notice, area.width()) {
                        closed = Some(i);
                    }
                }
            });
        if let Some(closed) = closed {
            self.list.remove(closed);
        }
    }
}

/// Returns whether it was closed.
fn notice_ui(ui: &mut egui::Ui, notice: &Notice, available: f32) -> bool {
    let accent = match notice.level {
        Severity::Done => Color32::from_rgb(70, 140, 90),
        Severity::Warning => Color32::from_rgb(200, 140, 30),
        Severity::Error => Color32::from_rgb(200, 60, 50),
    };
    let mut closed = false;
    let frame =
        egui::Frame::popup(ui.style()).inner_margin(egui::Margin { left: 14, right: 8, top: 8, bottom: 8 });
    let shown = frame.show(ui, |ui| {
        ui.horizontal_top(|ui| {
            let width = (available - 80.0).clamp(120.0, 330.0);
            ui.vertical(|ui| {
                ui.set_width(width);
                ui.add(egui::Label::new(&notice.text).wrap());
                if let Some(folder) = notice.file.as_ref().and_then(|f| f.parent())
                    && ui.link("Open folder").clicked()
                {
                    ui.ctx().open_url(egui::OpenUrl::new_tab(format!("file://{}", folder.display())));
                }
            });
            let close = ui.add(egui::Button::new(RichText::new("×")).frame(false));
            closed = close.on_hover_text("Close").clicked();
        });
    });
    let rect = shown.response.rect;
    let bar = egui::Rect::from_min_size(rect.min, egui::vec2(4.0, rect.height()));
    ui.painter().rect_filled(bar, egui::CornerRadius { nw: 4, sw: 4, ne: 0, se: 0 }, accent);
    ui.add_space(2.0);
    closed
}
