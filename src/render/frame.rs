//! THE FRAME: from a scene to the final image, in the order of the edge-enhancement paper's pipeline.
//!
//! ```text
//! objects ─► G-buffer ─► edge map ─► shaded surfaces + lines ─► resolve ─► final image
//! ```

use glam::{Vec2, Vec4};

use super::RenderError;
use super::effects::surface::{SurfaceUniform, surface};
use super::frame_uniform::{FrameUniform, View};
use super::gpu_scene::GpuScene;
use super::groups::Objects;
use super::passes::edge_map::{EdgeUniform, edge_map, operators};
use super::passes::gbuffer::{DrawCall, DrawUniform, GBuffer, GBufferPass};
use super::passes::resolve::resolve;
use super::passes::selection::{self, selection};
use super::passes::show::show;
use super::stage::{Output, Stage};
use crate::document::{Document, Show};
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
    /// The camera.
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
    /// The final image.
    pub image: Target,
    /// Changes when the image does.
    pub revision: u64,
    /// Outline of the selection, if anything is selected.
    pub selection: Option<Target>,
    /// Per-pixel geometry, for picking and for tests.
    pub gbuffer: GBuffer,
    /// Operators' values, if they were shown.
    pub operators: Option<Target>,
    /// Inner and profile ink per pixel; `None` when no object has lines.
    pub edge_map: Option<Target>,
}

/// What lives across frames.
pub struct FrameState {
    gbuffer_pass: GBufferPass,
    edge_styles: ArrayBuffer,
    surface_styles: ArrayBuffer,
    selected: ArrayBuffer,
    gbuffer: Stage<(u64, u64, View, Vec<DrawUniform>, Vec<DrawCall>), GBuffer>,
    edge_map: Stage<(u64, Vec<EdgeUniform>, Vec2), Target>,
    operators: Stage<(u64, Vec2), Target>,
    surface: Stage<(u64, Option<u64>, Vec<SurfaceUniform>, FrameUniform), Target>,
    image: Stage<(u64, Show, [u64; 3], Vec4), Target>,
    selection: Stage<(u64, Vec<u32>), Target>,
}

impl FrameState {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gbuffer_pass: GBufferPass::new(gpu),
            edge_styles: ArrayBuffer::new(gpu, "edge styles"),
            surface_styles: ArrayBuffer::new(gpu, "surface styles"),
            selected: ArrayBuffer::new(gpu, "selected"),
            gbuffer: Stage::default(),
            edge_map: Stage::default(),
            operators: Stage::default(),
            surface: Stage::default(),
            image: Stage::default(),
            selection: Stage::default(),
        }
    }

    /// Layout of the materials' bind group.
    pub fn material_layout(&self) -> &wgpu::BindGroupLayout {
        &self.gbuffer_pass.material_layout
    }

    /// How often each stage has run, by name.
    pub fn runs(&self) -> [(&'static str, u64); 4] {
        [
            ("g-buffer", self.gbuffer.runs()),
            ("edge map", self.edge_map.runs()),
            ("surface", self.surface.runs()),
            ("image", self.image.runs()),
        ]
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
        let edge_map = if what != Show::Picture || inputs.objects.have_lines() {
            let edges = (gbuffer.revision, inputs.objects.edge_styles.clone(), inputs.depth_range);
            Some(self.edge_map.run(edges, |(_, styles, _)| {
                self.edge_styles.write(rec.gpu, styles);
                edge_map(rec, &gbuffer.value, styles, self.edge_styles.buffer())
            })?)
        } else {
            self.edge_map.clear();
            None
        };
        let edge_revision = edge_map.as_ref().map(|e| e.revision);
        let edge_map = edge_map.map(|e| e.value);

        let wanted_operators = matches!(what, Show::NormalOperator | Show::DepthOperator | Show::C1Operator);
        let operators = if wanted_operators {
            Some(self.operators.run((gbuffer.revision, inputs.depth_range), |_| {
                operators(rec, &gbuffer.value, self.edge_styles.buffer())
            })?)
        } else {
            self.operators.clear();
            None
        };

        let image = if what == Show::Picture {
            let shading = (
                gbuffer.revision,
                edge_revision,
                inputs.objects.surface_styles.clone(),
                inputs.uniform.without_background(),
            );
            let color = self.surface.run(shading, |(_, _, styles, _)| {
                self.surface_styles.write(rec.gpu, styles);
                let (surfaces, edges) = (self.surface_styles.buffer(), self.edge_styles.buffer());
                surface(rec, &gbuffer.value, edge_map.as_ref(), styles, surfaces, edges)
            })?;
            let final_inputs = (shaders, what, [color.revision, 0, 0], inputs.background);
            self.image.run(final_inputs, |_| resolve(rec, &color.value))?
        } else {
            self.surface.clear();
            let revisions =
                [gbuffer.revision, edge_revision.unwrap_or(0), operators.as_ref().map_or(0, |o| o.revision)];
            // A shader that does not read these is given any texture of their kind.
            let ink = edge_map.as_ref().unwrap_or(&gbuffer.value.geometry);
            let values = operators.as_ref().map_or(&gbuffer.value.base_color, |o| &o.value);
            self.image.run((shaders, what, revisions, Vec4::ZERO), |_| {
                show(rec, what, &gbuffer.value, ink, values)
            })?
        };

        Ok(Picture {
            selection: self.outline(rec, inputs, &gbuffer)?,
            image: image.value,
            revision: image.revision,
            gbuffer: gbuffer.value,
            operators: operators.map(|o| o.value),
            edge_map,
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
        let bits = selection::bits(inputs.selected, inputs.scene.scene.nodes.len());
        let outline = self.selection.run((gbuffer.revision, bits), |(_, bits)| {
            self.selected.write(rec.gpu, bits);
            selection(rec, &gbuffer.value, self.selected.buffer())
        })?;
        Ok(Some(outline.value))
    }
}
