//! What the mirrors of a drawing show: drawings of the same kind, one for each.

use super::{Drawing, DrawingInputs, Shared};
use crate::gpu::{Recorder, Target, UniformBuffer};
use crate::render::base::error::RenderError;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::Output;
use crate::render::effects::mirror::MirrorUniform;

/// What a mirror shows.
pub(super) struct Reflection {
    object: u32,
    pub(super) drawing: Drawing,
    pub(super) uniform: UniformBuffer<MirrorUniform>,
}

/// A reflection that is drawn.
pub(super) struct Reflected {
    pub(super) color: Output<Target>,
    pub(super) uniform: MirrorUniform,
    /// Index of [`Drawing::reflections`].
    pub(super) index: usize,
}

impl Drawing {
    /// Draws what is seen in the mirrors.
    pub(super) fn reflect(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
    ) -> Result<Vec<Reflected>, RenderError> {
        let objects = inputs.objects;
        let mirrors = if inputs.reflections > 0 { objects.mirrors.as_slice() } else { &[] };
        let margin = objects.greatest_reach();
        let mirrors_in_view: Vec<_> = mirrors
            .iter()
            .filter_map(|m| Some((m, m.seen_from(inputs.scene_view.view, &objects.visible_bounds, margin)?)))
            .collect();
        self.reflections.retain(|r| mirrors_in_view.iter().any(|(mirror, _)| mirror.object == r.object));
        if mirrors_in_view.is_empty() {
            return Ok(Vec::new());
        }
        let mut reflected = Vec::new();
        for (mirror, view) in &mirrors_in_view {
            let index = match self.reflections.iter().position(|r| r.object == mirror.object) {
                Some(index) => index,
                None => {
                    self.reflections.push(Reflection {
                        object: mirror.object,
                        drawing: Self::new(rec.gpu, rec.pipelines.frame_layout()),
                        uniform: UniformBuffer::new(rec.gpu, "mirror"),
                    });
                    self.reflections.len() - 1
                }
            };
            let Some(reflection) = self.reflections.get_mut(index) else { continue };
            let scene_view = SceneView { view, ..inputs.scene_view };
            let inner = DrawingInputs { scene_view, reflections: inputs.reflections - 1, ..*inputs };
            let before = reflection.drawing.drawn();
            // Whoever looks at what a picture is made of means that of the eye.
            let color = rec.unwatched(|rec| reflection.drawing.draw(rec, shared, &inner))?.color;
            self.reflected += reflection.drawing.drawn() - before;
            reflected.push(Reflected { color, uniform: mirror.uniform(), index });
        }
        self.bind_camera(rec, &inputs.scene_view);
        Ok(reflected)
    }

    /// How often it was drawn, with what is seen in its mirrors.
    fn drawn(&self) -> u64 {
        self.color.runs() + self.reflected
    }
}
