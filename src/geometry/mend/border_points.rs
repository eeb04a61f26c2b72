//! Places on borders that become one point.

use glam::{DVec3, Vec3};

use super::borders::Borders;
use super::limits::Limits;

/// Of more cuts, an edge gets no further ones.
const MAX_INSERTIONS: usize = 4096;

/// A place on a border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BorderPoint {
    /// A welded point.
    Point(u32),
    /// On a border edge, at a share of it.
    On { border: u32, share: f64 },
}

/// A place on the straight line between two others.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointOnLine {
    pub(super) ends: [BorderPoint; 2],
    /// Share of the way from the first to the second.
    pub(super) share: f64,
}

/// Two places that are to become one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tie {
    pub(super) sides: [BorderPoint; 2],
    /// Where they meet if the seam is straight; else in the middle.
    pub(super) on_line: Option<PointOnLine>,
}

impl Tie {
    /// They meet in the middle.
    pub(super) fn new(sides: [BorderPoint; 2]) -> Self {
        Self { sides, on_line: None }
    }

    /// Whether no edge needs to be cut.
    pub(super) fn is_between_vertices(&self) -> bool {
        self.sides.iter().all(|side| match side {
            BorderPoint::Point(_) => true,
            BorderPoint::On { share, .. } => *share == 0.0 || *share == 1.0,
        })
    }
}

/// A new vertex on a border edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Insertion {
    pub(super) border: u32,
    /// Where on the edge, 0 to 1.
    pub(super) share: f64,
}

/// The welded points and the cuts of the border edges between them, in groups that become one point.
///
/// Two places on one edge never get into one group, so that no border edge vanishes.
pub(super) struct PointGroups {
    /// The welded points come first, then the cuts.
    parent: Vec<u32>,
    /// The groups as rings.
    next: Vec<u32>,
    size: Vec<u32>,
    /// The box around the places of each group.
    boxes: Vec<[Vec3; 2]>,
    pub(super) insertions: Vec<Insertion>,
    /// The cuts of each border edge, as places.
    insertions_on: Vec<Vec<u32>>,
    point_count: usize,
    /// How far each group may be moved: half of the largest diagonal of its box.
    reach: Vec<f32>,
    /// The least distance of two cuts of an edge.
    spacing: f64,
    /// The places that are on straight seams.
    on_lines: Vec<(u32, PointOnLine)>,
}

impl PointGroups {
    pub(super) fn new(positions: &[Vec3], borders: &Borders, limits: &Limits) -> Self {
        let count = positions.len();
        let mut reach = vec![0.0_f32; count];
        for border in &borders.list {
            for point in border.ends {
                reach[point as usize] = limits.reach(border) as f32;
            }
        }
        Self {
            parent: (0..count as u32).collect(),
            next: (0..count as u32).collect(),
            size: vec![1; count],
            boxes: positions.iter().map(|&p| [p; 2]).collect(),
            insertions: Vec::new(),
            insertions_on: vec![Vec::new(); borders.list.len()],
            point_count: count,
            reach,
            spacing: limits.spacing,
            on_lines: Vec::new(),
        }
    }

    /// The group of a place: one of its members.
    pub(super) fn group(&self, mut place: u32) -> u32 {
        while self.parent[place as usize] != place {
            place = self.parent[place as usize];
        }
        place
    }

    /// Number of points and cuts.
    pub(super) fn count(&self) -> usize {
        self.parent.len()
    }

    /// The cut of a place, unless it is a point.
    pub(super) fn cut(&self, place: u32) -> Option<&Insertion> {
        self.insertions.get((place as usize).checked_sub(self.point_count)?)
    }

    /// The cuts of a border edge, as places, in no order.
    pub(super) fn insertions_on(&self, border: u32) -> &[u32] {
        &self.insertions_on[border as usize]
    }

    /// Whether a group has several places.
    pub(super) fn is_shared(&self, group: u32) -> bool {
        self.size[group as usize] > 1
    }

    /// The middle of the places of a group of more than one.
    pub(super) fn middle(&self, group: u32) -> Option<Vec3> {
        let [low, high] = self.boxes[group as usize].map(Vec3::as_dvec3);
        self.is_shared(group).then(|| low.midpoint(high).as_vec3())
    }

    /// How far the places of a group may be moved.
    pub(super) fn reach(&self, group: u32) -> f32 {
        self.reach[group as usize] * (1.0 + 1e-5)
    }

    /// All members of a group, given one of them.
    pub(super) fn members(&self, place: u32) -> impl Iterator<Item = u32> {
        let mut next = Some(place);
        std::iter::from_fn(move || {
            let member = next?;
            next = Some(self.next[member as usize]).filter(|&n| n != place);
            Some(member)
        })
    }

    /// Where the groups on straight seams are on their line, if no place is too far from it.
    pub(super) fn on_lines(&self, borders: &Borders, positions: &[Vec3]) -> Vec<Option<Vec3>> {
        let mut targets = vec![None; self.count()];
        for &(place, PointOnLine { ends, share }) in &self.on_lines {
            let place_of = |end: u32| {
                let group = self.group(end);
                let target = targets[group as usize].or_else(|| self.middle(group)).map(Vec3::as_dvec3);
                target.unwrap_or_else(|| self.position(borders, end, positions))
            };
            let ends = ends.map(|end| self.settle(borders, end).map(place_of));
            let [Some(from), Some(to)] = ends else { continue };
            let (group, target) = (self.group(place), from.lerp(to, share).as_vec3());
            let is_near = |member| {
                let position = self.position(borders, member, positions).as_vec3();
                position.distance(target) <= self.reach(group)
            };
            if self.members(group).all(is_near) {
                targets[group as usize] = Some(target);
            }
        }
        targets
    }

