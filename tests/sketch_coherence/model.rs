//! A sample model: its exact visible edges, and what the renderer knows of a place on one of them.

use std::path::Path;
use std::sync::Arc;

use glam::{DVec2, DVec3, UVec2, Vec2};
use hachure::document::Document;
use hachure::export::Session;
use hachure::export::session::{Opened, initial_camera};
use hachure::geometry::visible_edges::{EdgeScene, LineRules, PlacedMesh, VisibleSegment};
use hachure::geometry::{Adjacency, Projector};
use hachure::import::{ImportOptions, Progress, load};
use hachure::render::View;
use hachure::render::base::ids::object_id;
use hachure::render::base::object_axes::ObjectAxes;
use hachure::render::passes::offset_field::{GpuFieldObject, NoisePlace};
use hachure::scene::Camera;

/// Pixels per side of the pictures that are measured: one of them is one reference pixel.
pub(crate) const SIDE: u32 = 1080;

/// A model on the device and as edges.
pub(crate) struct Model {
    pub(crate) name: &'static str,
    pub(crate) opened: Opened,
    edges: EdgeScene,
    adjacencies: Vec<Adjacency>,
}

/// A point on a visible edge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Anchor {
    pub(crate) world: DVec3,
    /// Direction of the edge.
    pub(crate) along: DVec3,
    pub(crate) object: u32,
    /// Whether surfaces run through each other there.
    pub(crate) is_crossing: bool,
    /// Where it was seen.
    pub(crate) pixel: DVec2,
    /// Where it lies on a map of the surface that is as large as the surface was seen: what a texture would follow.
    pub(crate) on_map: Option<DVec2>,
}

impl Model {
    /// Loads a sample and puts it on the device.
    pub(crate) fn new(session: &mut Session, name: &'static str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/models/{name}.glb"));
        let scene = Arc::new(load(&path, &ImportOptions::default(), &Progress::default()).unwrap());
        let opened = Opened { document: Document::default(), scene };
        session.set_scene(&opened).unwrap();
        let scene = &opened.scene;
        let adjacencies: Vec<Adjacency> = scene.meshes.iter().map(|mesh| Adjacency::new(mesh)).collect();
        let placed: Vec<PlacedMesh<'_>> = (0..)
            .zip(&scene.nodes)
            .filter_map(|(node, placed)| {
                let mesh = placed.mesh?;
                Some(PlacedMesh {
                    mesh: &scene.meshes[mesh],
                    adjacency: &adjacencies[mesh],
                    world_from_local: placed.world_from_local,
                    object: node,
                })
            })
            .collect();
        Self { name, edges: EdgeScene::new(&placed), opened, adjacencies }
    }

    /// The whole model as it is first seen.
    pub(crate) fn camera(&self) -> Camera {
        initial_camera(&self.opened.document, &self.opened.scene, 1.0)
    }

    pub(crate) fn up(&self) -> DVec3 {
        self.opened.document.up(&self.opened.scene).vector()
    }

    /// What an eye sees of the edges, `step` pixels apart.
    pub(crate) fn anchors(&self, eye: &Eye, step: f64) -> Vec<Anchor> {
        let visible = self.edges.visible(&eye.projector, &LineRules::default());
        let world_from_view = eye.view.view_from_world.inverse();
        let mut anchors = Vec::new();
        // So far along all of them is the next one.
        let mut ahead = 0.5 * step;
        for segment in &visible.segments {
            let [from, to] = segment.places.map(|p| eye.view.view_from_world.transform_point3(p));
            let seen = segment.ends[0].distance(segment.ends[1]);
            while ahead < seen {
                let share = ahead / seen;
                ahead += step;
                let point = from.lerp(to, eye.projector.along_segment([from, to], share));
                let world = world_from_view.transform_point3(point);
                anchors.push(Anchor {
                    world,
                    along: (segment.places[1] - segment.places[0]).normalize_or_zero(),
                    object: object_id(segment.object as usize),
                    is_crossing: segment.edge.is_none(),
                    pixel: segment.ends[0].lerp(segment.ends[1], share),
                    on_map: self.on_map(segment, world),
                });
            }
            ahead -= seen;
        }
        anchors
    }

    /// Where a place on an edge lies on the texture map of its mesh.
    fn on_map(&self, segment: &VisibleSegment, world: DVec3) -> Option<DVec2> {
        let node = &self.opened.scene.nodes[segment.object as usize];
        let mesh = node.mesh?;
        let geometry = &self.opened.scene.meshes[mesh];
        let vertices = self.adjacencies[mesh].edges[segment.edge? as usize].vertices.map(|v| v as usize);
        let [from, to] =
            vertices.map(|v| node.world_from_local.transform_point3(geometry.positions[v].as_dvec3()));
        let [a, b] = vertices.map(|v| geometry.uvs.get(v));
        let on_edge = world.distance(from) / from.distance(to);
        Some(a?.lerp(*b?, on_edge as f32).as_dvec2())
    }

