//! Rings on which pictures are taken: of several in company, and of each alone.

use std::sync::Arc;

use glam::{DMat4, DVec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::Mesh;
use hachure::scene::{AlphaMode, Camera, NodeId};

use super::SIDE;
use super::common;
use super::looks::{GLASS, Kind, Look};
use super::picture::Picture;
use super::places::Links;

/// A ring; its node has the same number.
#[derive(Debug, Clone)]
pub struct Ring {
    pub look: Look,
    pub place: usize,
}

/// Rings that may be seen together.
pub struct Stage {
    pub rings: Vec<Ring>,
    pub links: Links,
    opened: Opened,
}

/// Names of the cameras.
pub const CAMERAS: [&str; 6] =
    ["front", "right", "above", "front parallel", "right parallel", "above parallel"];

/// A color of its own for each place.
fn color(place: usize, of: usize) -> [f32; 3] {
    let turn = place as f32 / of as f32;
    [0.0, 1.0, 2.0].map(|i| 0.5 + 0.4 * ((turn + i / 3.0) * std::f32::consts::TAU).cos())
}

/// Objects of a mesh each, of which some blend.
fn opened(objects: Vec<(Mesh, DMat4, [f32; 3], bool)>) -> Opened {
    let names: Vec<String> = (0..objects.len()).map(|i| format!("ring {i}")).collect();
    let blends: Vec<bool> = objects.iter().map(|(.., blends)| *blends).collect();
    let objects =
        names.iter().zip(objects).map(|(name, (mesh, place, color, _))| (name.as_str(), mesh, place, color));
    let mut scene = Arc::unwrap_or_clone(common::scene(objects.collect()));
    for (material, _) in scene.materials.iter_mut().zip(blends).filter(|(_, blends)| *blends) {
        material.base_color.w = GLASS;
        material.alpha = AlphaMode::Blend;
    }
    common::opened(&Arc::new(scene), DVec3::Z)
}

impl Stage {
    /// Rings of such looks at such places.
    pub fn new(links: Links, rings: Vec<(Look, usize)>) -> Self {
        let rings: Vec<_> = rings.into_iter().map(|(look, place)| Ring { look, place }).collect();
        let of = links.places.len();
        let object = |Ring { look, place }: &Ring| {
            (links.mesh.clone(), links.places[*place], color(*place, of), look.kind == Kind::Glass)
        };
        let mut opened = opened(rings.iter().map(object).collect());
        for (node, ring) in rings.iter().enumerate() {
            opened.document.set_style(&opened.scene, &[node], &ring.look.style);
        }
        Self { rings, links, opened }
    }

    /// Sets a parameter of the view.
    pub fn set(&mut self, key: &str, value: &str) {
        common::set(&mut self.opened, key, value);
    }

    /// A camera by its number.
    pub fn camera(&self, number: usize) -> Camera {
        let towards = [DVec3::new(0.2, 0.35, 1.0), DVec3::new(1.0, 0.5, 0.3), DVec3::new(-0.4, 1.0, 0.5)];
        let camera = Camera::looking_from(towards[number % 3], DVec3::Y, &self.opened.scene.extent(), 1.0);
        camera.with_orthographic(number >= 3)
    }

    /// Makes it what pictures are taken of.
    pub fn enter(&self, session: &mut Session) {
        session.set_scene(&self.opened).unwrap();
    }

    /// The picture of some of the rings and of nothing else, with their looks as `changed` gives them.
    pub fn picture(
        &self,
        session: &mut Session,
        camera: Camera,
        nodes: &[NodeId],
        changed: impl Fn(Look) -> Look,
    ) -> Picture {
        let mut opened = self.opened.clone();
        for (node, ring) in self.rings.iter().enumerate() {
            let settings = opened.document.node_mut(&opened.scene.nodes[node].path);
            settings.visible = Some(nodes.contains(&node));
            settings.style = Some(changed(ring.look.clone()).style);
        }
        draw(session, opened, camera)
    }

    /// Pictures of parts of a ring's surface as if they hid what lies behind them: of triangle `i` those of the part
    /// `part_of[i]`.
    pub fn pictures_of_parts(
        &self,
        session: &mut Session,
        camera: Camera,
        node: NodeId,
        part_of: &[usize],
    ) -> Vec<Picture> {
        let Ring { look, place } = &self.rings[node];
        let parts = part_of.iter().max().map_or(0, |most| most + 1);
        let object = |part: usize| {
            let mut mesh = self.links.mesh.clone();
            let triangles = mesh.indices.chunks_exact(3).zip(part_of).filter(|(_, of)| **of == part);
            mesh.indices = triangles.flat_map(|(corners, _)| corners.to_vec()).collect();
            mesh.submeshes[0].index_count = mesh.indices.len() as u32;
            (mesh, self.links.places[*place], color(*place, self.links.places.len()), false)
        };
        let mut scene = opened((0..parts).map(object).collect());
        scene.document.style = look.clone().without_lines().style;
        session.set_scene(&scene).unwrap();
        let pictures = (0..parts).map(|part| {
            let mut opened = scene.clone();
            for other in (0..parts).filter(|other| *other != part) {
                opened.document.node_mut(&opened.scene.nodes[other].path).visible = Some(false);
            }
            draw(session, opened, camera)
        });
        let pictures = pictures.collect();
        self.enter(session);
        pictures
    }
}

fn draw(session: &mut Session, mut opened: Opened, camera: Camera) -> Picture {
    opened.document.camera = Some(camera);
    session.image(&opened, [SIDE; 2], true).unwrap().into()
}
