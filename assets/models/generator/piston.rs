//! A piston around its wrist pin, which lies along X: body, rings, pin.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec2, dvec3};

use crate::crankshaft::tube;
use crate::delaunay;
use crate::outline::arc;
use crate::plate::Plate;
use crate::solid::{Axis, Solid};

/// Heights of the rings' middles above the wrist pin.
pub(crate) const RINGS: [f64; 3] = [25.0, 19.4, 14.4];
/// Columns around the body.
const COLUMNS: usize = 32;
/// Columns on either side of a pin boss's middle that make room for it.
const BESIDE: i32 = 4;
/// Radius of the skirt.
const SKIRT: f64 = 39.0;
/// Radius of the lands between the rings.
const LAND: f64 = 38.6;
/// Radius at the bottom of the grooves.
const GROOVE: f64 = 35.2;
/// Inner radius of the skirt.
const INNER: f64 = 34.0;
/// Radius of the bore for the wrist pin.
const BORE: f64 = 10.25;
/// Radius of the bosses that carry it.
const BOSS: f64 = 15.5;
/// Where the bosses end, from the piston's axis.
const BOSS_END: f64 = 13.5;

/// A point of the body.
fn point(radius: f64, angle: f64, y: f64) -> DVec3 {
    dvec3(radius * angle.cos(), y, -radius * angle.sin())
}

/// The angle of a column.
fn angle(column: i32) -> f64 {
    TAU * f64::from(column) / COLUMNS as f64
}

/// A ring of the body around Y.
fn ring_at(radius: f64, y: impl Fn(f64) -> f64) -> Vec<DVec3> {
    (0..COLUMNS as i32).map(|c| point(radius, angle(c), y(angle(c)))).collect()
}

/// The skirt's lower edge: cut away beside the pin, where the counterweights pass.
fn edge(angle: f64) -> f64 {
    let side = angle.cos().abs();
    let t = ((side - 0.55) / 0.3).clamp(0.0, 1.0);
    -31.0 + 11.5 * t * t * (3.0 - 2.0 * t)
}

/// Rows of the outer skirt around the bore.
const OUTER_ROWS: [f64; 2] = [-15.0, 13.0];
/// Rows of the inner skirt around the boss.
const INNER_ROWS: [f64; 2] = [-18.0, 17.5];

/// The body: crown, ring grooves, skirt, hollow, bosses with their bore.
pub(crate) fn body() -> Solid {
    let mut out = Solid::default();
    let flat = |r, y| ring_at(r, move |_| y);
    // From the middle of the ceiling down the inside, around the edge, up the outside, to the middle of the crown.
    let mut path = vec![flat(31.0, 22.5)];
    path.extend(INNER_ROWS.iter().rev().map(|&y| flat(INNER, y)));
    path.push(ring_at(INNER + 0.6, edge));
    path.push(ring_at(SKIRT, edge));
    path.extend(OUTER_ROWS.iter().map(|&y| flat(SKIRT, y)));
    let mut land = SKIRT;
    for (i, &middle) in RINGS.iter().enumerate().rev() {
        let half = if i == 2 { 1.4 } else { 1.0 };
        if i < 2 {
            path.push(flat(land, middle - half));
        }
        path.push(flat(GROOVE, middle - half));
        path.push(flat(GROOVE, middle + half));
        land = LAND;
        path.push(flat(land, middle + half));
    }
    path.extend([flat(LAND, 29.0), flat(LAND - 1.0, 30.0), flat(28.0, 30.0), flat(25.0, 27.8)]);
    let inner_rows = 1..2;
    let outer_rows = 5..6;
    for (i, pair) in path.windows(2).enumerate() {
        let open = inner_rows.contains(&i) || outer_rows.contains(&i);
        strip(&mut out, &pair[0], &pair[1], open);
    }
    lid(&mut out, &path[0], false);
    lid(&mut out, &path[path.len() - 1], true);
    for half_turn in [false, true] {
        boss(&mut out, half_turn);
    }
    out
}

/// A band of the body; an open one leaves out the columns of the bosses.
fn strip(out: &mut Solid, a: &[DVec3], b: &[DVec3], open: bool) {
    let half = COLUMNS as i32 / 2;
    for i in 0..COLUMNS as i32 {
        let from_boss = (i + BESIDE).rem_euclid(half);
        if open && from_boss < 2 * BESIDE {
            continue;
        }
        let (i, j) = (i as usize, (i as usize + 1) % COLUMNS);
        out.quad(a[i], a[j], b[j], b[i]);
    }
}

