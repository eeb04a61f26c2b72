//! Which objects are drawn, and in which groups: styles and roles of a document, resolved for one picture.

use glam::DMat4;

use crate::document::{Document, Resolved, Show};
use crate::geometry::{Bounds, EdgeClass};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::gpu_scene::GpuScene;
use crate::render::base::group::{Group, Submeshes, Visible, box_of};
use crate::render::base::ids::object_id;
use crate::render::base::stripes::StripesBy;
use crate::render::base::stroke_maps::StrokeMaps;
use crate::render::base::style_images::StyleImages;
use crate::render::effects::blueprint::BlueprintGroup;
use crate::render::effects::hidden::Hidden;
use crate::render::effects::mirror::MirrorObject;
use crate::render::effects::sketch::SketchGroup;
use crate::render::effects::surface::SurfaceStyles;
use crate::render::effects::technique::Styled;
use crate::scene::{AlphaMode, NodeId};
use crate::style::Technique;

/// Everything that is visible, resolved for one frame.
#[derive(Clone, PartialEq, Default)]
pub struct Objects {
    /// The objects that hide what lies behind them: those of all surface techniques.
    pub surfaces: Group,
    /// Those of them that layers of blueprints are drawn to uncover; they have no lines of their own here.
    pub masks: Group,
    /// Their hidden lines.
    pub hidden: Hidden,
    /// Objects of the same techniques that are drawn as by hand, together where that is equal; they hide what lies behind them.
    pub sketches: Vec<SketchGroup>,
    /// Parts of the same techniques through which something shows.
    pub blended: Group,
    /// The others, together where their style is equal.
    pub blueprints: Vec<BlueprintGroup>,
    /// The box around everything visible, world space.
    pub visible_bounds: Bounds,
    /// How surfaces are shaded.
    pub styles: SurfaceStyles,
    /// The mirrors among them.
    pub mirrors: Vec<MirrorObject>,
    /// Pixels per reference pixel.
    pub scale: f32,
}

impl Objects {
    /// Resolves styles and roles of a document for the nodes of a scene; `scale`: pixels per reference pixel; `is_single`: whether
    /// the picture has one sample only.
    pub fn new(
        document: &Document,
        scene: &GpuScene,
        images: &StyleImages,
        strokes: &StrokeMaps,
        scale: f32,
        is_single: bool,
    ) -> Self {
        let stripes = StripesBy::new(document, &scene.scene);
        let resolved = document.resolve(&scene.scene);
        // What is not drawn, entry 0 (the background) included, has neither shading nor lines.
        let count = resolved.len() + 1;
        let (surfaces, styles) = (Group::new(count), SurfaceStyles::new(count));
        let mut objects = Self { scale, surfaces, styles, ..Self::default() };
        for (node, r) in resolved.iter().enumerate() {
            if !r.visible || scene.scene.nodes[node].mesh.is_none() || scene.is_clipped_away(node) {
                continue;
            }
            let id = object_id(node) as usize;
            objects.styles.add(&Styled {
                id,
                count,
                node,
                style: r.style,
                scene,
                images,
                strokes,
                stripes,
                scale,
                is_single,
            });
            objects.add(node, r, scene, images, document.view.show == Show::Picture);
        }
        objects
    }

