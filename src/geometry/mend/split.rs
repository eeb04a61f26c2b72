//! Cuts triangles at new vertices on their edges.

/// A triangle with new vertices on its edges, in their order.
pub(super) struct CutTriangle {
    pub(super) corners: [u32; 3],
    /// New vertices between corner `k` and the next one, in this direction.
    pub(super) on_edges: [Vec<u32>; 3],
}

impl CutTriangle {
    /// Appends triangles that cover this one and have all its vertices: fans from the corner opposite of the edge with
    /// the most new vertices, whose triangles are cut further where other edges have some, too.
    pub(super) fn split(mut self, triangles: &mut Vec<[u32; 3]>) {
        let most = (0..3).max_by_key(|&k| (self.on_edges[k].len(), std::cmp::Reverse(k))).unwrap_or_default();
        if self.on_edges[most].is_empty() {
            triangles.push(self.corners);
            return;
        }
        self.corners.rotate_left(most);
        self.on_edges.rotate_left(most);
        let [a, b, apex] = self.corners;
        let [base, right, left] = self.on_edges;
        let (Some(&first), Some(&last)) = (base.first(), base.last()) else { return };
        Self { corners: [a, first, apex], on_edges: [Vec::new(), Vec::new(), left] }.split(triangles);
        triangles.extend(base.windows(2).map(|pair| [pair[0], pair[1], apex]));
        Self { corners: [last, b, apex], on_edges: [Vec::new(), right, Vec::new()] }.split(triangles);
    }
}
