//! Mends the seams between separately tessellated faces.
//!
//! Exporters of solids tessellate every face by itself, so that two polylines of one curve lie along each other: with
//! T-junctions, and with cracks as wide as their chords leave the curve. By their edges alone these are borders. Here
//! both sides of every such seam get the same vertices, which moves none of them by more than a tolerance; then edges
//! meet as in any other mesh. Each side keeps its own vertices, and with them its normals and colors.
//!
//! Which borders belong together, in steps that each take up what the ones before left:
//!
//! 1. *Pairs* of edges whose ends nearly coincide (`pairs`).
//! 2. *Anchored chains*: rows of border edges between the same two points, at which more than one of them starts. Their
//!    ends alone say that they belong together, however far they are apart between (`anchors`).
//! 3. *Thin holes*: loops of border edges, linked at the smallest angle, split at their farthest points (`holes`).
//! 4. *Proximity*: the nearest edge within reach, if each is the other's nearest (`proximity`) and if the gap closes
//!    on both sides (`closure`), as it does between two polylines of one curve and not at a clearance. Rows of such
//!    places are taken as a whole (`intervals`).
//! 5. Where many gaps that do not close are overlaps instead, the corners are cracked too, and how wide gaps need not
//!    close is taken from the mesh itself (`closure`).
//!
//! Distance alone tells little. What tells real gaps from cracks is, in all steps, that a surface does not fold back at
//! a seam (sheets that lie on each other), and that there is no material in the gap (the sides of a narrow strip).
//!
//! What is matched is zipped: the vertices of each side get places on the other one, in the same order on both (`zip`).
//! Then these places become one, the edges are cut there and their triangles split (`join`); where a triangle would be
//! turned over, they meet elsewhere than in the middle of the gap, or not at all (`settle`).

mod anchors;
mod border_points;
mod borders;
mod closure;
mod holes;
mod intervals;
mod join;
mod limits;
mod open;
mod pairs;
mod proximity;
mod settle;
mod side;
mod split;
mod zip;

use self::anchors::{Joined, anchored};
use self::border_points::PointGroups;
use self::borders::{Borders, NO_BORDER};
use self::holes::thin_holes;
use self::limits::Limits;
pub use self::limits::SeamTolerance;
use self::open::Open;
use self::proximity::SubEdges;
use super::weld::TOLERANCE;
use super::{Adjacency, Mesh};

/// Share of the half-edges that are still open after the pairs, from which on the mesh is loose triangles and no seams
/// between faces are looked for.
const LOOSE: f64 = 0.5;
/// Fewer open edges are always looked at.
const MANY: usize = 4096;

/// What [`mend`] did. Lengths are in units of the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Mended {
    /// Length of all edges of one triangle only, before.
    pub border_length: f64,
    /// How much of it has a partner now.
    pub joined_length: f64,
    /// How far a vertex was allowed to move in a body as large as the mesh; in smaller ones less.
    pub tolerance: f64,
    /// Up to this width, gaps in such a body needed no sign that they are cracks.
    pub open_gap: f64,
    /// How far a vertex moved at most.
    pub farthest_move: f64,
    /// Number of vertices that were added on edges.
    pub added_vertices: usize,
    /// Number of triangles left out because nothing of them is left: two of their corners became one point, or they lie
    /// on another one back to back.
    pub dropped_triangles: usize,
}

impl Mended {
    /// All of these together: lengths and numbers summed, the rest the greatest.
    pub fn of_all<'a>(all: impl IntoIterator<Item = &'a Self>) -> Option<Self> {
        all.into_iter().copied().reduce(|a, b| Self {
            border_length: a.border_length + b.border_length,
            joined_length: a.joined_length + b.joined_length,
            tolerance: a.tolerance.max(b.tolerance),
            open_gap: a.open_gap.max(b.open_gap),
            farthest_move: a.farthest_move.max(b.farthest_move),
            added_vertices: a.added_vertices + b.added_vertices,
            dropped_triangles: a.dropped_triangles + b.dropped_triangles,
        })
    }
}

