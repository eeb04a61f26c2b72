//! The sample model `temple.glb` is what drawings through walls need: named solids, no two faces in one place, and a
//! chamber that nobody can see from outside.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test may stop at the first surprise in files that the project itself made"
)]

mod solids;

use std::f64::consts::TAU;

use glam::{DVec3, dvec3};
use hachure::geometry::Bounds;
use hachure::scene::Scene;

use solids::{Triangle, check_places, check_solids, imported, triangles};

/// The box around what a node and those below it show.
fn bounds(scene: &Scene, path: &str) -> Bounds {
    let top = format!("/temple/{path}");
    let below = format!("{top}/");
    let nodes = scene.nodes.iter().enumerate();
    let bounds = scene.bounds_of(
        nodes.filter(|(_, node)| node.path == top || node.path.starts_with(&below)).map(|(id, _)| id),
    );
    assert!(!bounds.is_empty(), "{path} shows nothing");
    bounds
}

#[test]
fn the_temple_is_made_of_named_solids() {
    let paths = [
        "ground",
        "forecourt/obelisk.2/needle",
        "pylon/tower.1",
        "pylon/tower.2",
        "pylon/gate",
        "pylon/mast.4",
        "yard/wall.2",
        "yard/column.14/capital",
        "yard/architrave.3",
        "yard/roof",
        "hall/wall.4",
        "hall/column.24/shaft",
        "hall/clerestory.2",
        "hall/roof.3",
        "hall/portal/frame",
        "statues/statue.1/king",
        "statues/statue.2/throne",
        "doorway/frame",
        "chambers/enclosure",
        "chambers/wall.10",
        "chambers/stair",
        "chambers/altar",
        "chambers/roof.lower",
        "chambers/roof.upper.3",
        "hidden_chamber/floor",
        "hidden_chamber/wall.4",
        "hidden_chamber/roof",
        "hidden_chamber/sarcophagus/lid",
    ];
    check_solids("temple", 30_000..80_000, 2, &paths);
}

#[test]
fn two_statues_guard_the_doorway_to_the_chambers() {
    let scene = imported("temple");
    let [left, right, door, hall, chambers] =
        ["statues/statue.1", "statues/statue.2", "doorway", "hall", "chambers"].map(|p| bounds(&scene, p));
    assert!(left.max.x < door.center().x && door.center().x < right.min.x);
    for statue in [&left, &right] {
        assert!(statue.min.z > door.min.z && statue.max.z < hall.max.z, "{statue:?}");
        assert!(statue.max.y - statue.min.y > 2.0 * (statue.max.x - statue.min.x), "{statue:?}");
    }
    assert!(door.center().z > chambers.center().z && door.min.z < chambers.max.z);
    // One can walk in a straight line from the forecourt to the altar.
    let (eye, altar) = (dvec3(0.0, 1.0, 37.0), bounds(&scene, "chambers/altar").center());
    let table = bounds(&scene, "chambers/offering_table");
    let above = dvec3(altar.x, table.max.y + 0.1, altar.z);
    let first = triangles(&scene)
        .into_iter()
        .filter_map(|(path, triangle)| Some((hit(eye, above - eye, triangle)?, path)))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(first.map(|hit| hit.1), Some("/temple/chambers/altar"));
}

#[test]
fn no_line_of_sight_leaves_the_hidden_chamber() {
    let scene = imported("temple");
    let [hidden, walls, roof] =
        ["hidden_chamber", "chambers/enclosure", "chambers/roof.upper"].map(|path| match path {
            "chambers/roof.upper" => (1..=3)
                .map(|i| bounds(&scene, &format!("{path}.{i}")))
                .fold(Bounds::EMPTY, |all, b| all.union(&b)),
            _ => bounds(&scene, path),
        });
    assert!(hidden.min.x > walls.min.x + 1.0 && hidden.max.x < walls.max.x - 1.0);
    assert!(hidden.min.z > walls.min.z + 1.0 && hidden.max.z < walls.max.z - 1.0);
    assert!(hidden.max.y < roof.min.y && hidden.min.y > bounds(&scene, "chambers/altar").max.y);
    let around: Vec<(&str, Triangle)> = triangles(&scene)
        .into_iter()
        .filter(|(path, _)| {
            ["/temple/chambers", "/temple/hidden_chamber"].iter().any(|p| path.starts_with(p))
        })
        .collect();
    let eye = dvec3(hidden.center().x, hidden.max.y - 0.6, hidden.center().z);
    // The points of a Fibonacci lattice on the sphere.
    const RAYS: usize = 400;
    for i in 0..RAYS {
        let y = 1.0 - (2 * i + 1) as f64 / RAYS as f64;
        let angle = TAU * i as f64 * 0.618_033_988_749_895;
        let way = dvec3(angle.cos(), 0.0, angle.sin()) * (1.0 - y * y).sqrt() + DVec3::Y * y;
        assert!(around.iter().any(|(_, triangle)| hit(eye, way, *triangle).is_some()), "{way}");
    }
}

#[test]
fn no_two_faces_of_the_temple_lie_in_one_place() {
    check_places("temple");
}

/// How far along a ray it meets a triangle, in lengths of `way`.
fn hit(eye: DVec3, way: DVec3, [a, b, c]: Triangle) -> Option<f64> {
    let (u, v) = (b - a, c - a);
    let p = way.cross(v);
    let scale = u.dot(p);
    let from = eye - a;
    let (s, q) = (from.dot(p) / scale, from.cross(u));
    let (t, distance) = (way.dot(q) / scale, v.dot(q) / scale);
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && distance > 0.0).then_some(distance)
}
