//! The sample model `cloister.glb` is what sketches and line drawings need: named solids that repeat, and no two faces in
//! one place.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test may stop at the first surprise in files that the project itself made"
)]

mod planes;

use std::collections::BTreeSet;

use hachure::geometry::{CreaseRule, Topology};

use planes::{file, imported, shared};

#[test]
fn the_cloister_is_made_of_named_solids() {
    let scene = imported("cloister");
    assert_eq!(scene.warnings, []);
    assert!((30_000..150_000).contains(&scene.triangle_count()), "{}", scene.triangle_count());
    assert!(file("cloister").metadata().unwrap().len() < 1 << 20, "larger than 1 MiB");
    for path in [
        "ground",
        "floor",
        "court/pavement",
        "court/garden.4/kerb",
        "court/garden.1/cypress/crown",
        "well/kerb",
        "well/post.2/shaft",
        "well/bucket",
        "south_walk/arcade/wall",
        "east_walk/arcade/arch.7",
        "north_walk/arcade/columns.6/column.2/capital",
        "north_walk/enclosure/door.2/leaf",
        "west_walk/arcade/parapet.2",
        "west_walk/vaults/vault.7/rib.2",
        "west_walk/enclosure/window.8",
        "corner.4/pier",
        "corner.1/vault/web",
        "roofs/roof",
        "roofs/tiles.4",
        "roofs/valley.4",
        "church/gable.2",
        "tower/bell",
        "tower/cross",
    ] {
        let found = scene.find(&format!("/cloister/{path}")).and_then(|id| scene.nodes[id].mesh);
        assert!(found.is_some(), "{path}");
    }
    let names: BTreeSet<&str> = scene.nodes.iter().map(|node| node.path.as_str()).collect();
    assert_eq!(names.len(), scene.nodes.len(), "two parts of one name");
    for node in &scene.nodes {
        let Some(mesh) = node.mesh.map(|mesh| &scene.meshes[mesh]) else { continue };
        assert!(Topology::new(mesh, 0.6, CreaseRule::default()).is_solid, "{}", node.path);
    }
}

#[test]
fn the_columns_share_their_stones() {
    let scene = imported("cloister");
    let shafts: Vec<_> = scene.nodes.iter().filter(|node| node.path.ends_with("/shaft")).collect();
    let columns: Vec<_> = shafts.iter().filter(|node| node.path.contains("/column.")).collect();
    assert_eq!(columns.len(), 4 * 6 * 2);
    let meshes: BTreeSet<_> = columns.iter().map(|node| node.mesh).collect();
    assert_eq!(meshes.len(), 1);
}

#[test]
fn no_two_faces_of_the_cloister_lie_in_one_place() {
    let scene = imported("cloister");
    let found = shared(&scene);
    assert!(found.is_empty(), "{found:#?}");
    // Twice the same ground is found.
    let ground = scene.find("/cloister/ground").unwrap();
    let mut twice = scene.clone();
    twice.nodes.push(hachure::scene::Node { path: "/again".to_owned(), ..scene.nodes[ground].clone() });
    assert!(!shared(&twice).is_empty());
}
