//! The window.
//!
//! [`run`] opens it. [`viewer`] holds everything and runs a frame: keys and finished work first, then the panels and
//! the picture, then what they asked for. Panels change the document in place; everything else is a
//! [`command::Command`], carried out in `viewer/execute.rs`. Slow work is a [`jobs::Job`], answered in `viewer/background.rs`.
//! A picture that rests gets smoother ([`refining`]); then an idle window draws nothing.

pub mod command;
pub mod dialogs;
pub mod gesture;
mod images;
pub mod jobs;
pub mod loading;
pub mod navigation;
pub mod notices;
pub mod panels;
pub mod placing;
pub mod refining;
pub mod screenshot;
pub mod selection;
pub mod state;
mod theme;
mod unsaved;
pub mod viewer;
pub mod viewport;

use eframe::egui;
use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui_wgpu;

use crate::gpu::GpuError;
use crate::gpu::device::{device_descriptor, instance_descriptor};
use crate::style::Style;

pub use viewer::{Launch, Viewer};

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// There is nothing to draw with.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The window came without the kind of device that is needed.
    #[error("the window has no graphics device; this is a mistake of the program, please report it")]
    NoDevice,
    /// There is no screen.
    #[error(
        "no display: neither WAYLAND_DISPLAY nor DISPLAY is set. `hachure render` draws without a window"
    )]
    NoDisplay,
    /// The system gave no window.
    #[error("cannot open a window ({0}); on a machine without a screen, use `hachure render`")]
    Window(String),
}

/// Opens the window with these models or documents and stays until it is closed. `style` is the look of everything
/// that has none of its own.
///
/// # Errors
/// [`AppError`], with what to install when there is no graphics driver.
pub fn run(files: Vec<PathBuf>, style: Option<Style>) -> Result<(), AppError> {
    if cfg!(target_os = "linux") && ["WAYLAND_DISPLAY", "DISPLAY"].iter().all(is_unset) {
        return Err(AppError::NoDisplay);
    }
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Hachure")
            .with_app_id("hachure")
            .with_inner_size([1280.0, 820.0])
            .with_min_inner_size([480.0, 320.0])
            .with_drag_and_drop(true),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: egui_wgpu::WgpuConfiguration { wgpu_setup: wgpu_setup(), ..Default::default() },
        ..Default::default()
    };
    let launch = Launch { files, style, ..Launch::default() };
    eframe::run_native("hachure", options, Box::new(|creation| Ok(Box::new(Viewer::new(creation, launch)?))))
        .map_err(as_app_error)
}

fn is_unset(variable: &&str) -> bool {
    std::env::var_os(variable).is_none_or(|value| value.is_empty())
}

fn as_app_error(error: eframe::Error) -> AppError {
    match error {
        eframe::Error::Wgpu(error) => GpuError::NoAdapter { reason: error.to_string() }.into(),
        eframe::Error::AppCreation(error) => match error.downcast::<AppError>() {
            Ok(error) => *error,
            Err(error) => AppError::Window(error.to_string()),
        },
        other => AppError::Window(other.to_string()),
    }
}

/// How the window gets its device: the same way as pictures without a window.
pub fn wgpu_setup() -> egui_wgpu::WgpuSetup {
    let mut setup = egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor = instance_descriptor();
    setup.device_descriptor = Arc::new(device_descriptor);
    setup.into()
}
