//! What a file becomes: nodes, materials, cameras, lights. Plain data in the file's own coordinates.

pub mod additions;
pub mod camera;
pub mod extent;
pub mod graph;
pub mod light;
pub mod material;
pub mod mip_chain;
pub mod standard;
pub mod texture;
pub mod unit;

pub use additions::Addition;
pub use camera::{Camera, Projection};
pub use extent::{Extent, Framed, MeasuredMesh};
pub use graph::{Node, NodeId, Scene, Up, Warning};
pub use light::{Light, LightKind};
pub use material::{AlphaMode, Material, TextureRef, UvTransform, Wrap};
pub use standard::Standard;
pub use texture::{Images, Texture};
pub use unit::Unit;
