//! The camera as the passes need it: matrices, clip planes and the part of the picture that is wanted.

use encase::ShaderType;
use glam::{DMat4, DVec2, DVec3, DVec4, Mat4, UVec2, UVec4, Vec2};

use crate::geometry::{Bounds, Lens, Plane, Projector};
use crate::scene::additions::{Facing, LetterSize};
use crate::scene::{Camera, Projection};

/// Height of the picture in reference pixels, in which widths and scales are given.
pub const REFERENCE_HEIGHT: f64 = 1080.0;

/// What lies this close before a mirror belongs to the mirror; share of the diagonal of everything visible.
const CLIP_MARGIN: f64 = 1e-5;

/// The camera as the passes need it, and what of it the G-buffer depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World to view space, in double precision: matrices are combined before they are narrowed.
    pub view_from_world: DMat4,
    /// View to clip space; depth is reversed, 1 at the near plane, 0 far away.
    pub clip_from_view: Mat4,
    /// Picture in pixels.
    pub size: UVec2,
    /// Half the picture at depth 1 (perspective) or anywhere (orthographic), scene units.
    pub half_extent: Vec2,
    /// Whether the projection is parallel.
    pub orthographic: bool,
    /// How view space is projected.
    pub projection: Projection,
    /// Depths of the nearest and farthest plane, scene units.
    pub clip_range: [f64; 2],
    /// Whether the nearest plane cuts something.
    pub near_plane_clips: bool,
    /// The middle of everything visible, world space.
    pub center: DVec3,
    /// How far the picture is moved, right and down; pixels, −0.5 to 0.5.
    pub jitter: Vec2,
    /// What lies behind this plane, a mirror's, is not drawn: view space, its product with (point, 1) is the distance before it.
    pub clip_plane: Option<DVec4>,
    /// What lies beyond the section plane is not drawn either: the same in world space.
    pub section: Option<DVec4>,
    /// The part of the picture that is wanted: left, top, right and bottom edge in pixels; `None`: all of it.
    pub scissor_rect: Option<[u32; 4]>,
}

/// What a box covers of a picture at most. Twin of `Extent` in `shaders/passes/occlusion_culling.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct Extent {
    /// Left, top, right and bottom edge, px.
    pub rect: UVec4,
    /// Reversed depth of its nearest point, with a margin for what rounding moves.
    pub nearest: f32,
}

impl Extent {
    /// Number of pixels.
    pub fn area(&self) -> f32 {
        let [left, top, right, bottom] = self.rect.to_array();
        (right.saturating_sub(left) as f32) * (bottom.saturating_sub(top) as f32)
    }
}

/// Share of a depth that rounding may move it.
const DEPTH_MARGIN: f64 = 1e-5;

/// Nearest and farthest depth of a box in view space; `None` when it is empty or wholly behind the eye.
fn depth_range(bounds: &Bounds, view_from_world: &DMat4) -> Option<(f64, f64)> {
    let local = bounds.transformed(view_from_world);
    (!local.is_empty() && local.min.z.is_finite() && local.max.z.is_finite())
        .then(|| (-local.max.z, -local.min.z))
}

impl View {
    /// The part of the picture that a box covers at most, with a margin: left, top, right and bottom edge in pixels. `None`
    /// if it is empty. `corners`: world space, in the order of [`Bounds::corners`].
    pub fn rect_of(&self, corners: &[DVec3; 8], margin: f32) -> Option<[u32; 4]> {
        let [near, _] = self.clip_range;
        let in_view = corners.map(|corner| self.view_from_world.transform_point3(corner));
        let edges =
            in_view.iter().enumerate().flat_map(|(i, from)| [1, 2, 4].map(|bit| (*from, in_view[i ^ bit])));
        let points = edges.filter_map(|(from, to)| {
            // Of each edge that begins before the near plane, its beginning, or where it ends there.
            let (lead, other) = (-from.z - near, -to.z - near);
            let ends = !self.orthographic && other < 0.0;
            let cut = if ends { from.lerp(to, lead / (lead - other)) } else { from };
            (self.orthographic || lead >= 0.0).then_some([from, cut])
        });
        let rect = self.rect_around(points.flatten(), f64::from(margin));
        (rect.x < rect.z && rect.y < rect.w).then(|| rect.to_array())
    }

    /// What a box covers of the picture at most; `None`: it reaches before the near plane, and so anywhere. `corners`: view space.
    pub fn extent_of(&self, corners: &[DVec3; 8]) -> Option<Extent> {
        let [near, far] = self.clip_range;
        let nearest = corners.iter().map(|corner| -corner.z).fold(f64::INFINITY, f64::min);
        if nearest < near || !nearest.is_finite() {
            return None;
        }
        let depth = if self.orthographic {
            (far - nearest) / (far - near) + DEPTH_MARGIN
        } else {
            near / nearest * (1.0 + DEPTH_MARGIN)
        };
        Some(Extent { rect: self.rect_around(corners.iter().copied(), 0.0), nearest: depth as f32 })
    }

