//! How the panels look: quiet grays, so that the paper is the brightest thing in the window.

use eframe::egui;
use eframe::egui::{Color32, CornerRadius, FontFamily, FontId, Stroke, TextStyle, Theme, Visuals};

/// Follows the system's light or dark theme.
pub(super) fn apply(context: &egui::Context) {
    context.options_mut(|o| {
        o.fallback_theme = Theme::Light;
    });
    context.set_visuals_of(Theme::Light, light());
    context.set_visuals_of(Theme::Dark, dark());
    context.all_styles_mut(|style| {
        style.text_styles = [
            (TextStyle::Small, FontId::new(11.0, FontFamily::Proportional)),
            (TextStyle::Body, FontId::new(13.0, FontFamily::Proportional)),
            (TextStyle::Button, FontId::new(13.0, FontFamily::Proportional)),
            (TextStyle::Heading, FontId::new(17.0, FontFamily::Proportional)),
            (TextStyle::Monospace, FontId::new(12.5, FontFamily::Monospace)),
        ]
        .into();
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        // No menu is cut off before the window ends.
        style.spacing.default_area_size.y = 800.0;
        style.spacing.button_padding = egui::vec2(7.0, 2.0);
        style.spacing.interact_size.y = 20.0;
        style.spacing.tooltip_width = 320.0;
        // A panel that slides would have the picture drawn at every width on its way.
        style.animation_time = 0.0;
        style.interaction.selectable_labels = false;
    });
}

/// Dark or light by choice, or as the system wants.
pub(super) fn choose(context: &egui::Context, dark: Option<bool>) {
    context.set_theme(match dark {
        None => egui::ThemePreference::System,
        Some(true) => egui::ThemePreference::Dark,
        Some(false) => egui::ThemePreference::Light,
    });
}

fn light() -> Visuals {
    let mut v = Visuals::light();
    v.panel_fill = Color32::from_rgb(232, 231, 228);
    v.window_fill = Color32::from_rgb(242, 241, 238);
    v.extreme_bg_color = Color32::from_rgb(250, 249, 247);
    v.faint_bg_color = Color32::from_rgb(224, 223, 219);
    let accent = Color32::from_rgb(38, 84, 124);
    v.selection.bg_fill = Color32::from_rgb(196, 213, 228);
    v.selection.stroke = Stroke::new(1.0, Color32::from_rgb(18, 48, 76));
    v.hyperlink_color = accent;
    v.widgets.noninteractive.bg_stroke = Stroke::new(1.0, Color32::from_rgb(208, 206, 202));
    v.widgets.noninteractive.fg_stroke.color = Color32::from_rgb(52, 51, 48);
    v.widgets.inactive.weak_bg_fill = Color32::from_rgb(219, 217, 213);
    v.widgets.inactive.bg_fill = Color32::from_rgb(206, 204, 199);
    v.widgets.inactive.fg_stroke.color = Color32::from_rgb(44, 43, 40);
    v.widgets.hovered.weak_bg_fill = Color32::from_rgb(210, 208, 203);
    rounded(v)
}

fn dark() -> Visuals {
    let mut v = Visuals::dark();
    v.panel_fill = Color32::from_rgb(38, 38, 40);
    v.window_fill = Color32::from_rgb(46, 46, 48);
    v.extreme_bg_color = Color32::from_rgb(26, 26, 28);
    v.selection.bg_fill = Color32::from_rgb(52, 84, 112);
    v.selection.stroke = Stroke::new(1.0, Color32::from_rgb(220, 234, 246));
    v.hyperlink_color = Color32::from_rgb(130, 180, 220);
    v.widgets.noninteractive.fg_stroke.color = Color32::from_rgb(200, 200, 198);
    v.widgets.inactive.fg_stroke.color = Color32::from_rgb(208, 208, 206);
    rounded(v)
}

fn rounded(mut v: Visuals) -> Visuals {
    let widgets = &mut v.widgets;
    for w in [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ] {
        w.corner_radius = CornerRadius::same(3);
        w.expansion = 0.0;
    }
    v.window_corner_radius = CornerRadius::same(6);
    v.menu_corner_radius = CornerRadius::same(5);
    v
}
