//! The noise of a sketch: where its lines and its colors go.

use super::group::SketchGroup;
use super::uniforms;
use crate::gpu::{ArrayBuffer, Gpu, Recorder, Target, UniformBuffer};
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::stage::{Output, Stage};
use crate::render::passes::gbuffer::GBuffer;
use crate::render::passes::line_pixels::ListedLines;
use crate::render::passes::offset_field::{
    FieldBuffers, FieldUniform, GpuFieldObject, LineField, NoiseSource, fill_field, line_field,
    nearest_surfaces,
};

/// What noise depends on.
#[derive(PartialEq)]
struct FieldKey {
    /// Lines or surfaces, and the geometry that noise follows.
    of: [u64; 2],
    field: FieldUniform,
    objects: Vec<GpuFieldObject>,
    uniform: FrameUniform,
}

/// Which noise.
#[derive(Clone, Copy)]
pub(super) struct NoiseInputs<'a> {
    pub(super) sketch: &'a SketchGroup,
    pub(super) objects: &'a Vec<GpuFieldObject>,
    pub(super) uniform: &'a FrameUniform,
}

impl NoiseInputs<'_> {
    fn key(&self, of: [u64; 2]) -> FieldKey {
        let Self { sketch, objects, uniform } = *self;
        FieldKey {
            of,
            field: sketch.field(),
            objects: objects.clone(),
            uniform: uniform.without_background(),
        }
    }
}

/// What of the noise lives across frames.
pub(super) struct SketchNoise {
    field: UniformBuffer<FieldUniform>,
    objects: ArrayBuffer,
    line_field: Stage<FieldKey, LineField>,
    nearest_surfaces: Stage<(u64, u32), Target>,
    fill_field: Stage<FieldKey, Target>,
}

impl SketchNoise {
    /// None yet.
    pub(super) fn new(gpu: &Gpu) -> Self {
        Self {
            field: UniformBuffer::new(gpu, "offset field"),
            objects: ArrayBuffer::new(gpu, "objects of an offset field"),
            line_field: Stage::default(),
            nearest_surfaces: Stage::default(),
            fill_field: Stage::default(),
        }
    }

    /// How often noise was found.
    pub(super) fn runs(&self) -> u64 {
        self.line_field.runs() + self.fill_field.runs()
    }

    /// Uploads which noise it is.
    pub(super) fn write(&mut self, gpu: &Gpu, inputs: &NoiseInputs<'_>) {
        self.field.write(gpu, &inputs.sketch.field());
        self.objects.write(gpu, inputs.objects);
    }

    /// Lets go of the noise of lines.
    pub(super) fn forget_lines(&mut self) {
        self.line_field.clear();
    }

    /// Noise along lines; `source`: what it follows, and the revision of that.
    pub(super) fn of_lines(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &NoiseInputs<'_>,
        lines: &Output<ListedLines<'_>>,
        source: &Output<NoiseSource<'_>>,
    ) -> Result<Output<LineField>, RenderError> {
        let Self { field, objects, .. } = self;
        let buffers = FieldBuffers { field, objects };
        let count = inputs.sketch.passes().len() as u32;
        let key = inputs.key([lines.revision, source.revision]);
        let found =
            self.line_field.run(key, |_| line_field(rec, buffers, lines.value, source.value, count))?;
        rec.note("noise of lines", Some(&found.value.first));
        Ok(found)
    }

    /// Noise of the nearest surface around each block.
    pub(super) fn of_surfaces(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &NoiseInputs<'_>,
        followed: &Output<GBuffer>,
    ) -> Result<Output<Target>, RenderError> {
        // Ink of the papers' operators follows surfaces too.
        let sketch = inputs.sketch;
        let [lines, fill] = uniforms::reaches(&sketch.style, sketch.scale);
        let reach = lines.max(fill);
        let geometry = &followed.value.geometry;
        let nearest = self
            .nearest_surfaces
            .run((followed.revision, reach as u32), |_| nearest_surfaces(rec, geometry, reach))?;
        let buffers = FieldBuffers { field: &self.field, objects: &self.objects };
        self.fill_field.run(inputs.key([nearest.revision, followed.revision]), |_| {
            fill_field(rec, buffers, geometry, &nearest.value)
        })
    }
}
