use glam::Vec3;

use super::*;
use crate::geometry::primitives;

/// A cube of which every second triangle pair is in another mesh.
fn halves(offset: Vec3) -> [Mesh; 2] {
    let cube = primitives::cube(1.0);
    let (one, two) = cube.indices.split_at(cube.indices.len() / 2);
    [(one, Vec3::ZERO), (two, offset)].map(|(indices, offset)| {
        let positions = cube.positions.iter().map(|p| p + offset).collect();
        primitives::from_triangles(positions, indices.to_vec()).without_unused_vertices()
    })
}

fn joined(meshes: &[Mesh; 2]) -> Vec<Option<Mesh>> {
    link_meshes(&[(3, &meshes[0]), (8, &meshes[1])], SeamTolerance::Automatic)
}

#[test]
fn halves_know_each_other_along_their_whole_border() {
    let joined = joined(&halves(Vec3::ZERO));
    for (mesh, other) in joined.iter().flatten().zip([8, 3]) {
        let adjacency = Adjacency::new(mesh);
        assert!(adjacency.border_count > 0 && adjacency.border_links.len() == adjacency.border_count);
        assert!(mesh.border_links.iter().all(|beyond| beyond.mesh == other && !beyond.is_soft));
    }
    assert_eq!(joined.iter().flatten().count(), 2);
}

#[test]
fn cracks_between_meshes_are_mended_and_gaps_are_not() {
    let crack = joined(&halves(Vec3::splat(1e-5)));
    assert_eq!(crack.iter().flatten().count(), 2);
    for mesh in crack.iter().flatten() {
        assert!(
            !mesh.position_errors.is_empty()
                && Adjacency::new(mesh).border_links.len() == mesh.border_links.len()
        );
    }
    assert!(joined(&halves(Vec3::splat(1e-2))).iter().flatten().next().is_none());
}

#[test]
fn sheets_that_lie_on_each_other_stay_apart() {
    let sheet = primitives::plane(1.0);
    assert!(joined(&[sheet.clone(), sheet]).iter().flatten().next().is_none());
}