/// Makes the seams of a clean mesh common edges; see the [module](self). `None` if there is nothing to join. Skinned
/// meshes stay as they are. `adjacency` must be that of the mesh.
pub fn mend(mesh: &Mesh, adjacency: &Adjacency, tolerance: SeamTolerance) -> Option<(Mesh, Mended)> {
    let has_borders = adjacency.border_count > 0 || !adjacency.overlaps.is_empty();
    if !has_borders || mesh.rig.is_some() {
        return None;
    }
    let limits = Limits::new(tolerance, mesh.bounds().diagonal());
    if !limits.is_usable() {
        return None;
    }
    let borders = Borders::new(mesh, adjacency);
    let mut matching = Matching::new(mesh, &borders, limits);
    matching.take_pairs();
    let open = matching.open();
    let is_loose = open.edges.len() > MANY && open.edges.len() as f64 > LOOSE * mesh.indices.len() as f64;
    matching.take(anchored(&borders, &open, &limits));
    matching.take(thin_holes(&borders, &matching.open(), &limits));
    let opening = if is_loose { 1.0 } else { matching.take_near() };
    if !matching.has_ties {
        return None;
    }
    let outcome = join::join(mesh, &adjacency.weld.representative, &borders, &matching.places);
    let report = Mended {
        border_length: borders.length,
        joined_length: outcome.joined_length,
        tolerance: limits.greatest_tolerance(),
        open_gap: (opening * limits.greatest_open_gap()).min(limits.greatest_tolerance()),
        farthest_move: outcome.farthest_move,
        added_vertices: outcome.added_vertices,
        dropped_triangles: outcome.dropped_triangles,
    };
    (report.joined_length > 0.0).then_some((outcome.mesh, report))
}

/// The mesh with its seams as common edges, where it has any, and with what was done to them ([`Mesh::mended`]).
pub fn mended(mesh: Mesh, tolerance: SeamTolerance) -> Mesh {
    if tolerance == SeamTolerance::Fraction(0.0) || mesh.rig.is_some() {
        return mesh;
    }
    // Where all lies exactly on each other, seams are found without mending.
    let min_move = TOLERANCE * mesh.bounds().diagonal();
    // The adjacency is not handed on to `Topology`: meshes are plain data, linked and altered before that is made, and made again
    // for other creases.
    match mend(&mesh, &Adjacency::new(&mesh), tolerance) {
        Some((mended, report)) if report.farthest_move > min_move => Mesh { mended: Some(report), ..mended },
        _ => mesh,
    }
}

/// What is joined so far.
struct Matching<'a> {
    borders: &'a Borders,
    limits: Limits,
    places: PointGroups,
    is_joined: Vec<bool>,
    has_ties: bool,
}

impl<'a> Matching<'a> {
    fn new(mesh: &Mesh, borders: &'a Borders, limits: Limits) -> Self {
        let count = borders.list.len();
        let places = PointGroups::new(&mesh.positions, borders, &limits);
        Self { borders, limits, places, is_joined: vec![false; count], has_ties: false }
    }

    fn open(&self) -> Open {
        Open::new(self.borders, &self.places, &self.is_joined)
    }

    fn take_pairs(&mut self) {
        for (border, partner) in (0..).zip(pairs::pairs(self.borders, &self.limits)) {
            if partner != NO_BORDER && border < partner {
                let ties = pairs::ties(self.borders.get(border), self.borders.get(partner));
                self.take([Joined { edges: vec![border, partner], ties: ties.to_vec() }]);
            }
        }
    }

    fn take(&mut self, all: impl IntoIterator<Item = Joined>) {
        for joined in all {
            for tie in joined.ties {
                self.has_ties |= self.places.tie(self.borders, tie);
            }
            for edge in joined.edges {
                self.is_joined[edge as usize] = true;
            }
        }
    }

    /// Joins edges by proximity; returns how many times wider than usual gaps were that needed no closure.
    fn take_near(&mut self) -> f64 {
        let sub_edges = SubEdges::new(self.borders, &self.open(), &self.limits);
        let closed = closure::closed(self.borders, &sub_edges, &self.limits);
        for tie in intervals::ties(self.borders, &sub_edges, &closed, &self.limits) {
            self.has_ties |= self.places.tie(self.borders, tie);
        }
        closed.opening
    }
}

#[cfg(test)]
mod tests;
