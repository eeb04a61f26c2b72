//! An Egyptian temple: pylon, inner yard, hypostyle hall, two statues that guard the doorway to the chambers behind, and
//! a hidden chamber above them. For what is drawn through walls: every part is named.
//!
//! Meters; the temple's axis lies along Z, its entrance at +Z; the floor is at y = 0. Parts stand a little in each
//! other, so that nowhere two faces share a plane.

use crate::glb::{Material, Node, Scene};
use crate::solid::Solid;
use crate::temple_masonry::block;
use crate::temple_statue::Statue;
use crate::{temple_chambers, temple_hall, temple_pylon, temple_yard};

/// Edges that turn by more stay hard, in degrees.
const CREASE: f64 = 30.0;

/// Finishes, in the order of [`materials`].
#[derive(Clone, Copy)]
pub(crate) enum Finish {
    Sandstone,
    Pale,
    Roof,
    Sand,
    Painted,
    Granite,
    DarkGranite,
    RedGranite,
    Alabaster,
    Cedar,
}

/// The colors of the finishes.
fn materials() -> Vec<Material> {
    let finish = |name, srgb| Material { name, srgb, roughness: 0.9, ..Material::default() };
    vec![
        finish("sandstone", 0xdf_caa0),
        finish("pale sandstone", 0xe9_d9b8),
        finish("roof slabs", 0xd3_bd93),
        finish("sand", 0xe8_dcc0),
        finish("painted stone", 0x86_aaa0),
        finish("granite", 0x77_7a80),
        finish("dark granite", 0x58_5b63),
        finish("red granite", 0xbd_8f7c),
        finish("alabaster", 0xf0_e9da),
        finish("cedar", 0x9a_6a48),
    ]
}

/// Turns solids in meters into meshes of the scene.
pub(crate) struct Mason {
    scene: Scene,
}

impl Mason {
    /// Adds a mesh, which several nodes may show.
    pub(crate) fn mesh(&mut self, name: &str, finish: Finish, solid: Solid) -> usize {
        self.creased(name, finish, solid, CREASE)
    }

    /// A node that shows a solid.
    pub(crate) fn part(&mut self, name: &str, finish: Finish, solid: Solid) -> Node {
        let mesh = self.mesh(name, finish, solid);
        Node::new(name, Some(mesh))
    }

    /// The node at a place in meters.
    pub(crate) fn placed(node: Node, x: f64, y: f64, z: f64) -> Node {
        node.at(x * 1e3, y * 1e3, z * 1e3)
    }

    /// Adds a mesh with edges that stay hard where they turn by more than `crease` degrees.
    pub(crate) fn creased(&mut self, name: &str, finish: Finish, solid: Solid, crease: f64) -> usize {
        let millimeters = solid.bent(|p| p * 1e3);
        self.scene.add(millimeters.into_mesh(name, finish as usize, crease))
    }
}

/// The file's contents.
pub(crate) fn scene() -> Scene {
    let mut mason = Mason { scene: Scene { materials: materials(), ..Scene::default() } };
    let roots = vec![
        mason.part("ground", Finish::Sand, block([-18.5, 18.5], [-0.4, 0.0], [-32.5, 37.0])),
        temple_pylon::forecourt(&mut mason),
        temple_pylon::pylon(&mut mason),
        temple_yard::yard(&mut mason),
        temple_hall::hall(&mut mason),
        statues(&mut mason),
        temple_hall::portal(&mut mason, "doorway", 1.75, [2.2, 3.95], [-9.6, -8.8]),
        temple_chambers::chambers(&mut mason),
        temple_chambers::hidden_chamber(&mut mason),
    ];
    mason.scene.roots = roots;
    mason.scene
}

/// The two kings who guard the doorway to the chambers.
fn statues(mason: &mut Mason) -> Node {
    let statue = Statue::new(mason);
    let king = |(name, x)| Mason::placed(statue.node(name), x, 0.0, -7.65);
    Node::new("statues", None).with([("statue.1", -2.75), ("statue.2", 2.75)].map(king).to_vec())
}
