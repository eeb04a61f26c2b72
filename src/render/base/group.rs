//! Objects that are drawn together, and their submeshes that are drawn.

use glam::{DMat4, Mat3, Mat4};

use super::edge_style::GpuEdgeStyle;
use super::edge_styles::EdgeStyles;
use super::gpu_scene::{GpuScene, Origin};
use super::ids::{ENHANCED, object_id};
use super::instances::{Detail, DrawCall, Instance};
use super::stroke_style::StrokeStyle;
use super::view::View;
use crate::geometry::Bounds;
use crate::gpu::material::MaterialUniform;
use crate::scene::{AlphaMode, NodeId};

/// The triangles of a visible object that have one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VisibleSubmesh {
    /// The object.
    pub node: NodeId,
    /// Whether its edges are drawn.
    pub enhanced: bool,
    /// Whether its mesh has no normals, so that faces are flat.
    pub is_flat: bool,
    /// Whether its vertices have colors.
    pub has_colors: bool,
    /// The box around its mesh, local space.
    pub bounds: Bounds,
    /// Its surfaces have smaller numbers than this.
    pub surfaces: u32,
    /// Local to world space.
    pub world_from_local: DMat4,
    /// Number of its material; none has that of a cap.
    pub material: usize,
    /// Whether all of its object is drawn together with it.
    pub is_whole: bool,
    /// The buffers that hold it.
    pub origin: Origin,
    /// Range of the index buffer.
    pub first_index: u32,
    /// Number of indices.
    pub index_count: u32,
    /// Number of its first triangle in its mesh.
    pub first_triangle: u32,
    /// First vertex of the mesh.
    pub base_vertex: i32,
}

/// An object in a group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Visible {
    /// The object.
    pub node: NodeId,
    /// Whether its edges are drawn.
    pub enhanced: bool,
    /// Which of its parts are in the group.
    pub submeshes: Submeshes,
}

/// Which parts of an object are in a group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Submeshes {
    /// All of them.
    All,
    /// Those through which nothing shows.
    Opaque,
    /// The others.
    Blended,
}

impl Visible {
    /// Whether all of its parts are in the group.
    pub fn is_whole(&self) -> bool {
        self.submeshes == Submeshes::All
    }

    fn has(&self, material: usize, scene: &GpuScene) -> bool {
        let blends = scene.alpha(material) == AlphaMode::Blend;
        let is_in = match self.submeshes {
            Submeshes::All => true,
            Submeshes::Opaque => !blends,
            Submeshes::Blended => blends,
        };
        // Nothing is left of what has no opacity at all.
        is_in && !(blends && scene.scene.materials.get(material).is_some_and(|m| m.base_color.w <= 0.0))
    }
}

impl VisibleSubmesh {
    /// Which side of its triangles nobody can see.
    pub fn culled_face(
        &self,
        scene: &GpuScene,
        view_from_local: &DMat4,
        orthographic: bool,
    ) -> Option<wgpu::Face> {
        // A cap closes what is cut open, whatever the side that it is seen from.
        let culled = || scene.culled_face(self.node, view_from_local, orthographic);
        (self.origin != Origin::Caps && self.is_whole).then(culled).flatten()
    }

    /// What it is made of; a cap of the section's color.
    pub fn material(&self, scene: &GpuScene) -> MaterialUniform {
        let own = scene.materials.uniform(self.material);
        match (self.origin, &scene.section) {
            (Origin::Caps, Some(section)) => own.with_color(section.style.color.to_linear()),
            _ => own,
        }
    }
}

/// Objects that are drawn together.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Group {
    visible: Vec<Visible>,
    /// How the lines of its objects look; others have none.
    pub edge_styles: EdgeStyles,
    /// Whether any object with lines has holes by alpha.
    pub has_holes: bool,
    /// Whether what faces away from the eye or lies behind a solid's front is drawn too.
    pub is_unculled: bool,
    /// How straight lines are drawn, unless the group is cut into layers; `None`: as they are.
    pub strokes: Option<StrokeStyle>,
}

impl Group {
    /// Nothing of a scene with so many object ids; nothing is culled.
    pub fn unculled(count: usize) -> Self {
        Self { is_unculled: true, ..Self::new(count) }
    }

    /// Nothing of a scene with so many object ids.
    pub fn new(count: usize) -> Self {
        Self { edge_styles: EdgeStyles::new(count), ..Self::default() }
    }

    /// The same with straight lines drawn by a hand.
    #[must_use]
    pub fn with_strokes(self, strokes: Option<StrokeStyle>) -> Self {
        Self { strokes, ..self }
    }

    /// Adds an object of which the lines are of no interest.
    pub fn add_without_lines(&mut self, object: Visible) {
        self.visible.push(object);
    }

