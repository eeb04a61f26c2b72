//! Recording a frame: passes from textures to textures.
//!
//! Bind group 0 is the frame's uniform, group 1 what a pass reads and writes: see [`super::bindings`].

use std::collections::BTreeMap;

use super::bindings::INPUTS;
use super::clears::cleared;
use super::depth_rules::DepthRule;
use super::pipelines::{Pipelines, Program, RasterKey};
use super::{Gpu, GpuError, Inputs, Predicate, ShaderError, Target, TargetPool, Timers, drawn_as};

/// What a pass does with what its outputs hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Onto {
    /// They are cleared to 0.
    Clear,
    /// What is not drawn over stays.
    Load,
    /// Drawn over it with premultiplied alpha.
    Over,
    /// Drawn under it with premultiplied alpha: what is there hides it.
    Under,
    /// The greater of both, channel by channel: with premultiplied alpha, what overlaps gets no stronger.
    Max,
}

impl Onto {
    fn blend(self) -> Option<wgpu::BlendState> {
        let under = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::OneMinusDstAlpha,
            dst_factor: wgpu::BlendFactor::One,
            operation: wgpu::BlendOperation::Add,
        };
        let greatest = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::One,
            dst_factor: wgpu::BlendFactor::One,
            operation: wgpu::BlendOperation::Max,
        };
        match self {
            Self::Clear | Self::Load => None,
            Self::Over => Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            Self::Under => Some(wgpu::BlendState { color: under, alpha: under }),
            Self::Max => Some(wgpu::BlendState { color: greatest, alpha: greatest }),
        }
    }
}

/// One render pass with one draw, or two.
pub struct Draw<'a> {
    /// Name, for timings.
    pub label: &'static str,
    /// Its shader.
    pub program: Program,
    /// What its shader reads.
    pub inputs: &'a Inputs<'a>,
    /// Locations of the fragment shader.
    pub outputs: &'a [&'a Target],
    /// What becomes of what they hold.
    pub onto: Onto,
    /// Its depth buffer.
    pub depth: Option<(&'a Target, DepthRule)>,
}

/// How many workgroups run a compute program.
#[derive(Clone, Copy)]
pub enum Workgroups<'a> {
    /// Columns and rows of them.
    Counted([u32; 2]),
    /// As many as a compute shader has written here. The predicate does not stop these: a shader that it does stop must have left
    /// none.
    Written(&'a wgpu::Buffer),
}

impl From<[u32; 2]> for Workgroups<'_> {
    fn from(counted: [u32; 2]) -> Self {
        Self::Counted(counted)
    }
}

impl<'a> From<&'a wgpu::Buffer> for Workgroups<'a> {
    fn from(written: &'a wgpu::Buffer) -> Self {
        Self::Written(written)
    }
}

/// One frame while it is being recorded.
pub struct Recorder<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// Shaders and pipelines.
    pub pipelines: &'a mut Pipelines,
    /// Where commands go.
    pub encoder: wgpu::CommandEncoder,
    /// Bind group 0 of the passes from here on.
    pub frame: wgpu::BindGroup,
    /// The part of the picture into which render passes draw from here on, though all of it is cleared: left, top, right and
    /// bottom edge; `None`: all of it.
    pub scissor_rect: Option<[u32; 4]>,
    /// Passes from here on draw and compute only while it is enabled.
    pub predicate: Option<Predicate>,
    pool: &'a mut TargetPool,
    timers: Option<&'a mut Timers>,
    size: [u32; 2],
    intermediates: &'a mut Intermediates,
}

/// Textures that a picture was made of, by name, for whoever looks at them: those under names that are entered here are kept.
/// A name may stand for several.
pub type Intermediates = BTreeMap<&'static str, Vec<Target>>;

impl<'a> Recorder<'a> {
    /// Begins a frame of `size` pixels.
    pub fn new(
        gpu: &'a Gpu,
        pipelines: &'a mut Pipelines,
        pool: &'a mut TargetPool,
        timers: Option<&'a mut Timers>,
        frame: wgpu::BindGroup,
        size: [u32; 2],
        intermediates: &'a mut Intermediates,
    ) -> Self {
        let encoder = encoder(gpu);
        Self {
            gpu,
            pipelines,
            encoder,
            frame,
            scissor_rect: None,
            predicate: None,
            pool,
            timers,
            size,
            intermediates,
        }
    }

