//! The composition of a drawing: surfaces with their lines, mirrors, hidden lines, sketches, and what is seen through.

use super::objects::Objects;
use super::reflections::Reflected;
use super::stages::{ColorKey, TogetherKey};
use super::{Drawing, DrawingInputs, Drawn, DrawnSurfaces, Shared, surfaces_of};
use crate::gpu::{Recorder, Target};
use crate::render::base::error::RenderError;
use crate::render::base::stage::Output;
use crate::render::effects::blended::BlendedShading;
use crate::render::effects::mirror::mirror;
use crate::render::effects::section::caps;
use crate::render::effects::sketch::{SketchInputs, SketchState, Sketching};
use crate::render::effects::surface::Look;
use crate::render::effects::translucent::{TranslucentGroups, TranslucentInputs, TranslucentState};
use crate::render::passes::composition::Composition;
use crate::render::passes::designated::DepthMask;
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::line_distance::LineDistance;
use crate::render::passes::lines::{LineShader, lines};
use crate::render::passes::overlay::overlay;
use crate::render::passes::shadows::ShadowMap;

/// What the color of the opaque surfaces is made of.
struct ColorInputs<'a> {
    look: &'a Look,
    edges: Option<&'a Output<EdgeMap>>,
    reflected: Vec<Reflected>,
    hidden: Option<Output<Target>>,
    /// The lines, if they are drawn with the surfaces.
    lines: Option<(&'a Output<EdgeMap>, Option<&'a Output<LineDistance>>)>,
}

