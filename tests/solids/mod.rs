//! What must hold of every sample model of named solids: all are there, each is closed, and no faces of two lie in one place, where no
//! renderer can tell which is in front.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3, dvec3};
use hachure::geometry::{CreaseRule, Topology};
use hachure::import::{ImportOptions, Progress, load};
use hachure::scene::{Node, Scene};

/// The file of a sample model.
fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/models/{name}.glb"))
}

/// A sample model as the program imports it.
pub fn imported(name: &str) -> Scene {
    load(&file(name), &ImportOptions::default(), &Progress::default()).unwrap()
}

/// A triangle in the world, in meters.
pub type Triangle = [DVec3; 3];

/// Each triangle with the path of its node.
pub fn triangles(scene: &Scene) -> Vec<(&str, Triangle)> {
    let shown = scene.nodes.iter().filter_map(|node| Some((node, &scene.meshes[node.mesh?])));
    shown
        .flat_map(|(node, mesh)| {
            mesh.indices.chunks_exact(3).map(move |corners| {
                let place = |k: usize| mesh.positions[corners[k] as usize].as_dvec3();
                (node.path.as_str(), [0, 1, 2].map(|k| node.world_from_local.transform_point3(place(k))))
            })
        })
        .collect()
}

/// The paths of nodes with faces in one place, in pairs.
fn shared(scene: &Scene) -> BTreeSet<(&str, &str)> {
    let mut planes: BTreeMap<[i64; 3], Vec<(f64, DVec3, &str, Triangle)>> = BTreeMap::new();
    for (path, triangle) in triangles(scene) {
        let [a, b, c] = triangle;
        let normal = (b - a).cross(c - a).normalize();
        // Both sides of a plane are the same plane.
        let sign = if normal.dot(dvec3(1.0, 1e-3, 1e-6)) < 0.0 { -1.0 } else { 1.0 };
        let normal = normal * sign;
        let key = (normal * 1e3).round().to_array().map(|v| v as i64);
        planes.entry(key).or_default().push((normal.dot(a), normal, path, triangle));
    }
    let mut shared = BTreeSet::new();
    for plane in planes.values_mut() {
        plane.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (i, &(at, normal, path, triangle)) in plane.iter().enumerate() {
            for &(_, _, other, beside) in plane[i + 1..].iter().take_while(|face| face.0 - at < 1e-3) {
                if overlap(normal, triangle, beside) {
                    shared.insert((path.min(other), path.max(other)));
                }
            }
        }
    }
    shared
}

/// Do two triangles of one plane overlap by more than two millimeters in every direction? (No line parts them.)
fn overlap(normal: DVec3, a: Triangle, b: Triangle) -> bool {
    let u = normal.any_orthonormal_vector();
    let v = normal.cross(u);
    let flat = |triangle: Triangle| triangle.map(|p| DVec2::new(p.dot(u), p.dot(v)));
    let (a, b) = (flat(a), flat(b));
    let span = |points: [DVec2; 3], axis: DVec2| {
        let along = points.map(|p| p.dot(axis));
        (along.into_iter().fold(f64::INFINITY, f64::min), along.into_iter().fold(f64::NEG_INFINITY, f64::max))
    };
    [a, b].iter().all(|points| {
        (0..3).all(|k| {
            let axis = (points[(k + 1) % 3] - points[k]).normalize().perp();
            let ((a0, a1), (b0, b1)) = (span(a, axis), span(b, axis));
            a1.min(b1) - a0.max(b0) > 2e-3
        })
    })
}

/// A sample model of so many triangles, in a file of less than so many MiB, has a solid at each of these paths, and others.
pub fn check_solids(name: &str, triangles: std::ops::Range<usize>, mebibytes: u64, paths: &[&str]) {
    let scene = imported(name);
    assert_eq!(scene.warnings, []);
    assert!(triangles.contains(&scene.triangle_count()), "{}", scene.triangle_count());
    assert!(file(name).metadata().unwrap().len() < mebibytes << 20, "larger than {mebibytes} MiB");
    for path in paths {
        let found = scene.find(&format!("/{name}/{path}")).and_then(|id| scene.nodes[id].mesh);
        assert!(found.is_some(), "{path}");
    }
    let names: BTreeSet<&str> = scene.nodes.iter().map(|node| node.path.as_str()).collect();
    assert_eq!(names.len(), scene.nodes.len(), "two parts of one name");
    for node in &scene.nodes {
        let Some(mesh) = node.mesh.map(|mesh| &scene.meshes[mesh]) else { continue };
        assert!(Topology::new(mesh, 0.6, CreaseRule::default()).is_solid, "{}", node.path);
    }
}

/// No two faces of a sample model lie in one place.
pub fn check_places(name: &str) {
    let scene = imported(name);
    let found = shared(&scene);
    assert!(found.is_empty(), "{found:#?}");
    // Twice the same ground is found.
    let ground = scene.find(&format!("/{name}/ground")).unwrap();
    let mut twice = scene.clone();
    twice.nodes.push(Node { path: "/again".to_owned(), ..scene.nodes[ground].clone() });
    assert!(!shared(&twice).is_empty());
}
