use glam::{DVec2, DVec3, DVec4, Vec3};

use super::*;
use crate::geometry::feature_edges::tests::junction;
use crate::geometry::{Adjacency, CreaseRule, FeatureEdges, Lens, Mesh, Projector, Topology, primitives};

pub(super) const LENSES: [Lens; 2] =
    [Lens::Perspective { tan_half_angle: 0.3 }, Lens::Orthographic { half_height: 1.5 }];

pub(super) const EYE: DVec3 = DVec3::new(2.1, 2.9, 4.3);

/// World to view space of an eye that looks at the origin, +Y up.
pub(super) fn look_at(eye: DVec3) -> DMat4 {
    let back = eye.normalize();
    let right = DVec3::Y.cross(back).normalize();
    let up = back.cross(right);
    let rotation = DMat4::from_cols(
        DVec3::new(right.x, up.x, back.x).extend(0.0),
        DVec3::new(right.y, up.y, back.y).extend(0.0),
        DVec3::new(right.z, up.z, back.z).extend(0.0),
        DVec4::W,
    );
    rotation * DMat4::from_translation(-eye)
}

pub(super) fn look_from(eye: DVec3, lens: Lens) -> LineView {
    let projector =
        Projector { view_from_world: look_at(eye), lens, size: [800, 800], near: 0.01, far: 100.0 };
    LineView { projector, jitter: DVec2::ZERO, margin: 64.0, clip_planes: [glam::DVec4::ZERO; 2] }
}

/// All classes, creases from 30°.
pub(super) fn everything() -> LineSelection {
    let angle = 30_f32.to_radians();
    LineSelection {
        classes: ClassSet::ALL,
        ridge_angle: angle,
        intersection_angle: 0.0,
        valley_angle: angle,
        suppress_angle: f32::INFINITY,
        dashes: None,
    }
}

/// A mesh with what topology knows of it.
pub(super) struct Subject {
    pub mesh: Mesh,
    pub edges: FeatureEdges,
    pub adjacency: Adjacency,
    pub is_solid: bool,
}

impl Subject {
    pub(super) fn new(mesh: Mesh) -> Self {
        let adjacency = Adjacency::new(&mesh);
        let edges = FeatureEdges::new(&mesh, &adjacency, adjacency.surfaces(0.5));
        let is_solid = Topology::new(&mesh, 0.5, CreaseRule::Normals).is_solid;
        Self { mesh, edges, adjacency, is_solid }
    }

    pub(super) fn at(&self, world_from_local: DMat4) -> PlacedEdges<'_> {
        let Self { mesh, edges, is_solid, .. } = self;
        PlacedEdges { edges, mesh, world_from_local, object: 7, is_solid: *is_solid, shown: &[] }
    }

    pub(super) fn segments(&self, place: DMat4, view: &LineView, wanted: &LineSelection) -> Vec<LineSegment> {
        let mut out = Vec::new();
        line_segments(&self.at(place), view, wanted, &mut out);
        out
    }
}

fn count(segments: &[LineSegment], class: EdgeClass) -> usize {
    segments.iter().filter(|s| s.class == class as u32).count()
}

fn length(segments: &[LineSegment], class: EdgeClass) -> f32 {
    let own = segments.iter().filter(|s| s.class == class as u32);
    own.map(|s| DVec2::from(s.ends[0].map(f64::from)).distance(s.ends[1].map(f64::from).into()) as f32).sum()
}