    /// Pixels per unit of an object's texture map, where it is seen: the median over its edges.
    pub(crate) fn map_scale(&self, eye: &Eye, object: u32) -> Option<f64> {
        let node = &self.opened.scene.nodes[object as usize - 1];
        let mesh = node.mesh?;
        let geometry = &self.opened.scene.meshes[mesh];
        let mut scales: Vec<f64> = self.adjacencies[mesh]
            .edges
            .iter()
            .filter_map(|edge| {
                let [a, b] = edge.vertices.map(|v| v as usize);
                let apart = geometry.uvs.get(a)?.distance(*geometry.uvs.get(b)?);
                let [p, q] = [a, b].map(|v| {
                    let world = node.world_from_local.transform_point3(geometry.positions[v].as_dvec3());
                    let view = eye.view.view_from_world.transform_point3(world);
                    (view, world)
                });
                let pixel = eye.pixel_at(-0.5 * (p.0.z + q.0.z));
                (apart > 0.0 && pixel > 0.0).then(|| p.1.distance(q.1) / pixel / f64::from(apart))
            })
            .collect();
        scales.sort_by(f64::total_cmp);
        scales.get(scales.len() / 2).copied()
    }
}

/// A camera and what sketches know of it.
pub(crate) struct Eye {
    pub(crate) camera: Camera,
    pub(crate) view: View,
    pub(crate) projector: Projector,
    /// Pixels per side of its picture.
    pub(crate) side: u32,
    objects: Vec<GpuFieldObject>,
}

/// A place on a line as an eye sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spot {
    pub(crate) place: NoisePlace,
    pub(crate) pixel: DVec2,
}

impl Eye {
    pub(crate) fn new(session: &mut Session, camera: Camera, side: u32) -> Self {
        let scene = session.renderer().scene().unwrap();
        let bounds = scene.scene.bounds();
        let view = View::new(&camera, &bounds, UVec2::splat(side));
        // Rays want an end.
        let far = camera.position.distance(bounds.center()) + bounds.diagonal();
        let objects = (0..=scene.scene.nodes.len() as u32)
            .map(|id| {
                let axes = ObjectAxes::of(scene, id, &view);
                axes.map_or_else(GpuFieldObject::default, |axes| GpuFieldObject {
                    from_view: axes.from_view.as_mat4(),
                    seed: id,
                })
            })
            .collect();
        Self { camera, projector: Projector { far, ..view.projector() }, view, side, objects }
    }

    pub(crate) fn object(&self, id: u32) -> &GpuFieldObject {
        &self.objects[id as usize]
    }

    fn pixel_at(&self, depth: f64) -> f64 {
        2.0 * f64::from(self.view.half_extent.y) / f64::from(self.side) * depth
    }

    /// A point of a line as the shader finds it again, from its pixel and its depth; `None`: it is not in the picture.
    pub(crate) fn spot(&self, world: DVec3, along: DVec3) -> Option<Spot> {
        self.seen_or_not(world, along)
            .filter(|spot| spot.pixel.min_element() >= 0.0 && spot.pixel.max_element() < f64::from(self.side))
    }

    /// The same for all that lies before the eye.
    pub(crate) fn seen_or_not(&self, world: DVec3, along: DVec3) -> Option<Spot> {
        let view = self.view.view_from_world.transform_point3(world);
        let depth = -view.z;
        if depth <= self.projector.near {
            return None;
        }
        let pixel = self.projector.pixel(view);
        // Length on paper of what would be as long if it faced the eye.
        let along = self.view.view_from_world.transform_vector3(along);
        let shortened = (along.truncate() + view.truncate() / depth * along.z).length();
        let foreshortening = shortened.recip().clamp(1.0, 4.0) as f32;
        Some(Spot { place: self.place(pixel, depth as f32, foreshortening), pixel })
    }

    /// What a pixel of this depth shows, as the shader finds it.
    pub(crate) fn place(&self, pixel: DVec2, depth: f32, foreshortening: f32) -> NoisePlace {
        let ndc = pixel.as_vec2() / self.side as f32 * Vec2::new(2.0, -2.0) + Vec2::new(-1.0, 1.0);
        let at = ndc * self.view.half_extent * depth;
        NoisePlace {
            at: at.extend(-depth),
            pixel: 2.0 * self.view.half_extent.y / self.side as f32 * depth,
            foreshortening,
        }
    }
}
