//! THE FRAME: from a scene to the final image, in the order of the edge-enhancement paper's pipeline.
//!
//! ```text
//! shadow maps ─► drawing (G-buffer ─► edges ─► surfaces + lines) ─► mean of the samples ─► resolve ─► final image
//! ```

use glam::{Vec2, Vec4};

use super::RenderError;
use super::drawing::{Drawing, DrawingInputs, Shared};
use super::layers::Reported;
use super::one_layer::OneLayer;
use super::passes::accumulate::{Accumulation, Subject};
use super::passes::front::Front;
use super::passes::gbuffer::GBuffer;
use super::passes::operators::operators;
use super::passes::peel::Layer;
use super::passes::resolve::resolve;
use super::passes::selection::{self, selection};
use super::passes::show::show;
use super::sample::Sample;
use super::scale_bar::ScaleBar;
use super::shadows::ShadowMaps;
use super::stage::{Output, Stage};
use crate::document::Show;
use crate::gpu::{ArrayBuffer, Gpu, Recorder, Target};
use crate::scene::NodeId;

/// What one frame is to show.
#[derive(Clone, Copy)]
pub struct FrameInputs<'a> {
    /// What is drawn, as the eye sees it; its sample is that of [`FrameState::next_sample`].
    pub drawing: DrawingInputs<'a>,
    /// The picture, or a buffer that it is made from.
    pub show: Show,
    /// Which depth layer such a buffer is of; 1: the nearest.
    pub layer: u32,
    /// Shown with the picture; `None`: none.
    pub scale_bar: Option<&'a ScaleBar>,
    /// Selected nodes; empty without a window.
    pub selected: &'a [NodeId],
}

/// The results of a frame; handles to textures that stay valid until the next frame.
#[derive(Debug, Clone)]
pub struct Picture {
    /// The final image: the mean of all samples so far.
    pub image: Target,
    /// Changes when the image does.
    pub revision: u64,
    /// The sample that was drawn last.
    pub sample: Sample,
    /// Outline of the selection, if anything is selected.
    pub selection: Option<Target>,
    /// Per-pixel geometry of the surfaces, for tests.
    pub gbuffer: GBuffer,
    /// What is in front, blueprints among it: for picking.
    pub front: Front,
    /// Operators' values, if they were shown.
    pub operators: Option<Target>,
    /// See `shaders/common/edge_map.wgsl`; `None` when no object has lines.
    pub edge_map: Option<Target>,
    /// Channel i: how much of the light that throws shadows as number i reaches the pixel (1: all of it); `None` when
    /// no light does.
    pub shadow_mask: Option<Target>,
    /// See `shaders/effects/toon.wgsl`; `None` when no object asks for it.
    pub cartoon_map: Option<Target>,
    /// See `shaders/passes/coordinates.wgsl`; `None` when no object asks for it.
    pub coordinates: Option<Target>,
    /// Reversed depth of the designated objects alone; `None` when no blueprint is peeled for them.
    pub depth_mask: Option<Target>,
    /// The layers of each blueprint, the farthest first; empty unless [`super::Renderer::keep_layers`] was called.
    pub layers: Vec<Vec<Layer>>,
}

/// What lives across frames.
pub struct FrameState {
    shared: Shared,
    shadow_maps: ShadowMaps,
    drawing: Drawing,
    one_layer: OneLayer,
    operators: Stage<(u64, u32, Vec2), Target>,
    accumulation: Accumulation,
    /// What this one went on from: held, so that the other one's pool does not hand out its textures before they have
    /// been read.
    origin: Option<Accumulation>,
    image: Stage<(u64, Show, [u64; 4], Vec4, Option<ScaleBar>), Target>,
    scale_bar: ArrayBuffer,
    /// The geometry of the picture's first sample: outlines do not follow the jitter.
    unmoved: (u64, Vec<u64>),
    selected: ArrayBuffer,
    selection: Stage<((u64, Vec<u64>), Vec<u32>), Target>,
}

