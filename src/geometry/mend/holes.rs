//! Step 3: thin holes between border edges.

use std::collections::HashMap;

use glam::DVec3;

use super::anchors::Joined;
use super::borders::{Borders, NO_BORDER};
use super::limits::{COS_FOLD, Limits};
use super::open::Open;
use super::side::Side;
use super::zip::Fit;

/// Holes with more edges are left to the next step.
const MAX_EDGES: usize = 512;
/// Cosine of the widest angle at the ends of a thin hole, 80°: a slot has 90° there.
const COS_END: f64 = 0.173_648_177_667;

/// Joins the two sides of every thin hole.
pub(super) fn thin_holes(borders: &Borders, open: &Open, limits: &Limits) -> Vec<Joined> {
    loops(borders, open).iter().filter_map(|hole| close(borders, hole, limits)).collect()
}

/// The border edges around holes: after each edge follows the one at the smallest angle across the hole.
fn loops(borders: &Borders, open: &Open) -> Vec<Vec<u32>> {
    let mut next: HashMap<u32, u32> = HashMap::with_capacity(open.edges.len());
    for &edge in &open.edges {
        let [group, _] = open.ends(edge);
        if open.starting_at(group).first() == Some(&(group, edge)) {
            link(borders, open, group, &mut next);
        }
    }
    let mut is_followed = vec![false; borders.list.len()];
    let mut loops = Vec::new();
    for &first in &open.edges {
        if is_followed[first as usize] {
            continue;
        }
        let mut hole = Vec::new();
        let mut edge = first;
        while edge != NO_BORDER && !is_followed[edge as usize] {
            is_followed[edge as usize] = true;
            hole.push(edge);
            edge = next.get(&edge).copied().unwrap_or(NO_BORDER);
        }
        if edge == first && (3..=MAX_EDGES).contains(&hole.len()) {
            loops.push(hole);
        }
    }
    loops
}

/// Chooses which edge follows which at a point.
fn link(borders: &Borders, open: &Open, group: u32, next: &mut HashMap<u32, u32>) {
    let mut links: Vec<(f64, u32, u32)> = Vec::new();
    for &(_, incoming) in open.ending_at(group) {
        for &(_, outgoing) in open.starting_at(group) {
            let (a, b) = (borders.get(incoming), borders.get(outgoing));
            let cos = -a.direction.dot(b.direction);
            if a.face != b.face && (cos < 0.5 || a.is_unfolded(b, COS_FOLD)) {
                links.push((cos, incoming, outgoing));
            }
        }
    }
    links.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut taken: Vec<u32> = Vec::new();
    for (_, incoming, outgoing) in links {
        if !next.contains_key(&incoming) && !taken.contains(&outgoing) {
            next.insert(incoming, outgoing);
            taken.push(outgoing);
        }
    }
}

fn close(borders: &Borders, hole: &[u32], limits: &Limits) -> Option<Joined> {
    let points: Vec<DVec3> = hole.iter().map(|&b| borders.get(b).positions[0]).collect();
    let mut hole = hole.to_vec();
    let (first, second) = farthest_pair(&points);
    hole.rotate_left(first);
    let split = (second + hole.len() - first) % hole.len();
    let is_pointed =
        |before: u32, after: u32| -borders.get(before).direction.dot(borders.get(after).direction) >= COS_END;
    let (&last, &start) = (hole.last()?, hole.first()?);
    let (there, back) = hole.split_at_checked(split)?;
    if !is_pointed(last, start) || !is_pointed(*there.last()?, *back.first()?) {
        return None;
    }
    let (side, other) = (Side::new(borders, there, false), Side::new(borders, back, true));
    let fit = Fit::new(&side, &other, COS_FOLD, limits)?;
    Some(Joined { ties: fit.ties(&side, &other, limits), edges: hole })
}

/// Two points that are about as far from each other as any.
fn farthest_pair(points: &[DVec3]) -> (usize, usize) {
    let farthest_from = |from: usize| {
        let distance = |&i: &usize| points[i].distance_squared(points[from]);
        (0..points.len())
            .max_by(|a, b| distance(a).total_cmp(&distance(b)).then(b.cmp(a)))
            .unwrap_or_default()
    };
    let first = farthest_from(0);
    let second = farthest_from(first);
    let third = farthest_from(second);
    (second, third)
}