#[test]
fn a_cube_has_six_silhouettes_and_three_ridges_before_the_eye() {
    for mesh in [primitives::cube(1.0), primitives::cube_split(1.0)] {
        let cube = Subject::new(mesh);
        for (lens, mirror) in LENSES.into_iter().zip([1.0, -1.0]) {
            let place = DMat4::from_scale(DVec3::new(mirror, 1.0, 1.0));
            let view = look_from(EYE, lens);
            let segments = cube.segments(place, &view, &everything());
            assert_eq!(count(&segments, EdgeClass::Silhouette), 6);
            assert_eq!(count(&segments, EdgeClass::Ridge), 3);
            assert_eq!(segments.len(), 9);
            for segment in &segments {
                assert!((segment.angle - std::f32::consts::FRAC_PI_2).abs() < 1e-5);
                assert!(segment.surfaces[0] != segment.surfaces[1] && segment.surfaces[1] < 6);
                assert_eq!((segment.object, segment.arcs), (7, [0.0; 2]));
            }
            // Not known to be solid, its back may be seen.
            let open = PlacedEdges { is_solid: false, ..cube.at(place) };
            let mut segments = Vec::new();
            line_segments(&open, &view, &everything(), &mut segments);
            assert_eq!((segments.len(), count(&segments, EdgeClass::Valley)), (12, 3));
        }
    }
}

#[test]
fn ends_are_where_the_projector_says() {
    let cube = Subject::new(primitives::cube(1.0));
    for lens in LENSES {
        let jitter = DVec2::new(0.25, -0.125);
        let view = LineView { jitter, ..look_from(EYE, lens) };
        for segment in cube.segments(DMat4::IDENTITY, &view, &everything()) {
            for (px, depth) in segment.ends.into_iter().zip(segment.depths) {
                let px = DVec2::from(px.map(f64::from)) - jitter;
                let there = view.projector.unproject(px, f64::from(depth));
                let world = view.projector.view_from_world.inverse().transform_point3(there);
                assert!((world.abs() - 0.5).abs().max_element() < 1e-5, "{world}");
            }
        }
    }
}

#[test]
fn outlines_of_closed_meshes_are_closed() {
    let meshes = [primitives::sphere(1.0, 24, 48), primitives::torus(1.0, 0.4, 40, 24)];
    let wanted = LineSelection { classes: ClassSet::of(&[EdgeClass::Silhouette]), ..everything() };
    for subject in meshes.map(Subject::new) {
        for (i, lens) in LENSES.into_iter().cycle().take(40).enumerate() {
            let (sin, cos) = (0.37 * i as f64).sin_cos();
            // Every second one exactly along an axis, where triangles are seen edge-on.
            let eye = if i % 4 < 2 {
                DVec3::new(5.0 * cos, 2.0 * sin, 5.0 * sin)
            } else {
                DVec3::new(0.0, 1e-9, 5.0)
            };
            let placed = subject.at(DMat4::IDENTITY);
            let view = look_from(eye, lens);
            let view_from_local = view.projector.view_from_world;
            let picture = PictureMap::new(&view, &view_from_local);
            let finder = Finder::new(&placed, &view, &wanted, &view_from_local, picture);
            let mut uses = vec![0; subject.mesh.positions.len()];
            for e in 0..subject.edges.len() {
                let [one, two] = subject.edges.faces[e].map(|face| finder.facings.of(face));
                if one != two {
                    subject.edges.ends[e].iter().for_each(|&v| uses[v as usize] += 1);
                }
            }
            assert!(uses.iter().all(|n| n % 2 == 0) && uses.iter().any(|&n| n > 0));
        }
    }
}

