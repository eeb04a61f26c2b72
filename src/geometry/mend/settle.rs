//! Moves places that become one point to their middle, or where that would turn a triangle over, elsewhere.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use super::super::Mesh;
use super::super::normals::face_normal;
use super::join::Draft;
use super::places::Places;

/// Cosine of the largest angle by which joining may turn a triangle.
const COS_TURN: f32 = 0.2;
/// How often groups are moved elsewhere before those that are left are not joined.
const ROUNDS: usize = 4;

/// Where the vertices of the draft go.
pub(super) fn settle(mesh: &Mesh, draft: &Draft, places: &Places) -> Vec<Vec3> {
    let mut settling = Settling::new(mesh, draft, places);
    for round in 0..2 * ROUNDS {
        let turned = settling.turned_triangles();
        if turned.is_empty() {
            break;
        }
        let groups: BTreeSet<u32> =
            turned.iter().flat_map(|&t| draft.triangles[t]).map(|v| settling.groups[v as usize]).collect();
        let around = settling.triangles_around(&groups);
        for group in groups {
            if round < ROUNDS {
                settling.try_elsewhere(group, around.get(&group).map_or(&[], Vec::as_slice));
            } else {
                settling.targets[group as usize] = None;
            }
        }
    }
    (0..draft.places.len()).map(|v| settling.position(v as u32)).collect()
}

struct Settling<'a> {
    mesh: &'a Mesh,
    draft: &'a Draft,
    places: &'a Places,
    /// The group of each vertex.
    groups: Vec<u32>,
    /// Where each group goes; `None`: its members stay where they are.
    targets: Vec<Option<Vec3>>,
    /// The triangles with a vertex in a group of several places.
    touched: Vec<usize>,
}

impl<'a> Settling<'a> {
    fn new(mesh: &'a Mesh, draft: &'a Draft, places: &'a Places) -> Self {
        let groups: Vec<u32> = draft.places.iter().map(|&place| places.group(place)).collect();
        let targets: Vec<Option<Vec3>> =
            (0..places.count() as u32).map(|group| places.middle(group)).collect();
        let is_touched = |t: &[u32; 3]| t.iter().any(|&v| targets[groups[v as usize] as usize].is_some());
        let touched =
            draft.triangles.iter().enumerate().filter(|(_, t)| is_touched(t)).map(|(t, _)| t).collect();
        Self { mesh, draft, places, groups, targets, touched }
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

    /// Moves a group to the place of that member around which triangles turn least, unless the middle is better.
    fn try_elsewhere(&mut self, group: u32, around: &[usize]) {
        let Some(middle) = self.places.middle(group) else { return };
        let members: Vec<Vec3> = self.places.members(group).map(|place| self.before(place)).collect();
        let mut best = (f32::NEG_INFINITY, middle);
        for target in std::iter::once(middle).chain(members) {
            self.targets[group as usize] = Some(target);
            let worst = around.iter().map(|&t| self.turn(t)).fold(1.0, f32::min);
            if worst > best.0 {
                best = (worst, target);
            }
        }
        self.targets[group as usize] = Some(best.1);
    }

    /// Where a place is before it moves.
    fn before(&self, place: u32) -> Vec3 {
        let points = self.mesh.positions.len();
        let vertex = place as usize;
        // Cuts are appended border by border, not in the order in which they were made.
        if vertex < points {
            return self.mesh.positions[vertex];
        }
        let found = self.draft.places[points..].iter().position(|&p| p == place);
        found.and_then(|k| self.draft.mesh.positions.get(points + k)).copied().unwrap_or_default()
    }
}
