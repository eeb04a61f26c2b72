//! Glyphs become objects beside the scene.

use std::borrow::Cow;

use glam::{DMat4, DVec3, Vec4};

use super::label::label_mesh;
use super::{Anchor, ArrowPath, BoxAround, Glyph, Label, LetterUnit, Shape};
use crate::document::Document;
use crate::geometry::primitives::cube;
use crate::geometry::{Bounds, Mesh, Text, arrow, box_frame};
use crate::scene::additions::{Facing, LetterSize};
use crate::scene::{Addition, Material, Scene, Warning};
use crate::style::{Color, nearest};

/// Points after these are left out.
const MAX_POINTS: usize = 2000;

/// From the middle of the model, in its diagonals.
const FARTHEST: f64 = 1e4;

/// Boxes around more vertices are made of those around meshes.
const MAX_VERTICES: usize = 300_000;

/// Glyphs as objects, one each, in their order; and what could not be drawn as it was meant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shapes {
    /// The objects.
    pub additions: Vec<Addition>,
    /// What a person should know.
    pub warnings: Vec<Warning>,
}

impl Document {
    /// All that [`Self::glyph_shapes`] depends on beside the scene.
    pub fn glyph_inputs(&self) -> (&[Glyph], Color) {
        (&self.glyphs, self.paper())
    }

    /// The glyphs for a scene (without additions) whose meshes have these boxes, each in its own space.
    pub fn glyph_shapes(&self, scene: &Scene, mesh_bounds: &[Bounds]) -> Shapes {
        let (glyphs, paper) = self.glyph_inputs();
        let mut shapes = Shapes::default();
        if glyphs.is_empty() {
            return shapes;
        }
        let mut model = Measures { scene, mesh_bounds, diagonal: 1.0, center: DVec3::ZERO };
        let bounds = model.bounds_of(0..scene.own_nodes().len());
        if bounds.diagonal() > 0.0 {
            (model.diagonal, model.center) = (bounds.diagonal(), bounds.center());
        }
        for glyph in glyphs {
            let mut notes = Vec::new();
            let made = match &glyph.shape {
                Shape::Box(shape) => model.around(shape),
                Shape::Path(shape) => model.path(shape, &mut notes),
                Shape::Label(shape) => model.label(shape, glyph.color, paper, &mut notes),
            };
            let made = made.unwrap_or_else(|fault| {
                notes.push(format!("is not drawn: {fault}"));
                GlyphMesh::default()
            });
            let place = glyph.path();
            shapes
                .warnings
                .extend(notes.into_iter().map(|message| Warning { place: place.clone(), message }));
            let base_color =
                if made.facing.is_some() { Vec4::ONE } else { glyph.color.to_linear().extend(1.0) };
            shapes.additions.push(Addition {
                path: place,
                owner: None,
                mesh: made.mesh,
                world_from_local: DMat4::from_translation(made.origin),
                material: Material { base_color, ..Material::default() },
                facing: made.facing,
            });
        }
        shapes
    }

    /// A scene with the glyphs beside it.
    pub fn scene_with_glyphs<'a>(&self, scene: &'a Scene) -> Cow<'a, Scene> {
        if self.glyphs.is_empty() {
            return Cow::Borrowed(scene);
        }
        let mesh_bounds: Vec<_> = scene.meshes.iter().map(|m| m.bounds()).collect();
        Cow::Owned(scene.with_additions(self.glyph_shapes(scene, &mesh_bounds).additions))
    }

    /// A warning for each glyph that is not drawn, or not as it was meant; `scene`: without additions.
    pub fn glyph_faults(&self, scene: &Scene) -> Vec<Warning> {
        let unreadable = self.unreadable_glyphs.iter().map(|u| Warning {
            place: "a glyph of the document".to_owned(),
            message: format!("is not drawn: {}", u.reason),
        });
        let mesh_bounds: Vec<_> = if self.glyphs.is_empty() {
            Vec::new()
        } else {
            scene.meshes.iter().map(|m| m.bounds()).collect()
        };
        unreadable.chain(self.glyph_shapes(scene, &mesh_bounds).warnings).collect()
    }
}

/// A mesh about a point of the files' coordinates.
#[derive(Default)]
struct GlyphMesh {
    mesh: Mesh,
    origin: DVec3,
    facing: Option<Facing>,
}

/// What glyphs are measured by.
struct Measures<'a> {
    scene: &'a Scene,
    mesh_bounds: &'a [Bounds],
    diagonal: f64,
    center: DVec3,
}

