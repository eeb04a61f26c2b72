//! The constants of matching, in units of one mesh.

use super::borders::Border;

/// How far the two sides of a seam may be apart.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum SeamTolerance {
    /// Up to 0.1 % of the diagonal of the body from the middle of the gap.
    #[default]
    Automatic,
    /// How far a vertex may move to the middle of the gap, as a share of the diagonal of the body's bounding box. 0: only
    /// what lies exactly on each other belongs together, and nothing is mended.
    Fraction(f32),
}

/// Share of the diagonal by which the two sides of a seam may leave their common middle, if nothing is set.
const AUTOMATIC_TOLERANCE: f64 = 1e-3;
/// Share of the diagonal up to which a gap needs no sign that it is a crack.
const OPEN_GAP: f64 = 3e-5;
/// Share of the diagonal of the mesh below which places on one edge are one place.
const SPACING: f64 = 4e-6;
/// Share of the smaller one's diagonal that a gap between parts without a common point is at most, whatever the size of
/// the mesh.
const APART: f64 = 1e-2;

/// Cosines of 180° minus the most by which a surface may turn at a seam: 150°, and 165° between common points.
pub(super) const COS_FOLD: f64 = 0.866_025_403_784;
/// The same of 8°: up to this one surface goes on through a seam.
pub(super) const COS_SMOOTH: f64 = -0.990_268_068_741;
/// See [`COS_FOLD`].
pub(super) const COS_ANCHORED_FOLD: f64 = 0.965_925_826_289;

/// What is near. Parts of the mesh that have points in common are a body, whose size is the measure. What body parts
/// without a common point belong to nobody knows; there it is that of the mesh, within reason.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// `τ`: how far a vertex may move, as a share of the diagonal.
    tolerance: f64,
    /// `ε_open`: gaps up to this are closed wherever they are; a share of the diagonal.
    open_gap: f64,
    /// Diagonal of the mesh, in its units.
    diagonal: f64,
    /// Least distance between places on one edge, in units of the mesh.
    pub(super) spacing: f64,
}

impl Limits {
    pub(super) fn new(tolerance: SeamTolerance, diagonal: f64) -> Self {
        let tolerance = match tolerance {
            SeamTolerance::Automatic => AUTOMATIC_TOLERANCE,
            SeamTolerance::Fraction(share) => f64::from(share),
        };
        Self { tolerance, open_gap: OPEN_GAP.min(tolerance), diagonal, spacing: SPACING * diagonal }
    }

    /// Whether anything can be near at all.
    pub(super) fn is_usable(&self) -> bool {
        let greatest = self.greatest_tolerance();
        greatest > 0.0 && greatest.is_finite()
    }

    /// How far a vertex may move in the largest body.
    pub(super) fn greatest_tolerance(&self) -> f64 {
        self.tolerance * self.diagonal
    }

    /// The largest of all [`Self::open_gap`].
    pub(super) fn greatest_open_gap(&self) -> f64 {
        self.open_gap * self.diagonal
    }

    /// `τ` where two borders meet.
    pub(super) fn tolerance(&self, a: &Border, b: &Border) -> f64 {
        self.between(self.tolerance, a, b)
    }

    /// `ε_open` where two borders meet.
    pub(super) fn open_gap(&self, a: &Border, b: &Border) -> f64 {
        self.between(self.open_gap, a, b)
    }

    /// How far the vertices of a border may move, whatever it meets.
    pub(super) fn reach(&self, border: &Border) -> f64 {
        self.apart(self.tolerance, border.body_size).max(self.tolerance * border.body_size)
    }

    /// How wide a gap between two sides may be: both of them move.
    pub(super) fn widest(&self, a: &Border, b: &Border) -> f64 {
        2.0 * self.tolerance(a, b)
    }

    /// Whether two vertices that lie `apart` from each other along a seam become one point, where the seam is `gap`
    /// wide and the shortest edge around is `shortest` long. Moving both tilts triangles less than a narrow one between
    /// them would be tilted.
    pub(super) fn is_same_place(&self, apart: f64, gap: f64, shortest: f64) -> bool {
        apart <= (4.0 * gap).max(2.0 * self.spacing) && apart <= 0.25 * shortest
    }

    fn between(&self, share: f64, a: &Border, b: &Border) -> f64 {
        if a.body == b.body { share * a.body_size } else { self.apart(share, a.body_size.min(b.body_size)) }
    }

    fn apart(&self, share: f64, size: f64) -> f64 {
        (share * self.diagonal).min(APART * size)
    }
}
