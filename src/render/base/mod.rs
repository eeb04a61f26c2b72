//! What all floors above share: the scene on the device, groups of its objects, what is drawn of them, and how a camera sees it.

pub mod edge_style;
pub mod edge_styles;
pub mod error;
pub mod feature_lines;
pub mod frame_uniform;
pub mod gpu_scene;
pub mod group;
pub mod ids;
pub mod instances;
pub mod intersections;
pub mod light_view;
pub mod lights;
pub mod noise;
pub mod object_axes;
pub mod sample;
pub mod scale_bar;
pub mod scene_view;
pub mod section;
pub mod stage;
pub mod stripes;
pub mod stroke_maps;
pub mod stroke_style;
pub mod style_images;
pub mod view;
