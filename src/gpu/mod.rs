//! The device and what every pass needs from it: shaders, pipelines, textures from a pool, uploads, read-back, timers.
//! Knows no style.

pub mod bindings;
pub mod buffer;
mod clears;
pub mod depth_rules;
pub mod device;
mod faults;
pub mod geometry;
mod image_array;
pub mod inputs;
pub mod integer_textures;
pub mod material;
pub mod parted_counter;
pub mod pipelines;
mod placeholders;
pub mod pool;
pub mod predicate;
pub mod readback;
mod record_list;
mod record_texture;
pub mod recorder;
pub mod reports;
pub mod shader;
mod specialize;
pub mod timer;
pub mod uniform_arrays;

pub use buffer::{ArrayBuffer, DynamicBuffer, RecordBuffer, UniformBuffer};
pub use depth_rules::{DepthRule, STENCIL};
pub use device::{Gpu, GpuError};
pub use geometry::GeometryBuffers;
pub use image_array::ImageArray;
pub use inputs::{Inputs, inputs};
pub use integer_textures::IntegerTextures;
pub use material::MaterialBindings;
pub use pipelines::{Pipelines, Program};
pub use pool::{Target, TargetPool, drawn_as};
pub use predicate::Predicate;
pub use record_list::RecordList;
pub use record_texture::{RecordTexture, frame_records};
pub use recorder::Recorder;
pub use reports::Reports;
pub use shader::{ShaderError, Shaders};
pub use timer::Timers;
