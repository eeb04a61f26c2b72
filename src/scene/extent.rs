//! How far things reach: what a camera has to frame.

use std::sync::Arc;

use glam::{DMat4, DVec3, Vec3};
use rayon::prelude::*;

use crate::geometry::{Bounds, Mesh};

/// Vertices that one thread takes at a time.
const CHUNK: usize = 1 << 14;

/// What a camera can frame.
pub trait Framed {
    /// Points near its hull.
    fn points(&self) -> &[DVec3];

    /// The points that reach farthest along some directions, where [`Self::points`] may miss them.
    fn farthest(&self, directions: &[DVec3]) -> Vec<DVec3>;
}

impl<T: AsRef<[DVec3]> + ?Sized> Framed for T {
    fn points(&self) -> &[DVec3] {
        self.as_ref()
    }

    fn farthest(&self, _: &[DVec3]) -> Vec<DVec3> {
        Vec::new()
    }
}

/// A mesh that was measured once, for all its places in a scene.
#[derive(Debug)]
pub struct MeasuredMesh {
    mesh: Arc<Mesh>,
    extremes: Vec<Vec3>,
    bounds: Bounds,
}

impl MeasuredMesh {
    /// Measures a mesh.
    pub fn new(mesh: &Arc<Mesh>) -> Arc<Self> {
        Arc::new(Self { mesh: Arc::clone(mesh), extremes: mesh.extremes(), bounds: mesh.bounds() })
    }

    /// The box around it, local space.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }
}

/// How far some objects reach, in world space.
#[derive(Debug, Clone, Default)]
pub struct Extent {
    points: Vec<DVec3>,
    meshes: Vec<(Arc<MeasuredMesh>, DMat4)>,
}

impl Extent {
    /// That of a mesh.
    pub fn of_mesh(mesh: &Arc<MeasuredMesh>, world_from_local: DMat4) -> Self {
        let points = mesh.extremes.iter().map(|p| world_from_local.transform_point3(p.as_dvec3())).collect();
        Self { points, meshes: vec![(Arc::clone(mesh), world_from_local)] }
    }

    /// That of one point.
    pub fn of_point(point: DVec3) -> Self {
        Self { points: vec![point], meshes: Vec::new() }
    }

    /// That of all of these.
    pub fn of_all<'a>(extents: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut all = Self::default();
        for extent in extents {
            all.points.extend_from_slice(&extent.points);
            all.meshes.extend_from_slice(&extent.meshes);
        }
        all
    }

    /// Whether there is nothing to be framed.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}

impl Framed for Extent {
    fn points(&self) -> &[DVec3] {
        &self.points
    }

    fn farthest(&self, directions: &[DVec3]) -> Vec<DVec3> {
        let mut found = Farthest::of(directions, self.points.iter().copied());
        for (measured, world_from_local) in &self.meshes {
            // Of thousands of objects few are at the rim.
            if found.is_beyond(&measured.bounds.transformed(world_from_local)) {
                let chunks = measured.mesh.positions.par_chunks(CHUNK);
                let place = |p: &Vec3| world_from_local.transform_point3(p.as_dvec3());
                let own = chunks
                    .map(|chunk| Farthest::of(directions, chunk.iter().map(place)))
                    .reduce(|| Farthest::of(directions, []), Farthest::or);
                found = found.or(own);
            }
        }
        found.0.into_iter().map(|farthest| farthest.point).filter(|p| p.is_finite()).collect()
    }
}

/// For each direction the point that lies farthest along it.
struct Farthest(Vec<FarthestPoint>);

/// The point that lies farthest along a direction, and how far.
struct FarthestPoint {
    direction: DVec3,
    distance: f64,
    point: DVec3,
}

