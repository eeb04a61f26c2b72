//! Pictures of a document, without a window.

pub mod image;
pub mod session;

pub use image::{ExportError, save_png};
pub use session::Session;
