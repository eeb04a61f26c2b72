//! Shader modules and pipelines, made when first used and kept.

use std::borrow::Cow;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

use wgpu::naga::valid::ModuleInfo;
use wgpu::naga::{Module, ShaderStage};

use super::bindings::{Bindings, INPUTS};
use super::depth_rules::DepthTest;
use super::placeholders::Placeholders;
use super::specialize::specialized;
use super::uniform_arrays::make_uniform;
use super::{Gpu, Inputs, ShaderError, Shaders};

/// A shader of a file below `shaders/`, specialized: switches are its `override` constants, and what is switched off is
/// compiled away. Software devices run both sides of a branch, so this is what makes an unused feature free.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Program {
    /// File below `shaders/`.
    pub file: &'static str,
    /// Entry point of the fragment or compute shader.
    pub entry_point: &'static str,
    /// Names and values of boolean `override` constants.
    pub switches: Vec<(&'static str, bool)>,
}

impl Program {
    /// A program without switches.
    pub fn new(file: &'static str, entry_point: &'static str) -> Self {
        Self { file, entry_point, switches: Vec::new() }
    }

    fn constants(&self) -> Vec<(&'static str, f64)> {
        self.switches.iter().map(|(name, on)| (*name, f64::from(u8::from(*on)))).collect()
    }
}

/// Everything that a render pipeline depends on.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct RasterKey {
    /// Its fragment shader.
    pub program: Program,
    /// Formats of its outputs.
    pub outputs: Vec<wgpu::TextureFormat>,
    /// How outputs are laid over what is there.
    pub blend: Option<wgpu::BlendState>,
    /// Whether it has outputs at all; otherwise only the depth buffer knows of it.
    pub writes: bool,
    /// Its depth buffer.
    pub depth: Option<(wgpu::TextureFormat, DepthTest)>,
}

/// What a pipeline is made of, and how it reads arrays.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Variant<K> {
    key: K,
    /// Numbers of the arrays that are uniforms.
    uniforms: Vec<u32>,
}

/// A pipeline and the layout of its group 1.
#[derive(Clone)]
struct Cached<P> {
    pipeline: P,
    inputs: wgpu::BindGroupLayout,
}

/// A pipeline with what it reads and writes.
pub struct Bound<P> {
    /// The pipeline.
    pub pipeline: P,
    /// Bind group 1.
    pub inputs: wgpu::BindGroup,
}

/// The shader whose vertices cover the picture.
const FULLSCREEN: &str = "common/fullscreen.wgsl";

/// A shader of which pipelines are made.
#[derive(Clone)]
struct Shader {
    /// All of it, with numbered variables.
    source: Module,
    info: ModuleInfo,
    bindings: Bindings,
    /// All of it on the device, for pipelines with bind groups of their own.
    module: Option<wgpu::ShaderModule>,
}

/// Shader modules and pipelines, made when first used and kept.
#[derive(Clone)]
pub struct Pipelines {
    shaders: Shaders,
    parsed: HashMap<&'static str, Shader>,
    placeholders: Placeholders,
    raster: HashMap<Variant<RasterKey>, Cached<wgpu::RenderPipeline>>,
    compute: HashMap<Variant<Program>, Cached<wgpu::ComputePipeline>>,
    frame_layout: wgpu::BindGroupLayout,
    generation: u64,
}

impl Pipelines {
    /// No pipeline yet. If the shaders of a folder are wrong, the embedded ones are used and the mistake is returned.
    pub fn new(gpu: &Gpu, shaders: Shaders) -> (Self, Option<ShaderError>) {
        let error = if shaders.can_change() { validate_all(&shaders).err() } else { None };
        let shaders = if error.is_some() { Shaders::default() } else { shaders };
        (Self::of(gpu, shaders), error)
    }