impl Drawing {
    /// Shades the surfaces, and composes them with their lines, mirrors, sketches and what is seen through.
    pub(super) fn compose(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        drawn: &DrawnSurfaces,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Drawn, RenderError> {
        let DrawingInputs { scene_view, objects, .. } = *inputs;
        let look =
            Look::new(&objects.styles, &scene_view, caps(scene_view.scene, scene_view.view, objects.scale));
        let reflected = self.reflect(rec, shared, inputs)?;
        let own = surfaces_of(inputs, &drawn.uniform);
        let hidden = self.surfaces.hidden_lines(rec, &mut shared.gbuffer, &own, &objects.hidden, edges)?;
        let line_distance = self.surfaces.line_distance(rec, own.group, edges)?;
        let gbuffer = &drawn.surfaces.gbuffer;
        let geometry = Output { value: gbuffer.value.geometry.clone(), revision: gbuffer.revision };
        let mut composition = Composition::of_surfaces(geometry, !objects.surfaces.is_empty());
        self.shading.upload(&mut shared.techniques, rec.gpu, &look)?;
        let is_opaque = objects.blended.is_empty() && objects.blueprints.is_empty();
        let has_sketches = !objects.sketches.is_empty();
        if is_opaque && !has_sketches {
            self.surfaces.forget_ink();
        } else {
            let ink = self.surfaces.ink(rec, &own, &drawn.surfaces, edges, line_distance.as_ref())?;
            composition.place_ink(ink);
        }
        let lines = edges.filter(|_| !has_sketches).map(|edges| (edges, line_distance.as_ref()));
        let color_inputs = ColorInputs { look: &look, edges, reflected, hidden, lines };
        let color = if has_sketches {
            let alone = Composition::of_surfaces(composition.surfaces.clone(), composition.has_surfaces);
            let color = self.color_surfaces(rec, shared, inputs, drawn, &color_inputs, &alone)?;
            let color = self.place_sketches(rec, shared, inputs, drawn, &look, &mut composition, color)?;
            self.place_translucent(rec, shared, inputs, drawn, &look, &mut composition)?;
            if composition.is_laid() {
                self.together.clear();
                return Ok(Drawn { color, front: composition.front() });
            }
            let key = TogetherKey {
                shaders: rec.pipelines.generation(),
                opaque: [Some(color.revision), composition.ink.as_ref().map(|ink| ink.revision)],
                translucent: composition.translucent_revisions(),
            };
            self.together.run(key, |_| {
                let together = rec.target("composition", color.value.format())?;
                rec.copy(&color.value, &together);
                composition.lay_ink(rec, &together)?;
                composition.lay_translucent(rec, &together)?;
                Ok::<_, RenderError>(together)
            })?
        } else {
            self.sketches.clear();
            self.together.clear();
            self.place_translucent(rec, shared, inputs, drawn, &look, &mut composition)?;
            self.color_surfaces(rec, shared, inputs, drawn, &color_inputs, &composition)?
        };
        Ok(Drawn { color, front: composition.front() })
    }

    /// Shades the opaque surfaces that lie in their place; what is seen through of this composition goes over them.
    fn color_surfaces(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        drawn: &DrawnSurfaces,
        color_inputs: &ColorInputs<'_>,
        composition: &Composition,
    ) -> Result<Output<Target>, RenderError> {
        let DrawingInputs { scene_view, objects, .. } = *inputs;
        let ColorInputs { look, edges, reflected, hidden, lines: drawn_lines } = color_inputs;
        let spines = look.lines(*edges);
        let DrawnSurfaces { uniform, surfaces } = drawn;
        let uniform = uniform.without_background();
        let key = ColorKey {
            gbuffer: surfaces.gbuffer.revision,
            shadows: surfaces.shadow_mask.as_ref().map(|mask| mask.revision),
            lines: drawn_lines.map(|(edges, line_distance)| {
                (edges.revision, line_distance.map(|line_distance| line_distance.revision))
            }),
            shaded_by_lines: spines.map(|(_, revision)| revision),
            look: (*look).clone(),
            edge_styles: objects.surfaces.edge_styles.clone(),
            uniform: composition.has_surfaces.then_some(uniform),
            reflected: reflected.iter().map(|r| (r.color.revision, r.uniform)).collect(),
            paper_in_mirrors: (!reflected.is_empty()).then_some(scene_view.background),
            hidden: hidden.as_ref().map(|hidden| hidden.revision),
            translucent: composition.translucent_revisions(),
        };
        self.color.run(key, |key| {
            if let Some(only) = composition.only_translucent() {
                return Ok(only.clone());
            }
            let layer = self.surfaces.shaded(surfaces, scene_view, &uniform, spines);
            let color = self.shading.shade(rec, &mut shared.techniques, &key.look, &layer, false)?;
            for mirrored in reflected {
                let Some(reflection) = self.reflections.get_mut(mirrored.index) else { continue };
                reflection.uniform.write(rec.gpu, &mirrored.uniform);
                let geometry = &surfaces.gbuffer.value.geometry;
                mirror(rec, geometry, &mirrored.color.value, &reflection.uniform, &color)?;
            }
            if let Some(hidden) = hidden {
                overlay(rec, &hidden.value, &color)?;
            }
            if let Some((edges, line_distance)) = *drawn_lines {
                let line_distance = line_distance.map(|line_distance| &line_distance.value);
                let drawn = self.surfaces.lines(&objects.surfaces, surfaces, &edges.value, line_distance);
                lines(rec, &drawn, &LineShader::PLAIN, &color)?;
            }
            composition.lay_translucent(rec, &color)?;
            Ok::<_, RenderError>(color)
        })
    }

    /// Places the sketches among the opaque surfaces, of which this is the color without lines; returns that of all.
    fn place_sketches(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        drawn: &DrawnSurfaces,
        look: &Look,
        composition: &mut Composition,
        mut color: Output<Target>,
    ) -> Result<Output<Target>, RenderError> {
        let DrawingInputs { scene_view, objects, shadow_maps, .. } = *inputs;
        self.sketches.truncate(objects.sketches.len());
        self.sketches.resize_with(objects.sketches.len(), || SketchState::new(rec.gpu));
        let is_opaque = objects.blended.is_empty() && objects.blueprints.is_empty();
        let count = objects.sketches.len();
        for (number, (sketch, state)) in (1..).zip(objects.sketches.iter().zip(&mut self.sketches)) {
            let inputs = SketchInputs { scene_view, sketch, uniform: &drawn.uniform, look, shadow_maps };
            let with = Sketching {
                gbuffer: &mut shared.gbuffer,
                techniques: &mut shared.techniques,
                shared: &mut shared.sketches,
            };
            color = state.place(rec, with, &inputs, composition, &color, is_opaque && number == count)?;
        }
        Ok(color)
    }

    /// Places what is seen through.
    fn place_translucent(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        drawn: &DrawnSurfaces,
        look: &Look,
        composition: &mut Composition,
    ) -> Result<(), RenderError> {
        let DrawingInputs { scene_view, objects, shadow_maps, .. } = *inputs;
        if objects.blended.is_empty() && objects.blueprints.is_empty() {
            self.blueprinted += self.translucent.take().map_or(0, |state| state.blueprint_runs());
            self.depth_mask.forget();
            return Ok(());
        }
        let mask = self.draw_mask(rec, shared, inputs, drawn, composition)?;
        let no_caps = Vec::new();
        let caps = if objects.blueprints.is_empty() { &no_caps } else { look.caps() };
        let shading = BlendedShading {
            look,
            shading: &mut self.shading,
            shared: &mut shared.techniques,
            shadow_mask: self.surfaces.shadow_mask(),
            shadow_maps,
        };
        let inputs = TranslucentInputs {
            scene_view,
            uniform: &drawn.uniform,
            caps,
            mask: mask.as_ref(),
            shading,
            shadow_revisions: shadow_maps.iter().map(ShadowMap::revision).collect(),
        };
        let groups = TranslucentGroups { blended: &objects.blended, blueprints: &objects.blueprints };
        let state = self.translucent.get_or_insert_with(|| TranslucentState::new(rec.gpu));
        state.place(rec, &mut shared.gbuffer, groups, inputs, composition)
    }

    /// The depth mask; `None` where nobody asks for one.
    fn draw_mask(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        drawn: &DrawnSurfaces,
        composition: &Composition,
    ) -> Result<Option<Output<DepthMask>>, RenderError> {
        let Objects { blueprints, masks, surfaces, .. } = inputs.objects;
        let mask = if blueprints.is_empty() || masks.is_empty() {
            self.depth_mask.forget();
            None
        } else {
            // Where nothing else is opaque, they have been drawn.
            let is_all = masks.visible() == surfaces.visible();
            let drawn = is_all.then_some(&drawn.surfaces.gbuffer.value);
            let (gbuffer_pass, scene_view) = (&mut shared.gbuffer, &inputs.scene_view);
            Some(self.depth_mask.run(rec, gbuffer_pass, scene_view, masks, drawn, &composition.surfaces)?)
        };
        rec.note("depth mask", mask.as_ref().map(|mask| &mask.value.depth));
        Ok(mask)
    }
}
