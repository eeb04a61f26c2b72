//! Triangle meshes and what can be computed from them. Plain data: no file, no GPU.

pub mod angle;
pub mod bounds;
pub mod bvh;
pub mod clean;
pub mod edge_class;
pub mod feature_edges;
mod line_chains;
pub mod line_score;
pub mod line_segments;
pub mod mesh;
pub mod normals;
pub mod primitives;
pub mod projector;
pub mod rig;
pub mod solid;
pub mod stitch;
pub mod surfaces;
pub mod topology;
pub mod triangulate;
pub mod visible_edges;
pub mod weld;

pub use bounds::Bounds;
pub use bvh::Bvh;
pub use clean::{Report, clean};
pub use edge_class::{ClassSet, EdgeClass};
pub use feature_edges::FeatureEdges;
pub use line_segments::{LineSegment, line_segments};
pub use mesh::{Mesh, MeshPart};
pub use projector::{Lens, Projector};
pub use rig::Rig;
pub use solid::Topology;
pub use stitch::Seam;
pub use surfaces::{Provoking, Surfaces, provoking};
pub use topology::{Adjacency, Edge, EdgeKind};
pub use triangulate::Triangulator;
pub use weld::Weld;
