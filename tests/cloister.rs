//! The sample model `cloister.glb` is what sketches and line drawings need: named solids that repeat, and no two faces in
//! one place.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test may stop at the first surprise in files that the project itself made"
)]

mod solids;

use std::collections::BTreeSet;

use solids::{check_places, check_solids, imported};

#[test]
fn the_cloister_is_made_of_named_solids() {
    let paths = [
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
    ];
    check_solids("cloister", 30_000..150_000, 1, &paths);
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
    check_places("cloister");
}