#[test]
fn unwanted_creases_are_found_as_suppressed() {
    let cube = Subject::new(primitives::cube(1.0));
    let view = look_from(EYE, LENSES[0]);
    let wanted = LineSelection {
        classes: ClassSet::of(&[EdgeClass::Silhouette]),
        suppress_angle: 0.5,
        ..everything()
    };
    let segments = cube.segments(DMat4::IDENTITY, &view, &wanted);
    assert_eq!((segments.len(), count(&segments, EdgeClass::Silhouette)), (9, 6));
    let suppressed: Vec<_> = segments.iter().filter(|s| s.is_suppressed()).collect();
    assert!(suppressed.len() == 3 && suppressed.iter().all(|s| s.edge_class() == Some(EdgeClass::Ridge)));
    // Too blunt for a ridge, not for a boundary of surfaces.
    let wanted = LineSelection { ridge_angle: 1.6, suppress_angle: 1.0, ..everything() };
    let segments = cube.segments(DMat4::IDENTITY, &view, &wanted);
    assert_eq!((segments.len(), count(&segments, EdgeClass::Silhouette)), (9, 6));
    let wanted =
        LineSelection { classes: ClassSet::of(&[EdgeClass::Ridge]), suppress_angle: 0.5, ..everything() };
    let segments = cube.segments(DMat4::IDENTITY, &view, &wanted);
    assert_eq!((segments.len(), count(&segments, EdgeClass::Ridge)), (9, 3));
    let wanted = LineSelection { classes: ClassSet::of(&[EdgeClass::Intersection]), ..everything() };
    assert!(cube.segments(DMat4::IDENTITY, &view, &wanted).is_empty());
    let wanted = LineSelection { classes: ClassSet::of(&[EdgeClass::Object]), ..everything() };
    assert_eq!(count(&cube.segments(DMat4::IDENTITY, &view, &wanted), EdgeClass::Silhouette), 6);
}

#[test]
fn scales_change_angles() {
    // A roof of 90°, pressed flat to 2 · atan(0.2) below the horizontal on either side: it bends by 22.6°.
    let roof = |y: f32| {
        let corners = [(-1.0, -1.0), (0.0, 0.0), (1.0, -1.0)]
            .map(|(x, h)| [Vec3::new(x, y * h, -0.5), Vec3::new(x, y * h, 0.5)]);
        primitives::from_triangles(corners.concat(), vec![0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4])
    };
    for (angle, up) in [(EdgeClass::Ridge, 1.0), (EdgeClass::Valley, -1.0)] {
        let roof = Subject::new(roof(up));
        let view = look_from(DVec3::new(0.2, 5.0, 0.4), LENSES[0]);
        for (scale, bend) in [(1.0_f64, 90.0_f64), (0.2, 22.62), (5.0, 157.38), (-1.0, 90.0), (-0.2, 22.62)] {
            let place = DMat4::from_scale(DVec3::new(scale.signum(), scale.abs(), 1.0));
            let found = |least: f64| {
                let least = least.to_radians() as f32;
                let wanted = LineSelection { ridge_angle: least, valley_angle: least, ..everything() };
                count(&roof.segments(place, &view, &wanted), angle)
            };
            let silhouette = count(&roof.segments(place, &view, &everything()), EdgeClass::Silhouette);
            assert_eq!((found(bend - 0.1), found(bend + 0.1), silhouette), (1, 0, 0), "{scale}");
        }
    }
}

#[test]
fn segments_end_at_the_near_plane_and_beyond_the_sides() {
    // A long bar that runs past the eye, and the picture of it.
    let bar = Subject::new(primitives::cube(1.0));
    let place = DMat4::from_translation(DVec3::new(0.6, -0.8, 0.0))
        * DMat4::from_rotation_x(0.02)
        * DMat4::from_scale(DVec3::new(0.1, 0.1, 60.0));
    for lens in LENSES {
        let projector =
            Projector { view_from_world: DMat4::IDENTITY, lens, size: [800, 600], near: 0.5, far: 100.0 };
        let view =
            LineView { projector, jitter: DVec2::ZERO, margin: 64.0, clip_planes: [glam::DVec4::ZERO; 2] };
        let segments = bar.segments(place, &view, &everything());
        assert!(segments.len() >= 3, "{lens:?}: {}", segments.len());
        for segment in &segments {
            assert!(segment.depths.iter().all(|&d| (0.4999..30.01).contains(&d)), "{segment:?}");
            for [x, y] in segment.ends {
                assert!((-64.01..=864.01).contains(&x) && (-64.01..=664.01).contains(&y), "{segment:?}");
            }
        }
        let behind = DMat4::from_translation(DVec3::new(0.0, 0.0, 40.0));
        assert!(bar.segments(behind, &view, &everything()).is_empty());
        let aside = DMat4::from_translation(DVec3::new(400.0, 0.0, -5.0));
        assert!(bar.segments(aside, &view, &everything()).is_empty());
    }
}

