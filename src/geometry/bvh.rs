//! A bounding volume hierarchy over triangles, for rays cast on the CPU in double precision.

use glam::DVec3;

use super::Bounds;

/// Most triangles in a leaf.
const LEAF_SIZE: usize = 4;
/// Subtrees with more triangles than this are built on several threads.
const PARALLEL_SIZE: usize = 8192;
/// How far outside a triangle, in barycentric coordinates, a ray still meets it, so that none slips through between
/// two neighbours.
const BARYCENTRIC_SLACK: f64 = 1e-12;
/// Splits are at the median, so no tree over 2³² triangles is deeper than this.
const MAX_DEPTH: usize = 64;

/// The hierarchy: a binary tree split at the median of the longest axis.
#[derive(Debug, Clone, Default)]
pub struct Bvh {
    /// In depth-first order.
    nodes: Vec<Node>,
    /// Corners, in the order of the leaves.
    triangles: Vec<[DVec3; 3]>,
    /// The number each triangle had in the input, in the order of the leaves.
    numbers: Vec<u32>,
}

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Number of the triangle in the input of [`Bvh::new`].
    pub triangle: usize,
    /// Distance from the origin in multiples of the ray's direction.
    pub t: f64,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Bounds,
    /// Of a leaf: its first triangle. Of an inner node: its second child; the first one follows it directly.
    next: u32,
    /// Number of triangles; 0 for an inner node.
    count: u32,
}

impl Bvh {
    /// Builds the tree. Triangles whose corners are not finite are never hit.
    pub fn new(triangles: &[[DVec3; 3]]) -> Self {
        let mut items: Vec<Item> = triangles
            .iter()
            .enumerate()
            .filter(|(_, corners)| corners.iter().all(|p| p.is_finite()))
            .map(|(i, &[a, b, c])| Item {
                number: i as u32,
                bounds: Bounds { min: a.min(b).min(c), max: a.max(b).max(c) },
            })
            .collect();
        let nodes = if items.is_empty() { Vec::new() } else { build(&mut items, 0) };
        Self {
            nodes,
            triangles: items.iter().map(|item| triangles[item.number as usize]).collect(),
            numbers: items.iter().map(|item| item.number).collect(),
        }
    }

    /// Whether the ray `origin + t · direction` meets a triangle, from either side, with `t_min < t < t_max`; those
    /// for which `skip` is true, given their number, count as absent.
    pub fn any_hit(
        &self,
        origin: DVec3,
        direction: DVec3,
        t_min: f64,
        t_max: f64,
        skip: impl Fn(usize) -> bool,
    ) -> bool {
        let mut found = false;
        self.traverse(&Ray::new(origin, direction), t_min, t_max, |number, _| {
            found |= !skip(number);
            if found { Next::Stop } else { Next::Continue }
        });
        found
    }

    /// The nearest hit with `t_min < t < t_max`, as in [`Bvh::any_hit`].
    pub fn closest_hit(
        &self,
        origin: DVec3,
        direction: DVec3,
        t_min: f64,
        t_max: f64,
        skip: impl Fn(usize) -> bool,
    ) -> Option<Hit> {
        let mut closest = None;
        self.traverse(&Ray::new(origin, direction), t_min, t_max, |triangle, t| {
            if skip(triangle) {
                return Next::Continue;
            }
            closest = Some(Hit { triangle, t });
            Next::Nearer(t)
        });
        closest
    }