impl FrameState {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        Self {
            shared: Shared::new(gpu),
            shadow_maps: ShadowMaps::new(gpu),
            drawing: Drawing::new(gpu, frame_layout),
            one_layer: OneLayer::new(gpu),
            operators: Stage::default(),
            accumulation: Accumulation::default(),
            origin: None,
            image: Stage::default(),
            scale_bar: ArrayBuffer::new(gpu, "scale bar"),
            unmoved: (0, Vec::new()),
            selected: ArrayBuffer::new(gpu, "selected"),
            selection: Stage::default(),
        }
    }

    /// Layout of the materials' bind group.
    pub fn material_layout(&self) -> &wgpu::BindGroupLayout {
        &self.shared.gbuffer.material_layout
    }

    /// What the eye sees.
    pub fn drawing(&self) -> &Drawing {
        &self.drawing
    }

    /// What has been reported about the pictures so far; incomplete ones are drawn again. Never waits.
    pub fn take_reports(&mut self) -> Reported {
        self.drawing.take_reports()
    }

    /// Gives memory back that the last frame did not need.
    pub fn shrink(&mut self, gpu: &Gpu) {
        self.shared.gbuffer.lists.shrink(gpu);
    }

    /// How often each stage has run, by name.
    pub fn runs(&self) -> Vec<(&'static str, u64)> {
        let mut runs = self.drawing.runs().to_vec();
        runs.push(("shadow map", self.shadow_maps.runs()));
        runs.push(("image", self.image.runs()));
        runs
    }

    /// Goes on with the picture of another frame, where it asks for the same one.
    pub fn go_on_from(&mut self, other: &Self) {
        self.accumulation = other.accumulation.clone();
        self.origin = Some(other.accumulation.clone());
    }

    /// The sample to draw next of a picture of `of` samples. Buffers are shown as they are, without a mean.
    pub fn next_sample(&mut self, subject: Subject, of: u32) -> Sample {
        let of = if subject.document.view.show == Show::Picture { of.max(1) } else { 1 };
        self.accumulation.next(subject, of)
    }

    /// Records one frame; stages whose inputs did not change are left out.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn record(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &FrameInputs<'_>,
    ) -> Result<Picture, RenderError> {
        let FrameInputs { drawing: eye, show: what, .. } = inputs;
        let shaders = rec.pipelines.generation();
        let shadow_maps = self.shadow_maps.run(rec, eye, &self.shared.gbuffer.material_layout)?;
        let eye = &DrawingInputs { shadow_maps: &shadow_maps, ..*eye };
        let begun = self.drawing.begin(rec, &mut self.shared, eye)?;
        let edge_map = if *what != Show::Picture || eye.objects.surfaces.have_lines() {
            Some(self.drawing.find_edges(rec, eye, &begun)?)
        } else {
            self.drawing.forget_edges();
            None
        };
        let is_deeper = *what != Show::Picture && inputs.layer > 1;
        let deeper = if is_deeper {
            let asked = (inputs.layer, begun.depth_range);
            Some(self.one_layer.run(rec, &mut self.shared.gbuffer, eye, asked)?)
        } else {
            self.one_layer.forget();
            None
        };
        let gbuffer = match &deeper {
            Some(layer) => &Output { value: layer.value.0.clone(), revision: layer.revision },
            None => &begun.gbuffer,
        };
        let operators = self.operators(rec, (*what, inputs.layer), gbuffer, begun.depth_range)?;

        let (mut cartoon_map, mut coordinates, mut depth_mask, mut layers) = (None, None, None, Vec::new());
        let mut fronts = (Vec::new(), Vec::new());
        let image = if *what == Show::Picture {
            let shaded = self.drawing.shade(rec, &mut self.shared, eye, &begun, edge_map.as_ref())?;
            (cartoon_map, coordinates) = (shaded.cartoon_map, shaded.coordinates);
            (depth_mask, layers, fronts) = (shaded.depth_mask, shaded.layers, shaded.fronts);
            let color = self.accumulation.add(rec, eye.sample, shaded.color)?;
            let asked =
                (shaders, *what, [color.revision, 0, 0, 0], eye.background, inputs.scale_bar.cloned());
            self.image.run(asked, |(.., bar)| {
                let bar = bar.as_ref().and_then(ScaleBar::uniform);
                if let Some(bar) = &bar {
                    self.scale_bar.write(rec.gpu, bar);
                }
                resolve(rec, &color.value, (self.scale_bar.buffer(), bar.is_some()))
            })?
        } else {
            self.drawing.forget_surfaces();
            let revisions = [
                u64::from(inputs.layer),
                gbuffer.revision,
                edge_map.as_ref().map_or(0, |e| e.revision),
                operators.as_ref().map_or(0, |(revision, _)| *revision),
            ];
            // A shader that does not read these is given any texture of their kind.
            let buffers = &gbuffer.value;
            let visible = edge_map.as_ref().map_or(&buffers.geometry, |e| &e.value.edges);
            let ink = deeper.as_ref().map_or(visible, |layer| &layer.value.1);
            let values = operators.as_ref().map_or(&buffers.base_color, |(_, values)| values);
            self.image.run((shaders, *what, revisions, Vec4::ZERO, None), |_| {
                show(rec, *what, buffers, ink, values)
            })?
        };

        let (revisions, layers_before) = fronts;
        let front = Front { surfaces: begun.gbuffer.value.geometry.clone(), layers: layers_before };

        Ok(Picture {
            selection: self.outline(rec, inputs, &front, (begun.gbuffer.revision, revisions))?,
            front,
            image: image.value,
            sample: eye.sample,
            revision: image.revision,
            gbuffer: begun.gbuffer.value,
            operators: operators.map(|(_, values)| values),
            edge_map: edge_map.map(|e| e.value.edges),
            shadow_mask: begun.shadow_mask.map(|mask| mask.value),
            cartoon_map,
            coordinates,
            depth_mask,
            layers,
        })
    }

    fn operators(
        &mut self,
        rec: &mut Recorder<'_>,
        (what, layer): (Show, u32),
        gbuffer: &Output<GBuffer>,
        depth_range: Vec2,
    ) -> Result<Option<(u64, Target)>, RenderError> {
        if !matches!(what, Show::NormalOperator | Show::DepthOperator | Show::C1Operator) {
            self.operators.clear();
            return Ok(None);
        }
        let inputs = (gbuffer.revision, layer, depth_range);
        let found =
            self.operators.run(inputs, |_| operators(rec, &gbuffer.value, self.drawing.edge_styles()))?;
        Ok(Some((found.revision, found.value)))
    }

    fn outline(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &FrameInputs<'_>,
        front: &Front,
        revisions: (u64, Vec<u64>),
    ) -> Result<Option<Target>, RenderError> {
        if inputs.selected.is_empty() {
            self.selection.clear();
            return Ok(None);
        }
        if inputs.drawing.sample.index == 0 {
            self.unmoved = revisions;
        }
        let bits = selection::bits(inputs.selected, &inputs.drawing.scene.scene);
        let outline = self.selection.run((self.unmoved.clone(), bits), |(_, bits)| {
            self.selected.write(rec.gpu, bits);
            let front = front.nearest(rec)?;
            selection(rec, &front, self.selected.buffer())
        })?;
        Ok(Some(outline.value))
    }
}
