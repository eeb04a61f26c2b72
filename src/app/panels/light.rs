//! The lights: a ball on which each light of the rig is a dot that can be dragged, and their parameters.

use eframe::egui;
use eframe::egui::{Align2, Color32, FontId, Pos2, Rect, Rgba, RichText, Sense, Stroke, Ui, Vec2, vec2};
use glam::{DMat3, DMat4, DVec2, DVec3, Vec3};

use super::Editing;
use super::params::params_ui;
use super::row::capitalized;
use crate::document::Lighting;
use crate::document::lighting::{Attached, Lamp, Source};
use crate::scene::Up;
use crate::style::param;

/// Radius of the ball.
const RADIUS: f32 = 48.0;
/// How far the ring around it reaches, in radii: there are the lights that shine from behind.
const RING: f32 = 0.5;
/// Radius of a dot.
const DOT: f32 = 8.0;

/// Where the eye is, and what is up.
#[derive(Clone, Copy)]
struct Eye {
    view_from_world: DMat4,
    up: Up,
}

impl Eye {
    /// From the space of a light's direction to view space.
    fn view_from_lamp(&self, attached: Attached) -> DMat3 {
        match attached {
            Attached::Camera => DMat3::IDENTITY,
            Attached::World => DMat3::from_mat4(self.view_from_world) * attached.axes(self.up),
        }
    }

    /// Towards the light, in view space.
    fn direction(&self, lamp: &Lamp) -> DVec3 {
        self.view_from_lamp(lamp.attached) * lamp.direction()
    }

    /// Turns a light to where it shines from this direction of view space.
    fn turn(&self, lamp: &mut Lamp, direction: DVec3) {
        lamp.turn_to(self.view_from_lamp(lamp.attached).transpose() * direction);
    }
}

/// The page.
pub fn light_ui(ui: &mut Ui, editing: &mut Editing<'_>) {
    let eye = Eye {
        view_from_world: editing.document.camera.unwrap_or_default().view_from_world(),
        up: editing.document.up(&editing.model.scene),
    };
    let lighting = &mut editing.document.lighting;
    let mut default = Lighting { source: lighting.source, ..Lighting::default() };
    let selected_id = ui.make_persistent_id("selected light");
    let mut selected = ui.data(|d| d.get_temp::<usize>(selected_id)).unwrap_or(0);
    if lighting.source == Source::Rig {
        ui.horizontal(|ui| {
            ball_ui(ui, lighting, &eye, &mut selected);
            ui.vertical(|ui| names_ui(ui, lighting, &mut selected));
        });
    }
    ui.data_mut(|d| d.insert_temp(selected_id, selected));

    let before = lighting.clone();
    let prefix = format!("light.{}.", Lighting::LAMPS.get(selected).unwrap_or(&""));
    let defaults = default.params();
    let mut params = lighting.params();
    param::retain_relevant(&mut params);
    let of_lamps = |key: &str| key.matches('.').count() > 1;
    let (mut lamps, mut shared): (Vec<_>, Vec<_>) = params.into_iter().partition(|p| of_lamps(&p.key));
    lamps.retain(|p| p.key.starts_with(&prefix));
    params_ui(ui, "light", &mut lamps, &defaults);
    ui.add_space(6.0);
    params_ui(ui, "light", &mut shared, &defaults);
    keep_directions(lighting, &before, &eye);
}

/// A light that is fixed to something else stays where it is.
fn keep_directions(lighting: &mut Lighting, before: &Lighting, eye: &Eye) {
    let mut before = before.clone();
    for (lamp, old) in lighting.lamps_mut().into_iter().zip(before.lamps_mut()) {
        if lamp.attached != old.attached {
            eye.turn(lamp, eye.direction(old));
        }
    }
}

/// A line for each light, which selects it.
fn names_ui(ui: &mut Ui, lighting: &mut Lighting, selected: &mut usize) {
    ui.add_space(20.0);
    for (i, (name, lamp)) in Lighting::LAMPS.into_iter().zip(lighting.lamps_mut()).enumerate() {
        let text = RichText::new(capitalized(name));
        let text = if lamp.show { text } else { text.weak() };
        let hint = if lamp.show { "Drag its dot on the ball" } else { "It is off" };
        ui.selectable_value(selected, i, text).on_hover_text(hint);
    }
    ui.add(egui::Label::new(RichText::new("Beyond the rim:\nfrom behind").weak().small()));
}

fn ball_ui(ui: &mut Ui, lighting: &mut Lighting, eye: &Eye, selected: &mut usize) {
    let side = 2.0 * (RADIUS * (1.0 + RING) + DOT);
    let (rect, ball) = ui.allocate_exact_size(Vec2::splat(side), Sense::click_and_drag());
    ball.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Light ball"));
    let center = rect.center();
    // Wherever the ball is touched, the selected light goes.
    if let (Some(at), Some(lamp)) = (ball.interact_pointer_pos(), lighting.lamps_mut().get_mut(*selected))
        && lamp.show
    {
        eye.turn(lamp, direction_at(at - center));
    }
    let mut dots = Vec::new();
    for (i, (name, lamp)) in Lighting::LAMPS.into_iter().zip(lighting.lamps_mut()).enumerate() {
        if !lamp.show {
            continue;
        }
        let at = center + place_of(eye.direction(lamp));
        let dot = ui.interact(
            Rect::from_center_size(at, Vec2::splat(2.5 * DOT)),
            ball.id.with(name),
            Sense::click_and_drag(),
        );
        dot.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Slider, true, format!("Direction of the {name} light"))
        });
        if let Some(at) = dot.interact_pointer_pos() {
            *selected = i;
            if dot.dragged() {
                eye.turn(lamp, direction_at(at - center));
            }
        }
        let hint = format!("{:.0}° to the right, {:.0}° up", lamp.azimuth, lamp.elevation);
        let hovered = dot.on_hover_text(hint).hovered();
        dots.push((i, name, center + place_of(eye.direction(lamp)), lamp.color.0, hovered));
    }
    if ui.is_rect_visible(rect) {
        paint_ball(ui, center, lighting, eye);
        for (i, name, at, color, hovered) in dots {
            paint_dot(ui, at, name, color, i == *selected, hovered);
        }
    }
}

