//! Numbers that tell objects apart where their boxes meet: caps of neighbors are hatched differently, and where solids reach
//! into each other one cap lies over the other.

use crate::geometry::{Bounds, touching};
use crate::render::base::gpu_scene::GpuScene;
use crate::scene::NodeId;

/// What tells an object from those that touch it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct CapNumber {
    /// Different from that of each other one, and small.
    pub pattern: u32,
    /// Greater than that of each smaller one.
    pub level: u32,
}

/// Numbers by node. They depend on all objects that are visible and not on the plane, so that hatching stays as it is while
/// that moves. `margin`: boxes that are no farther apart touch.
pub(super) fn numbers(scene: &GpuScene, visible: &[NodeId], margin: f64) -> Vec<CapNumber> {
    let boxes: Vec<_> = visible.iter().map(|&node| scene.bounds_of(node)).collect();
    let mut numbers = vec![CapNumber::default(); scene.scene.nodes.len()];
    for (&node, number) in visible.iter().zip(numbers_of(&boxes, margin)) {
        numbers[node] = number;
    }
    numbers
}

fn numbers_of(boxes: &[Bounds], margin: f64) -> Vec<CapNumber> {
    let neighbors = neighbors(boxes, margin);
    let mut by_size: Vec<usize> = (0..boxes.len()).collect();
    by_size.sort_by(|&a, &b| boxes[a].diagonal().total_cmp(&boxes[b].diagonal()));
    let mut numbers: Vec<Option<CapNumber>> = vec![None; boxes.len()];
    for i in by_size {
        let smaller: Vec<CapNumber> = neighbors[i].iter().filter_map(|&other| numbers[other]).collect();
        let is_free = |pattern: &u32| smaller.iter().all(|other| other.pattern != *pattern);
        numbers[i] = Some(CapNumber {
            pattern: (0..).find(is_free).unwrap_or(0),
            level: smaller.iter().map(|other| other.level + 1).max().unwrap_or(0),
        });
    }
    numbers.into_iter().map(Option::unwrap_or_default).collect()
}

/// For each box those that it touches.
fn neighbors(boxes: &[Bounds], margin: f64) -> Vec<Vec<usize>> {
    let mut neighbors = vec![Vec::new(); boxes.len()];
    for [one, other] in touching(boxes, margin) {
        neighbors[one].push(other);
        neighbors[other].push(one);
    }
    neighbors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bounds::cube;

    #[test]
    fn what_touches_differs_and_the_larger_lies_lower() {
        let boxes = [
            cube([0.0; 3], 10.0),
            cube([1.0; 3], 1.0),
            cube([2.0, 1.0, 1.0], 2.0),
            cube([20.0; 3], 1.0),
            Bounds::EMPTY,
            cube([10.0, 0.0, 0.0], 3.0),
        ];
        let numbers = numbers_of(&boxes, 1e-6);
        for (i, a) in boxes.iter().enumerate() {
            for (j, b) in boxes.iter().enumerate().skip(i + 1) {
                let touches =
                    !a.is_empty() && !b.is_empty() && a.min.cmple(b.max).all() && a.max.cmpge(b.min).all();
                if touches {
                    assert_ne!(numbers[i].pattern, numbers[j].pattern, "{i} {j}");
                    let is_larger = a.diagonal() > b.diagonal();
                    assert_eq!(numbers[i].level > numbers[j].level, is_larger, "{i} {j}");
                }
            }
        }
        assert_eq!(numbers[3], CapNumber::default());
        assert_eq!(numbers[0], CapNumber { pattern: 2, level: 2 });
    }
}
