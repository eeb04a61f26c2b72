//! Fragment lists: all that a group covers, collected per pixel in one traversal of the scene and cut into the same depth
//! layers as peeling gives (Yang et al. 2010, "Real-Time Concurrent Linked List Construction on the GPU").
//!
//! A list holds as many fragments as there is room for, and all are counted: who finds out later that there were more
//! makes room and draws again. See `shaders/common/fragments.wgsl`.

use super::gbuffer::{GBuffer, ORDER};
use super::peel::{Layer, PeelCount};
use crate::gpu::recorder::{Draw, Input, Onto};
use crate::gpu::{DepthRule, Gpu, GpuError, Program, Recorder, Target};
use crate::render::RenderError;

/// Bytes of a fragment in each of the buffers: how it is linked, what it is, its base colour, and what lies behind it.
const BYTES: [u64; 4] = [16, 16, 4, 4];

/// As many layers are sorted at a time, as in `passes/cut.wgsl`.
const SORTED: u32 = 8;

/// More fragments are never kept: they take 320 MiB.
const MOST_FRAGMENTS: u64 = 1 << 23;

/// Room for the fragments of one group after the other.
pub struct FragmentLists {
    layout: wgpu::BindGroupLayout,
    heads: wgpu::Buffer,
    cursors: wgpu::Buffer,
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
            cursors: create(gpu, "next layer of lists", 4),
            fragments: BYTES.map(|bytes| create(gpu, "fragments", bytes)),
            asked: 0,
        }
    }

    /// The most fragments that a device can keep; 0 where shaders of fragments cannot write.
    pub fn most(gpu: &Gpu) -> u64 {
        let limits = gpu.device.limits();
        if !gpu.writes_in_fragments || limits.max_storage_buffers_per_shader_stage < 6 {
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
        let [links, payloads, colors, _] = &self.fragments;
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
            self.cursors = create(gpu, "next layer of lists", heads);
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

    /// The layer of this number, from 0 on, which lies behind the last one: its depth and order. Layers are cut one after
    /// the other, with a base colour if the fragments have been collected with it.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn cut(
        &self,
        rec: &mut Recorder<'_>,
        number: u32,
        with_color: bool,
        [last_depth, last_order]: &[Target; 2],
    ) -> Result<Layer, RenderError> {
        let layer = Layer { gbuffer: GBuffer::new(rec)?, order: rec.target("order", ORDER)? };
        let [links, payloads, colors, behind] = &self.fragments;
        let inputs = [
            Input::Storage(&self.heads),
            Input::Storage(links),
            Input::Storage(payloads),
            Input::Storage(colors),
            Input::Written(&self.cursors),
            Input::Written(behind),
            Input::Texture(last_depth),
            Input::Texture(last_order),
        ];
        let is_first = number.is_multiple_of(SORTED);
        rec.draw(Draw {
            label: if is_first { "sort and cut" } else { "cut" },
            program: Program {
                file: "passes/cut.wgsl",
                entry_point: if is_first { "fs_first" } else { "fs_next" },
                switches: vec![("WITH_COLOR", with_color)],
            },
            inputs: &inputs,
            outputs: &[
                &layer.gbuffer.geometry,
                &layer.gbuffer.base_color,
                &layer.gbuffer.region,
                &layer.order,
            ],
            onto: Onto::Nothing,
            depth: Some((&layer.gbuffer.depth, DepthRule::Mark)),
        })?;
        Ok(layer)
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
