use EdgeClass::{Border, Intersection, Material, Object, Ridge, Silhouette, Valley};

use super::tests::{LENSES, length, look_from, see, see_by};
use super::*;
use crate::geometry::{Lens, Submesh, primitives};

const EYE: DVec3 = DVec3::new(2.1, 2.9, 4.3);

/// The lengths of all classes.
fn lengths(visible: &VisibleEdges) -> [f64; EdgeClass::ALL.len()] {
    EdgeClass::ALL.map(|class| length(visible, class))
}

/// Length in world units.
fn world_length(visible: &VisibleEdges, class: EdgeClass) -> f64 {
    visible.segments.iter().filter(|s| s.class == class).map(|s| s.world_length()).sum()
}

fn at(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_translation(DVec3::new(x, y, z))
}

/// Both in one mesh.
fn joined(a: &Mesh, b: &Mesh, b_place: DMat4) -> Mesh {
    let base = a.positions.len() as u32;
    let moved = b.positions.iter().map(|p| b_place.transform_point3(p.as_dvec3()).as_vec3());
    let positions = a.positions.iter().copied().chain(moved).collect();
    primitives::from_triangles(
        positions,
        a.indices.iter().copied().chain(b.indices.iter().map(|i| base + i)).collect(),
    )
}

#[track_caller]
fn assert_alike(found: &VisibleEdges, expected: &VisibleEdges) {
    for (found, expected) in lengths(found).into_iter().zip(lengths(expected)) {
        assert!((found - expected).abs() <= 2.0, "{found} instead of {expected} px");
    }
}

#[test]
fn outlines_before_another_object_are_object_boundaries() {
    let (cube, wall) = (primitives::cube(0.5), primitives::plane(9.0));
    for lens in LENSES {
        let projector = look_from(DVec3::new(0.7, 0.9, 4.3), lens);
        let alone = see(&[(&cube, DMat4::IDENTITY)], &projector);
        let before = see(&[(&cube, DMat4::IDENTITY), (&wall, at(0.0, 0.0, -1.0))], &projector);
        assert!(length(&alone, Silhouette) > 100.0 && length(&alone, Object) == 0.0);
        assert!((length(&before, Object) - length(&alone, Silhouette)).abs() < 1.0);
        assert_eq!((length(&before, Silhouette), length(&before, Ridge)), (0.0, length(&alone, Ridge)));
        // In one mesh they are no two objects.
        let together = joined(&cube, &wall, at(0.0, 0.0, -1.0));
        assert_alike(&see(&[(&together, DMat4::IDENTITY)], &projector), &alone);
        // Those who do not ask for them see them as what they are besides.
        let classes = [Silhouette, Border, Ridge];
        let rules = LineRules { classes: &classes, ..LineRules::default() };
        let before = [(&cube, DMat4::IDENTITY), (&wall, at(0.0, 0.0, -1.0))];
        assert_alike(&see_by(&before, &projector, &rules), &alone);
    }
}

#[test]
fn surfaces_that_run_through_each_other_have_intersections() {
    let (cube, ball) = (primitives::cube(1.0), primitives::sphere(0.3, 32, 64));
    let plate = primitives::plane(2.0);
    let lying = DMat4::from_rotation_x(0.5 * std::f64::consts::PI);
    for lens in LENSES {
        // A plate through the middle of a cube, of which two sides are seen.
        let visible = see(&[(&cube, DMat4::IDENTITY), (&plate, lying)], &look_from(EYE, lens));
        let cut = world_length(&visible, Intersection);
        assert!((cut - 2.0).abs() < 0.01, "{cut}");
        let projector = look_from(EYE, lens);
        // Of a ball too, whether its vertices lie on the plate or not; about half of it is seen.
        for height in [0.0, -0.1] {
            let visible = see(&[(&plate, lying), (&ball, at(0.0, height, 0.0))], &projector);
            let around = world_length(&visible, Intersection);
            let radius = (0.09 - height * height).sqrt();
            let whole = std::f64::consts::TAU * radius;
            assert!((0.45 * whole..1.01 * whole).contains(&around), "{around} of {whole}");
            // Within one mesh as well.
            let mesh = joined(&plate, &ball, lying.inverse() * at(0.0, height, 0.0));
            let inside = world_length(&see(&[(&mesh, lying)], &projector), Intersection);
            assert!((inside - around).abs() < 0.02 * whole, "{inside} instead of {around}");
        }
    }
}