    /// Makes one group of the groups of two places, unless it became too large, or two places of one edge became one.
    pub(super) fn tie(&mut self, borders: &Borders, tie: Tie) -> bool {
        let is_tied = self.tie_sides(borders, &tie);
        if is_tied
            && let Some(on_line) = tie.on_line
            && let Some(place) = self.settle(borders, tie.sides[0])
        {
            self.on_lines.push((place, on_line));
        }
        is_tied
    }

    fn tie_sides(&mut self, borders: &Borders, tie: &Tie) -> bool {
        let [a, b] = tie.sides.map(|side| self.settle(borders, side));
        if let (Some(a), Some(b)) = (a, b) {
            return self.unite(borders, a, b);
        }
        let [Some(a), Some(b)] = tie.sides.map(|side| self.make(borders, side)) else { return false };
        if self.unite(borders, a, b) {
            return true;
        }
        // Cuts that nothing is tied to are taken back, the last one first.
        for place in [a.max(b), a.min(b)] {
            if place as usize + 1 == self.parent.len()
                && self.next[place as usize] == place
                && let Some(cut) = self.cut(place).copied()
            {
                self.insertions_on[cut.border as usize].pop();
                self.insertions.pop();
                self.parent.pop();
                self.next.pop();
                self.size.pop();
                self.boxes.pop();
                self.reach.pop();
            }
        }
        false
    }

    /// The existing place there, if there is one.
    fn settle(&self, borders: &Borders, place: BorderPoint) -> Option<u32> {
        match place {
            BorderPoint::Point(point) => Some(point),
            BorderPoint::On { border, share } => {
                let edge = borders.get(border);
                let near = |other: f64| (share - other).abs() * edge.length < self.spacing;
                let end = [0.0, 1.0].into_iter().zip(edge.ends).find(|&(s, _)| near(s));
                let cut = || {
                    let cuts = self.insertions_on(border).iter().copied();
                    cuts.into_iter().find(|&c| self.cut(c).is_some_and(|cut| near(cut.share)))
                };
                end.map(|(_, point)| point).or_else(cut)
            }
        }
    }

    fn make(&mut self, borders: &Borders, place: BorderPoint) -> Option<u32> {
        if let Some(place) = self.settle(borders, place) {
            return Some(place);
        }
        let BorderPoint::On { border, share } = place else { return None };
        if self.insertions_on(border).len() >= MAX_INSERTIONS {
            return None;
        }
        let number = self.parent.len() as u32;
        self.parent.push(number);
        self.next.push(number);
        self.size.push(1);
        self.boxes.push([borders.get(border).at(share).as_vec3(); 2]);
        self.reach.push(self.reach[borders.get(border).ends[0] as usize]);
        self.insertions.push(Insertion { border, share });
        self.insertions_on[border as usize].push(number);
        Some(number)
    }

    /// Makes one group of the groups of two existing places, as [`Self::tie`].
    pub(super) fn unite(&mut self, borders: &Borders, a: u32, b: u32) -> bool {
        let (a, b) = (self.group(a), self.group(b));
        if a == b {
            return true;
        }
        let (small, large) = if self.size[a as usize] < self.size[b as usize] { (a, b) } else { (b, a) };
        let [[low_a, high_a], [low_b, high_b]] = [a, b].map(|g| self.boxes[g as usize]);
        let united = [low_a.min(low_b), high_a.max(high_b)];
        let reach = self.reach[a as usize].min(self.reach[b as usize]);
        if united[0].distance(united[1]) > 2.0 * reach * (1.0 + 1e-5)
            || self.members(small).any(|member| self.has_neighbor_in(borders, member, large))
        {
            return false;
        }
        self.parent[small as usize] = large;
        self.size[large as usize] += self.size[small as usize];
        self.boxes[large as usize] = united;
        self.reach[large as usize] = reach;
        self.next.swap(small as usize, large as usize);
        true
    }

    /// Whether a place shares an edge with a place of a group.
    fn has_neighbor_in(&self, borders: &Borders, place: u32, group: u32) -> bool {
        let on_edge = |border: u32| {
            let ends = borders.get(border).ends;
            ends.into_iter().chain(self.insertions_on(border).iter().copied()).any(|p| self.group(p) == group)
        };
        match self.cut(place) {
            Some(cut) => on_edge(cut.border),
            None => borders.starting_at(place).iter().chain(borders.ending_at(place)).any(|&b| on_edge(b)),
        }
    }

    /// Where a place is before anything moves.
    pub(super) fn position(&self, borders: &Borders, place: u32, positions: &[Vec3]) -> DVec3 {
        match self.cut(place) {
            Some(cut) => borders.get(cut.border).at(cut.share),
            None => positions[place as usize].as_dvec3(),
        }
    }
}
