//! THE FRAME: from a scene to the final image, in the order of the edge-enhancement paper's pipeline.
//!
//! ```text
//! objects ─► G-buffer ─┬─► (cartoon map ─►) shaded surfaces ┬─► + lines ─► mean of the samples ─► resolve ─► final image
//!                      └─► edge map ─► reach of the lines ──┘
//! segments (topology) ─────┘
//! ```

use std::sync::Arc;

use glam::{Vec2, Vec4};

use super::RenderError;
use super::effects::surface::{Shading, SurfaceUniform, surface};
use super::effects::toon::{ToonUniform, cartoon_map};
use super::frame_uniform::{FrameUniform, View};
use super::gpu_scene::GpuScene;
use super::groups::Objects;
use super::passes::accumulate::{Accumulation, Subject};
use super::passes::edge_map::{EdgeInputs, EdgeMap, EdgeMapPass};
use super::passes::edge_style::EdgeUniform;
use super::passes::gbuffer::{DrawCall, DrawUniform, GBuffer, GBufferPass};
use super::passes::line_distance::{Reach, line_distance};
use super::passes::lines::lines;
use super::passes::operators::operators;
use super::passes::resolve::resolve;
use super::passes::selection::{self, selection};
use super::passes::show::show;
use super::sample::Sample;
use super::segments::segments;
use super::stage::{Output, Stage};
use crate::document::{Document, Show};
use crate::geometry::LineSegment;
use crate::gpu::{ArrayBuffer, Gpu, Recorder, Target};
use crate::scene::NodeId;

/// What one frame is to show.
#[derive(Clone, Copy)]
pub struct FrameInputs<'a> {
    /// The scene on the device.
    pub scene: &'a GpuScene,
    /// Changes when the scene does.
    pub scene_revision: u64,
    /// The document.
    pub document: &'a Document,
    /// Styles and roles, resolved.
    pub objects: &'a Objects,
    /// The sample to draw, of [`FrameState::next_sample`].
    pub sample: Sample,
    /// The camera, moved by the sample's jitter.
    pub view: &'a View,
    /// Linear depth range of the enhanced objects.
    pub depth_range: Vec2,
    /// All that is in bind group 0.
    pub uniform: &'a FrameUniform,
    /// Paper: linear colour and opacity.
    pub background: Vec4,
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
    /// Per-pixel geometry, for picking and for tests.
    pub gbuffer: GBuffer,
    /// Operators' values, if they were shown.
    pub operators: Option<Target>,
    /// See `shaders/common/edge_map.wgsl`; `None` when no object has lines.
    pub edge_map: Option<Target>,
    /// See `shaders/effects/toon.wgsl`; `None` when no object asks for it.
    pub cartoon_map: Option<Target>,
}

/// What lives across frames.
pub struct FrameState {
    gbuffer_pass: GBufferPass,
    edge_map_pass: EdgeMapPass,
    greatest_radius: ArrayBuffer,
    edge_styles: ArrayBuffer,
    surface_styles: ArrayBuffer,
    toon_styles: ArrayBuffer,
    selected: ArrayBuffer,
    gbuffer: Stage<(u64, u64, View, Vec<DrawUniform>, Vec<DrawCall>), GBuffer>,
    segments: Stage<(u64, View, Vec<EdgeUniform>, f32), Arc<Vec<LineSegment>>>,
    edge_map: Stage<(u64, Vec<EdgeUniform>, Vec2, Option<FrameUniform>), EdgeMap>,
    reach: Stage<u64, Reach>,
    operators: Stage<(u64, Vec2), Target>,
    cartoon_map: Stage<(u64, Vec<ToonUniform>, FrameUniform), Target>,
    surface: Stage<
        (u64, Option<[u64; 2]>, Vec<SurfaceUniform>, Vec<ToonUniform>, Vec<EdgeUniform>, FrameUniform),
        Target,
    >,
    accumulation: Accumulation,
    /// What this one went on from: held, so that the other one's pool does not hand out its textures before they have
    /// been read.
    origin: Option<Accumulation>,
    image: Stage<(u64, Show, [u64; 3], Vec4), Target>,
    /// The G-buffer of the picture's first sample: outlines do not follow the jitter.
    unmoved: u64,
    selection: Stage<(u64, Vec<u32>), Target>,
}

