//! Texture coordinates: each face goes to the nearest of some capsules, is unrolled around it, and the unrolled
//! charts are packed into the unit square at one scale.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec2};

use crate::remesh::Surface;

/// A capsule to unroll from; its own texture runs around it (u) and along it (v).
#[derive(Clone, Copy)]
pub(crate) struct Chart {
    /// One end of its axis.
    pub(crate) from: DVec3,
    /// The other end.
    pub(crate) to: DVec3,
    /// Its radius.
    pub(crate) radius: f64,
    /// Where the seam goes, as seen from the axis.
    pub(crate) seam: DVec3,
}

/// A vertex of the unrolled surface: a point and its texture coordinates.
pub(crate) struct Unwrapped {
    /// Point and coordinates of each vertex.
    pub(crate) vertices: Vec<(usize, DVec2)>,
    /// Vertices of each face.
    pub(crate) faces: Vec<[usize; 3]>,
}

impl Chart {
    /// A chart around the axis from `from` to `to` with its seam behind (−Z).
    pub(crate) fn new(from: DVec3, to: DVec3, radius: f64) -> Self {
        Self { from, to, radius, seam: DVec3::NEG_Z }
    }

    /// The same with another seam.
    pub(crate) fn seam(mut self, seam: DVec3) -> Self {
        self.seam = seam;
        self
    }

    /// The axis' direction and length.
    fn axis(&self) -> (DVec3, f64) {
        let axis = self.to - self.from;
        let length = axis.length();
        if length > 1e-9 { (axis / length, length) } else { (DVec3::Y, 0.0) }
    }

    /// Distance from the capsule.
    fn distance(&self, p: DVec3) -> f64 {
        let (axis, length) = self.axis();
        let t = (p - self.from).dot(axis).clamp(0.0, length);
        p.distance(self.from + axis * t) - self.radius
    }

    /// The direction from the axis to a point.
    fn outwards(&self, p: DVec3) -> DVec3 {
        let (axis, _) = self.axis();
        let from = p - self.from;
        from - axis * axis.dot(from)
    }

    /// Angle around the axis, ±π at the seam, and arc length along capsule.
    fn unroll(&self, p: DVec3) -> (f64, f64) {
        let (axis, length) = self.axis();
        let x = (axis * axis.dot(self.seam) - self.seam).normalize();
        let out = self.outwards(p);
        let angle = out.dot(axis.cross(x)).atan2(out.dot(x));
        let t = (p - self.from).dot(axis);
        let beyond = |t: f64| self.radius * t.atan2(out.length());
        let along = if t < 0.0 {
            beyond(t)
        } else if t > length {
            length + beyond(t - length)
        } else {
            t
        };
        (angle, along)
    }
}

/// Unrolls a surface around `charts`. The inner side of a `layered` one (a sleeve) gets charts of its own.
pub(crate) fn unwrap(surface: &Surface, charts: &[Chart], layered: bool) -> Unwrapped {
    let mut out = Unwrapped { vertices: Vec::new(), faces: Vec::new() };
    let mut numbers: BTreeMap<(usize, usize, i64), usize> = BTreeMap::new();
    let mut chart_of: Vec<usize> = Vec::new();
    for face in &surface.faces {
        let [a, b, c] = face.map(|i| surface.points[i]);
        let middle = (a + b + c) / 3.0;
        let nearest = (0..charts.len())
            .min_by(|&i, &j| charts[i].distance(middle).total_cmp(&charts[j].distance(middle)))
            .unwrap_or(0);
        let chart = &charts[nearest];
        let inner = layered && (b - a).cross(c - a).dot(chart.outwards(middle)) < 0.0;
        let key = nearest * 2 + usize::from(inner);
        let (around, _) = chart.unroll(middle);
        out.faces.push(face.map(|i| {
            let (angle, along) = chart.unroll(surface.points[i]);
            let turns = ((around - angle) / TAU).round();
            *numbers.entry((i, key, turns as i64)).or_insert_with(|| {
                let u = (angle + turns * TAU + PI) * chart.radius;
                out.vertices.push((i, dvec2(u, -along)));
                chart_of.push(key);
                out.vertices.len() - 1
            })
        }));
    }
    pack(&mut out.vertices, &chart_of, charts.len() * 2);
    out
}

/// Lays the charts out in rows, the tallest first, and scales everything into the unit square.
fn pack(vertices: &mut [(usize, DVec2)], chart_of: &[usize], charts: usize) {
    let mut boxes = vec![(DVec2::INFINITY, DVec2::NEG_INFINITY); charts];
    for ((_, uv), &chart) in vertices.iter().zip(chart_of) {
        boxes[chart] = (boxes[chart].0.min(*uv), boxes[chart].1.max(*uv));
    }
    let size = |chart: usize| (boxes[chart].1 - boxes[chart].0).max(DVec2::ZERO);
    let area: f64 = (0..charts).map(|c| size(c).x * size(c).y).sum();
    let widest = (0..charts).map(|c| size(c).x).fold(0.0, f64::max);
    let width = (area.sqrt() * 1.1).max(widest * 1.02);
    let gap = width * 0.01;
    let mut order: Vec<usize> = (0..charts).filter(|&c| size(c).x > 0.0).collect();
    order.sort_by(|&a, &b| size(b).y.total_cmp(&size(a).y).then(a.cmp(&b)));
    let mut corner = vec![DVec2::ZERO; charts];
    let (mut pen, mut row) = (DVec2::splat(gap), 0.0_f64);
    for &c in &order {
        if pen.x > gap && pen.x + size(c).x > width {
            pen = dvec2(gap, pen.y + row + gap);
            row = 0.0;
        }
        corner[c] = pen;
        pen.x += size(c).x + gap;
        row = row.max(size(c).y);
    }
    let scale = 1.0 / (width + 2.0 * gap).max(pen.y + row + gap);
    for ((_, uv), &chart) in vertices.iter_mut().zip(chart_of) {
        *uv = (*uv - boxes[chart].0 + corner[chart]) * scale;
    }
}