    /// Calls `visit` with the number of every triangle whose box overlaps or touches `bounds`.
    pub fn overlapping(&self, bounds: &Bounds, mut visit: impl FnMut(usize)) {
        let apart = |b: &Bounds| b.min.cmpgt(bounds.max).any() || b.max.cmplt(bounds.min).any();
        let mut stack = Stack::new(&self.nodes);
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if apart(&node.bounds) {
                continue;
            }
            if node.count == 0 {
                stack.push(node.next);
                stack.push(index + 1);
                continue;
            }
            for leaf in node.next as usize..(node.next + node.count) as usize {
                let [a, b, c] = self.triangles[leaf];
                if !apart(&Bounds { min: a.min(b).min(c), max: a.max(b).max(c) }) {
                    visit(self.numbers[leaf] as usize);
                }
            }
        }
    }

    /// Offers every hit to `visit`, which says how to go on.
    fn traverse(&self, ray: &Ray, t_min: f64, mut t_max: f64, mut visit: impl FnMut(usize, f64) -> Next) {
        let mut stack = Stack::new(&self.nodes);
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !ray.enters(&node.bounds, t_min, t_max) {
                continue;
            }
            if node.count == 0 {
                // The nearer child is looked at first.
                let (first, second) = (index + 1, node.next);
                let entry = |child: u32| self.nodes[child as usize].bounds.center().dot(ray.direction);
                let swapped = entry(second) < entry(first);
                stack.push(if swapped { first } else { second });
                stack.push(if swapped { second } else { first });
                continue;
            }
            for leaf in node.next as usize..(node.next + node.count) as usize {
                let Some(t) = ray.meets(&self.triangles[leaf]) else { continue };
                if t <= t_min || t >= t_max {
                    continue;
                }
                match visit(self.numbers[leaf] as usize, t) {
                    Next::Continue => {}
                    Next::Nearer(t) => t_max = t,
                    Next::Stop => return,
                }
            }
        }
    }
}

enum Next {
    Continue,
    /// Only hits nearer than this.
    Nearer(f64),
    Stop,
}

/// Nodes still to be looked at.
struct Stack {
    nodes: [u32; MAX_DEPTH],
    len: usize,
}

impl Stack {
    fn new(nodes: &[Node]) -> Self {
        Self { nodes: [0; MAX_DEPTH], len: usize::from(!nodes.is_empty()) }
    }

    fn push(&mut self, node: u32) {
        self.nodes[self.len] = node;
        self.len += 1;
    }

    fn pop(&mut self) -> Option<u32> {
        self.len = self.len.checked_sub(1)?;
        Some(self.nodes[self.len])
    }
}

struct Ray {
    origin: DVec3,
    direction: DVec3,
    inverse: DVec3,
}

impl Ray {
    fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, inverse: direction.recip() }
    }

    /// The slab test. Where the ray runs in a side of the box, 0 · ∞ is not a number, and that slab is left out.
    fn enters(&self, bounds: &Bounds, t_min: f64, t_max: f64) -> bool {
        let (mut near, mut far) = (t_min, t_max);
        for axis in 0..3 {
            let a = (bounds.min[axis] - self.origin[axis]) * self.inverse[axis];
            let b = (bounds.max[axis] - self.origin[axis]) * self.inverse[axis];
            if a.is_nan() || b.is_nan() {
                continue;
            }
            // A little wider than exact, against rounding.
            near = near.max(a.min(b) - 1e-12 * a.abs().min(b.abs()));
            far = far.min(a.max(b) + 1e-12 * a.abs().min(b.abs()));
        }
        near <= far
    }

    /// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997, for both sides.
    fn meets(&self, &[a, b, c]: &[DVec3; 3]) -> Option<f64> {
        let (ab, ac) = (b - a, c - a);
        let p = self.direction.cross(ac);
        let determinant = ab.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let from_a = self.origin - a;
        let u = from_a.dot(p) / determinant;
        let q = from_a.cross(ab);
        let v = self.direction.dot(q) / determinant;
        let inside = u >= -BARYCENTRIC_SLACK && v >= -BARYCENTRIC_SLACK && u + v <= 1.0 + BARYCENTRIC_SLACK;
        inside.then(|| ac.dot(q) / determinant)
    }
}

#[derive(Clone, Copy)]
struct Item {
    number: u32,
    bounds: Bounds,
}

