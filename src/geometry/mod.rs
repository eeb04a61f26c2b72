//! Triangle meshes and what can be computed from them. Plain data: no file, no GPU.

pub mod bounds;
pub mod mesh;

pub use bounds::Bounds;
pub use mesh::{Mesh, MeshPart};
