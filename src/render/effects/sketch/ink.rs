//! The lines of the passes of a sketch: where noise moves them, and which of them reach each pixel then.

use super::group::SketchGroup;
use crate::gpu::{ArrayBuffer, Gpu, Recorder, UniformBuffer};
use crate::render::base::error::RenderError;
use crate::render::base::stage::{Output, Stage};
use crate::render::passes::line_distance::{LineDistance, Widths, line_distance};
use crate::render::passes::line_pixels::ListedLines;
use crate::render::passes::moved_edges::{MovedEdges, MovedEdgesPass, MovementUniform};
use crate::render::passes::offset_field::LineField;

/// What moving lines depends on.
#[derive(PartialEq)]
struct MovedKey {
    lines: u64,
    field: u64,
    movement: MovementUniform,
}

/// Lines of a pass, moved.
#[derive(Clone)]
pub(super) struct MovedLines {
    pub(super) edges: MovedEdges,
    pub(super) line_distance: Output<LineDistance>,
}

/// What of the passes lives across frames.
pub(super) struct SketchPasses {
    moved_edges: MovedEdgesPass,
    passes: Vec<SketchPass>,
}

impl SketchPasses {
    /// None yet.
    pub(super) fn new(gpu: &Gpu) -> Self {
        Self { moved_edges: MovedEdgesPass::new(gpu), passes: Vec::new() }
    }

    /// How often lines were moved.
    pub(super) fn runs(&self) -> u64 {
        self.passes.iter().map(|pass| pass.moved.runs()).sum()
    }

    /// Lets go of the lines.
    pub(super) fn forget(&mut self) {
        for pass in &mut self.passes {
            pass.moved.clear();
            pass.line_distance.clear();
        }
    }

    /// Moves lines for each pass.
    pub(super) fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        sketch: &SketchGroup,
        lines: &Output<ListedLines<'_>>,
        field: &Output<LineField>,
    ) -> Result<Vec<MovedLines>, RenderError> {
        let count = sketch.passes().len();
        self.passes.truncate(count);
        self.passes.resize_with(count, || SketchPass::new(rec.gpu));
        let Self { moved_edges, passes } = self;
        let all = passes.iter_mut().enumerate();
        all.map(|(number, pass)| pass.run(rec, moved_edges, sketch, number, lines, field)).collect()
    }

    /// The numbers of so many passes, on the device.
    pub(super) fn numbers(&mut self, gpu: &Gpu, count: usize) -> Vec<&UniformBuffer<u32>> {
        self.passes.resize_with(count.max(self.passes.len()), || SketchPass::new(gpu));
        (0..count).zip(&mut self.passes).map(|(number, pass)| pass.number(gpu, number)).collect()
    }
}

/// What of a pass lives across frames.
struct SketchPass {
    movement: UniformBuffer<MovementUniform>,
    number: UniformBuffer<u32>,
    greatest_radius: ArrayBuffer,
    moved: Stage<MovedKey, MovedEdges>,
    line_distance: Stage<(u64, Widths), LineDistance>,
}

impl SketchPass {
    /// Nothing moved yet.
    fn new(gpu: &Gpu) -> Self {
        Self {
            movement: UniformBuffer::new(gpu, "movement of lines"),
            number: UniformBuffer::new(gpu, "number of a pass"),
            greatest_radius: ArrayBuffer::new(gpu, "greatest radius of moved lines"),
            moved: Stage::default(),
            line_distance: Stage::default(),
        }
    }

    /// Its number, on the device.
    fn number(&mut self, gpu: &Gpu, number: usize) -> &UniformBuffer<u32> {
        self.number.write(gpu, &(number as u32));
        &self.number
    }

    /// Moves lines; `number`: that of the pass.
    fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        pass: &mut MovedEdgesPass,
        sketch: &SketchGroup,
        number: usize,
        lines: &Output<ListedLines<'_>>,
        field: &Output<LineField>,
    ) -> Result<MovedLines, RenderError> {
        let (noise, component) = field.value.of_pass(number);
        let (movement, widths) = sketch.movement(number, component);
        let key = MovedKey { lines: lines.revision, field: field.revision, movement };
        let buffer = &mut self.movement;
        let moved = self.moved.run(key, |key| {
            buffer.write(rec.gpu, &key.movement);
            pass.run(rec, buffer, lines.value, noise)
        })?;
        let radius = &mut self.greatest_radius;
        let line_distance = self.line_distance.run((moved.revision, widths), |_| {
            line_distance(rec, &moved.value.spines, None, widths, radius)
        })?;
        Ok(MovedLines { edges: moved.value, line_distance })
    }
}
