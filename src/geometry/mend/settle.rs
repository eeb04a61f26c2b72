//! Moves places that become one point to their middle, or where that would turn a triangle over, elsewhere.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use super::super::Mesh;
use super::super::normals::face_normal;
use super::border_points::PointGroups;
use super::borders::Borders;
use super::join::Draft;

/// Cosine of the largest angle by which joining may turn a triangle.
const COS_TURN: f32 = 0.0;
/// Height of the needles that may turn if nothing else helps, as a share of how far vertices may move.
const NEEDLE: f32 = 0.5;
/// Height of needles as a share of their longest side.
const SLENDER: f32 = 0.1;
/// How often groups are moved elsewhere before those that are left are not joined.
const ROUNDS: usize = 3;

/// Where everything goes.
pub(super) struct Settled {
    /// The position of each vertex of the draft.
    pub(super) positions: Vec<Vec3>,
    /// For each vertex of the draft whether it may lie off its place as far as anything was moved.
    pub(super) is_doubtful: Vec<bool>,
    /// For each place a number of the point it became; places that became one have the same.
    pub(super) points: Vec<u32>,
    /// The triangles with a corner that became one with another place.
    pub(super) touched: Vec<usize>,
}

/// Finds places for the vertices of the draft.
pub(super) fn settle(mesh: &Mesh, borders: &Borders, draft: &Draft, places: &PointGroups) -> Settled {
    let mut settling = Settling::new(mesh, borders, draft, places);
    for round in 0..2 * ROUNDS {
        let turned = settling.turned_triangles();
        if turned.is_empty() {
            break;
        }
        match round {
            0..ROUNDS => settling.try_elsewhere(&turned),
            _ => settling.give_up(&turned, round + 1 == 2 * ROUNDS),
        }
    }
    let is_joined = |group: u32| settling.targets[group as usize].is_some();
    Settled {
        is_doubtful: (0..draft.places.len()).map(|v| settling.is_doubtful(v)).collect(),
        positions: (0..draft.places.len()).map(|v| settling.position(v as u32)).collect(),
        points: (0..places.count() as u32)
            .map(|place| Some(places.group(place)).filter(|&group| is_joined(group)).unwrap_or(place))
            .collect(),
        touched: settling.touched,
    }
}

struct Settling<'a> {
    mesh: &'a Mesh,
    borders: &'a Borders,
    draft: &'a Draft,
    places: &'a PointGroups,
    /// The group of each vertex.
    groups: Vec<u32>,
    /// Where each group goes; `None`: its members stay where they are.
    targets: Vec<Option<Vec3>>,
    /// Where those on straight seams are on the line.
    on_lines: Vec<Option<Vec3>>,
    /// The triangles with a vertex in a group of several places.
    touched: Vec<usize>,
}

impl<'a> Settling<'a> {
    fn new(mesh: &'a Mesh, borders: &'a Borders, draft: &'a Draft, places: &'a PointGroups) -> Self {
        let on_lines = places.on_lines(borders, &mesh.positions);
        let groups = 0..places.count() as u32;
        let targets: Vec<Option<Vec3>> =
            groups.zip(&on_lines).map(|(group, on_line)| on_line.or_else(|| places.middle(group))).collect();
        let groups: Vec<u32> = draft.places.iter().map(|&place| places.group(place)).collect();
        let is_moved = |&v: &u32| targets[groups[v as usize] as usize].is_some();
        let triangles = draft.triangles.iter().enumerate();
        let touched = triangles.filter(|(_, t)| t.iter().any(is_moved)).map(|(t, _)| t).collect();
        Self { mesh, borders, draft, places, groups, targets, on_lines, touched }
    }

    /// Whether a vertex belongs to others and does not meet them on a straight line.
    fn is_doubtful(&self, vertex: usize) -> bool {
        let group = self.groups[vertex];
        let target = self.targets[group as usize];
        self.places.is_shared(group) && (target.is_none() || target != self.on_lines[group as usize])
    }

    fn position(&self, vertex: u32) -> Vec3 {
        let target = self.targets[self.groups[vertex as usize] as usize];
        target.unwrap_or(self.draft.mesh.positions[vertex as usize])
    }

