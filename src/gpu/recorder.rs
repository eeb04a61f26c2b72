//! Recording a frame: passes from textures to textures.
//!
//! Bind group 0 is the frame's uniform, group 1 the inputs of a pass in the order in which they are given.

use std::collections::HashMap;

use super::{Gpu, GpuError, ShaderError, Shaders, Target, TargetPool, Timers};

/// What a full-screen pass reads, in the order of its bindings in group 1.
#[derive(Clone, Copy)]
pub enum Input<'a> {
    /// A texture, read by `textureLoad`.
    Texture(&'a Target),
    /// A read-only storage buffer.
    Storage(&'a wgpu::Buffer),
}

/// A fragment shader of a file below `shaders/`, specialised: switches are its `override` constants, and what is
/// switched off is compiled away. Software devices run both sides of a branch, so this is what makes an unused
/// feature free.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Program {
    /// File below `shaders/`.
    pub file: &'static str,
    /// Entry point.
    pub entry_point: &'static str,
    /// Names and values of boolean `override` constants.
    pub switches: Vec<(&'static str, bool)>,
}

impl Program {
    /// A program without switches.
    pub fn new(file: &'static str, entry_point: &'static str) -> Self {
        Self { file, entry_point, switches: Vec::new() }
    }
}

#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct FullscreenKey {
    program: Program,
    inputs: Vec<Option<wgpu::TextureFormat>>,
    outputs: Vec<wgpu::TextureFormat>,
    covered: Option<wgpu::TextureFormat>,
}

struct Fullscreen {
    pipeline: wgpu::RenderPipeline,
    inputs: wgpu::BindGroupLayout,
}

/// Shader modules and pipelines, made when first used and kept.
pub struct Pipelines {
    shaders: Shaders,
    modules: HashMap<&'static str, wgpu::ShaderModule>,
    fullscreen: HashMap<FullscreenKey, Fullscreen>,
    frame_layout: wgpu::BindGroupLayout,
    generation: u64,
}

impl Pipelines {
    /// No pipeline yet. If the shaders of a folder are wrong, the embedded ones are used and the mistake is returned.
    pub fn new(gpu: &Gpu, shaders: Shaders) -> (Self, Option<ShaderError>) {
        let error = if shaders.can_change() { validate_all(&shaders).err() } else { None };
        let shaders = if error.is_some() { Shaders::default() } else { shaders };
        let frame_layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let pipelines = Self {
            shaders,
            modules: HashMap::new(),
            fullscreen: HashMap::new(),
            frame_layout,
            generation: 0,
        };
        (pipelines, error)
    }

    /// Reads changed shaders again. When one of them is wrong, all pipelines stay as they are.
    ///
    /// # Errors
    /// The first mistake.
    pub fn reload(&mut self) -> Result<(), ShaderError> {
        let shaders = Shaders::from_environment();
        validate_all(&shaders)?;
        self.shaders = shaders;
        self.modules.clear();
        self.fullscreen.clear();
        self.generation += 1;
        Ok(())
    }

    /// Changes whenever pipelines made before are out of date.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// The layout of bind group 0.
    pub fn frame_layout(&self) -> &wgpu::BindGroupLayout {
        &self.frame_layout
    }

    /// The compiled shader of a file below `shaders/`.
    ///
    /// # Errors
    /// [`ShaderError::Missing`]; that texts are valid is checked when they are loaded.
    pub fn module(&mut self, gpu: &Gpu, file: &'static str) -> Result<wgpu::ShaderModule, ShaderError> {
        if let Some(module) = self.modules.get(file) {
            return Ok(module.clone());
        }
        let composed = self.shaders.compose(file)?;
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(file),
            source: wgpu::ShaderSource::Wgsl(composed.text.into()),
        });
        self.modules.insert(file, module.clone());
        Ok(module)
    }

    fn fullscreen(&mut self, gpu: &Gpu, key: &FullscreenKey) -> Result<&Fullscreen, ShaderError> {
        if !self.fullscreen.contains_key(key) {
            let module = self.module(gpu, key.program.file)?;
            let made = build_fullscreen(gpu, &module, &self.frame_layout, key);
            self.fullscreen.insert(key.clone(), made);
        }
        self.fullscreen
            .get(key)
            .ok_or_else(|| ShaderError::Missing { file: key.program.file.to_owned(), imported_by: None })
    }
}

fn validate_all(shaders: &Shaders) -> Result<(), ShaderError> {
    Shaders::embedded().iter().try_for_each(|file| shaders.validate(file).map(|_composed| ()))
}

