//! Counting the layers of a group, and when they end, which the device decides by itself (blueprints paper, section 4.2).

use encase::{ShaderType, StorageBuffer};

use super::designated::{DepthMask, Uncover};
use super::gbuffer::GBuffer;
use super::layer_report::{LayerReport, LayersEnd};
use crate::gpu::{Gpu, Inputs, Program, Recorder, inputs, parted_counter, readback};
use crate::render::base::error::RenderError;

/// No object has more layers than this that are drawn.
pub const MAX_LAYERS: u32 = 64;

/// Pixels per side that a workgroup counts, as in `passes/count.wgsl`.
const GROUP: u32 = 64;

/// One depth layer.
#[derive(Debug, Clone)]
pub struct Layer {
    /// Geometry, surface ids, base colors and depths of its pixels.
    pub gbuffer: GBuffer,
    /// Its depth only tells where it has anything, and those behind it take it over: so often has that buffer been marked;
    /// see [`super::edge_map::EdgeInputs::marked`].
    pub marked: Option<u32>,
}

/// How far layers have come, as the device counts it. Twin of `Counted` in `shaders/common/counted.wgsl`.
#[derive(Debug, Clone, PartialEq, ShaderType)]
pub struct GpuCounted {
    /// A layer with fewer pixels ends it, before it is drawn.
    pub min_pixels: u32,
    /// 1: it has ended.
    pub has_ended: u32,
    /// Layers so far.
    pub layers: u32,
    /// Pixels of the layer that is counted.
    pub covered: u32,
    /// Pixels of the depth mask that pass the depth test against it.
    pub uncovered: u32,
    /// A layer that leaves this share of the depth mask uncovered, 0 to 1, ends it once it has been drawn.
    pub fraction: f32,
    /// So many layers end it where no depth mask is in the picture.
    pub max_layers: u32,
    /// What has ended it: 0: too few pixels, 1: the depth mask is uncovered, 2: `max_layers`.
    pub ended_by: u32,
    /// Pixels of the depth mask, the paper's Q; 0: nothing designated is in the picture.
    pub masked: u32,
    /// Those of them that opaque surfaces hide, which no layer uncovers.
    pub hidden: u32,
    /// Fragments of the lists of each part of the picture, those for which there was no room included; 0 without lists.
    pub fragments: [u32; parted_counter::COUNTER_WORDS],
    /// Pixels of each layer, that which ended it included.
    pub pixels: [u32; MAX_LAYERS as usize],
    /// Pixels of the mask that pass the depth test against each layer, the paper's R.
    pub passed: [u32; MAX_LAYERS as usize],
}

impl GpuCounted {
    /// Before the first layer.
    fn initial(min_pixels: u32, uncover: Option<Uncover<'_>>) -> Self {
        let none = [0; MAX_LAYERS as usize];
        Self {
            min_pixels,
            has_ended: 0,
            layers: 0,
            covered: 0,
            uncovered: 0,
            fraction: uncover.map_or(1.0, |uncover| uncover.fraction.clamp(0.0, 1.0)),
            max_layers: uncover.map_or(MAX_LAYERS, |uncover| uncover.max_without),
            ended_by: 0,
            masked: 0,
            hidden: 0,
            fragments: [0; parted_counter::COUNTER_WORDS],
            pixels: none,
            passed: none,
        }
    }

    /// As it comes back from the device.
    fn from_bytes(bytes: &[u8]) -> Self {
        let mut words = bytes.chunks_exact(4).filter_map(|w| w.try_into().ok()).map(u32::from_le_bytes);
        let mut next = || words.next().unwrap_or(0);
        Self {
            min_pixels: next(),
            has_ended: next(),
            layers: next(),
            covered: next(),
            uncovered: next(),
            fraction: f32::from_bits(next()),
            max_layers: next(),
            ended_by: next(),
            masked: next(),
            hidden: next(),
            fragments: std::array::from_fn(|_| next()),
            pixels: std::array::from_fn(|_| next()),
            passed: std::array::from_fn(|_| next()),
        }
    }

