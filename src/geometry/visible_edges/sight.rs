//! What an eye sees of a point on an edge, by rays.

use glam::{DMat4, DVec2, DVec3};

use super::world_edge::{Line, WorldEdge};
use super::{EdgeScene, LineRules, SurfacePoint};
use crate::geometry::bvh::Hit;
use crate::geometry::{EdgeClass, Lens, Projector};

/// How much nearer than a sample a surface must be to hide it: this part of the distance, or in parallel projection of
/// the picture's height.
const DEPTH_SLACK: f64 = 1e-4;
/// How far beside a silhouette, in pixels, is looked at too: on one side its own surface bends away in front of it.
const BESIDE: f64 = 0.5;
/// How far outwards of a silhouette or border, in pixels, another object is looked for.
const NEXT_TO: f64 = 1.0;

/// What hid the last sample of an edge: itself, its outer and its inner side.
pub(super) type Hiders = [Option<usize>; 3];

/// A scene before an eye.
pub(super) struct Sight<'a> {
    pub projector: &'a Projector,
    pub rules: &'a LineRules<'a>,
    scene: &'a EdgeScene,
    world_from_view: DMat4,
}

impl<'a> Sight<'a> {
    pub(super) fn new(scene: &'a EdgeScene, projector: &'a Projector, rules: &'a LineRules<'a>) -> Self {
        Self { projector, rules, scene, world_from_view: projector.view_from_world.inverse() }
    }

    /// From a point to the eye, in world space; of any length.
    pub(super) fn to_eye(&self, world: DVec3) -> DVec3 {
        let view = self.projector.view_from_world.transform_point3(world);
        -self.world_from_view.transform_vector3(self.projector.view_direction(view))
    }

    /// The unit vector in the picture that leads off the surface, for an edge with all surfaces on one side, which
    /// appears between `pixels` and begins at `start` in view space.
    pub(super) fn outwards(&self, line: &Line, pixels: [DVec2; 2], start: DVec3) -> Option<DVec2> {
        let off = self.projector.view_from_world.transform_vector3(line.off_surface?);
        let across = (pixels[1] - pixels[0]).perp().normalize_or_zero();
        let aside = self.projector.unproject(pixels[0] + across, -start.z) - start;
        Some(if aside.dot(off) < 0.0 { -across } else { across })
    }

    /// What a sample of an edge is; `None` if it is hidden. `position` is in pixels, `point` in view space.
    pub(super) fn class_at(
        &self,
        edge: &WorldEdge,
        line: &Line,
        position: DVec2,
        point: DVec3,
        outwards: Option<DVec2>,
        hiders: &mut Hiders,
    ) -> Option<EdgeClass> {
        let beside = |side: DVec2| self.projector.unproject(position + side * BESIDE, -point.z);
        let [here, outside, inside] = hiders;
        let seen = self.is_there(edge, point)
            && (self.sees(point, &edge.faces, here)
                || edge.is_fold()
                    && outwards.is_some_and(|out| {
                        self.sees(beside(out), &edge.faces, outside)
                            || self.sees(beside(-out), &edge.faces, inside)
                    }));
        if !seen {
            return None;
        }
        let meets_another = || {
            let there = self.object_at(position + outwards? * NEXT_TO);
            Some(there? != edge.object)
        };
        if self.rules.classes.contains(&EdgeClass::Object) && meets_another() == Some(true) {
            return Some(EdgeClass::Object);
        }
        line.class
    }

