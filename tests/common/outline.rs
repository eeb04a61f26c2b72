//! Outlines in the picture and the exact area that they cover of a pixel.

use glam::{DVec2, DVec3, UVec2};
use hachure::export::session::Opened;
use hachure::render::View;

/// Area of a convex polygon within a unit pixel with its corner at `px`.
pub fn coverage(polygon: &[DVec2], px: DVec2) -> f64 {
    let mut rest = polygon.to_vec();
    for (normal, limit) in
        [(DVec2::X, px.x), (DVec2::NEG_X, -px.x - 1.0), (DVec2::Y, px.y), (DVec2::NEG_Y, -px.y - 1.0)]
    {
        let mut clipped = Vec::new();
        for (i, &a) in rest.iter().enumerate() {
            let b = rest[(i + 1) % rest.len()];
            let (da, db) = (a.dot(normal) - limit, b.dot(normal) - limit);
            if da >= 0.0 {
                clipped.push(a);
            }
            if (da >= 0.0) != (db >= 0.0) {
                clipped.push(a.lerp(b, da / (da - db)));
            }
        }
        rest = clipped;
    }
    let twice: f64 = (0..rest.len()).map(|i| rest[i].perp_dot(rest[(i + 1) % rest.len()])).sum();
    twice.abs() * 0.5
}

/// Where points of the world lie in a picture by the document's camera, in pixels.
pub fn projected(opened: &Opened, size: [u32; 2], world: &[DVec3]) -> Vec<DVec2> {
    let size = UVec2::from_array(size);
    let view = View::new(&opened.document.camera.unwrap(), &opened.scene.bounds(), size);
    let place = |&point: &DVec3| {
        let clip = view.clip_from_view.as_dmat4() * view.view_from_world.transform_point3(point).extend(1.0);
        (clip.truncate().truncate() / clip.w * DVec2::new(0.5, -0.5) + 0.5) * size.as_dvec2()
    };
    world.iter().map(place).collect()
}

/// The outline of the first object, which is convex, in pixels of a picture of this size.
pub fn outline(opened: &Opened, size: [u32; 2]) -> Vec<DVec2> {
    let scene = &opened.scene;
    let place = scene.nodes[0].world_from_local;
    let world: Vec<DVec3> =
        scene.meshes[0].positions.iter().map(|p| place.transform_point3(p.as_dvec3())).collect();
    hull_of(projected(opened, size, &world))
}

/// The convex hull, counter-clockwise as seen with y up.
pub fn hull_of(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut hull: Vec<DVec2> = Vec::new();
        for p in points {
            while let [.., a, b] = hull[..]
                && (b - a).perp_dot(p - a) <= 1e-12
            {
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
        hull
    };
    let mut hull = chain(&mut points.iter().copied());
    hull.extend(chain(&mut points.iter().rev().copied()));
    hull
}
