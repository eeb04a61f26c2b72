//! What the temple is built from: blocks, walls with openings, cornices, bands led along a path. In meters.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3, dvec2, dvec3};

use crate::delaunay;
use crate::outline::Outline;
use crate::plate::{Plate, Rim};
use crate::solid::{Axis, Solid};

/// How deep parts stand in each other, so that no two faces share a plane.
pub(crate) const SUNK: f64 = 0.02;

/// From where to where along an axis.
pub(crate) type Span = [f64; 2];

/// The span, longer by so many times [`SUNK`] at both ends: parts that meet in a third one end at different depths.
pub(crate) fn sunk([from, to]: Span, depth: f64) -> Span {
    [from - depth * SUNK, to + depth * SUNK]
}

/// The rectangle between two corners, counter-clockwise.
fn rectangle(u: Span, v: Span) -> [DVec2; 4] {
    [dvec2(u[0], v[0]), dvec2(u[1], v[0]), dvec2(u[1], v[1]), dvec2(u[0], v[1])]
}

/// A block with its sides along the axes.
pub(crate) fn block(x: Span, y: Span, z: Span) -> Solid {
    slab(rectangle(z, x).to_vec(), y)
}

/// An outline in the plan, given by z and x, from one height to another.
pub(crate) fn slab(outline: Outline, y: Span) -> Solid {
    Plate { outline, rim: vec![(0.0, y[0]), (0.0, y[1])], ..Plate::default() }.solid().along(Axis::Y)
}

/// A straight wall, as it is seen from one side.
pub(crate) struct Wall {
    length: Span,
    height: Span,
    thickness: Span,
    along_z: bool,
    /// Doorways and windows: where they are along the wall, and their lower and upper sides.
    openings: Vec<[Span; 2]>,
}

impl Wall {
    /// A wall whose length is along X.
    pub(crate) fn along_x(x: Span, y: Span, z: Span) -> Self {
        Self { length: x, height: y, thickness: z, along_z: false, openings: Vec::new() }
    }

    /// A wall whose length is along Z.
    pub(crate) fn along_z(z: Span, y: Span, x: Span) -> Self {
        Self { along_z: true, ..Self::along_x([-z[1], -z[0]], y, x) }
    }

    /// The same with a doorway that reaches down to the wall's foot.
    pub(crate) fn door(self, middle: f64, width: f64, top: f64) -> Self {
        let foot = self.height[0];
        self.window(middle, width, [foot, top])
    }

    /// The same with an opening.
    pub(crate) fn window(mut self, middle: f64, width: f64, y: Span) -> Self {
        let middle = if self.along_z { -middle } else { middle };
        self.openings.push([[middle - width / 2.0, middle + width / 2.0], y]);
        self
    }

    /// The wall's surface, cut along all sides of all openings, so that none of its corners lies within an edge.
    pub(crate) fn solid(self) -> Solid {
        let cuts = |ends: Span, side: usize| {
            let mut all: Vec<f64> =
                ends.into_iter().chain(self.openings.iter().flat_map(|o| o[side])).collect();
            all.sort_by(f64::total_cmp);
            all.dedup();
            all
        };
        let (u, v) = (cuts(self.length, 0), cuts(self.height, 1));
        let within = |[from, to]: Span, cuts: &[f64], i: usize| from <= cuts[i] && cuts[i + 1] <= to;
        let stone = |i: usize, j: usize| {
            i < u.len() - 1
                && j < v.len() - 1
                && !self.openings.iter().any(|o| within(o[0], &u, i) && within(o[1], &v, j))
        };
        let [near, far] = self.thickness;
        let mut solid = Solid::default();
        for (i, j) in (0..u.len() - 1).flat_map(|i| (0..v.len() - 1).map(move |j| (i, j))) {
            if !stone(i, j) {
                continue;
            }
            let [a, b, c, d] = rectangle([u[i], u[i + 1]], [v[j], v[j + 1]]);
            solid.quad(a.extend(far), b.extend(far), c.extend(far), d.extend(far));
            solid.quad(d.extend(near), c.extend(near), b.extend(near), a.extend(near));
            // Below, right, above, left; what lies before the first cell wraps to no cell.
            let beside = [(i, j.wrapping_sub(1)), (i + 1, j), (i, j + 1), (i.wrapping_sub(1), j)];
            for ((i, j), [from, to]) in beside.into_iter().zip([[a, b], [b, c], [c, d], [d, a]]) {
                if !stone(i, j) {
                    solid.quad(from.extend(near), to.extend(near), to.extend(far), from.extend(far));
                }
            }
        }
        if self.along_z { solid.along(Axis::X) } else { solid }
    }
}