#[test]
fn an_eye_inside_a_box_sees_its_edges() {
    let room = Subject::new(primitives::cube(4.0));
    let view = LineView { ..look_from(DVec3::new(0.1, 0.2, 0.3), Lens::Perspective { tan_half_angle: 0.9 }) };
    let segments = room.segments(DMat4::IDENTITY, &view, &everything());
    assert!(count(&segments, EdgeClass::Valley) >= 3, "{segments:?}");
    assert_eq!(count(&segments, EdgeClass::Silhouette), 0);
    assert!(segments.iter().flat_map(|s| s.depths).all(|d| d > 0.0));
}

#[test]
fn flat_placements_and_degenerate_triangles_do_no_harm() {
    let flat = DMat4::from_scale(DVec3::new(1.0, 1.0, 0.0));
    let sphere = Subject::new(primitives::sphere(1.0, 12, 24));
    let nothing = DMat4::from_scale(DVec3::ZERO);
    let broken = DMat4::from_scale(DVec3::splat(f64::NAN));
    let line = primitives::from_triangles(
        vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::Y],
        vec![0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 0, 1],
    );
    let line = Subject::new(line);
    for lens in LENSES {
        let view = look_from(EYE, lens);
        let segments = sphere.segments(flat, &view, &everything());
        assert!(length(&segments, EdgeClass::Silhouette) > 100.0);
        for (subject, place) in [(&sphere, nothing), (&sphere, broken), (&line, DMat4::IDENTITY)] {
            for segment in subject.segments(place, &view, &everything()) {
                assert!(segment.ends.iter().flatten().all(|x| x.is_finite()), "{segment:?}");
            }
        }
        let empty = Subject::new(primitives::from_triangles(Vec::new(), Vec::new()));
        assert!(empty.segments(DMat4::IDENTITY, &view, &everything()).is_empty());
    }
}

#[test]
fn t_junctions_are_what_the_surface_is() {
    for lens in LENSES {
        let view = look_from(DVec3::new(0.4, 0.3, 5.0), lens);
        for (angle, class) in [
            (0.0, None),
            (1.0, Some(EdgeClass::Valley)),
            (-1.0, Some(EdgeClass::Ridge)),
            (2.0, Some(EdgeClass::Silhouette)),
            (-2.0, Some(EdgeClass::Silhouette)),
        ] {
            let segments = Subject::new(junction(angle)).segments(DMat4::IDENTITY, &view, &everything());
            for other in [EdgeClass::Silhouette, EdgeClass::Ridge, EdgeClass::Valley] {
                let expected = if Some(other) == class { 3 } else { 0 };
                assert_eq!(count(&segments, other), expected, "{angle} {other:?}");
            }
            assert_eq!(count(&segments, EdgeClass::Border), 5);
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let torus = Subject::new(primitives::torus(1.0, 0.3, 200, 200));
    let view = look_from(EYE, LENSES[0]);
    let found = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| torus.segments(DMat4::IDENTITY, &view, &everything()))
    };
    let (one, three) = (found(1), found(3));
    assert!(one.len() > 400 && one == three);
}

#[test]
fn soft_edges_are_outlines_and_no_creases() {
    let coarse = primitives::torus(1.0, 0.5, 8, 8);
    let faceted = Mesh { normals: Vec::new(), ..coarse.clone() };
    let [smooth, faceted] = [coarse, faceted].map(Subject::new);
    let view = look_from(DVec3::new(0.7, 4.0, 1.1), LENSES[0]);
    let counts = [&smooth, &faceted].map(|subject| {
        let segments = subject.segments(DMat4::IDENTITY, &view, &everything());
        [EdgeClass::Silhouette, EdgeClass::Ridge].map(|class| count(&segments, class))
    });
    assert!(counts[0][0] >= 16 && counts[0][0] == counts[1][0], "{counts:?}");
    assert!(counts[0][1] == 0 && counts[1][1] > 0, "{counts:?}");
}