/// Where a direction (view space, unit length) lies from the ball's middle.
fn place_of(direction: DVec3) -> Vec2 {
    let across = DVec2::new(direction.x, -direction.y);
    let sine = across.length().min(1.0);
    let share = if direction.z >= 0.0 { sine } else { 1.0 + f64::from(RING) * (1.0 - sine) };
    let place = across.normalize_or(DVec2::X) * share;
    RADIUS * vec2(place.x as f32, place.y as f32)
}

/// The inverse of [`place_of`]; beyond the ring, what is nearest to it.
fn direction_at(place: Vec2) -> DVec3 {
    let at = DVec2::new(f64::from(place.x), -f64::from(place.y)) / f64::from(RADIUS);
    let share = at.length();
    if share <= 1.0 {
        return at.extend((1.0 - share * share).sqrt());
    }
    let sine = (1.0 - (share - 1.0) / f64::from(RING)).clamp(0.0, 1.0);
    (at / share * sine).extend(-(1.0 - sine * sine).sqrt())
}

/// A gray ball in the light of the rig.
fn paint_ball(ui: &Ui, center: Pos2, lighting: &mut Lighting, eye: &Eye) {
    const RINGS: u32 = 12;
    const SEGMENTS: u32 = 48;
    let lights: Vec<(Vec3, Vec3)> = lighting
        .lamps_mut()
        .into_iter()
        .filter(|lamp| lamp.show)
        .map(|lamp| (eye.direction(lamp).as_vec3(), lamp.color.to_linear() * lamp.intensity))
        .collect();
    let color = |normal: Vec3| {
        let light: Vec3 = lights.iter().map(|(towards, color)| *color * normal.dot(*towards).max(0.0)).sum();
        let [r, g, b] = ((light + 0.12) * 0.75).min(Vec3::ONE).to_array();
        Color32::from(Rgba::from_rgb(r, g, b))
    };
    let mut mesh = egui::Mesh::default();
    mesh.colored_vertex(center, color(Vec3::Z));
    for ring in 1..=RINGS {
        // Denser towards the rim, where the ball turns away.
        let (sine, cosine) = (f32::from(ring as u16) / RINGS as f32 * std::f32::consts::FRAC_PI_2).sin_cos();
        for segment in 0..SEGMENTS {
            let (y, x) = (segment as f32 / SEGMENTS as f32 * std::f32::consts::TAU).sin_cos();
            mesh.colored_vertex(
                center + RADIUS * sine * vec2(x, y),
                color(Vec3::new(x * sine, -y * sine, cosine)),
            );
            let at = |ring: u32, segment: u32| match ring {
                0 => 0,
                _ => 1 + (ring - 1) * SEGMENTS + segment % SEGMENTS,
            };
            mesh.add_triangle(at(ring - 1, segment), at(ring, segment), at(ring, segment + 1));
            if ring > 1 {
                mesh.add_triangle(at(ring - 1, segment), at(ring, segment + 1), at(ring - 1, segment + 1));
            }
        }
    }
    let visuals = ui.visuals();
    let painter = ui.painter();
    painter.circle(
        center,
        RADIUS * (1.0 + RING),
        visuals.faint_bg_color,
        Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color),
    );
    painter.add(mesh);
    painter.circle_stroke(center, RADIUS, Stroke::new(1.2, Color32::from_gray(40)));
}

fn paint_dot(ui: &Ui, at: Pos2, name: &str, [r, g, b]: [u8; 3], is_selected: bool, is_hovered: bool) {
    let visuals = ui.visuals();
    let is_bright = u32::from(r) * 3 + u32::from(g) * 6 + u32::from(b) > 1200;
    let ink = if is_bright { Color32::from_gray(30) } else { Color32::WHITE };
    let painter = ui.painter();
    if is_selected || is_hovered {
        let ring = if is_selected { visuals.hyperlink_color } else { visuals.weak_text_color() };
        painter.circle_stroke(at, DOT + 2.0, Stroke::new(2.0, ring));
    }
    painter.circle(at, DOT, Color32::from_rgb(r, g, b), Stroke::new(1.0, Color32::from_gray(40)));
    let letter: String = name.chars().take(1).flat_map(char::to_uppercase).collect();
    painter.text(at, Align2::CENTER_CENTER, letter, FontId::proportional(10.0), ink);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_on_the_ball_is_a_direction_and_back() {
        for direction in [
            DVec3::new(0.3, -0.5, 0.4),
            DVec3::new(-0.9, 0.1, 0.01),
            DVec3::new(0.6, 0.7, -0.2),
            DVec3::new(0.1, -0.1, -0.9),
        ] {
            let direction = direction.normalize();
            let back = direction_at(place_of(direction));
            assert!((back - direction).length() < 1e-5, "{direction} {back}");
        }
        assert!(direction_at(vec2(900.0, 0.0)).z < -0.999);
    }
}
