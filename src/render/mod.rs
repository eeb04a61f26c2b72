//! One frame of one scene. Knows no window, no egui and no file.

pub mod drawing;
pub mod effects;
pub mod frame;
pub mod frame_uniform;
pub mod gpu_scene;
pub mod groups;
pub mod layers;
pub mod light_view;
pub mod lights;
mod one_layer;
pub mod passes;
mod renderer;
pub mod sample;
pub mod scale_bar;
pub mod section;
mod segments;
pub mod shadows;
pub mod stage;
mod style_images;

pub use frame::Picture;
pub use gpu_scene::{GpuScene, Origin, UploadedTopology, Uploader};
pub use layers::{LayersBy, Reason, Reported};
pub use renderer::{Pick, RenderError, Renderer, Request};
pub use sample::Sample;
pub use style_images::StyleImages;