    /// Left, top, right and bottom edge, px, of what these points and a margin, px, cover of the picture: each pixel that one
    /// touches, and one more for the jitter. `points`: view space.
    fn rect_around(&self, points: impl Iterator<Item = DVec3>, margin: f64) -> UVec4 {
        let projector = self.projector();
        let (low, high) = points
            .map(|point| projector.pixel(point))
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), px| (low.min(px), high.max(px)));
        let edge = |at: DVec2| at.clamp(DVec2::ZERO, self.size.as_dvec2()).as_uvec2();
        let (low, high) = (edge((low - margin - 2.0).floor()), edge((high + margin + 2.0).ceil()));
        UVec4::new(low.x, low.y, high.x, high.y)
    }

    /// The view of `camera` on a scene of which `visible` is the box around everything that is drawn.
    pub fn new(camera: &Camera, visible: &Bounds, size: UVec2) -> Self {
        Self::through(camera.view_from_world(), camera.projection, visible, size)
    }

    fn through(view_from_world: DMat4, projection: Projection, visible: &Bounds, size: UVec2) -> Self {
        let aspect = f64::from(size.x.max(1)) / f64::from(size.y.max(1));
        let (near, far) = depth_range(visible, &view_from_world).unwrap_or((0.1, 1.0));
        let (half_height, clip_from_view, orthographic, clip_range) = match projection {
            Projection::Perspective { view_angle } => {
                let half = (view_angle.clamp(1.0, 170.0).to_radians() * 0.5).tan();
                // Slightly before the nearest point, but never so close that depth loses its digits.
                let near = (near * 0.999).max(far.abs().max(1e-30) * 1e-5);
                let (x, y) = (1.0 / (half * aspect), 1.0 / half);
                let matrix = DMat4::from_cols_array(&[
                    x, 0.0, 0.0, 0.0, //
                    0.0, y, 0.0, 0.0, //
                    0.0, 0.0, 0.0, -1.0, //
                    0.0, 0.0, near, 0.0,
                ]);
                (half, matrix, false, [near, f64::INFINITY])
            }
            Projection::Orthographic { view_height } => {
                let half = (view_height * 0.5).max(f64::MIN_POSITIVE);
                let margin = (far - near).max(half) * 1e-3;
                let (near, far) = (near - margin, far + margin);
                let (x, y, z) = (1.0 / (half * aspect), 1.0 / half, 1.0 / (far - near));
                let matrix = DMat4::from_cols_array(&[
                    x,
                    0.0,
                    0.0,
                    0.0, //
                    0.0,
                    y,
                    0.0,
                    0.0, //
                    0.0,
                    0.0,
                    z,
                    0.0, //
                    0.0,
                    0.0,
                    far * z,
                    1.0,
                ]);
                (half, matrix, true, [near, far])
            }
        };
        Self {
            view_from_world,
            clip_from_view: clip_from_view.as_mat4(),
            size,
            half_extent: Vec2::new((half_height * aspect) as f32, half_height as f32),
            orthographic,
            projection,
            clip_range,
            near_plane_clips: !orthographic && near < clip_range[0],
            center: if visible.is_empty() { DVec3::ZERO } else { visible.center() },
            jitter: Vec2::ZERO,
            clip_plane: None,
            section: None,
            scissor_rect: None,
        }
    }

    /// What this view shows in a mirror: the view of the eye's mirror image, flipped left to right so that nothing is
    /// inside out. A pixel of the mirror shows the pixel of this view that lies as far from the opposite side of the
    /// picture. What lies behind the mirror or on it is left out; `rect` as in [`View::scissor_rect`], for this view.
    #[must_use]
    pub fn mirrored(&self, plane: &Plane, visible: &Bounds, rect: [u32; 4]) -> Self {
        let flipped = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let view_from_world = flipped * self.view_from_world * plane.reflection();
        let [left, top, right, bottom] = rect;
        let margin = visible.diagonal() * CLIP_MARGIN;
        let plane = plane.equation() - DVec4::W * margin;
        Self {
            clip_plane: Some(view_from_world.inverse().transpose() * plane),
            scissor_rect: Some([self.size.x - right, top, self.size.x - left, bottom]),
            center: self.center,
            section: self.section,
            ..Self::through(view_from_world, self.projection, visible, self.size)
        }
        .moved(self.jitter * Vec2::new(-1.0, 1.0))
    }

    /// The same with everything beyond a section plane cut away: world space, its product with (point, 1) is the distance before it.
    #[must_use]
    pub fn with_section(self, section: Option<DVec4>) -> Self {
        Self { section, ..self }
    }

    /// The planes of a mirror, behind which nothing is drawn, and of the section, beyond which nothing is: view space, 0: none.
    pub fn clip_planes(&self) -> [DVec4; 2] {
        let section = self.section.map(|plane| self.view_from_world.inverse().transpose() * plane);
        [self.clip_plane, section].map(Option::unwrap_or_default)
    }

    /// Whether anything is clipped.
    pub fn is_clipped(&self) -> bool {
        self.clip_plane.is_some() || self.section.is_some()
    }

    /// Where something lies that faces the eye: local to world space. It is seen where its anchor is, nothing of size where
    /// that is behind the eye.
    pub fn facing(&self, facing: &Facing) -> DMat4 {
        let [near, far] = self.clip_range;
        let half = f64::from(self.half_extent.y);
        let anchor = self.view_from_world.transform_point3(facing.anchor);
        let depth = -anchor.z;
        // Just behind the nearest plane, before all that is seen.
        let front = if self.orthographic { near + (far - near) * 2e-4 } else { near * 1.000_5 };
        let units = |depth: f64| match facing.size {
            LetterSize::Units(units) => units,
            LetterSize::ReferencePixels(px) => {
                px * 2.0 * half / REFERENCE_HEIGHT * if self.orthographic { 1.0 } else { depth }
            }
        };
        // Nearer by its own size, so that it does not sink into what it stands on.
        let wanted = if facing.in_front { front } else { (depth - 2.0 * units(depth)).max(front) }.min(depth);
        let (share, size) = match (self.orthographic, depth > 0.0) {
            (true, _) => (1.0, units(depth)),
            (false, true) => (wanted / depth, units(depth) * wanted / depth),
            (false, false) => (1.0, 0.0),
        };
        let place = DVec3::new(anchor.x * share, anchor.y * share, -wanted);
        self.view_from_world.inverse()
            * DMat4::from_translation(place)
            * DMat4::from_scale(DVec3::splat(size))
    }

    /// Whether the clip planes leave nothing of what lies between these points, in view space.
    pub fn clips_away(&self, corners: &[DVec3]) -> bool {
        self.clip_planes().iter().any(|plane| corners.iter().all(|c| plane.dot(c.extend(1.0)) < 0.0))
    }

    /// The same with the picture moved by so many pixels, right and down; less than one in each direction.
    #[must_use]
    pub fn moved(self, jitter: Vec2) -> Self {
        let ndc = (jitter - self.jitter) / self.size.as_vec2() * Vec2::new(2.0, -2.0);
        let clip_from_view = Mat4::from_translation(ndc.extend(0.0)) * self.clip_from_view;
        Self { clip_from_view, jitter, ..self }
    }

    /// Linear depth of the nearest and farthest corner of the given boxes (local space, and local to world), in front
    /// of the eye and never of width 0. For the enhanced objects' boxes, that is the range to which the paper fits
    /// near and far (section 4.1.1).
    pub fn fitted_depth_range(&self, boxes: impl IntoIterator<Item = (Bounds, DMat4)>) -> Vec2 {
        let all = boxes
            .into_iter()
            .filter_map(|(bounds, world_from_local)| {
                depth_range(&bounds, &(self.view_from_world * world_from_local))
            })
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let (near, far) = all.unwrap_or((0.0, 1.0));
        let near = if self.orthographic { near } else { near.max(0.0) };
        // Something flat that faces the eye has no depth: keep the rounding of its depth from becoming edges.
        let far = far.max(near + near.abs().max(1e-30) * 1e-3);
        Vec2::new(near as f32, far as f32)
    }

    /// The same in plain numbers, for what is projected without the device.
    pub fn projector(&self) -> Projector {
        let half = f64::from(self.half_extent.y);
        let [near, far] = self.clip_range;
        Projector {
            view_from_world: self.view_from_world,
            lens: if self.orthographic {
                Lens::Orthographic { half_height: half }
            } else {
                Lens::Perspective { tan_half_angle: half }
            },
            size: self.size.to_array(),
            near,
            far,
        }
    }

    /// Points whose hull holds all that the picture shows between two depths, world space.
    pub fn corners(&self, depths: Vec2) -> [DVec3; 8] {
        let size = self.size.as_vec2();
        // A pixel more, for the jitter.
        let px =
            [Vec2::splat(-1.0), Vec2::new(size.x + 1.0, -1.0), Vec2::new(-1.0, size.y + 1.0), size + 1.0];
        std::array::from_fn(|i| self.unproject(px[i % 4], depths[i / 4]))
    }

    /// The point in world space that a pixel of this linear depth shows.
    pub fn unproject(&self, px: Vec2, depth: f32) -> DVec3 {
        let ndc = ((px - self.jitter) / self.size.as_vec2() * 2.0 - 1.0) * Vec2::new(1.0, -1.0);
        let xy = ndc * self.half_extent * if self.orthographic { 1.0 } else { depth };
        let pos_view = DVec3::new(f64::from(xy.x), f64::from(xy.y), -f64::from(depth));
        self.view_from_world.inverse().transform_point3(pos_view)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_unprojects_to_the_point_that_projects_there() {
        let bounds = Bounds { min: DVec3::splat(-1.0), max: DVec3::ONE };
        let camera = Camera::looking_from(DVec3::new(1.0, 2.0, 3.0), DVec3::Y, &bounds.corners(), 1.5);
        let cameras = [camera, camera.with_orthographic(true)];
        for (camera, jitter) in cameras.into_iter().zip([Vec2::ZERO, Vec2::new(0.5, -0.25)]) {
            let view = View::new(&camera, &bounds, UVec2::new(600, 400)).moved(jitter);
            let world = DVec3::new(0.3, -0.2, 0.5);
            let pos_view = view.view_from_world.transform_point3(world);
            let clip = view.clip_from_view.as_dmat4() * pos_view.extend(1.0);
            let ndc = clip / clip.w;
            assert!(ndc.z > 0.0 && ndc.z < 1.0, "{ndc}");
            let px = (ndc.truncate().truncate() * glam::DVec2::new(0.5, -0.5) + 0.5)
                * glam::DVec2::new(600.0, 400.0);
            let back = view.unproject(px.as_vec2(), -pos_view.z as f32);
            assert!((back - world).length() < 1e-4, "{back}");
        }
    }

    #[test]
    fn no_point_of_a_box_lies_beyond_its_extent() {
        let all = Bounds { min: DVec3::splat(-1.0), max: DVec3::ONE };
        let camera = Camera::looking_from(DVec3::new(1.0, 2.0, 3.0), DVec3::Y, &all.corners(), 1.5);
        let own = Bounds { min: DVec3::new(-0.2, 0.1, -0.6), max: DVec3::new(0.3, 0.5, -0.1) };
        for camera in [camera, camera.with_orthographic(true)] {
            let view = View::new(&camera, &all, UVec2::new(600, 400)).moved(Vec2::new(0.5, -0.5));
            let in_view = |point: DVec3| view.view_from_world.transform_point3(point);
            let extent = view.extent_of(&own.corners().map(in_view)).unwrap();
            let [left, top, right, bottom] = extent.rect.to_array().map(f64::from);
            for i in 0..1000 {
                let at = DVec3::new(f64::from(i % 10), f64::from(i / 10 % 10), f64::from(i / 100)) / 9.0;
                let clip =
                    view.clip_from_view.as_dmat4() * in_view(own.min + at * (own.max - own.min)).extend(1.0);
                let ndc = clip.truncate() / clip.w;
                let px = (ndc.truncate() * DVec2::new(0.5, -0.5) + 0.5) * DVec2::new(600.0, 400.0);
                assert!(ndc.z <= f64::from(extent.nearest), "{ndc}");
                assert!(left < px.x && px.x < right && top < px.y && px.y < bottom, "{px}");
            }
            assert!((right - left) * (bottom - top) < 0.1 * 600.0 * 400.0, "{extent:?}");
            // Beside or around the eye anything may be covered.
            let around = Bounds { min: DVec3::splat(-9.0), max: DVec3::splat(9.0) };
            assert_eq!(view.extent_of(&around.corners().map(in_view)), None);
        }
    }

    #[test]
    fn nearer_points_have_greater_clip_depth() {
        let bounds = Bounds { min: DVec3::splat(-1.0), max: DVec3::ONE };
        let camera = Camera::looking_from(DVec3::Z, DVec3::Y, &bounds.corners(), 1.0);
        for camera in [camera, camera.with_orthographic(true)] {
            let view = View::new(&camera, &bounds, UVec2::splat(100));
            let depth = |z: f64| {
                let clip = view.clip_from_view.as_dmat4()
                    * view.view_from_world.transform_point3(DVec3::new(0.0, 0.0, z)).extend(1.0);
                clip.z / clip.w
            };
            assert!(depth(1.0) <= 1.0 && depth(1.0) > depth(0.0) && depth(0.0) > depth(-1.0));
        }
    }
}