    /// Adds an object with its lines.
    pub fn add(&mut self, object: Visible, edges: GpuEdgeStyle, scene: &GpuScene) {
        self.visible.push(object);
        if object.enhanced {
            self.edge_styles.set(object_id(object.node), &edges);
            self.has_holes |= scene.has_holes(object.node);
        }
    }

    /// The same objects, nothing culled, with lines by object id.
    pub fn unculled_with_lines(&self, edge_styles: &EdgeStyles) -> Self {
        Self { edge_styles: edge_styles.clone(), is_unculled: true, ..self.clone() }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.visible.is_empty()
    }

    /// Whether any of them has lines.
    pub fn have_lines(&self) -> bool {
        self.edge_styles.styles().iter().any(|s| s.is_exact() || s.is_image_space())
    }

    /// Greatest distance from its spine at which a line has ink, px.
    pub fn greatest_radius(&self) -> f32 {
        self.edge_styles.greatest_radius()
    }

    /// Greatest distance from its edge at which a line has ink, px.
    pub fn greatest_reach(&self) -> f32 {
        self.greatest_radius() + self.strokes.map_or(0.0, |StrokeStyle(hand)| hand.reach() as f32)
    }

    /// The visible objects.
    pub fn visible(&self) -> &[Visible] {
        &self.visible
    }

    /// The boxes of all visible objects, each in its own space, and where that lies.
    pub fn boxes<'a>(&'a self, scene: &'a GpuScene) -> impl Iterator<Item = (Bounds, DMat4)> + 'a {
        self.visible.iter().filter_map(|object| box_of(object.node, scene))
    }