/// Closes the body at its axis.
fn lid(out: &mut Solid, ring: &[DVec3], up: bool) {
    let outline: Vec<DVec2> = ring.iter().map(|p| dvec2(p.x, -p.z)).collect();
    for face in delaunay::fill(&outline, &[]) {
        let [a, b, c] = face.map(|p| dvec3(p.x, ring[0].y, -p.y));
        if up {
            out.triangle(a, b, c);
        } else {
            out.triangle(a, c, b);
        }
    }
}

/// One end of the wrist pin's bore: from the skirt through the boss to the hollow.
fn boss(out: &mut Solid, half_turn: bool) {
    let outer = frame(OUTER_ROWS);
    let inner = frame(INNER_ROWS);
    let n = outer.len();
    let start = -0.5 * PI - PI * f64::from(BESIDE) / (n as f64 / 2.0);
    let round = |radius: f64| -> Vec<DVec2> {
        (0..n).map(|i| radius * DVec2::from_angle(start + TAU * i as f64 / n as f64)).collect()
    };
    // Across the bore on a cylinder around the piston's axis: angle and height.
    let wrap = |across: Vec<DVec2>, radius: f64| -> Vec<DVec2> {
        across.iter().map(|p| dvec2((p.x / radius).asin(), p.y)).collect()
    };
    let on = |radius: f64, ring: &[DVec2]| -> Vec<DVec3> {
        ring.iter().map(|p| point(radius, p.x, p.y)).collect()
    };
    let between = |a: &[DVec2], b: &[DVec2], t: f64| -> Vec<DVec2> {
        a.iter().zip(b).map(|(a, b)| a.lerp(*b, t)).collect()
    };
    let flat =
        |radius: f64, x: f64| -> Vec<DVec3> { round(radius).iter().map(|p| dvec3(x, p.y, -p.x)).collect() };
    let mouth = wrap(round(BORE), SKIRT);
    let root = wrap(round(BOSS), INNER);
    let rings = [
        on(SKIRT, &outer),
        on(SKIRT, &between(&outer, &mouth, 0.55)),
        on(SKIRT, &mouth),
        flat(BORE, BOSS_END),
        flat(BOSS, BOSS_END),
        on(INNER, &root),
        on(INNER, &inner),
    ];
    let turned = |ring: &Vec<DVec3>| -> Vec<DVec3> {
        let sign = if half_turn { -1.0 } else { 1.0 };
        ring.iter().map(|p| dvec3(sign * p.x, p.y, sign * p.z)).collect()
    };
    for pair in rings.windows(2) {
        out.band(&turned(&pair[0]), &turned(&pair[1]));
    }
}

/// The border of the cells that a boss replaces: angle and height, counter-clockwise from outside.
fn frame(rows: [f64; 2]) -> Vec<DVec2> {
    let mut out = Vec::new();
    for c in -BESIDE..BESIDE {
        out.push(dvec2(angle(c), rows[0]));
    }
    out.push(dvec2(angle(BESIDE), rows[0]));
    for c in (-BESIDE + 1..=BESIDE).rev() {
        out.push(dvec2(angle(c), rows[1]));
    }
    out.push(dvec2(angle(-BESIDE), rows[1]));
    out
}

/// A piston ring of the given height, with its gap at −Z.
pub(crate) fn ring(height: f64) -> Solid {
    let gap: f64 = 1.0;
    let (outer, inner): (f64, f64) = (39.3, GROOVE + 0.5);
    let (a, b) = ((gap / outer).asin(), (gap / inner).asin());
    let mut outline = arc(DVec2::ZERO, outer, a, TAU - a, 32);
    outline.extend(arc(DVec2::ZERO, inner, TAU - b, b, 32));
    let half = height / 2.0;
    Plate { outline, rim: vec![(0.0, -half), (0.0, half)], ..Plate::default() }.solid().along(Axis::Y)
}

/// The hollow wrist pin.
pub(crate) fn pin() -> Solid {
    tube(5.5, 10.0, 33.0, 0.8, 16).solid().along(Axis::X)
}
