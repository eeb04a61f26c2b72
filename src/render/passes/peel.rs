//! Depth peeling: what lies behind what has been drawn, layer by layer (blueprints paper, section 3, Fig. 2), and when it
//! ends, which the device decides by itself (section 4.2).

use encase::{ShaderType, StorageBuffer};

use super::gbuffer::{DEPTH, GBuffer, ORDER};
use crate::gpu::recorder::{Input, color_attachment};
use crate::gpu::{Gpu, Program, Recorder, Target, readback};
use crate::render::RenderError;

/// No object has more layers than this that are drawn.
pub const MOST_LAYERS: u32 = 64;

/// Pixels per side of a workgroup, as in `passes/count.wgsl`.
const GROUP: u32 = 16;

/// One depth layer.
#[derive(Debug, Clone)]
pub struct Layer {
    /// Its surfaces.
    pub gbuffer: GBuffer,
    /// The draw and surface of each pixel, which tells coplanar ones apart; see `passes/peel.wgsl`.
    pub order: Target,
}

/// What a layer lies behind, and where its own order goes.
pub struct Peel<'a> {
    /// Depth of the layer before.
    pub last_depth: &'a Target,
    /// Order of the layer before.
    pub last_order: &'a Target,
    /// Order of the layer that is drawn.
    pub order: &'a Target,
}

impl Peel<'_> {
    /// Layout of the bind group that holds the layer before.
    pub fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
        let texture = |binding, sample_type| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Texture {
                sample_type,
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        };
        gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("last layer"),
            entries: &[texture(0, wgpu::TextureSampleType::Depth), texture(1, wgpu::TextureSampleType::Uint)],
        })
    }

    /// The layer before as a bind group.
    pub fn group(&self, gpu: &Gpu, layout: &wgpu::BindGroupLayout) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("last layer"),
            layout,
            entries: &[(0, self.last_depth), (1, self.last_order)].map(|(binding, target)| {
                let resource = wgpu::BindingResource::TextureView(target.view());
                wgpu::BindGroupEntry { binding, resource }
            }),
        })
    }
}

/// Depth and order that everything lies behind.
///
/// # Errors
/// [`RenderError`].
pub fn before_all(rec: &mut Recorder<'_>) -> Result<[Target; 2], RenderError> {
    let targets = [rec.target("nearest depth", DEPTH)?, rec.target("no order", ORDER)?];
    let [depth, order] = &targets;
    let depth = wgpu::RenderPassDepthStencilAttachment {
        view: depth.view(),
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    };
    let color = [Some(color_attachment(order, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)))];
    rec.pass("before all layers", &color, Some(depth));
    Ok(targets)
}

/// How far peeling has come. Twin of `Peeled` in `shaders/common/peeled.wgsl`.
#[derive(Debug, Clone, PartialEq, ShaderType)]
pub struct Peeled {
    /// A layer with fewer pixels ends it.
    pub least: u32,
    /// 1: it has ended.
    pub has_ended: u32,
    /// Layers so far.
    pub layers: u32,
    /// Pixels of the layer that is counted.
    pub covered: u32,
    /// Fragments of all lists, those for which there was no room included; 0 without lists.
    pub fragments: u32,
    /// Pixels of each layer, that which ended it included.
    pub pixels: [u32; MOST_LAYERS as usize],
}

impl Peeled {
    /// As it comes back from the device.
    pub fn from_bytes(bytes: &[u8]) -> Self {
        let mut words = bytes.chunks_exact(4).filter_map(|w| w.try_into().ok()).map(u32::from_le_bytes);
        let mut next = || words.next().unwrap_or(0);
        let (least, has_ended, layers, covered) = (next(), next(), next(), next());
        Self { least, has_ended, layers, covered, fragments: next(), pixels: std::array::from_fn(|_| next()) }
    }
}

/// How far peeling has come, on the device.
pub struct PeelCount {
    buffer: wgpu::Buffer,
}

impl PeelCount {
    /// Undefined until [`Self::begin`].
    pub fn new(gpu: &Gpu) -> Self {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        Self {
            buffer: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("peeled"),
                size: Peeled::min_size().get(),
                usage,
                mapped_at_creation: false,
            }),
        }
    }

    /// [`Peeled`] on the device.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Begins anew, for what is submitted next; it ends with a layer of fewer than `least` pixels.
    pub fn begin(&self, gpu: &Gpu, least: u32) {
        let pixels = [0; MOST_LAYERS as usize];
        let begun = Peeled { least, has_ended: 0, layers: 0, covered: 0, fragments: 0, pixels };
        let mut bytes = StorageBuffer::new(Vec::new());
        // Writing into a growing vector cannot fail.
        if bytes.write(&begun).is_ok() {
            gpu.queue.write_buffer(&self.buffer, 0, bytes.as_ref());
        }
    }

    /// Reads it back.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn read(&self, gpu: &Gpu) -> Result<Peeled, RenderError> {
        Ok(Peeled::from_bytes(&readback::read_buffer(gpu, &self.buffer)?))
    }

    /// Counts the pixels of a layer and shuts the recorder's gate if they are too few.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn count(&self, rec: &mut Recorder<'_>, layer: &Layer) -> Result<(), RenderError> {
        let [width, height] = rec.size();
        let program = |entry_point| Program::new("passes/count.wgsl", entry_point);
        rec.compute(
            "count",
            program("cs_count"),
            &[Input::Texture(&layer.order), Input::Written(&self.buffer)],
            [width.div_ceil(GROUP), height.div_ceil(GROUP)],
        )?;
        // What shuts the gate cannot stand behind it.
        let Some(gate) = rec.gate.take() else { return Ok(()) };
        let inputs =
            [Input::Texture(&layer.order), Input::Written(&self.buffer), Input::Written(gate.buffer())];
        let decided = rec.compute("go on", program("cs_decide"), &inputs, [1, 1]);
        rec.gate = Some(gate);
        Ok(decided?)
    }
}