    /// The rectangle of the picture that they and their lines cover at most: left, top, right and bottom edge in pixels.
    pub fn scissor_rect(&self, scene: &GpuScene, view: &View) -> [u32; 4] {
        let margin = self.greatest_reach();
        let boxes = self.boxes(scene).filter(|(bounds, _)| !bounds.is_empty());
        let rects = boxes.filter_map(|(bounds, place)| {
            view.rect_of(&bounds.corners().map(|corner| place.transform_point3(corner)), margin)
        });
        let [width, height] = view.size.to_array();
        let [left, top, right, bottom] = view.scissor_rect.unwrap_or([0, 0, width, height]);
        let [x0, y0, x1, y1] = rects.fold([right, bottom, left, top], |a, b| {
            [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
        });
        let [x1, y1] = [x1.min(right), y1.min(bottom)];
        [x0.max(left).min(x1), y0.max(top).min(y1), x1, y1]
    }

    /// The parts of all visible objects, and the caps of those that are cut open.
    pub fn submeshes<'a>(&'a self, scene: &'a GpuScene) -> impl Iterator<Item = VisibleSubmesh> + 'a {
        self.submeshes_of_meshes(scene).chain(self.caps(scene))
    }

    fn caps<'a>(&'a self, scene: &'a GpuScene) -> impl Iterator<Item = VisibleSubmesh> + 'a {
        scene.section.iter().flat_map(move |section| {
            self.visible.iter().filter(|object| object.submeshes != Submeshes::Blended).filter_map(
                move |object| {
                    let Visible { node, enhanced, .. } = *object;
                    let sectioned = section.sectioned(node)?;
                    let cap = sectioned.cap?;
                    Some(VisibleSubmesh {
                        node,
                        enhanced,
                        bounds: cap.bounds,
                        surfaces: cap.surface + 1,
                        is_flat: true,
                        has_colors: false,
                        world_from_local: section.world_from_cap(sectioned),
                        material: usize::MAX,
                        is_whole: true,
                        origin: Origin::Caps,
                        first_index: cap.range.first_index,
                        index_count: cap.index_count,
                        first_triangle: 0,
                        base_vertex: cap.range.base_vertex,
                    })
                },
            )
        })
    }

    fn submeshes_of_meshes<'a>(&'a self, scene: &'a GpuScene) -> impl Iterator<Item = VisibleSubmesh> + 'a {
        self.visible.iter().flat_map(move |object| {
            let Visible { node: id, enhanced, .. } = *object;
            let node = &scene.scene.nodes[id];
            let found = node.mesh.and_then(|m| Some((m, scene.scene.meshes.get(m)?, scene.range_of(m)?)));
            found.into_iter().flat_map(move |(mesh, source, (origin, range))| {
                let submeshes = source.submeshes.iter().filter(|submesh| object.has(submesh.material, scene));
                submeshes.map(move |submesh| VisibleSubmesh {
                    node: id,
                    enhanced,
                    bounds: scene.mesh_bounds(mesh),
                    surfaces: source.triangle_count() as u32,
                    is_flat: source.normals.is_empty(),
                    has_colors: !source.colors.is_empty(),
                    world_from_local: node.world_from_local,
                    material: submesh.material,
                    is_whole: object.is_whole(),
                    origin,
                    first_index: range.first_index + submesh.first_index,
                    index_count: submesh.index_count,
                    first_triangle: submesh.first_index / 3,
                    base_vertex: range.base_vertex,
                })
            })
        })
    }

    /// What the G-buffer depends on: for each visible part its matrices, object and material, ordered by pipeline.
    pub fn instances(&self, scene: &GpuScene, view: &View) -> (Vec<Instance>, Vec<DrawCall>) {
        let mut instances = Vec::new();
        let mut calls = Vec::new();
        for submesh in self.submeshes(scene) {
            // Combined in double precision, so that models far from the origin do not jitter.
            let view_from_local = view.view_from_world * submesh.world_from_local;
            // What faces the eye does not face its mirror images.
            if view.clip_plane.is_some() && scene.scene.facing_of(submesh.node).is_some() {
                continue;
            }
            let corners = submesh.bounds.corners().map(|corner| view_from_local.transform_point3(corner));
            if view.is_clipped() && view.clips_away(&corners) {
                continue;
            }
            let material = scene.scene.materials.get(submesh.material);
            let alpha = scene.alpha(submesh.material);
            let has_images =
                material.is_some_and(|m| m.base_color_texture.is_some() || m.normal_texture.is_some());
            let depth = corners.iter().map(|corner| -corner.z).fold(f64::INFINITY, f64::min);
            let call = DrawCall {
                instance: instances.len() as u32,
                origin: submesh.origin,
                first_index: submesh.first_index,
                index_count: submesh.index_count,
                surfaces: submesh.surfaces,
                base_vertex: submesh.base_vertex,
                material_group: scene.materials.group_index(submesh.material),
                detail: if scene.geometry(submesh.origin).attributes.is_none() {
                    Detail::Lean
                } else if has_images || alpha != AlphaMode::Opaque {
                    Detail::Full
                } else if submesh.has_colors {
                    Detail::Colored
                } else {
                    Detail::Smooth
                },
                culled_face: if alpha == AlphaMode::Opaque && !self.is_unculled {
                    submesh.culled_face(scene, &view_from_local, view.orthographic)
                } else {
                    None
                },
                extent: view.extent_of(&corners),
            };
            calls.push((depth, call));
            let instance = Instance {
                view_from_local: view_from_local.as_mat4(),
                normal_from_local: normal_matrix(&view_from_local),
                object: object_id(submesh.node) | if submesh.enhanced { ENHANCED } else { 0 },
                material: submesh.material(scene),
                is_flat: submesh.is_flat,
                first_surface: 0,
                first_triangle: submesh.first_triangle,
                enlarged: 0.0,
            };
            instances.push(instance);
        }
        // Near ones first: what lies behind them is then never shaded.
        calls.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        calls.sort_by_key(|(_, c)| (c.origin, c.detail, c.culled_face.map(|s| s as u32)));
        let calls: Vec<DrawCall> = calls.into_iter().map(|(_, call)| call).collect();
        // 0 is left for nothing.
        let mut first_surface = 1_u32;
        for call in &calls {
            if let Some(instance) = instances.get_mut(call.instance as usize) {
                instance.first_surface = first_surface;
                first_surface = first_surface.saturating_add(call.surfaces);
            }
        }
        (instances, calls)
    }
}

/// The box of an object in its own space, and where that lies; `None` for what faces the eye, which lies elsewhere for
/// each.
pub fn box_of(node: NodeId, scene: &GpuScene) -> Option<(Bounds, DMat4)> {
    if scene.scene.facing_of(node).is_some() {
        return None;
    }
    let node = &scene.scene.nodes[node];
    Some((scene.mesh_bounds(node.mesh?), node.world_from_local))
}

/// The cofactor matrix of the linear part: the inverse transpose up to a factor, which exists for flattening
/// transforms too; its sign is that of the determinant, so mirrored normals still point outwards.
fn normal_matrix(view_from_local: &DMat4) -> Mat3 {
    let m = view_from_local;
    let (x, y, z) = (m.x_axis.truncate(), m.y_axis.truncate(), m.z_axis.truncate());
    let sign = x.dot(y.cross(z)).signum();
    let cofactors = glam::DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
    let scale = cofactors.to_cols_array().iter().fold(0.0f64, |m, c| m.max(c.abs()));
    if scale > 0.0 { (cofactors * scale.recip()).as_mat3() } else { Mat3::from_mat4(Mat4::IDENTITY) }
}
