//! What a light sees: projections from a light, fitted to the visible scene.

use glam::{DMat3, DMat4, DVec2, DVec3};

use crate::geometry::Bounds;
use crate::scene::LightKind;

/// Empty texels around what a light sees, so that filters find something beyond its border.
const MARGIN: f64 = 3.0;
/// A light that sees the scene at a wider angle than this tangent looks to all six sides.
const WIDEST: f64 = 1.5;
/// A picture that shows less of the scene than this many halvings leave shows nothing of it.
const MAX_HALVINGS: f64 = 16.0;
/// The nearest that something may be to a light, as a share of the scene's diagonal.
const NEAREST: f64 = 1e-4;

/// One picture that a light sees. Light space: it looks along −Z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightView {
    /// World to light space; distances stay.
    pub light_from_world: DMat4,
    /// Whether rays come from the origin; otherwise they are parallel.
    pub is_central: bool,
    /// Lower and upper corner of what is seen: x and y of light space, for central rays at distance 1.
    pub window: [DVec2; 2],
    /// Distances that are seen; central rays see on to infinity.
    pub range: [f64; 2],
    /// Upper left corner and size of its part of the shadow map, texels.
    pub tile: [[u32; 2]; 2],
}

impl LightView {
    /// Light space to clip space; depth is reversed, 1 at the nearest distance.
    pub fn clip_from_light(&self) -> DMat4 {
        let center = (self.window[0] + self.window[1]) * 0.5;
        let scale = ((self.window[1] - self.window[0]) * 0.5).recip();
        let [near, far] = self.range;
        if self.is_central {
            DMat4::from_cols_array(&[
                scale.x,
                0.0,
                0.0,
                0.0, //
                0.0,
                scale.y,
                0.0,
                0.0, //
                center.x * scale.x,
                center.y * scale.y,
                0.0,
                -1.0, //
                0.0,
                0.0,
                near,
                0.0,
            ])
        } else {
            let depth = (far - near).recip();
            DMat4::from_cols_array(&[
                scale.x,
                0.0,
                0.0,
                0.0, //
                0.0,
                scale.y,
                0.0,
                0.0, //
                0.0,
                0.0,
                depth,
                0.0, //
                -center.x * scale.x,
                -center.y * scale.y,
                far * depth,
                1.0,
            ])
        }
    }

    /// Texels per unit of the window, and the texel of its origin.
    pub fn texels(&self) -> (DVec2, DVec2) {
        let [origin, size] = self.tile.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
        let scale = size / (self.window[1] - self.window[0]) * DVec2::new(1.0, -1.0);
        let upper_left = DVec2::new(self.window[0].x, self.window[1].y);
        (scale, origin - upper_left * scale)
    }
}

/// Where shadows matter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ShadowReceivers {
    /// Points whose hull holds everything that shows shadows, world space; none: anywhere.
    pub points: Vec<DVec3>,
    /// Tangent of the light's radius as seen from there.
    pub spread: f64,
}

/// What a light sees of some boxes (local space, and local to world), in a square map of `side` texels: one picture,
/// or six when it stands among them. Nothing when there are no boxes. Parallel light sees
/// no more than what is looked at.
pub fn light_views(
    light: &LightKind,
    boxes: &[(Bounds, DMat4)],
    looked_at: &ShadowReceivers,
    side: u32,
) -> Vec<LightView> {
    let all = boxes.iter().fold(Bounds::EMPTY, |all, (b, m)| all.union(&b.transformed(m)));
    if all.is_empty() || !all.diagonal().is_finite() {
        return Vec::new();
    }
    let tile = [[0, 0], [side, side]];
    match *light {
        LightKind::Directional { direction } => {
            let light_from_world = looking(all.center(), direction.normalize_or(DVec3::NEG_Z));
            let seen = boxes
                .iter()
                .fold(Bounds::EMPTY, |seen, (b, m)| seen.union(&b.transformed(&(light_from_world * *m))));
            let least = all.diagonal().max(f64::MIN_POSITIVE) * 1e-3;
            let whole = [seen.min.truncate(), seen.max.truncate()];
            let points = looked_at.points.iter().map(|p| light_from_world.transform_point3(*p).truncate());
            // Soft borders have their causes beside them.
            let reach = DVec2::splat(looked_at.spread * (seen.max.z - seen.min.z));
            let hull = points.map(|p| [p - reach, p + reach]);
            let hull = hull.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
            let window = widened(hull.map_or(whole, |hull| narrowed(whole, hull)), least, side);
            let range = [-seen.max.z - least, -seen.min.z + least];
            vec![LightView { light_from_world, is_central: false, window, range, tile }]
        }
        LightKind::Point { position } => {
            let nearest = all.diagonal().max(f64::MIN_POSITIVE) * NEAREST;
            let light_from_world = looking(position, (all.center() - position).normalize_or(DVec3::NEG_Z));
            window_of(boxes, &light_from_world, nearest).map_or_else(
                || six_sides(position, nearest, side),
                |(window, near)| {
                    let window = widened(window, 1e-3, side);
                    vec![LightView {
                        light_from_world,
                        is_central: true,
                        window,
                        range: [near * 0.999, f64::INFINITY],
                        tile,
                    }]
                },
            )
        }
    }
}