#[test]
fn what_only_touches_has_no_intersection() {
    let (cube, plate) = (primitives::cube(1.0), primitives::plane(1.6));
    for lens in LENSES {
        let projector = look_from(EYE, lens);
        for place in [at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.3), at(0.2, 1.0, 0.1)] {
            let visible = see(&[(&cube, DMat4::IDENTITY), (&cube, place)], &projector);
            assert_eq!(length(&visible, Intersection), 0.0, "{place}");
        }
        let turned = at(0.1, 0.0, 0.0) * DMat4::from_rotation_z(0.3);
        let visible = see(&[(&plate, DMat4::IDENTITY), (&plate, turned)], &projector);
        assert_eq!(length(&visible, Intersection), 0.0);
    }
}

/// Two rectangles that meet along x = 0, divided differently there; the second one lies at `angle` to the first.
fn junction(angle: f32) -> Mesh {
    let (sin, cos) = angle.sin_cos();
    let mut positions = vec![glam::Vec3::new(-1.0, -1.0, 0.0), glam::Vec3::new(-1.0, 1.0, 0.0)];
    positions.extend([-1.0, 1.0].map(|y| glam::Vec3::new(0.0, y, 0.0)));
    positions.extend([-1.0, -0.3, 0.4, 1.0].map(|y| glam::Vec3::new(0.0, y, 0.0)));
    positions.push(glam::Vec3::new(cos, 0.0, sin));
    primitives::from_triangles(positions, vec![0, 2, 3, 0, 3, 1, 4, 8, 5, 5, 8, 6, 6, 8, 7])
}

#[test]
fn at_t_junctions_the_surface_goes_on() {
    for lens in LENSES {
        let projector = look_from(DVec3::new(0.4, 0.3, 5.0), lens);
        let inner = |angle: f32| {
            let visible = see(&[(&junction(angle), DMat4::IDENTITY)], &projector);
            let on_it =
                |s: &&VisibleSegment| (s.ends[0].x - s.ends[1].x).abs() < 0.2 * s.ends[0].distance(s.ends[1]);
            let middle = |s: &&VisibleSegment| {
                let x = projector.pixel(projector.view_from_world.transform_point3(DVec3::ZERO)).x;
                (0.5 * (s.ends[0].x + s.ends[1].x) - x).abs() < 5.0
            };
            EdgeClass::ALL.map(|class| {
                let visible =
                    visible.segments.iter().filter(|s| s.class == class).filter(on_it).filter(middle);
                visible.map(|s| s.world_length()).sum::<f64>()
            })
        };
        assert_eq!(inner(0.0), [0.0; EdgeClass::ALL.len()], "flat");
        for (angle, class) in [(1.0, Valley), (-1.0, Ridge), (2.0, Silhouette), (-2.0, Silhouette)] {
            let found = inner(angle);
            for other in EdgeClass::ALL {
                let expected = if other == class { 2.0 } else { 0.0 };
                assert!((found[other as usize] - expected).abs() < 0.05, "{angle}: {found:?}");
            }
        }
    }
}

#[test]
fn winding_and_doubled_walls_change_nothing() {
    let mut open = primitives::cube(1.0);
    // Without the wall that faces the eye.
    open.indices.truncate(30);
    let mut flipped = open.clone();
    for triangle in flipped.indices.chunks_exact_mut(3).step_by(2) {
        triangle.swap(1, 2);
    }
    let mut turned = open.clone();
    for quad in turned.indices.chunks_exact_mut(6) {
        let [a, b, c, d] = [quad[0], quad[1], quad[2], quad[5]];
        quad.copy_from_slice(&[d, c, b, d, b, a]);
    }
    let doubled = joined(&open, &turned, DMat4::IDENTITY);
    for lens in LENSES {
        let projector = look_from(EYE, lens);
        let expected = see(&[(&open, DMat4::IDENTITY)], &projector);
        assert!(length(&expected, Border) > 100.0 && length(&expected, Valley) > 100.0);
        assert_eq!(length(&expected, Intersection), 0.0);
        for mesh in [flipped.clone(), doubled.clone()] {
            assert_alike(&see(&[(&mesh, DMat4::IDENTITY)], &projector), &expected);
        }
    }
}

