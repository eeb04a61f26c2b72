//! How lines change while the camera goes round the model in small steps: each point of a line is taken to where it lies in the
//! next picture.

use std::fmt;

use glam::DVec2;
use hachure::geometry::visible_edges::VisibleEdges;
use hachure::geometry::{EdgeClass, Projector};

use crate::lines::{Lines, Point};

/// A point is found again within this, px, in a line of about its direction; with another class if none there has its own.
const NEAR: f64 = 1.5;
/// Two lines of different classes that are so near each other, px, may merge into one of them, and where they meet moves by as much
/// from one picture to the next.
const MERGING: f64 = 2.5;
/// A class that exact visible edges do not have within so many pixels is none that a line could have kept.
const TRUE_NEAR: usize = 2;
/// What crosses an inner line so near, px, may hide it in the next picture.
const CROSSING: f64 = 4.0;

/// What became of the points of a picture, as numbers of them.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct Changes {
    pub(crate) points: usize,
    /// Found again, with another class, though exact visible edges still have its class there. (Where a face turns away a
    /// fold becomes an outline.)
    pub(crate) classes: usize,
    /// Those of them where a line of the other class was near the point before: two lines have merged, or meet elsewhere now.
    pub(crate) merges: usize,
    /// Of inner lines whose ink has changed by more than a quarter, where nothing is that could hide them.
    pub(crate) strengths: usize,
}

impl Changes {
    /// Compares two pictures, each with where it is seen from; `truth`: of the second one.
    pub(crate) fn between(
        before: (&Lines, &Projector),
        after: (&Lines, &Projector),
        truth: &TrueClasses,
    ) -> Self {
        let mut changes = Self::default();
        let view_from_view = after.1.view_from_world * before.1.view_from_world.inverse();
        for (_, point) in before.0.points() {
            let seen = before.1.unproject(point.at, point.depth);
            let at = after.1.pixel(view_from_view.transform_point3(seen));
            let is_inside = at.min_element() > 2.0 && at.max_element() < f64::from(after.1.size[0]) - 2.0;
            if !is_inside {
                continue;
            }
            changes.points += 1;
            let found = Found::new(after.0, point, at);
            let has_changed = found.classes != 0 && found.classes & bit(point.class) == 0;
            if has_changed && truth.is_near(at, point.class) {
                changes.classes += 1;
                changes.merges += usize::from(found.was_near(before.0, point));
            }
            let is_weaker = (found.weight - point.weight).abs() > 0.25;
            if !point.class.is_profile() && is_weaker && !may_hide(before.0, point, point.at) {
                changes.strengths += usize::from(!may_hide(after.0, point, at));
            }
        }
        changes
    }

    /// With those of other pictures.
    #[must_use]
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            points: self.points + other.points,
            classes: self.classes + other.classes,
            merges: self.merges + other.merges,
            strengths: self.strengths + other.strengths,
        }
    }

    pub(crate) fn shares(&self) -> Shares {
        let percent = |count| 100.0 * count as f64 / self.points.max(1) as f64;
        Shares {
            classes: percent(self.classes),
            unmerged: percent(self.classes - self.merges),
            strengths: percent(self.strengths),
        }
    }
}

/// [`Changes`] in percent of the points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shares {
    pub(crate) classes: f64,
    /// Changes of class that are no merges.
    pub(crate) unmerged: f64,
    pub(crate) strengths: f64,
}

impl fmt::Display for Shares {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:6.3}  {:6.3}  {:6.3}", self.classes, self.unmerged, self.strengths)
    }
}

/// The classes of exact visible edges near each pixel of a square picture.
pub(crate) struct TrueClasses {
    side: usize,
    /// A bit per class.
    classes: Vec<u16>,
}

impl TrueClasses {
    /// Of these edges.
    pub(crate) fn new(edges: &VisibleEdges, side: usize) -> Self {
        let mut classes = vec![0; side * side];
        for (class, samples) in edges.samples.iter().enumerate() {
            for at in samples.iter().map(|sample| sample.position) {
                if at.min_element() >= 0.0 && at.max_element() < side as f64 {
                    classes[at.y as usize * side + at.x as usize] |= 1_u16 << class;
                }
            }
        }
        Self { side, classes }
    }

    fn is_near(&self, at: DVec2, class: EdgeClass) -> bool {
        let (x, y) = (at.x as usize, at.y as usize);
        let near = |v: usize| v.saturating_sub(TRUE_NEAR)..(v + TRUE_NEAR + 1).min(self.side);
        near(y).any(|y| near(x).any(|x| self.classes[y * self.side + x] & bit(class) != 0))
    }
}

fn bit(class: EdgeClass) -> u16 {
    1 << class as usize
}

/// What lines there are near the place of a point: of which classes, and how strong the strongest is.
struct Found {
    /// A bit per class.
    classes: u16,
    weight: f64,
}

impl Found {
    fn new(lines: &Lines, point: &Point, at: DVec2) -> Self {
        let mut found = Self { classes: 0, weight: 0.0 };
        for (_, other) in lines.around(at, 3) {
            if other.is_parallel(point) && other.at.distance(at) < NEAR {
                found.classes |= bit(other.class);
                found.weight = found.weight.max(other.weight);
            }
        }
        found
    }

    /// Whether a line of one of these classes was near a point, with which it may have merged.
    fn was_near(&self, before: &Lines, point: &Point) -> bool {
        before
            .around(point.at, 3)
            .any(|(_, other)| other.at.distance(point.at) < MERGING && self.classes & bit(other.class) != 0)
    }
}

fn may_hide(lines: &Lines, point: &Point, at: DVec2) -> bool {
    lines.around(at, CROSSING as i64).any(|(_, other)| {
        other.at.distance(at) < CROSSING && (other.class.is_profile() || !other.is_parallel(point))
    })
}
