//! Pictures of lines against the exact visible edges (paper mode; its known limits set the bar).

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the scores are worth reading")]

mod common;

use common::{draw, ink, opened, scene, session};
use glam::{DMat4, DVec3};
use hachure::geometry::line_score::{InkImage, LineScore, score};
use hachure::geometry::visible_edges::{EdgeScene, PlacedMesh};
use hachure::geometry::{Adjacency, Lens, Mesh, Projector, primitives};
use hachure::scene::Projection;

const SIDE: u32 = 400;

/// Draws a mesh with the default edges and scores the edge map within 1.5 pixels.
fn measure(mesh: &Mesh, towards_viewer: DVec3, orthographic: bool) -> LineScore {
    let scene = scene(vec![("object", mesh.clone(), DMat4::IDENTITY, [0.7; 3])]);
    let mut opened = opened(&scene, towards_viewer);
    let camera = opened.document.camera.unwrap().with_orthographic(orthographic);
    opened.document.camera = Some(camera);
    let mut session = session();
    let picture = draw(&mut session, &opened, SIDE);
    let ink: Vec<f32> = ink(&mut session, &picture).iter().map(|i| i.0.max(i.1)).collect();

    let adjacency = Adjacency::new(mesh);
    let placed = PlacedMesh { mesh, adjacency: &adjacency, world_from_local: DMat4::IDENTITY, object: 1 };
    let projector = Projector {
        view_from_world: camera.view_from_world(),
        lens: match camera.projection {
            Projection::Perspective { view_angle } => {
                Lens::Perspective { tan_half_angle: (view_angle.to_radians() * 0.5).tan() }
            }
            Projection::Orthographic { view_height } => Lens::Orthographic { half_height: view_height * 0.5 },
        },
        size: [SIDE; 2],
        near: camera.distance() * 1e-3,
        far: camera.distance() * 10.0,
    };
    let truth = EdgeScene::new(&[placed]).visible(&projector, 30.0);
    score(InkImage::new(SIDE as usize, SIDE as usize, &ink).unwrap(), &truth, 1.5)
}

#[test]
fn simple_solids_are_outlined_where_their_edges_are() {
    let towards = DVec3::new(0.5, 0.6, 1.0);
    for (name, mesh, least) in [
        ("cube", primitives::cube(2.0), 0.98),
        ("sphere", primitives::sphere(1.0, 48, 96), 0.9),
        ("torus", primitives::torus(1.0, 0.35, 96, 48), 0.8),
    ] {
        for orthographic in [false, true] {
            let s = measure(&mesh, towards, orthographic);
            println!("{name:<8} precision {:.3} recall {:.3} F1 {:.3}", s.precision, s.recall, s.f1());
            assert!(s.f1() >= least, "{name}: {s:?}");
        }
    }
}
