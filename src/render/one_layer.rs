//! A look at one depth layer of everything visible: its geometry and its edge map (blueprints paper, Fig. 4).

use glam::Vec2;

use super::RenderError;
use super::drawing::DrawingInputs;
use super::frame_uniform::View;
use super::layers::{LayerInputs, LayerLines, LayerLinesInputs, Layers};
use super::passes::edge_style::EdgeUniform;
use super::passes::gbuffer::{GBuffer, GBufferPass};
use super::passes::instances::{DrawCall, Instance};
use super::passes::peel::MOST_LAYERS;
use super::passes::segments::Segments;
use super::segments::segments;
use super::stage::{Output, Stage};
use crate::document::LayersBy;
use crate::gpu::{Gpu, GpuError, Recorder, Target};

/// What of that look lives across frames.
pub(super) struct OneLayer {
    lines: LayerLines,
    segments: Segments,
    stage: Stage<Inputs, (GBuffer, Target)>,
}

/// What it depends on.
#[derive(PartialEq)]
struct Inputs {
    shaders: u64,
    scene_revision: u64,
    number: u32,
    view: View,
    draws: Vec<Instance>,
    calls: Vec<DrawCall>,
    edge_styles: Vec<EdgeUniform>,
    depth_range: Vec2,
    crease_angle: f32,
}

impl OneLayer {
    /// Nothing drawn yet.
    pub(super) fn new(gpu: &Gpu) -> Self {
        Self { lines: LayerLines::new(gpu), segments: Segments::new(gpu), stage: Stage::default() }
    }

    /// Lets go of the last one.
    pub(super) fn forget(&mut self) {
        self.stage.clear();
    }

    /// The layer of that number, 1 being the nearest, and its edge map; both empty behind the last one. `depth_range`: see
    /// [`super::drawing::Begun`].
    ///
    /// # Errors
    /// [`RenderError`].
    pub(super) fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &DrawingInputs<'_>,
        (number, depth_range): (u32, Vec2),
    ) -> Result<Output<(GBuffer, Target)>, RenderError> {
        let DrawingInputs { scene, view, crease_angle, .. } = *inputs;
        let mut group = inputs.objects.surfaces.clone();
        group.shows_hidden = true;
        let (draws, calls) = group.draws(scene, view);
        let asked = Inputs {
            shaders: rec.pipelines.generation(),
            scene_revision: inputs.scene_revision,
            number,
            view: *view,
            draws,
            calls,
            edge_styles: group.edge_styles.clone(),
            depth_range,
            crease_angle,
        };
        let Self { lines, segments: placed, stage } = self;
        stage.run(asked, |asked| {
            let is_cut = view.cut.is_some();
            let cut = LayerInputs {
                scene,
                draws: &asked.draws,
                calls: &asked.calls,
                is_cut,
                most: number,
                least: 1,
                mask: None,
                fraction: 1.0,
                // It cannot run out of room, which nobody would hear of.
                by: LayersBy::Peeling,
                with_color: true,
                with_normals: true,
                with_depth: true,
                whole: MOST_LAYERS,
            };
            let mut found = None;
            // A layer that has ended is empty, and nobody waits for the report about it.
            Layers::new(rec.gpu).each(rec, gbuffer_pass, &cut, |_, _, layer, _| {
                found = Some(layer.clone());
                Ok(())
            })?;
            let Some(layer) = found else { return Err(GpuError::Lost("no layer".to_owned()).into()) };
            lines.begin(rec.gpu, &group.edge_styles);
            placed.write(rec, &segments(scene, &group, view, crease_angle), true)?;
            let edges = LayerLinesInputs {
                styles: &group.edge_styles,
                is_whole: true,
                segments: placed,
                has_holes: group.has_holes,
                is_cut,
                repeated: true,
                before: None,
            };
            let edges = lines.edges(rec, &edges, &layer, &mut None)?;
            Ok((layer.gbuffer, edges.edge_map.edges))
        })
    }
}
