//! A cloister: arcades on twin columns around a court with a well, walks under groin vaults, tiled lean-to roofs, and
//! beside it the church with its bell tower. For sketches and line drawings: much that repeats, round and straight.
//!
//! Meters; the court's middle is the origin, the church is at −Z; the court's pavement is at y = 0. Parts stand a little
//! in each other, so that nowhere two faces share a plane.

use std::f64::consts::FRAC_PI_2;

use glam::DQuat;

use crate::cloister_arcade::{self as arcade, Arcade};
use crate::cloister_vault::Vaults;
use crate::cloister_walls::{self as walls, Walls};
use crate::glb::{Material, Node, Scene};
use crate::solid::Solid;
use crate::{
    cloister_church as church, cloister_court as court, cloister_roof as roof, cloister_well as well,
};

/// The court's side of the arcades.
pub(crate) const COURT: f64 = 10.0;
/// The walks' side of the arcades.
pub(crate) const WALK: f64 = 10.5;
/// The middle of the arcades.
pub(crate) const ARCADE: f64 = (COURT + WALK) / 2.0;
/// The walks' outer side.
pub(crate) const OUTER: f64 = 14.5;
/// The width of a bay.
pub(crate) const BAY: f64 = 19.5 / 7.0;
/// The radius of the arcades' arches.
pub(crate) const ARCH: f64 = (BAY - 0.5) / 2.0;
/// The walks' pavement.
pub(crate) const FLOOR: f64 = 0.15;
/// The parapets' upper side.
pub(crate) const PARAPET: f64 = 0.75;
/// Where arches and vaults spring.
pub(crate) const IMPOST: f64 = 2.75;
/// Where the cornice meets the roof.
pub(crate) const EAVES: f64 = 4.96;
/// How deep stands in the ground what stands on it: so deep that its foot is not mistaken for an edge in sight.
pub(crate) const DEEP: f64 = 0.3;
/// Edges that turn by more stay hard, in degrees.
const CREASE: f64 = 30.0;

/// The middles of a side's bays.
pub(crate) fn bays() -> [f64; 7] {
    [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0].map(|i| i * BAY)
}

/// Where a side's bays meet.
pub(crate) fn bounds() -> [f64; 6] {
    [-2.5, -1.5, -0.5, 0.5, 1.5, 2.5].map(|i| i * BAY)
}

/// Finishes, in the order of [`materials`].
#[derive(Clone, Copy)]
pub(crate) enum Finish {
    Stone,
    Pale,
    Marble,
    Plaster,
    Paving,
    Tiles,
    Wood,
    Iron,
    Bronze,
    Water,
    Lawn,
    Earth,
    Cypress,
}

/// The colors of the finishes.
fn materials() -> Vec<Material> {
    let finish = |name, srgb| Material { name, srgb, roughness: 0.9, ..Material::default() };
    vec![
        finish("stone", 0xe3_d6bc),
        finish("pale stone", 0xee_e5d2),
        finish("marble", 0xf1_ece1),
        finish("plaster", 0xf0_e8d8),
        finish("paving", 0xd9_cfba),
        finish("roof tiles", 0xdc_a88e),
        finish("wood", 0x9f_7b59),
        Material { metallic: 0.6, roughness: 0.5, ..finish("wrought iron", 0x5c_6168) },
        Material { metallic: 0.6, roughness: 0.5, ..finish("bronze", 0xa8_8a5a) },
        finish("water", 0x9c_bcc6),
        finish("lawn", 0xbd_cc9a),
        finish("earth", 0xe2_d9c2),
        finish("cypress", 0x83_9f78),
    ]
}

/// Turns solids in meters into meshes of the scene.
pub(crate) struct Builder {
    scene: Scene,
}

impl Builder {
    /// Adds a mesh, which several nodes may show.
    pub(crate) fn mesh(&mut self, name: &str, finish: Finish, solid: Solid) -> usize {
        self.creased(name, finish, solid, CREASE)
    }

    /// Adds a mesh with edges that stay hard where they turn by more than `crease` degrees.
    pub(crate) fn creased(&mut self, name: &str, finish: Finish, solid: Solid, crease: f64) -> usize {
        let millimeters = solid.bent(|p| p * 1e3);
        self.scene.add(millimeters.into_mesh(name, finish as usize, crease))
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
}

/// The sides of the court with the quarter turns that bring what is built at +Z there.
const SIDES: [(&str, f64); 4] = [("south", 0.0), ("east", 1.0), ("north", 2.0), ("west", 3.0)];

/// The node at a side of the court.
fn at_side(node: Node, quarters: f64) -> Node {
    node.turned(DQuat::from_rotation_y(quarters * FRAC_PI_2))
}

/// The file's contents.
pub(crate) fn scene() -> Scene {
    let mut builder = Builder { scene: Scene { materials: materials(), ..Scene::default() } };
    let arcades = Arcade::new(&mut builder);
    let vaults = Vaults::new(&mut builder);
    let walls = Walls::new(&mut builder);
    let mut roots = court::grounds(&mut builder);
    roots.push(well::well(&mut builder, &arcades));
    for (side, quarters) in SIDES {
        let wall = if side == "north" { walls.beside_church() } else { walls.outside() };
        let parts = vec![arcades.node(), vaults.walk(), wall];
        roots.push(at_side(Node::new(format!("{side}_walk"), None).with(parts), quarters));
    }
    let piers = arcade::pier(&mut builder);
    let buttress = walls::corner(&mut builder);
    for (i, (_, quarters)) in SIDES.into_iter().enumerate() {
        let mut parts = vec![vaults.corner()];
        let meshes = piers.iter().chain(&buttress);
        parts.extend(meshes.map(|&(name, mesh)| Node::new(name, Some(mesh))));
        roots.push(at_side(Node::new(format!("corner.{}", i + 1), None).with(parts), quarters));
    }
    let mut above = arcade::cornices(&mut builder);
    above.push(walls::coping(&mut builder));
    above.extend(roof::roofs(&mut builder));
    roots.push(Node::new("roofs", None).with(above));
    roots.push(church::church(&mut builder));
    roots.push(church::tower(&mut builder));
    builder.scene.roots = roots;
    builder.scene
}