#[test]
fn materials_meet_only_where_asked_for() {
    let mut mesh = primitives::plane(1.0);
    mesh.submeshes = vec![
        Submesh { first_index: 0, index_count: 3, material: 4 },
        Submesh { first_index: 3, index_count: 3, material: 2 },
    ];
    let mut same = mesh.clone();
    same.submeshes[1].material = 4;
    let rules = LineRules { classes: &EdgeClass::ALL, ..LineRules::default() };
    for lens in LENSES {
        let projector = look_from(DVec3::new(0.4, 0.3, 5.0), lens);
        assert_eq!(length(&see(&[(&mesh, DMat4::IDENTITY)], &projector), Material), 0.0);
        assert_eq!(length(&see_by(&[(&same, DMat4::IDENTITY)], &projector, &rules), Material), 0.0);
        let visible = see_by(&[(&mesh, DMat4::IDENTITY)], &projector, &rules);
        assert!((world_length(&visible, Material) - 2_f64.sqrt()).abs() < 1e-6);
    }
}

#[test]
fn through_holes_the_edges_behind_are_seen() {
    let (sheet, cube) = (primitives::plane(2.0), primitives::cube(0.5));
    for lens in LENSES {
        let projector = look_from(DVec3::new(0.0, 0.001, 5.0), lens);
        let meshes = [(&cube, DMat4::IDENTITY), (&sheet, at(0.0, 0.0, 1.0))];
        let hidden = see(&meshes, &projector);
        assert_eq!((length(&hidden, Object), length(&hidden, Ridge)), (0.0, 0.0));
        let edge = length(&hidden, Border) / 4.0;
        // The right half of the sheet is open.
        let is_hole = |point: SurfacePoint| {
            if point.mesh != 1 {
                return false;
            }
            let corners = sheet.corners(sheet.triangles()[point.triangle]);
            let x: f32 = corners.iter().zip(point.weights.as_vec3().to_array()).map(|(p, w)| p.x * w).sum();
            x > 0.0
        };
        let rules = LineRules { is_hole: Some(&is_hole), ..LineRules::default() };
        let seen = see_by(&meshes, &projector, &rules);
        assert!((length(&seen, Border) - 2.0 * edge).abs() < 1.0);
        let alone = length(&see(&meshes[..1], &projector), Silhouette);
        assert!((length(&seen, Silhouette) - alone / 2.0).abs() < 2.0, "{:?} {alone}", lengths(&seen));

        let adjacency = [Adjacency::new(&cube), Adjacency::new(&sheet)];
        let placed = [0, 1].map(|i| PlacedMesh {
            mesh: meshes[i].0,
            adjacency: &adjacency[i],
            world_from_local: meshes[i].1,
            object: i as u32,
        });
        let holes = EdgeScene::new(&placed).holes_before(&projector, &rules);
        assert_eq!([holes[400 * 800 + 390], holes[400 * 800 + 410], holes[0]], [0, 1, 0]);
    }
}

#[test]
fn what_lies_before_the_near_plane_hides_nothing() {
    let (wall, cube) = (primitives::plane(9.0), primitives::cube(0.5));
    for lens in LENSES {
        let near = Projector { near: 3.0, ..look_from(DVec3::new(0.7, 0.9, 5.0), lens) };
        let alone = see(&[(&cube, DMat4::IDENTITY)], &near);
        let behind = see(&[(&cube, DMat4::IDENTITY), (&wall, at(0.0, 0.0, 3.0))], &near);
        assert!(length(&alone, Silhouette) > 100.0);
        assert_alike(&behind, &alone);
        let far = Projector { near: 0.01, ..near };
        let hidden = see(&[(&cube, DMat4::IDENTITY), (&wall, at(0.0, 0.0, 3.0))], &far);
        assert_eq!(length(&hidden, Silhouette) + length(&hidden, Ridge), 0.0);
    }
}

#[test]
fn a_lens_close_to_the_surface_sees_edges_pass_by() {
    let cube = primitives::cube(1.0);
    let projector = look_from(DVec3::new(0.1, 0.2, 0.9), Lens::Perspective { tan_half_angle: 3.0 });
    let visible = see(&[(&cube, DMat4::IDENTITY)], &projector);
    // Only the side before the eye is seen.
    assert!((world_length(&visible, Silhouette) - 4.0).abs() < 0.01);
    assert_eq!(length(&visible, Ridge), 0.0);
}