fn build_fullscreen(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    frame_layout: &wgpu::BindGroupLayout,
    key: &FullscreenKey,
) -> Fullscreen {
    let entries: Vec<_> = key
        .inputs
        .iter()
        .enumerate()
        .map(|(binding, format)| wgpu::BindGroupLayoutEntry {
            binding: binding as u32,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: match format {
                Some(format) => wgpu::BindingType::Texture {
                    sample_type: match format.sample_type(None, None) {
                        Some(wgpu::TextureSampleType::Float { .. }) | None => {
                            wgpu::TextureSampleType::Float { filterable: false }
                        }
                        Some(other) => other,
                    },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                None => wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only: true },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
            },
            count: None,
        })
        .collect();
    let inputs = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(key.program.file),
        entries: &entries,
    });
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(key.program.file),
        bind_group_layouts: &[Some(frame_layout), Some(&inputs)],
        immediate_size: 0,
    });
    let constants: Vec<_> =
        key.program.switches.iter().map(|(name, on)| (*name, f64::from(u8::from(*on)))).collect();
    let targets: Vec<_> = key.outputs.iter().map(|format| Some((*format).into())).collect();
    let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(key.program.file),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vs_fullscreen"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        // The triangle lies at depth 0, where the reversed buffer is cleared: only what is nearer passes.
        depth_stencil: key.covered.map(|format| wgpu::DepthStencilState {
            format,
            depth_write_enabled: Some(false),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(key.program.entry_point),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..Default::default()
            },
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    });
    Fullscreen { pipeline, inputs }
}

/// One frame while it is being recorded.
pub struct Recorder<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// Shaders and pipelines.
    pub pipelines: &'a mut Pipelines,
    /// Where commands go.
    pub encoder: wgpu::CommandEncoder,
    /// Bind group 0.
    pub frame: &'a wgpu::BindGroup,
    pool: &'a mut TargetPool,
    timers: Option<&'a mut Timers>,
    size: [u32; 2],
}

impl<'a> Recorder<'a> {
    /// Begins a frame of `size` pixels.
    pub fn new(
        gpu: &'a Gpu,
        pipelines: &'a mut Pipelines,
        pool: &'a mut TargetPool,
        timers: Option<&'a mut Timers>,
        frame: &'a wgpu::BindGroup,
        size: [u32; 2],
    ) -> Self {
        let encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        Self { gpu, pipelines, encoder, frame, pool, timers, size }
    }

    /// A target as large as the picture, with undefined contents.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn target(&mut self, label: &str, format: wgpu::TextureFormat) -> Result<Target, GpuError> {
        self.pool.get(self.gpu, label, self.size, format)
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
            timestamp_writes,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, self.frame, &[]);
        pass
    }

    /// Runs a program once per pixel: `inputs` are its bindings in group 1, `outputs` its locations, which are cleared
    /// to 0. With a `covered` depth buffer it runs only where something was drawn.
    ///
    /// # Errors
    /// [`ShaderError::Missing`].
    pub fn fullscreen(
        &mut self,
        label: &'static str,
        program: Program,
        inputs: &[Input<'_>],
        outputs: &[&Target],
        covered: Option<&Target>,
    ) -> Result<(), ShaderError> {
        let key = FullscreenKey {
            program,
            inputs: inputs
                .iter()
                .map(|i| match i {
                    Input::Texture(target) => Some(target.format()),
                    Input::Storage(_) => None,
                })
                .collect(),
            outputs: outputs.iter().map(|o| o.format()).collect(),
            covered: covered.map(Target::format),
        };
        let made = self.pipelines.fullscreen(self.gpu, &key)?;
        let pipeline = made.pipeline.clone();
        let entries: Vec<_> = inputs
            .iter()
            .enumerate()
            .map(|(binding, input)| wgpu::BindGroupEntry {
                binding: binding as u32,
                resource: match input {
                    Input::Texture(target) => wgpu::BindingResource::TextureView(target.view()),
                    Input::Storage(buffer) => buffer.as_entire_binding(),
                },
            })
            .collect();
        let group = self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(label),
            layout: &made.inputs,
            entries: &entries,
        });
        let color: Vec<_> = outputs
            .iter()
            .map(|o| Some(color_attachment(o, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT))))
            .collect();
        let depth = covered.map(|depth| wgpu::RenderPassDepthStencilAttachment {
            view: depth.view(),
            depth_ops: None,
            stencil_ops: None,
        });
        let mut pass = self.pass(label, &color, depth);
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(1, &group, &[]);
        pass.draw(0..3, 0..1);
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

/// A target as an output of a pass.
pub fn color_attachment(
    target: &Target,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view: target.view(),
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
    }
}
