use super::*;
use crate::geometry::primitives::{cube, from_triangles, sphere};
use crate::geometry::{Adjacency, clean};

/// Every triangle its own three vertices, as in STL.
fn soup(mesh: &Mesh) -> Mesh {
    let mut soup = mesh.gather(&mesh.indices);
    soup.indices = (0..mesh.indices.len() as u32).collect();
    soup.submeshes.clone_from(&mesh.submeshes);
    soup
}

#[test]
fn a_cube_keeps_its_edges_below_its_angle_and_loses_them_above() {
    let sharp = by_crease_angle(cube(2.0), 30.0);
    assert_eq!(sharp.positions.len(), 24);
    for (&t, face) in sharp.triangles().iter().zip(face_normals(&sharp)) {
        for v in t {
            assert!(sharp.normals[v as usize].distance(face) < 1e-6);
        }
    }
    assert_eq!(Adjacency::new(&sharp).edges.len(), 18);

    let round = by_crease_angle(cube(2.0), 100.0);
    assert_eq!([round.positions.len(), round.normals.len()], [8; 2]);
    for (p, n) in round.positions.iter().zip(&round.normals) {
        // Angle weights make the corner's diagonal exact, whichever way the sides are triangulated.
        assert!(n.distance(p.normalize()) < 1e-6);
    }
}

#[test]
fn soup_becomes_as_smooth_as_the_indexed_mesh() {
    let exact = sphere(1.0, 24, 48);
    let flat_soup = flat(soup(&exact));
    assert!(flat_soup.normals.is_empty());
    let smooth = by_crease_angle(flat_soup, 40.0);
    assert_eq!([smooth.positions.len(), smooth.normals.len()], [exact.indices.len(); 2]);
    for (p, n) in smooth.positions.iter().zip(&smooth.normals) {
        assert!(n.distance(*p) < 0.01, "{n} at {p}");
    }
}

#[test]
fn seams_of_texture_coordinates_stay_and_get_one_normal() {
    let mesh = sphere(1.0, 8, 16);
    let smooth = by_crease_angle(mesh.clone(), 80.0);
    assert!(smooth.positions == mesh.positions && smooth.uvs == mesh.uvs);
    // Behind the 16 vertices of the pole, the first and the last of each row are the two sides of the seam.
    for row in smooth.normals[16..].chunks_exact(17).take(7) {
        assert_eq!(row[0], row[16]);
    }
}

#[test]
fn only_the_corners_on_a_crease_are_split() {
    // A roof: two quads that meet at 90 degrees.
    let positions = vec![
        Vec3::new(-1.0, 0.0, 0.0),
        Vec3::new(-1.0, 0.0, 1.0),
        Vec3::new(0.0, 1.0, 1.0),
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(1.0, 0.0, 1.0),
        Vec3::new(1.0, 0.0, 0.0),
    ];
    let roof = from_triangles(positions, vec![0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5]);
    let sharp = by_crease_angle(roof.clone(), 45.0);
    assert_eq!(sharp.positions.len(), 8);
    assert!(clean(sharp).1.is_clean());
    assert_eq!(by_crease_angle(roof, 95.0).positions.len(), 6);
}

#[test]
fn a_fan_of_thousands_is_quick_and_smooth() {
    let n = 20_000_u32;
    let mut positions = vec![Vec3::Y];
    positions.extend((0..n).map(|i| {
        let (sin, cos) = (i as f32 / n as f32 * std::f32::consts::TAU).sin_cos();
        Vec3::new(cos, 0.0, -sin)
    }));
    let indices = (0..n).flat_map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect();
    let started = std::time::Instant::now();
    let cone = by_crease_angle(from_triangles(positions, indices), 30.0);
    assert!(started.elapsed().as_secs() < 5);
    assert!(cone.normals[0].distance(Vec3::Y) < 1e-3);
}

#[test]
fn tiny_and_empty_meshes_work() {
    assert_eq!(by_crease_angle(Mesh::default(), 30.0), Mesh::default());
    let mut tiny = cube(2.0);
    tiny.positions.iter_mut().for_each(|p| *p *= 1e-15);
    assert_eq!(by_crease_angle(tiny, 30.0).positions.len(), 24);
}
