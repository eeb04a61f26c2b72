use super::*;
use crate::geometry::{Lens, primitives};

pub(super) fn look_from(eye: DVec3, lens: Lens) -> Projector {
    let view_from_world = look_at(eye);
    Projector { view_from_world, lens, size: [800, 800], near: 0.01, far: 100.0 }
}

pub(super) const LENSES: [Lens; 2] =
    [Lens::Perspective { tan_half_angle: 0.3 }, Lens::Orthographic { half_height: 1.5 }];

pub(super) fn see(meshes: &[(&Mesh, DMat4)], projector: &Projector) -> VisibleEdges {
    see_by(meshes, projector, &LineRules::default())
}

pub(super) fn see_by(
    meshes: &[(&Mesh, DMat4)],
    projector: &Projector,
    rules: &LineRules<'_>,
) -> VisibleEdges {
    let adjacency: Vec<Adjacency> = meshes.iter().map(|(mesh, _)| Adjacency::new(mesh)).collect();
    let placed: Vec<PlacedMesh<'_>> = meshes
        .iter()
        .zip(&adjacency)
        .enumerate()
        .map(|(i, (&(mesh, world_from_local), adjacency))| PlacedMesh {
            mesh,
            adjacency,
            world_from_local,
            object: i as u32,
        })
        .collect();
    EdgeScene::new(&placed).visible(projector, rules)
}

/// Length of what is visible, in pixels.
pub(super) fn length(visible: &VisibleEdges, class: EdgeClass) -> f64 {
    visible.samples[class as usize].iter().map(|s| s.length).sum()
}

#[test]
fn a_cube_shows_nine_edges_of_their_full_length() {
    let eye = DVec3::new(2.1, 2.9, 4.3);
    for lens in LENSES {
        let projector = look_from(eye, lens);
        for mesh in [primitives::cube(1.0), primitives::cube_split(1.0)] {
            for mirror in [1.0, -1.0] {
                let placement = DMat4::from_scale(DVec3::new(mirror, 1.0, 1.0));
                let visible = see(&[(&mesh, placement)], &projector);
                // All edges of the cube but those at the corner away from the eye.
                let (mut outline, mut inner) = (0.0, 0.0);
                let pixel = |p: DVec3| projector.pixel(projector.view_from_world.transform_point3(p));
                for axis in 0..3 {
                    for (u, v) in [(-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)] {
                        let mut a = DVec3::splat(-0.5);
                        (a[(axis + 1) % 3], a[(axis + 2) % 3]) = (u, v);
                        let b = a + DVec3::AXES[axis];
                        let seen = pixel(a).distance(pixel(b));
                        if u > 0.0 && v > 0.0 {
                            inner += seen;
                        } else if u > 0.0 || v > 0.0 {
                            outline += seen;
                        }
                    }
                }
                let drawn: std::collections::BTreeSet<u32> = visible
                    .segments
                    .iter()
                    .filter(|s| s.world_length() > 0.01)
                    .filter_map(|s| s.edge)
                    .collect();
                assert_eq!(drawn.len(), 9, "{:?}", visible.segments);
                assert!((length(&visible, EdgeClass::Silhouette) - outline).abs() < 1.0);
                assert!((length(&visible, EdgeClass::Ridge) - inner).abs() < 1.0);
                assert_eq!(length(&visible, EdgeClass::Border) + length(&visible, EdgeClass::Valley), 0.0);
                let world: f64 = visible.segments.iter().map(|s| s.world_length()).sum();
                assert!((world - 9.0).abs() < 0.01, "{world}");
            }
        }
    }
}

#[test]
fn a_sphere_has_a_round_outline() {
    let mesh = primitives::sphere(1.0, 64, 128);
    for lens in LENSES {
        // On the axis of the view, so that the outline is a circle around the middle of the picture.
        let projector = look_from(DVec3::new(1.2, 2.3, 4.1), lens);
        let distance = DVec3::new(1.2, 2.3, 4.1).length();
        let radius = match lens {
            Lens::Perspective { tan_half_angle } => {
                400.0 / tan_half_angle / (distance * distance - 1.0).sqrt()
            }
            Lens::Orthographic { half_height } => 400.0 / half_height,
        };
        let visible = see(&[(&mesh, DMat4::IDENTITY)], &projector);
        let silhouette = &visible.samples[EdgeClass::Silhouette as usize];
        for sample in silhouette {
            let off = sample.position.distance(DVec2::splat(400.0)) - radius;
            assert!(off.abs() < 0.005 * radius, "{off} px off the circle");
        }
        let around = length(&visible, EdgeClass::Silhouette) / (std::f64::consts::TAU * radius);
        assert!((0.97..1.3).contains(&around), "{around} times around");
        assert_eq!(visible.samples.iter().map(Vec::len).sum::<usize>(), silhouette.len());
    }
}

#[test]
fn a_cube_in_a_cube_is_hidden() {
    let (outer, inner) = (primitives::cube(1.0), primitives::cube(0.5));
    for lens in LENSES {
        let projector = look_from(DVec3::new(2.1, 2.9, 4.3), lens);
        let visible = see(&[(&outer, DMat4::IDENTITY), (&inner, DMat4::IDENTITY)], &projector);
        assert!(visible.segments.iter().all(|s| s.object == 0));
        assert!(visible.segments.len() >= 9);
    }
}

#[test]
fn an_open_sheet_has_borders_and_a_folded_one_a_valley() {
    let sheet = primitives::plane(1.0);
    for lens in LENSES {
        let projector = look_from(DVec3::new(0.0, 0.0, 5.0), lens);
        let visible = see(&[(&sheet, DMat4::IDENTITY)], &projector);
        let side = match lens {
            Lens::Perspective { tan_half_angle } => 400.0 / tan_half_angle / 5.0,
            Lens::Orthographic { half_height } => 400.0 / half_height,
        };
        assert!((length(&visible, EdgeClass::Border) - 4.0 * side).abs() < 1e-6);
        assert_eq!(visible.segments.len(), 4);

        let corners = [(-1.0, 1.0), (0.0, 0.0), (1.0, 1.0)]
            .map(|(x, z)| [glam::Vec3::new(x, -0.5, z), glam::Vec3::new(x, 0.5, z)]);
        let valley = primitives::from_triangles(corners.concat(), vec![0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3]);
        let visible = see(&[(&valley, DMat4::IDENTITY)], &projector);
        assert!((length(&visible, EdgeClass::Valley) - side).abs() < 1e-6);
        assert_eq!(visible.segments.len(), 7);
    }
}

/// World to view space of an eye that looks at the origin, +Y up.
fn look_at(eye: DVec3) -> DMat4 {
    let back = eye.normalize();
    let right = DVec3::Y.cross(back).normalize();
    let up = back.cross(right);
    let rotation = DMat4::from_cols(
        DVec3::new(right.x, up.x, back.x).extend(0.0),
        DVec3::new(right.y, up.y, back.y).extend(0.0),
        DVec3::new(right.z, up.z, back.z).extend(0.0),
        glam::DVec4::W,
    );
    rotation * DMat4::from_translation(-eye)
}
