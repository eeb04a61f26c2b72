//! Plates: a 2D outline given thickness, with profiled rims, raised or sunk steps on both faces and through holes.
//! With a circle for its outline a plate is a turned part, so nearly every part of an engine is one.

use glam::{DVec2, DVec3};

use crate::delaunay;
use crate::outline::{Outline, contains, inset};
use crate::solid::Solid;

/// A profile: how far the outline is moved inwards at which height.
pub(crate) type Rim = Vec<(f64, f64)>;

/// A solid between two faces, `w` along its thickness.
#[derive(Default)]
pub(crate) struct Plate {
    /// The silhouette seen along `w`.
    pub(crate) outline: Outline,
    /// Its edge, from the back face to the front face.
    pub(crate) rim: Rim,
    /// What stands on or is sunk into the front face.
    pub(crate) front: Vec<Step>,
    /// The same for the back face.
    pub(crate) back: Vec<Step>,
    /// Holes from face to face.
    pub(crate) holes: Vec<Hole>,
}

/// An area of a face that is raised or sunk.
#[derive(Clone)]
pub(crate) struct Step {
    /// Where it leaves the face around it.
    pub(crate) outline: Outline,
    /// From there to the step's own face: moved inwards by, height above the face around it.
    pub(crate) rim: Rim,
    /// Steps on the step.
    pub(crate) inside: Vec<Self>,
}

/// A hole through the plate.
pub(crate) struct Hole {
    /// Its outline.
    pub(crate) outline: Outline,
    /// The chamfer at both ends.
    pub(crate) chamfer: f64,
}

impl Step {
    /// A step with one sloped wall.
    pub(crate) fn new(outline: Outline, slope: f64, height: f64) -> Self {
        Self { outline, rim: vec![(slope, height)], inside: Vec::new() }
    }

    /// The same with steps on it.
    pub(crate) fn with(mut self, inside: Vec<Self>) -> Self {
        self.inside = inside;
        self
    }
}

/// A straight rim from `-half` to `half`, chamfered by `chamfer`.
pub(crate) fn chamfered(half: f64, chamfer: f64) -> Rim {
    vec![(chamfer, -half), (0.0, -half + chamfer), (0.0, half - chamfer), (chamfer, half)]
}

impl Plate {
    /// A turned part: radii and heights from back to front; the first is the outline's own radius.
    pub(crate) fn turned(profile: &[(f64, f64)], segments: usize) -> Self {
        let radius = profile[0].0;
        Self {
            outline: crate::outline::circle(DVec2::ZERO, radius, segments),
            // A circle of n points moves its edges, not its points, by the inset.
            rim: profile
                .iter()
                .map(|&(r, w)| {
                    let edge = (std::f64::consts::PI / segments as f64).cos();
                    ((radius - r) * edge, w)
                })
                .collect(),
            ..Self::default()
        }
    }

    /// The surface.
    pub(crate) fn solid(&self) -> Solid {
        let mut out = Solid::default();
        let rings: Vec<Ring> = self.rim.iter().map(|&(d, w)| Ring::new(inset(&self.outline, d), w)).collect();
        for pair in rings.windows(2) {
            out.band(&pair[0].lifted(), &pair[1].lifted());
        }
        let mut ends: Vec<[f64; 2]> = vec![[0.0; 2]; self.holes.len()];
        for (side, ring, steps) in [(0, &rings[0], &self.back), (1, &rings[rings.len() - 1], &self.front)] {
            let mut face = Face { out: &mut out, holes: &self.holes, ends: &mut ends, side };
            let all: Vec<usize> = (0..self.holes.len()).collect();
            face.emit(ring, steps, &all);
        }
        for (hole, [low, high]) in self.holes.iter().zip(ends) {
            let c = hole.chamfer;
            let mut wall = vec![(0.0, low + c), (0.0, high - c)];
            if c > 0.0 {
                wall.insert(0, (-c, low));
                wall.push((-c, high));
            }
            let wall: Vec<Vec<DVec3>> =
                wall.iter().map(|&(d, w)| Ring::new(inset(&hole.outline, d), w).lifted()).collect();
            for pair in wall.windows(2) {
                out.band(&pair[1], &pair[0]);
            }
        }
        out
    }
}

/// An outline at a height.
struct Ring {
    points: Outline,
    w: f64,
}

impl Ring {
    fn new(points: Outline, w: f64) -> Self {
        Self { points, w }
    }

    fn lifted(&self) -> Vec<DVec3> {
        self.points.iter().map(|p| p.extend(self.w)).collect()
    }
}

/// One of the two faces while it is built.
struct Face<'a> {
    out: &'a mut Solid,
    holes: &'a [Hole],
    ends: &'a mut [[f64; 2]],
    /// 0 = back, 1 = front.
    side: usize,
}

impl Face<'_> {
    /// Fills the area inside `ring`, with its steps, around those of the `candidates` among the holes that lie in it.
    fn emit(&mut self, ring: &Ring, steps: &[Step], candidates: &[usize]) {
        let up = [-1.0, 1.0][self.side];
        let mut taken = Vec::new();
        let mut cut: Vec<Outline> = Vec::new();
        for step in steps {
            let within: Vec<usize> = candidates
                .iter()
                .copied()
                .filter(|&h| contains(&step.outline, self.holes[h].outline[0]))
                .collect();
            let mut below = Ring::new(step.outline.clone(), ring.w);
            for &(d, height) in &step.rim {
                let above = Ring::new(inset(&step.outline, d), ring.w + up * height);
                self.band(&below, &above);
                below = above;
            }
            self.emit(&below, &step.inside, &within);
            taken.extend(within);
            cut.push(step.outline.clone());
        }
        for &h in candidates.iter().filter(|h| !taken.contains(h)) {
            self.ends[h][self.side] = ring.w;
            cut.push(inset(&self.holes[h].outline, -self.holes[h].chamfer));
        }
        for [a, b, c] in delaunay::fill(&ring.points, &cut) {
            let [a, b, c] = [a, b, c].map(|p| p.extend(ring.w));
            if self.side == 1 {
                self.out.triangle(a, b, c);
            } else {
                self.out.triangle(a, c, b);
            }
        }
    }

    /// The wall of a step.
    fn band(&mut self, from: &Ring, to: &Ring) {
        let (from, to) = (from.lifted(), to.lifted());
        if self.side == 1 {
            self.out.band(&from, &to);
        } else {
            let flip = |ring: Vec<DVec3>| ring.into_iter().rev().collect::<Vec<_>>();
            self.out.band(&flip(from), &flip(to));
        }
    }
}
