//! Rounds what is still sharp after remeshing: folds tighter than the triangles can follow.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::remesh::Surface;
use crate::sdf::gradient;

/// Edges at the bottom of a fold that turn by more are rounded, in degrees.
const FOLD: f64 = 27.0;
/// The same for edges of a bulge. Its points are mostly left where they are: moving them inwards leaves lumps.
const BULGE: f64 = 37.0;

impl Surface {
    /// Moves the points around sharp edges towards their neighbors until few are left; tells which were moved.
    pub(crate) fn soften(&mut self) -> Vec<bool> {
        let neighbors = self.neighbors();
        let mut moved = vec![false; self.points.len()];
        for _ in 0..60 {
            let sharp = self.around_sharp_edges();
            if !sharp.contains(&true) {
                break;
            }
            let points = &self.points;
            self.points = (0..points.len())
                .map(|i| {
                    if !sharp[i] {
                        return points[i];
                    }
                    let sum: DVec3 = neighbors[i].iter().map(|&j| points[j]).sum();
                    points[i].lerp(sum / neighbors[i].len() as f64, 0.3)
                })
                .collect();
            moved.iter_mut().zip(&sharp).for_each(|(m, s)| *m |= s);
        }
        moved
    }

    /// Which points belong to a triangle beside a sharp edge.
    fn around_sharp_edges(&self) -> Vec<bool> {
        let folds = FOLD.to_radians().cos();
        let bulges = BULGE.to_radians().cos();
        let normals: Vec<DVec3> = self.face_normals();
        let mut out = vec![false; self.points.len()];
        let mut waiting: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (face[k], face[(k + 1) % 3]);
                let Some(g) = waiting.remove(&(b, a)) else {
                    waiting.insert((a, b), f);
                    continue;
                };
                let across = |i: &usize| (self.points[*i] - self.points[a]).dot(normals[f]);
                let hollow = self.faces[g].iter().map(across).sum::<f64>() > 0.0;
                if normals[f].dot(normals[g]) < if hollow { folds } else { bulges } {
                    face.iter().chain(&self.faces[g]).for_each(|&i| out[i] = true);
                }
            }
        }
        out
    }

    /// The unit normal of each face.
    fn face_normals(&self) -> Vec<DVec3> {
        self.faces
            .iter()
            .map(|f| {
                let [a, b, c] = f.map(|i| self.points[i]);
                (b - a).cross(c - a).normalize_or_zero()
            })
            .collect()
    }

    /// Shading normals: the distance's gradient, or the mean of the faces where points were `moved` off the surface.
    pub(crate) fn normals(&self, f: &impl Fn(DVec3) -> f64, moved: &[bool]) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.points.len()];
        for (face, normal) in self.faces.iter().zip(self.face_normals()) {
            for k in 0..3 {
                let [p, q, r] = [0, 1, 2].map(|d| self.points[face[(k + d) % 3]]);
                sums[face[k]] += normal * (q - p).angle_between(r - p);
            }
        }
        (0..sums.len())
            .map(|i| if moved[i] { sums[i].normalize() } else { gradient(f, self.points[i]).normalize() })
            .collect()
    }
}
