//! A stocky ogre with a club: smooth bodies without a hard edge, about two metres tall.

use glam::{DVec3, dvec3};

use crate::glb::{Material, Mesh, Node, Scene};
use crate::ogre_body::{details, in_head, nails, skin};
use crate::remesh::polygonise;
use crate::sdf::gradient;
use crate::{ogre_gear, ogre_head};

/// The file's contents.
pub(crate) fn scene() -> Scene {
    let finish = |name, srgb| Material {
        name,
        srgb,
        metallic: 0.0,
        roughness: 0.8,
    };
    let mut scene = Scene {
        materials: vec![
            finish("skin", 0x8f_a86a),
            finish("ivory", 0xef_e6cc),
            finish("eye", 0xf6_f3e6),
            finish("pupil", 0x2a_1c14),
            finish("hide", 0x96_6b45),
            finish("leather", 0x5a_3d29),
            finish("brass", 0xc9_a24a),
            finish("wood", 0x7a_5a3c),
            finish("hair", 0x3b_2a24),
        ],
        ..Scene::default()
    };
    let fine = |p: DVec3| {
        details().iter().fold(1.0_f64, |size, &(centre, radius, part)| {
            let far = ((p.distance(centre) - radius) / 0.25).clamp(0.0, 1.0);
            size.min(part + (1.0 - part) * far)
        }) * 0.0262
    };
    let all = (dvec3(-1.3, -0.05, -0.55), dvec3(1.3, 2.3, 0.85));
    part(&mut scene, "skin", 0, skin, all, 0.0125, fine);
    let head = (dvec3(-0.5, 1.1, -0.4), dvec3(0.6, 2.3, 0.8));
    part(&mut scene, "tusks", 1, |p| in_head(p, ogre_head::tusks), head, 0.006, |_| 0.0125);
    part(&mut scene, "nails", 1, nails, all, 0.008, |_| 0.0125);
    part(&mut scene, "eyes", 2, |p| in_head(p, ogre_head::eyes), head, 0.01, |_| 0.0125);
    part(&mut scene, "pupils", 3, |p| in_head(p, ogre_head::pupils), head, 0.005, |_| 0.007);
    part(&mut scene, "topknot", 8, |p| in_head(p, ogre_head::topknot), head, 0.01, |_| 0.016);
    part(&mut scene, "tie", 5, |p| in_head(p, ogre_head::tie), head, 0.006, |_| 0.011);
    part(&mut scene, "loincloth", 4, ogre_gear::loincloth, all, 0.01, |_| 0.02);
    part(&mut scene, "belt", 5, ogre_gear::belt, all, 0.01, |_| 0.02);
    part(&mut scene, "buckle", 6, ogre_gear::buckle, all, 0.01, |_| 0.015);
    part(&mut scene, "club", 7, ogre_gear::club, all, 0.0125, |_| 0.022);
    scene
}

/// Adds one body as a mesh under a node of its own.
fn part(
    scene: &mut Scene,
    name: &str,
    material: usize,
    distance: impl Fn(DVec3) -> f64,
    bounds: (DVec3, DVec3),
    cell: f64,
    size: impl Fn(DVec3) -> f64,
) {
    let surface = polygonise(&distance, bounds, cell, &size);
    let normal = |p: &DVec3| gradient(&distance, *p).normalize().as_vec3().to_array();
    let mesh = scene.add(Mesh {
        name: name.to_owned(),
        positions: surface.points.iter().map(|p| p.as_vec3().to_array()).collect(),
        normals: surface.points.iter().map(normal).collect(),
        uvs: Vec::new(),
        indices: surface.faces.iter().flatten().map(|&i| i as u32).collect(),
        material,
    });
    scene.roots.push(Node::new(name, Some(mesh)));
}