impl FrameState {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gbuffer_pass: GBufferPass::new(gpu),
            edge_map_pass: EdgeMapPass::new(gpu),
            greatest_radius: ArrayBuffer::new(gpu, "greatest radius"),
            edge_styles: ArrayBuffer::new(gpu, "edge styles"),
            surface_styles: ArrayBuffer::new(gpu, "surface styles"),
            toon_styles: ArrayBuffer::new(gpu, "toon styles"),
            selected: ArrayBuffer::new(gpu, "selected"),
            gbuffer: Stage::default(),
            segments: Stage::default(),
            edge_map: Stage::default(),
            reach: Stage::default(),
            operators: Stage::default(),
            cartoon_map: Stage::default(),
            surface: Stage::default(),
            accumulation: Accumulation::default(),
            origin: None,
            image: Stage::default(),
            unmoved: 0,
            selection: Stage::default(),
        }
    }

    /// Layout of the materials' bind group.
    pub fn material_layout(&self) -> &wgpu::BindGroupLayout {
        &self.gbuffer_pass.material_layout
    }

    /// How often each stage has run, by name.
    pub fn runs(&self) -> [(&'static str, u64); 6] {
        [
            ("g-buffer", self.gbuffer.runs()),
            ("edge map", self.edge_map.runs()),
            ("line distance", self.reach.runs()),
            ("cartoon map", self.cartoon_map.runs()),
            ("surface", self.surface.runs()),
            ("image", self.image.runs()),
        ]
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
        let shaders = rec.pipelines.generation();
        let (draws, calls) = inputs.objects.draws(inputs.scene, inputs.view);
        let geometry = (shaders, inputs.scene_revision, *inputs.view, draws, calls);
        let gbuffer = self
            .gbuffer
            .run(geometry, |(.., draws, calls)| self.gbuffer_pass.run(rec, inputs.scene, draws, calls))?;

        let what = inputs.document.view.show;
        let styles = &inputs.objects.edge_styles;
        self.edge_styles.write(rec.gpu, styles);
        let edge_map = if what != Show::Picture || inputs.objects.have_lines() {
            Some(self.find_edges(rec, inputs, &gbuffer)?)
        } else {
            self.edge_map.clear();
            None
        };

        let wanted_operators = matches!(what, Show::NormalOperator | Show::DepthOperator | Show::C1Operator);
        let operators = if wanted_operators {
            Some(self.operators.run((gbuffer.revision, inputs.depth_range), |_| {
                operators(rec, &gbuffer.value, self.edge_styles.buffer())
            })?)
        } else {
            self.operators.clear();
            None
        };

        let cartoon_map = if what == Show::Picture { self.find_bands(rec, inputs, &gbuffer)? } else { None };
        let image = if what == Show::Picture {
            let color = self.shade(rec, inputs, &gbuffer, edge_map.as_ref(), cartoon_map.as_ref())?;
            let color = self.accumulation.add(rec, inputs.sample, color)?;
            let final_inputs = (shaders, what, [color.revision, 0, 0], inputs.background);
            self.image.run(final_inputs, |_| resolve(rec, &color.value))?
        } else {
            self.surface.clear();
            let revisions = [
                gbuffer.revision,
                edge_map.as_ref().map_or(0, |e| e.revision),
                operators.as_ref().map_or(0, |o| o.revision),
            ];
            // A shader that does not read these is given any texture of their kind.
            let ink = edge_map.as_ref().map_or(&gbuffer.value.geometry, |e| &e.value.edges);
            let values = operators.as_ref().map_or(&gbuffer.value.base_color, |o| &o.value);
            self.image.run((shaders, what, revisions, Vec4::ZERO), |_| {
                show(rec, what, &gbuffer.value, ink, values)
            })?
        };

        Ok(Picture {
            selection: self.outline(rec, inputs, &gbuffer)?,
            image: image.value,
            sample: inputs.sample,
            revision: image.revision,
            gbuffer: gbuffer.value,
            operators: operators.map(|o| o.value),
            edge_map: edge_map.map(|e| e.value.edges),
            cartoon_map,
        })
    }

    fn find_edges(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &FrameInputs<'_>,
        gbuffer: &Output<GBuffer>,
    ) -> Result<Output<EdgeMap>, RenderError> {
        let styles: Vec<_> = inputs.objects.edge_styles.iter().map(EdgeUniform::for_finding).collect();
        // Only widths that follow the light depend on more than the geometry.
        let light = styles.iter().any(|s| s.by_light > 0.0).then(|| inputs.uniform.without_background());
        let crease_angle = inputs.document.view.crease_angle.to_radians();
        // Which edges are lines does not change from sample to sample.
        let view = inputs.view.moved(Vec2::ZERO);
        let found = (inputs.scene_revision, view, styles.clone(), crease_angle);
        let segments = self.segments.run(found, |_| {
            Ok::<_, RenderError>(Arc::new(segments(inputs.scene, inputs.objects, &view, crease_angle)))
        })?;
        let edges = (gbuffer.revision, styles, inputs.depth_range, light);
        self.edge_map.run(edges, |(_, styles, ..)| {
            self.edge_map_pass.run(
                rec,
                &EdgeInputs {
                    gbuffer: &gbuffer.value,
                    styles,
                    edge_styles: self.edge_styles.buffer(),
                    segments: &segments.value,
                    has_holes: inputs.objects.has_holes,
                },
            )
        })
    }

    fn find_bands(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &FrameInputs<'_>,
        gbuffer: &Output<GBuffer>,
    ) -> Result<Option<Target>, RenderError> {
        let toons = &inputs.objects.toon_styles;
        if !toons.is_empty() {
            self.toon_styles.write(rec.gpu, toons);
        }
        if !inputs.objects.have_cartoon_map() {
            self.cartoon_map.clear();
            return Ok(None);
        }
        let bands = (gbuffer.revision, toons.clone(), inputs.uniform.without_background());
        let map =
            self.cartoon_map.run(bands, |_| cartoon_map(rec, &gbuffer.value, self.toon_styles.buffer()))?;
        Ok(Some(map.value))
    }

    fn shade(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &FrameInputs<'_>,
        gbuffer: &Output<GBuffer>,
        edge_map: Option<&Output<EdgeMap>>,
        cartoon_map: Option<&Target>,
    ) -> Result<Output<Target>, RenderError> {
        let styles = &inputs.objects.edge_styles;
        let spines = edge_map.and_then(|e| Some((e.revision, e.value.spines.as_ref()?)));
        let reach = match spines {
            Some((revision, spines)) => Some(
                self.reach
                    .run(revision, |_| line_distance(rec, spines, styles, &mut self.greatest_radius))?,
            ),
            None => {
                self.reach.clear();
                None
            }
        };
        let revisions = edge_map.map(|e| [e.revision, reach.as_ref().map_or(0, |reach| reach.revision)]);
        let shading = (
            gbuffer.revision,
            revisions,
            inputs.objects.surface_styles.clone(),
            inputs.objects.toon_styles.clone(),
            styles.clone(),
            inputs.uniform.without_background(),
        );
        self.surface.run(shading, |(_, _, surfaces, toons, styles, _)| {
            self.surface_styles.write(rec.gpu, surfaces);
            let shading = Shading {
                surfaces,
                surface_styles: self.surface_styles.buffer(),
                toons,
                toon_styles: self.toon_styles.buffer(),
                cartoon_map,
            };
            let color = surface(rec, &gbuffer.value, &shading)?;
            if let Some(edge_map) = edge_map {
                lines(
                    rec,
                    &gbuffer.value,
                    &edge_map.value,
                    reach.as_ref().map(|reach| &reach.value),
                    styles,
                    self.edge_styles.buffer(),
                    &color,
                )?;
            }
            Ok(color)
        })
    }

    fn outline(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &FrameInputs<'_>,
        gbuffer: &Output<GBuffer>,
    ) -> Result<Option<Target>, RenderError> {
        if inputs.selected.is_empty() {
            self.selection.clear();
            return Ok(None);
        }
        if inputs.sample.index == 0 {
            self.unmoved = gbuffer.revision;
        }
        let bits = selection::bits(inputs.selected, inputs.scene.scene.nodes.len());
        let outline = self.selection.run((self.unmoved, bits), |(_, bits)| {
            self.selected.write(rec.gpu, bits);
            selection(rec, &gbuffer.value, self.selected.buffer())
        })?;
        Ok(Some(outline.value))
    }
}
