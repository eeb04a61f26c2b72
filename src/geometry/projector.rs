//! From world space to pixels, as plain numbers: what measuring a picture needs to know of its camera.

use glam::{DMat4, DVec2, DVec3};

/// How a camera maps world space to a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projector {
    /// World space to view space, rigid: the eye at the origin, looking along −Z, +Y up.
    pub view_from_world: DMat4,
    /// How view space is projected.
    pub lens: Lens,
    /// Width and height of the picture in pixels, at least 1.
    pub size: [u32; 2],
    /// Distance of the near plane along the view, in world units; greater than 0 in perspective.
    pub near: f64,
    /// Distance of the far plane along the view, in world units.
    pub far: f64,
}

/// Central or parallel projection; pixels are square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lens {
    /// Central projection.
    Perspective {
        /// Tangent of half the vertical view angle.
        tan_half_angle: f64,
    },
    /// Parallel projection.
    Orthographic {
        /// Half the height of the picture in world units.
        half_height: f64,
    },
}

impl Projector {
    /// Half the width and height of what is seen at this depth, in world units.
    fn half_extents(&self, depth: f64) -> DVec2 {
        let height = match self.lens {
            Lens::Perspective { tan_half_angle } => tan_half_angle * depth,
            Lens::Orthographic { half_height } => half_height,
        };
        DVec2::new(height * f64::from(self.size[0]) / f64::from(self.size[1].max(1)), height)
    }

    /// The pixel position of a point in view space: (0, 0) is the upper left corner of the picture, y runs down. In
    /// perspective the point must lie in front of the eye.
    pub fn pixel(&self, view: DVec3) -> DVec2 {
        let unit = view.truncate() / self.half_extents(-view.z);
        let [width, height] = self.size.map(f64::from);
        DVec2::new((1.0 + unit.x) * 0.5 * width, (1.0 - unit.y) * 0.5 * height)
    }

    /// The point in view space at this pixel position and depth (distance along the view, world units).
    pub fn unproject(&self, pixel: DVec2, depth: f64) -> DVec3 {
        let [width, height] = self.size.map(|s| f64::from(s.max(1)));
        let unit = DVec2::new(2.0 * pixel.x / width - 1.0, 1.0 - 2.0 * pixel.y / height);
        (unit * self.half_extents(depth)).extend(-depth)
    }

    /// From the eye to a point, both in view space: not a unit vector in perspective.
    pub fn view_direction(&self, view: DVec3) -> DVec3 {
        match self.lens {
            Lens::Perspective { .. } => view,
            Lens::Orthographic { .. } => DVec3::NEG_Z,
        }
    }

    /// The part of a segment in view space that lies in the view volume, if any.
    pub fn clip(&self, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let inside = |p: DVec3| {
            let half = self.half_extents(-p.z);
            [-p.z - self.near, self.far + p.z, half.x - p.x, half.x + p.x, half.y - p.y, half.y + p.y]
        };
        // Each of these is linear along the segment.
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (at_a, at_b) in inside(a).into_iter().zip(inside(b)) {
            match (at_a < 0.0, at_b < 0.0) {
                (true, true) => return None,
                (true, false) => from = from.max(at_a / (at_a - at_b)),
                (false, true) => to = to.min(at_a / (at_a - at_b)),
                (false, false) => {}
            }
        }
        (from < to).then(|| [a.lerp(b, from), a.lerp(b, to)])
    }

    /// How far along a segment in view space (0 to 1) the point is that appears at the part `along` of its picture.
    pub fn along_segment(&self, [a, b]: [DVec3; 2], along: f64) -> f64 {
        match self.lens {
            Lens::Perspective { .. } => along * a.z / (b.z + along * (a.z - b.z)),
            Lens::Orthographic { .. } => along,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn projector(lens: Lens) -> Projector {
        Projector { view_from_world: DMat4::IDENTITY, lens, size: [200, 100], near: 0.1, far: 100.0 }
    }

    const LENSES: [Lens; 2] =
        [Lens::Perspective { tan_half_angle: 0.5 }, Lens::Orthographic { half_height: 2.0 }];

    #[test]
    fn pixels_and_points_agree() {
        for lens in LENSES {
            let p = projector(lens);
            assert_eq!(p.pixel(DVec3::new(0.0, 0.0, -3.0)), DVec2::new(100.0, 50.0));
            for pixel in [DVec2::new(0.0, 0.0), DVec2::new(150.0, 12.5)] {
                assert!((p.pixel(p.unproject(pixel, 4.0)) - pixel).length() < 1e-9);
            }
        }
        let up = projector(LENSES[0]).pixel(DVec3::new(0.0, 1.5, -3.0));
        assert_eq!(up, DVec2::new(100.0, 0.0));
    }

    #[test]
    fn segments_are_cut_at_the_sides_and_the_near_plane() {
        for lens in LENSES {
            let p = projector(lens);
            let a = DVec3::new(0.1, 0.2, -3.0);
            let clipped = p.clip([a, DVec3::new(90.0, 10.0, -3.0)]).unwrap();
            assert!(clipped[0] == a && (p.pixel(clipped[1]).x - 200.0).abs() < 1e-9);
            let clipped = p.clip([DVec3::new(0.0, 0.0, 5.0), DVec3::new(0.0, 0.0, -3.0)]).unwrap();
            assert!((clipped[0].z + 0.1).abs() < 1e-12);
            assert_eq!(p.clip([DVec3::new(0.0, 0.0, 5.0), DVec3::new(1.0, 0.0, 6.0)]), None);
        }
    }

    #[test]
    fn halves_of_a_picture_of_a_segment_are_found_on_it() {
        for lens in LENSES {
            let p = projector(lens);
            let ends = [DVec3::new(-1.0, 0.0, -2.0), DVec3::new(3.0, 1.0, -9.0)];
            let there = ends[0].lerp(ends[1], p.along_segment(ends, 0.3));
            let expected = p.pixel(ends[0]).lerp(p.pixel(ends[1]), 0.3);
            assert!((p.pixel(there) - expected).length() < 1e-9);
        }
    }
}
