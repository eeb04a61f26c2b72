//! One frame of one scene. Knows no window, no egui and no file. Its floors, from top to bottom: the renderer, the frame, debug
//! views, drawings, effects, passes, and what all of them share.

pub mod base;
pub mod drawing;
pub mod effects;
pub mod frame;
pub mod passes;
mod renderer;
pub mod views;

pub use base::error::RenderError;
pub use base::gpu_scene::{GpuScene, Origin, UploadedTopology, Uploader};
pub use base::intersections::{ExaminedMesh, Intersections};
pub use base::sample::{MAX_SAMPLES, Sample};
pub use base::stripes::{GpuStripes, SolvedStripes, StripeRequest};
pub use base::stroke_maps::StrokeMap;
pub use base::style_images::StyleImages;
pub use base::view::View;
pub use effects::blueprint::LAYERS;
pub use effects::{image_faults, prepare_images};
pub use frame::Picture;
pub use passes::count::MAX_LAYERS;
pub use passes::layer_report::{LayerReport, LayersEnd};
pub use passes::layers::{LayerMethod, Reason, Reported};
pub use renderer::{Pick, Renderer, Request};