    /// No pipeline yet, of shaders that are known to be right.
    pub(super) fn of(gpu: &Gpu, shaders: Shaders) -> Self {
        let frame_layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[
                wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::all(),
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                },
                wgpu::BindGroupLayoutEntry {
                    binding: 1,
                    visibility: wgpu::ShaderStages::FRAGMENT | wgpu::ShaderStages::COMPUTE,
                    ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering),
                    count: None,
                },
            ],
        });
        Self {
            shaders,
            parsed: HashMap::new(),
            placeholders: Placeholders::default(),
            raster: HashMap::new(),
            compute: HashMap::new(),
            frame_layout,
            generation: 0,
        }
    }

    /// Reads changed shaders again. When one of them is wrong, all pipelines stay as they are.
    ///
    /// # Errors
    /// The first mistake.
    pub fn reload(&mut self) -> Result<(), ShaderError> {
        let shaders = Shaders::from_environment();
        validate_all(&shaders)?;
        self.shaders = shaders;
        self.parsed.clear();
        self.raster.clear();
        self.compute.clear();
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

    /// The compiled shader of a file below `shaders/`, for a pipeline with bind groups of its own.
    ///
    /// # Errors
    /// [`ShaderError`]; that texts are valid is checked when they are loaded.
    pub fn module(&mut self, gpu: &Gpu, file: &'static str) -> Result<wgpu::ShaderModule, ShaderError> {
        let shader = self.shader(gpu, file)?;
        Ok(shader.module.get_or_insert_with(|| create_module(gpu, file, shader.source.clone())).clone())
    }

    fn shader(&mut self, gpu: &Gpu, file: &'static str) -> Result<&mut Shader, ShaderError> {
        match self.parsed.entry(file) {
            Entry::Occupied(known) => Ok(known.into_mut()),
            Entry::Vacant(place) => Ok(place.insert(parse(gpu, &self.shaders, file)?)),
        }
    }

    /// A render pipeline, with what its shader reads.
    ///
    /// # Errors
    /// [`ShaderError`].
    pub fn raster(
        &mut self,
        gpu: &Gpu,
        key: &RasterKey,
        inputs: &Inputs<'_>,
    ) -> Result<Bound<wgpu::RenderPipeline>, ShaderError> {
        let program = &key.program;
        let variant = Variant { key: key.clone(), uniforms: self.uniforms(gpu, program, inputs)? };
        if !self.raster.contains_key(&variant) {
            let frame = self.frame_layout.clone();
            let vertex = self.module(gpu, FULLSCREEN)?;
            let made = build_raster(gpu, &vertex, self.shader(gpu, program.file)?, &frame, &variant)?;
            self.raster.insert(variant.clone(), made);
        }
        let made = self.raster.get(&variant).ok_or_else(|| missing(program))?.clone();
        let inputs = self.bind(gpu, program, &made.inputs, &variant.uniforms, inputs)?;
        Ok(Bound { pipeline: made.pipeline, inputs })
    }

    /// A compute pipeline, with what its shader reads and writes.
    ///
    /// # Errors
    /// [`ShaderError`].
    pub fn compute(
        &mut self,
        gpu: &Gpu,
        program: &Program,
        inputs: &Inputs<'_>,
    ) -> Result<Bound<wgpu::ComputePipeline>, ShaderError> {
        let variant = Variant { key: program.clone(), uniforms: self.uniforms(gpu, program, inputs)? };
        if !self.compute.contains_key(&variant) {
            let frame = self.frame_layout.clone();
            let made = build_compute(gpu, self.shader(gpu, program.file)?, &frame, &variant)?;
            self.compute.insert(variant.clone(), made);
        }
        let made = self.compute.get(&variant).ok_or_else(|| missing(program))?.clone();
        let inputs = self.bind(gpu, program, &made.inputs, &variant.uniforms, inputs)?;
        Ok(Bound { pipeline: made.pipeline, inputs })
    }

    /// Which arrays a program reads as uniforms, with these inputs.
    pub(super) fn uniforms(
        &mut self,
        gpu: &Gpu,
        program: &Program,
        inputs: &Inputs<'_>,
    ) -> Result<Vec<u32>, ShaderError> {
        Ok(self.shader(gpu, program.file)?.bindings.uniforms(program.entry_point, inputs))
    }

    fn bind(
        &mut self,
        gpu: &Gpu,
        program: &Program,
        layout: &wgpu::BindGroupLayout,
        uniforms: &[u32],
        inputs: &Inputs<'_>,
    ) -> Result<wgpu::BindGroup, ShaderError> {
        let shader = self.parsed.get(program.file).ok_or_else(|| missing(program))?;
        let Program { file, entry_point, .. } = *program;
        shader.bindings.group(gpu, &mut self.placeholders, file, entry_point, layout, uniforms, inputs)
    }
}

