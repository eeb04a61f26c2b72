//! A still life on a wooden table: mirror, vase with leaves, bottle, ball, fruit, whisk. For images, relief, shapes that
//! are cut out, reflections and thin wires.
//!
//! Millimeters; the table's top is at y = 0, its front towards +Z. Composed for an eye that is turned 30° to +X.

use glam::{DQuat, DVec3, dvec3};

use crate::glb::{Image, Material, Node, Scene};
use crate::solid::Solid;
use crate::{
    leaf, still_life_bottle as bottle, still_life_fruit as fruit, still_life_mirror as mirror,
    still_life_plant as plant, still_life_table as table, still_life_toys as toys, still_life_vase as vase,
    still_life_whisk as whisk, wood,
};

/// How deep things stand in what they stand on, so that no light falls under them.
pub(crate) const SUNK: f64 = 0.2;

/// Finishes, in the order of [`Finish::all`].
#[derive(Clone, Copy)]
pub(crate) enum Finish {
    Wood,
    DarkWood,
    Vase,
    Label,
    Leaf,
    Checker,
    Gilt,
    Glass,
    Bottle,
    Cork,
    Stem,
    Steel,
    Lacquer,
    Clay,
    Pear,
    Apple,
    Bark,
}

impl Finish {
    /// The finishes, with the images that they use.
    fn all() -> (Vec<Material>, Vec<Image>) {
        let mut images = Vec::new();
        let mut image = |image: Image| {
            images.push(image);
            Some(images.len() - 1)
        };
        let plain = |name, srgb, roughness| Material { name, srgb, roughness, ..Material::default() };
        let white = |name, roughness| plain(name, 0xff_ffff, roughness);
        let (rings, grain) = (image(wood::color()), image(wood::relief()));
        let wood =
            |name, srgb| Material { color_image: rings, normal_image: grain, ..plain(name, srgb, 0.7) };
        let materials = vec![
            wood("wood", 0xff_ffff),
            wood("dark wood", 0xf0_e2d2),
            Material {
                color_image: image(vase::color()),
                normal_image: image(vase::relief()),
                ..white("glaze", 0.35)
            },
            Material { color_image: image(bottle::label_image()), ..white("label", 0.9) },
            Material { color_image: image(leaf::image()), cut_out: true, ..white("leaf", 0.6) },
            Material { color_image: image(toys::checker()), ..white("checker", 0.4) },
            plain("gilt", 0xc2_9a4c, 0.4),
            plain("mirror glass", 0xcf_dee2, 0.0),
            plain("bottle glass", 0x5d_7f6e, 0.1),
            plain("cork", 0xc9_a275, 0.9),
            plain("stem", 0x6b_7d45, 0.7),
            plain("steel", 0xb9_c1c6, 0.3),
            plain("lacquer", 0x9c_3f35, 0.3),
            plain("clay", 0xd0_b39a, 0.9),
            plain("pear skin", 0xcf_b95c, 0.5),
            plain("apple skin", 0xc0_5a44, 0.4),
            plain("bark", 0x6a_4a35, 0.9),
        ];
        (materials, images)
    }
}

/// Turns solids into meshes of the scene.
#[derive(Default)]
pub(crate) struct Studio {
    scene: Scene,
}

impl Studio {
    /// A node that shows a solid. Edges that turn by more than 40° stay hard.
    pub(crate) fn node(&mut self, name: &str, finish: Finish, solid: Solid) -> Node {
        self.node_creased(name, finish, solid, 40.0)
    }

    /// The same for another angle.
    pub(crate) fn node_creased(&mut self, name: &str, finish: Finish, solid: Solid, crease: f64) -> Node {
        let mesh = self.scene.add(solid.into_mesh(name, finish as usize, crease));
        Node::new(name, Some(mesh))
    }
}

/// The file's contents.
pub(crate) fn scene() -> Scene {
    let mut studio = Studio::default();
    let on_table = |node: Node, x: f64, z: f64| node.at(x, -SUNK, z);
    let roots = vec![
        table::node(&mut studio),
        mirror::node(&mut studio, dvec3(-190.0, 0.0, -88.0), 52_f64.to_radians()),
        on_table(vase::node(&mut studio), 12.0, -104.0),
        on_table(plant::node(&mut studio), 12.0, -104.0),
        on_table(bottle::node(&mut studio), 166.0, -66.0),
        on_table(toys::ball(&mut studio), 36.0, 44.0),
        on_table(toys::cube(&mut studio), -170.0, 14.0).turned(DQuat::from_rotation_y(0.3)),
        on_table(fruit::pear(&mut studio), 249.0, -18.0).turned(DQuat::from_rotation_y(0.6)),
        on_table(fruit::apple(&mut studio), 122.0, 84.0),
        whisk::node(&mut studio, dvec3(86.0, 0.0, 150.0), DVec3::new(-1.0, 0.0, 0.02)),
    ];
    (studio.scene.materials, studio.scene.images) = Finish::all();
    studio.scene.roots = roots;
    studio.scene
}