    /// What it says.
    fn report(&self) -> LayerReport {
        LayerReport {
            layers: self.layers,
            ended: match (self.has_ended, self.ended_by) {
                (1, 0) => LayersEnd::TooFewPixels,
                (1, 1) => LayersEnd::MaskUncovered,
                _ => LayersEnd::MaxLayers,
            },
            fraction: self.fraction,
            masked: self.masked,
            hidden: self.hidden,
            fragments: self.fragments.iter().map(|&fragments| u64::from(fragments)).sum(),
            capacity: parted_counter::capacity(&self.fragments),
            pixels: self.pixels.to_vec(),
            passed: self.passed.to_vec(),
        }
    }
}

/// What the device reported, from its bytes.
pub fn report_from_bytes(bytes: &[u8]) -> LayerReport {
    GpuCounted::from_bytes(bytes).report()
}

/// How far layers have come, on the device.
pub struct LayerCount {
    buffer: wgpu::Buffer,
}

impl LayerCount {
    /// Undefined until [`Self::begin`].
    pub fn new(gpu: &Gpu) -> Self {
        let usage = wgpu::BufferUsages::STORAGE
            | wgpu::BufferUsages::UNIFORM
            | wgpu::BufferUsages::COPY_DST
            | wgpu::BufferUsages::COPY_SRC;
        Self {
            buffer: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("layer count"),
                size: GpuCounted::min_size().get(),
                usage,
                mapped_at_creation: false,
            }),
        }
    }

    /// [`GpuCounted`] on the device.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Begins anew, for what is submitted next; it ends before a layer of fewer than `min_pixels` pixels, and where `uncover`
    /// says.
    pub fn begin(&self, gpu: &Gpu, min_pixels: u32, uncover: Option<Uncover<'_>>) {
        let initial = GpuCounted::initial(min_pixels, uncover);
        let mut bytes = StorageBuffer::new(Vec::new());
        // Writing into a growing vector cannot fail.
        if bytes.write(&initial).is_ok() {
            gpu.queue.write_buffer(&self.buffer, 0, bytes.as_ref());
        }
    }

    /// Reads it back.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn read(&self, gpu: &Gpu) -> Result<LayerReport, RenderError> {
        Ok(report_from_bytes(&readback::read_buffer(gpu, &self.buffer)?))
    }

    /// Counts the pixels of a layer, and those of the depth mask that it leaves uncovered, and disables the recorder's predicate if
    /// the layer has too few.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn count(
        &self,
        rec: &mut Recorder<'_>,
        layer: &Layer,
        mask: Option<&DepthMask>,
    ) -> Result<(), RenderError> {
        let [width, height] = rec.size();
        let program = Program {
            file: "passes/count.wgsl",
            entry_point: "cs_count",
            switches: vec![("WITH_MASK", mask.is_some())],
        };
        let groups = [width.div_ceil(GROUP), height.div_ceil(GROUP)];
        rec.compute("count", &program, &self.counted(layer, mask), groups)?;
        let program = Program {
            file: "passes/count.wgsl",
            entry_point: "cs_decide",
            switches: vec![("WITH_MASK", mask.is_some())],
        };
        self.decide(rec, &program, layer, mask)
    }

    /// After a layer has been drawn: disables the recorder's predicate if it left so much of the mask uncovered as is asked for.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn end_where_uncovered(
        &self,
        rec: &mut Recorder<'_>,
        layer: &Layer,
        mask: &DepthMask,
    ) -> Result<(), RenderError> {
        self.decide(rec, &Program::new("passes/count.wgsl", "cs_uncovered"), layer, Some(mask))
    }

    /// What `passes/count.wgsl` reads of a layer.
    fn counted<'a>(&'a self, layer: &'a Layer, mask: Option<&'a DepthMask>) -> Inputs<'a> {
        inputs! {
            surface_id_tex: &layer.gbuffer.surface_id,
            layer_depth_tex: &layer.gbuffer.depth,
            mask_depth_tex: mask.map(|mask| &mask.depth),
            layer_count: &self.buffer,
        }
    }

    fn decide(
        &self,
        rec: &mut Recorder<'_>,
        program: &Program,
        layer: &Layer,
        mask: Option<&DepthMask>,
    ) -> Result<(), RenderError> {
        // What disables the predicate cannot stand behind it.
        let Some(predicate) = rec.predicate.take() else { return Ok(()) };
        let predicated = inputs! { predicate: predicate.buffer(), mask: mask.map(|mask| &mask.count) };
        let inputs = self.counted(layer, mask).and(&predicated);
        let decided = rec.compute("go on", program, &inputs, [1, 1]);
        rec.predicate = Some(predicate);
        Ok(decided?)
    }
}
