//! The constants of matching, in units of one mesh.

/// How far the two sides of a seam may be apart.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum SeamTolerance {
    /// Up to 0.1 % of the diagonal of the mesh from the middle of the gap.
    #[default]
    Automatic,
    /// How far a vertex may move to the middle of the gap, as a share of the diagonal of the mesh's bounding box. 0: only
    /// what lies exactly on each other belongs together, and nothing is mended.
    Fraction(f32),
}

/// Share of the diagonal by which the two sides of a seam may leave their common middle, if nothing is set.
const AUTOMATIC_TOLERANCE: f64 = 1e-3;
/// Share of the diagonal up to which a gap needs no sign that it is a crack.
const OPEN_GAP: f64 = 3e-5;
/// Share of the diagonal below which places on one edge are one place.
const SPACING: f64 = 4e-6;

/// Cosines of 180° minus the most by which a surface may turn at a seam: 150°, and 165° between common points.
pub(super) const COS_FOLD: f64 = 0.866_025_403_784;
/// See [`COS_FOLD`].
pub(super) const COS_ANCHORED_FOLD: f64 = 0.965_925_826_289;

/// Lengths in units of the mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// `τ`: how far a vertex may move.
    pub(super) tolerance: f64,
    /// `ε_open`: gaps up to this are closed wherever they are.
    pub(super) open_gap: f64,
    /// Least distance between places on one edge.
    pub(super) spacing: f64,
}

impl Limits {
    pub(super) fn new(tolerance: SeamTolerance, diagonal: f64) -> Self {
        let tolerance = match tolerance {
            SeamTolerance::Automatic => AUTOMATIC_TOLERANCE * diagonal,
            SeamTolerance::Fraction(share) => f64::from(share) * diagonal,
        };
        Self { tolerance, open_gap: (OPEN_GAP * diagonal).min(tolerance), spacing: SPACING * diagonal }
    }

    /// How wide a gap between two sides may be: both of them move.
    pub(super) fn widest(&self) -> f64 {
        2.0 * self.tolerance
    }

    /// Whether two vertices that lie `apart` from each other along a seam become one point, where the seam is `gap`
    /// wide and the shortest edge around is `shortest` long. Moving both tilts triangles less than a narrow one between
    /// them would be tilted.
    pub(super) fn is_same_place(&self, apart: f64, gap: f64, shortest: f64) -> bool {
        apart <= (4.0 * gap).max(2.0 * self.spacing) && apart <= 0.25 * shortest
    }
}