    /// Adds an object to the groups that draw it. `as_picture`: otherwise a buffer is looked at (`view.show`), which is that of
    /// opaque surfaces: every object is drawn as such.
    fn add(
        &mut self,
        node: NodeId,
        r: &Resolved<'_>,
        scene: &GpuScene,
        images: &StyleImages,
        as_picture: bool,
    ) {
        let (scale, id, count) = (self.scale, object_id(node), scene.scene.nodes.len() + 1);
        let has_layers = r.style.technique == Technique::Blueprint && as_picture;
        let is_blueprint = has_layers && !r.mask;
        let is_sketch = as_picture && !has_layers && !r.mirror && SketchGroup::moves(r.style);
        // Mirrors and masks show and hide as a whole.
        let blends = as_picture && !has_layers && !r.mask && !r.mirror && !is_sketch;
        let is_blended = |alpha: AlphaMode| blends && alpha == AlphaMode::Blend;
        let has_blended = scene.alphas(node).any(is_blended);
        let is_opaque = !has_blended || !scene.alphas(node).all(is_blended);
        if has_blended && self.blended.is_empty() {
            self.blended = Group::unculled(count);
        }
        // The width of lines that are nowhere would decide how all others are drawn; and what is only shaded smoothly has
        // no relief.
        let possible = |edges: GpuEdgeStyle| {
            let edges = if scene.is_sectioned(node) { edges } else { edges.without(EdgeClass::Section) };
            if scene.has_relief(node) { edges } else { edges.without(EdgeClass::Relief) }
        };
        let edges = possible(GpuEdgeStyle::new(&r.style.edges, scale));
        let edges = if has_layers { edges.inked(&r.style.edges, r.style.blueprint.near) } else { edges };
        let edges = if has_layers { edges.without_fainter(r.style.blueprint.threshold) } else { edges };
        let whole = Visible { node, enhanced: r.enhanced, submeshes: Submeshes::All };
        if is_blueprint {
            let group = BlueprintGroup::group_of(&mut self.blueprints, r.style, count);
            group.add(whole, edges, scene);
        } else if is_sketch {
            let sketch = SketchGroup::group_of(&mut self.sketches, r.style, count, images, scale);
            sketch.group.add(whole, edges, scene);
            sketch.add_alphas(scene.alphas(node));
            if r.enhanced {
                let style = possible(GpuEdgeStyle::of_hidden_lines(&r.style.edges, scale));
                sketch.hidden.add(count, id, &style, &r.style.edges.hidden);
            }
        } else if is_opaque {
            let submeshes = if has_blended { Submeshes::Opaque } else { Submeshes::All };
            self.surfaces.add(Visible { submeshes, ..whole }, edges, scene);
            if r.enhanced && as_picture {
                let style = possible(GpuEdgeStyle::of_hidden_lines(&r.style.edges, scale));
                self.hidden.add(count, id, &style, &r.style.edges.hidden);
            }
        }
        if has_blended {
            let submeshes = if is_opaque { Submeshes::Blended } else { Submeshes::All };
            self.blended.add(Visible { submeshes, ..whole }, edges, scene);
        }
        if r.mask {
            self.masks.add_without_lines(whole);
        }
        if r.mirror
            && !is_blueprint
            && !scene.scene.is_added(node)
            && let Ok(plane) = scene.plane_of(node)
        {
            self.mirrors.push(MirrorObject::new(id, plane, scene.corners_of(node), &r.style.mirror));
        }
        self.visible_bounds = self.visible_bounds.union(&scene.bounds_of(node));
    }

    /// All visible objects.
    fn groups(&self) -> impl Iterator<Item = &Group> {
        let sketches = self.sketches.iter().map(|s| &s.group);
        let blueprints = self.blueprints.iter().map(|b| &b.group);
        [&self.surfaces, &self.blended].into_iter().chain(sketches).chain(blueprints)
    }

    /// The groups that hide what lies behind them.
    pub fn opaque(&self) -> Vec<&Group> {
        std::iter::once(&self.surfaces).chain(self.sketches.iter().map(|s| &s.group)).collect()
    }

    /// Greatest distance from its edge at which a line has ink, px.
    pub fn greatest_reach(&self) -> f32 {
        let sketches = self.sketches.iter().map(SketchGroup::greatest_reach);
        let groups = self.groups().map(Group::greatest_reach);
        groups.chain(sketches).fold(self.hidden.greatest_radius(), f32::max)
    }

    /// The boxes of the enhanced objects, each in its own space, and where that lies.
    pub fn enhanced_boxes<'a>(&'a self, scene: &'a GpuScene) -> impl Iterator<Item = (Bounds, DMat4)> + 'a {
        let enhanced = self.groups().flat_map(Group::visible).filter(|object| object.enhanced);
        enhanced.filter_map(|object| box_of(object.node, scene))
    }
}
