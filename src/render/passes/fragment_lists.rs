//! Fragment lists: all that a group covers, collected per pixel in one traversal of the scene and cut into the same depth
//! layers as peeling gives (Yang et al. 2010, "Real-Time Concurrent Linked List Construction on the GPU").
//!
//! A list holds as many fragments as there is room for, and all are counted: who finds out later that there were more
//! makes room and draws again. See `shaders/common/fragments.wgsl`.

use super::gbuffer::{DEPTH, DrawCall, DrawUniform, GBuffer, ORDER, surface_bits};
use super::peel::{Layer, PeelCount};
use crate::gpu::recorder::{Draw, Input, Onto};
use crate::gpu::{DepthRule, Gpu, GpuError, Program, Recorder, Target};
use crate::render::RenderError;

/// Bytes of a fragment in each of the buffers: how it is linked, what it is, its base colour.
const BYTES: [u64; 3] = [12, 12, 4];

/// As many layers are sorted at a time: a pass has no more targets.
const SORTED: u32 = 8;

/// For each pixel the number of a fragment.
const NUMBERS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;

/// More fragments are never kept: they take 224 MiB.
const MOST_FRAGMENTS: u64 = 1 << 23;

/// Room for the fragments of one group after the other.
pub struct FragmentLists {
    layout: wgpu::BindGroupLayout,
    heads: wgpu::Buffer,
    /// In the order of [`BYTES`].
    fragments: [wgpu::Buffer; BYTES.len()],
    /// The most room that was asked for since the last [`Self::shrink`].
    asked: u64,
}

impl FragmentLists {
    /// Without room for anything.
    pub fn new(gpu: &Gpu) -> Self {
        let written = |binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: false },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        Self {
            layout: gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("fragment lists"),
                entries: &[0, 1, 2, 3, 4].map(written),
            }),
            heads: create(gpu, "heads of lists", 4),
            fragments: BYTES.map(|bytes| create(gpu, "fragments", bytes)),
            asked: 0,
        }
    }

    /// The most fragments that a device can keep; 0 where shaders of fragments cannot write.
    pub fn most(gpu: &Gpu) -> u64 {
        let limits = gpu.device.limits();
        if !gpu.writes_in_fragments || limits.max_storage_buffers_per_shader_stage < 5 {
            return 0;
        }
        let bytes = limits.max_buffer_size.min(limits.max_storage_buffer_binding_size);
        MOST_FRAGMENTS.min(bytes / BYTES[0])
    }

    /// Layout of the bind group that fragments are written through.
    pub(super) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// The bind group that fragments are written through; `count` counts them.
    pub(super) fn group(&self, gpu: &Gpu, count: &PeelCount) -> wgpu::BindGroup {
        let [links, payloads, colors] = &self.fragments;
        let buffers = [count.buffer(), &self.heads, links, payloads, colors];
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, b)| wgpu::BindGroupEntry { binding, resource: b.as_entire_binding() })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("fragment lists"),
            layout: &self.layout,
            entries: &entries,
        })
    }

    /// Empties all lists, for so many fragments; returns how many there is room for.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn begin(&mut self, rec: &mut Recorder<'_>, fragments: u64) -> Result<u64, GpuError> {
        let [width, height] = rec.size().map(u64::from);
        let (gpu, heads) = (rec.gpu, width * height * 4);
        gpu.check_buffer_size("the lists of a picture", heads)?;
        if self.heads.size() != heads {
            self.heads = create(gpu, "heads of lists", heads);
        }
        rec.encoder.clear_buffer(&self.heads, 0, None);
        self.asked = self.asked.max(fragments);
        if self.room() < fragments {
            self.fragments = BYTES.map(|bytes| create(gpu, "fragments", bytes * fragments));
        }
        Ok(self.room())
    }

    fn room(&self) -> u64 {
        self.fragments[0].size() / BYTES[0]
    }

    /// Gives memory back of which the last frame that used any needed little.
    pub fn shrink(&mut self, gpu: &Gpu) {
        let asked = std::mem::take(&mut self.asked);
        if asked > 0 && self.room() > 4 * asked {
            self.fragments = BYTES.map(|bytes| create(gpu, "fragments", bytes * asked));
        }
    }

    /// Begins to cut so many layers; `orders` on the device: [`meanings`].
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn cut(
        &self,
        rec: &mut Recorder<'_>,
        layers: u32,
        orders: &wgpu::Buffer,
    ) -> Result<CutLists, RenderError> {
        let [links, payloads, colors] = &self.fragments;
        let buffers = [&self.heads, links, payloads, colors, orders].map(wgpu::Buffer::clone);
        let listed = rec.target("listed", DEPTH)?;
        let lists = CutLists { buffers, listed, numbers: Vec::new(), last: None, layers };
        let inputs = lists.inputs();
        rec.draw(Draw {
            label: "listed",
            program: Program::new("passes/cut.wgsl", "fs_listed"),
            inputs: &inputs,
            outputs: &[],
            onto: Onto::Nothing,
            depth: Some((&lists.listed, DepthRule::Mark)),
        })?;
        Ok(lists)
    }
}

