//! Objects that are drawn as by hand together.

use glam::Vec2;

use super::images::SketchPaper;
use super::uniforms::{self, SketchObject};
use crate::render::base::group::Group;
use crate::render::base::ids::object_id;
use crate::render::base::object_axes::ObjectAxes;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stroke_style::StrokeStyle;
use crate::render::base::style_images::StyleImages;
use crate::render::effects::hidden::Hidden;
use crate::render::passes::line_distance::Widths;
use crate::render::passes::moved_edges::MovementUniform;
use crate::render::passes::offset_field::{FieldUniform, GpuFieldObject};
use crate::scene::AlphaMode;
use crate::style::sketch::{Anchor, Exterior};
use crate::style::{self, Style, Technique};

/// Objects that are drawn as by hand in one way, together.
#[derive(Clone, PartialEq)]
pub struct SketchGroup {
    /// The objects.
    pub group: Group,
    /// Their hidden lines.
    pub hidden: Hidden,
    pub(super) style: style::Sketch,
    pub(super) paper: SketchPaper,
    /// Whether something shows through any of them.
    pub(super) blends: bool,
    /// Pixels per reference pixel.
    pub(super) scale: f32,
}

impl SketchGroup {
    /// Whether a style is drawn as by hand; one that moves and roughens nothing is not.
    pub fn moves(style: &Style) -> bool {
        let sketch = &style.sketch;
        let style::sketch::Sketch { wander, passes, pass, fill, grain, strokes, .. } = sketch;
        let still = style::Sketch::default();
        let is_still = |matrix: style::Matrix| wander.amount <= 0.0 || matrix == style::Matrix::ZERO;
        let is_plain_pass = |pass: &style::sketch::Pass| {
            is_still(pass.matrix) && pass.color.is_none() && pass.relative_width == 1.0 && pass.opacity == 1.0
        };
        let is_plain_fill = fill.show
            && is_still(fill.matrix)
            && (fill.opacity, fill.tone, fill.object_color, fill.strokes) == (1.0, still.fill.tone, 1.0, 0.0);
        let is_plain_grain = grain.amount <= 0.0 && grain.roughness <= 0.0 && grain.smudge <= 0.0;
        let is_plain = *passes == 1
            && is_plain_pass(&pass[0])
            && is_plain_fill
            && is_plain_grain
            && wander.pressure <= 0.0
            && !strokes.enabled;
        sketch.enabled && style.technique != Technique::Blueprint && !is_plain
    }

    /// The sketch to which an object of this style belongs, in a scene with `count` object ids; `scale`: pixels per reference
    /// pixel.
    pub fn group_of<'a>(
        all: &'a mut Vec<Self>,
        style: &Style,
        count: usize,
        images: &StyleImages,
        scale: f32,
    ) -> &'a mut Self {
        let found = all.iter().position(|sketch| sketch.style == style.sketch);
        let index = found.unwrap_or(all.len());
        if found.is_none() {
            let strokes = StrokeStyle::new(&style.sketch.strokes, style.sketch.wander.seed, scale);
            all.push(Self {
                group: Group::new(count).with_strokes(strokes),
                hidden: Hidden::default(),
                style: style.sketch.clone(),
                paper: SketchPaper::of(&style.sketch, images),
                blends: false,
                scale,
            });
        }
        &mut all[index]
    }

    /// Tells it what an object that was added is made of.
    pub fn add_alphas(&mut self, mut alphas: impl Iterator<Item = AlphaMode>) {
        self.blends |= alphas.any(|alpha| alpha == AlphaMode::Blend);
    }

    /// Greatest distance from where it belongs at which anything is drawn, px.
    pub fn greatest_reach(&self) -> f32 {
        let [lines, fill] = uniforms::reaches(&self.style, self.scale);
        (self.group.greatest_reach() * self.widest() + lines).max(fill)
    }

    fn widest(&self) -> f32 {
        self.passes().iter().map(uniforms::width).fold(1.0, f32::max)
    }

    /// How often lines are drawn, and how.
    pub(super) fn passes(&self) -> &[style::sketch::Pass] {
        let all = &self.style.pass;
        let count = (self.style.passes as usize).clamp(1, all.len());
        all.get(..count).unwrap_or(all)
    }

    /// Whether noise beyond outlines is that of enlarged surfaces.
    pub(super) fn is_enlarged(&self) -> bool {
        self.style.wander.exterior == Exterior::Enlarged && !self.is_on_screen()
    }

    /// Whether noise is that of the picture.
    pub(super) fn is_on_screen(&self) -> bool {
        self.style.wander.anchor == Anchor::Screen
    }

    /// Whether anything of the tile of paper is seen.
    pub(super) fn has_paper(&self) -> bool {
        let style::Sketch { fill, grain, .. } = &self.style;
        grain.amount > 0.0 || grain.roughness > 0.0 || fill.strokes > 0.0
    }

    /// What noise depends on.
    pub(super) fn field(&self) -> FieldUniform {
        uniforms::field(&self.style, self.scale)
    }

    /// How noise is found for each of its objects, and where their middles are.
    pub(super) fn objects(&self, scene_view: &SceneView<'_>) -> (Vec<GpuFieldObject>, Vec<SketchObject>) {
        let count = self.group.edge_styles.count();
        let mut fields = vec![GpuFieldObject::default(); count];
        let mut places = vec![SketchObject::default(); count];
        // The noise does not shake with the samples of a picture.
        let view = scene_view.view.moved(Vec2::ZERO);
        let projector = view.projector();
        for object in self.group.visible() {
            let id = object_id(object.node);
            let Some(axes) = ObjectAxes::of(scene_view.scene, id, &view) else { continue };
            let (Some(field), Some(place)) = (fields.get_mut(id as usize), places.get_mut(id as usize))
            else {
                continue;
            };
            field.from_view = axes.from_view.as_mat4();
            field.seed = if self.style.wander.by_object { id } else { 0 };
            let middle = projector.pixel(axes.middle);
            place.middle = if middle.is_finite() { middle.as_vec2() } else { Vec2::ZERO };
        }
        (fields, places)
    }

    /// How a pass moves lines, and how wide they are then; `component`: which noise of a texel it has.
    pub(super) fn movement(&self, number: usize, component: u32) -> (MovementUniform, Widths) {
        let movement = uniforms::movement(&self.style, number, self.scale, component);
        let own = Widths::of(self.group.edge_styles.styles());
        let greatest_radius = own.greatest_radius * movement.width + movement.margin;
        (movement, Widths { greatest_radius, are_moved: true, ..own })
    }
}
