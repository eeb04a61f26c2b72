//! The edge map of a sketch: each line where its noise moves it, see `shaders/passes/moved_edges.wgsl`.

use encase::ShaderType;
use glam::Vec4;

use super::edge_map::{EDGE_MAP, EdgeMap};
use super::line_pixels::ListedLines;
use super::repeated::SPINES;
use crate::gpu::{Gpu, Program, RecordBuffer, Recorder, Target, UniformBuffer, inputs};
use crate::render::base::error::RenderError;

/// Twin of `Movement` in `shaders/passes/moved_edges.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct MovementUniform {
    /// From noise to offsets, px, by rows.
    pub matrix: Vec4,
    /// Factor of all widths.
    pub width: f32,
    /// So much farther, px, are lines looked for.
    pub margin: f32,
    /// How much the pressure of the hand varies, 0 to 1.
    pub pressure: f32,
    /// Which of the four noises of a texel of the field is meant.
    pub component: u32,
}

/// Lines that have been moved.
#[derive(Debug, Clone)]
pub struct MovedEdges {
    /// Their edge map, undefined where no spine is.
    pub edges: Target,
    /// Where their spines run and how wide they are.
    pub spines: Target,
    /// The pixel that each line comes from (column in the lower 16 bits, row in the upper ones), undefined where no spine is.
    pub sources: Target,
}

impl MovedEdges {
    /// Their edge map.
    pub fn edge_map(&self) -> EdgeMap {
        EdgeMap { edges: self.edges.clone(), spines: Some(self.spines.clone()), has_operators: false }
    }
}

/// What moving edges needs across frames. All of it is 0 between frames: who reads it last clears it.
pub struct MovedEdgesPass {
    keys: RecordBuffer,
    winners: RecordBuffer,
}

impl MovedEdgesPass {
    /// Nothing moved yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            keys: RecordBuffer::new(gpu, "keys of moved edges"),
            winners: RecordBuffer::new(gpu, "winners of moved edges"),
        }
    }

    /// Moves lines by a `field` of noise: its texels hold that of four passes each.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        movement: &UniformBuffer<MovementUniform>,
        lines: ListedLines<'_>,
        field: &Target,
    ) -> Result<MovedEdges, RenderError> {
        let [width, height] = rec.size().map(u64::from);
        self.keys.reserve(rec.gpu, width * height * 4)?;
        self.winners.reserve(rec.gpu, width * height * 4)?;
        let moved = rec.target("moved edges", EDGE_MAP)?;
        let moved_spines = rec.target("moved spines", SPINES)?;
        let sources = rec.target("sources of moved edges", SPINES)?;
        rec.clear("no moved lines", &[&moved_spines]);
        let inputs = inputs! {
            movement: movement,
            edge_map_tex: lines.edges,
            spine_tex: lines.spines,
            line_field_tex: field,
            list: lines.pixels.count(),
            listed_pixels: lines.pixels.buffer(),
            keys: self.keys.buffer(),
            winners: self.winners.buffer(),
            moved_edge_tex: &moved,
            moved_spine_tex: &moved_spines,
            source_tex: &sources,
        };
        for entry_point in ["cs_move", "cs_compare", "cs_put"] {
            let program = Program::new("passes/moved_edges.wgsl", entry_point);
            rec.compute("moved edges", &program, &inputs, lines.pixels.count())?;
        }
        Ok(MovedEdges { edges: moved, spines: moved_spines, sources })
    }
}
