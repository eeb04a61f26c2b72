//! A stocky ogre with a club: smooth bodies without a hard edge, about two meters tall.

use glam::{DVec3, dvec3};

use crate::glb::{Material, Mesh, Node, Scene};
use crate::ogre_body::{CLUB_FOOT, CLUB_TOP, in_head, nails, skin};
use crate::ogre_charts::{
    bracer_charts, buckle_chart, nail_charts, on_head, ring_chart, skin_charts, strand_charts, tie_chart,
    tusk_charts,
};
use crate::remesh::{Sizing, polygonize};
use crate::unwrap::{Chart, unwrap};
use crate::{ogre_gear, ogre_head};

/// The file's contents.
pub(crate) fn scene() -> Scene {
    let finish = |name, srgb| Material { name, srgb, roughness: 0.8, ..Material::default() };
    let mut scene = Scene {
        materials: vec![
            finish("skin", 0x9d_b873),
            finish("ivory", 0xf2_ead2),
            finish("eye", 0xfa_f6e8),
            finish("pupil", 0x2a_1c14),
            finish("hide", 0xa8_7b52),
            finish("leather", 0x6f_4c34),
            finish("brass", 0xd9_ae4c),
            finish("wood", 0x8f_6b48),
            finish("hair", 0x4a_352d),
        ],
        ..Scene::default()
    };
    let all = (dvec3(-1.3, -0.05, -0.65), dvec3(1.3, 2.35, 0.95));
    let head = (dvec3(-0.5, 1.1, -0.5), dvec3(0.7, 2.35, 0.8));
    let mut part =
        |name, material, distance: &dyn Fn(DVec3) -> f64, bounds, cell, edges, charts: &[Chart]| {
            let body = Body { name, material, distance, bounds, cell, edges };
            scene.roots.push(body.add(charts, &mut scene.meshes));
        };
    let tusks = |p| in_head(p, ogre_head::tusks);
    let eyes = |p| in_head(p, ogre_head::eyes);
    let pupils = |p| in_head(p, ogre_head::pupils);
    let topknot = |p| in_head(p, ogre_head::topknot);
    let tie = |p| in_head(p, ogre_head::tie);
    let earring = |p| in_head(p, ogre_head::earring);
    let round = |y: f64, half: f64, radius: f64| {
        [Chart::new(dvec3(0.0, y - half, 0.05), dvec3(0.0, y + half, 0.05), radius)]
    };
    let [eye_l, eye_r] =
        [1.0, -1.0].map(|side| on_head(side * ogre_head::EYE.x, ogre_head::EYE.y, ogre_head::EYE.z));
    let balls = [Chart::new(eye_l, eye_l, 0.064), Chart::new(eye_r, eye_r, 0.064)];
    let club = [Chart::new(CLUB_FOOT, CLUB_TOP, 0.12)];
    part("skin", 0, &skin, all, 0.0095, (0.0092, 0.052, 0.435), &skin_charts());
    part("tusks", 1, &tusks, head, 0.006, (0.008, 0.025, 0.5), &tusk_charts());
    part("nails", 1, &nails, all, 0.006, (0.0068, 0.025, 0.5), &nail_charts());
    part("eyes", 2, &eyes, head, 0.012, (0.019, 0.019, 0.5), &balls);
    part("pupils", 3, &pupils, head, 0.005, (0.0065, 0.016, 0.58), &balls);
    part("topknot", 8, &topknot, head, 0.009, (0.0105, 0.03, 0.46), &strand_charts());
    part("tie", 5, &tie, head, 0.007, (0.0085, 0.02, 0.46), &tie_chart());
    part("earring", 6, &earring, head, 0.005, (0.008, 0.02, 0.46), &ring_chart());
    part("loincloth", 4, &ogre_gear::loincloth, all, 0.016, (0.0175, 0.055, 0.48), &round(0.45, 0.2, 0.42));
    part("belt", 5, &ogre_gear::belt, all, 0.016, (0.0145, 0.055, 0.46), &round(0.64, 0.06, 0.45));
    part("buckle", 6, &ogre_gear::buckle, all, 0.009, (0.0105, 0.03, 0.4), &buckle_chart());
    part("bracers", 5, &ogre_gear::bracers, all, 0.012, (0.014, 0.045, 0.46), &bracer_charts());
    part("club", 7, &ogre_gear::club, all, 0.014, (0.0135, 0.045, 0.48), &club);
    scene
}

/// One body on its way into the scene.
struct Body<'a> {
    name: &'a str,
    material: usize,
    distance: &'a dyn Fn(DVec3) -> f64,
    bounds: (DVec3, DVec3),
    cell: f64,
    /// The shortest and the longest edges, and the angle in radians that the surface may turn along one.
    edges: (f64, f64, f64),
}

impl Body<'_> {
    /// Polygonizes and unrolls the body; adds the mesh and returns a node that shows it.
    fn add(&self, charts: &[Chart], meshes: &mut Vec<Mesh>) -> Node {
        let sizing = Sizing { finest: self.edges.0, coarsest: self.edges.1, turn: self.edges.2 };
        let mut surface = polygonize(&self.distance, self.bounds, self.cell, sizing);
        let moved = surface.soften();
        let layered = ["tie", "earring"].contains(&self.name);
        let unwrapped = unwrap(&surface, charts, layered);
        let normals = surface.normals(&self.distance, &moved);
        let points = || unwrapped.vertices.iter().map(|v| v.0);
        meshes.push(Mesh {
            name: self.name.to_owned(),
            positions: points().map(|i| surface.points[i].as_vec3().to_array()).collect(),
            normals: points().map(|i| normals[i].as_vec3().to_array()).collect(),
            uvs: unwrapped.vertices.iter().map(|v| v.1.as_vec2().to_array()).collect(),
            indices: unwrapped.faces.iter().flatten().map(|&i| i as u32).collect(),
            material: self.material,
        });
        Node::new(self.name, Some(meshes.len() - 1))
    }
}