    /// Whether at least one of the surfaces at an edge has no hole at a point in view space.
    fn is_there(&self, edge: &WorldEdge, point: DVec3) -> bool {
        let Some(is_hole) = self.rules.is_hole else { return true };
        let world = self.world_from_view.transform_point3(point);
        edge.faces.iter().any(|&face| {
            let (mesh, first) = self.scene.mesh_of(face as usize);
            let Some(&[a, b, c]) = self.scene.triangles.get(face as usize) else { return false };
            let normal = (b - a).cross(c - a);
            let area = normal.length_squared();
            let v = (world - a).cross(c - a).dot(normal) / area;
            let w = (b - a).cross(world - a).dot(normal) / area;
            let weights = DVec3::new(1.0 - v - w, v, w).clamp(DVec3::ZERO, DVec3::ONE);
            !is_hole(SurfacePoint { mesh, triangle: face as usize - first, weights })
        })
    }

    /// Whether nothing but `own` triangles hides a point in view space. What hid the last point, `hider`, is tried
    /// first; it often hides this one too.
    fn sees(&self, point: DVec3, own: &[u32], hider: &mut Option<usize>) -> bool {
        let depth = -point.z;
        let slack = match self.projector.lens {
            Lens::Perspective { .. } => depth * DEPTH_SLACK,
            Lens::Orthographic { half_height } => DEPTH_SLACK * 2.0 * half_height,
        };
        let Ray { origin, direction, near, per_depth } = self.ray(point);
        let far = per_depth * (depth - slack);
        let again = hider
            .and_then(|triangle| Hit::of(origin, direction, triangle, self.scene.triangles.get(triangle)?));
        if again.is_some_and(|hit| hit.t > near && hit.t < far && !self.is_hole(&hit)) {
            return false;
        }
        let skip = |hit: &Hit| own.contains(&(hit.triangle as u32)) || self.is_hole(hit);
        *hider = self.scene.tree.any_hit(origin, direction, near, far, skip).map(|hit| hit.triangle);
        hider.is_none()
    }

    /// The object that is seen at a position in pixels.
    fn object_at(&self, position: DVec2) -> Option<u32> {
        let ray = self.ray(self.projector.unproject(position, self.projector.far));
        let far = ray.per_depth * self.projector.far;
        let skip = |hit: &Hit| self.is_hole(hit);
        let hit = self.scene.tree.closest_hit(ray.origin, ray.direction, ray.near, far, skip)?;
        Some(self.scene.meshes.get(self.scene.mesh_of(hit.triangle).0)?.1)
    }

    /// How many holes are seen through at a position in pixels.
    pub(super) fn holes_at(&self, position: DVec2) -> u32 {
        let ray = self.ray(self.projector.unproject(position, self.projector.far));
        let (mut from, to) = (ray.near, ray.per_depth * self.projector.far);
        let mut holes = 0;
        while let Some(hit) = self.scene.tree.closest_hit(ray.origin, ray.direction, from, to, |_| false) {
            if !self.is_hole(&hit) {
                break;
            }
            holes += 1;
            from = hit.t;
        }
        holes
    }

    fn is_hole(&self, hit: &Hit) -> bool {
        self.rules.is_hole.is_some_and(|is_hole| {
            let (mesh, first) = self.scene.mesh_of(hit.triangle);
            let [v, w] = hit.weights;
            is_hole(SurfacePoint {
                mesh,
                triangle: hit.triangle - first,
                weights: DVec3::new(1.0 - v - w, v, w),
            })
        })
    }

    /// The ray through a point in view space. It starts where the depth is 0.
    fn ray(&self, point: DVec3) -> Ray {
        let (origin, per_depth) = match self.projector.lens {
            Lens::Perspective { .. } => (DVec3::ZERO, -point.z.recip()),
            Lens::Orthographic { .. } => (point.with_z(0.0), 1.0),
        };
        Ray {
            origin: self.world_from_view.transform_point3(origin),
            direction: self.world_from_view.transform_vector3(self.projector.view_direction(point)),
            near: per_depth * self.projector.near,
            per_depth,
        }
    }
}

/// A ray in world space.
struct Ray {
    origin: DVec3,
    direction: DVec3,
    /// Its parameter at the near plane.
    near: f64,
    /// Its parameter per unit of depth.
    per_depth: f64,
}
