use super::*;
use crate::geometry::primitives::{cube, from_triangles, sphere};

#[test]
fn a_sound_mesh_comes_back_untouched() {
    let mesh = sphere(1.0, 12, 24);
    let buffers = |m: &Mesh| (m.positions.as_ptr(), m.indices.as_ptr());
    let (copy, before) = (mesh.clone(), buffers(&mesh));
    let (after, report) = clean(mesh);
    assert!(report.is_clean() && report.messages().is_empty());
    assert_eq!(buffers(&after), before, "nothing is copied");
    assert!(after == copy);
}

#[test]
fn every_fault_is_counted_and_dropped() {
    let mut mesh = cube(2.0);
    let n = mesh.positions.len() as u32;
    mesh.positions.extend([
        Vec3::new(f32::NAN, 0.0, 0.0),
        Vec3::new(0.0, f32::INFINITY, 0.0),
        Vec3::ZERO,
        Vec3::X,
        Vec3::X * 3.0,
        mesh.positions[0],
    ]);
    let sound = mesh.indices.len() as u32;
    mesh.indices.extend(
        [
            [0, 1, 99],            // out of range
            [0, 1, n],             // NaN
            [0, 1, n + 1],         // infinite
            [0, 1, 1],             // repeated corner
            [0, 1, n + 5],         // coincident corners
            [n + 2, n + 3, n + 4], // collinear
            [6, 4, 0],             // duplicate of the first, turned round
            [n + 5, 4, 6],         // duplicate by position
        ]
        .as_flattened(),
    );
    mesh.submeshes.push(Submesh { first_index: sound, index_count: 24, material: 1 });
    let (after, report) = clean(mesh);
    assert_eq!(
        report,
        CleanReport { out_of_range: 1, not_finite: 2, degenerate: 3, duplicate: 2, ..CleanReport::default() }
    );
    assert_eq!(report.dropped(), 8);
    assert_eq!(after, cube(2.0), "the second part is empty and gone, unused vertices too");
    let messages = report.messages();
    assert_eq!(messages.len(), 4);
    assert_eq!(messages[0], "left out 1 triangle with a vertex index out of range");
    assert!(messages[1].starts_with("left out 2 triangles"));
}

#[test]
fn parts_move_up_when_triangles_before_them_go() {
    let mut mesh = cube(2.0);
    mesh.indices[1] = mesh.indices[0];
    mesh.submeshes = vec![
        Submesh { first_index: 0, index_count: 6, material: 4 },
        Submesh { first_index: 6, index_count: 30, material: 7 },
    ];
    let (after, report) = clean(mesh);
    assert_eq!(report.degenerate, 1);
    assert_eq!(after.submeshes[0], Submesh { first_index: 0, index_count: 3, material: 4 });
    assert_eq!(after.submeshes[1], Submesh { first_index: 3, index_count: 30, material: 7 });
    assert_eq!(after.indices.len(), 33);
}

#[test]
fn small_and_large_units_and_slivers_are_kept() {
    for scale in [1e-15, 1e-6, 1.0, 1e6, 1e15] {
        let mut mesh = cube(2.0);
        mesh.positions.iter_mut().for_each(|p| *p *= scale);
        assert!(clean(mesh).1.is_clean(), "{scale}");
    }
    let sliver = vec![Vec3::ZERO, Vec3::X, Vec3::new(0.5, 1e-6, 0.0)];
    assert!(clean(from_triangles(sliver, vec![0, 1, 2])).1.is_clean());
}

#[test]
fn vertices_that_are_not_finite_go_even_when_unused() {
    let mut mesh = cube(2.0);
    mesh.positions.push(Vec3::NAN);
    assert_eq!(clean(mesh).0, cube(2.0));
}

#[test]
fn normals_without_direction_and_attributes_of_wrong_length_are_repaired() {
    let mut mesh = sphere(1.0, 4, 6);
    mesh.normals[8] = Vec3::ZERO;
    mesh.normals[9] *= 7.0;
    mesh.uvs.pop();
    let (after, report) = clean(mesh);
    assert_eq!((report.bad_normals, report.bad_attributes), (1, 1));
    assert!(after.uvs.is_empty());
    assert!(after.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-3));
    assert!(after.normals[8].dot(after.positions[8]) > 0.5);
}

#[test]
fn nothing_and_only_rubbish_become_nothing() {
    assert_eq!(clean(Mesh::default()).0, Mesh::default());
    let rubbish = from_triangles(vec![Vec3::ZERO; 3], vec![0, 1, 2, 7, 8, 9, 1]);
    let (after, report) = clean(rubbish);
    assert_eq!(after, Mesh::default());
    assert_eq!((report.degenerate, report.out_of_range), (1, 2));
}

#[test]
fn many_duplicates_are_all_found() {
    let mut mesh = sphere(1.0, 40, 60);
    let sound = mesh.clone();
    let copy = mesh.indices.clone();
    mesh.indices.extend(copy.as_chunks::<3>().0.iter().flat_map(|&[a, b, c]| [b, a, c]));
    mesh.submeshes[0].index_count *= 2;
    let (after, report) = clean(mesh);
    assert_eq!(report.duplicate, sound.triangle_count());
    assert!(after == sound);
}