/// The profile of torus molding and cavetto cornice, `height` in all, upon a face that is `inset` at the height `foot`.
fn cornice(inset: f64, foot: f64, height: f64) -> Rim {
    let torus = 0.09 * height;
    let (hollow, flare) = (0.6 * height, 0.42 * height);
    let arc = |n: usize, angle: f64| (0..=n).map(move |i| (angle * i as f64 / n as f64).sin_cos());
    let mut rim: Rim =
        arc(8, PI).map(|(sin, cos)| (inset - torus * sin, foot + torus * (1.0 - cos))).collect();
    let neck = foot + 2.0 * torus;
    rim.extend(
        arc(8, FRAC_PI_2).skip(1).map(|(sin, cos)| (inset - flare * (1.0 - cos), neck + hollow * sin)),
    );
    rim.push((inset - flare, foot + height));
    rim
}

/// A rectangular body whose sides lean inwards by `batter` meters per meter, under a cornice `crown` high that belongs
/// to the height.
pub(crate) fn crowned(x: Span, y: Span, z: Span, batter: f64, crown: f64) -> Solid {
    let [low, high] = [y[0], y[1] - crown];
    let mut rim = vec![(0.0, low)];
    rim.extend(cornice(batter * (high - low), high, crown));
    Plate { outline: rectangle(z, x).to_vec(), rim, ..Plate::default() }.solid().along(Axis::Y)
}

/// The section of an outer wall, by distance outwards from its upright inner face and height: its outer face leans
/// inwards by `lean` in all and ends in a cornice `crown` high.
pub(crate) fn wall_section(thickness: f64, y: Span, lean: f64, crown: f64) -> Outline {
    let mut section = eaves_section(thickness - lean, [y[1] - crown, y[1]]);
    section[0].y = y[0];
    section.insert(1, dvec2(thickness, y[0]));
    section
}

/// The section of a roof that ends in a cornice, by distance outwards and height.
pub(crate) fn eaves_section(width: f64, y: Span) -> Outline {
    let mut section = vec![dvec2(0.0, y[0])];
    section.extend(cornice(0.0, y[0], y[1] - y[0]).into_iter().map(|(inset, y)| dvec2(width - inset, y)));
    section.push(dvec2(0.0, y[1]));
    section
}

/// Leads a section along a path of x and z, outwards to the path's right, with mitered corners.
pub(crate) fn sweep(section: &Outline, path: &[DVec2]) -> Solid {
    let path = in_pieces(path);
    let right = |from: DVec2, to: DVec2| (to - from).normalize().perp();
    let n = path.len();
    let rings: Vec<Vec<DVec3>> = (0..n)
        .map(|i| {
            let before = right(path[i.max(1) - 1], path[i.max(1)]);
            let after = right(path[i.min(n - 2)], path[i.min(n - 2) + 1]);
            let out = (before + after) / (1.0 + before.dot(after));
            let place = |p: &DVec2| dvec3(path[i].x + out.x * p.x, p.y, path[i].y + out.y * p.x);
            section.iter().map(place).collect()
        })
        .collect();
    let mut solid = Solid::default();
    for pair in rings.windows(2) {
        solid.band(&pair[1], &pair[0]);
    }
    let corner = |ring: &[DVec3], p: DVec2| {
        section.iter().position(|q| *q == p).map(|i| ring[i]).expect("filling adds no points")
    };
    for triangle in delaunay::fill(section, &[]) {
        let [a, b, c] = triangle.map(|p| corner(&rings[0], p));
        solid.triangle(a, b, c);
        let [a, b, c] = triangle.map(|p| corner(&rings[n - 1], p));
        solid.triangle(a, c, b);
    }
    solid
}

/// The path with more points, so that narrow bands along it are not cut into needles.
fn in_pieces(path: &[DVec2]) -> Vec<DVec2> {
    const LONGEST: f64 = 8.0;
    let mut out = vec![path[0]];
    for side in path.windows(2) {
        let n = (side[0].distance(side[1]) / LONGEST).ceil();
        out.extend((1..=n as usize).map(|i| side[0].lerp(side[1], i as f64 / n)));
    }
    out
}