    /// Whether anybody looks at what has this name.
    pub fn captures(&self, name: &str) -> bool {
        self.intermediates.contains_key(name)
    }

    /// Keeps a texture under a name, in place of an earlier one, if anybody looks at it; `None`: there is none.
    pub fn note(&mut self, name: &str, target: Option<&Target>) {
        if let Some(kept) = self.intermediates.get_mut(name) {
            kept.clear();
            kept.extend(target.cloned());
        }
    }

    /// The same beside earlier ones.
    pub fn note_another(&mut self, name: &str, target: &Target) {
        if let Some(kept) = self.intermediates.get_mut(name) {
            kept.push(target.clone());
        }
    }

    /// Records something of which nobody looks at intermediate textures.
    pub fn unwatched<T>(&mut self, record: impl FnOnce(&mut Self) -> T) -> T {
        let watched = std::mem::take(self.intermediates);
        let recorded = record(self);
        *self.intermediates = watched;
        recorded
    }

    /// Submits what has been recorded so far: what is written to buffers from here on is for what follows.
    pub fn flush(&mut self) {
        let recorded = std::mem::replace(&mut self.encoder, encoder(self.gpu));
        self.gpu.queue.submit([recorded.finish()]);
    }

    /// Width and height of the picture in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// A target as large as the picture, with undefined contents.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn target(&mut self, label: &str, format: wgpu::TextureFormat) -> Result<Target, GpuError> {
        self.pool.get(self.gpu, label, self.size, format)
    }

    /// A target of another size than the picture, with undefined contents.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn target_of(
        &mut self,
        label: &str,
        format: wgpu::TextureFormat,
        size: [u32; 2],
    ) -> Result<Target, GpuError> {
        self.pool.get(self.gpu, label, size, format)
    }

    /// Targets as outputs of the pass that is recorded next.
    pub fn attachments<'t>(
        &mut self,
        onto: Onto,
        outputs: &[&'t Target],
    ) -> Vec<Option<wgpu::RenderPassColorAttachment<'t>>> {
        match onto {
            Onto::Clear => cleared(self.gpu, &mut self.encoder, outputs),
            Onto::Load | Onto::Over | Onto::Under | Onto::Max => {
                outputs.iter().map(|output| Some(color_attachment(output, wgpu::LoadOp::Load))).collect()
            }
        }
    }

    /// Begins a render pass that is timed under its label.
    pub fn pass<'e>(
        &'e mut self,
        label: &'static str,
        color: &[Option<wgpu::RenderPassColorAttachment<'_>>],
        depth: Option<wgpu::RenderPassDepthStencilAttachment<'_>>,
    ) -> wgpu::RenderPass<'e> {
        let timestamp_writes = self.timers.as_mut().and_then(|t| t.pass(label));
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: color,
            depth_stencil_attachment: depth,
            timestamp_writes: timestamp_writes.map(|t| wgpu::RenderPassTimestampWrites {
                query_set: t.query_set,
                beginning_of_pass_write_index: Some(t.begin),
                end_of_pass_write_index: Some(t.end),
            }),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, &self.frame, &[]);
        if let Some([left, top, right, bottom]) = self.scissor_rect {
            pass.set_scissor_rect(left, top, right - left, bottom - top);
        }
        pass
    }

    /// Runs a program once per pixel: `outputs` its locations, which are cleared
    /// to 0. With a `covered` depth buffer it runs only where something was drawn.
    ///
    /// # Errors
    /// [`ShaderError`].
    pub fn fullscreen(
        &mut self,
        label: &'static str,
        program: Program,
        inputs: &Inputs<'_>,
        outputs: &[&Target],
        covered: Option<&Target>,
    ) -> Result<(), ShaderError> {
        let depth = covered.map(|target| (target, DepthRule::Covered));
        self.draw(Draw { label, program, inputs, outputs, onto: Onto::Clear, depth })
    }

    /// Runs one render pass.
    ///
    /// # Errors
    /// [`ShaderError`].
    pub fn draw(&mut self, draw: Draw<'_>) -> Result<(), ShaderError> {
        let key = RasterKey {
            program: draw.program,
            outputs: draw.outputs.iter().map(|o| drawn_as(o.format())).collect(),
            blend: draw.onto.blend(),
            writes: true,
            depth: draw.depth.map(|(target, rule)| (target.format(), rule.test())),
        };
        let marker = draw.depth.and_then(|(target, rule)| {
            let (entry_point, test) = rule.marker()?;
            let program = Program { entry_point, ..key.program.clone() };
            Some(RasterKey {
                program,
                blend: None,
                writes: false,
                depth: Some((target.format(), test)),
                ..key.clone()
            })
        });
        let mut draws = Vec::new();
        for key in marker.iter().chain([&key]) {
            let bound = self.pipelines.raster(self.gpu, key, draw.inputs)?;
            let viewport = draw.depth.zip(key.depth).map(|((target, rule), (_, test))| {
                (target.size().map(|side| side as f32), rule.depths(test))
            });
            draws.push((bound, viewport));
        }
        let color = self.attachments(draw.onto, draw.outputs);
        let depth = draw.depth.map(|(target, rule)| rule.attachment(target));
        let predicated = self.predicated(&[[3, 1, 0, 0, 0]]);
        let mut pass = self.pass(draw.label, &color, depth);
        for (bound, viewport) in &draws {
            pass.set_pipeline(&bound.pipeline);
            pass.set_bind_group(INPUTS, &bound.inputs, &[]);
            if let Some(([width, height], [least, greatest])) = *viewport {
                pass.set_viewport(0.0, 0.0, width, height, least, greatest);
            }
            match &predicated {
                Some((buffer, offset)) => pass.draw_indirect(buffer, *offset),
                None => pass.draw(0..3, 0..1),
            }
        }
        Ok(())
    }

    /// Where the arguments of draws or dispatches lie that the predicate may stop; `None`: they are not to be stopped.
    pub fn predicated(&mut self, args: &[[u32; 5]]) -> Option<(wgpu::Buffer, u64)> {
        let predicate = self.predicate.as_mut()?;
        let offset = predicate.offset(args)?;
        Some((predicate.buffer().clone(), offset))
    }

    /// Clears targets.
    pub fn clear(&mut self, label: &'static str, targets: &[&Target]) {
        let color = self.attachments(Onto::Clear, targets);
        self.pass(label, &color, None);
    }

    /// Copies a target into another one of the same size and format.
    pub fn copy(&mut self, from: &Target, to: &Target) {
        self.encoder.copy_texture_to_texture(
            from.texture().as_image_copy(),
            to.texture().as_image_copy(),
            to.texture().size(),
        );
    }

    /// Runs a compute program.
    ///
    /// # Errors
    /// [`ShaderError`].
    pub fn compute<'w>(
        &mut self,
        label: &'static str,
        program: &Program,
        inputs: &Inputs<'_>,
        workgroups: impl Into<Workgroups<'w>>,
    ) -> Result<(), ShaderError> {
        let bound = self.pipelines.compute(self.gpu, program, inputs)?;
        let workgroups = workgroups.into();
        let predicated = match workgroups {
            Workgroups::Counted([columns, rows]) => self.predicated(&[[columns, rows, 1, 0, 0]]),
            Workgroups::Written(_) => None,
        };
        let timestamp_writes = self.timers.as_mut().and_then(|t| t.pass(label));
        let mut pass = self.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(label),
            timestamp_writes: timestamp_writes.map(|t| wgpu::ComputePassTimestampWrites {
                query_set: t.query_set,
                beginning_of_pass_write_index: Some(t.begin),
                end_of_pass_write_index: Some(t.end),
            }),
        });
        pass.set_pipeline(&bound.pipeline);
        pass.set_bind_group(0, &self.frame, &[]);
        pass.set_bind_group(INPUTS, &bound.inputs, &[]);
        match (&predicated, workgroups) {
            (Some((buffer, offset)), _) => pass.dispatch_workgroups_indirect(buffer, *offset),
            (None, Workgroups::Counted([columns, rows])) => pass.dispatch_workgroups(columns, rows, 1),
            (None, Workgroups::Written(buffer)) => pass.dispatch_workgroups_indirect(buffer, 0),
        }
        Ok(())
    }

    /// Submits what was recorded.
    pub fn submit(mut self) {
        if let Some(timers) = &self.timers {
            timers.resolve(&mut self.encoder);
        }
        self.gpu.queue.submit([self.encoder.finish()]);
    }
}

fn encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") })
}

pub(super) fn color_attachment(
    target: &Target,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view: target.attachment(),
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
    }
}
