//! The composition of a drawing: surfaces with their lines, mirrors, hidden lines, and what is seen through.

use super::objects::Objects;
use super::stages::{ColorKey, InkKey};
use super::{Drawing, DrawingInputs, Drawn, Shared, Surfaces};
use crate::gpu::{Recorder, Target};
use crate::render::base::edge_style::EdgeUniform;
use crate::render::base::error::RenderError;
use crate::render::base::stage::Output;
use crate::render::effects::blended::BlendedShading;
use crate::render::effects::hidden::HiddenLines;
use crate::render::effects::mirror::mirror;
use crate::render::effects::section::caps;
use crate::render::effects::surface::Look;
use crate::render::effects::technique::Shaded;
use crate::render::effects::translucent::{TranslucentGroups, TranslucentInputs, TranslucentState};
use crate::render::passes::composition::{Composition, ink};
use crate::render::passes::designated::DepthMask;
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::line_distance::{Reach, line_distance};
use crate::render::passes::lines::{Lines, Pen, lines};
use crate::render::passes::overlay::overlay;
use crate::render::passes::shadows::ShadowMap;

impl Drawing {
    /// Shades the surfaces, and composes them with their lines, mirrors and what is seen through.
    pub(super) fn compose(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Drawn, RenderError> {
        let DrawingInputs { seen, objects, .. } = *inputs;
        let look = Look::new(&objects.styles, &seen, caps(seen.scene, seen.view, objects.scale));
        let reflected = self.reflect(rec, shared, inputs)?;
        let hidden = self.draw_hidden(rec, shared, inputs, surfaces, edges)?;
        let reach = self.find_reach(rec, inputs, edges)?;
        let gbuffer = &surfaces.gbuffer;
        let geometry = Output { value: gbuffer.value.geometry.clone(), revision: gbuffer.revision };
        let mut composition = Composition::of_surfaces(geometry, !objects.surfaces.is_empty());
        let edge_styles = &objects.surfaces.edge_styles;
        self.shading.upload(&mut shared.techniques, rec.gpu, &look)?;
        if objects.blended.is_empty() && objects.blueprints.is_empty() {
            self.blueprinted += self.translucent.take().map_or(0, |state| state.blueprint_runs());
            self.ink.clear();
            self.depth_mask.forget();
        } else {
            composition.place_ink(self.draw_ink(rec, inputs, surfaces, edges, reach.as_ref())?);
            self.place_translucent(rec, shared, inputs, surfaces, &look, &mut composition)?;
        }
        let key = ColorKey {
            gbuffer: gbuffer.revision,
            shadows: surfaces.shadow_mask.as_ref().map(|mask| mask.revision),
            edges: edges.map(|edges| edges.revision),
            reach: reach.as_ref().map(|reach| reach.revision),
            look,
            edge_styles: edge_styles.clone(),
            uniform: surfaces.uniform.without_background(),
            reflected: reflected.iter().map(|r| (r.color.revision, r.uniform)).collect(),
            paper_in_mirrors: (!reflected.is_empty()).then_some(seen.background),
            hidden: hidden.as_ref().map(|hidden| hidden.revision),
            translucent: composition.translucent_revisions(),
        };
        let color = self.color.run(key, |key| {
            if let Some(only) = composition.only_translucent() {
                return Ok(only.clone());
            }
            let geometry = self.gbuffer.inputs();
            let layer = Shaded {
                gbuffer: &gbuffer.value,
                revision: Some(gbuffer.revision),
                shadow_mask: surfaces.shadow_mask.as_ref().map(|mask| (&mask.value, mask.revision)),
                seen,
                uniform: &key.uniform,
                instances: &self.draws,
                draws: geometry.map_or(&[], |key| &key.draws),
                calls: geometry.map_or(&[], |key| &key.calls),
            };
            let color = self.shading.shade(rec, &mut shared.techniques, &key.look, &layer, false)?;
            for seen in &reflected {
                let Some(reflection) = self.reflections.get_mut(seen.index) else { continue };
                reflection.uniform.write(rec.gpu, &vec![seen.uniform]);
                let uniform = reflection.uniform.buffer();
                mirror(rec, &composition.surfaces.value, &seen.color.value, uniform, &color)?;
            }
            if let Some(hidden) = &hidden {
                overlay(rec, &hidden.value, &color)?;
            }
            if let Some(edges) = edges {
                let buffer = self.edge_styles.buffer();
                let drawn = lines_of(surfaces, edges, reach.as_ref(), edge_styles, buffer);
                lines(rec, &drawn, &Pen::PLAIN, &color)?;
            }
            composition.lay_translucent(rec, &color)?;
            Ok::<_, RenderError>(color)
        })?;
        let mut revisions = vec![gbuffer.revision];
        revisions.extend(composition.translucent_revisions());
        Ok(Drawn { color, front: (composition.front(), revisions) })
    }

    fn draw_hidden(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Option<Output<Target>>, RenderError> {
        let Objects { surfaces: group, hidden: asked, .. } = inputs.objects;
        if asked.is_empty() {
            self.hidden = None;
            return Ok(None);
        }
        let hidden = self.hidden.get_or_insert_with(|| HiddenLines::new(rec.gpu));
        let asked = (group, asked);
        hidden.run(rec, &mut shared.gbuffer, &inputs.seen, &surfaces.uniform, asked, edges).map(Some)
    }

    fn find_reach(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &DrawingInputs<'_>,
        edges: Option<&Output<EdgeMap>>,
    ) -> Result<Option<Output<Reach>>, RenderError> {
        let spines = edges.and_then(|edges| Some((edges.revision, edges.value.spines.as_ref()?)));
        let Some((revision, spines)) = spines else {
            self.reach.clear();
            return Ok(None);
        };
        let styles = &inputs.objects.surfaces.edge_styles;
        self.reach.run(revision, |_| line_distance(rec, spines, styles, &mut self.greatest_radius)).map(Some)
    }

    fn draw_ink(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
        edges: Option<&Output<EdgeMap>>,
        reach: Option<&Output<Reach>>,
    ) -> Result<Option<Output<Target>>, RenderError> {
        let styles = &inputs.objects.surfaces.edge_styles;
        let Some(edges) = edges.filter(|_| !inputs.objects.surfaces.is_empty()) else {
            self.ink.clear();
            return Ok(None);
        };
        let key = InkKey {
            gbuffer: surfaces.gbuffer.revision,
            edges: edges.revision,
            reach: reach.map(|reach| reach.revision),
            edge_styles: styles.clone(),
            uniform: surfaces.uniform.without_background(),
        };
        let drawn = lines_of(surfaces, edges, reach, styles, self.edge_styles.buffer());
        self.ink.run(key, |_| ink(rec, &drawn)).map(Some)
    }

    fn place_translucent(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        surfaces: &Surfaces,
        look: &Look,
        composition: &mut Composition,
    ) -> Result<(), RenderError> {
        let DrawingInputs { seen, objects, shadow_maps, .. } = *inputs;
        let mask = self.draw_mask(rec, shared, inputs, surfaces, composition)?;
        let no_caps = Vec::new();
        let caps = if objects.blueprints.is_empty() { &no_caps } else { look.caps() };
        let shading = BlendedShading {
            look,
            shading: &mut self.shading,
            shared: &mut shared.techniques,
            shadow_mask: &mut self.shadow_mask,
            shadow_maps,
        };
        let inputs = TranslucentInputs {
            seen,
            uniform: &surfaces.uniform,
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
        surfaces: &Surfaces,
        composition: &Composition,
    ) -> Result<Option<Output<DepthMask>>, RenderError> {
        let objects = inputs.objects;
        let mask = if objects.blueprints.is_empty() || objects.masks.is_empty() {
            self.depth_mask.forget();
            None
        } else {
            // Where nothing else is opaque, they have been drawn.
            let is_all = objects.masks.visible() == objects.surfaces.visible();
            let drawn = is_all.then_some(&surfaces.gbuffer.value);
            let (gbuffer_pass, seen) = (&mut shared.gbuffer, &inputs.seen);
            Some(self.depth_mask.run(
                rec,
                gbuffer_pass,
                seen,
                (&objects.masks, drawn),
                &composition.surfaces,
            )?)
        };
        rec.note("depth mask", mask.as_ref().map(|mask| &mask.value.depth));
        Ok(mask)
    }
}

/// The lines of surfaces.
fn lines_of<'a>(
    surfaces: &'a Surfaces,
    edges: &'a Output<EdgeMap>,
    reach: Option<&'a Output<Reach>>,
    styles: &'a [EdgeUniform],
    edge_styles: &'a wgpu::Buffer,
) -> Lines<'a> {
    Lines {
        gbuffer: &surfaces.gbuffer.value,
        edge_map: &edges.value,
        reach: reach.map(|reach| &reach.value),
        styles,
        edge_styles,
    }
}