/// The subtree over these items, which it sorts, the first of which is number `first` of all.
fn build(items: &mut [Item], first: u32) -> Vec<Node> {
    let bounds = items.iter().fold(Bounds::EMPTY, |all, item| all.union(&item.bounds));
    if items.len() <= LEAF_SIZE {
        return vec![Node { bounds, next: first, count: items.len() as u32 }];
    }
    let centers = items.iter().fold(Bounds::EMPTY, |all, item| {
        let center = item.bounds.center();
        all.union(&Bounds { min: center, max: center })
    });
    let axis = (centers.max - centers.min).max_position();
    let half = items.len() / 2;
    let key = |item: &Item| item.bounds.min[axis] + item.bounds.max[axis];
    items.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)));
    let (low, high) = items.split_at_mut(half);
    let second = first + half as u32;
    let (low, high) = if low.len() > PARALLEL_SIZE {
        rayon::join(|| build(low, first), || build(high, second))
    } else {
        (build(low, first), build(high, second))
    };
    let mut nodes = Vec::with_capacity(1 + low.len() + high.len());
    nodes.push(Node { bounds, next: 1 + low.len() as u32, count: 0 });
    for (subtree, start) in [(&low, 1), (&high, 1 + low.len() as u32)] {
        nodes.extend(subtree.iter().map(|node| match node.count {
            0 => Node { next: node.next + start, ..*node },
            _ => *node,
        }));
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives;

    /// Numbers between −1 and 1 that look random (a linear congruential generator).
    fn noise(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    fn point(noise: &mut impl FnMut() -> f64) -> DVec3 {
        DVec3::new(noise(), noise(), noise())
    }

    #[test]
    fn rays_meet_what_they_meet_without_the_tree() {
        let mut noise = noise(1);
        let triangles: Vec<[DVec3; 3]> = (0..20_000)
            .map(|_| {
                let center = point(&mut noise);
                [(); 3].map(|()| center + point(&mut noise) * 0.08)
            })
            .collect();
        let tree = Bvh::new(&triangles);
        let (mut hits, mut misses) = (0, 0);
        for i in 0..200 {
            let (origin, mut direction) = (point(&mut noise) * 2.0, point(&mut noise));
            if i % 10 == 0 {
                direction.x = 0.0;
            }
            let (t_min, t_max) = (0.05, 3.0);
            let skip = |t: usize| t.is_multiple_of(3);
            let ray = Ray::new(origin, direction);
            let expected = triangles
                .iter()
                .enumerate()
                .filter(|(t, _)| !skip(*t))
                .filter_map(|(triangle, corners)| Some(Hit { triangle, t: ray.meets(corners)? }))
                .filter(|hit| hit.t > t_min && hit.t < t_max)
                .min_by(|a, b| a.t.total_cmp(&b.t));
            assert_eq!(tree.closest_hit(origin, direction, t_min, t_max, skip), expected);
            assert_eq!(tree.any_hit(origin, direction, t_min, t_max, skip), expected.is_some());
            *(if expected.is_some() { &mut hits } else { &mut misses }) += 1;
        }
        assert!(hits > 20 && misses > 20, "{hits} hits, {misses} misses prove little");
    }

    #[test]
    fn boxes_overlap_what_they_overlap_without_the_tree() {
        let mut noise = noise(2);
        let triangles: Vec<[DVec3; 3]> = (0..3000)
            .map(|_| {
                let center = point(&mut noise);
                [(); 3].map(|()| center + point(&mut noise) * 0.1)
            })
            .collect();
        let tree = Bvh::new(&triangles);
        for _ in 0..50 {
            let center = point(&mut noise);
            let bounds = Bounds { min: center - 0.1, max: center + 0.1 };
            let mut found = Vec::new();
            tree.overlapping(&bounds, |t| found.push(t));
            found.sort_unstable();
            let expected: Vec<usize> = (0..triangles.len())
                .filter(|&t| {
                    let [a, b, c] = triangles[t];
                    a.min(b).min(c).cmple(bounds.max).all() && a.max(b).max(c).cmpge(bounds.min).all()
                })
                .collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn no_ray_slips_through_a_closed_surface() {
        let mesh = primitives::cube(2.0);
        let triangles: Vec<[DVec3; 3]> =
            mesh.triangles().iter().map(|&t| mesh.corners(t).map(|p| p.as_dvec3())).collect();
        let tree = Bvh::new(&triangles);
        // Along the diagonals of the sides and through the corners, where triangles meet.
        for i in -10..=10 {
            for j in -10..=10 {
                let target = DVec3::new(f64::from(i) / 10.0, f64::from(j) / 10.0, 1.0);
                assert!(tree.any_hit(DVec3::ZERO, target, 0.0, 2.0, |_| false), "{target}");
            }
        }
        let empty = Bvh::new(&[[DVec3::NAN; 3]]);
        assert!(!empty.any_hit(DVec3::ZERO, DVec3::X, 0.0, 1.0, |_| false));
    }
}
