use glam::Vec3;

use super::*;
use crate::geometry::primitives::{cube, from_triangles, plane, sphere};

const ANGLE: f32 = 0.5;

fn bodies(mesh: &Mesh) -> Bodies {
    let adjacency = Adjacency::new(mesh);
    Bodies::new(mesh, &adjacency, Arc::new(adjacency.surfaces(ANGLE)))
}

fn moved(mut mesh: Mesh, by: Vec3) -> Mesh {
    mesh.positions.iter_mut().for_each(|p| *p += by);
    mesh
}

fn inside_out(mut mesh: Mesh) -> Mesh {
    mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|t| t.swap(0, 1));
    mesh
}

fn without(mut mesh: Mesh, triangles: usize) -> Mesh {
    mesh.indices.truncate(mesh.indices.len() - 3 * triangles);
    mesh
}

fn together(meshes: &[Mesh]) -> Mesh {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    for mesh in meshes {
        indices.extend(mesh.indices.iter().map(|i| i + positions.len() as u32));
        positions.extend(&mesh.positions);
    }
    from_triangles(positions, indices)
}

#[test]
fn each_body_is_judged_by_itself() {
    let far = Vec3::X * 5.0;
    let mesh = together(&[
        cube(4.0),
        inside_out(cube(2.0)),
        cube(1.0),
        moved(without(cube(1.0), 1), far),
        moved(inside_out(cube(1.0)), 2.0 * far),
        moved(sphere(1.0, 12, 16), 3.0 * far),
        moved(plane(1.0), 4.0 * far),
    ]);
    let found = bodies(&mesh);
    use BodyKind::{Cavity, Open, Solid};
    assert_eq!(found.kinds(), [Solid, Cavity, Solid, Open, Open, Solid, Open]);
    assert_eq!(found.open_count(), 3);
    let firsts = [0, 12, 24, 36, 47, 59];
    assert!(firsts.iter().zip(0..).all(|(&triangle, body)| found.of_triangle(triangle) == body));
    assert_eq!(found.of_triangle(u32::MAX), 0);
}

#[test]
fn bodies_that_touch_along_an_edge_are_closed() {
    let boxes = [Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0), Vec3::new(2.0, 0.0, 0.0), Vec3::new(1.0, 0.0, -1.0)];
    for count in 2..=4 {
        let mesh = together(&boxes[..count].iter().map(|by| moved(cube(1.0), *by)).collect::<Vec<_>>());
        assert_eq!(Adjacency::new(&mesh).non_manifold_count, if count == 4 { 4 } else { count - 1 });
        assert_eq!(bodies(&mesh).kinds(), [BodyKind::Solid], "{count}");
    }
    // A wall that begins at an edge of a box.
    let fin = from_triangles(
        vec![Vec3::new(0.5, -0.5, 0.5), Vec3::new(0.5, 0.5, 0.5), Vec3::new(2.0, 0.0, 2.0)],
        vec![0, 1, 2],
    );
    assert_eq!(bodies(&together(&[cube(1.0), fin.clone()])).kinds(), [BodyKind::Open]);
    // Seen from both sides, it belongs to the solid.
    assert_eq!(bodies(&together(&[cube(1.0), fin.clone(), inside_out(fin)])).kinds(), [BodyKind::Solid]);
}

#[test]
fn sheets_that_touch_in_a_point_are_open() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, 1.0], [-1.0, 1.0]];
    let points = corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec();
    let mesh = from_triangles(points, vec![0, 1, 2, 0, 3, 4, 0, 5, 6]);
    assert_eq!(bodies(&mesh).kinds(), [BodyKind::Open; 3]);
}

#[test]
fn one_turned_triangle_opens_its_body() {
    let mut mesh = together(&[cube(1.0), moved(cube(1.0), Vec3::X * 3.0)]);
    mesh.indices.swap(0, 1);
    assert_eq!(bodies(&mesh).kinds(), [BodyKind::Open, BodyKind::Solid]);
}

#[test]
fn where_a_body_lies_does_not_change_it() {
    let small = |at: f32| moved(sphere(1e-3, 8, 12), Vec3::splat(at));
    for mesh in [together(&[small(0.0), small(50.0)]), together(&[small(-50.0), small(50.0), cube(10.0)])] {
        assert_eq!(bodies(&mesh).open_count(), 0);
    }
    assert_eq!(bodies(&Mesh::default()).kinds(), []);
}
