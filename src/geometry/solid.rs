//! What drawing needs to know of a mesh's topology.

use std::sync::Arc;

use super::{Adjacency, CreaseRule, FeatureEdges, Mesh, Provoking, Weld, provoking};

/// The findings of topology about one mesh, in the form that drawing needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Topology {
    /// Surface ids at the first vertex of each triangle.
    pub provoking: Provoking,
    /// Whether the mesh encloses a volume and all its triangles face outwards: then nobody outside ever sees a back
    /// face.
    pub is_solid: bool,
    /// The edges, to be classified for every camera.
    pub edges: Arc<FeatureEdges>,
    /// Which vertices are one point.
    pub weld: Arc<Weld>,
}

impl Topology {
    /// Examines a mesh; creases, which `rule` tells from the other edges with a dihedral angle above `crease_angle`
    /// (radians), separate surfaces. Takes about 0.1 s per million triangles.
    ///
    /// # Panics
    /// When an index is out of range.
    pub fn new(mesh: &Mesh, crease_angle: f32, rule: CreaseRule) -> Self {
        let adjacency = Adjacency::new(mesh).with_rule(rule);
        let surfaces = adjacency.surfaces(crease_angle);
        Self {
            is_solid: is_solid(mesh, &adjacency),
            provoking: provoking(mesh, &surfaces),
            edges: Arc::new(FeatureEdges::new(mesh, &adjacency, surfaces)),
            weld: Arc::new(adjacency.weld),
        }
    }
}

/// Closed, of one mind about inside and outside, and not inside out.
fn is_solid(mesh: &Mesh, adjacency: &Adjacency) -> bool {
    adjacency.is_closed()
        && adjacency.flipped_count == 0
        && adjacency.collapsed.is_empty()
        && adjacency.seams.is_empty()
        && six_volumes(mesh) > 0.0
}

/// Six times the signed volume, about a corner of the mesh so that digits are not lost far from the origin.
fn six_volumes(mesh: &Mesh) -> f64 {
    let Some(origin) = mesh.positions.first().map(|p| p.as_dvec3()) else { return 0.0 };
    mesh.triangles()
        .iter()
        .map(|t| t.map(|v| mesh.positions[v as usize].as_dvec3() - origin))
        .map(|[a, b, c]| a.dot(b.cross(c)))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::super::primitives;
    use super::*;

    #[test]
    fn closed_meshes_that_face_outwards_are_solid() {
        let is_solid = |mesh: &Mesh| Topology::new(mesh, 0.5, CreaseRule::Normals).is_solid;
        assert!(is_solid(&primitives::cube(1.0)) && is_solid(&primitives::cube_split(1.0)));
        assert!(is_solid(&primitives::sphere(1.0, 12, 16)) && is_solid(&primitives::torus(1.0, 0.3, 16, 8)));
        assert!(!is_solid(&primitives::plane(1.0)));
        let mut inside_out = primitives::cube(1.0);
        inside_out.indices.chunks_exact_mut(3).for_each(|t| t.swap(0, 1));
        assert!(!is_solid(&inside_out));
        let mut one_flipped = primitives::cube(1.0);
        one_flipped.indices.swap(0, 1);
        assert!(!is_solid(&one_flipped));
        let mut open = primitives::cube(1.0);
        open.indices.truncate(33);
        open.parts[0].index_count = 33;
        assert!(!is_solid(&open));
    }
}
