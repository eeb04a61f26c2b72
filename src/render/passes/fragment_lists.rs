//! Fragment lists: all that a group covers, collected per pixel in one traversal of the scene and split into the same depth
//! layers as peeling gives (Yang et al. 2010, "Real-Time Concurrent Linked List Construction on the GPU").
//!
//! A list holds as many fragments as there is room for, and all are counted: who finds out later that there were more
//! makes room and draws again. See `shaders/common/fragments.wgsl`.

use super::count::{Layer, LayerCount};
use super::gbuffer::{DEPTH, GBuffer};
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{DepthRule, Gpu, GpuError, Inputs, Program, RecordTexture, Recorder, Target, inputs};
use crate::render::base::error::RenderError;

/// Bytes of a fragment's base color. How it is linked and what it is take a texel each.
const COLOR_BYTES: u64 = 4;

/// As many layers are sorted at a time: a pass has no more targets.
const SORTED: u32 = 8;

/// For each pixel the number of a fragment.
const NUMBERS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// More fragments are never kept: they take 288 MiB.
const MAX_FRAGMENTS: u64 = 1 << 23;

/// Memory for the fragments of one group after the other.
pub struct FragmentLists {
    layout: wgpu::BindGroupLayout,
    heads: wgpu::Buffer,
    nodes: RecordTexture,
    payloads: RecordTexture,
    colors: wgpu::Buffer,
    /// The most memory that was asked for since the last [`Self::shrink`].
    asked: u64,
}

impl FragmentLists {
    /// Without room for anything.
    pub fn new(gpu: &Gpu) -> Self {
        let buffer = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: false },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let texture = wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: wgpu::TextureFormat::Rgba32Uint,
            view_dimension: wgpu::TextureViewDimension::D2,
        };
        let written = |(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        Self {
            layout: gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("fragment lists"),
                entries: &[(0, buffer), (1, buffer), (2, texture), (3, texture), (4, buffer)].map(written),
            }),
            heads: create(gpu, "heads of lists", 4),
            nodes: RecordTexture::new(gpu, "nodes of fragments"),
            payloads: RecordTexture::new(gpu, "fragments"),
            colors: create(gpu, "colors of fragments", COLOR_BYTES),
            asked: 0,
        }
    }

    /// The most fragments that a device can keep; 0 where shaders of fragments cannot write.
    pub fn most(gpu: &Gpu) -> u64 {
        let limits = gpu.device.limits();
        if !gpu.writes_in_fragments
            || limits.max_storage_buffers_per_shader_stage < 3
            || limits.max_storage_textures_per_shader_stage < 2
        {
            return 0;
        }
        let bytes = limits.max_buffer_size.min(limits.max_storage_buffer_binding_size);
        MAX_FRAGMENTS.min(bytes / COLOR_BYTES).min(RecordTexture::max_texels(gpu))
    }

    /// Layout of the bind group that fragments are written through.
    pub(super) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// The bind group that fragments are written through; `count` counts them.
    pub(super) fn group<'a>(&'a self, gpu: &Gpu, count: &'a LayerCount) -> wgpu::BindGroup {
        let texture =
            |texture: &'a RecordTexture| wgpu::BindingResource::TextureView(texture.target().view());
        let resources = [
            count.buffer().as_entire_binding(),
            self.heads.as_entire_binding(),
            texture(&self.nodes),
            texture(&self.payloads),
            self.colors.as_entire_binding(),
        ];
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("fragment lists"),
            layout: &self.layout,
            entries: &entries,
        })
    }

    /// Empties all lists, for so many fragments; returns their capacity.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn begin(&mut self, rec: &mut Recorder<'_>, fragments: u64) -> Result<u64, GpuError> {
        let [width, height] = rec.size().map(u64::from);
        let (gpu, heads) = (rec.gpu, width * height * 4);
        gpu.check_bytes_of_pixels("in which something is seen through", rec.size(), 4)?;
        if self.heads.size() != heads {
            self.heads = create(gpu, "heads of lists", heads);
        }
        rec.encoder.clear_buffer(&self.heads, 0, None);
        self.asked = self.asked.max(fragments);
        self.reserve(gpu, fragments)?;
        Ok(self.nodes.capacity())
    }

    fn reserve(&mut self, gpu: &Gpu, fragments: u64) -> Result<(), GpuError> {
        self.nodes.reserve(gpu, fragments as usize)?;
        self.payloads.reserve(gpu, fragments as usize)?;
        let bytes = self.nodes.capacity() * COLOR_BYTES;
        if self.colors.size() < bytes {
            self.colors = create(gpu, "colors of fragments", bytes);
        }
        Ok(())
    }

    /// Gives memory back of which the last frame that used any needed little.
    pub fn shrink(&mut self, gpu: &Gpu) {
        let asked = std::mem::take(&mut self.asked);
        if asked > 0 && self.nodes.capacity() > 4 * asked.next_power_of_two() {
            self.nodes.clear(gpu);
            self.payloads.clear(gpu);
            self.colors = create(gpu, "colors of fragments", COLOR_BYTES);
        }
    }

    /// Begins to extract so many layers.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn extract(&self, rec: &mut Recorder<'_>, layers: u32) -> Result<LayerExtraction, RenderError> {
        let lists = LayerExtraction {
            heads: self.heads.clone(),
            fragments: [&self.nodes, &self.payloads].map(|texture| texture.target().clone()),
            colors: self.colors.clone(),
            listed: rec.target("listed", DEPTH)?,
            numbers: Vec::new(),
            last: None,
            layers,
            done: 0,
        };
        let inputs = lists.inputs(None);
        rec.draw(Draw {
            label: "listed",
            program: Program::new("passes/extract_layers.wgsl", "fs_listed"),
            inputs: &inputs,
            outputs: &[],
            onto: Onto::Clear,
            depth: Some((&lists.listed, DepthRule::Mark)),
        })?;
        Ok(lists)
    }
}