impl Farthest {
    fn of(directions: &[DVec3], points: impl IntoIterator<Item = DVec3>) -> Self {
        let none = |&direction| FarthestPoint { direction, distance: f64::NEG_INFINITY, point: DVec3::NAN };
        let mut found: Vec<_> = directions.iter().map(none).collect();
        for point in points {
            for farthest in &mut found {
                let distance = point.dot(farthest.direction);
                // Never true of what is not a number.
                if distance > farthest.distance && distance < f64::INFINITY {
                    (farthest.distance, farthest.point) = (distance, point);
                }
            }
        }
        Self(found)
    }

    fn or(self, other: Self) -> Self {
        let pairs = self.0.into_iter().zip(other.0);
        Self(pairs.map(|(a, b)| if b.distance > a.distance { b } else { a }).collect())
    }

    /// Whether a box reaches beyond any of the points.
    fn is_beyond(&self, bounds: &Bounds) -> bool {
        let corners = bounds.corners();
        self.0.iter().any(|f| corners.iter().any(|c| c.dot(f.direction) > f.distance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives;
    use crate::scene::{Camera, Standard, Up};

    /// A ball of more than 100,000 vertices, one of which stands out far.
    fn spiked(spike: usize, to: Vec3) -> Arc<Mesh> {
        let mut mesh = primitives::sphere(1.0, 460, 230);
        assert!(mesh.positions.len() > 100_000);
        let spike = spike % mesh.positions.len();
        mesh.positions[spike] = to;
        Arc::new(mesh)
    }

    /// The greatest share of half the picture that any vertex needs on either side.
    fn reach(camera: &Camera, mesh: &Mesh, world_from_local: &DMat4, aspect: f64) -> f64 {
        let view = camera.view_from_world() * *world_from_local;
        let tan = (camera.view_angle().to_radians() * 0.5).tan();
        let half = |z: f64| match camera.projection {
            crate::scene::Projection::Perspective { .. } => -z * tan,
            crate::scene::Projection::Orthographic { view_height } => 0.5 * view_height,
        };
        let shares = mesh.positions.iter().map(|p| {
            let p = view.transform_point3(p.as_dvec3());
            assert!(p.z < 0.0, "{p} lies behind the eye");
            (p.x.abs() / aspect).max(p.y.abs()) / half(p.z)
        });
        shares.fold(0.0, f64::max)
    }

    #[test]
    fn one_vertex_of_many_that_stands_out_is_in_the_picture() {
        let placed = DMat4::from_rotation_x(0.4) * DMat4::from_translation(DVec3::new(3.0, -1.0, 2.0));
        for (i, to) in [
            Vec3::new(9.0, 0.0, 0.0),
            Vec3::new(-4.0, 7.0, 1.0),
            Vec3::new(0.3, -20.0, 0.2),
            Vec3::new(2.0, 1.0, 30.0),
        ]
        .into_iter()
        .enumerate()
        {
            let mesh = spiked(7 + 13_131 * i, to);
            let extent = Extent::of_mesh(&MeasuredMesh::new(&mesh), placed);
            for aspect in [0.4, 1.0, 2.5] {
                for standard in [Standard::Home, Standard::Front, Standard::Top, Standard::Left] {
                    let seen = standard.camera(Up::PosY, &extent, aspect, None);
                    let parallel = seen.with_orthographic(true).framing(&extent, aspect);
                    for camera in [seen, parallel] {
                        let reach = reach(&camera, &mesh, &placed, aspect);
                        assert!((0.8..=1.0).contains(&reach), "spike {to} at {aspect}: {reach}");
                    }
                }
            }
        }
    }

    #[test]
    fn only_meshes_at_the_rim_count() {
        let cube = MeasuredMesh::new(&Arc::new(primitives::cube(1.0)));
        let at = |x: f64| Extent::of_mesh(&cube, DMat4::from_translation(DVec3::X * x));
        let all = Extent::of_all(&[at(0.0), at(5.0), at(2.0)]);
        let farthest = all.farthest(&[DVec3::X, DVec3::NEG_X]);
        assert_eq!([farthest[0].x, farthest[1].x], [5.5, -0.5]);
        assert!(Extent::default().farthest(&[DVec3::X]).is_empty());
    }
}