/// The window through which boxes are seen from the origin, and the nearest distance; `None` if they reach around it.
fn window_of(boxes: &[(Bounds, DMat4)], light_from_world: &DMat4, nearest: f64) -> Option<([DVec2; 2], f64)> {
    let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let mut near = f64::INFINITY;
    for (bounds, world_from_local) in boxes.iter().filter(|(b, _)| !b.is_empty()) {
        let light_from_local = *light_from_world * *world_from_local;
        for corner in bounds.corners() {
            let p = light_from_local.transform_point3(corner);
            if -p.z < nearest {
                return None;
            }
            let at = p.truncate() / -p.z;
            (min, max, near) = (min.min(at), max.max(at), near.min(-p.z));
        }
    }
    let widest = min.abs().max(max.abs()).max_element();
    (widest < WIDEST).then_some(([min, max], near))
}

/// All directions from a point: three tiles beside each other, in two rows.
fn six_sides(position: DVec3, near: f64, side: u32) -> Vec<LightView> {
    let size = [side / 3, side / 2].map(|s| s.max(8));
    let sides = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let window = widened([DVec2::splat(-1.0), DVec2::ONE], 0.0, size[0]);
    let views = sides.into_iter().zip(0..).map(|(towards, i)| LightView {
        light_from_world: looking(position, towards),
        is_central: true,
        window,
        range: [near, f64::INFINITY],
        tile: [[i % 3 * size[0], i / 3 * size[1]], size],
    });
    views.collect()
}

/// World to the space of a light at `position` that looks along a unit vector.
fn looking(position: DVec3, towards: DVec3) -> DMat4 {
    let up = if towards.y.abs() < 0.9 { DVec3::Y } else { DVec3::X };
    let right = towards.cross(up).normalize_or(DVec3::Z);
    let axes = DMat3::from_cols(right, right.cross(towards), -towards).transpose();
    DMat4::from_mat3_translation(axes, -(axes * position))
}

/// The part of a window that holds a smaller one. It changes in steps, and not at all while the smaller one is more than
/// half of it, so that a map is not drawn again at every turn of the camera.
fn narrowed([min, max]: [DVec2; 2], hull: [DVec2; 2]) -> [DVec2; 2] {
    let axis = |i: usize| {
        let (size, low, high) = (max[i] - min[i], hull[0][i].max(min[i]), hull[1][i].min(max[i]));
        let halvings = (size / (high - low)).log2().floor();
        if !(1.0..=MAX_HALVINGS).contains(&halvings) {
            return (min[i], max[i]);
        }
        let cell = size / halvings.exp2();
        let step = cell / 4.0;
        let first = min[i] + ((low - min[i]) / step).floor() * step;
        (first, first + cell + step)
    };
    let ((left, right), (bottom, top)) = (axis(0), axis(1));
    [DVec2::new(left, bottom), DVec2::new(right, top)]
}

