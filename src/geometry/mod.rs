//! Triangle meshes and what can be computed from them. Plain data: no file, no GPU.

pub mod angle;
pub mod bounds;
pub mod clean;
pub mod mesh;
pub mod normals;
pub mod primitives;
pub mod rig;
pub mod solid;
pub mod stitch;
pub mod surfaces;
pub mod topology;
pub mod triangulate;
pub mod weld;

pub use bounds::Bounds;
pub use clean::{Report, clean};
pub use mesh::{Mesh, MeshPart};
pub use rig::Rig;
pub use solid::Topology;
pub use stitch::Seam;
pub use surfaces::{Provoking, Surfaces, provoking};
pub use topology::{Adjacency, Edge, EdgeKind};
pub use triangulate::Triangulator;
pub use weld::Weld;
