//! What of a drawing is cut into depth layers: hidden lines and blueprints, and what is reported about them.

use super::{Begun, Drawing, DrawingInputs};
use crate::gpu::{Gpu, Recorder, Target};
use crate::render::RenderError;
use crate::render::effects::blended::Blended;
use crate::render::effects::blueprint::{Blueprints, Peels};
use crate::render::effects::hidden::HiddenLines;
use crate::render::layers::{LayersBy, Reported};
use crate::render::passes::depth_mask::DepthMask;
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::gbuffer::GBufferPass;
use crate::render::passes::peel::Peeled;
use crate::render::stage::Output;
use crate::style::Style;

impl Drawing {
    /// How far peeling came in each blueprint. Waits for the device.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn peeled(&self, gpu: &Gpu) -> Result<Vec<Peeled>, RenderError> {
        self.blueprints.iter().map(|b| b.count().read(gpu)).collect()
    }

    /// What has been reported about the layers of its pictures and of what mirrors show; it draws incomplete ones again.
    /// Never waits.
    pub fn take_reports(&mut self) -> Reported {
        let own = self.blueprints.iter_mut().map(Blueprints::take_reports);
        let reflected = self.reflections.iter_mut().map(|r| r.drawing.take_reports());
        let hidden = self.hidden.iter_mut().map(HiddenLines::take_reports);
        let blended = self.blended.as_mut().map(Blended::take_reports);
        if blended == Some(Reported::Incomplete) {
            self.surface.clear();
        }
        own.chain(hidden).chain(blended).chain(reflected).max().unwrap_or(Reported::Complete)
    }

    /// How far the layers of each blueprint came in the last picture whose report has arrived; in the order of
    /// [`crate::render::groups::Objects::blueprints`].
    pub fn last_peeled(&self) -> Vec<Option<(Peeled, LayersBy)>> {
        self.blueprints.iter().map(|b| b.last().cloned()).collect()
    }

    /// The same of the blueprint that objects of this style are in.
    pub fn last_peeled_of(&self, style: &Style) -> Option<&(Peeled, LayersBy)> {
        self.blueprints.iter().find(|b| b.is_of(style))?.last()
    }

    pub(super) fn draw_hidden(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &DrawingInputs<'_>,
        begun: &Begun,
        edge_map: Option<&Output<EdgeMap>>,
    ) -> Result<Option<Output<Target>>, RenderError> {
        if inputs.objects.hidden.is_empty() {
            self.hidden = None;
            return Ok(None);
        }
        let hidden = self.hidden.get_or_insert_with(|| HiddenLines::new(rec.gpu));
        hidden.run(rec, gbuffer_pass, inputs, &begun.uniform, edge_map).map(Some)
    }

    /// Draws the blueprints, the farthest first, each with the depth of its middle. Blended groups that reach into each
    /// other have no right order: that of their middles is the nearest to it.
    pub(super) fn peel(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &DrawingInputs<'_>,
        drawn: (&Begun, Option<&Output<DepthMask>>),
    ) -> Result<Vec<(f64, Output<Peels>)>, RenderError> {
        let groups = &inputs.objects.blueprints;
        self.blueprints.truncate(groups.len());
        self.blueprints.resize_with(groups.len(), || Blueprints::new(rec.gpu));
        let mut pictures = Vec::new();
        for (blueprint, state) in groups.iter().zip(&mut self.blueprints) {
            let before = state.runs();
            let picture = state.run(rec, gbuffer_pass, inputs, drawn, blueprint)?;
            self.blueprinted += state.runs() - before;
            pictures.push((blueprint.group.mean_depth(inputs.scene, inputs.view), picture));
        }
        pictures.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        Ok(pictures)
    }
}
