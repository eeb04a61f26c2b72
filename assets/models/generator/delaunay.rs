//! Triangulates a polygon with holes, then flips edges until no triangle is thinner than it has to be.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::outline::Outline;

/// The triangles inside `outline` and outside all `holes`, counter-clockwise. Adds no points.
pub(crate) fn fill(outline: &Outline, holes: &[Outline]) -> Vec<[DVec2; 3]> {
    let mut points = outline.clone();
    let mut starts = Vec::new();
    for hole in holes {
        starts.push(points.len());
        points.extend(hole.iter().rev());
    }
    let flat: Vec<f64> = points.iter().flat_map(|p| p.to_array()).collect();
    let corners = earcutr::earcut(&flat, &starts, 2).expect("outlines are simple polygons");
    let mut faces: Vec<[usize; 3]> = corners
        .chunks_exact(3)
        .map(|c| [c[0], c[1], c[2]])
        .map(|[a, b, c]| {
            let turn = (points[b] - points[a]).perp_dot(points[c] - points[a]);
            if turn < 0.0 { [a, c, b] } else { [a, b, c] }
        })
        .collect();
    for _ in 0..64 {
        if !flip_all(&points, &mut faces) {
            break;
        }
    }
    faces.iter().map(|f| f.map(|i| points[i])).collect()
}

/// Flips each edge once that has a better diagonal; tells whether there was any. Edges of the outline have a triangle
/// on one side only and so are never touched.
fn flip_all(points: &[DVec2], faces: &mut [[usize; 3]]) -> bool {
    let mut beside: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (f, face) in faces.iter().enumerate() {
        for k in 0..3 {
            beside.insert((face[k], face[(k + 1) % 3]), f);
        }
    }
    let mut stale = vec![false; faces.len()];
    let mut any = false;
    for (&(a, b), &f) in &beside {
        let Some(&g) = beside.get(&(b, a)) else {
            continue;
        };
        if a > b || stale[f] || stale[g] {
            continue;
        }
        let apex = |f: usize| faces[f].iter().copied().find(|&i| i != a && i != b);
        let (Some(c), Some(d)) = (apex(f), apex(g)) else {
            continue;
        };
        if in_circle(points[a], points[b], points[c], points[d]) {
            faces[f] = [a, d, c];
            faces[g] = [d, b, c];
            (stale[f], stale[g]) = (true, true);
            any = true;
        }
    }
    any
}

/// Does `d` lie clearly inside the circle through the counter-clockwise triangle `a`, `b`, `c`?
fn in_circle(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    let [a, b, c] = [a - d, b - d, c - d];
    let value = a.length_squared() * b.perp_dot(c) - b.length_squared() * a.perp_dot(c)
        + c.length_squared() * a.perp_dot(b);
    let scale = a.length_squared().max(b.length_squared()).max(c.length_squared());
    value > 1e-9 * scale * scale
}