/// A window of at least `least` in each direction, with a margin.
fn widened([min, max]: [DVec2; 2], least: f64, side: u32) -> [DVec2; 2] {
    let (center, half) = ((min + max) * 0.5, ((max - min) * 0.5).max(DVec2::splat(least)));
    let side = f64::from(side.max(16));
    let half = half * (side / (side - 2.0 * MARGIN));
    [center - half, center + half]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes() -> Vec<(Bounds, DMat4)> {
        let bounds = Bounds { min: DVec3::splat(-1.0), max: DVec3::ONE };
        vec![(bounds, DMat4::IDENTITY), (bounds, DMat4::from_translation(DVec3::new(5.0, 0.0, 1.0)))]
    }

    /// Where a point lies in the map, texels, and its depth.
    fn seen(view: &LightView, point: DVec3) -> (DVec2, f64) {
        let clip = view.clip_from_light() * view.light_from_world * point.extend(1.0);
        let ndc = clip.truncate() / clip.w;
        let [origin, size] = view.tile.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
        (origin + (ndc.truncate() * DVec2::new(0.5, -0.5) + 0.5) * size, ndc.z)
    }

    #[test]
    fn a_light_outside_sees_everything_in_one_picture_nearer_is_greater() {
        let kinds = [
            LightKind::Directional { direction: DVec3::new(0.3, -1.0, 0.2) },
            LightKind::Directional { direction: DVec3::NEG_Y },
            LightKind::Point { position: DVec3::new(2.0, 9.0, 1.0) },
        ];
        for kind in kinds {
            let views = light_views(&kind, &boxes(), &ShadowReceivers::default(), 512);
            assert_eq!(views.len(), 1);
            for (bounds, m) in boxes() {
                for corner in bounds.corners().map(|c| m.transform_point3(c)) {
                    let (texel, depth) = seen(&views[0], corner);
                    assert!(texel.min_element() > 2.0 && texel.max_element() < 510.0, "{texel}");
                    assert!(depth > 0.0 && depth < 1.0, "{depth}");
                    // The matrix and the numbers for the shader agree.
                    let p = views[0].light_from_world.transform_point3(corner);
                    let at = p.truncate() / if views[0].is_central { -p.z } else { 1.0 };
                    let (scale, origin) = views[0].texels();
                    assert!((at * scale + origin - texel).length() < 1e-6);
                }
            }
            let towards = views[0].light_from_world.inverse().transform_vector3(DVec3::Z);
            assert!(seen(&views[0], towards * 0.1).1 > seen(&views[0], DVec3::ZERO).1);
        }
    }

    #[test]
    fn a_light_among_objects_looks_to_all_sides() {
        let views = light_views(
            &LightKind::Point { position: DVec3::new(2.0, 0.0, 0.0) },
            &boxes(),
            &ShadowReceivers::default(),
            600,
        );
        assert_eq!(views.len(), 6);
        for direction in [DVec3::new(1.0, 0.2, -0.3), DVec3::new(-0.9, -1.0, 0.8), DVec3::new(0.1, 0.2, -1.0)]
        {
            let point = DVec3::new(2.0, 0.0, 0.0) + direction;
            let hits = views.iter().filter(|v| {
                let p = v.light_from_world.transform_point3(point);
                let (texel, _) = seen(v, point);
                let [origin, size] = v.tile.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
                -p.z > p.x.abs().max(p.y.abs())
                    && texel.cmpgt(origin).all()
                    && texel.cmplt(origin + size).all()
            });
            assert_eq!(hits.count(), 1);
        }
    }

    #[test]
    fn a_light_looks_closer_at_what_is_looked_at_and_moves_in_steps() {
        let whole = [DVec2::ZERO, DVec2::splat(16.0)];
        let hull = |x: f64, size: f64| [DVec2::splat(x), DVec2::splat(x + size)];
        assert_eq!(narrowed(whole, hull(-5.0, 30.0)), whole);
        assert_eq!(narrowed(whole, hull(3.0, 9.0)), whole);
        assert_eq!(narrowed(whole, hull(40.0, 1.0)), whole, "nothing of it is seen");
        let mut windows = Vec::new();
        for i in 0..120 {
            let hull = hull(f64::from(i) * 0.1, 3.0);
            let window = narrowed(whole, hull);
            assert!(window[0].cmple(hull[0]).all() && window[1].cmpge(hull[1]).all());
            assert!((window[1] - window[0]).max_element() <= 5.0);
            windows.push(window);
        }
        windows.dedup();
        assert!(windows.len() < 14);
    }

    #[test]
    fn nothing_is_seen_of_nothing() {
        let kind = LightKind::Directional { direction: DVec3::NEG_Y };
        assert!(light_views(&kind, &[], &ShadowReceivers::default(), 512).is_empty());
        assert!(
            light_views(&kind, &[(Bounds::EMPTY, DMat4::IDENTITY)], &ShadowReceivers::default(), 512)
                .is_empty()
        );
    }
}
