//! Separates sheets of a surface that a polygonizer left hanging together.

use std::collections::BTreeMap;

use crate::remesh::{Surface, cosine, normal};
use crate::sets::{root, unite};

impl Surface {
    /// Gives every sheet of surface points of its own where sheets share edges or points, as they do in grid cells
    /// that the surface passes twice.
    pub(crate) fn untangle(&mut self) {
        let mut beside: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for k in 0..3 {
                let edge = (face[k], face[(k + 1) % 3]);
                beside.entry(edge).or_default().push(f * 3 + k);
            }
        }
        // Corners that stay together, found across each edge.
        let mut fan: Vec<usize> = (0..self.faces.len() * 3).collect();
        let way = |corner: usize| normal(self.faces[corner / 3].map(|i| self.points[i]));
        for (&(a, b), here) in &beside {
            let mut there = beside.get(&(b, a)).cloned().unwrap_or_default();
            for &corner in here {
                let flattest = |&x: &usize, &y: &usize| {
                    let bend = |other| cosine(way(corner), way(other));
                    bend(x).total_cmp(&bend(y))
                };
                let Some(other) = there.iter().copied().max_by(flattest) else {
                    continue;
                };
                if a < b {
                    unite(&mut fan, corner, after(other));
                    unite(&mut fan, after(corner), other);
                }
                there.retain(|&x| x != other);
            }
        }
        let mut number: BTreeMap<usize, usize> = BTreeMap::new();
        let mut points = Vec::new();
        let corners: Vec<usize> = (0..fan.len()).map(|i| root(&fan, i)).collect();
        for (corner, point) in self.faces.iter_mut().flatten().enumerate() {
            let old = self.points[*point];
            *point = *number.entry(corners[corner]).or_insert_with(|| {
                points.push(old);
                points.len() - 1
            });
        }
        self.points = points;
    }
}

/// The corner after this one in its triangle.
fn after(corner: usize) -> usize {
    corner / 3 * 3 + (corner % 3 + 1) % 3
}
