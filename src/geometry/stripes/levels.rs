//! How many stripes there are.

/// Number of stroke families. The strokes of family `f` run at `60 f` degrees to the direction field, counter-clockwise
/// seen from the front.
pub const FAMILIES: usize = 3;
/// How dense the lines of a family are, as a share of the first one's. Were all three equally dense, the third would cross the
/// crossings of the other two everywhere in the same way, and how much they ink together would depend on where it began.
pub(super) const DENSITIES: [f32; FAMILIES] = [1.0, 1.0, 0.89];
/// Number of levels of a ladder.
pub const LEVELS: usize = 7;
/// The level whose lines are [`CYCLES_PER_EXTENT`] to an extent.
pub const BASE_LEVEL: usize = 5;
/// Lines of the base level per extent.
pub const CYCLES_PER_EXTENT: f32 = 70.0;

/// Phases of one vertex: for each family and level the share of a cycle in 1/65536. Lines are where it is 0.
pub type Phases = [[u16; LEVELS]; FAMILIES];