/// What is asked of the layers of a group.
#[derive(Debug, Clone, Copy)]
pub struct LayerOutputs {
    /// Their base colors.
    pub with_color: bool,
    /// Their shading normals; otherwise they are those of the faces.
    pub with_normals: bool,
    /// Their depth.
    pub with_depth: bool,
}

/// The lists of one group while they are split into layers.
pub struct LayerExtraction {
    heads: wgpu::Buffer,
    /// Links and payloads.
    fragments: [Target; 2],
    colors: wgpu::Buffer,
    /// A depth buffer that is covered where there are any fragments, of the layer that was extracted last or of those behind it.
    listed: Target,
    /// The fragments of the next layers, the nearest one last.
    numbers: Vec<Target>,
    /// Those of the layer that was extracted last.
    last: Option<Target>,
    /// So many are left to be extracted.
    layers: u32,
    /// So many have been.
    done: u32,
}

impl LayerExtraction {
    /// The next layer, of fragments that were collected for the same.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn next(&mut self, rec: &mut Recorder<'_>, asked: LayerOutputs) -> Result<Layer, RenderError> {
        let LayerOutputs { with_color, with_normals, with_depth } = asked;
        let numbers = match self.numbers.pop() {
            Some(numbers) => numbers,
            None => self.sort(rec)?,
        };
        self.layers = self.layers.saturating_sub(1);
        let mut layer = Layer { gbuffer: GBuffer::new(rec)?, marked: None };
        let mut rule = DepthRule::Covered;
        let inputs = self.inputs(Some(&numbers));
        let program = |entry_point| Program::new("passes/extract_layers.wgsl", entry_point);
        if with_depth {
            rec.draw(Draw {
                label: "depth of layer",
                program: program("fs_depth"),
                inputs: &inputs,
                outputs: &[],
                onto: Onto::Clear,
                depth: Some((&layer.gbuffer.depth, DepthRule::Mark)),
            })?;
        } else {
            layer.gbuffer.depth = self.listed.clone();
            layer.marked = Some(self.done);
            // All that is listed has a first layer.
            if self.done > 0 {
                rule = DepthRule::CoveredUnless("fs_ended");
            }
        }
        let GBuffer { geometry, base_color, surface_id, depth } = &layer.gbuffer;
        let mut outputs = vec![geometry, surface_id];
        outputs.extend(with_color.then_some(base_color));
        rec.draw(Draw {
            label: "extract layer",
            program: Program {
                switches: vec![("WITH_COLOR", with_color), ("WITH_NORMALS", with_normals)],
                ..program("fs_layer")
            },
            inputs: &inputs,
            outputs: &outputs,
            onto: Onto::Clear,
            depth: Some((depth, rule)),
        })?;
        self.last = Some(numbers);
        self.done += 1;
        Ok(layer)
    }

    /// Sorts the next layers, and returns the fragments of the nearest one; they are undefined where nothing is listed.
    fn sort(&mut self, rec: &mut Recorder<'_>) -> Result<Target, RenderError> {
        let layers = self.layers.clamp(1, SORTED);
        let nearest = rec.target("fragments of layer", NUMBERS)?;
        self.numbers =
            (1..layers).map(|_| rec.target("fragments of layer", NUMBERS)).collect::<Result<_, _>>()?;
        let inputs = self.inputs(self.last.as_ref());
        rec.draw(Draw {
            label: "sort",
            program: Program {
                file: "passes/extract_layers.wgsl",
                entry_point: if self.last.is_some() { "fs_sort_behind" } else { "fs_sort" },
                switches: vec![
                    ("THREE_OR_MORE", layers >= 3),
                    ("FIVE_OR_MORE", layers >= 5),
                    ("SEVEN_OR_MORE", layers >= 7),
                    ("ONCE_EACH", true),
                ],
            },
            inputs: &inputs,
            outputs: &std::iter::once(&nearest).chain(&self.numbers).collect::<Vec<_>>(),
            onto: Onto::Load,
            depth: Some((&self.listed, DepthRule::Covered)),
        })?;
        self.numbers.reverse();
        Ok(nearest)
    }

    /// What `passes/extract_layers.wgsl` reads.
    fn inputs<'a>(&'a self, numbers: Option<&'a Target>) -> Inputs<'a> {
        let [nodes, payloads] = &self.fragments;
        inputs! {
            heads: &self.heads,
            node_tex: nodes,
            payload_tex: payloads,
            colors: &self.colors,
            number_tex: numbers,
        }
    }
}

fn create(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