fn parse(gpu: &Gpu, shaders: &Shaders, file: &'static str) -> Result<Shader, ShaderError> {
    let (module, info) = shaders.module(file, gpu.integer_textures)?;
    let bindings = Bindings::of(&module, &info).map_err(|name| ShaderError::Invalid {
        file: file.to_owned(),
        line: 0,
        message: format!("no pass can give anything for {name}"),
    })?;
    Ok(Shader { source: module, info, bindings, module: None })
}

fn create_module(gpu: &Gpu, file: &'static str, source: Module) -> wgpu::ShaderModule {
    let source = wgpu::ShaderSource::Naga(Cow::Owned(source));
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(file), source })
}

impl Shader {
    /// The entry point of a program, without what is switched off.
    fn specialized(
        &self,
        gpu: &Gpu,
        stage: ShaderStage,
        program: &Program,
        uniforms: &[u32],
    ) -> Result<wgpu::ShaderModule, ShaderError> {
        let Program { file, entry_point, .. } = *program;
        specialized(&self.source, &self.info, stage, entry_point, &program.constants())
            .map(|mut source| {
                make_uniform(&mut source, INPUTS, uniforms);
                create_module(gpu, file, source)
            })
            .map_err(|message| ShaderError::Invalid {
                file: file.to_owned(),
                line: 0,
                message: format!("{entry_point}: {message}"),
            })
    }
}

fn missing(program: &Program) -> ShaderError {
    ShaderError::Missing { file: program.file.to_owned(), imported_by: None }
}

fn validate_all(shaders: &Shaders) -> Result<(), ShaderError> {
    Shaders::embedded().iter().try_for_each(|file| shaders.validate(file).map(|_module| ()))
}

fn pipeline_layout(
    gpu: &Gpu,
    label: &str,
    frame: &wgpu::BindGroupLayout,
    inputs: &wgpu::BindGroupLayout,
) -> wgpu::PipelineLayout {
    gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &[Some(frame), Some(inputs)],
        immediate_size: 0,
    })
}

fn build_raster(
    gpu: &Gpu,
    vertex: &wgpu::ShaderModule,
    shader: &Shader,
    frame_layout: &wgpu::BindGroupLayout,
    Variant { key, uniforms }: &Variant<RasterKey>,
) -> Result<Cached<wgpu::RenderPipeline>, ShaderError> {
    let label = key.program.file;
    let inputs =
        shader.bindings.layout(gpu, label, key.program.entry_point, wgpu::ShaderStages::FRAGMENT, uniforms);
    let fragment = shader.specialized(gpu, ShaderStage::Fragment, &key.program, uniforms)?;
    let write_mask = if key.writes { wgpu::ColorWrites::ALL } else { wgpu::ColorWrites::empty() };
    let targets: Vec<_> = key
        .outputs
        .iter()
        .map(|&format| Some(wgpu::ColorTargetState { format, blend: key.blend, write_mask }))
        .collect();
    let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(&pipeline_layout(gpu, label, frame_layout, &inputs)),
        vertex: wgpu::VertexState {
            module: vertex,
            entry_point: Some("vs_fullscreen"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: key.depth.map(|(format, test)| test.state(format)),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &fragment,
            entry_point: Some(key.program.entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    });
    Ok(Cached { pipeline, inputs })
}

fn build_compute(
    gpu: &Gpu,
    shader: &Shader,
    frame_layout: &wgpu::BindGroupLayout,
    Variant { key: program, uniforms }: &Variant<Program>,
) -> Result<Cached<wgpu::ComputePipeline>, ShaderError> {
    let label = program.file;
    let inputs =
        shader.bindings.layout(gpu, label, program.entry_point, wgpu::ShaderStages::COMPUTE, uniforms);
    let module = shader.specialized(gpu, ShaderStage::Compute, program, uniforms)?;
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(label),
        layout: Some(&pipeline_layout(gpu, label, frame_layout, &inputs)),
        module: &module,
        entry_point: Some(program.entry_point),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    Ok(Cached { pipeline, inputs })
}