    /// The cosine of the angle by which a triangle turns; 1 if it collapses.
    fn turn(&self, triangle: usize) -> f32 {
        let corners = self.draft.triangles[triangle];
        let moved = corners.map(|v| self.position(v));
        if moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0] {
            return 1.0;
        }
        let source = self.mesh.triangles()[self.draft.sources[triangle] as usize];
        face_normal(moved).dot(face_normal(self.mesh.corners(source)))
    }

    /// Whether a triangle was so thin that its direction says nothing beside a crack.
    fn is_needle(&self, triangle: usize) -> bool {
        let source = self.mesh.triangles()[self.draft.sources[triangle] as usize];
        let [a, b, c] = self.mesh.corners(source);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let height = (b - a).cross(c - a).length() / longest;
        let groups = self.draft.triangles[triangle].map(|v| self.groups[v as usize]);
        let reach = groups.map(|group| self.places.reach(group)).into_iter().fold(0.0, f32::max);
        height < NEEDLE * reach && height < SLENDER * longest
    }

    fn turned_triangles(&self) -> Vec<usize> {
        self.touched.iter().copied().filter(|&t| self.turn(t) < COS_TURN).collect()
    }

    /// The touched triangles around each of these groups.
    fn triangles_around(&self, groups: &BTreeSet<u32>) -> BTreeMap<u32, Vec<usize>> {
        let mut is_wanted = vec![false; self.targets.len()];
        for &group in groups {
            is_wanted[group as usize] = true;
        }
        let mut around: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for &triangle in &self.touched {
            for v in self.draft.triangles[triangle] {
                let group = self.groups[v as usize];
                if is_wanted[group as usize] {
                    around.entry(group).or_default().push(triangle);
                }
            }
        }
        around
    }

    /// Moves the corners of turned triangles towards single members of their groups, if triangles turn less there.
    fn try_elsewhere(&mut self, turned: &[usize]) {
        let groups = turned.iter().flat_map(|&t| self.draft.triangles[t]);
        let groups: BTreeSet<u32> = groups.map(|v| self.groups[v as usize]).collect();
        for (group, around) in self.triangles_around(&groups) {
            let Some(target) = self.targets[group as usize] else { continue };
            let worst = |all: &Self| around.iter().map(|&t| all.turn(t)).fold(1.0, f32::min);
            let mut best = (worst(self), target);
            for target in self.alternatives(group) {
                self.targets[group as usize] = Some(target);
                let worst = worst(self);
                if worst > best.0 {
                    best = (worst, target);
                }
            }
            self.targets[group as usize] = Some(best.1);
        }
    }

    /// Where a group could go: its middle, and as far towards each member as that is not too far from any other.
    fn alternatives(&self, group: u32) -> Vec<Vec3> {
        let Some(middle) = self.places.middle(group) else { return Vec::new() };
        let reach = self.places.reach(group);
        let members: Vec<Vec3> = self.places.members(group).map(|place| self.before(place)).collect();
        let towards = members.iter().flat_map(|m| [0.0, 0.25, 0.5, 0.75].map(|share| m.lerp(middle, share)));
        let is_near = |p: &Vec3| members.iter().all(|m| m.distance(*p) <= reach);
        std::iter::once(middle).chain(towards.filter(is_near)).collect()
    }

    /// Leaves members of groups where they are: for each turned triangle those of the group with which it is turned
    /// least then, or those of all of its groups.
    fn give_up(&mut self, turned: &[usize], all: bool) {
        for &triangle in turned {
            if self.is_needle(triangle) {
                continue;
            }
            let groups = self.draft.triangles[triangle].map(|v| self.groups[v as usize]);
            let mut best = (f32::NEG_INFINITY, groups[0]);
            for group in groups {
                let target = self.targets[group as usize].take();
                let turn = self.turn(triangle);
                if target.is_some() && turn > best.0 {
                    best = (turn, group);
                }
                if !all {
                    self.targets[group as usize] = target;
                }
            }
            self.targets[best.1 as usize] = None;
        }
    }

    fn before(&self, place: u32) -> Vec3 {
        self.places.position(self.borders, place, &self.mesh.positions).as_vec3()
    }
}