/// The lists of one group while they are cut into layers.
pub struct CutLists {
    /// The first bindings of `passes/cut.wgsl`.
    buffers: [wgpu::Buffer; 5],
    /// A depth buffer that is covered where there are any fragments.
    listed: Target,
    /// The fragments of the next layers, the nearest one last.
    numbers: Vec<Target>,
    /// Those of the layer that was cut last.
    last: Option<Target>,
    /// So many are left to be cut.
    layers: u32,
}

impl CutLists {
    /// The next layer. It has a base colour if the fragments have been collected with it.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn next(
        &mut self,
        rec: &mut Recorder<'_>,
        with_color: bool,
        with_order: bool,
    ) -> Result<Layer, RenderError> {
        let numbers = match self.numbers.pop() {
            Some(numbers) => numbers,
            None => self.sort(rec)?,
        };
        self.layers = self.layers.saturating_sub(1);
        let mut layer = Layer { gbuffer: GBuffer::new(rec)?, order: None };
        let inputs: Vec<_> = self.inputs().into_iter().chain([Input::Texture(&numbers)]).collect();
        let program = |entry_point| Program::new("passes/cut.wgsl", entry_point);
        if with_order {
            layer.order = Some(rec.target("order", ORDER)?);
            rec.draw(Draw {
                label: "depth of layer",
                program: program("fs_depth"),
                inputs: &inputs,
                outputs: &[],
                onto: Onto::Nothing,
                depth: Some((&layer.gbuffer.depth, DepthRule::Mark)),
            })?;
        } else {
            layer.gbuffer.depth = self.listed.clone();
        }
        let GBuffer { geometry, base_color, region, depth } = &layer.gbuffer;
        let mut outputs = vec![geometry, region];
        outputs.extend((with_color || with_order).then_some(base_color));
        outputs.extend(&layer.order);
        rec.draw(Draw {
            label: "cut",
            program: Program { switches: vec![("WITH_COLOR", with_color)], ..program("fs_layer") },
            inputs: &inputs,
            outputs: &outputs,
            onto: Onto::Nothing,
            depth: Some((depth, DepthRule::Covered)),
        })?;
        self.last = Some(numbers);
        Ok(layer)
    }

    /// Sorts the next layers, and returns the fragments of the nearest one.
    fn sort(&mut self, rec: &mut Recorder<'_>) -> Result<Target, RenderError> {
        let layers = self.layers.clamp(1, SORTED);
        let nearest = rec.target("fragments of layer", NUMBERS)?;
        self.numbers =
            (1..layers).map(|_| rec.target("fragments of layer", NUMBERS)).collect::<Result<_, _>>()?;
        let inputs: Vec<_> =
            self.inputs().into_iter().chain(self.last.as_ref().map(Input::Texture)).collect();
        rec.draw(Draw {
            label: "sort",
            program: Program {
                file: "passes/cut.wgsl",
                entry_point: if self.last.is_some() { "fs_sort_behind" } else { "fs_sort" },
                switches: vec![
                    ("THREE_OR_MORE", layers >= 3),
                    ("FIVE_OR_MORE", layers >= 5),
                    ("SEVEN_OR_MORE", layers >= 7),
                ],
            },
            inputs: &inputs,
            outputs: &std::iter::once(&nearest).chain(&self.numbers).collect::<Vec<_>>(),
            onto: Onto::Nothing,
            depth: Some((&self.listed, DepthRule::Covered)),
        })?;
        self.numbers.reverse();
        Ok(nearest)
    }

    fn inputs(&self) -> [Input<'_>; 5] {
        self.buffers.each_ref().map(Input::Storage)
    }
}

/// For each order without the bits that tell the surfaces of a draw apart: object id with the enhanced flag, and order of the
/// draw's first surface; in the first place, which no order has, the number of those bits.
pub fn meanings(draws: &[DrawUniform], calls: &[DrawCall]) -> Vec<[u32; 2]> {
    let bits = surface_bits(calls);
    let mut meanings = vec![[bits, 0]];
    for call in calls {
        let meaning = draws.get(call.draw as usize).map_or([0; 2], |draw| [draw.object, draw.first_surface]);
        let times = if bits == 0 { call.surfaces as usize } else { 1 };
        meanings.resize(meanings.len() + times, meaning);
    }
    meanings
}

fn create(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
