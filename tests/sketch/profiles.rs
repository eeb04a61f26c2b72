//! Strokes along the profile of models that are open, have no normals or are split at seams.

use std::sync::Arc;

use glam::{DMat4, DVec3, Vec3};
use hachure::geometry::primitives::{from_triangles, sphere, torus};
use hachure::geometry::visible_edges::{EdgeScene, LineRules, PlacedMesh};
use hachure::geometry::{Adjacency, EdgeClass, Lens, Mesh, Projector};
use hachure::scene::{Camera, Projection};
use hachure::style::sketch::Anchor;

use super::common::{
    self,
    line_drawing::{Ink, line_drawing, only},
};
use super::{set_style, sketched};

const SIDE: u32 = 320;

const PROFILE: [EdgeClass; 3] = [EdgeClass::Silhouette, EdgeClass::Border, EdgeClass::Object];

/// The lower half of a ball, open above.
fn bowl() -> Mesh {
    let ball = sphere(1.0, 24, 48);
    let is_low = |t: &[u32]| t.iter().all(|v| ball.positions[*v as usize].y < 0.05);
    let indices = ball.indices.chunks_exact(3).filter(|t| is_low(t)).flatten().copied().collect();
    let mut mesh = ball.clone();
    mesh.indices = indices;
    mesh.submeshes[0].index_count = mesh.indices.len() as u32;
    mesh
}

fn without_normals() -> Mesh {
    let torus = torus(1.0, 0.35, 48, 24);
    from_triangles(torus.positions, torus.indices)
}

/// Each triangle has vertices of its own.
fn split() -> Mesh {
    let torus = torus(1.0, 0.35, 48, 24);
    let positions: Vec<Vec3> = torus.indices.iter().map(|v| torus.positions[*v as usize]).collect();
    let indices = (0..positions.len() as u32).collect();
    from_triangles(positions, indices)
}

fn projector(camera: &Camera) -> Projector {
    let Projection::Perspective { view_angle } = camera.projection else { unreachable!() };
    Projector {
        view_from_world: camera.view_from_world(),
        lens: Lens::Perspective { tan_half_angle: (view_angle.to_radians() * 0.5).tan() },
        size: [SIDE; 2],
        near: camera.distance() * 1e-3,
        far: camera.distance() * 10.0,
    }
}

#[test]
fn profiles_of_open_and_split_models_have_strokes_all_along() {
    let mut session = common::session();
    let models = [("bowl", bowl()), ("without normals", without_normals()), ("split", split())];
    for (name, mesh) in models {
        let scene = common::scene(vec![(name, mesh.clone(), DMat4::IDENTITY, [0.8; 3])]);
        let adjacency = Adjacency::new(&mesh);
        let placed =
            PlacedMesh { mesh: &mesh, adjacency: &adjacency, world_from_local: DMat4::IDENTITY, object: 0 };
        let edges = EdgeScene::new(&[placed]);
        let (mut near, mut all) = (0.0, 0.0);
        let mut least: f64 = 1.0;
        for (towards, anchor, amplitude) in [
            (DVec3::new(0.4, 0.7, 1.0), Anchor::Surface, 1.2),
            (DVec3::new(-0.5, 0.35, 1.0), Anchor::Surface, 2.0),
            (DVec3::new(0.2, 1.0, -0.6), Anchor::Surface, 3.0),
            (DVec3::new(0.9, -0.4, 0.5), Anchor::Curvature, 1.2),
            (DVec3::new(0.4, 0.7, 1.0), Anchor::Screen, 2.0),
            (DVec3::new(0.4, 0.5, 1.0), Anchor::Normal, 2.0),
        ] {
            let camera = Camera::looking_from(towards, DVec3::Y, &scene.extent(), 1.0);
            let mut opened = line_drawing(&Arc::clone(&scene), camera);
            only(&mut opened, &PROFILE);
            let reference = amplitude * 1080.0 / SIDE as f32;
            let mut style = sketched(opened.document.style.clone(), reference, reference);
            style.edges.profile.width = 1.5 * 1080.0 / SIDE as f32;
            style.sketch.wander.anchor = anchor;
            // Waves as long beside offsets as they should be.
            style.sketch.wander.wave = (50.0 * reference).min(400.0);
            set_style(&mut opened, 0, &style);
            session.set_scene(&opened).unwrap();
            let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
            let rules = LineRules { classes: &PROFILE, ..LineRules::default() };
            let truth = edges.visible(&projector(&camera), &rules);
            let reach = 3.0 * f64::from(amplitude);
            let has_ink = |at: glam::DVec2| {
                let far = reach.ceil() as i32;
                let (x, y) = (at.x.floor() as i32, at.y.floor() as i32);
                (-far..=far).any(|dy| {
                    (-far..=far).any(|dx| {
                        let middle = glam::DVec2::new(f64::from(x + dx) + 0.5, f64::from(y + dy) + 0.5);
                        middle.distance(at) <= reach && ink.at(x + dx, y + dy) > 0.3
                    })
                })
            };
            let (mut own_near, mut own_all) = (0.0, 0.0);
            for sample in truth.samples.iter().flatten() {
                own_all += sample.length;
                own_near += if has_ink(sample.position) { sample.length } else { 0.0 };
            }
            assert!(own_all > 200.0, "{name}: {own_all} px of profile");
            least = least.min(own_near / own_all);
            near += own_near;
            all += own_all;
        }
        println!(
            "{name}: strokes along {:.2} % of the profile, {:.2} % in the worst picture",
            100.0 * near / all,
            100.0 * least
        );
        assert!(least >= 0.95, "{name}: {least}");
    }
}