impl Measures<'_> {
    fn bounds_of(&self, nodes: std::ops::Range<usize>) -> Bounds {
        self.scene.nodes.get(nodes).into_iter().flatten().fold(Bounds::EMPTY, |all, node| {
            let own = node.mesh.and_then(|m| self.mesh_bounds.get(m)).copied().unwrap_or(Bounds::EMPTY);
            all.union(&own.transformed(&node.world_from_local))
        })
    }

    /// [`Self::bounds_of`] by every vertex, as far as that is quick: turned objects fill little of their boxes.
    fn close_bounds_of(&self, nodes: std::ops::Range<usize>) -> Bounds {
        let meshes = || {
            let nodes = self.scene.nodes.get(nodes.clone()).unwrap_or_default();
            nodes.iter().filter_map(|n| Some((n.world_from_local, self.scene.meshes.get(n.mesh?)?)))
        };
        if meshes().map(|(_, mesh)| mesh.positions.len()).sum::<usize>() > MAX_VERTICES {
            return self.bounds_of(nodes);
        }
        meshes().fold(Bounds::EMPTY, |all, (place, mesh)| {
            mesh.positions
                .iter()
                .map(|p| place.transform_point3(p.as_dvec3()))
                .fold(all, |all, p| Bounds { min: all.min.min(p), max: all.max.max(p) })
        })
    }

    fn bounds_below(&self, path: &str) -> Result<Bounds, String> {
        let Some(node) = self.scene.find(path) else {
            let similar = nearest(path, self.scene.nodes.iter().map(|n| n.path.as_str()));
            let meant = similar.map_or(String::new(), |n| format!("; did you mean `{n}`?"));
            return Err(format!("the model has no node `{path}`{meant}"));
        };
        let bounds = self.close_bounds_of(self.scene.subtree(node));
        if bounds.is_empty() {
            Err(format!("nothing hangs below `{path}` that can be seen"))
        } else {
            Ok(bounds)
        }
    }

    /// Whether a point is so far away that nothing else would be seen beside it, or nowhere.
    fn is_too_far(&self, point: DVec3) -> bool {
        !point.is_finite() || point.distance(self.center) > FARTHEST * self.diagonal
    }

    fn absolute(&self, thickness: f32) -> f64 {
        f64::from(thickness) / 100.0 * self.diagonal
    }

    fn around(&self, shape: &BoxAround) -> Result<GlyphMesh, String> {
        let thickness = self.absolute(shape.thickness);
        let node = self.bounds_below(&shape.node)?;
        let origin = node.center();
        let margin = DVec3::splat(0.5 * thickness);
        let bounds = Bounds { min: node.min - origin - margin, max: node.max - origin + margin };
        let mesh = if shape.frame {
            box_frame(&bounds, thickness)
        } else {
            let mut mesh = cube(1.0);
            let size = (bounds.max - bounds.min).as_vec3();
            mesh.positions.iter_mut().for_each(|p| *p *= size);
            mesh
        };
        Ok(GlyphMesh { mesh, origin, facing: None })
    }

    fn path(&self, shape: &ArrowPath, notes: &mut Vec<String>) -> Result<GlyphMesh, String> {
        if let Some(number) = shape.points.iter().position(|p| self.is_too_far(*p)) {
            return Err(format!("its point {} is too far from the model", number + 1));
        }
        let count = shape.points.len();
        if count > MAX_POINTS {
            notes.push(format!("has {count} points; only the first {MAX_POINTS} are drawn"));
        }
        let points = shape.points.get(..MAX_POINTS.min(count)).unwrap_or_default();
        let origin = points.iter().fold(DVec3::ZERO, |sum, p| sum + p / points.len() as f64);
        let local: Vec<DVec3> = points.iter().map(|p| p - origin).collect();
        let mesh = arrow(&local, 0.5 * self.absolute(shape.thickness), shape.heads.into());
        if mesh.indices.is_empty() {
            return Err("a path needs two different points".to_owned());
        }
        Ok(GlyphMesh { mesh, origin, facing: None })
    }

    fn label(
        &self,
        shape: &Label,
        ink: Color,
        paper: Color,
        notes: &mut Vec<String>,
    ) -> Result<GlyphMesh, String> {
        let anchor = match &shape.anchor {
            Anchor::Point(point) => *point,
            Anchor::Node(path) => self.bounds_below(path)?.center(),
        };
        if self.is_too_far(anchor) {
            return Err("its point is too far from the model".to_owned());
        }
        let text = Text::new(&shape.text);
        notes.extend(text.fault());
        if text.mesh.indices.is_empty() {
            return Err("it has no text".to_owned());
        }
        let size = f64::from(shape.size);
        let size = match shape.unit {
            LetterUnit::Pixel => LetterSize::ReferencePixels(size),
            LetterUnit::Model => LetterSize::Units(size * 1e-3 * self.diagonal),
        };
        let mesh = label_mesh(shape, &text, ink, paper);
        let facing = Facing { anchor, size, in_front: shape.in_front };
        Ok(GlyphMesh { mesh, origin: anchor, facing: Some(facing) })
    }
}
