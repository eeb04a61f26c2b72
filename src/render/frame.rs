//! THE FRAME: from a scene to the final image, in the order of the edge-enhancement paper's pipeline. A frame is groups; a group
//! is layers; each layer has geometry, shade and ink; all of them are placed into one composition by depth.
//!
//! ```text
//! shadow maps ─► drawing: groups ─► layers (geometry) ─┬─► shade ─┬─► composition ─► mean of the samples ─► resolve ─► final image
//!                                                     └─► ink ───┘
//! ```

use super::base::error::RenderError;
use super::base::sample::Sample;
use super::base::scale_bar::ScaleBar;
use super::drawing::{Drawing, DrawingInputs, Shared};
use super::passes::accumulate::{Accumulation, Subject};
use super::passes::front::Front;
use super::passes::layers::Reported;
use super::passes::resolve::Resolve;
use super::passes::selection::SelectionOutline;
use super::passes::shadows::{ShadowMap, ShadowMaps};
use super::views::{DebugView, DebugViews};
use crate::document::Show;
use crate::gpu::{Gpu, Recorder, Target};
use crate::scene::NodeId;

/// What one frame is to show.
#[derive(Clone, Copy)]
pub struct FrameInputs<'a> {
    /// What is drawn, as the eye sees it; its sample is that of [`FrameState::next_sample`].
    pub drawing: DrawingInputs<'a>,
    /// The picture, or a buffer that it is made from.
    pub view: DebugView,
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
    /// What is in front, blueprints among it: for picking.
    pub front: Front,
}

/// What lives across frames.
pub struct FrameState {
    shared: Shared,
    shadow_maps: ShadowMaps,
    drawing: Drawing,
    views: DebugViews,
    accumulation: Accumulation,
    /// What this one went on from: held, so that the other one's pool does not hand out its textures before they have
    /// been read.
    origin: Option<Accumulation>,
    resolve: Resolve,
    selection: SelectionOutline,
}

impl FrameState {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        Self {
            shared: Shared::new(gpu),
            shadow_maps: ShadowMaps::new(gpu),
            drawing: Drawing::new(gpu, frame_layout),
            views: DebugViews::new(gpu),
            accumulation: Accumulation::default(),
            origin: None,
            resolve: Resolve::new(gpu),
            selection: SelectionOutline::new(gpu),
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
        let mut runs = self.drawing.runs();
        runs.push(("shadow map", self.shadow_maps.runs()));
        runs.push(("image", self.resolve.runs() + self.views.runs()));
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
        let FrameInputs { drawing: eye, view, scale_bar, selected } = *inputs;
        let shadow_maps = self.draw_shadow_maps(rec, &eye)?;
        let eye = DrawingInputs { shadow_maps: &shadow_maps, ..eye };
        let (sample, background) = (eye.scene_view.sample, eye.scene_view.background);
        let is_picture = view.show == Show::Picture;
        let (image, front) = if is_picture {
            self.views.forget();
            let drawn = self.drawing.draw(rec, &mut self.shared, &eye)?;
            let mean = self.accumulation.add(rec, sample, drawn.color)?;
            (self.resolve.run(rec, &mean, background, scale_bar)?, drawn.front)
        } else {
            self.resolve.forget();
            let viewed = self.views.draw(rec, &mut self.drawing, &mut self.shared, &eye, view)?;
            (viewed.image, viewed.front)
        };
        let (front, revisions) = front;
        let scene = &eye.scene_view.scene.scene;
        let selection = self.selection.run(rec, &front, revisions, selected, scene, sample)?;
        Ok(Picture { image: image.value, revision: image.revision, sample, selection, front })
    }

    fn draw_shadow_maps(
        &mut self,
        rec: &mut Recorder<'_>,
        eye: &DrawingInputs<'_>,
    ) -> Result<Vec<ShadowMap>, RenderError> {
        let objects = eye.objects;
        let opaque = objects.opaque();
        let fitted_to = objects.mirrors.is_empty().then_some(opaque.as_slice());
        let groups = [&opaque[..], &[&objects.blended]].concat();
        self.shadow_maps.run(rec, &eye.scene_view, &groups, fitted_to, &self.shared.gbuffer.material_layout)
    }
}
