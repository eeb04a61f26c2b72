//! Polygons become triangles.

use glam::{DVec2, DVec3, Vec3};

/// Divides polygons, also concave ones, into triangles. One value serves a whole file, so that the time spent on hostile
/// polygons stays bounded: when it is used up, the rest become fans.
#[derive(Debug, Clone)]
pub struct Triangulator {
    tests_left: usize,
    points: Vec<DVec2>,
    ring: Vec<u32>,
}

impl Default for Triangulator {
    fn default() -> Self {
        Self { tests_left: 200_000_000, points: Vec::new(), ring: Vec::new() }
    }
}

impl Triangulator {
    /// Calls `emit` with the triangles of a polygon, as places in `corners`, with its orientation: always
    /// `corners.len() - 2`, none below three corners. Triangles keep the order of the corners, so that a convex
    /// polygon is a fan around its first corner.
    pub fn triangulate(&mut self, corners: &[Vec3], mut emit: impl FnMut([u32; 3])) {
        match corners.len() {
            0..3 => {}
            3 => emit([0, 1, 2]),
            4 => {
                let [first, second] = best_quad([corners[0], corners[1], corners[2], corners[3]]);
                emit(first);
                emit(second);
            }
            n => {
                self.points.clear();
                self.points.extend(flattened(corners));
                if is_convex(&self.points) {
                    for k in 1..n as u32 - 1 {
                        emit([0, k, k + 1]);
                    }
                } else {
                    self.clip_ears(&mut emit);
                }
            }
        }
    }

    /// Cuts off ears, the corners whose triangle contains no other corner.
    fn clip_ears(&mut self, emit: &mut impl FnMut([u32; 3])) {
        self.ring.clear();
        self.ring.extend(0..self.points.len() as u32);
        let mut at = 0;
        let mut misses = 0;
        while self.ring.len() > 3 {
            let n = self.ring.len();
            at %= n;
            let (before, here, after) = ((at + n - 1) % n, at, (at + 1) % n);
            let ear = [before, here, after].map(|i| self.ring[i]);
            // When no ear is left (crossing edges) or time is up, any corner has to do.
            if misses >= n || self.tests_left == 0 || self.is_ear(ear) {
                emit(ear);
                self.ring.remove(here);
                misses = 0;
                // Going on behind the next corner spreads the triangles.
                at += 1;
            } else {
                misses += 1;
                at += 1;
            }
        }
        emit([self.ring[0], self.ring[1], self.ring[2]]);
    }

    fn is_ear(&mut self, ear: [u32; 3]) -> bool {
        let [a, b, c] = ear.map(|i| self.points[i as usize]);
        if turn(a, b, c) <= 0.0 {
            return false;
        }
        self.tests_left = self.tests_left.saturating_sub(self.ring.len());
        !self.ring.iter().any(|&i| {
            let p = self.points[i as usize];
            p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
        })
    }
}

/// Twice the signed area of a triangle, positive when it is counter-clockwise.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

fn is_convex(points: &[DVec2]) -> bool {
    let n = points.len();
    // A star turns the same way everywhere too; the fan around the first corner tells it from a convex polygon.
    (0..n).all(|i| turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) >= 0.0)
        && (1..n - 1).all(|i| turn(points[0], points[i], points[i + 1]) >= 0.0)
}

/// Newell's normal, whose length is twice the area.
fn normal(corners: &[Vec3]) -> DVec3 {
    let Some(origin) = corners.first() else {
        return DVec3::ZERO;
    };
    let origin = origin.as_dvec3();
    corners.windows(2).map(|w| (w[0].as_dvec3() - origin).cross(w[1].as_dvec3() - origin)).sum()
}

/// The corners projected along the axis that the polygon faces most, counter-clockwise.
fn flattened(corners: &[Vec3]) -> impl Iterator<Item = DVec2> + '_ {
    let normal = normal(corners);
    let size = normal.abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let mirrored = normal[axis] < 0.0;
    corners.iter().map(move |p| {
        let p = p.as_dvec3();
        let flat = DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3]);
        if mirrored { flat * DVec2::new(-1.0, 1.0) } else { flat }
    })
}

/// The diagonal from the first corner, unless only the other one lies inside.
fn best_quad(corners: [Vec3; 4]) -> [[u32; 3]; 2] {
    const CHOICES: [[[u32; 3]; 2]; 2] = [[[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [1, 3, 0]]];
    let up = normal(&corners);
    let faces_up = |t: [u32; 3]| normal(&t.map(|i| corners[i as usize])).dot(up) > 0.0;
    let [first, second] = CHOICES;
    if !first.into_iter().all(faces_up) && second.into_iter().all(faces_up) { second } else { first }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangulated(corners: &[Vec3]) -> Vec<[u32; 3]> {
        let mut triangles = Vec::new();
        Triangulator::default().triangulate(corners, |t| triangles.push(t));
        triangles
    }

    /// The sum of the triangles' areas is the polygon's, and none is turned round.
    fn check(corners: &[Vec3]) {
        let triangles = triangulated(corners);
        assert_eq!(triangles.len(), corners.len() - 2);
        let whole = normal(corners);
        let mut sum = 0.0;
        for t in triangles {
            let part = normal(&t.map(|i| corners[i as usize]));
            assert!(part.dot(whole) >= 0.0, "{t:?} is turned round");
            sum += part.length();
        }
        assert!((sum / whole.length() - 1.0).abs() < 1e-6);
    }

    fn on_a_slope(points: &[(f32, f32)]) -> Vec<Vec3> {
        let lift = |&(x, y): &(f32, f32)| Vec3::new(x, y, 0.3 * x - 2.0 * y);
        points.iter().map(lift).collect()
    }

    #[test]
    fn convex_polygons_are_fans() {
        let square = on_a_slope(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        assert_eq!(triangulated(&square), [[0, 1, 2], [0, 2, 3]]);
        let pentagon = on_a_slope(&[(0.0, 0.0), (2.0, 0.0), (3.0, 1.0), (1.0, 3.0), (-1.0, 1.0)]);
        assert_eq!(triangulated(&pentagon), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    }

    #[test]
    fn concave_polygons_are_covered_exactly_from_either_side() {
        let arrow = [(0.0, 0.0), (2.0, 1.0), (0.0, 2.0), (1.5, 1.0)];
        let letter_l = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)];
        let comb: Vec<(f32, f32)> = (0..40)
            .map(|i| (i as f32, if i % 2 == 0 { 5.0 } else { 1.0 }))
            .chain([(39.0, 0.0), (0.0, 0.0)])
            .collect();
        for points in [&arrow[..], &letter_l, &comb] {
            let mut corners = on_a_slope(points);
            for _ in 0..corners.len() {
                check(&corners);
                corners.rotate_left(1);
            }
            corners.reverse();
            check(&corners);
        }
    }

    #[test]
    fn hopeless_polygons_end() {
        assert!(triangulated(&[]).is_empty() && triangulated(&[Vec3::ZERO; 2]).is_empty());
        assert_eq!(triangulated(&[Vec3::ZERO; 9]).len(), 7);
        assert_eq!(triangulated(&[Vec3::NAN; 9]).len(), 7);
        let zigzag: Vec<Vec3> = (0..5000)
            .map(|i| Vec3::new((i * 7919 % 5003) as f32, (i * 104_729 % 4999) as f32, 0.0))
            .collect();
        assert_eq!(triangulated(&zigzag).len(), 4998);
    }
}
