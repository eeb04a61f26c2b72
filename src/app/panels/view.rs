//! How the picture is shown: axis, unit, projection, paper, smoothness, section plane.

use eframe::egui;
use eframe::egui::Ui;

use super::Editing;
use super::params::params_ui;
use super::row::named_row;
use super::section::section_ui;
use crate::app::navigation::with_view_angle;
use crate::app::state::{Samples, SamplesSetting};
use crate::document::{Document, ViewSettings};
use crate::scene::unit::UNITS;
use crate::scene::{Camera, Projection, Scene, Unit, Up};
use crate::style::param;

/// Samples per pixel to choose from.
const SAMPLES: [u32; 4] = [1, 16, 64, 256];

/// The page. Returns whether the axis changed, so that the model is to be seen upright again.
pub fn view_ui(ui: &mut Ui, editing: &mut Editing<'_>, samples: &mut Samples) -> bool {
    let scene = &editing.model.scene;
    let document = &mut *editing.document;
    let before = document.up(scene);

    up_ui(ui, document, scene);
    unit_ui(ui, document, scene);
    let unit = document.meters_per_unit(scene).and_then(Unit::of);
    if let Some(camera) = &mut document.camera {
        projection_ui(ui, camera, unit);
    }

    ui.add_space(4.0);
    let mut default = ViewSettings::default();
    let paper = document.style.paper.color;
    let defaults = default.params(paper);
    let mut params = document.view.params(paper);
    param::retain_relevant(&mut params);
    params_ui(ui, "view", &mut params, &defaults);
    samples_ui(ui, samples);
    let is_turned = document.up(scene) != before;
    section_ui(ui, editing);
    is_turned
}

fn up_ui(ui: &mut Ui, document: &mut Document, scene: &Scene) {
    named_row(ui, "Up axis", "The axis of the file that points up", |ui, label| {
        let as_file = format!("As in the file ({})", scene.up.name());
        let text = document.up.map_or_else(|| as_file.clone(), |up| up.name().to_owned());
        let combo = egui::ComboBox::from_id_salt("up")
            .width(ui.available_width())
            .selected_text(text)
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut document.up, None, as_file);
                for up in Up::ALL {
                    ui.selectable_value(&mut document.up, Some(up), up.name());
                }
            });
        combo.response.labelled_by(label);
    });
}

fn unit_ui(ui: &mut Ui, document: &mut Document, scene: &Scene) {
    named_row(ui, "Unit", "What one unit of the file's coordinates stands for", |ui, label| {
        let as_file = match scene.meters_per_unit {
            Some(meters) => format!("As in the file ({})", unit_name(meters).to_lowercase()),
            None => "Unknown".to_owned(),
        };
        let text = document.meters_per_unit.map_or_else(|| as_file.clone(), unit_name);
        let combo = egui::ComboBox::from_id_salt("unit")
            .width(ui.available_width())
            .selected_text(text)
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut document.meters_per_unit, None, as_file);
                for unit in UNITS {
                    ui.selectable_value(&mut document.meters_per_unit, Some(unit.meters), unit.name);
                }
            });
        combo.response.labelled_by(label);
    });
}

fn projection_ui(ui: &mut Ui, camera: &mut Camera, unit: Option<Unit>) {
    named_row(ui, "Projection", "Perspective, or parallel as in technical drawings", |ui, label| {
        let mut parallel = matches!(camera.projection, Projection::Orthographic { .. });
        let was = parallel;
        let text = if parallel { "Parallel" } else { "Perspective" };
        let combo = egui::ComboBox::from_id_salt("projection")
            .width(ui.available_width())
            .selected_text(text)
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut parallel, false, "Perspective");
                ui.selectable_value(&mut parallel, true, "Parallel");
            });
        combo.response.labelled_by(label);
        if parallel != was {
            *camera = camera.with_orthographic(parallel);
        }
    });
    if let Projection::Orthographic { view_height } = &mut camera.projection {
        named_row(ui, "Height", "Height of the picture in units of the model", |ui, label| {
            let speed = *view_height * 0.005;
            let number = egui::DragValue::new(view_height)
                .range(f64::MIN_POSITIVE..=f64::MAX)
                .speed(speed)
                .max_decimals(6)
                .suffix(unit.map_or_else(String::new, |unit| format!(" {}", unit.symbol)));
            let width = ui.available_width();
            ui.add_sized([width, ui.spacing().interact_size.y], number).labelled_by(label);
        });
    }
    if let Projection::Perspective { view_angle } = camera.projection {
        named_row(ui, "View angle", "Vertical angle of the view; a small one flattens", |ui, label| {
            let mut angle = view_angle;
            ui.spacing_mut().slider_width = (ui.available_width() - 66.0).max(40.0);
            let slider = egui::Slider::new(&mut angle, 5.0..=100.0).show_value(false).trailing_fill(true);
            ui.add(slider).labelled_by(label);
            let number =
                egui::DragValue::new(&mut angle).range(1.0..=170.0).speed(0.25).max_decimals(1).suffix(" °");
            ui.add_sized([58.0, ui.spacing().interact_size.y], number).labelled_by(label);
            if angle != view_angle {
                *camera = with_view_angle(camera, angle);
            }
        });
    }
}

fn samples_ui(ui: &mut Ui, samples: &mut Samples) {
    for SamplesSetting { label, help, value } in samples.settings() {
        named_row(ui, label, help, |ui, name| {
            let combo = egui::ComboBox::from_id_salt(label)
                .width(ui.available_width())
                .selected_text(samples_name(*value))
                .show_ui(ui, |ui| {
                    for choice in SAMPLES {
                        ui.selectable_value(value, choice, samples_name(choice));
                    }
                });
            combo.response.labelled_by(name);
        });
    }
}

fn samples_name(samples: u32) -> String {
    if samples > 1 { format!("{samples} samples") } else { "Off".to_owned() }
}

fn unit_name(meters: f64) -> String {
    Unit::of(meters).map_or_else(|| format!("{meters} m"), |unit| unit.name.to_owned())
}
