//! A bounding volume hierarchy over triangles, for rays cast on the CPU in double precision.

use glam::DVec3;

use super::Bounds;

/// Most triangles in a leaf.
const LEAF_SIZE: usize = 4;
/// Subtrees with more triangles than this are built on several threads.
const PARALLEL_SIZE: usize = 8192;
/// How far outside a triangle, in barycentric coordinates, a ray still meets it, so that none slips through between
/// two neighbors.
const BARYCENTRIC_SLACK: f64 = 1e-12;
/// How many places along an axis are tried for a split.
const BINS: usize = 12;
/// Below this depth, splits are at the median.
const SEARCHED_DEPTH: usize = 28;
/// So no tree over 2³² triangles is deeper than this.
const MAX_DEPTH: usize = 64;

/// The hierarchy: a binary tree, split along the longest axis where rays then have the least to do.
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
    /// Barycentric coordinates of the point: the weights of the second and the third corner.
    pub weights: [f64; 2],
}

impl Hit {
    /// Where the ray `origin + t · direction` meets a single triangle, from either side and at any `t`.
    pub fn of(origin: DVec3, direction: DVec3, triangle: usize, corners: &[DVec3; 3]) -> Option<Self> {
        Ray::new(origin, direction).meets(triangle, corners)
    }
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
        let nodes = if items.is_empty() { Vec::new() } else { build(&mut items, 0, 0) };
        Self {
            nodes,
            triangles: items.iter().map(|item| triangles[item.number as usize]).collect(),
            numbers: items.iter().map(|item| item.number).collect(),
        }
    }

    /// Some hit of the ray `origin + t · direction` with a triangle, from either side, with `t_min < t < t_max`, if
    /// there is one; those for which `skip` is true count as absent.
    pub fn any_hit(
        &self,
        origin: DVec3,
        direction: DVec3,
        t_min: f64,
        t_max: f64,
        skip: impl Fn(&Hit) -> bool,
    ) -> Option<Hit> {
        let mut found = None;
        self.traverse(&Ray::new(origin, direction), t_min, t_max, |hit| {
            if skip(&hit) {
                return Next::Continue;
            }
            found = Some(hit);
            Next::Stop
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
        skip: impl Fn(&Hit) -> bool,
    ) -> Option<Hit> {
        let mut closest = None;
        self.traverse(&Ray::new(origin, direction), t_min, t_max, |hit| {
            if skip(&hit) {
                return Next::Continue;
            }
            closest = Some(hit);
            Next::Nearer(hit.t)
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
    fn traverse(&self, ray: &Ray, t_min: f64, mut t_max: f64, mut visit: impl FnMut(Hit) -> Next) {
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
                let Some(hit) = ray.meets(self.numbers[leaf] as usize, &self.triangles[leaf]) else {
                    continue;
                };
                if hit.t <= t_min || hit.t >= t_max {
                    continue;
                }
                match visit(hit) {
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

    /// Where it meets a triangle, from either side: Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle
    /// Intersection", 1997.
    fn meets(&self, triangle: usize, &[a, b, c]: &[DVec3; 3]) -> Option<Hit> {
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
        inside.then(|| Hit { triangle, t: ac.dot(q) / determinant, weights: [u, v] })
    }
}

#[derive(Clone, Copy)]
struct Item {
    number: u32,
    bounds: Bounds,
}

/// The subtree over these items, which it sorts, the first of which is number `first` of all.
fn build(items: &mut [Item], first: u32, depth: usize) -> Vec<Node> {
    let bounds = items.iter().fold(Bounds::EMPTY, |all, item| all.union(&item.bounds));
    if items.len() <= LEAF_SIZE {
        return vec![Node { bounds, next: first, count: items.len() as u32 }];
    }
    let half = split(items, depth);
    let (low, high) = items.split_at_mut(half);
    let second = first + half as u32;
    let (low, high) = if low.len().min(high.len()) > PARALLEL_SIZE {
        rayon::join(|| build(low, first, depth + 1), || build(high, second, depth + 1))
    } else {
        (build(low, first, depth + 1), build(high, second, depth + 1))
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

/// Sorts items into two parts, none of them empty, and tells how long the first one is. The cost of a split is the
/// surface of each part times its number (Wald, "On Fast Construction of SAH-based Bounding Volume Hierarchies", 2007).
fn split(items: &mut [Item], depth: usize) -> usize {
    let centers = items.iter().fold(Bounds::EMPTY, |all, item| {
        let center = item.bounds.center();
        all.union(&Bounds { min: center, max: center })
    });
    let extent = centers.max - centers.min;
    let axis = extent.max_position();
    let bin = |item: &Item| {
        let along = (item.bounds.center()[axis] - centers.min[axis]) / extent[axis];
        ((along * BINS as f64) as usize).min(BINS - 1)
    };
    if depth < SEARCHED_DEPTH && extent[axis] > 0.0 {
        let mut bins = [(Bounds::EMPTY, 0); BINS];
        for item in items.iter() {
            let (bounds, count) = &mut bins[bin(item)];
            *bounds = bounds.union(&item.bounds);
            *count += 1;
        }
        let cost = |part: &[(Bounds, usize)]| {
            let (bounds, count) =
                part.iter().fold((Bounds::EMPTY, 0), |all, one| (all.0.union(&one.0), all.1 + one.1));
            let size = bounds.max - bounds.min;
            let surface = size.x * size.y + size.y * size.z + size.z * size.x;
            (count > 0).then_some(surface * count as f64)
        };
        let costs = (1..BINS).filter_map(|at| Some((at, cost(&bins[..at])? + cost(&bins[at..])?)));
        if let Some((at, _)) = costs.min_by(|a, b| a.1.total_cmp(&b.1)) {
            items.sort_unstable_by_key(|item| bin(item) >= at);
            return items.partition_point(|item| bin(item) < at);
        }
    }
    let half = items.len() / 2;
    items.select_nth_unstable_by(half, |a, b| a.bounds.center()[axis].total_cmp(&b.bounds.center()[axis]));
    half
}

#[cfg(test)]
#[path = "bvh_tests.rs"]
mod tests;
